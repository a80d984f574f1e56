#include "coupling/membrane_structure.h"

#include "dem/io/state/named_numbers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace mergel::coupling {

namespace {

/// The end nodes of a tube: those at the bottom, then those at the top.
std::vector<fem::GuidedNodes> tied_nodes(const fem::Tube& tube, MembraneEnds ends)
{
  std::vector<fem::GuidedNodes> all(2);
  for (std::size_t end = 0; end < 2; ++end) {
    all[end].along_z_only = ends == MembraneEnds::free;
    for (int i = 0; i < tube.n_around; ++i)
      all[end].nodes.push_back(tube.node(i, end == 0 ? 0 : tube.n_high));
  }
  return all;
}

template <class State>
auto fields_of(const std::string& name, State& s)
{
  return std::array<std::pair<std::string, decltype(&s.x)>, 4>{{{name + "_x", &s.x},
                                                                {name + "_own", &s.f_own},
                                                                {name + "_f", &s.f},
                                                                {name + "_work", &s.work}}};
}

template <class State>
dem::NumbersOf<State> numbers_of(State& s)
{
  auto& w = s.work_volume;
  dem::NumbersOf<State> all{{"pressure [Pa]", &s.pressure},
                            {"pressure of the next window [Pa]", &s.next_pressure},
                            {"time step [s]", &s.dt},
                            {"window of its own forces [s]", &s.window},
                            {"time since they kicked [s]", &s.since},
                            {"pressure of its work [Pa]", &s.work_pressure},
                            {"volume of its work [m3]", &w.V},
                            {"work of the pressure [J]", &s.pressure_work}};
  const char* const ends[] = {"bottom", "top"};
  for (std::size_t end = 0; end < 2; ++end)
    for (int c = 0; c < 3; ++c) {
      const std::string at = std::string(" at the ") + ends[end] + ' ' + "xyz"[c];
      all.push_back({"area" + at + " [m2]", &w.area[end][c]});
      all.push_back({"centre" + at + " [m]", &w.centre[end][c]});
    }
  return all;
}

template <class State>
dem::CountsOf<State> counts_of(State& s)
{
  return {{"steps to the next kick by its own forces [-]", &s.n_left},
          {"steps from kick to kick [-]", &s.subcycle},
          {"windows since the work of the pressure [-]", &s.n_volume}};
}

template <class Limit>
dem::NumbersOf<Limit> subcycle_numbers(Limit& limit)
{
  return {{"limit of the subcycle [-]", &limit}};
}

constexpr double largest_window = 0.7; // of the subcycle times the largest frequency [-]

/// Add the columns of a field, as rows of the state, that belong to this rank's nodes.
template <class Field>
void add_nodal(dem::State& state, const std::string& name, const Field& field,
               const fem::NodeShares& nodes)
{
  const auto n = static_cast<Eigen::Index>(Field::RowsAtCompileTime);
  std::vector<double> rows(field.data() + n * nodes.first(),
                           field.data() + n * nodes.end());
  const auto columns = static_cast<std::size_t>(n);
  if (nodes.is_alone()) // the ranks of the state may be more
    state.add_common(name, std::move(rows), columns);
  else
    state.add(name, std::move(rows), columns);
}

template <class Field>
void load_nodal(const dem::State& state, const std::string& name, Field& field)
{
  const auto& rows =
      state.get_rows<double>(name, static_cast<std::size_t>(field.cols()),
                             static_cast<std::size_t>(Field::RowsAtCompileTime));
  std::copy(rows.begin(), rows.end(), field.data());
}

} // namespace

MembraneStructure::MembraneStructure(fem::Membrane membrane, const fem::Tube& tube,
                                     MembraneEnds ends, double alpha,
                                     const RigidPlaten& bottom, const RigidPlaten& top)
    : motion_(std::move(membrane), tube, alpha, tied_nodes(tube, ends)), bottom_(bottom),
      top_(top)
{
}

Interface MembraneStructure::interface(const dem::ContactLaw& contact) const
{
  const fem::SurfaceMesh& mesh = motion_.membrane().rest();
  std::vector<int> itself(n_nodes());
  for (std::size_t k = 0; k < itself.size(); ++k) itself[k] = static_cast<int>(k);
  return {dem::make_wall(mesh.x, mesh.triangles, contact), follow(itself, itself.size())};
}

dem::NodeShares MembraneStructure::shares() const
{
  const fem::NodeShares& nodes = motion_.membrane().shares();
  if (nodes.is_alone()) return {};
  dem::NodeShares shares{{}, nodes.rank()};
  for (const Eigen::Index first : nodes.first_of_rank())
    shares.first.push_back(static_cast<std::size_t>(first));
  return shares;
}

void MembraneStructure::positions(Nodal& x) const
{
  x.resize(n_nodes());
  for (std::size_t k = 0; k < x.size(); ++k)
    x[k] = fem::at(motion_.state().x, static_cast<Eigen::Index>(k));
}

void MembraneStructure::velocities(Nodal& v) const
{
  const fem::NodalMessage& of_nodes = motion_.state().v;
  v.resize(n_nodes());
  std::copy(of_nodes.data(), of_nodes.data() + of_nodes.size(), v.front().data());
}

void MembraneStructure::step(double dt, const Nodal& f)
{
  const fem::Tube& tube = motion_.tube();
  guided_.clear();
  for (const RigidPlaten* platen : {&bottom_, &top_})
    for (int i = 0; i < tube.n_around; ++i)
      guided_.push_back(platen->velocity_at(
          fem::at(motion_.state().x, tube.node(i, platen == &bottom_ ? 0 : tube.n_high))));
  motion_.step(dt, f, guided_);
}

std::optional<Nodal> MembraneStructure::solve_static(const Nodal&)
{
  return std::nullopt;
}

void MembraneStructure::equalise_frequencies(double omega2,
                                             std::span<const double> stiffness)
{
  Eigen::ArrayXd m = motion_.membrane().stiffness_bound(motion_.state().x);
  for (Eigen::Index a = 0; a < m.size(); ++a)
    m[a] = (m[a] + stiffness[static_cast<std::size_t>(a)]) / omega2;
  motion_.set_masses(m);
}

void MembraneStructure::restore_masses()
{
  motion_.set_masses(motion_.membrane().masses());
}

/// As for the far field: a window of at most 0.7 over the largest frequency of a node between
/// particles that are held. Four steps, at 2.1, give an energy error of 9e-3 in
/// `triaxial_small`, and the pressure on the particles swings by a third; one step 7e-5.
void MembraneStructure::choose_subcycle(double dt, std::span<const double> stiffness,
                                        double longest, std::size_t most)
{
  const Eigen::ArrayXd k = motion_.membrane().stiffness_bound(motion_.state().x);
  const Eigen::ArrayXd& m = motion_.state().m;
  double omega2 = 0.0;
  for (Eigen::Index a = 0; a < k.size(); ++a)
    omega2 = std::max(omega2, (k[a] + stiffness[static_cast<std::size_t>(a)]) / m[a]);
  const double window = std::min(largest_window / std::sqrt(omega2), longest);
  subcycle_limit_ = window / dt;
  motion_.set_subcycle(static_cast<std::size_t>(
      std::clamp(std::floor(subcycle_limit_), 1.0, static_cast<double>(most))));
}

Structure::Subcycle MembraneStructure::subcycle() const
{
  return {motion_.state().subcycle, subcycle_limit_};
}

std::size_t MembraneStructure::n_amplitudes() const
{
  return 3 * n_nodes();
}

void MembraneStructure::move(std::span<const double> y, Nodal& u) const
{
  u.resize(n_nodes());
  for (std::size_t k = 0; k < u.size(); ++k) {
    const auto a = static_cast<Eigen::Index>(k);
    const double root = 1.0 / std::sqrt(motion_.state().m[a]);
    for (int c = 0; c < 3; ++c)
      u[k][c] = motion_.free()(c, a) * root * y[3 * k + static_cast<std::size_t>(c)];
  }
}

void MembraneStructure::multiply(std::span<const double> y, const Nodal& f,
                                 std::span<double> to) const
{
  const Eigen::ArrayXd stiffness = motion_.membrane().stiffness_bound(motion_.state().x);
  for (std::size_t k = 0; k < f.size(); ++k) {
    const auto a = static_cast<Eigen::Index>(k);
    const double m = motion_.state().m[a], root = 1.0 / std::sqrt(m);
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * k + static_cast<std::size_t>(c);
      to[i] = motion_.free()(c, a) * (stiffness[a] / m * y[i] + root * f[k][c]);
    }
  }
}

StructureEnergies MembraneStructure::energies() const
{
  const fem::MembraneEnergies e = motion_.energies();
  return {e.kinetic, e.strain, e.load_work, 0.0, e.pressure_work + e.guide_work, e.damping};
}

void MembraneStructure::save(dem::State& state, const std::string& name) const
{
  const fem::MembraneState& s = motion_.state();
  const fem::NodeShares& nodes = motion_.membrane().shares();
  for (const auto& [array, field] : fields_of(name, s))
    add_nodal(state, array, *field, nodes);
  add_nodal(state, name + "_v", s.v, nodes);
  state.add_common(name + "_m", std::vector<double>(s.m.data(), s.m.data() + s.m.size()),
                   1);
  dem::save_numbers(state, name + "_numbers", numbers_of(s));
  dem::save_numbers(state, name + "_subcycle", subcycle_numbers(subcycle_limit_));
  dem::save_counts(state, name + "_counts", counts_of(s));
}

void MembraneStructure::load(const dem::State& state, const std::string& name)
{
  fem::MembraneState s = motion_.state();
  for (const auto& [array, field] : fields_of(name, s)) load_nodal(state, array, *field);
  load_nodal(state, name + "_v", s.v);
  const auto& m = state.get_rows<double>(name + "_m", n_nodes());
  std::copy(m.begin(), m.end(), s.m.data());
  dem::load_numbers(state, name + "_numbers", numbers_of(s));
  dem::load_numbers(state, name + "_subcycle", subcycle_numbers(subcycle_limit_));
  dem::load_counts(state, name + "_counts", counts_of(s));
  motion_.restore(std::move(s));
}

} // namespace mergel::coupling
