/// Keys that have no effect in the chosen mode, of every job: each is refused by its place,
/// with the choice that makes it void, before anything is written.
#include "apps/run/jobs.h"
#include "dem/error.h"
#include "tests/support/catch.h"
#include "tests/support/shipped_case.h"
#include "tests/support/temporary_folder.h"

#include <fstream>
#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;
using mergel::match::StartsWith;
using mergel::test::without;
namespace fs = std::filesystem;

namespace {

using Names = std::vector<std::string>;

/// A choice of a case, and what is void with it.
struct Mode {
  RunCase run;
  const char* of; ///< the case it starts from
  Names left_out; ///< keys of that case that the mode makes void
  Names settings; ///< the mode, "Section/key=value"
  const char *choice, *is;
  Names void_keys; ///< "Section/key=value"
};

const Names damage_only{"compressive strength", "softening displacement",
                        "softening rotation", "bending flow", "damage at breakage"};
const Names damage_keys{
    "Bond/compressive strength=1 MPa", "Bond/softening displacement=1 mm",
    "Bond/softening rotation=1 rad",   "Bond/bending flow=conjugate",
    "Bond/damage at breakage=0.9",     "Bond/twist=elastic"};
const Names variability{"Strength variability/coefficient of variation=0.3",
                        "Strength variability/seed=2"};
const Names of_other_sizes{"Specimen/exponent=0.4",     "Specimen/median diameter=0.1 mm",
                           "Specimen/spread=0.3",       "Specimen/size table=sizes.csv",
                           "Specimen/size table sum=1", "Specimen/size table points=0.1 0"};
const Names of_axis{"Specimen/inner upscaling=2", "Specimen/outer upscaling=3",
                    "Specimen/inner radius=1 mm", "Specimen/outer radius=2 mm"};

const std::vector<Mode> modes{
    // pile
    {run_pile,
     "pile_small.prm",
     {"Young's modulus", "Poisson ratio", "K0"},
     {"Far field/model=rigid"},
     "model",
     "rigid",
     {"Far field/Young's modulus=1 GPa", "Far field/Poisson ratio=0.2", "Far field/K0=0.3",
      "Far field/outer boundary=fixed", "Far field/elasticity from=results"}},
    {run_pile,
     "pile_small.prm",
     {},
     {},
     "outer boundary",
     "roller",
     {"Far field/side pressure=1 MPa"}},
    {run_pile,
     "pile_small.prm",
     damage_only,
     {"Bond/bond law=parallel"},
     "bond law",
     "parallel",
     damage_keys},
    {run_pile,
     "pile_small.prm",
     {"cone angle"},
     {"Pile/tip=flat"},
     "tip",
     "flat",
     {"Pile/cone angle=60 degree"}},
    {run_pile,
     "pile_small.prm",
     {},
     {},
     "contact law",
     "linear",
     {"Contact/Young's modulus=1 GPa", "Contact/Poisson ratio=0.2"}},
    {run_pile,
     "pile_small.prm",
     {"effective modulus", "stiffness ratio", "activation gap"},
     {"Contact/contact law=hertz", "Contact/Young's modulus=1 GPa",
      "Contact/Poisson ratio=0.2", "Bond/effective modulus=22.5 GPa",
      "Bond/stiffness ratio=2.4"},
     "contact law",
     "hertz",
     {"Contact/effective modulus=1 GPa", "Contact/stiffness ratio=2",
      "Contact/activation gap=0.01 mm"}},
    {run_pile, "pile_small.prm", {}, {}, "distribution", "none", variability},
    {run_pile, "pile_small.prm", {}, {}, "sizes", "uniform in number", of_other_sizes},
    {run_pile,
     "pile_small.prm",
     {"inner upscaling", "outer upscaling", "inner radius", "outer radius"},
     {"Specimen/upscaling=uniform", "Specimen/upscaling ratio=4"},
     "upscaling",
     "uniform",
     of_axis},
    {run_pile,
     "pile_small.prm",
     {},
     {},
     "upscaling",
     "graded",
     {"Specimen/upscaling ratio=4"}},
    {run_pile,
     "pile_small.prm",
     {},
     {},
     "packing",
     "unjammed",
     {"Specimen/target pressure=5 kPa", "Specimen/generation friction=0.1"}},
    {run_pile,
     "pile_small.prm",
     {},
     {},
     "shape",
     "half cylinder",
     {"Specimen/edge x=5 mm", "Specimen/edge y=5 mm", "Specimen/edge z=5 mm"}},
    // element
    {run_element,
     "element_small.prm",
     {},
     {},
     "size effect",
     "false",
     {"Size effect/specimen width=1 mm", "Size effect/reference width=50 mm",
      "Size effect/psi=1.1"}},
    {run_element,
     "element_small.prm",
     {},
     {},
     "pictures",
     "stages",
     {"Output/picture every=0.1"}},
    {run_element,
     "element_small.prm",
     {},
     {"Output/pictures=none"},
     "pictures",
     "none",
     {"Output/picture every=0.1"}},
    {run_element,
     "element_small.prm",
     damage_only,
     {"Bond/bond law=parallel"},
     "bond law",
     "parallel",
     damage_keys},
    {run_element, "element_small.prm", {}, {}, "distribution", "none", variability},
    {run_element,
     "element_small.prm",
     {},
     {},
     "shape",
     "periodic box",
     {"Specimen/diameter=5 mm", "Specimen/height=5 mm", "Specimen/symmetry=wall",
      "Specimen/faces around the side=12"}},
    {run_element, "element_small.prm", {}, {}, "upscaling", "uniform", of_axis},
    // sample
    {run_sample, "sample_dense.prm", {}, {}, "distribution", "none", variability},
    {run_sample, "sample_dense.prm", {}, {}, "sizes", "uniform in number", of_other_sizes},
    {run_sample,
     "sample_dense.prm",
     {},
     {},
     "packing",
     "expanded",
     {"Specimen/target pressure=5 kPa"}},
    {run_sample,
     "sample_dense.prm",
     {"generation friction"},
     {"Specimen/packing=confined", "Specimen/target pressure=5 kPa"},
     "packing",
     "confined",
     {"Specimen/generation friction=0.1"}},
    {run_sample,
     "sample_dense.prm",
     {"smallest diameter", "largest diameter"},
     {"Specimen/sizes=table", "Specimen/size table=sizes.csv"},
     "sizes",
     "table",
     {"Specimen/smallest diameter=1 mm", "Specimen/largest diameter=2 mm",
      "Specimen/exponent=0.4"}},
    // bond
    {run_bond,
     "bond_fig5a.prm",
     {},
     {},
     "mode",
     "path",
     {"Loading/normal displacement=1 mm", "Loading/shear displacement=1 mm",
      "Loading/rotation=1 rad"}},
    {run_bond,
     "bond_fig5a.prm",
     {"path"},
     {"Loading/mode=tension", "Loading/normal displacement=1 mm"},
     "mode",
     "tension",
     {"Loading/path=bond_fig5a.csv", "Loading/shear displacement=1 mm",
      "Loading/rotation=1 rad"}},
    {run_bond,
     "bond_fig5a.prm",
     {"path"},
     {"Loading/mode=shear-bending", "Loading/shear displacement=1 mm",
      "Loading/rotation=1 rad"},
     "mode",
     "shear-bending",
     {"Loading/path=bond_fig5a.csv", "Loading/normal displacement=1 mm"}},
    {run_bond,
     "bond_fig5a.prm",
     damage_only,
     {"Bond/bond law=parallel"},
     "bond law",
     "parallel",
     damage_keys},
};

/// Message of the job on this case. The folder for its results cannot be made: a case that
/// is accepted starts no run.
std::string refusal(RunCase run, const fs::path& case_file, const Names& settings)
{
  JobOptions options;
  options.case_file = case_file;
  options.set = settings;
  options.output = case_file / "results";
  try {
    run(options);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

} // namespace

TEST_CASE("Each key that has no effect in its mode is refused, in every job",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "case.prm";
  std::ofstream(folder.path / "bond_fig5a.csv")
      << "u_n [m],u_s [m],theta [rad]\n1e-5,0,0\n";
  std::ofstream(folder.path / "sizes.csv") << "diameter [mm],passing [%]\n0.1,0\n0.2,100\n";
  for (const Mode& mode : modes) {
    std::ofstream(file) << without(mode.of, mode.left_out);
    Names with_files = mode.settings;
    for (std::string& s : with_files)
      if (s == "Specimen/size table=sizes.csv")
        s = "Specimen/size table=" + (folder.path / "sizes.csv").string();
    INFO(mode.of << ", " << mode.choice << " = " << mode.is);
    // Without a void key the case is good: what is refused is the folder.
    CHECK_THAT(refusal(mode.run, file, with_files), StartsWith("output folder "));
    for (const std::string& key : mode.void_keys) {
      Names settings = with_files;
      settings.push_back(key);
      const auto equals = key.find('=');
      const std::string message = refusal(mode.run, file, settings);
      CHECK_THAT(message, StartsWith("--set " + key.substr(0, equals) + " = " +
                                     key.substr(equals + 1) + ": is a key of `" +
                                     mode.choice + "` = "));
      CHECK_THAT(message,
                 Contains("; here it is " + std::string(mode.is) +
                          ". Leave the key out, or change `" + mode.choice + "`."));
    }
  }
}

TEST_CASE("A void key in the file is refused by its line", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "case.prm";
  std::ofstream(file) << "subsection Far field\n set K0 = 0.3\nend\n"
                      << without("pile_small.prm",
                                 {"Young's modulus", "Poisson ratio", "K0"});
  CHECK(refusal(run_pile, file, {"Far field/model=rigid"}) ==
        file.string() + ":2: Far field/K0 = 0.3: is a key of `model` = elastic; here it is "
                        "rigid. Leave the key out, or change `model`.");
}
