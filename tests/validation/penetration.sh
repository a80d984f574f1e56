#!/usr/bin/env bash
# A membrane sinks into the surface of a dense packing without bonds within a factor of 2 of Baldi and Nova
# (1984), J. Geotech. Eng. 110(3), 403-420:
#
#   eps_v = d/(2 D) (sigma_3 d/(E t))^(1/3)
#
# d the particles' diameter, D the specimen's, E t the membrane's stiffness. Their zero is a membrane without
# pressure that touches every particle of the surface. A packing made against a wall has particles that do not
# reach it, and the first touch sinks in by as much as the whole rest. So the strain counts from a small pressure,
# as in the laboratory, and so does the formula: from sigma_3 d/(E t) = 0.01 to 0.1 and to 0.3, and from 0.1 to 0.3.
#
# usage: tests/validation/penetration.sh MERGEL [SETTING...]
. "$(dirname "$0")/../program/preamble.sh"
. "$root/tests/program/results.sh"
shift
options=()
for setting in "$@"; do options+=(--set "$setting"); done
bounded "$mergel" triaxial "$root/tests/validation/penetration.prm" "${options[@]}" --output a >a.log 2>&1 || fail "the run: $(tail -5 a.log)"
[ "$(grep -c '^stage [0-9]*, .*: target reached' a.log)" -eq 2 ] || fail "two stages: $(tail -5 a.log)"
# d50 by mass of penetration.prm, D, E t
records a 'BEGIN { d = 0.507e-3; D = 6e-3; Et = 420 }
  function formula(p) { return d / (2 * D) * (p * d / Et) ^ (1 / 3) }
  NR == 2 { p[0] = c("cell pressure [Pa]") }
  { k = c("stage [-]"); p[k] = c("cell pressure [Pa]"); e[k] = c("membrane penetration [-]")
    if (abs(c("energy error [-]")) > 1e-3) bad = 1 }
  function compare(i, j,   ratio) {
    ratio = (e[j] - e[i]) / (formula(p[j]) - formula(p[i]))
    printf "sigma_3 d/(E t) %.3f to %.3f: penetration %.3f %%, Baldi and Nova %.3f %%, ratio %.2f\n", p[i] * d / Et,
      p[j] * d / Et, 100 * (e[j] - e[i]), 100 * (formula(p[j]) - formula(p[i])), ratio
    if (!(ratio > 0.5 && ratio < 2)) bad = 1 }
  END { e[0] = 0; compare(0, 1); compare(0, 2); compare(1, 2); exit bad }' || fail "beyond a factor of 2"
echo "penetration: within a factor of 2 of Baldi and Nova"
