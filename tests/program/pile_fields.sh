#!/usr/bin/env bash
# Continuum fields and profiles of a tiny pile: every file that a series names is there and says what it
# holds; the same bits on two ranks and after a restart; a stress that balances the head force.
#
# usage: tests/program/pile_fields.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
deep=("${tiny[@]}" --set "Pile/cone angle=120 degree" --set "Pile/final depth=2.3 mm" --set "Output/frames=4"
  --set "Output/checkpoint every=4000 steps")
guarded "$mergel" pile "$case_file" "${deep[@]}" --output a >log || fail "the run: $(tail -3 log)"

# Follow each series, and look into the heading of each file, which names type and arrays.
for series in particles bonds pile far_field fields contacts; do
  n=0
  while IFS= read -r file; do
    n=$((n + 1))
    [ -s "a/$file" ] || fail "$series.pvd names $file, which is not there"
    grep -aq '^<VTKFile type=' "a/$file" || grep -aq '<VTKFile type=' "a/$file" || fail "$file is no VTK file"
  done < <(grep -o 'file="[^"]*"' "a/$series.pvd" | cut -d'"' -f2)
  [ "$n" -eq 5 ] || fail "$series.pvd lists $n files, not 5"
done
has_arrays() { # FILE ARRAY...
  local file=$1 name
  shift
  for name in "$@"; do grep -aqF "Name=\"$name\"" "a/fields/$file" || fail "$file has no array $name"; done
}
has_arrays fields_0004.vti "stress [Pa]" "p [Pa]" "q [Pa]" "major principal stress [Pa]" "intermediate principal stress [Pa]" \
  "minor principal stress [Pa]" "major principal direction [-]" "porosity [-]" "damage [-]" "coordination [-]" \
  "displacement [m]" "displacement increment [m]" "volumetric strain of the increment [-]" "shear strain of the increment [-]"
has_arrays particles_0004.vtp "stress [Pa]" "displacement increment [m]" "shear strain of the increment [-]" \
  "volumetric strain of the increment [-]" "coordination [-]" "layer [-]"
has_arrays contacts_0004.vtp "normal force [N]" "shear force [N]"

# The profiles: their columns, a line of each frame, and values that can be.
# TABLE PROGRAM: awk over its lines, c(name) as in records()
lines() {
  awk -F, 'function c(name) { if (!(name in at)) { print "no column " name; exit 2 } return $at[name] + 0 }
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next } '"$2" "a/$1"
}
for table in tip_profile radial_profile; do
  n=$(lines $table.csv '{ print c("time [s]") }' | sort -u | wc -l)
  [ "$n" -eq 5 ] || fail "$table.csv has lines of $n frames, not of 5"
  lines $table.csv '{ n = c("porosity [-]"); e = c("void ratio [-]"); D = c("damage [-]")
    if (!(n > 0.1 && n < 0.8 && D >= 0 && D <= 1 && e / (1 + e) - n < 1e-9 && n - e / (1 + e) < 1e-9)) exit 1 }' ||
    fail "$table.csv has values that cannot be"
done
lines tip_profile.csv 'c("time [s]") == 0 { n += 1; sum += c("porosity [-]") }
  END { exit !(n > 0 && sum / n > 0.47 && sum / n < 0.57) }' || fail "the porosity before the penetration is not that of the case"
# Rings that stand still: the tip, with its points on the axis and beside it, passes the upper ones; stress below it.
lines stress_path.csv 'function low(a, b) { return a < b ? a : b }
  { n = c("porosity [-]"); h = c("height above the tip/D_p [-]"); top = h > top ? h : top; bottom = low(bottom, h)
    if (!(n > 0.1 && n < 0.8 && c("q [Pa]") >= 0)) exit 1 }
  END { exit !(top > 0.5 && bottom < -0.9) }' || fail "the paths do not tell of points that the tip passes"
[ "$(lines shaft_profile.csv 'END { print NR }')" -gt 1 ] || fail "no ring of the shaft is whole at 2.3 mm"
lines shaft_profile.csv '{ if (!(c("radial stress [Pa]") >= 0 && c("h/R [-]") > 0)) exit 1 }' || fail "the shaft is pulled"
for name in "averaging length" "d50 beside the pile" "void ratio below the tip" "p below the tip" \
  "angle of the major principal stress to the vertical below the tip" "minor principal stress at the shoulder" \
  "thinning of the diameter below the tip" "broken below the shoulder within 2 D_p of the tip" \
  "broken above the shoulder away from the shaft" "needle penetration index"; do
  grep -qF "\"$name" a/summary.json || fail "the summary has no $name"
done

# The rock below the tip is thinner than at the start, pressed from above; the index is head force over depth.
found() { sed -n "s/^ *\"$1\": \([^,]*\),*\$/\1/p" a/summary.json; }
awk -v t="$(found 'thinning of the diameter below the tip \[-\]')" \
  -v angle="$(found 'angle of the major principal stress to the vertical below the tip \[degree\]')" \
  'BEGIN { exit !(t > 0 && t < 1 && angle >= 0 && angle < 45) }' || fail "the rock below the tip is not pressed from above"
awk -v F="$(found 'head force of the full pile \[N\]')" -v d="$(found 'tip depth \[m\]')" \
  -v D="$(sed -n 's/^ *set diameter *= *\([0-9.]*\) mm.*/\1/p' a/resolved.prm | tail -1)" -v npi="$(found 'needle penetration index \[N\/mm\]')" \
  'BEGIN { print F, d, D, npi; e = F / (1e3 * d) * (0.84 / D) ^ 2; exit !(npi > 0.999 * e && npi < 1.001 * e) }' ||
  fail "the needle penetration index is not head force over depth"

# In a region of 6 mm across around a pile of 1.4 mm the outermost break is inside, and the log says how far from the far field.
awk -v d="$(found 'distance of the outermost break from the far field \[m\]')" 'BEGIN { exit !(d > -1e-4 && d < 3e-3) }' ||
  fail "the outermost break: $(grep outermost a/summary.json)"
grep -q 'the bond that broke closest to the far field was [0-9.]* mm from it (' log || fail "the outermost break is not said: $(cat log)"
if awk -v d="$(found 'distance of the outermost break from the far field over d50 there \[-\]')" 'BEGIN { exit !(d < 2) }'; then
  grep -q '^unusual: distance of the outermost break from the far field/d50' log || fail "a crushed zone at the far field is not said: $(cat log)"
else
  ! grep -q '^unusual: distance of the outermost break' log || fail "a crushed zone that is not there: $(cat log)"
fi

# The same bits on two ranks, and from a checkpoint in the middle.
on_ranks 2 "$mergel" pile "$case_file" "${deep[@]}" --output b >log || fail "two ranks: $(tail -3 log)"
cp -r a c
checkpoints=(c/checkpoint_*.h5)
[ "${#checkpoints[@]}" -ge 2 ] || fail "no checkpoint in the middle"
guarded "$mergel" pile --restart "${checkpoints[0]}" --output d >log || fail "the restart: $(tail -3 log)"
same_results a b d

# A longer averaging length makes fewer points; one below 1 is refused.
code=$(code_of "$mergel" pile "$case_file" --set "Output/averaging length=0.5" --output e)
[ "$code" -eq 1 ] && grep -q 'averaging length' log && [ ! -e e ] || fail "an averaging length of 0.5: $code $(cat log)"
echo "pile fields: all checks hold"
