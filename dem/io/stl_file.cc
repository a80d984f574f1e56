#include "dem/io/stl_file.h"

#include "dem/error.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace mergel::dem {

static_assert(std::endian::native == std::endian::little, "as binary STL files are");

namespace {

constexpr std::size_t header = 84;       ///< bytes: 80 of text, the number of triangles
constexpr std::size_t per_triangle = 50; ///< normal, three corners, two bytes of attributes
const char* const again = ". Export it again, as ASCII or binary STL.";

bool is_blank(char c)
{
  return c == ' ' || (c >= '\t' && c <= '\r');
}

char lower(char c)
{
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

/// Words of a text, and the line in which the last one stands.
class Words {
public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  /// In lower case; empty at the end.
  std::string next()
  {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    std::string word;
    while (at_ < text_.size() && !is_blank(text_[at_])) word += lower(text_[at_++]);
    return word;
  }
  void skip_line()
  {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }
  void expect(const char* word)
  {
    const std::string found = next();
    if (found != word) fail("\"" + found + "\" where \"" + word + "\" is expected", found);
  }
  double number()
  {
    const std::string word = next();
    const char* from = word.data() + (word.starts_with('+') ? 1 : 0);
    const char* const end = word.data() + word.size();
    double value = 0.0;
    const auto [rest, error] = std::from_chars(from, end, value);
    if (error != std::errc{} || rest != end || !std::isfinite(value))
      fail("\"" + word + "\" is no coordinate", word);
    return value;
  }
  [[noreturn]] void fail(const std::string& what, const std::string& found) const
  {
    throw InputError(name_ + ":" + std::to_string(line_) + ": " +
                     (found.empty() ? "the file ends within a triangle" : what) + again);
  }

private:
  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::vector<StlTriangle> from_ascii(std::string_view text, const std::string& name)
{
  std::vector<StlTriangle> triangles;
  Words words(text, name);
  words.expect("solid");
  words.skip_line(); // its name
  for (bool is_open = true;;) {
    const std::string word = words.next();
    if (word.empty()) {
      require(!is_open, name + ": ends without \"endsolid\": it was cut off" + again);
      return triangles;
    }
    if (is_open && word == "endsolid") {
      words.skip_line();
      is_open = false;
    } else if (!is_open && word == "solid") {
      words.skip_line();
      is_open = true;
    } else if (is_open && word == "facet") {
      words.expect("normal");
      for (int k = 0; k < 3; ++k) words.next(); // some write "nan" where there is none
      words.expect("outer");
      words.expect("loop");
      StlTriangle& t = triangles.emplace_back();
      for (Vec3& corner : t) {
        words.expect("vertex");
        for (double& x : corner) x = words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
    } else {
      words.fail("\"" + word + "\" where " +
                     (is_open ? "\"facet\" or \"endsolid\"" : "\"solid\" or the end") +
                     " is expected",
                 word);
    }
  }
}

/// The shortest decimal number that stands for this one.
double decimal(float value)
{
  std::array<char, 32> text{};
  const auto written = std::to_chars(text.data(), text.data() + text.size(), value);
  double shortest = 0.0;
  std::from_chars(text.data(), written.ptr, shortest);
  return shortest;
}

std::uint32_t count_in(std::string_view bytes)
{
  std::uint32_t n = 0;
  std::memcpy(&n, bytes.data() + header - sizeof n, sizeof n);
  return n;
}

std::vector<StlTriangle> from_binary(std::string_view bytes, const std::string& name)
{
  std::vector<StlTriangle> triangles(count_in(bytes));
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<float, 12> row{}; // the normal, then the corners
    std::memcpy(row.data(), bytes.data() + header + per_triangle * t, sizeof row);
    for (std::size_t k = 0; k < 9; ++k) {
      const float x = row[3 + k];
      require(std::isfinite(x), name + ": triangle " + std::to_string(t + 1) +
                                    ": a coordinate is not a number" + again);
      triangles[t][k / 3][static_cast<Eigen::Index>(k % 3)] = decimal(x);
    }
  }
  return triangles;
}

} // namespace

std::vector<StlTriangle> stl_from(std::string_view bytes, const std::string& name)
{
  // The head of a binary file may begin with "solid" too: its size tells.
  if (bytes.size() >= header && bytes.size() == header + per_triangle * count_in(bytes)) {
    require(bytes.size() > header, name + ": has no triangles" + again);
    return from_binary(bytes, name);
  }
  std::string start;
  for (const char c : bytes.substr(0, 256))
    if (!is_blank(c) || !start.empty()) start += lower(c);
  if (!start.starts_with("solid")) {
    require(bytes.size() >= header, name + ": is no STL file" + again);
    throw InputError(name + ": is no STL file, or was cut off: as a binary one it counts " +
                     std::to_string(count_in(bytes)) +
                     " triangles of 50 bytes behind its 84, "
                     "and has " +
                     std::to_string(bytes.size()) + " bytes" + again);
  }
  std::vector<StlTriangle> triangles = from_ascii(bytes, name);
  require(!triangles.empty(), name + ": has no triangles" + again);
  return triangles;
}

} // namespace mergel::dem
