#include "apps/case/strength_keys.h"

#include "apps/case/material_keys.h"

#include <sstream>

namespace mergel::apps {

namespace {

const std::vector<std::pair<std::string, dem::StrengthVariability::Distribution>>
    distributions{{"none", dem::StrengthVariability::Distribution::none},
                  {"log-normal", dem::StrengthVariability::Distribution::log_normal},
                  {"Weibull", dem::StrengthVariability::Distribution::weibull}};

} // namespace

void declare(CaseFile& file, dem::StrengthVariability& v)
{
  const auto section = file.section("Strength variability");
  file.choice(
      "distribution", v.distribution, distributions,
      "Distribution of a factor of mean 1 that is drawn for each particle. The strengths "
      "of a bond are multiplied by the mean of the factors of its two particles, those of "
      "a bond to a wall by the factor of its particle.");
  const auto only = file.only_if("distribution", {"log-normal", "Weibull"});
  v.variation = unset;
  file.number("coefficient of variation", v.variation, above_to(0.0, 1.0),
              "Standard deviation of the particles' factors; that of the bonds is 0.71 "
              "times as large.");
  file.integer("seed", v.seed, non_negative,
               "Of the factors; with the same seed a particle has the same factor in all "
               "jobs.");
}

std::string report(const dem::StrengthVariability& v, const dem::Particles& p)
{
  if (!v.is_on()) return "";
  std::string name;
  for (const auto& [text, distribution] : distributions)
    if (distribution == v.distribution) name = text;
  const dem::StrengthSpread drawn = dem::describe_strengths(p);
  std::ostringstream out;
  out.precision(4);
  out << "\nstrengths vary: " << name << ", seed " << v.seed
      << "; factors of the particles " << drawn.smallest << " to " << drawn.largest
      << ", mean " << drawn.mean << ", coefficient of variation " << drawn.variation
      << " (wanted " << v.variation << ')';
  return out.str();
}

} // namespace mergel::apps
