#include "coupling/triaxial/specimen_bands.h"

#include "dem/io/state/named_rows.h"
#include "dem/io/state/stage_numbers.h"
#include "dem/io/state/state_rows.h"
#include "dem/parallel/rows.h"

#include <cmath>
#include <utility>

namespace mergel::coupling {

using dem::Vec3;

namespace {

template <class Numbers, class Slab>
void append_slab(Numbers& all, const std::string& name, Slab& s)
{
  dem::append_vector(all, name + ": normal", "[-]", s.normal);
  all.push_back({name + ": first face [m]", &s.from});
  all.push_back({name + ": last face [m]", &s.to});
  all.push_back({name + ": share [-]", &s.share});
  all.push_back({name + ": even share [-]", &s.even});
}

template <class Numbers, class Found>
void append_localisation(Numbers& all, const std::string& name, Found& l)
{
  append_slab(all, name + ", band", l.band);
  append_slab(all, name + ", of ten", l.of_ten);
  append_slab(all, name + ", second", l.second);
}

template <class Record>
dem::NumbersOf<Record> numbers_of(Record& r)
{
  dem::NumbersOf<Record> all{{"time [s]", &r.time},
                             {"axial strain [-]", &r.axial_strain},
                             {"increment of the axial strain [-]", &r.increment}};
  append_localisation(all, "shear", r.shear);
  append_localisation(all, "increment of shear", r.shear_increment);
  append_localisation(all, "compaction", r.compaction);
  append_localisation(all, "increment of compaction", r.compaction_increment);
  return all;
}

template <class Record>
dem::CountsOf<Record> counts_of(Record& r)
{
  return {{"stage", &r.stage}};
}

std::vector<Vec3> positions_in(const dem::State& state, const char* name, std::size_t n)
{
  const auto& rows = state.get_rows<double>(name, n, 3);
  std::vector<Vec3> x;
  for (std::size_t k = 0; k < rows.size(); k += 3) x.push_back(dem::vec_at(rows, k));
  return x;
}

void save_positions(dem::State& state, const char* name, const std::vector<Vec3>& x)
{
  std::vector<double> rows;
  for (const Vec3& a : x) dem::append(rows, a);
  state.add_common(name, std::move(rows), 3);
}

/// What `measure` says of each fit.
template <class Measure>
std::vector<double> each(const std::vector<dem::DeformationFit>& fits, Measure&& measure)
{
  std::vector<double> values;
  for (const dem::DeformationFit& fit : fits) values.push_back(measure(fit.F));
  return values;
}

} // namespace

void save(dem::State& state, const std::vector<BandRecord>& records)
{
  dem::save_number_rows(state, "band_numbers", records,
                        [](auto& r) { return numbers_of(r); });
  dem::save_count_rows(state, "band_counts", records, [](auto& r) { return counts_of(r); });
}

std::vector<BandRecord> load_band_records(const dem::State& state)
{
  auto records = dem::load_count_rows<BandRecord>(state, "band_counts",
                                                  [](auto& r) { return counts_of(r); });
  dem::load_number_rows(state, "band_numbers", records,
                        [](auto& r) { return numbers_of(r); });
  return records;
}

EarlierPositions::EarlierPositions(double every, double axial_strain, std::vector<Vec3> x)
    : every_(every)
{
  begin_stage(axial_strain, std::move(x));
}

EarlierPositions::EarlierPositions(double every, const dem::State& state,
                                   std::size_t n_particles)
    : every_(every)
{
  const auto& strains = state.get_rows<double>("earlier_strains", 2);
  older_ = {strains[0], positions_in(state, "older_x", n_particles)};
  newer_ = {strains[1], positions_in(state, "newer_x", n_particles)};
}

void EarlierPositions::begin_stage(double axial_strain, std::vector<Vec3> x)
{
  newer_ = {axial_strain, std::move(x)};
  older_ = newer_;
}

bool EarlierPositions::is_due(double axial_strain) const
{
  return std::abs(axial_strain - newer_.axial_strain) >= every_;
}

void EarlierPositions::add(double axial_strain, std::vector<Vec3> x)
{
  older_ = std::exchange(newer_, {axial_strain, std::move(x)});
}

const EarlierPositions::Positions& EarlierPositions::reference(double axial_strain) const
{
  const bool is_far = std::abs(axial_strain - newer_.axial_strain) >= 0.5 * every_;
  return is_far ? newer_ : older_;
}

const std::vector<Vec3>& EarlierPositions::x(double axial_strain) const
{
  return reference(axial_strain).x;
}

double EarlierPositions::increment(double axial_strain) const
{
  return std::abs(axial_strain - reference(axial_strain).axial_strain);
}

void EarlierPositions::save(dem::State& state) const
{
  state.add_common<double>("earlier_strains", {older_.axial_strain, newer_.axial_strain});
  save_positions(state, "older_x", older_.x);
  save_positions(state, "newer_x", newer_.x);
}

LocalStrains local_strains(const std::vector<Vec3>& x_0, const std::vector<Vec3>& earlier,
                           const dem::Particles& p)
{
  return {dem::local_deformations(x_0, p), dem::local_deformations(earlier, p)};
}

LocalStrains gather_on_first_rank(const LocalStrains& mine, const dem::Assembly& assembly)
{
  const auto gathered = [&](const std::vector<dem::DeformationFit>& fits) {
    return dem::gather_rows(assembly.comm, assembly.partition, fits, 0);
  };
  return {gathered(mine.total), gathered(mine.increment)};
}

BandRecord find_bands(const std::vector<Vec3>& x, const LocalStrains& strains, double d_50)
{
  const auto found = [&](const std::vector<dem::DeformationFit>& fits, auto&& measure) {
    return dem::localise(x, each(fits, measure), d_50);
  };
  BandRecord r;
  r.shear = found(strains.total, dem::shear_strain);
  r.shear_increment = found(strains.increment, dem::shear_strain);
  r.compaction = found(strains.total, dem::volumetric_strain);
  r.compaction_increment = found(strains.increment, dem::volumetric_strain);
  return r;
}

} // namespace mergel::coupling
