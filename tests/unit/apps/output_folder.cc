#include "apps/run/output_folder.h"

#include "apps/case/case_file.h"
#include "apps/run/restart.h"
#include "dem/error.h"
#include "dem/io/atomic_file.h"
#include "dem/io/picture_of_view.h"
#include "tests/support/catch.h"
#include "tests/support/temporary_folder.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

namespace {

namespace fs = std::filesystem;

void create_file(const fs::path& file)
{
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

/// A picture as mergel-view begins it.
void create_picture(const fs::path& file)
{
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary)
      << "\x89PNG\r\n\x1a\n"
      << std::string("Software\0", 9) << dem::software_of_pictures;
}

/// What marks the folder of a run.
void create_case(const fs::path& folder)
{
  fs::create_directories(folder);
  std::ofstream(folder / "resolved.prm") << CaseFile::first_words_of_resolved << " More.\n";
}

/// Everything below a folder, sorted.
std::vector<std::string> tree(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    names.push_back(entry.path().lexically_relative(folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

/// Message of check(); commit() must give the same one.
std::string refusal(const fs::path& folder, Earlier earlier,
                    const std::vector<fs::path>& inputs = {})
{
  const auto message = [](auto&& call) -> std::string {
    try {
      call();
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  OutputFolder output(folder, earlier);
  const std::string by_check = message([&] { output.check(inputs); });
  if (by_check != "accepted") CHECK(message([&] { output.commit(inputs); }) == by_check);
  return by_check;
}

const std::vector<std::string> own = {".history.partial.csv",
                                      "compare.png",
                                      "brazilian.png",
                                      "breaks.pvd",
                                      "curve.png",
                                      "damage.png",
                                      "disc.png",
                                      "displacement.png",
                                      "element.png",
                                      "contacts.pvd",
                                      "fields.pvd",
                                      "fields/bonds_0000.vtp",
                                      "fields/contacts_0000.vtp",
                                      "fields/fields_0001.vti",
                                      "stress.png",
                                      "shaft_profile.csv",
                                      "stress_path.csv",
                                      "paths.png",
                                      "fields/breaks_0000.vtp",
                                      "fields/membrane_0000.vtp",
                                      "fields/platens_0001.vtp",
                                      "fields/plates_0001.vtp",
                                      "history.csv",
                                      "isotropic.png",
                                      "load.png",
                                      "localisation.csv",
                                      "localisation.png",
                                      "membrane.pvd",
                                      "particles.pvd",
                                      "platens.pvd",
                                      "resolved.prm",
                                      "sample.h5",
                                      "specimen.png",
                                      "summary.json",
                                      "triaxial.png"};

} // namespace

TEST_CASE("check() changes nothing and commit() makes the folder", "[unit][apps]")
{
  const TemporaryFolder folder;
  OutputFolder output(folder.path / "results" / "pile", Earlier::keep);
  output.check();
  CHECK(tree(folder.path).empty());
  output.commit();
  CHECK(tree(folder.path) ==
        std::vector<std::string>{"results", "results/pile", "results/pile/.mergel.lock"});
  output.commit(); // an empty folder is used as a new one is
  CHECK(output.path() == folder.path / "results" / "pile");
}

TEST_CASE("A folder with other files only is used as it is", "[unit][apps]")
{
  const TemporaryFolder folder;
  create_file(folder.path / "notes.txt");
  create_file(folder.path / "history.csv.bak");
  create_file(folder.path / "photo.png");
  fs::create_directory(folder.path / "history.csv"); // a folder, not a file of mergel
  const auto before = tree(folder.path);
  for (const Earlier earlier : {Earlier::keep, Earlier::overwrite}) {
    OutputFolder(folder.path, earlier).commit();
    CHECK(tree(folder.path) == before);
  }
}

TEST_CASE("Each file of an earlier run is recognised and kept", "[unit][apps]")
{
  for (const std::string& name : own) {
    const TemporaryFolder folder;
    create_file(folder.path / name);
    create_case(folder.path);
    const auto before = tree(folder.path);
    CHECK(refusal(folder.path, Earlier::keep) ==
          "output folder " + folder.path.string() + ": holds an earlier run (" +
              std::min(name, std::string("resolved.prm")) +
              "). Choose another folder with --output, or replace that run with "
              "--overwrite.");
    CHECK(tree(folder.path) == before);
  }
}

TEST_CASE("--overwrite removes what mergel wrote and nothing else", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path results = folder.path / "results";
  const std::vector<std::string> others = {
      "case.prm",           "damage.png.txt", "figure.png",
      "partial.csv",        "pile.log",       "more/history.csv",
      ".notes.partial.txt", "my_view.pvd",    "fields/notes.txt"};
  for (const auto& names : {own, others})
    for (const std::string& name : names)
      if (name.ends_with(".png"))
        create_picture(results / name);
      else
        create_file(results / name);
  create_case(results);
  create_file(folder.path / "precious" / "data");
  fs::create_symlink(folder.path / "precious", results / "link");
  const auto before = tree(folder.path);

  OutputFolder output(results, Earlier::overwrite);
  output.check();
  CHECK(tree(folder.path) == before);

  output.commit();
  std::vector<std::string> expected = others;
  expected.insert(expected.end(), {".mergel.lock", "fields", "link", "more"});
  std::sort(expected.begin(), expected.end());
  CHECK(tree(results) == expected);
  CHECK(fs::exists(folder.path / "precious" / "data"));
}

TEST_CASE("Files of a user that have the names of mergel's are neither removed nor offered "
          "to --overwrite",
          "[unit][apps]")
{
  const std::vector<std::string> names{"history.csv",
                                       "resolved.prm",
                                       "summary.json",
                                       "triaxial.png",
                                       "sample.h5",
                                       "load.png",
                                       "checkpoint_000000000300.h5",
                                       "fields/bonds_0000.vtp"};
  for (const std::string& name : names)
    for (const Earlier earlier : {Earlier::keep, Earlier::overwrite}) {
      const TemporaryFolder folder;
      create_file(folder.path / name);
      const auto before = tree(folder.path);
      CHECK(refusal(folder.path, earlier) ==
            "output folder " + folder.path.string() + ": holds " + name +
                ", and no run of mergel that has written it. Move it away, or choose "
                "another folder with --output.");
      CHECK(tree(folder.path) == before);
    }
  // also where --restart has locked the folder already
  const TemporaryFolder folder;
  create_file(folder.path / "history.csv");
  OutputFolder output(folder.path, Earlier::begun);
  output.hold(FolderLock(folder.path, 0.0));
  CHECK_THROWS_WITH(output.commit(), Contains("no run of mergel that has written it"));
}

TEST_CASE("A run is known by its case, its checkpoints, what it could not rename, and the "
          "lock that it left when it was killed",
          "[unit][apps]")
{
  const std::string begun = "mergel checkpoint, and more";
  const std::string of_earlier_version = "\x89HDF\r\n\x1a\n and more";
  const std::vector<std::pair<std::string, std::string>> marks{
      {"resolved.prm", std::string(CaseFile::first_words_of_resolved) + " And more."},
      {"checkpoint_000000000300.h5", begun},
      {"checkpoint_000000000300.h5", of_earlier_version},
      {"checkpoint_000000000300.h5.aside-2", begun},
      {".history.partial.csv", "x"},
      {".mergel.lock", "process 7"}};
  for (const auto& [mark, text] : marks) {
    const TemporaryFolder folder;
    std::ofstream(folder.path / mark, std::ios::binary) << text;
    create_file(folder.path / "history.csv");
    CHECK_THAT(refusal(folder.path, Earlier::keep), Contains("holds an earlier run ("));
    OutputFolder(folder.path, Earlier::overwrite).commit();
    CHECK(tree(folder.path).empty());
  }
}

TEST_CASE("--overwrite refuses a picture that mergel-view has not made, beside a run too",
          "[unit][apps]")
{
  const std::string signature = "\x89PNG\r\n\x1a\n";
  for (const std::string& text : {std::string("mine, of mergel-view"), signature,
                                  signature + "Software another program", std::string()}) {
    const TemporaryFolder folder;
    create_case(folder.path);
    create_picture(folder.path / "curve.png");
    std::ofstream(folder.path / "element.png", std::ios::binary) << text;
    const auto before = tree(folder.path);
    CHECK(refusal(folder.path, Earlier::overwrite) ==
          "output folder " + folder.path.string() +
              ": holds element.png, which this version of mergel-view has not made. Move "
              "it away, or choose another folder with --output.");
    CHECK(tree(folder.path) == before);
    create_picture(folder.path / "element.png");
    OutputFolder(folder.path, Earlier::overwrite).commit();
    CHECK(tree(folder.path).empty());
  }
}

TEST_CASE("A lock file that names no process makes a folder none of mergel", "[unit][apps]")
{
  for (const char* text : {"", "mine"}) {
    const TemporaryFolder folder;
    std::ofstream(folder.path / ".mergel.lock") << text;
    create_file(folder.path / "history.csv");
    const auto before = tree(folder.path);
    CHECK_THAT(refusal(folder.path, Earlier::overwrite),
               Contains("holds history.csv, and no run of mergel that has written it"));
    CHECK(tree(folder.path) == before);
  }
}

TEST_CASE("--overwrite removes links, never what they point to", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path results = folder.path / "results";
  create_file(folder.path / "precious" / "sample.h5");
  fs::create_directory(results);
  fs::create_symlink(folder.path / "precious", results / "fields");
  fs::create_symlink(folder.path / "precious" / "sample.h5", results / "sample.h5");
  create_case(results);
  OutputFolder(results, Earlier::overwrite).commit();
  CHECK(tree(results).empty());
  CHECK(fs::exists(folder.path / "precious" / "sample.h5"));
}

TEST_CASE("--overwrite does not remove what the run is to read", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path sample = folder.path / "sample.h5",
                 field = folder.path / "fields/pile_0003.vtp";
  create_file(sample);
  create_file(field);
  create_file(folder.path / "notes.txt");
  create_case(folder.path);
  const auto before = tree(folder.path);
  for (const fs::path& input : {sample, field, folder.path / "." / "sample.h5"})
    CHECK(refusal(folder.path, Earlier::overwrite, {input}) ==
          "output folder " + folder.path.string() + ": --overwrite would remove " +
              input.string() +
              ", which this run reads. Choose another folder with --output.");
  CHECK(tree(folder.path) == before);
  CHECK(refusal(folder.path, Earlier::overwrite,
                {"", folder.path / "notes.txt", folder.path / "missing.h5"}) == "accepted");
}

TEST_CASE("A file in place of the folder is named", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "file";
  create_file(file);
  for (const fs::path& wanted : {file, file / "results", file / "results" / "pile"})
    CHECK(refusal(wanted, Earlier::overwrite) ==
          "output folder " + wanted.string() + ": \"" + file.string() +
              "\" exists and is not a folder. Choose another folder with --output.");
  fs::create_symlink(folder.path / "nowhere", folder.path / "dangling");
  CHECK_THAT(refusal(folder.path / "dangling", Earlier::keep),
             Contains("dangling\" exists and is not a folder"));
  CHECK(refusal("", Earlier::keep) == "output folder: no name is given. Use --output DIR.");
}

TEST_CASE("A folder that cannot be written is refused before it is used", "[unit][apps]")
{
  // a file system without new folders reports it only when one is made
  CHECK_THROWS_WITH(OutputFolder("/proc/mergel", Earlier::keep).commit(),
                    Contains("output folder /proc/mergel: cannot be"));
  if (geteuid() == 0) return; // root may write everywhere
  const TemporaryFolder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  CHECK_THAT(refusal(folder.path / "results", Earlier::keep),
             Contains("cannot be written: Permission denied"));
}

TEST_CASE("remove_after() removes what a run wrote after its checkpoint, and nothing else",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  for (const char* file :
       {"history.csv", "resolved.prm", "summary.json", "notes.txt", "damage.png",
        "checkpoint_000000000100.h5", "checkpoint_000000000200.h5",
        "checkpoint_000000000300.h5", ".checkpoint_000000000400.partial.h5",
        "fields/particles_99999999999999999999999.vtp", "fields/particles_0000.vtp",
        "fields/particles_0001.vtp", "fields/far_field_0001.vtu",
        "fields/.bonds_0001.partial.vtp", "fields/mine.vtp"})
    create_file(folder.path / file);
  OutputFolder out(folder.path, Earlier::go_on);
  out.check();
  out.commit();
  CHECK(tree(folder.path).size() == 17); // with fields itself and the lock
  const fs::path aside = folder.path / "checkpoint_000000000300.h5.aside";
  CHECK(out.remove_after(1, 200) == std::vector<fs::path>{aside});
  CHECK(tree(folder.path) ==
        std::vector<std::string>{
            ".mergel.lock", "checkpoint_000000000100.h5", "checkpoint_000000000200.h5",
            "checkpoint_000000000300.h5.aside", "damage.png", "fields", "fields/mine.vtp",
            "fields/particles_0000.vtp", "history.csv", "notes.txt", "resolved.prm"});
}

TEST_CASE("A checkpoint set aside does not replace those set aside before", "[unit][apps]")
{
  const TemporaryFolder folder;
  const fs::path checkpoint = folder.path / "checkpoint_000000000300.h5";
  const auto beside = [&](const char* ending) {
    return fs::path(checkpoint.string() + ending);
  };
  const auto text_of = [](const fs::path& file) {
    std::ifstream in(file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  for (const char* ending : {".aside", ".aside-2", ".aside-3"}) {
    std::ofstream(checkpoint) << "of " << ending;
    OutputFolder out(folder.path, Earlier::go_on);
    out.commit();
    CHECK(out.remove_after(0, 200) == std::vector<fs::path>{beside(ending)});
  }
  for (const char* ending : {".aside", ".aside-2", ".aside-3"})
    CHECK(text_of(beside(ending)) == std::string("of ") + ending);

  // each of them counts as a file of an earlier run
  fs::remove(beside(".aside"));
  std::ofstream(beside(".aside-2"), std::ios::binary) << "mergel checkpoint, cut";
  create_file(beside(".aside-two"));
  CHECK_THAT(refusal(folder.path, Earlier::keep),
             Contains("holds an earlier run (checkpoint_000000000300.h5.aside-2)"));
  OutputFolder(folder.path, Earlier::overwrite).commit();
  CHECK(tree(folder.path) ==
        std::vector<std::string>{"checkpoint_000000000300.h5.aside-two"});

  fs::rename(beside(".aside-two"), beside(".aside-2"));
  JobOptions options;
  options.output = options.restart = folder.path;
  CHECK_THROWS_WITH(folder_to_begin_in(options).check(),
                    Contains("holds a run with checkpoints"));
}

TEST_CASE("A run that another process finished meanwhile is not started again",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  create_file(folder.path / "history.csv");
  create_case(folder.path);
  JobOptions options;
  options.output = options.restart = folder.path;
  OutputFolder output = folder_to_begin_in(options);
  output.check();
  create_file(folder.path / "summary.json");
  CHECK_THROWS_WITH(output.commit(), Contains("holds a finished run"));
  CHECK(fs::exists(folder.path / "history.csv"));
}

TEST_CASE("A failed run without a checkpoint is not started again over its results",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  create_file(folder.path / "history.csv");
  create_case(folder.path);
  create_file(folder.path / "failed.json");
  JobOptions options;
  options.output = options.restart = folder.path;
  CHECK_THROWS_WITH(folder_to_begin_in(options).check(), Contains("holds a failed run"));
  options.restart.clear();
  options.overwrite = true;
  folder_to_begin_in(options).commit();
  CHECK(tree(folder.path).empty());
}

TEST_CASE("A folder that is locked before its check stays locked until the run ends",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  {
    OutputFolder output(folder.path, Earlier::go_on);
    output.hold(FolderLock(folder.path, 0.0));
    CHECK_THROWS_AS(require_no_run(folder.path, 0.0), InputError);
    CHECK_NOTHROW(output.check());
    CHECK_NOTHROW(output.commit());
    CHECK_THROWS_AS(FolderLock(folder.path, 0.0), InputError);
  }
  CHECK(tree(folder.path).empty());
}

TEST_CASE("The files of a results folder are distinguished from those of a user",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  for (const char* file : {"notes.txt", "data.csv", "fields/mine.vtp"})
    create_file(folder.path / file);
  CHECK(own_files_in(folder.path).files.empty());
  CHECK(own_files_in(folder.path).frames.empty());
  for (const char* file : {".history.partial.csv", "checkpoint_000000000300.h5.aside-2",
                           "fields/bonds_0000.vtp", "fields/.bonds_0001.partial.vtp"})
    create_file(folder.path / file);
  const OwnFiles own = own_files_in(folder.path);
  CHECK(own.files.size() == 2);
  CHECK(own.aside ==
        std::vector<fs::path>{folder.path / "checkpoint_000000000300.h5.aside-2"});
  CHECK(own.frames == std::vector<fs::path>{folder.path / "fields/bonds_0000.vtp"});
}

TEST_CASE("A folder to which a run writes is refused to another run until it ends",
          "[unit][apps]")
{
  const TemporaryFolder folder;
  std::ofstream(folder.path / ".mergel.lock") << "of a run that was killed";
  {
    OutputFolder output(folder.path, Earlier::go_on);
    output.commit();
    output.commit();
    CHECK_THAT(FolderLock::holder(folder.path),
               Contains("another run (process " + std::to_string(getpid())));
    CHECK_THROWS_WITH(require_no_run(folder.path, 0.0),
                      Contains("is writing there. Wait for it to end"));
    CHECK_THROWS_AS(FolderLock(folder.path, 0.0), InputError);
  }
  CHECK(FolderLock::holder(folder.path).empty());
  CHECK(tree(folder.path).empty());
}
