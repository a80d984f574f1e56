#include "apps/case_file.h"

#include "apps/case_scan.h"
#include "apps/units.h"
#include "apps/words.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <ostream>
#include <sstream>
#include <stdexcept>

namespace mergel::apps {

namespace {

constexpr std::size_t columns = 92;

/// One key: how it reads, and what it does with a text.
struct Key {
  std::string name = {}, unit = {}, allowed = {}, sentence = {};
  std::string standard = {};   ///< text of the default, which parse() takes back exactly
  bool is_required = false;    ///< no default
  std::string write_hint = {}; ///< what to write, for a missing key

  /// Set the variable; returns the text that sets it to the same bits anywhere.
  /// @param base folder where relative paths start
  /// @throws InputError without place and value, when the text cannot be used
  std::function<std::string(const std::string& text, const std::filesystem::path& base)>
      parse = {};

  std::string section = {};
  std::string choice = {};              ///< the key exists only where this other key of its
  std::vector<std::string> values = {}; ///< section has one of these values; "" for always
  bool is_active = true;                ///< whether it does, in the case as read
  std::string value = {}, resolved = {}; ///< as given, and for write_resolved()
  int line = 0;                          ///< in the case file; 0 if not there
  bool is_override = false;              ///< from --set
};

/// A violated range, and what helps: the range's own remedy, or what the key means.
std::string violation(const Range& range, const std::string& range_text,
                      const std::string& sentence)
{
  return "must satisfy " + range_text + ". " +
         (range.remedy.empty() ? sentence : range.remedy);
}

/// Texts that the format of the case file cannot hold are refused.
void require_writable(const std::string& text)
{
  if (text.find_first_of("#\n\r") != std::string::npos || text.ends_with('\\'))
    throw InputError("must be one line without '#', not ending in '\\'. Rename the file or "
                     "leave the character out.");
}

} // namespace

struct CaseFile::Impl {
  std::vector<std::string> sections; ///< in the order of declaration
  std::vector<Key> keys;
  std::string open_section;
  std::string open_choice;              ///< of the open condition
  std::vector<std::string> open_values; ///< of the open condition
  bool is_read = false;
  std::string file_name;
  std::map<std::string, int> section_lines;

  /// Every key of this name: more than one where conditions exclude each other.
  std::vector<Key*> find_all(const std::string& section, const std::string& name)
  {
    std::vector<Key*> found;
    for (Key& k : keys)
      if (k.section == section && k.name == name) found.push_back(&k);
    return found;
  }

  /// The one that exists in the case as read, else the first; null if there is none.
  Key* find(const std::string& section, const std::string& name)
  {
    const auto found = find_all(section, name);
    for (Key* k : found)
      if (k->is_active) return k;
    return found.empty() ? nullptr : found.front();
  }

  const Key& at(const std::string& section, const std::string& name)
  {
    if (!is_read) throw std::logic_error("CaseFile: no case has been read");
    if (const Key* key = find(section, name)) return *key;
    throw std::logic_error("CaseFile: no key " + section + "/" + name);
  }

  void add(Key key)
  {
    if (open_section.empty())
      throw std::logic_error("CaseFile: " + key.name + " is declared outside a section");
    key.section = open_section;
    key.choice = open_choice;
    key.values = open_values;
    for (const Key* other : find_all(key.section, key.name))
      if (other->choice.empty() || other->choice != key.choice ||
          std::find_first_of(other->values.begin(), other->values.end(), key.values.begin(),
                             key.values.end()) != other->values.end())
        throw std::logic_error("CaseFile: " + key.section + "/" + key.name +
                               " is declared twice");
    keys.push_back(std::move(key));
  }

  /// Whether the key exists, its choice being read already.
  bool exists(const Key& key)
  {
    if (key.choice.empty()) return true;
    const Key& choice = *find(key.section, key.choice);
    return choice.is_active && std::find(key.values.begin(), key.values.end(),
                                         choice.resolved) != key.values.end();
  }

  /// A key was given that does not exist in this case: say where it would.
  [[noreturn]] void refuse_inactive(const Key& key)
  {
    std::vector<std::string> values;
    for (const Key* k : find_all(key.section, key.name))
      values.insert(values.end(), k->values.begin(), k->values.end());
    const Key& choice = *find(key.section, key.choice);
    throw InputError(place(key) + " = " + key.value + ": is a key of `" + key.choice +
                     "` = " + joined(values, " | ") + "; here it is " + choice.resolved +
                     ". Leave the key out, or change `" + key.choice + "`.");
  }

  std::string place(const Key& key) const
  {
    const std::string full = key.section + "/" + key.name;
    if (key.is_override) return "--set " + full;
    if (key.line > 0) return file_name + ":" + std::to_string(key.line) + ": " + full;
    return file_name + ": " + full;
  }

  std::vector<std::string> names_in(const std::string& section) const
  {
    std::vector<std::string> names;
    for (const Key& key : keys)
      if (key.section == section &&
          std::find(names.begin(), names.end(), key.name) == names.end())
        names.push_back(key.name);
    return names;
  }

  /// Why this section/key is not known, with the likeliest meant. @param what "place: "
  [[noreturn]] void refuse_section(const std::string& place,
                                   const std::string& section) const
  {
    const std::string meant = nearest(section, sections);
    throw InputError(place + "unknown section \"" + section + "\". " +
                     (meant.empty() ? "There are " + joined(sections, ", ")
                                    : "Did you mean \"" + meant + "\"?") +
                     (meant.empty() ? "." : ""));
  }

  [[noreturn]] void refuse_key(const std::string& place, const CaseEntry& entry) const
  {
    std::string help;
    for (const Key& key : keys)
      if (key.name == entry.key) help = "It belongs to section \"" + key.section + "\".";
    if (const auto meant = nearest(entry.key, names_in(entry.section));
        help.empty() && !meant.empty())
      help = "Did you mean \"" + meant + "\"?";
    if (help.empty()) help = "Its keys are " + joined(names_in(entry.section), ", ") + ".";
    throw InputError(place + " = " + entry.value + ": unknown key in section \"" +
                     entry.section + "\". " + help);
  }

  /// Refuse what the file has and we do not know; note the lines of the rest.
  void match_file(const CaseScan& scan)
  {
    std::vector<std::pair<int, std::string>> by_line;
    for (const auto& [section, line] : scan.sections) by_line.emplace_back(line, section);
    std::sort(by_line.begin(), by_line.end());
    for (const auto& [line, section] : by_line)
      if (std::find(sections.begin(), sections.end(), section) == sections.end())
        refuse_section(file_name + ":" + std::to_string(line) + ": ", section);

    for (const CaseEntry& entry : scan.entries) {
      Key* key = find(entry.section, entry.key);
      if (!key)
        refuse_key(file_name + ":" + std::to_string(entry.line) + ": " + entry.section +
                       "/" + entry.key,
                   entry);
      for (Key* same : find_all(entry.section, entry.key)) same->line = entry.line;
    }
  }

  /// The same for one --set.
  void match_override(const CaseEntry& entry)
  {
    const std::string place = "--set " + entry.section + "/" + entry.key;
    if (std::find(sections.begin(), sections.end(), entry.section) == sections.end())
      refuse_section(place + " = " + entry.value + ": ", entry.section);
    Key* key = find(entry.section, entry.key);
    if (!key) refuse_key(place, entry);
    if (key->is_override)
      throw InputError(place + " = " + entry.value + ": already given by another --set (" +
                       key->value + "). Keep one of the two.");
    for (Key* same : find_all(entry.section, entry.key)) {
      same->is_override = true;
      same->value = entry.value;
    }
  }
};

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
         if (is_required && text.empty())
           throw InputError("must not be empty. " + sentence);
         const auto full =
             text.empty() ? std::filesystem::path{} : (base / text).lexically_normal();
         require_writable(full.string());
         target = full;
         return full.string();
       }});
}

void CaseFile::read(const std::filesystem::path& path,
                    const std::vector<std::string>& overrides)
{
  read(read_case_text(path), path.string(), std::filesystem::absolute(path).parent_path(),
       overrides);
}

void CaseFile::read_text(const std::string& text, const std::string& name,
                         const std::vector<std::string>& overrides)
{
  read(text, name, std::filesystem::current_path(), overrides);
}

void CaseFile::read(const std::string& text, const std::string& name,
                    const std::filesystem::path& case_folder,
                    const std::vector<std::string>& overrides)
{
  impl_->is_read = false;
  impl_->file_name = name;
  for (Key& key : impl_->keys) {
    key.line = 0;
    key.is_override = false;
    key.is_active = true;
  }

  const CaseScan scan = scan_case(text, impl_->file_name);
  impl_->section_lines = scan.sections;
  impl_->match_file(scan);

  // From here on the file is deal.II's to read. Its patterns stay open: the parsers of the
  // keys know more about units and ranges, and say it in one line.
  dealii::ParameterHandler prm;
  for (const Key& key : impl_->keys) {
    if (&key != impl_->find_all(key.section, key.name).front()) continue;
    prm.enter_subsection(key.section);
    prm.declare_entry(key.name, key.standard, dealii::Patterns::Anything(), key.sentence);
    prm.leave_subsection();
  }
  try {
    std::istringstream stream(text);
    prm.parse_input(stream, impl_->file_name);
  } catch (const dealii::ExceptionBase& error) {
    const std::string text = in_one_line(error.what());
    const std::string banner = "Additional information: ";
    const auto start = text.find(banner);
    throw InputError(impl_->file_name + ": " +
                     text.substr(start == std::string::npos ? 0 : start + banner.size()));
  }
  for (Key& key : impl_->keys) {
    prm.enter_subsection(key.section);
    key.value = key.line > 0 ? std::string(trimmed(prm.get(key.name))) : key.standard;
    prm.leave_subsection();
  }

  for (const std::string& argument : overrides)
    impl_->match_override(scan_override(argument));

  const auto working_folder = std::filesystem::current_path();
  for (Key& key : impl_->keys) {
    const bool is_given = key.is_override || key.line > 0;
    key.is_active = impl_->exists(key);
    if (!key.is_active) continue;
    if (key.is_required && !is_given) {
      const auto line = impl_->section_lines.find(key.section);
      throw InputError(
          impl_->file_name +
          (line == impl_->section_lines.end() ? std::string(": ")
                                              : ":" + std::to_string(line->second) + ": ") +
          key.section + "/" + key.name + ": must be given, it has no default. " +
          "Write \"set " + key.name + " = ...\", " + key.write_hint + ".");
    }
    try {
      key.resolved = key.parse(
          key.value, key.line > 0 && !key.is_override ? case_folder : working_folder);
    } catch (const InputError& error) {
      std::string message = error.what();
      if (!message.ends_with('.') && !message.ends_with('?')) message += ".";
      throw InputError(impl_->place(key) + " = " + key.value + ": " + message);
    }
  }
  for (const Key& key : impl_->keys)
    if ((key.is_override || key.line > 0) && !impl_->find(key.section, key.name)->is_active)
      impl_->refuse_inactive(key);
  impl_->is_read = true;
}

std::string CaseFile::where(const std::string& section, const std::string& key) const
{
  return impl_->place(impl_->at(section, key));
}

void CaseFile::refuse(const std::string& section, const std::string& key,
                      const std::string& message) const
{
  const Key& k = impl_->at(section, key);
  throw InputError(impl_->place(k) + " = " + k.value + ": " + message);
}

void CaseFile::resolve(const std::string& section, const std::string& key,
                       const std::string& value)
{
  impl_->at(section, key); // it is there, and a case was read
  impl_->find(section, key)->resolved = value;
}

bool CaseFile::is_given(const std::string& section, const std::string& key) const
{
  const Key& k = impl_->at(section, key);
  return k.is_active && (k.is_override || k.line > 0);
}

void CaseFile::write_resolved(const std::filesystem::path& path) const
{
  dem::replace_file(path, resolved_text());
}

std::string CaseFile::resolved_text() const
{
  if (!impl_->is_read) throw std::logic_error("CaseFile: no case has been read");
  std::string text =
      "# The complete case of a run, defaults included. mergel reads it back to "
      "the same bits.\n";
  for (const std::string& section : impl_->sections) {
    text += "\nsubsection " + section + "\n";
    for (const Key& key : impl_->keys)
      if (key.section == section && key.is_active)
        text += wrapped(key.sentence + " [" + key.allowed + "]", "  # ", columns) +
                "  set " + key.name + (key.resolved.empty() ? " =" : " = ") + key.resolved +
                "\n";
    text += "end\n";
  }
  return text;
}

std::vector<CaseFile::Change>
CaseFile::changes_since(const std::string& earlier_resolved_text) const
{
  if (!impl_->is_read) throw std::logic_error("CaseFile: no case has been read");
  std::vector<CaseEntry> earlier = scan_case(earlier_resolved_text, "earlier case").entries;
  std::vector<Change> changes;
  for (const Key& key : impl_->keys) {
    if (!key.is_active) continue;
    const auto same = std::find_if(earlier.begin(), earlier.end(), [&](const auto& e) {
      return e.section == key.section && e.key == key.name;
    });
    const std::string was = same == earlier.end() ? "" : same->value;
    if (was != key.resolved || same == earlier.end())
      changes.push_back({key.section, key.name, was, key.resolved});
    if (same != earlier.end()) earlier.erase(same);
  }
  for (const CaseEntry& e : earlier) changes.push_back({e.section, e.key, e.value, ""});
  return changes;
}

void CaseFile::help(std::ostream& out) const
{
  std::size_t name_width = 3, unit_width = 4, default_width = 8;
  for (const Key& key : impl_->keys) {
    name_width = std::max(name_width, key.name.size());
    unit_width = std::max(unit_width, key.unit.size());
    if (key.standard.size() <= 14)
      default_width = std::max(default_width, key.standard.size());
  }
  const auto row = [&](const std::string& name, const std::string& unit,
                       const std::string& standard, const std::string& allowed) {
    const auto padded = [](std::string text, std::size_t width) {
      text.resize(std::max(width, text.size()), ' ');
      return text + "  ";
    };
    const std::string start =
        padded("  " + name, name_width + 2) + padded(unit, unit_width);
    const std::string whole = start + padded(standard, default_width) + allowed;
    if (whole.size() <= columns) {
      out << whole << "\n";
      return;
    }
    // too long for one line: the default, then what is allowed, each under its column
    const std::string indent(start.size(), ' ');
    out << start << standard << "\n" << wrapped(allowed, indent, columns);
  };

  row("key", "unit", "default", "allowed");
  for (const std::string& section : impl_->sections) {
    out << "\n" << section << "\n";
    for (const Key& key : impl_->keys) {
      if (key.section != section) continue;
      row(key.name, key.unit,
          key.is_required ? "required" : (key.standard.empty() ? "none" : key.standard),
          key.allowed);
      const std::string condition =
          key.choice.empty()
              ? ""
              : "Where " + key.choice + " = " + joined(key.values, " | ") + ": ";
      out << wrapped(condition + key.sentence, "      ", columns);
    }
  }
}

} // namespace mergel::apps
