#include "dem/io/readable.h"

#include "dem/error.h"

#include <cerrno>
#include <fstream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mergel::dem {

namespace {

std::error_code system_error()
{
  return {errno, std::generic_category()};
}

[[noreturn]] void refuse(const std::filesystem::path& path, const std::error_code& error)
{
  throw InputError(path.string() + ": cannot be read: " + with_remedy(error) + ".");
}

} // namespace

std::error_code reading_error(const std::filesystem::path& file)
{
  // Without O_NONBLOCK a pipe that nobody writes would be waited for.
  const int number = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (number < 0) return system_error();
  struct stat status = {};
  const std::error_code error =
      ::fstat(number, &status) == 0 ? std::error_code() : system_error();
  ::close(number);
  if (error) return error;
  if (S_ISDIR(status.st_mode)) return std::make_error_code(std::errc::is_a_directory);
  if (!S_ISREG(status.st_mode)) return std::make_error_code(std::errc::invalid_seek);
  return {};
}

std::error_code listing_error(const std::filesystem::path& folder)
{
  std::error_code error;
  const std::filesystem::directory_iterator files(folder, error);
  if (!error && ::access(folder.c_str(), X_OK) != 0) return system_error();
  return error;
}

std::string with_remedy(const std::error_code& error)
{
  if (error == std::errc::invalid_seek)
    return "it is a pipe or a device. Name a regular file";
  const auto remedy = [&] {
    if (error == std::errc::permission_denied)
      return "Check its permissions and those of its folders";
    if (error == std::errc::is_a_directory) return "Name a file in it";
    if (error == std::errc::filename_too_long) return "Give a shorter name";
    return "Check the name";
  };
  return error.message() + ". " + remedy();
}

bool is_readable(const std::filesystem::path& file)
{
  const std::error_code error = reading_error(file);
  if (error == std::errc::no_such_file_or_directory) return false;
  if (error) refuse(file, error);
  return true;
}

void require_readable(const std::filesystem::path& file)
{
  if (const std::error_code error = reading_error(file)) refuse(file, error);
}

void require_folder(const std::filesystem::path& folder)
{
  const std::error_code error = listing_error(folder);
  if (error == std::errc::not_a_directory || error == std::errc::no_such_file_or_directory)
    throw InputError(folder.string() + ": is no folder.");
  if (error) refuse(folder, error);
}

bool begins_with(const std::filesystem::path& file, std::string_view bytes)
{
  std::ifstream in(file, std::ios::binary);
  std::string start(bytes.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in.good() && start == bytes;
}

} // namespace mergel::dem
