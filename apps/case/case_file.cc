/// Declaring the keys of a case: the allowed values of each kind, and the parser of its
/// text.
#include "apps/case/case_file.h"

#include "apps/case/case_keys.h"
#include "apps/case/units.h"
#include "apps/case/word_list.h"
#include "apps/case/words.h"
#include "dem/error.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>

namespace mergel::apps {

namespace {

/// Message on a violated range: the range, and its remedy or else the sentence of the key.
std::string violation(const Range& range, const std::string& range_text,
                      const std::string& sentence)
{
  return "must satisfy " + range_text + ". " +
         (range.remedy.empty() ? sentence : range.remedy);
}

/// A name without the double quotes around it.
std::string unquoted(const std::string& name)
{
  const bool is_quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return is_quoted ? name.substr(1, name.size() - 2) : name;
}

/// @param base where a relative name starts
/// @throws InputError when a case file cannot hold it
std::filesystem::path absolute(const std::string& name, const std::filesystem::path& base)
{
  const std::filesystem::path full = (base / name).lexically_normal();
  require_writable(full.string());
  return full;
}

} // namespace

void require_writable(const std::string& text)
{
  if (text.find_first_of("#\n\r") != std::string::npos || text.ends_with('\\'))
    throw InputError("must be one line without '#', not ending in '\\'. Rename the file or "
                     "leave the character out.");
}

CaseFile::CaseFile() : impl_(std::make_unique<Impl>()) {}
CaseFile::~CaseFile() = default;
CaseFile::Section::~Section()
{
  file_.impl_->open_section.clear();
}

CaseFile::Section CaseFile::section(const std::string& name)
{
  if (!impl_->open_section.empty())
    throw std::logic_error("CaseFile: section " + name + " opens inside " +
                           impl_->open_section);
  auto& sections = impl_->sections;
  if (std::find(sections.begin(), sections.end(), name) == sections.end())
    sections.push_back(name);
  impl_->open_section = name;
  return Section(*this);
}

CaseFile::Condition::~Condition()
{
  file_.impl_->open_choice.clear();
  file_.impl_->open_values.clear();
}

CaseFile::Condition CaseFile::only_if(const std::string& choice,
                                      const std::vector<std::string>& values)
{
  if (!impl_->open_choice.empty() ||
      impl_->find_all(impl_->open_section, choice).size() != 1)
    throw std::logic_error(
        "CaseFile: a condition on " + choice +
        " needs one such key in the open section, and no other condition");
  impl_->open_choice = choice;
  impl_->open_values = values;
  return Condition(*this);
}

void CaseFile::former_name(const std::string& former, const std::string& key)
{
  impl_->former_names[{impl_->open_section, former}] = key;
}

void CaseFile::former_section(const std::string& former, const std::string& section)
{
  impl_->former_sections[former] = section;
}

void CaseFile::identified_by(const std::string& sum, const std::vector<std::string>& keys)
{
  for (const std::string& name : keys) {
    const auto found = impl_->find_all(impl_->open_section, name);
    if (found.empty()) throw std::logic_error("CaseFile: no key " + name + " to identify");
    for (CaseKey* key : found) key->sum = sum;
  }
}

void CaseFile::not_needed_at_zero(const std::string& section, const std::string& number,
                                  const std::vector<std::string>& keys)
{
  for (CaseKey& key : impl_->keys)
    if (key.section == impl_->open_section &&
        (keys.empty() || std::find(keys.begin(), keys.end(), key.name) != keys.end()))
      key.needed_by = {section, number};
}

void CaseFile::quantity(const std::string& key, double& target, const std::string& si_unit,
                        const Range& range, const std::string& sentence,
                        const std::string& shown_unit)
{
  const std::string shown = shown_unit.empty() ? si_unit : shown_unit;
  const bool is_required = std::isnan(target);
  if (!is_required && !(std::isfinite(target) && range.holds(target)))
    throw std::logic_error("CaseFile: the default of " + key + " is out of its range");

  const std::string range_text = range.text(si_unit, shown);
  with_unit(1.0, si_unit, shown); // throws std::logic_error for units that do not agree
  impl_->add({.name = key,
              .unit = si_unit == "1" ? "-" : shown,
              .allowed = range_text,
              .sentence = sentence,
              .standard = is_required ? "" : with_unit(target, si_unit, shown),
              .is_required = is_required,
              .write_hint = "for example " + example_of(si_unit),
              .parse = [=, &target](const std::string& text, const std::filesystem::path&) {
                const double value = to_si(text, si_unit);
                if (!range.holds(value))
                  throw InputError(violation(range, range_text, sentence));
                target = value;
                return with_unit(value, si_unit, shown);
              }});
}

void CaseFile::derived(const std::string& key, double& target, const std::string& si_unit,
                       const Range& range, const std::string& rule,
                       const std::string& sentence, const std::string& shown_unit)
{
  const std::string shown = shown_unit.empty() ? si_unit : shown_unit;
  const std::string range_text = range.text(si_unit, shown);
  with_unit(1.0, si_unit, shown); // throws std::logic_error for units that do not agree
  const auto set = [=, &target](double value) {
    if (!range.holds(value)) throw InputError(violation(range, range_text, sentence));
    target = value;
    return with_unit(value, si_unit, shown);
  };
  impl_->add({.name = key,
              .unit = si_unit == "1" ? "-" : shown,
              .allowed = range_text,
              .sentence = sentence,
              .rule = rule,
              .derive = set,
              .parse = [=, &target](const std::string& text, const std::filesystem::path&) {
                target = std::numeric_limits<double>::quiet_NaN();
                return text.empty() ? text : set(to_si(text, si_unit));
              }});
}

void CaseFile::derive(const std::string& section, const std::string& key, double value)
{
  const CaseKey& k = impl_->at(section, key);
  if (k.rule.empty()) throw std::logic_error("CaseFile: " + key + " follows from no other");
  if (!k.value.empty() || !k.is_active) return;
  try {
    impl_->find(section, key)->resolved = k.derive(value);
  } catch (const InputError& e) {
    throw InputError(impl_->place(k) + " = " + k.rule + ": " + e.what());
  }
}

void CaseFile::number(const std::string& key, double& target, const Range& range,
                      const std::string& sentence)
{
  quantity(key, target, "1", range, sentence);
}

void CaseFile::add_integer(const std::string& key, std::int64_t present, Limits limits,
                           std::function<void(std::int64_t)> set, const Range& range,
                           const std::string& sentence, Default standard)
{
  const bool is_required = standard == Default::none;
  if (!is_required && !range.holds(static_cast<double>(present)))
    throw std::logic_error("CaseFile: the default of " + key + " is out of its range");

  const std::string range_text = range.text("1");
  impl_->add({.name = key,
              .unit = "-",
              .allowed = "whole, " + range_text,
              .sentence = sentence,
              .standard = is_required ? "" : std::to_string(present),
              .is_required = is_required,
              .write_hint = "a whole number",
              .parse = [=](const std::string& text, const std::filesystem::path&) {
                std::int64_t value = 0;
                const char* end = text.data() + text.size();
                const auto parsed = std::from_chars(text.data(), end, value);
                if (parsed.ec == std::errc::result_out_of_range ||
                    (parsed.ec == std::errc{} && parsed.ptr == end &&
                     (value < limits.lower || value > limits.upper)))
                  throw InputError("must lie between " + std::to_string(limits.lower) +
                                   " and " + std::to_string(limits.upper) + ". " +
                                   sentence);
                if (parsed.ec != std::errc{} || parsed.ptr != end)
                  throw InputError("is not a whole number. " + sentence);
                if (!range.holds(static_cast<double>(value)))
                  throw InputError(violation(range, range_text, sentence));
                set(value);
                return std::to_string(value);
              }});
}

void CaseFile::add_choice(const std::string& key, const std::vector<std::string>& names,
                          std::size_t present, std::function<void(std::size_t)> set,
                          const std::string& sentence, Default standard)
{
  const bool is_required = standard == Default::none;
  if (!is_required && present >= names.size())
    throw std::logic_error("CaseFile: the default of " + key + " is none of its choices");

  const std::string all = joined(names, " | ");
  impl_->add({.name = key,
              .unit = "-",
              .allowed = all,
              .sentence = sentence,
              .standard = is_required ? "" : names[present],
              .is_required = is_required,
              .write_hint = "one of " + all,
              .parse = [=](const std::string& text, const std::filesystem::path&) {
                const auto found = std::find(names.begin(), names.end(), text);
                if (found == names.end()) {
                  const std::string meant = nearest(text, names);
                  throw InputError(
                      "must be one of " + all + ". " +
                      (meant.empty() ? sentence : "Did you mean \"" + meant + "\"?"));
                }
                set(static_cast<std::size_t>(found - names.begin()));
                return text;
              }});
}

void CaseFile::choice(const std::string& key, std::string& target,
                      const std::vector<std::string>& options, const std::string& sentence,
                      Default standard)
{
  const auto present = std::find(options.begin(), options.end(), target);
  add_choice(
      key, options, static_cast<std::size_t>(present - options.begin()),
      [&target, options](std::size_t which) { target = options[which]; }, sentence,
      standard);
}

void CaseFile::flag(const std::string& key, bool& target, const std::string& sentence)
{
  impl_->add({.name = key,
              .unit = "-",
              .allowed = "true | false",
              .sentence = sentence,
              .standard = target ? "true" : "false",
              .is_required = false,
              .parse = [=, &target](const std::string& text, const std::filesystem::path&) {
                const bool is_true = text == "true" || text == "yes";
                if (!is_true && text != "false" && text != "no")
                  throw InputError("must be true or false. " + sentence);
                target = is_true;
                return std::string(is_true ? "true" : "false");
              }});
}

void CaseFile::text(const std::string& key, std::string& target,
                    const std::string& sentence, Default standard)
{
  const bool is_required = standard == Default::none;
  impl_->add({.name = key,
              .unit = "-",
              .allowed = "text",
              .sentence = sentence,
              .standard = is_required ? "" : target,
              .is_required = is_required,
              .write_hint = "a text",
              .parse = [=, &target](const std::string& text, const std::filesystem::path&) {
                if (is_required && text.empty())
                  throw InputError("must not be empty. " + sentence);
                require_writable(text);
                return target = text;
              }});
}

void CaseFile::numbered(const std::string& stem, std::map<std::size_t, std::string>& texts,
                        const std::string& sentence, const std::string& next, Default first)
{
  const NumberedKeys group{impl_->open_section, stem, next, &texts};
  impl_->add(group.key(1, sentence, first));
  impl_->numbered.push_back(group);
}

void CaseFile::path(const std::string& key, std::filesystem::path& target,
                    const std::string& sentence, Default standard)
{
  const bool is_required = standard == Default::none;
  impl_->add(
      {.name = key,
       .unit = "-",
       .allowed = "path",
       .sentence = sentence,
       .standard = is_required ? "" : target.string(),
       .is_required = is_required,
       .write_hint = "the name of a file",
       .parse = [=, &target](const std::string& text, const std::filesystem::path& base) {
         const std::string name = unquoted(text);
         if (is_required && name.empty())
           throw InputError("must not be empty. " + sentence);
         target = name.empty() ? std::filesystem::path{} : absolute(name, base);
         return target.string();
       }});
}

void CaseFile::paths(const std::string& key, std::vector<std::filesystem::path>& targets,
                     const std::string& sentence)
{
  targets.clear();
  impl_->add(
      {.name = key,
       .unit = "-",
       .allowed = "paths",
       .sentence = sentence,
       .parse = [&targets](const std::string& text, const std::filesystem::path& base) {
         targets.clear();
         std::vector<std::string> names;
         for (const std::string& word : words_of(text)) {
           if (word.empty()) throw InputError("has a name without a letter. Leave it out");
           targets.push_back(absolute(word, base));
           names.push_back(as_word(targets.back().string()));
         }
         return joined(names, " ");
       }});
}

} // namespace mergel::apps
