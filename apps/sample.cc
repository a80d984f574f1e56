/// mergel sample: make a specimen and write it to a file that later runs read.
#include "apps/coupled_rock.h"
#include "apps/jobs.h"
#include "apps/output_folder.h"
#include "apps/pile_case.h"
#include "apps/ranks.h"
#include "apps/restart.h"
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
  read_case(file, options, std::nullopt);
  complete(file, c);
  if (!c.rock.sample.empty())
    file.refuse("Specimen", "file",
                "mergel sample makes the specimen: leave the key empty");
  const OutputFolder folder = folder_to_begin_in(options);
  const auto inputs = options.restart.empty()
                          ? std::vector<std::filesystem::path>{options.case_file}
                          : std::vector<std::filesystem::path>{};
  on_first_rank([&] { folder.check(inputs); });

  make_far_field(c.rock); // sets the faces around the side
  const dem::Sample sample = obtain_sample(file, c.rock);
  std::cout << report(c.rock, sample) << '\n';

  const auto path = folder.path() / "sample.h5";
  on_first_rank([&] {
    folder.commit(inputs);
    file.write_resolved(folder.path() / "resolved.prm");
    dem::write_sample(path, sample);
  });
  std::cout << "specimen: " << path.string()
            << "\nuse it with --set \"Specimen/file=" << path.string() << "\"\n";
  return 0;
}

} // namespace mergel::apps
