#include "apps/run/step_report.h"

#include "dem/text.h"

#include <algorithm>
#include <cstdio>

namespace mergel::apps {

std::string alarm_text(const dem::EnergyAlarm& alarm)
{
  char text[256];
  std::snprintf(text, sizeof text,
                "the energy error has risen to %.2g at t = %.4g ms: the time step may be "
                "too large; compare with a run at a lower `Motion/time step safety`\n",
                alarm.first_error, 1e3 * alarm.first_time);
  return text;
}

std::string report(const dem::StepSpec& step, const dem::StableStep& stable, double dt,
                   const dem::Particles& p)
{
  char text[96];
  std::snprintf(text, sizeof text, "time step %.3g s, %.3g of the stable one, ruled by ",
                dt, dt / stable.limit);
  std::string lines =
      dem::report(dem::scaled_zones(p)) + text + dem::what_rules(stable) + '\n';
  if (step.safety > 1.0)
    lines += "Motion/time step safety = " + dem::shortest(step.safety) +
             ": the step is beyond the stable one, and the run will go unstable\n";
  return lines;
}

void add_step(Summary& summary, const dem::StableStep& stable, double dt)
{
  summary.number("time step [s]", dt);
  summary.number("stable step [s]", stable.limit);
  summary.text("the step is ruled by", dem::what_rules(stable));
  summary.count("evaluations of the largest frequency [-]", stable.n_evaluations);
}

void add_mass_scaling(Summary& summary, const dem::Particles& p)
{
  const std::vector<dem::ScaledZone> zones = dem::scaled_zones(p);
  if (zones.empty()) return;
  const dem::ScaledZone all = sum_of(zones);
  summary.count("particles with added mass [-]", all.n_scaled);
  summary.number("added mass over true mass [-]", all.share());
  double largest = 0.0;
  for (const dem::ScaledZone& z : zones) largest = std::max(largest, z.share());
  summary.number("the same of the zone that gained most [-]", largest);
}

void add_alarm(Summary& summary, const dem::EnergyAlarm& alarm)
{
  if (!alarm.is_raised()) return;
  summary.number("energy error of the alarm [-]", alarm.first_error);
  summary.number("time of the alarm [s]", alarm.first_time);
  summary.closing << alarm_text(alarm);
}

} // namespace mergel::apps
