/// Reading a case: the values of its keys, and where each comes from.
#include "apps/case/case_forms.h"
#include "apps/case/case_keys.h"
#include "dem/error.h"

#include <system_error>

namespace mergel::apps {

namespace {

/// All entries of a case; a malformed --set, which is refused later, is left out.
std::vector<CaseEntry> with_overrides(std::vector<CaseEntry> entries,
                                      const std::vector<std::string>& overrides)
{
  for (const std::string& argument : overrides) try {
      entries.push_back(scan_override(argument));
    } catch (const InputError&) {
    }
  return entries;
}

/// Where the relative paths of a case start. A pipe or a device has no folder of its own: the
/// working folder, also where standard input is a regular file.
std::filesystem::path folder_of(const std::filesystem::path& case_file)
{
  const auto folder = std::filesystem::absolute(case_file).parent_path();
  std::error_code error;
  const bool has_folder = std::filesystem::is_regular_file(case_file, error) &&
                          folder != "/dev" && folder != "/dev/fd";
  return has_folder ? folder : std::filesystem::current_path();
}

} // namespace

void CaseFile::read(const std::filesystem::path& path,
                    const std::vector<std::string>& overrides)
{
  read(path, read_case_text(path), overrides);
}

void CaseFile::read(const std::filesystem::path& path, const std::string& text,
                    const std::vector<std::string>& overrides)
{
  read(text, path.string(), folder_of(path), overrides);
}

void CaseFile::continue_from(const std::string& earlier_resolved_text)
{
  impl_->is_continued = true;
  impl_->earlier = scan_case(earlier_resolved_text, "earlier case").entries;
}

bool CaseFile::is_continued() const
{
  return impl_->is_continued;
}

std::string CaseFile::earlier_value(const std::string& section,
                                    const std::string& key) const
{
  for (const CaseEntry& e : impl_->earlier)
    if (e.section == section && e.key == key) return e.value;
  return "";
}

void CaseFile::read_text(const std::string& text, const std::string& name,
                         const std::vector<std::string>& overrides)
{
  continue_from(text);
  read(text, name, std::filesystem::current_path(), overrides);
}

void CaseFile::read(const std::string& text, const std::string& name,
                    const std::filesystem::path& case_folder,
                    const std::vector<std::string>& overrides)
{
  impl_->is_read = false;
  impl_->file_name = name;
  const CaseScan scan = scan_case(text, impl_->file_name);
  impl_->declare_numbers(with_overrides(scan.entries, overrides));
  for (CaseKey& key : impl_->keys) {
    key.value = key.standard;
    key.line = 0;
    key.is_override = false;
    key.is_active = true;
  }
  impl_->section_lines = scan.sections;
  impl_->match_file(scan);

  for (const std::string& argument : overrides)
    impl_->match_override(scan_override(argument));

  const auto working_folder = std::filesystem::current_path();
  for (CaseKey& key : impl_->keys) {
    const bool is_given = key.is_override || key.line > 0;
    key.is_active = impl_->exists(key);
    if (!key.is_active) continue;
    if (key.is_required && !is_given && impl_->may_be_left_out(key)) {
      key.is_active = false;
      continue;
    }
    if (key.is_required && !is_given) {
      const auto line = impl_->section_lines.find(key.section);
      throw InputError(
          impl_->file_name +
          (line == impl_->section_lines.end() ? std::string(": ")
                                              : ":" + std::to_string(line->second) + ": ") +
          key.section + "/" + key.name + ": must be given, it has no default. " +
          "Write \"set " + key.name + " = ...\", " + key.write_hint + ".");
    }
    if (key.value == to_be_given)
      throw InputError(
          impl_->place(key) + " = " + key.value + ": is still to be filled in" +
          (key.write_hint.empty() ? "" : ", " + key.write_hint) + ". " + key.sentence);
    try {
      key.resolved = key.parse(
          key.value, key.line > 0 && !key.is_override ? case_folder : working_folder);
    } catch (const InputError& error) {
      std::string message = error.what();
      if (!message.ends_with('.') && !message.ends_with('?')) message += ".";
      throw InputError(impl_->place(key) + " = " + key.value + ": " + message);
    }
  }
  // The user did not choose the keys of a resolved case.
  const bool is_resolved = text.starts_with(first_words_of_resolved);
  for (const CaseKey& key : impl_->keys)
    if ((key.is_override || (key.line > 0 && !is_resolved)) &&
        !impl_->find(key.section, key.name)->is_active)
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
  if (!impl_->find(section, key) && impl_->is_numbered(section, key))
    throw InputError(impl_->file_name + ": " + section + "/" + key +
                     ", which is not given: " + message);
  const CaseKey& k = impl_->at(section, key);
  throw InputError(impl_->place(k) + " = " + k.value + ": " + message);
}

void CaseFile::resolve(const std::string& section, const std::string& key,
                       const std::string& value)
{
  impl_->at(section, key); // throws unless the key exists and a case was read
  impl_->find(section, key)->resolved = value;
}

bool CaseFile::is_override(const std::string& section, const std::string& key) const
{
  return impl_->at(section, key).is_override;
}

bool CaseFile::is_given(const std::string& section, const std::string& key) const
{
  const CaseKey& k = impl_->at(section, key);
  const bool is_empty = k.value.empty() && !k.rule.empty(); // it follows from other keys
  return k.is_active && !is_empty && (k.is_override || k.line > 0);
}

} // namespace mergel::apps
