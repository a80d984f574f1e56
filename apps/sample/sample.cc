/// mergel sample: makes a specimen and writes it to a file that later runs read.
#include "apps/brazilian/brazilian_plan.h"
#include "apps/case/job_of_case.h"
#include "apps/case/words.h"
#include "apps/coupled/system_of_case.h"
#include "apps/element/element_plan.h"
#include "apps/pile/pile_plan.h"
#include "apps/run/frames.h"
#include "apps/run/jobs.h"
#include "apps/run/output_folder.h"
#include "apps/run/ranks.h"
#include "apps/run/restart.h"
#include "apps/run/results.h"
#include "apps/specimen/specimen.h"
#include "apps/triaxial/triaxial_plan.h"
#include "dem/continuum/particle_stress.h"
#include "dem/io/assembly_frame.h"
#include "dem/io/atomic_file.h"
#include "dem/specimen/forecast.h"

#include <iostream>

namespace mergel::apps {

namespace {

/// A case with a specimen only.
struct SampleCase {
  SpecimenKeys specimen;
  ContactKeys contact;
};

void declare(CaseFile& file, SampleCase& c)
{
  c.specimen.shape = SpecimenKeys::Shape::periodic_box;
  c.specimen.upscaling = SpecimenKeys::Upscaling::uniform;
  declare(file, c.specimen);
  declare(file, c.contact);
  const auto section = file.section("Motion");
  file.flag("free rotation", c.specimen.specimen.free_rotation,
            "Let particles without an intact bond rotate; in the paper they do not.");
}

void complete(CaseFile& file, SampleCase& c)
{
  complete(file, c.specimen, c.contact.chosen());
}

SpecimenKeys& keys_of(SampleCase& c)
{
  return c.specimen;
}
SpecimenKeys& keys_of(ElementCase& c)
{
  return c.specimen;
}
SpecimenKeys& keys_of(TriaxialCase& c)
{
  return c.specimen;
}
SpecimenKeys& keys_of(BrazilianCase& c)
{
  return c.specimen;
}
SpecimenKeys& keys_of(PileCase& c)
{
  return c.assembly;
}

/// Finish what only the walls of the run determine.
void fit_to_walls(SampleCase&) {}
void fit_to_walls(ElementCase&) {}
void fit_to_walls(TriaxialCase&) {}
void fit_to_walls(BrazilianCase&) {}
void fit_to_walls(PileCase& c)
{
  make_far_field(c.assembly, MPI_COMM_WORLD); // sets the faces around the side
}

/// Reads the case file, whose text then belongs to the options.
CaseJob job_of(JobOptions& options)
{
  const std::filesystem::path file =
      options.case_file.empty() ? folder_to_restart(options.restart) / "resolved.prm"
                                : options.case_file;
  const std::string text = read_case_text(file);
  if (!options.case_file.empty()) options.case_text = text;
  return job_of_case(scan_case(text, file.string()), options.set);
}

/// Particles, bonds and contacts as an assembly at rest, for the writers of fields.
dem::Assembly as_assembly(const SpecimenKeys& k, const dem::Sample& sample)
{
  dem::Assembly assembly;
  assembly.particles = sample.packing.particles;
  assembly.cell = sample.packing.cell;
  assembly.material.contact = k.specimen.contact;
  assembly.bonds = dem::make_bonds(assembly.particles, assembly.cell, sample.bonding.pairs);
  dem::VerletList(dem::activation_gap(k.specimen.contact), 0.0)
      .rebuild(assembly.particles, assembly.cell, assembly.bonds, assembly.contacts);
  return assembly;
}

/// @param porosity of the core [-]
void write_pictures(const std::filesystem::path& folder, const dem::Assembly& assembly,
                    double porosity)
{
  Frames frames(folder, {{"particles", "vtp"}, {"bonds", "vtp"}, {"contacts", "vtp"}});
  const dem::Particles& p = assembly.particles;
  std::vector<dem::Vec3> x;
  for (const dem::ParticleState& b : p.state) x.push_back(b.x);
  const auto branches = dem::loaded_branches(assembly);
  const auto around = assembly.cell.is_periodic()
                          ? dem::even_porosity(p, assembly.cell.volume())
                          : std::vector<double>(p.size(), porosity);
  dem::FrameFiles({assembly, x, branches, around, {}})
      .write({frames.file(0), frames.file(1), frames.file(2)});
  frames.add(0.0);
}

void refuse_sample(const CaseFile& file, const SpecimenKeys& k)
{
  if (!k.sample.empty())
    file.refuse("Specimen", "file",
                "mergel sample makes the specimen: leave the key empty");
}

Remarks unusual(const SampleCase& c)
{
  Remarks remarks;
  remark_on_specimen(remarks, c.specimen);
  return remarks;
}

/// Read the case, make the specimen, print its report and write its files.
template <class Case>
void make(const JobOptions& options)
{
  CaseFile file;
  Case c;
  declare(file, c);
  SpecimenKeys& k = keys_of(c);
  on_every_rank([&] {
    read_case(file, options, std::nullopt);
    refuse_sample(file, k);
    complete(file, c);
  });
  require_same_case(file);
  const auto inputs = inputs_of(options, std::nullopt, {k.table});
  OutputFolder folder = folder_of(options, std::nullopt, inputs, {});
  fit_to_walls(c);

  std::cout << lines_of(unusual(c));
  const dem::Sample sample = obtain_sample(file, k);
  std::cout << report(k, sample) << '\n';
  const auto path = folder.path() / "sample.h5";
  on_first_rank([&] {
    const Provenance made = provenance(options);
    begin_folder(folder, inputs, file, made);
    dem::write_sample(path, sample);
    write_pictures(folder.path(), as_assembly(k, sample), sample.packing.porosity);
    Summary found = summary(k, sample);
    found.json("made by", made.json());
    dem::replace_file(folder.path() / "summary.json", found.object());
    require_results(folder.path(), "sample");
  });
  std::cout << "specimen: " << printable(path.string()) << "\nuse it with --set "
            << in_shell("Specimen/file=" + path.string()) << "\n";
}

} // namespace

void help_sample(std::ostream& out)
{
  out << "A case of mergel pile, element, triaxial or brazilian serves here as it is: the "
         "specimen "
         "of\nthat job is made, that of a pile inside the walls of its run. A section Pile "
         "or "
         "Far field, or\n`shape = half cylinder`, tells a case of pile; a section Plates, "
         "or "
         "`Loading/velocity`, one of\nbrazilian; a section Membrane or Platens one of "
         "triaxial; "
         "a section Loading one of triaxial for\na cylinder, one of element for a periodic "
         "box. "
         "Each job lists its keys by --help. The keys below\nare those of all other "
         "cases.\n\n";
}

void keys_of_sample(const UseKeys& use)
{
  CaseFile file;
  SampleCase c;
  declare(file, c);
  use(file);
}

Plan plan_sample(const JobOptions& options)
{
  CaseFile file;
  SampleCase c;
  declare(file, c);
  read_case(file, options, std::nullopt);
  complete(file, c);
  Plan plan;
  plan.n_particles = dem::expected_particles(c.specimen.specimen);
  plan.particles_by = "solid volume over the mean volume of a particle";
  plan.bonds_per_particle = 0.5 * c.specimen.specimen.coordination;
  plan.is_made = true;
  plan.unusual = unusual(c);
  return plan;
}

int run_sample(const JobOptions& given)
{
  JobOptions options = given;
  CaseJob job = CaseJob::sample;
  on_every_rank([&] { job = job_of(options); });
  MPI_Bcast(&job, sizeof job, MPI_BYTE, 0,
            MPI_COMM_WORLD); // require_same_case() compares the cases
  switch (job) {
  case CaseJob::sample:
  case CaseJob::bond: // which read_case() refuses
    make<SampleCase>(options);
    break;
  case CaseJob::pile:
    make<PileCase>(options);
    break;
  case CaseJob::element:
    make<ElementCase>(options);
    break;
  case CaseJob::triaxial:
    make<TriaxialCase>(options);
    break;
  case CaseJob::brazilian:
    make<BrazilianCase>(options);
    break;
  }
  return 0;
}

} // namespace mergel::apps
