/// mergel sample: make a specimen and write it to a file that later runs read.
#include "apps/coupled_rock.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/pile_case.h"
#include "apps/ranks.h"
#include "dem/io/rock_fields.h"

#include <iostream>

namespace mergel::apps {

void help_sample(std::ostream& out)
{
  help_pile(out);
}

int run_sample(const JobOptions& options)
{
  // The same case as the run that will use the specimen: it is made inside that run's
  // walls.
  CaseFile file;
  PileCase c;
  declare(file, c);
  file.read(options.case_file, options.set);
  complete(file, c);
  if (!c.rock.sample.empty())
    file.refuse("Specimen", "file",
                "mergel sample makes the specimen: leave the key empty");
  const OutputFolder folder(options.output,
                            options.overwrite ? Earlier::overwrite : Earlier::keep);
  on_first_rank([&] { folder.check({options.case_file}); });

  make_far_field(c.rock); // sets the faces around the side
  const dem::Sample sample = obtain_sample(file, c.rock);
  std::cout << report(c.rock, sample) << '\n';

  const auto path = folder.path() / "sample.h5";
  on_first_rank([&] {
    folder.commit({options.case_file});
    file.write_resolved(folder.path() / "resolved.prm");
    dem::write_sample(path, sample);
  });
  std::cout << "specimen: " << path.string()
            << "\nuse it with --set \"Specimen/file=" << path.string() << "\"\n";
  return 0;
}

} // namespace mergel::apps
