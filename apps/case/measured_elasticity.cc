#include "apps/case/measured_elasticity.h"

#include "apps/case/job_of_case.h"
#include "dem/error.h"
#include "dem/io/readable.h"

#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace mergel::apps {

namespace {

/// The number of a member `"name": number`; none without it.
std::optional<double> number(std::string_view object, const std::string& name)
{
  const std::string begin = '"' + name + "\": ";
  const auto at = object.find(begin);
  if (at == std::string_view::npos) return std::nullopt;
  const char* first = object.data() + at + begin.size();
  double value = 0.0;
  const auto [end, error] = std::from_chars(first, object.data() + object.size(), value);
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

} // namespace

MeasuredElasticity measured_elasticity(const std::filesystem::path& folder)
{
  const std::filesystem::path file = folder / "summary.json";
  if (const std::error_code error = dem::reading_error(file))
    throw InputError(error == std::errc::no_such_file_or_directory
                         ? "has no summary.json. Name the results folder of a finished "
                           "`mergel element` test"
                         : "its summary.json cannot be read: " + dem::with_remedy(error));
  // Platens hold the ends of other specimens: their E and nu are not the rock's.
  if (const auto resolved = folder / "resolved.prm"; dem::is_readable(resolved)) {
    const CaseJob job =
        job_of_case(scan_case(read_case_text(resolved), resolved.string()), {});
    if (job != CaseJob::element)
      throw InputError("is a run of mergel " + std::string(name_of(job)) +
                       ". Name the results folder of a finished `mergel element` test");
  }
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  // A stage is an object without objects in it.
  for (auto from = text.find('{', 1); from != std::string::npos;
       from = text.find('{', from + 1)) {
    const auto to = text.find_first_of("{}", from + 1);
    if (to == std::string::npos || text[to] != '}') continue;
    const std::string_view stage = std::string_view(text).substr(from, to - from);
    const auto E = number(stage, "Young's modulus [Pa]"),
               nu = number(stage, "Poisson's ratio [-]");
    if (E && nu) return {*E, *nu};
  }
  throw InputError(
      "its summary.json has no stage with Young's modulus and Poisson's ratio. "
      "Load the rock in a stage of compression or triaxial");
}

} // namespace mergel::apps
