#include "apps/run/results.h"

#include "apps/case/case_scan.h"
#include "apps/case/words.h"
#include "apps/run/tables.h"
#include "dem/error.h"
#include "dem/io/readable.h"
#include "dem/io/state/checkpoint.h"
#include "dem/io/vtk.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <system_error>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

bool is_there(const fs::path& file)
{
  std::error_code error;
  return fs::is_regular_file(file, error);
}

/// The keys of resolved.prm; none where it cannot be read.
CaseScan case_of(const fs::path& folder)
{
  try {
    return scan_case(read_case_text(folder / "resolved.prm"), "resolved.prm");
  } catch (const InputError&) {
    return {};
  }
}

/// The first line that is no remark.
std::string first_line(const fs::path& file)
{
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line.starts_with('#')) {
  }
  return line;
}

/// Whether the text of a file contains `text`.
bool contains(const fs::path& file, const std::string& text)
{
  std::ifstream in(file, std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(in)), {});
  return all.find(text) != std::string::npos;
}

/// Whether the folder is that of mergel sample, whose case may be that of another job.
bool holds_only_a_specimen(const fs::path& folder)
{
  if (is_there(folder / "summary.json"))
    return contains(folder / "summary.json", "\"porosity wanted [-]\"");
  return is_there(folder / "sample.h5") && !is_there(folder / "history.csv") &&
         !is_there(folder / "far_field.pvd") && dem::checkpoints_in(folder).empty();
}

/// Whether the run has written force chains. Those of earlier versions, but for piles, have none.
bool has_contacts(const fs::path& folder)
{
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder / "fields", error))
    if (entry.path().filename().string().starts_with("contacts_")) return true;
  return is_there(folder / "contacts.pvd");
}

/// Whether the run has written its specimen: before all else. One that was continued from a
/// checkpoint alone, without the specimen, has none.
bool owes_specimen(const fs::path& folder, const std::string& job, Extent extent)
{
  if (job == "sample") return true;
  if (job != "pile" && job != "triaxial" && job != "brazilian") return false;
  return extent == Extent::finished && !begins_at_checkpoint(folder / "history.csv");
}

/// The series that a finished run of this job leaves.
std::vector<std::string> series_of(const fs::path& folder, const std::string& job)
{
  if (job == "pile")
    return {"particles", "bonds", "pile", "far_field", "fields", "contacts"};
  std::vector<std::string> series{"particles", "bonds"};
  if (has_contacts(folder)) series.push_back("contacts");
  if (job == "sample") return series;
  if (job != "element" && job != "triaxial" && job != "brazilian") return {};
  const CaseScan scan = case_of(folder);
  const auto value_of = [&](const char* section, const char* key) {
    const auto is_it = [&](const CaseEntry& e) {
      return e.section == section && e.key == key;
    };
    const auto found = std::find_if(scan.entries.begin(), scan.entries.end(), is_it);
    return found == scan.entries.end() ? std::string{} : found->value;
  };
  const std::string pictures = value_of("Output", "pictures");
  if (pictures.empty() || pictures == "none") return {};
  if (job == "triaxial") series.push_back("platens");
  if (job == "brazilian") series.insert(series.end(), {"breaks", "plates"});
  if (value_of("Membrane", "membrane") == "true") series.push_back("membrane");
  return series;
}

/// The files of a series that are not there, or the series where it cannot be read.
std::vector<std::string> missing_in(const fs::path& folder, const std::string& pvd)
{
  std::vector<std::string> missing;
  try {
    for (const dem::SeriesEntry& entry : dem::read_series(folder / pvd))
      if (!is_there(folder / entry.file)) missing.push_back(entry.file.string());
  } catch (const InputError&) {
    const std::error_code error = dem::reading_error(folder / pvd);
    const bool is_absent = !error || error == std::errc::no_such_file_or_directory;
    missing.push_back(is_absent ? pvd : pvd + " (" + error.message() + ")");
  }
  return missing;
}

} // namespace

std::string job_of(const fs::path& folder)
{
  const CaseScan scan = case_of(folder);
  const auto has = [&](const char* section) { return scan.sections.contains(section); };
  if (has("Particles")) return "bond";
  if (has("Specimen") && holds_only_a_specimen(folder)) return "sample";
  if (has("Plates")) return "brazilian";
  if (has("Membrane") || has("Platens")) return "triaxial";
  if (has("Loading")) return "element";
  if (has("Specimen")) return has("Pile") ? "pile" : "sample";
  const std::string heading = first_line(folder / "history.csv");
  if (heading.find("depth/D_p [-]") != std::string::npos) return "pile";
  if (heading.find("2P/(pi D t) [Pa]") != std::string::npos) return "brazilian";
  if (heading.find("cell pressure [Pa]") != std::string::npos) return "triaxial";
  if (heading.find("axial strain [-]") != std::string::npos) return "element";
  if (heading.find("plastic theta [rad]") != std::string::npos) return "bond";
  return "";
}

std::vector<std::string> missing_results(const fs::path& folder, const std::string& job,
                                         Extent extent)
{
  std::vector<std::string> missing;
  const auto owe = [&](const std::string& name) {
    if (!is_there(folder / name)) missing.push_back(name);
  };
  owe("resolved.prm");
  if (job.empty()) owe("history.csv");
  for (const std::string& table : tables_of(job)) owe(table);
  if (owes_specimen(folder, job, extent)) owe("sample.h5");
  const std::vector<std::string> owed = series_of(folder, job);
  for (const char* name : {"particles", "bonds", "pile", "far_field", "fields", "contacts",
                           "platens", "membrane", "breaks", "plates"}) {
    const std::string pvd = std::string(name) + ".pvd";
    if (is_there(folder / pvd)) {
      const auto gone = missing_in(folder, pvd);
      missing.insert(missing.end(), gone.begin(), gone.end());
    } else if (extent == Extent::finished &&
               std::find(owed.begin(), owed.end(), name) != owed.end()) {
      missing.push_back(pvd);
    }
  }
  return missing;
}

std::string lost_results(const fs::path& folder, const std::string& job)
{
  std::vector<std::string> missing = missing_results(folder, job, Extent::finished);
  if (job != "sample") std::erase(missing, "sample.h5"); // not needed to go on
  if (missing.empty()) return "";
  const std::size_t n_more = missing.size() - 1;
  return folder.string() + ": was changed while the run wrote there, and lacks " +
         missing.front() +
         (n_more == 0   ? ""
          : n_more == 1 ? " and one more file"
                        : " and " + std::to_string(n_more) + " more files");
}

void require_results(const fs::path& folder, const std::string& job)
{
  const std::string lost = lost_results(folder, job);
  if (!lost.empty()) throw NumericalError(lost);
}

} // namespace mergel::apps
