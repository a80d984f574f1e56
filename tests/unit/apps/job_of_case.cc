#include "apps/case/job_of_case.h"

#include "tests/support/catch.h"
#include "tests/support/repository.h"

using namespace mergel;
using namespace mergel::apps;

namespace {

CaseJob job(const std::string& text, const std::vector<std::string>& set = {})
{
  return job_of_case(scan_case(text, "case"), set);
}

CaseJob job_of_file(const char* name)
{
  const auto file = test::repository() / "apps/cases" / name;
  return job_of_case(scan_case(read_case_text(file), name), {});
}

} // namespace

TEST_CASE("The job of every case that ships is known", "[unit][apps]")
{
  CHECK(job_of_file("sample_rock.prm") == CaseJob::sample);
  CHECK(job_of_file("sample_dense.prm") == CaseJob::sample);
  CHECK(job_of_file("pile_small.prm") == CaseJob::pile);
  CHECK(job_of_file("pile_paper.prm") == CaseJob::pile);
  for (const char* name : {"element_small.prm", "element_rock.prm", "element_loose.prm",
                           "element_dense.prm", "element_scale.prm"})
    CHECK(job_of_file(name) == CaseJob::element);
  CHECK(job_of_file("triaxial_small.prm") == CaseJob::triaxial);
  CHECK(job_of_file("ucs.prm") == CaseJob::triaxial);
  CHECK(job_of_file("brazilian.prm") == CaseJob::brazilian);
  CHECK(job_of_file("brazilian_small.prm") == CaseJob::brazilian);
  CHECK(job_of_file("bond_fig5a.prm") == CaseJob::bond);
}

TEST_CASE("The job of a case follows from sections, shape and keys", "[unit][apps]")
{
  const std::string loading = "subsection Loading\nend\n";
  const auto specimen = [](const std::string& key) {
    return "subsection Specimen\n set " + key + "\nend\n";
  };
  CHECK(job(specimen("shape = cylinder")) == CaseJob::sample);
  CHECK(job(specimen("shape = half cylinder")) == CaseJob::pile);
  CHECK(job(specimen("shape = cylinder") + loading) == CaseJob::triaxial);
  CHECK(job(specimen("shape = periodic box") + loading) == CaseJob::element);
  CHECK(job(specimen("diameter = 5 mm") + loading) == CaseJob::triaxial);
  CHECK(job(specimen("edge x = 5 mm") + loading) == CaseJob::element);
  CHECK(job(specimen("edge x = 5 mm") + "subsection Platens\nend\n") == CaseJob::triaxial);
  CHECK(job(specimen("edge x = 5 mm"), {"Specimen/shape=half cylinder"}) == CaseJob::pile);
  CHECK(job(specimen("edge x = 5 mm") + loading, {"Platens/friction=0.3"}) ==
        CaseJob::triaxial);
  CHECK(job(specimen("diameter = 5 mm") + "subsection Plates\nend\n") ==
        CaseJob::brazilian);
  CHECK(job(specimen("diameter = 5 mm") + loading, {"Loading/velocity=1 mm/s"}) ==
        CaseJob::brazilian);
  // A section written wrongly does not make a case one of another job.
  CHECK(job(specimen("diameter = 5 mm") + "subsection Far field\nend\n" + loading) ==
        CaseJob::pile);
  CHECK(job(loading) == CaseJob::sample);
  CHECK(job("subsection Pile\nend\n", {"Specimen/shape=cylinder"}) == CaseJob::pile);
}
