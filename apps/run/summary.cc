#include "apps/run/summary.h"

#include "apps/case/words.h"
#include "dem/text.h"

#include <cmath>

namespace mergel::apps {

std::string number_in_json(double value)
{
  return std::isfinite(value) ? dem::shortest(value) : "null";
}

void Summary::number(const std::string& name, double value)
{
  json(name, number_in_json(value));
}

void Summary::text(const std::string& name, const std::string& value)
{
  json(name, in_json(value));
}

void Summary::json(const std::string& name, const std::string& value)
{
  members_ += (members_.empty() ? "" : ",\n") + ("  \"" + name + "\": " + value);
}

} // namespace mergel::apps
