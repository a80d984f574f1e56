/// A small case with a key of each kind, read from files in a temporary folder.
#pragma once

#include "apps/case/case_file.h"
#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace mergel::apps::test {

/// A temporary folder for one test. It is the working folder meanwhile, so that messages
/// name "pile.prm" alone.
class WorkingFolder {
public:
  WorkingFolder() : before_(std::filesystem::current_path())
  {
    std::filesystem::current_path(folder_.path);
  }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

private:
  TemporaryFolder folder_;
  std::filesystem::path before_;
};

inline void write(const std::filesystem::path& file, const std::string& text)
{
  std::ofstream(file, std::ios::binary) << text;
}

inline std::string content(const std::filesystem::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

enum class Flow { conjugate, published };

/// A small case with a key of each kind.
struct Case {
  double porosity = 0.52;
  std::filesystem::path sample, notes;
  std::uint64_t seed = 1;
  int bands = 4;
  double E = 0.63e9;
  double sigma_t = std::numeric_limits<double>::quiet_NaN();
  Flow flow = Flow::conjugate;
  double nu = 0.14;
  double D = std::numeric_limits<double>::quiet_NaN();
  double cone = std::numbers::pi / 3.0;
  bool is_half = true;
  std::string title, side = "free";

  void declare(CaseFile& file)
  {
    {
      const auto section = file.section("Specimen");
      file.number("porosity", porosity, inside(0.0, 1.0).named("n"), "Pores over volume.");
      file.path("file", sample, "Sample to read.");
      file.integer("seed", seed, any, "Seed of the random numbers.");
      file.integer("bands", bands, between(1, 20), "Bands of the report.");
    }
    {
      const auto section = file.section("Bond");
      file.quantity("effective modulus", E, "Pa", positive, "Modulus of the bond, Eq. 4.");
      file.quantity("tensile strength", sigma_t, "Pa", positive,
                    "Tensile strength of the bond, Eq. 6.", "MPa");
      file.choice("bending flow", flow,
                  {{"conjugate", Flow::conjugate}, {"published", Flow::published}},
                  "Flow rule of the bending moment, Eq. 7.");
    }
    {
      const auto section = file.section("Far field");
      file.number(
          "Poisson ratio", nu,
          from_to(0.0, 0.5).named("nu").advise("Use 0.49 if nearly incompressible."),
          "Poisson's ratio.");
      file.choice("side", side, {"free", "roller", "fixed"}, "Outer side.");
    }
    {
      const auto section = file.section("Pile");
      file.quantity("diameter", D, "m", above_to(0.0, 0.1), "Diameter.", "mm");
      file.quantity("cone angle", cone, "rad", above_to(0.0, std::numbers::pi),
                    "Full angle.", "degree");
      file.flag("half", is_half, "Half model.");
      file.text("title", title, "Text for the report.");
    }
  }

  bool operator==(const Case&) const = default;
};

inline const std::string good = R"(# a pile
subsection Bond
  set tensile strength = 1 MPa  # Table 1
end

subsection Pile
  set diameter = 1.4 mm
end
)";

/// The case read from `text`; throws as read() does.
inline Case read_text(const std::string& text,
                      const std::vector<std::string>& overrides = {})
{
  write("pile.prm", text);
  Case c;
  CaseFile file;
  c.declare(file);
  file.read("pile.prm", overrides);
  return c;
}

/// The one-line message with which `text` is refused.
inline std::string refusal(const std::string& text,
                           const std::vector<std::string>& overrides = {})
{
  try {
    read_text(text, overrides);
  } catch (const InputError& error) {
    const std::string message = error.what();
    CHECK(message.find('\n') == std::string::npos);
    return message;
  }
  return "accepted";
}

/// good, with `line` appended to a section Far field; it becomes line 11.
inline std::string with_far_field(const std::string& line)
{
  return good + "\nsubsection Far field\n  " + line + "\nend\n";
}

inline std::string replaced(std::string text, const std::string& old,
                            const std::string& fresh)
{
  const auto at = text.find(old);
  REQUIRE(at != std::string::npos);
  return text.replace(at, old.size(), fresh);
}

} // namespace mergel::apps::test
