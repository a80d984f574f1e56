/// mergel bench: measures the cost of a step on this machine and of its parts. The
/// workloads are described in tests/bench/README.md.
#include "apps/bench/bench_checkpoint.h"
#include "apps/bench/workloads.h"
#include "apps/run/command_line.h"
#include "apps/run/jobs.h"
#include "apps/run/ranks.h"
#include "dem/assembly/distribute.h"
#include "dem/io/atomic_file.h"
#include "dem/io/readable.h"
#include "dem/io/seal.h"
#include "dem/io/state/checkpoint.h"
#include "dem/text.h"
#include "dem/timer.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <system_error>
#include <utility>

#include <unistd.h>

namespace mergel::apps {

namespace {

/// What the command line says.
struct BenchOptions {
  std::vector<Workload> workloads{Workload::bonded_block, Workload::frictional_packing};
  WorkloadSpec spec; ///< workload and size are set by spec_of()
  long particles = 50000, steps = 1000, repeat = 5; // signed: a minus must not wrap around
  std::filesystem::path output;                     ///< may be empty
  std::filesystem::path block;                      ///< may be empty
  std::filesystem::path checkpoint;                 ///< may be empty
};

const std::map<std::string, std::vector<Workload>> workload_names{
    {"W1", {Workload::bonded_block}},
    {"W2", {Workload::frictional_packing}},
    {"all", {Workload::bonded_block, Workload::frictional_packing}}};

void declare(CLI::App& app, BenchOptions& o)
{
  app.add_option("--workload", "W1, W2 or all, the default")
      ->each([&o](const std::string& name) {
        const auto found = workload_names.find(name);
        require(found != workload_names.end(),
                "mergel bench: --workload = " + in_quotes(name) +
                    ": must be W1, W2 or all");
        o.workloads = found->second;
      })
      ->expected(1);
  app.add_option("--particles", o.particles, "number of particles; default 50000");
  CLI::Option* const steps =
      app.add_option("--steps", o.steps, "timed steps; default 1000");
  CLI::Option* const repeat = app.add_option(
      "--repeat", o.repeat, "equal blocks of steps, timed separately; default 5");
  app.add_option("--seed", o.spec.seed, "of the workload; default 1");
  app.add_option("--yielding", o.spec.yielding,
                 "fraction of the bonds of W1 that yield in a step, 0 to 0.5; default 0");
  CLI::Option* const output = app.add_option(
      "--output", o.output, "CSV file to which a line per workload is added");
  CLI::Option* const block = app.add_option(
      "--write-block", o.block,
      "text file for the particles and bonds of W1, for another code; no run");
  CLI::Option* const checkpoint =
      app.add_option("--checkpoint", o.checkpoint,
                     "file for a checkpoint of the first workload, which is timed; no run");
  block->excludes(checkpoint);
  for (CLI::Option* const no_run : {block, checkpoint})
    for (CLI::Option* const of_run : {steps, repeat, output}) no_run->excludes(of_run);
}

WorkloadSpec spec_of(const BenchOptions& o, Workload w)
{
  WorkloadSpec spec = o.spec;
  spec.workload = w;
  spec.n_particles = static_cast<std::size_t>(o.particles);
  return spec;
}

void check(const BenchOptions& o)
{
  require(o.repeat >= 1 && o.steps >= o.repeat,
          "mergel bench: --steps = " + std::to_string(o.steps) +
              ", --repeat = " + std::to_string(o.repeat) +
              ": must be at least one block of at least one step");
  require(
      o.block.empty() || o.workloads.front() == Workload::bonded_block,
      "mergel bench: --write-block writes W1, and --workload W2 has no effect. Leave one "
      "of them out");
  require(o.particles > 0, "mergel bench: --particles must be positive");
  for (const Workload w : o.workloads) spec_of(o, w).check();
}

/// Time per particle and step [ns].
struct Costs {
  double smallest = 0.0, median = 0.0, most = 0.0; ///< of the blocks
  dem::StepTimes parts;                            ///< mean over all blocks
  double mean = 0.0;
  double cpu = 0.0; ///< of all ranks together
};

/// Results of one workload.
struct Figures {
  Costs ns;
  std::size_t n_steps = 0, n_particles = 0, n_bonds = 0, n_candidates = 0, n_contacts = 0;
  std::size_t n_rebuilds = 0, n_broken = 0, n_yielded = 0;
  int n_ranks = 1;
  double messages = 0.0, message_bytes = 0.0; ///< of the busiest rank, per step
  double reductions = 0.0;                    ///< global reductions per step
  double bytes = 0.0;                         ///< of the containers, all ranks
  double peak_bytes = 0.0;                    ///< resident, of the process so far
  std::uint64_t checksum = 0;
};

template <class T>
double bytes_of(const std::vector<T>& v)
{
  return static_cast<double>(v.capacity() * sizeof(T));
}

/// Memory of all containers that are kept from step to step.
double bytes_of(const dem::Assembly& assembly)
{
  const dem::Particles& p = assembly.particles;
  double bytes =
      bytes_of(p.state) + bytes_of(p.load) + bytes_of(p.id) + bytes_of(p.n_bonds);
  bytes += bytes_of(assembly.bonds.pairs) + bytes_of(assembly.bonds.blocks);
  bytes += bytes_of(assembly.contacts.pairs) + bytes_of(assembly.contacts.shear);
  bytes += static_cast<double>(p.size() * sizeof(dem::Vec3)); // where the list was built
  return bytes;
}

double peak_resident_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss); // Linux counts kilobytes
}

/// User and system time of this process [s].
double cpu_seconds()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

Costs run_blocks(WorkingAssembly& working, std::size_t steps_a_block, std::size_t n_blocks)
{
  dem::Assembly& assembly = working.assembly;
  assembly.times = {};
  const double n = static_cast<double>(assembly.particles.size() * steps_a_block);
  std::vector<double> blocks;
  const double cpu_before = cpu_seconds();
  for (std::size_t b = 0; b < n_blocks; ++b) {
    const double start = dem::wall_clock();
    for (std::size_t k = 0; k < steps_a_block; ++k) working.step();
    blocks.push_back(1e9 * (dem::wall_clock() - start) / n);
  }
  Costs c;
  for (const double ns : blocks) c.mean += ns / static_cast<double>(n_blocks);
  const double cpu_ns = 1e9 * (cpu_seconds() - cpu_before);
  c.cpu = static_cast<double>(assembly.comm.global_sum(static_cast<std::size_t>(cpu_ns))) /
          (n * static_cast<double>(n_blocks));
  c.parts = assembly.times;
  for (double* part : {&c.parts.motion, &c.parts.lists, &c.parts.bonds, &c.parts.contacts,
                       &c.parts.walls, &c.parts.exchange})
    *part *= 1e9 / (n * static_cast<double>(n_blocks));
  std::sort(blocks.begin(), blocks.end());
  c.smallest = blocks.front();
  c.most = blocks.back();
  c.median = 0.5 * (blocks[(n_blocks - 1) / 2] + blocks[n_blocks / 2]);
  return c;
}

Figures measure(const WorkloadSpec& spec, std::size_t steps_a_block, std::size_t n_blocks)
{
  WorkingAssembly working = make_workload(spec);
  dem::Assembly& assembly = working.assembly;
  Figures f;
  f.n_bonds = assembly.bonds.size();
  dem::distribute(assembly, MPI_COMM_WORLD);
  constexpr int steps_to_warm_up = 20;
  for (int k = 0; k < steps_to_warm_up; ++k) working.step();

  const std::size_t rebuilds = assembly.list.n_builds(), broken = assembly.losses.broken,
                    yielded = assembly.losses.yielded;
  const dem::Ghosts::Traffic before = assembly.ghosts.traffic();
  const std::size_t reductions_before = assembly.comm.n_reductions();
  f.ns = run_blocks(working, steps_a_block, n_blocks);
  f.n_steps = steps_a_block * n_blocks;
  f.n_particles = assembly.particles.size();
  const dem::Ghosts::Traffic after = assembly.ghosts.traffic();
  const auto a_step = [&](std::size_t now, std::size_t then) {
    return assembly.comm.global_max(static_cast<double>(now - then)) /
           static_cast<double>(f.n_steps);
  };
  f.messages = a_step(after.messages, before.messages);
  f.message_bytes = a_step(after.bytes, before.bytes);
  f.reductions = a_step(assembly.comm.n_reductions(), reductions_before);
  f.n_ranks = assembly.comm.n_ranks();
  f.n_rebuilds = assembly.list.n_builds() - rebuilds;
  f.n_broken = assembly.comm.global_sum(assembly.losses.broken - broken);
  f.n_yielded = assembly.comm.global_sum(assembly.losses.yielded - yielded);
  f.bytes = static_cast<double>(
      assembly.comm.global_sum(static_cast<std::size_t>(bytes_of(assembly))));
  f.peak_bytes = static_cast<double>(
      assembly.comm.global_sum(static_cast<std::size_t>(peak_resident_bytes())));
  const dem::Assembly all = dem::gather(assembly);
  f.n_candidates = all.contacts.pairs.size();
  f.n_contacts = count_contacts(all);
  f.checksum = checksum(all.particles);
  return f;
}

/// Best rate of a[i] = b[i] + s c[i] on arrays much larger than any cache, three numbers
/// per element [byte/s]. Source: McCalpin (1995), STREAM.
double triad_rate()
{
  constexpr std::size_t n = std::size_t{1} << 24;
  constexpr int n_runs = 7;
  std::vector<double> a(n, 0.0), b(n, 1.0), c(n, 2.0);
  double best = 0.0;
  for (int run = 1; run <= n_runs; ++run) {
    const double s = run, start = dem::wall_clock();
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + s * c[i];
    const double seconds = dem::wall_clock() - start;
    if (a[n / 2] != 1.0 + 2.0 * s) throw std::logic_error("triad_rate: a wrong sum");
    best = std::max(best, static_cast<double>(3 * n * sizeof(double)) / seconds);
  }
  return best;
}

/// One number of the report: name and unit, in the CSV file and on the screen.
struct Figure {
  const char* name;
  const char* unit;
  double value;
  int digits; ///< after the point
};

double ratio(double a, double b)
{
  return b > 0.0 ? a / b : 0.0;
}

double ratio(std::size_t a, std::size_t b)
{
  return ratio(static_cast<double>(a), static_cast<double>(b));
}

/// All numbers of the report.
std::vector<Figure> figures(const WorkloadSpec& spec, const Figures& f)
{
  const bool is_bonded = spec.workload == Workload::bonded_block;
  const double pairs = ratio(is_bonded ? f.n_bonds : f.n_contacts, f.n_particles);
  const auto n = static_cast<double>(f.n_particles);
  const dem::StepTimes& part = f.ns.parts;
  const auto share = [&](double ns) { return 100.0 * ratio(ns, f.ns.mean); };
  return {
      {"time per particle-step", "ns", f.ns.median, 1},
      {"time per particle-step, smallest", "ns", f.ns.smallest, 1},
      {"time per particle-step, largest", "ns", f.ns.most, 1},
      {is_bonded ? "time per bond-step" : "time per contact-step", "ns",
       ratio(f.ns.median, pairs), 1},
      {"motion", "%", share(part.motion), 1},
      {"lists", "%", share(part.lists), 1},
      {"bonds", "%", share(part.bonds), 1},
      {"contacts", "%", share(part.contacts), 1},
      {"walls", "%", share(part.walls), 1},
      {"other ranks", "%", share(part.exchange), 1},
      {"processor time of all ranks per particle-step", "ns", f.ns.cpu, 1},
      {"ghost messages of the busiest rank in a step", "-", f.messages, 1},
      {"bytes of these messages", "byte", f.message_bytes, 0},
      {"global reductions in a step", "-", f.reductions, 2},
      {"rebuilds", "-", static_cast<double>(f.n_rebuilds), 0},
      {"bonds per particle", "-", ratio(f.n_bonds, f.n_particles), 3},
      {"contacts per particle", "-", ratio(f.n_contacts, f.n_particles), 3},
      {"unbonded candidates per particle", "-", ratio(f.n_candidates, f.n_particles), 3},
      {"bonds broken", "-", static_cast<double>(f.n_broken), 0},
      {"bonds yielding in a step", "%", 100.0 * ratio(f.n_yielded, f.n_bonds * f.n_steps),
       2},
      {"memory per particle", "byte", f.bytes / n, 0},
      {"peak memory per particle, building included", "byte", f.peak_bytes / n, 0},
  };
}

const char* name_of(Workload w)
{
  return w == Workload::bonded_block ? "W1" : "W2";
}

constexpr std::size_t width_of_name = 45; ///< of the report, a blank after the longest
constexpr const char* checksum_name = "checksum of x, v, omega";

void print_figure(const Figure& f)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", f.digits, f.value);
  std::string name = f.name;
  name.resize(std::max(name.size(), width_of_name), ' ');
  std::cout << "  " << name << ' ' << text << (f.unit[0] == '-' ? "" : " ")
            << (f.unit[0] == '-' ? "" : f.unit) << '\n';
}

void print(const WorkloadSpec& spec, const Figures& f)
{
  std::cout << name_of(spec.workload) << ": " << f.n_particles << " particles, "
            << f.n_steps << " steps, seed " << spec.seed << ", " << f.n_ranks
            << (f.n_ranks == 1 ? " rank\n" : " ranks\n");
  for (const Figure& figure : figures(spec, f)) print_figure(figure);
  std::string name = checksum_name;
  name.resize(width_of_name, ' ');
  std::cout << "  " << name << ' ' << dem::hexadecimal(f.checksum) << std::endl;
}

/// A line of the CSV file and its header.
struct Line {
  std::string header, text;
};

Line csv_line(const WorkloadSpec& spec, const Figures& f, double triad)
{
  std::ostringstream header, text;
  header << "workload,particles [-],ranks [-],steps [-],seed [-]";
  text << name_of(spec.workload) << ',' << f.n_particles << ',' << f.n_ranks << ','
       << f.n_steps << ',' << spec.seed;
  for (const Figure& figure : figures(spec, f)) {
    std::string name = figure.name;
    if (name.starts_with("time per") && name.find("particle") == std::string::npos)
      name = "time per pair-step"; // one header for both workloads
    std::erase(name, ',');
    header << ',' << name << " [" << figure.unit << ']';
    text << ',' << dem::shortest(figure.value);
  }
  header << ",triad [GB/s],checksum";
  text << ',' << dem::shortest(1e-9 * triad) << ',' << dem::hexadecimal(f.checksum);
  return {header.str(), text.str()};
}

/// Refuse a file that cannot be written, before the measurement.
/// @throws InputError
void check_place(const char* option, const std::filesystem::path& file)
{
  const std::filesystem::path parent = file.parent_path();
  const std::filesystem::path folder = parent.empty() ? "." : parent;
  std::error_code error;
  const bool is_there = std::filesystem::exists(file, error);
  require(is_there || error != std::errc::filename_too_long,
          "mergel bench: " + std::string(option) + ": " + error.message() +
              ". Give a shorter name");
  const std::string in_front = "mergel bench: " + std::string(option) + " " +
                               file.string() + ": the folder " + folder.string();
  const auto kind = std::filesystem::status(folder, error).type();
  require(kind != std::filesystem::file_type::not_found,
          in_front + " does not exist. Create it, or name another");
  require(kind == std::filesystem::file_type::directory ||
              kind == std::filesystem::file_type::none, // it cannot be reached
          in_front + " is no folder. Name another");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(in_front + " cannot be written: " +
                     std::generic_category().message(errno) + ". Name another");
  if (is_there) dem::require_readable(file);
}

/// Refuse to replace a file that this job has not written, before the measurement.
/// @param is_own whether it has; called when the file exists
/// @throws InputError
template <class IsOwn>
void check_earlier(const char* option, const std::filesystem::path& file, IsOwn&& is_own)
{
  std::error_code error; // a file that cannot be reached is refused where it is written
  require(!std::filesystem::exists(std::filesystem::symlink_status(file, error)) ||
              is_own(),
          "mergel bench: " + std::string(option) + " " + file.string() +
              ": exists, and is not what this option writes. Move it away, or choose "
              "another name");
}

/// Whether the file begins as write_block() begins one: two whole numbers and a time.
bool is_block(const std::filesystem::path& file)
{
  std::ifstream in(file);
  std::string line, rest;
  std::getline(in, line);
  std::istringstream first(line);
  std::size_t n_particles = 0, n_bonds = 0;
  double dt = 0.0;
  return first >> n_particles >> n_bonds >> dt && !(first >> rest) && dt > 0.0;
}

bool is_checkpoint_of_bench(const std::filesystem::path& file)
{
  try {
    return dem::read_checkpoint(file).label.job == "bench";
  } catch (const InputError&) {
    return false;
  }
}

/// The lines of the file, without newlines; none if there is no file.
/// @throws InputError when it is not a table of this job
std::vector<std::string> earlier_lines(const std::filesystem::path& file,
                                       const std::string& header)
{
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  require(lines.empty() ? !std::filesystem::exists(file) : lines.front() == header,
          "mergel bench: --output " + file.string() +
              ": exists and is not a table of mergel bench of this version. Choose another "
              "name");
  return lines;
}

void append(const std::filesystem::path& file, const std::vector<Line>& lines)
{
  const std::string& header = lines.front().header;
  std::vector<std::string> all = earlier_lines(file, header);
  if (all.empty()) all.push_back(header);
  for (const Line& line : lines) all.push_back(line.text);
  dem::replace_file(file, joined(all, "\n") + "\n");
}

/// Number of particles and bonds, and time step [s]; x, R, m, v of every particle, SI; i
/// and j of every bond, from 0.
void write_block(const std::filesystem::path& file, const WorkingAssembly& working)
{
  const dem::Assembly& assembly = working.assembly;
  std::ostringstream out;
  out << assembly.particles.size() << ' ' << assembly.bonds.size() << ' '
      << dem::shortest(working.dt) << '\n';
  for (const dem::ParticleState& b : assembly.particles.state) {
    for (const double value :
         {b.x.x(), b.x.y(), b.x.z(), b.R, b.m, b.v.x(), b.v.y(), b.v.z()})
      out << dem::shortest(value) << ' ';
    out << '\n';
  }
  for (const dem::Pair& q : assembly.bonds.pairs) out << q.i << ' ' << q.j << '\n';
  dem::replace_file(file, out.str());
}

int run_bench(const BenchOptions& o)
{
  if (!o.block.empty()) {
    check_place("--write-block", o.block);
    on_first_rank([&] {
      check_earlier("--write-block", o.block, [&] { return is_block(o.block); });
    });
    on_first_rank(
        [&] { write_block(o.block, make_workload(spec_of(o, Workload::bonded_block))); });
    std::cout << "block: " << o.block.string() << '\n';
    return 0;
  }
  if (!o.checkpoint.empty()) {
    check_place("--checkpoint", o.checkpoint);
    on_first_rank([&] {
      check_earlier("--checkpoint", o.checkpoint,
                    [&] { return is_checkpoint_of_bench(o.checkpoint); });
    });
    measure_checkpoint(spec_of(o, o.workloads.front()), o.checkpoint);
    return 0;
  }
  if (!o.output.empty()) {
    check_place("--output", o.output);
    earlier_lines(o.output, csv_line(o.spec, {}, 0.0).header);
  }

  const auto n_blocks = static_cast<std::size_t>(o.repeat);
  const std::size_t steps_a_block = static_cast<std::size_t>(o.steps) / n_blocks;
  std::vector<std::pair<WorkloadSpec, Figures>> found;
  for (const Workload w : o.workloads) {
    const WorkloadSpec spec = spec_of(o, w);
    found.emplace_back(spec, measure(spec, steps_a_block, n_blocks));
    print(spec, found.back().second);
  }
  double triad = 0.0;
  on_first_rank([&] { triad = triad_rate(); });
  print_figure({"memory bandwidth, triad on one core", "GB/s", 1e-9 * triad, 1});

  if (o.output.empty()) return 0;
  std::vector<Line> lines;
  for (const auto& [s, f] : found) lines.push_back(csv_line(s, f, triad));
  on_first_rank([&] { append(o.output, lines); });
  std::cout << "table: " << o.output.string() << '\n';
  return 0;
}

} // namespace

void help_bench(std::ostream& out)
{
  CLI::App app;
  BenchOptions o;
  declare(app, o);
  for (const CLI::Option* option : app.get_options()) {
    std::string name = option->get_name();
    if (name.find("help") != std::string::npos) continue;
    name.resize(std::max<std::size_t>(name.size(), 15), ' ');
    out << "  " << name << "  " << option->get_description() << '\n';
  }
  out << "\nW1 is a bonded block, W2 a frictional packing: see tests/bench/README.md.\n";
}

std::function<int()> read_bench(const std::vector<std::string>& arguments)
{
  CLI::App app;
  BenchOptions o;
  declare(app, o);
  parse(app, "mergel bench", arguments);
  check(o);
  return [o] { return run_bench(o); };
}

} // namespace mergel::apps
