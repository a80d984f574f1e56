#include "apps/run/provenance.h"

#include "apps/case/case_file.h"
#include "apps/case/words.h"
#include "dem/version.h"

#include <mpi.h>

#include <array>
#include <ctime>
#include <fstream>

#include <unistd.h>

namespace mergel::apps {

namespace fs = std::filesystem;

namespace {

std::string present_date()
{
  std::array<char, 32> text{};
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text.data();
}

std::string host_name()
{
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

} // namespace

Provenance provenance(const std::vector<std::string>& command)
{
  Provenance p;
  p.program = dem::program_text();
  p.date = present_date();
  p.host = host_name();
  MPI_Comm_size(MPI_COMM_WORLD, &p.n_ranks);
  p.command = in_shell(command);
  return p;
}

Provenance provenance(const JobOptions& options)
{
  Provenance p = provenance(options.command);
  const fs::path& named = options.case_file.empty() ? options.restart : options.case_file;
  p.case_name = fs::absolute(named).lexically_normal().string();
  return p;
}

std::string Provenance::json() const
{
  return "{\"program\": " + in_json(program) + ", \"date\": " + in_json(date) +
         ", \"host\": " + in_json(host) + ", \"ranks\": " + std::to_string(n_ranks) +
         ", \"command\": " + in_json(command) +
         (case_name.empty() ? "" : ", \"case\": " + in_json(case_name)) + "}";
}

std::string Provenance::remark() const
{
  return std::string(first_words_of_start) + date + " on " + printable(host) + " with " +
         std::to_string(n_ranks) + (n_ranks == 1 ? " rank" : " ranks") + " by " + program +
         ": " + command + (case_name.empty() ? "" : "; case " + in_shell(case_name)) + "\n";
}

std::string earlier_starts(const fs::path& resolved)
{
  std::ifstream in(resolved);
  std::string line, starts;
  while (std::getline(in, line) && line.starts_with('#'))
    if (line.starts_with(first_words_of_start)) starts += line + "\n";
  return starts;
}

std::string in_shell(const std::vector<std::string>& words)
{
  std::vector<std::string> quoted;
  for (const std::string& word : words) quoted.push_back(in_shell(word));
  return joined(quoted, " ");
}

} // namespace mergel::apps
