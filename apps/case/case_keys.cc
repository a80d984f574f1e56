#include "apps/case/case_keys.h"

#include "apps/case/words.h"
#include "dem/error.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <stdexcept>

namespace mergel::apps {

std::vector<CaseKey*> CaseFile::Impl::find_all(const std::string& section,
                                               const std::string& name)
{
  std::vector<CaseKey*> found;
  for (CaseKey& k : keys)
    if (k.section == section && k.name == name) found.push_back(&k);
  return found;
}

CaseKey* CaseFile::Impl::find(const std::string& section, const std::string& name)
{
  const auto found = find_all(section, name);
  for (CaseKey* k : found)
    if (k->is_active) return k;
  return found.empty() ? nullptr : found.front();
}

const CaseKey& CaseFile::Impl::at(const std::string& section, const std::string& name)
{
  if (!is_read) throw std::logic_error("CaseFile: no case has been read");
  if (const CaseKey* key = find(section, name)) return *key;
  throw std::logic_error("CaseFile: no key " + section + "/" + name);
}

void CaseFile::Impl::add(CaseKey key)
{
  if (open_section.empty())
    throw std::logic_error("CaseFile: " + key.name + " is declared outside a section");
  key.section = open_section;
  key.choice = open_choice;
  key.values = open_values;
  for (const CaseKey* other : find_all(key.section, key.name))
    if (other->choice.empty() || other->choice != key.choice ||
        std::find_first_of(other->values.begin(), other->values.end(), key.values.begin(),
                           key.values.end()) != other->values.end())
      throw std::logic_error("CaseFile: " + key.section + "/" + key.name +
                             " is declared twice");
  keys.push_back(std::move(key));
}

std::size_t NumberedKeys::number_in(const std::string& key) const
{
  if (!key.starts_with(stem + ' ')) return 0;
  std::size_t number = 0;
  const char *begin = key.data() + stem.size() + 1, *end = key.data() + key.size();
  const auto [at, error] = std::from_chars(begin, end, number);
  return error == std::errc{} && at == end && *begin != '0' ? number : 0;
}

CaseKey NumberedKeys::key(std::size_t number, const std::string& sentence,
                          Default standard) const
{
  CaseKey k;
  k.name = name(number);
  k.section = section;
  k.unit = "-";
  k.allowed = "text";
  k.sentence = sentence;
  k.is_required = standard == Default::none;
  k.write_hint = "a text";
  k.parse = [number, to = texts, sentence, is_required = k.is_required](
                const std::string& text, const std::filesystem::path&) {
    if (is_required && text.empty()) throw InputError("must not be empty. " + sentence);
    require_writable(text);
    if (!text.empty()) (*to)[number] = text;
    return text;
  };
  return k;
}

bool CaseFile::Impl::is_numbered(const std::string& section, const std::string& name) const
{
  return std::any_of(numbered.begin(), numbered.end(), [&](const NumberedKeys& group) {
    return group.section == section && group.number_in(name) > 0;
  });
}

std::string CaseFile::Impl::present_name(const std::string& section,
                                         const std::string& former) const
{
  if (const auto now = former_names.find({section, former}); now != former_names.end())
    return now->second;
  const auto stem = former.find_last_not_of("0123456789") + 1; // 0 of digits alone
  const auto now = former_names.find({section, former.substr(0, stem) + "N"});
  if (stem == former.size() || now == former_names.end()) return "";
  return now->second.substr(0, now->second.size() - 1) + former.substr(stem);
}

void CaseFile::Impl::declare_numbers(const std::vector<CaseEntry>& entries)
{
  for (const NumberedKeys& group : numbered) {
    group.texts->clear();
    std::set<std::size_t> numbers;
    for (const CaseEntry& e : entries)
      if (e.section == group.section) numbers.insert(group.number_in(e.key));
    std::erase_if(keys, [&](const CaseKey& k) {
      return k.section == group.section && group.number_in(k.name) > 1;
    });
    auto at = std::find_if(keys.begin(), keys.end(), [&](const CaseKey& k) {
      return k.section == group.section && k.name == group.name(1);
    });
    for (const std::size_t number : numbers)
      if (number > 1) at = keys.insert(at + 1, group.key(number, group.next));
  }
}

bool CaseFile::Impl::exists(const CaseKey& key)
{
  if (key.choice.empty()) return true;
  const CaseKey& choice = *find(key.section, key.choice);
  return choice.is_active && std::find(key.values.begin(), key.values.end(),
                                       choice.resolved) != key.values.end();
}

bool CaseFile::Impl::may_be_left_out(const CaseKey& key)
{
  const CaseKey* number = find(key.needed_by.first, key.needed_by.second);
  return number && number->is_active && std::stod(number->resolved) == 0.0;
}

void CaseFile::Impl::refuse_inactive(const CaseKey& key)
{
  std::vector<std::string> values;
  for (const CaseKey* k : find_all(key.section, key.name))
    values.insert(values.end(), k->values.begin(), k->values.end());
  const CaseKey& choice = *find(key.section, key.choice);
  throw InputError(place(key) + " = " + key.value + ": is a key of `" + key.choice +
                   "` = " + joined(values, " | ") + "; here it is " + choice.resolved +
                   ". Leave the key out, or change `" + key.choice + "`.");
}

std::string CaseFile::Impl::place(const CaseKey& key) const
{
  const std::string full = key.section + "/" + key.name;
  if (key.is_override) return "--set " + full;
  if (key.line > 0) return file_name + ":" + std::to_string(key.line) + ": " + full;
  return file_name + ": " + full;
}

std::vector<std::string> CaseFile::Impl::names_in(const std::string& section) const
{
  std::vector<std::string> names;
  for (const CaseKey& key : keys)
    if (key.section == section &&
        std::find(names.begin(), names.end(), key.name) == names.end())
      names.push_back(key.name);
  return names;
}

void CaseFile::Impl::refuse_section(const std::string& place,
                                    const std::string& section) const
{
  if (const auto now = former_sections.find(section); now != former_sections.end())
    throw InputError(place + "the section \"" + section + "\" is now \"" + now->second +
                     "\". Rename it.");
  const std::string meant = nearest(section, sections);
  throw InputError(place + "unknown section \"" + section + "\". " +
                   (meant.empty() ? "There are " + joined(sections, ", ")
                                  : "Did you mean \"" + meant + "\"?") +
                   (meant.empty() ? "." : ""));
}

void CaseFile::Impl::refuse_key(const std::string& place, const CaseEntry& entry) const
{
  if (const std::string now = present_name(entry.section, entry.key); !now.empty())
    throw InputError(place + " = " + entry.value + ": this key is now `" + now +
                     "`. Rename it.");
  std::string help;
  for (const CaseKey& key : keys)
    if (key.name == entry.key) help = "It belongs to section \"" + key.section + "\".";
  if (const auto meant = nearest(entry.key, names_in(entry.section));
      help.empty() && !meant.empty())
    help = "Did you mean \"" + meant + "\"?";
  if (help.empty()) help = "Its keys are " + joined(names_in(entry.section), ", ") + ".";
  throw InputError(place + " = " + entry.value + ": unknown key in section \"" +
                   entry.section + "\". " + help);
}

void CaseFile::Impl::match_file(const CaseScan& scan)
{
  std::vector<std::pair<int, std::string>> by_line;
  for (const auto& [section, line] : scan.sections) by_line.emplace_back(line, section);
  std::sort(by_line.begin(), by_line.end());
  for (const auto& [line, section] : by_line)
    if (std::find(sections.begin(), sections.end(), section) == sections.end())
      refuse_section(file_name + ":" + std::to_string(line) + ": ", section);

  for (const CaseEntry& entry : scan.entries) {
    CaseKey* key = find(entry.section, entry.key);
    if (!key)
      refuse_key(file_name + ":" + std::to_string(entry.line) + ": " + entry.section + "/" +
                     entry.key,
                 entry);
    for (CaseKey* same : find_all(entry.section, entry.key)) {
      same->value = entry.value;
      same->line = entry.line;
    }
  }
}

void CaseFile::Impl::match_override(const CaseEntry& entry)
{
  const std::string place = "--set " + entry.section + "/" + entry.key;
  if (std::find(sections.begin(), sections.end(), entry.section) == sections.end())
    refuse_section(place + " = " + entry.value + ": ", entry.section);
  CaseKey* key = find(entry.section, entry.key);
  if (!key) refuse_key(place, entry);
  if (key->is_override)
    throw InputError(place + " = " + entry.value + ": already given by another --set (" +
                     key->value + "). Keep one of the two.");
  for (CaseKey* same : find_all(entry.section, entry.key)) {
    // An empty text is a value; a number or a choice has none, and is as if it was not given.
    const bool is_unset = entry.value.empty() && !same->is_required && !same->is_text();
    same->is_override = !is_unset;
    same->value = is_unset ? same->standard : entry.value;
    if (is_unset) same->line = 0;
  }
}

} // namespace mergel::apps
