/// Saving and loading a Brazilian test: each number by its name.
#include "coupling/brazilian/brazilian_test.h"
#include "dem/io/state/energy_numbers.h"
#include "dem/io/state/named_rows.h"
#include "dem/io/state/stage_numbers.h"

namespace mergel::coupling {

namespace {

template <class State>
dem::NumbersOf<State> numbers_of(State& s)
{
  dem::NumbersOf<State> all{
      {"distance of the plates before the test [m]", &s.gap_0},
      {"diametral strain since the record [-]", &s.since_record},
      {"sum of forces on the upper plate since the record [N]", &s.top_sum},
      {"sum of forces on the lower plate since the record [N]", &s.bottom_sum},
      {"gross work [J]", &s.gross_work},
      {"work at the record [J]", &s.last_work},
      {"stiffness before the test [Pa]", &s.stiffness},
      {"density of the rock [kg/m3]", &s.density}};
  dem::append_energies(all, "start: ", s.start);
  dem::append_alarm(all, s.alarm);
  return all;
}

template <class State>
dem::CountsOf<State> counts_of(State& s)
{
  return {{"steps since the record", &s.n_sum}};
}

template <class Point>
dem::NumbersOf<Point> numbers_of_point(Point& p)
{
  return {{"diametral strain [-]", &p.strain},
          {"load [N]", &p.load},
          {"difference of the plate forces [N]", &p.difference},
          {"contact half-angle [rad]", &p.half_angle},
          {"half-angle of all contacts [rad]", &p.outermost},
          {"stress across at the centre [Pa]", &p.across},
          {"stress along at the centre [Pa]", &p.along},
          {"energy error [-]", &p.energy_error}};
}

template <class Point>
dem::CountsOf<Point> counts_of_point(Point& p)
{
  return {{"broken bonds", &p.broken}};
}

template <class Break>
dem::NumbersOf<Break> numbers_of_break(Break& b)
{
  dem::NumbersOf<Break> all{{"radius [m]", &b.radius},
                            {"distance to the nearer plate [m]", &b.to_plate},
                            {"diametral strain [-]", &b.strain},
                            {"load [N]", &b.load}};
  dem::append_vector(all, "place", "[m]", b.x);
  dem::append_vector(all, "normal", "[-]", b.n);
  return all;
}

template <class Break>
dem::CountsOf<Break> counts_of_break(Break& b)
{
  return {{"step", &b.step},
          {"first particle", &b.first},
          {"second particle", &b.second},
          {"mode", &b.mode, dem::BreakMode::bending}};
}

} // namespace

void BrazilianTest::save(dem::State& state) const
{
  dem::save_numbers(state, "brazilian_numbers", numbers_of(state_));
  dem::save_counts(state, "brazilian_counts", counts_of(state_));
  dem::save_number_rows(state, "point_numbers", points_,
                        [](auto& p) { return numbers_of_point(p); });
  dem::save_count_rows(state, "point_counts", points_,
                       [](auto& p) { return counts_of_point(p); });
  dem::save_number_rows(state, "break_numbers", breaks_,
                        [](auto& b) { return numbers_of_break(b); });
  dem::save_count_rows(state, "break_counts", breaks_,
                       [](auto& b) { return counts_of_break(b); });
}

std::vector<BrazilianPoint> BrazilianTest::load_points(const dem::State& state)
{
  auto points = dem::load_count_rows<BrazilianPoint>(
      state, "point_counts", [](auto& p) { return counts_of_point(p); });
  if (points.empty()) dem::State::refuse("point_counts", "has no record");
  dem::load_number_rows(state, "point_numbers", points,
                        [](auto& p) { return numbers_of_point(p); });
  return points;
}

void BrazilianTest::load(const dem::State& state)
{
  dem::load_numbers(state, "brazilian_numbers", numbers_of(state_));
  dem::load_counts(state, "brazilian_counts", counts_of(state_));
  points_ = load_points(state);
  breaks_ = dem::load_count_rows<DiscBreak>(state, "break_counts",
                                            [](auto& b) { return counts_of_break(b); });
  dem::load_number_rows(state, "break_numbers", breaks_,
                        [](auto& b) { return numbers_of_break(b); });
}

} // namespace mergel::coupling
