#include "apps/case/case_forms.h"

#include "apps/case/words.h"

namespace mergel::apps {

namespace {

constexpr std::size_t columns = 92;

std::string or_null(const std::string& text)
{
  return text.empty() ? "null" : in_json(text);
}

std::string as_json(const CaseFile::Description& key)
{
  const bool has_default = !key.is_required && key.rule.empty();
  return "{\"section\": " + in_json(key.section) + ", \"key\": " + in_json(key.name) +
         ", \"unit\": " + (key.unit == "-" ? "null" : in_json(key.unit)) +
         ", \"default\": " + (has_default ? in_json(key.standard) : "null") +
         ", \"rule\": " + or_null(key.rule) +
         ", \"required\": " + (key.is_required ? "true" : "false") +
         ", \"range\": " + in_json(key.allowed) +
         ", \"meaning\": " + in_json(key.sentence) +
         ", \"condition\": " + or_null(key.condition) +
         ", \"not needed\": " + or_null(key.not_needed) + "}";
}

/// "Diameter of the shaft. [> 0 mm]", and when the key counts.
std::string remark_on(const CaseFile::Description& key)
{
  return (key.condition.empty() ? "" : key.condition + ": ") + key.sentence +
         (key.not_needed.empty() ? "" : " Not needed where " + key.not_needed + ".") +
         " [" + key.allowed + "]";
}

/// The line of a key in a template, a remark or not.
std::string line_of(const CaseFile::Description& key)
{
  const std::string set = "set " + key.name + " =";
  const std::string unit = key.unit == "-" ? "" : "   # with its unit, such as " + key.unit;
  // Required as long as the template is what it is: nothing else in it takes its place.
  const bool is_required = key.is_required || key.rule.starts_with("required");
  const bool is_given = key.exists_by_default && (is_required || !key.standard.empty());
  if (!is_given && !key.rule.empty()) return "# " + set + "   # default: " + key.rule;
  const std::string value = is_required
                                ? " " + std::string(is_given ? to_be_given : "...") + unit
                            : key.standard.empty() ? ""
                                                   : " " + key.standard;
  return (is_given ? "" : "# ") + set + value;
}

} // namespace

std::string keys_as_json(const CaseFile& file)
{
  std::vector<std::string> keys;
  for (const CaseFile::Description& key : file.descriptions())
    keys.push_back("    " + as_json(key));
  return "[\n" + joined(keys, ",\n") + "\n  ]";
}

std::string template_of(const CaseFile& file, const std::string& first_lines)
{
  std::string text = wrapped(first_lines, "# ", columns), section;
  std::string meaning; // of the key before: like keys share theirs
  for (const CaseFile::Description& key : file.descriptions()) {
    if (key.section != section) {
      text += (section.empty() ? "" : "end\n") + ("\nsubsection " + key.section + "\n");
      section = key.section;
    }
    if (remark_on(key) != meaning) text += "\n" + wrapped(remark_on(key), "  # ", columns);
    meaning = remark_on(key);
    text += "  " + line_of(key) + "\n";
  }
  return text + (section.empty() ? "" : "end\n");
}

} // namespace mergel::apps
