#!/usr/bin/env bash
# mergel bond as a user runs it: every case of apps/cases balances its energy, repeats to the bit
# from its resolved case, and has the strengths of the paper (Table 1 left).
#
# usage: tests/program/one_bond.sh MERGEL
. "$(dirname "$0")/preamble.sh"
figure() { awk -F': ' -v name="\"$2\"" 'index($0, name) { print $2 + 0 }' "$1/summary.json"; }
# near VALUE EXPECTED RELATIVE
near() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(d <= e * (b < 0 ? -b : b)) }'; }
holds_nan() { grep -Eqi 'nan|inf|: null' "$1/history.csv" "$1/summary.json"; }

for case_file in "$root"/apps/cases/bond_*.prm; do
  run=$(basename "$case_file" .prm)
  "$mergel" bond "$case_file" --output "$run" >"$run.log" || fail "$run: $(cat "$run.log")"
  holds_nan "$run" && fail "$run holds a NaN"
  # Round-off (1e-13) while the bond acts. Where the contact closes within a step, the trapezoid of
  # the work counts the whole step: 4e-6 with these steps.
  awk -v e="$(figure "$run" "energy error [-]")" 'BEGIN { exit !(e < 1e-5) }' ||
    fail "$run: energy error $(figure "$run" "energy error [-]")"
done

base=bond_fig4a_tension
"$mergel" bond $base/resolved.prm --output again >again.log || fail "from resolved.prm: $(cat again.log)"
cmp $base/history.csv again/history.csv || fail "a run from its resolved case differs"
case_file=$root/apps/cases/$base.prm

# One load at a time: strength, motion at yield, and exp(-(u-u_y)/u_c) one softening length on.
single() # MODE, SET..., then COLUMN STRENGTH
{
  local mode=$1 key=$2 reach=$3 column=$4 strength=$5
  grep -v 'displacement \|rotation  ' "$case_file" | sed "s/= tension-bending/= $mode/" >"$mode.prm"
  sed -i "/subsection Bond/,/end/{/displacement\|rotation/d}" "$mode.prm"
  "$mergel" bond "$mode.prm" --output "$mode" --set "Bond/softening displacement=0.1 mm" \
    --set "Bond/softening rotation=1e-4 rad" --set "Loading/$key=$reach" \
    --set "Loading/steps per stage=1000" >"$mode.log" || fail "$mode: $(cat "$mode.log")"
  local last
  last=$(tail -1 "$mode/history.csv" | cut -d, -f"$column")
  near "$last" "$(awk -v s="$strength" 'BEGIN { printf "%.12g", s * exp(-1) }')" 1e-6 ||
    fail "$mode ends at $last, not at $strength/e"
}
single tension "normal displacement" "0.25 mm" 4 314.159265
single compression "normal displacement" "1.6 mm" 4 -3141.59265
single shear "shear displacement" "0.55 mm" 5 471.238898
single bending rotation "15.1e-3 rad" 6 0.785398163

# A path with a reversal, far outside the surface in one step, with a stage of no length.
cp "$root/apps/cases/bond_fig5b.prm" hard.prm
printf 'u_n [m],u_s [m],theta [rad]\n0,0,0\n-3e-3,5e-3,0.1\n-3e-3,5e-3,0.1\n1e-2,-5e-3,-0.1\n0,0,0' >bond_fig5b.csv
for n in 1 2 1000; do
  "$mergel" bond hard.prm --output "hard$n" --set "Loading/steps per stage=$n" >"hard$n.log" ||
    fail "hard path in $n steps: $(cat "hard$n.log")"
  holds_nan "hard$n" && fail "the hard path in $n steps holds a NaN"
  [ "$(tail -1 "hard$n/history.csv" | cut -d, -f7)" = 1 ] || fail "the hard path leaves the bond intact"
  [ "$(wc -l <"hard$n/history.csv")" -eq $((2 + 4 * n)) ] || fail "one line per step, the start and the header"
done

# The other law: brittle at sigma_c A.
sed -e 's/^  set \(compressive\|softening\|bending\).*//' "$case_file" |
  sed -e 's/= tension-bending/= tension/' -e '/set rotation/d' >parallel.prm
"$mergel" bond parallel.prm --set "Bond/bond law=parallel" --output parallel >parallel.log ||
  fail "parallel: $(cat parallel.log)"
near "$(figure parallel "largest tension [N]")" 314.159265 2.1e-3 || # one step of 1/500 of the elastic range
  fail "the parallel bond bears $(figure parallel "largest tension [N]") N"
[ "$(tail -1 parallel/history.csv | cut -d, -f7)" = 1 ] || fail "the parallel bond is not broken"
echo "one bond: all checks hold"
