/// A case as text: the resolved case, its comparison with an earlier one, and the help on
/// the keys.
#include "apps/case/case_keys.h"
#include "apps/case/words.h"
#include "dem/io/atomic_file.h"

#include <algorithm>
#include <ostream>
#include <stdexcept>

namespace mergel::apps {

namespace {

constexpr std::size_t columns = 92;

} // namespace

void CaseFile::write_resolved(const std::filesystem::path& path,
                              const std::string& remarks) const
{
  std::string text = resolved_text();
  text.insert(text.find('\n') + 1, remarks);
  dem::replace_file(path, text);
}

std::string CaseFile::resolved_text() const
{
  if (!impl_->is_read) throw std::logic_error("CaseFile: no case has been read");
  std::string text(first_words_of_resolved);
  text += " mergel reads it back to the same bits.\n";
  for (const std::string& section : impl_->sections) {
    text += "\nsubsection " + section + "\n";
    for (const CaseKey& key : impl_->keys)
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
  const auto earlier_value = [entries = earlier](const std::string& section,
                                                 const std::string& key) {
    for (const CaseEntry& e : entries)
      if (e.section == section && e.key == key) return e.value;
    return std::string();
  };
  const auto is_told_by_sum = [&](const CaseKey& key) {
    return !key.sum.empty() && !impl_->at(key.section, key.sum).resolved.empty() &&
           !earlier_value(key.section, key.sum).empty();
  };
  std::vector<Change> changes;
  for (const CaseKey& key : impl_->keys) {
    if (!key.is_active) continue;
    const auto same = std::find_if(earlier.begin(), earlier.end(), [&](const auto& e) {
      return e.section == key.section && e.key == key.name;
    });
    const std::string was = same == earlier.end() ? "" : same->value;
    if ((was != key.resolved || same == earlier.end()) && !is_told_by_sum(key))
      changes.push_back({key.section, key.name, was, key.resolved});
    if (same != earlier.end()) earlier.erase(same);
  }
  for (const CaseEntry& e : earlier) {
    // A key that is void here was void there too, or the choice that makes it so has changed.
    const CaseKey* key = impl_->find(e.section, e.key);
    if (!key || key->is_active) changes.push_back({e.section, e.key, e.value, ""});
  }
  std::erase_if(changes, [&](const Change& c) {
    return c.was.empty() && c.is.empty() && impl_->is_numbered(c.section, c.key);
  });
  return changes;
}

std::vector<CaseFile::Description> CaseFile::descriptions() const
{
  const auto exists = [&](const CaseKey& key) {
    for (const CaseKey* k = &key; !k->choice.empty();) {
      const CaseKey* choice = impl_->find_all(k->section, k->choice).front();
      if (std::find(k->values.begin(), k->values.end(), choice->standard) ==
          k->values.end())
        return false;
      k = choice;
    }
    return true;
  };
  std::vector<Description> all;
  for (const std::string& section : impl_->sections)
    for (const CaseKey& key : impl_->keys) {
      if (key.section != section) continue;
      Description d{section,     key.name,     key.unit, key.standard,    key.rule,
                    key.allowed, key.sentence, {},       key.is_required, exists(key),
                    {}};
      if (!key.choice.empty())
        d.condition = "Where " + key.choice + " = " + joined(key.values, " | ");
      if (key.is_required && !key.needed_by.second.empty())
        d.not_needed = key.needed_by.first + "/" + key.needed_by.second + " = 0";
      all.push_back(std::move(d));
    }
  return all;
}

void CaseFile::help(std::ostream& out) const
{
  const std::vector<Description> keys = descriptions();
  std::size_t name_width = 3, unit_width = 4, default_width = 8;
  for (const Description& key : keys) {
    name_width = std::max(name_width, key.name.size());
    unit_width = std::max(unit_width, key.unit.size());
    for (const std::string* text : {&key.standard, &key.rule})
      if (text->size() <= 14) default_width = std::max(default_width, text->size());
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
    for (const Description& key : keys) {
      if (key.section != section) continue;
      row(key.name, key.unit,
          key.is_required        ? "required"
          : !key.rule.empty()    ? key.rule
          : key.standard.empty() ? "none"
                                 : key.standard,
          key.allowed);
      out << wrapped(
          (key.condition.empty() ? "" : key.condition + ": ") + key.sentence +
              (key.not_needed.empty() ? "" : " Not needed where " + key.not_needed + "."),
          "      ", columns);
    }
  }
}

} // namespace mergel::apps
