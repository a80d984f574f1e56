// The case file of the job pile, with every kind of key.
#include "tests/fuzz/reader.h"

#include "apps/pile/pile_case.h"
#include "dem/error.h"

#include <fstream>
#include <sstream>

namespace mergel::fuzz {

namespace {

std::string content(const std::filesystem::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

/// The resolved case. @throws InputError
std::string resolved(const std::filesystem::path& file)
{
  apps::CaseFile keys;
  apps::PileCase c;
  declare(keys, c);
  keys.read(file);
  complete(keys, c);
  const std::filesystem::path beside = file.string() + ".resolved";
  keys.write_resolved(beside);
  return content(beside);
}

} // namespace

const Reader case_reader{
    "case", false, [](const std::string& bytes, const std::filesystem::path& file) {
      write_bytes(file, bytes);
      std::string first;
      try {
        first = resolved(file);
      } catch (const InputError&) {
        return false;
      }
      write_bytes(file, first);
      try {
        promise(resolved(file) == first, "a resolved case resolves to another case");
      } catch (const InputError& e) {
        throw BrokenPromise(std::string("a resolved case is refused: ") + e.what());
      }
      return true;
    }};

} // namespace mergel::fuzz
