#!/usr/bin/env bash
# The small pile installation, run twice: in the elastic far field and in rigid walls. Bands, each with its
# source; about six minutes on one core.
#
# usage: tests/validation/pile_small.sh MERGEL
. "$(dirname "$0")/../program/preamble.sh"
n_failed=0

"$mergel" pile "$case_file" --output elastic >elastic.log || { cat elastic.log; exit 1; }
sed "/^subsection Far field/,/^end/{/Young's modulus/d; /Poisson ratio/d; /K0/d}" "$case_file" >rigid.prm
"$mergel" pile rigid.prm --set "Specimen/file=elastic/sample.h5" --set "Far field/model=rigid" \
  --output rigid >rigid.log || { cat rigid.log; exit 1; }
sed -n '/^pile at/,$p' elastic.log rigid.log

found() { awk -F': ' -v key="\"$1\"" 'index($0, key) { sub(/,$/, "", $2); print $2 }' elastic/summary.json; }

# claim NAME AWK-CONDITION: holds for the numbers a, b, ...
claim()
{
  if awk "BEGIN { exit !($2) }"; then echo "holds   $1 ($2)"; else echo "FAILED  $1 ($2)"; n_failed=$((n_failed + 1)); fi
}

broken=$(found "broken between particles [-]")
claim "the energy is balanced to 1 % (dem/README.md, 14.)" "$(found "largest energy error [-]") < 0.01"
claim "the forces at the interface agree to round-off" "$(found "largest interface force error [-]") < 1e-12"
claim "the moments at the interface agree to round-off" "$(found "largest interface moment error [-]") < 1e-12"
claim "the rock is crushed" "$broken > 1000"
claim "damage stays near the pile: 90 % within 2 D_p of the axis (paper, Fig. 19c)" \
  "$(found "broken within 2 D_p of the axis [-]") > 0.9 * $broken"
# Paper, section 3: none above the shoulder at 6 D_p. At 2 D_p the heaving surface loses chips.
claim "few bonds break more than D_p above the shoulder" \
  "$(found "broken more than D_p above the shoulder [-]") < 0.03 * $broken"

# Cone resistance grows with depth and is of the order of cavity expansion, 3 to 15 times the UCS of some 4 MPa.
mean_q() { awk -F, -v from="$2" -v to="$3" 'NR > 1 && $3 >= from && $3 < to { s += $7; n++ } END { print s / n }' "$1"; }
claim "q_c between 1 and 2 D_p is 3 to 15 UCS" \
  "$(mean_q elastic/history.csv 1 2) > 12e6 && $(mean_q elastic/history.csv 1 2) < 60e6"
claim "q_c rises with depth" "$(mean_q elastic/history.csv 1 2) > $(mean_q elastic/history.csv 0 1)"
# Once bonds break, the two runs diverge: single particles, 4.7 to D_p, make the curves differ by 10 MPa at any one
# depth. That rigid walls are stiffer is tested where nothing breaks, in tests/program/end_to_end.sh.
echo "mean q_c from 0 to 2 D_p: elastic $(mean_q elastic/history.csv 0 2), rigid $(mean_q rigid/history.csv 0 2) Pa"

echo "$n_failed failed"
[ "$n_failed" -eq 0 ]
