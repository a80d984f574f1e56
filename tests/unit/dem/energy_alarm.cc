// The alarm of the energy error.
#include "tests/support/catch.h"

#include "dem/assembly/energy_balance.h"

using namespace mergel::dem;

namespace {

/// A record of an assembly that took in much more than it stored at the start [J].
bool raises(EnergyAlarm& alarm, double error, double time = 0.0)
{
  return alarm.add(error, time, 1.0, 0.0);
}

} // namespace

TEST_CASE(
    "The energy alarm is raised by a large error, of either sign, and keeps the first "
    "record",
    "[unit][dem]")
{
  constexpr double large = EnergyAlarm::large;
  EnergyAlarm alarm;
  CHECK_FALSE(raises(alarm, 0.9 * large, 1.0)); // no record before it
  CHECK_FALSE(alarm.is_raised());
  CHECK(raises(alarm, -1.1 * large, 2.0));
  CHECK(alarm.is_raised());
  CHECK(alarm.first_error == 1.1 * large);
  CHECK(alarm.first_time == 2.0);
  CHECK_FALSE(raises(alarm, 20.0 * large, 3.0)); // once
  CHECK(alarm.first_error == 1.1 * large);
  CHECK(alarm.first_time == 2.0);
}

TEST_CASE(
    "The energy alarm is raised by a tenfold rise from one record to the next, but not "
    "within the noise",
    "[unit][dem]")
{
  EnergyAlarm steady, noisy, rising;
  for (const double error : {1e-6, 8e-6, 5e-5}) CHECK_FALSE(raises(steady, error));
  for (const double error : {0.0, 1e-9, 9e-6, 1e-8}) CHECK_FALSE(raises(noisy, error));
  CHECK_FALSE(raises(rising, 2e-6, 1.0));
  CHECK(raises(rising, -2.1e-5, 2.0));
  CHECK(rising.first_error == 2.1e-5);
}

TEST_CASE(
    "The energy alarm waits until the input is ten times what was stored at the start",
    "[unit][dem]")
{
  EnergyAlarm alarm;
  CHECK_FALSE(alarm.add(0.005, 1.0, 9.9, 1.0));
  CHECK(alarm.before == 0.0);                  // the next record does not rise from it
  CHECK_FALSE(alarm.add(0.5, 1.5, 10.1, 1.0)); // that stops the run
  CHECK(alarm.add(0.005, 2.0, 10.1, 1.0));
  CHECK(alarm.first_time == 2.0);
}
