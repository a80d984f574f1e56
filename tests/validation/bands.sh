#!/usr/bin/env bash
# The paper's rock in a periodic cell of 5,000 particles, three packings: the bands of tests/validation/README.md,
# each with its source. Some half an hour on two cores.
#
# usage: tests/validation/bands.sh MERGEL [FOLDER]
#   FOLDER  takes the runs and keeps them; default a temporary one
set -euo pipefail
here=$(dirname "$(readlink -f "$0")")
mergel=$(readlink -f "$1")
if [ $# -gt 1 ]; then
  folder=$2
else
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
fi
FLOWS=published "$here/laboratory.sh" "$mergel" "$folder" bands fig15
n_failed=0

# band "CLAIM" TABLE COLUMN LOW HIGH ["COLUMN=VALUE"]: every value of the column, of the rows that match
band() {
  local verdict
  verdict=$(awk -F, -v name="$3" -v low="$4" -v high="$5" -v only="${6:-}" '
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; split(only, match_, "="); next }
    only && $at[match_[1]] + 0 != match_[2] + 0 { next }
    { v = $at[name]; text = text " " v; ++n; if (v == "nan" || v < low || v > high) bad = 1 }
    END { print (bad || !n ? "FAILED" : "holds "), text }' "$folder/$2.csv")
  echo "${verdict%% *}  $1, $4 to $5:${verdict#* }"
  [[ $verdict != FAILED* ]] || n_failed=$((n_failed + 1))
}

band "Young's modulus (paper, Table 4: 1.1 GPa)" bands "E [Pa]" 1.0e9 1.2e9
band "UCS of a cell without walls (paper: 3.6 MPa of a cylinder, which is some 5 % weaker)" bands "UCS [Pa]" 3.7e6 4.6e6
band "direct tension (Brazilian 2.2 MPa, which is 10 to 20 % above it)" bands "tensile strength [Pa]" 1.7e6 2.2e6
band "isotropic yield" bands "isotropic yield [Pa]" 6.2e6 7.4e6
band "p falls after it (paper, section 2.4)" bands "dip after it [Pa]" 5.4e6 6.7e6
band "p is that of the unbonded packing at 25 MPa" bands "p over unbonded at 25 MPa" 0.95 1.05
band "at 1 MPa q softens to its half (paper, Fig. 14b)" bands "minimum q at 1 MPa [Pa]" 1.6e6 2.6e6
band "at 1 MPa the peak of q" bands "peak q at 1 MPa [Pa]" 3.2e6 4.5e6
band "at 4 MPa q hardens far beyond its yield (paper, Fig. 14b)" bands "q at 18 % at 4 MPa [Pa]" 9e6 12e6
band "q/p at 18 % at 1 MPa" bands "q/p at 1 MPa" 1.35 1.50
band "q/p at 18 % at 4 MPa" bands "q/p at 4 MPa" 1.35 1.50
for p in 1 1.5 2.5 4 6; do # 34 degrees, paper, section 2.5
  band "friction angle after 20 % at $p MPa" fig15 "friction angle [degree]" 33 37 "confinement [MPa]=$p"
done

# Means over the packings: one of 5,000 particles scatters by 2 %.
spread=$(awk -F, 'NR > 1 { sum[$1] += $4; ++n[$1] }
  END { for (S in sum) { m = sum[S] / n[S]; if (!low || m < low) low = m; if (m > high) high = m } print high / low - 1 }' "$folder/bands_scale.csv")
# Critical states at 1 MPa and above; below, particles outside a shear band do not take part.
R2=$(awk -F, 'NR > 1 && $2 >= 1 { x = ($8 / 101325) ^ 0.7; y = $9; ++n; sx += x; sy += y; xx += x * x; xy += x * y; yy += y * y }
  END { c = n * xy - sx * sy; print c * c / ((n * xx - sx * sx) * (n * yy - sy * sy)) }' "$folder/fig15.csv")
for claim in "UCS is the same for S = 2, 5, 10 within 5 %|$spread < 0.05" "e is linear in (p/p_a)^0.7 (paper, Fig. 15c)|$R2 > 0.98"; do
  if awk "BEGIN { exit !(${claim#*|}) }"; then echo "holds   ${claim%|*}: ${claim#*|}"; else echo "FAILED  ${claim%|*}: ${claim#*|}"; n_failed=$((n_failed + 1)); fi
done

echo "$n_failed failed"
[ "$n_failed" -eq 0 ]
