#include "apps/pile/pile_case.h"
#include "tests/support/catch.h"
#include "tests/support/polyhedra.h"
#include "tests/support/shipped_case.h"
#include "tests/support/temporary_folder.h"

#include <fstream>

using namespace mergel;
using namespace mergel::apps;
using dem::ClosedSurface;
using mergel::match::Contains;

namespace {

/// pile_small with a pile from a file in a folder of its own.
class Project {
public:
  explicit Project(const std::string& stl) { write(stl); }

  void write(const std::string& stl) const { std::ofstream(path()) << stl; }
  std::filesystem::path path() const { return folder_.path / "pile.stl"; }

  std::string text() const
  {
    std::string text = test::without("pile_small.prm", {"cone angle"});
    const std::string of_shaft = "set diameter         = 1.4 mm";
    return text.replace(text.find(of_shaft), of_shaft.size(),
                        "set tip = surface\n  set surface = " + path().string());
  }

  PileCase read(const std::vector<std::string>& set = {}) const
  {
    CaseFile file;
    return read(file, text(), set);
  }
  /// As a new case, not one that is continued.
  PileCase read(CaseFile& file, const std::string& text,
                const std::vector<std::string>& set = {}) const
  {
    PileCase c;
    declare(file, c);
    file.read(folder_.path / "case.prm", text, set);
    complete(file, c);
    return c;
  }

  std::string refusal(const std::vector<std::string>& set = {}) const
  {
    try {
      read(set);
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  }

private:
  TemporaryFolder folder_;
};

/// Round, 1.4 mm, a cone of 60 degrees; 32 chords.
ClosedSurface round_pile(double length = 9.0)
{
  return dem::test::cone_ended_surface(0.7, 1.2, length, 32);
}

ClosedSurface moved(ClosedSurface s, const dem::Vec3& by)
{
  for (dem::Vec3& x : s.x) x += by;
  return s;
}

} // namespace

TEST_CASE(
    "a pile from a file has the diameter of its largest section and the height of its tip",
    "[unit][apps]")
{
  const Project project(dem::test::ascii_stl(moved(round_pile(), {0, 0, -3.5})));
  const PileCase c = project.read();
  const double area = 16.0 * std::sin(2.0 * dem::pi / 32) * 0.49e-6;
  CHECK(c.diameter == Approx(2.0 * std::sqrt(area / dem::pi)).epsilon(1e-7));
  CHECK(c.tip_height() == Approx(1.2e-3).epsilon(1e-7));
  CHECK(c.travel() == Approx(c.final_depth + 1.2e-3).epsilon(1e-7));
  CHECK(c.record_every == Approx(0.01e-3)); // that of the case
  CHECK(c.surface.polyhedron->length == Approx(9e-3).epsilon(1e-7));

  CHECK(project.read({"Pile/tip height=2 mm"}).tip_height() == 2e-3);
  project.write(dem::test::binary_stl(moved(round_pile(), {0, 0, -3.5})));
  CHECK(project.read().diameter == Approx(c.diameter).epsilon(1e-6));
  ClosedSurface in_metres = round_pile();
  for (dem::Vec3& x : in_metres.x) x *= 1e-3;
  project.write(dem::test::ascii_stl(in_metres));
  CHECK(project.read({"Pile/surface unit=m"}).diameter == Approx(c.diameter).epsilon(1e-6));
}

TEST_CASE("a resolved case holds the surface: it needs no file, and refuses a changed one",
          "[unit][apps]")
{
  const Project project(dem::test::ascii_stl(round_pile()));
  CaseFile file;
  const PileCase c = project.read(file, project.text());
  const std::string resolved = file.resolved_text();
  std::filesystem::remove(project.path());
  CaseFile again;
  const PileCase repeated = project.read(again, resolved);
  CHECK(again.resolved_text() == resolved);
  CHECK(repeated.surface.polyhedron->surface.x == c.surface.polyhedron->surface.x);
  CHECK(repeated.diameter == c.diameter);
  CHECK(repeated.tip_height() == c.tip_height());

  project.write(dem::test::ascii_stl(round_pile(8.0)));
  CaseFile changed;
  CHECK_THROWS_WITH(project.read(changed, resolved),
                    Contains("Pile/surface sum = ") && Contains("it was changed after"));
  // Of a run that is continued the content counts, whatever became of the file.
  CaseFile continued;
  PileCase later;
  declare(continued, later);
  continued.read_text(resolved, "checkpoint");
  complete(continued, later);
  CHECK(later.surface.polyhedron->length == c.surface.polyhedron->length);

  std::string damaged = resolved;
  damaged.replace(damaged.find("set surface content"), 30,
                  "set surface content = 1 2 3 4;");
  std::filesystem::remove(project.path());
  CaseFile refused;
  CHECK_THROWS_WITH(project.read(refused, damaged),
                    Contains("Pile/surface content: is no surface"));
}

TEST_CASE("text of a surface gives the same surface", "[unit][apps]")
{
  // Points are numbered as the triangles name them first: from then on the text is the same.
  const ClosedSurface s = surface_from(text_of(round_pile()));
  CHECK(s.x.size() == round_pile().x.size());
  CHECK(s.triangles.size() == round_pile().triangles.size());
  CHECK(text_of(surface_from(text_of(s))) == text_of(s));
  for (const char* text :
       {"", "0 0 0", "0 0 0; 0 1 2", "a b c; 0 0 0", "0 0; 0 0 0", "0 0 0; -1 0 0",
        "0 0 0, 1 0 0, 0 1 0; 0 1", "0 0 0, 1 0 0, 2 0 0; 0 1 2"})
    CHECK_THROWS_AS(surface_from(text), InputError);
}

TEST_CASE("a surface that cannot be a pile is refused with what is wrong and a remedy",
          "[unit][apps]")
{
  using dem::test::ascii_stl;
  const Project project(ascii_stl(round_pile()));
  CHECK(project.refusal() == "accepted");
  CHECK_THAT(project.refusal({"Pile/surface unit=cm"}),
             Contains("Pile/surface = ") && Contains("wider than the DEM region") &&
                 Contains("is `surface unit` right?"));
  CHECK_THAT(project.refusal({"Pile/surface unit=s"}), Contains("Pile/surface unit = s"));
  CHECK_THAT(project.refusal({"Pile/diameter=1.4 mm"}),
             Contains("Pile/diameter = 1.4 mm: is a key of `tip` = "));
  CHECK_THAT(project.refusal({"Pile/tip height=10 mm"}),
             Contains("--set Pile/tip height = 10 mm: the pile is 9 mm long"));
  CHECK_THAT(project.refusal({"Pile/final depth=8 mm"}),
             Contains("Pile/surface = ") &&
                 Contains("it would be covered. Make it longer"));
  CHECK_THAT(project.refusal({"Pile/surface=none.stl"}),
             Contains("cannot be read: No such file"));

  const auto refused = [&](const ClosedSurface& s) {
    project.write(ascii_stl(s));
    return project.refusal();
  };
  ClosedSurface inside_out = round_pile(), open = round_pile();
  for (dem::Triangle& t : inside_out.triangles) std::swap(t[0], t[1]);
  open.triangles.pop_back();
  CHECK_THAT(refused(inside_out), Contains("Pile/surface = ") && Contains("is inside out"));
  CHECK_THAT(refused(open), Contains("the surface is open"));
  CHECK_THAT(refused(moved(round_pile(), {0.3, 0, 0})), Contains("is off its axis"));
  CHECK_THAT(refused(moved(round_pile(), {0, 0.05, 0})),
             Contains("is not symmetric about the plane y = 0") &&
                 Contains("make the full model, `Specimen/shape = cylinder`"));
  CHECK_THAT(refused(dem::test::cone_ended_surface(0.7, 1.2, 9.0, 4000)),
             Contains("has 16000 triangles, at most 15000 are allowed"));
  project.write("PK");
  CHECK_THAT(project.refusal(), Contains("is no STL file"));
}
