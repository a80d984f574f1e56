/// The keys of a CaseFile: their declarations, search by name, and their lines in the file
/// that was read. Included by the sources of CaseFile only.
#pragma once

#include "apps/case/case_file.h"
#include "apps/case/case_scan.h"

#include <map>
#include <utility>

namespace mergel::apps {

/// One key: its description, its parser, and its value in the case that was read.
struct CaseKey {
  std::string name = {}, unit = {}, allowed = {}, sentence = {};
  std::string standard = {}; ///< text of the default; parse() gives the same bits
  std::string rule = {};     ///< by which the default follows from other keys, or ""
  /// Of a key with a rule: set the variable; returns its text as parse() does.
  std::function<std::string(double)> derive = {};
  bool is_required = false;    ///< no default
  std::string write_hint = {}; ///< what to write, for a missing key

  /// Set the variable; returns the text that sets it to the same bits anywhere.
  /// @param base folder where relative paths start
  /// @throws InputError without place and value, when the text cannot be used
  std::function<std::string(const std::string& text, const std::filesystem::path& base)>
      parse = {};

  /// Whether an empty value is a value.
  bool is_text() const
  {
    return allowed == "text" || allowed == "path" || allowed == "paths";
  }

  std::string section = {};
  std::string choice = {};              ///< the key exists only where this other key of its
  std::vector<std::string> values = {}; ///< section has one of these values; "" for always
  bool is_active = true;                ///< whether it does, in the case as read
  std::string value = {}, resolved = {}; ///< as given, and for write_resolved()
  int line = 0;                          ///< in the case file; 0 if not there
  bool is_override = false;              ///< from --set
  std::string sum = {}; ///< key of its section that tells its content; may be empty
  /// Section and name of a number; where that is zero the key may be left out. May be empty.
  std::pair<std::string, std::string> needed_by = {};
};

/// Refuse a text that the format of the case file cannot hold. @throws InputError
void require_writable(const std::string& text);

/// Keys "stem 1", "stem 2" and so on of a section.
struct NumberedKeys {
  std::string section, stem, next; ///< sentence of all but the first
  std::map<std::size_t, std::string>* texts;

  std::string name(std::size_t number) const { return stem + ' ' + std::to_string(number); }
  /// The number of a key of this name; 0 for any other.
  std::size_t number_in(const std::string& key) const;
  CaseKey key(std::size_t number, const std::string& sentence,
              Default standard = Default::present) const;
};

/// What a CaseFile holds.
struct CaseFile::Impl {
  std::vector<std::string> sections; ///< in the order of declaration
  std::vector<CaseKey> keys;
  std::vector<NumberedKeys> numbered;
  std::map<std::pair<std::string, std::string>, std::string>
      former_names; ///< by section and former name: the present one; "N" for any number
  std::map<std::string, std::string> former_sections; ///< the same
  std::string open_section;
  std::string open_choice;              ///< of the open condition
  std::vector<std::string> open_values; ///< of the open condition
  bool is_read = false;
  bool is_continued = false;
  std::vector<CaseEntry> earlier; ///< of the run that is continued
  std::string file_name;
  std::map<std::string, int> section_lines;

  /// Every key of this name: more than one where conditions exclude each other.
  std::vector<CaseKey*> find_all(const std::string& section, const std::string& name);

  /// The one that exists in the case as read, else the first; null if there is none.
  CaseKey* find(const std::string& section, const std::string& name);

  /// The same, of a case that was read. @throws std::logic_error when there is none
  const CaseKey& at(const std::string& section, const std::string& name);

  /// Declare a key in the open section, under the open condition.
  /// @throws std::logic_error when it is declared twice, or outside a section
  void add(CaseKey key);

  /// Whether the key exists, its choice being read already.
  bool exists(const CaseKey& key);

  /// Whether a key without a default may be left out, the numbers before it being read already.
  bool may_be_left_out(const CaseKey& key);

  /// Refuse a key that does not exist in this case, naming the choice that it belongs to.
  [[noreturn]] void refuse_inactive(const CaseKey& key);

  /// Whether this is a name of numbered keys, of a number that the case gives or not.
  bool is_numbered(const std::string& section, const std::string& name) const;

  /// The present name of a key that was renamed; "" for any other.
  std::string present_name(const std::string& section, const std::string& former) const;

  /// Declare the numbered keys that these entries have, and no others but the first of each.
  void declare_numbers(const std::vector<CaseEntry>& entries);

  /// Where the value of a key comes from, as in CaseFile::where().
  std::string place(const CaseKey& key) const;

  /// Names of a section's keys, in the order of declaration.
  std::vector<std::string> names_in(const std::string& section) const;

  /// Refuse an unknown section, naming the nearest known one. @param place "pile.prm:14: "
  [[noreturn]] void refuse_section(const std::string& place,
                                   const std::string& section) const;

  /// The same for a key. @param place "pile.prm:14: Pile/diametre"
  [[noreturn]] void refuse_key(const std::string& place, const CaseEntry& entry) const;

  /// Refuse unknown sections and keys of the file; set values and lines of the others.
  void match_file(const CaseScan& scan);

  /// The same for one --set. An empty value takes back what the file gives to an optional number
  /// or choice.
  void match_override(const CaseEntry& entry);
};

} // namespace mergel::apps
