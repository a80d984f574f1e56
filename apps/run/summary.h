/// What a run has found: the figures of summary.json or failed.json, and the closing text
/// for the user.
#pragma once

#include <cstddef>
#include <sstream>
#include <string>

namespace mergel::apps {

/// The shortest text that reads back to the same bits; null, the absence of a value, where there
/// is no number: JSON has neither nan nor inf.
std::string number_in_json(double value);

class Summary {
public:
  /// A member of the JSON object, in the order of the calls. @param name with its unit
  void number(const std::string& name, double value);
  void count(const std::string& name, std::size_t value)
  {
    number(name, static_cast<double>(value));
  }
  void text(const std::string& name, const std::string& value);
  /// @param value is JSON; its lines are indented by two blanks
  void json(const std::string& name, const std::string& value);

  /// The complete object, one member a line.
  std::string object() const { return "{\n" + members_ + "\n}\n"; }

  std::ostringstream closing; ///< printed at the end, on lines of its own; may be empty

private:
  std::string members_;
};

} // namespace mergel::apps
