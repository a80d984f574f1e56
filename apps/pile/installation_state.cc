/// Saving and loading an installation: its numbers and counts in a fixed order.
#include "apps/pile/installation.h"

#include <cmath>
#include <type_traits>

namespace mergel::apps {

template <class Self>
auto Installation::numbers_of(Self& self)
{
  using Number = std::conditional_t<std::is_const_v<Self>, const double, double>;
  std::vector<Number*> all{&self.time_,        &self.q_peak_,     &self.worst_energy_error_,
                           &self.next_record_, &self.force_.cone, &self.force_.shaft};
  for (auto* b : {&self.worst_interface_, &self.last_.interface})
    all.insert(all.end(), {&b->force, &b->moment, &b->power});
  auto& r = self.last_;
  all.insert(all.end(), {&r.time, &r.depth, &r.tip_depth, &r.F_tip, &r.F_shaft, &r.q_c,
                         &r.unbalanced, &r.kinetic, &r.energy_error});
  for (auto* e : {&self.start_.assembly, &self.last_.balance})
    all.insert(all.end(), {&e->kinetic, &e->bonds, &e->contacts, &e->walls, &e->mirror,
                           &e->gravity, &e->wall_work, &e->pile_work, &e->slip, &e->plastic,
                           &e->breakage_release, &e->rotation_constraint, &e->damping});
  auto& f = self.start_.structures;
  all.insert(all.end(), {&f.kinetic, &f.strain, &f.wall_work, &f.gravity_work,
                         &f.applied_work, &f.damping});
  return all;
}

template <class Self>
auto Installation::counts_of(Self& self)
{
  using Count = std::conditional_t<std::is_const_v<Self>, const std::size_t, std::size_t>;
  return std::vector<Count*>{
      &self.force_.n,        &self.last_.broken, &self.breakage_.all, &self.breakage_.near,
      &self.breakage_.above, &self.n_frames_,    &self.n_bonds_,      &self.n_between_};
}

void Installation::save(dem::State& state) const
{
  std::vector<double> numbers;
  for (const double* a : numbers_of(*this)) numbers.push_back(*a);
  std::vector<std::uint64_t> counts;
  for (const std::size_t* n : counts_of(*this)) counts.push_back(*n);
  state.add_common("pile_numbers", std::move(numbers));
  state.add_common("pile_counts", std::move(counts));
}

void Installation::load(const dem::State& state)
{
  const auto all = numbers_of(*this);
  const auto& numbers = state.get_rows<double>("pile_numbers", all.size());
  for (std::size_t k = 0; k < all.size(); ++k) *all[k] = numbers[k];
  const auto all_counts = counts_of(*this);
  const auto& counts = state.get_rows<std::uint64_t>("pile_counts", all_counts.size());
  for (std::size_t k = 0; k < all_counts.size(); ++k) *all_counts[k] = counts[k];
}

void Installation::space_records_anew()
{
  next_record_ = case_.record_every * (std::floor(travelled() / case_.record_every) + 1.0);
}

void Installation::space_frames_anew()
{
  n_frames_ = 1;
  while (n_frames_ < static_cast<std::size_t>(case_.frames) && next_frame() <= travelled())
    ++n_frames_;
}

} // namespace mergel::apps
