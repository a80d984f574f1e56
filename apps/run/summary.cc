#include "apps/run/summary.h"

#include "apps/case/words.h"
#include "dem/text.h"

namespace mergel::apps {

void Summary::number(const std::string& name, double value)
{
  json(name, dem::shortest(value));
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
