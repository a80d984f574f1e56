#!/usr/bin/env bash
# A tiny coupled installation from start to end: its files, the same bits when repeated or run
# from its own sample and resolved case; rigid walls stiffer than the far field.
#
# usage: tests/program/end_to_end.sh MERGEL
. "$(dirname "$0")/preamble.sh"

# Some 540 particles in a region of 6 x 6 mm, penetrated until the tip is 1.7 mm deep.
tiny=(--set "Specimen/diameter=6 mm" --set "Specimen/height=6 mm" --set "Specimen/inner upscaling=5"
  --set "Specimen/outer radius=3 mm" --set "Far field/chamber diameter=12 mm"
  --set "Far field/chamber height=12 mm" --set "Output/frames=2" --set "Motion/unbalanced-force tolerance=1e-3")
punch=("${tiny[@]}")
tiny+=(--set "Pile/final depth=0.5 mm")
case_file=$root/apps/cases/pile_small.prm

"$mergel" pile "$case_file" "${tiny[@]}" --output a >a.log || fail "the run: $(cat a.log)"
for file in history.csv summary.json resolved.prm sample.h5 particles.pvd bonds.pvd pile.pvd \
  far_field.pvd fields/particles_0002.vtp fields/bonds_0002.vtp fields/pile_0002.vtp \
  fields/far_field_0002.vtu; do
  [ -s "a/$file" ] || fail "a/$file is missing"
done
head -1 a/history.csv | grep -q '^time \[s\],depth \[m\],depth/D_p \[-\],tip depth \[m\],' ||
  fail "the header of history.csv"
[ "$(wc -l <a/history.csv)" -gt 150 ] || fail "a line every 0.01 mm of 1.7 mm travel"
grep -q 'largest energy error' a.log || fail "the closing summary"

# The stress at the start, after settling. A surcharge of 100 kPa adds as much to the vertical stress in the middle,
# within what a box of a few particles scatters.
grep -q '^stress at the start, in the middle of the specimen: p ' a.log || fail "the stress at the start is not said: $(cat a.log)"
"$mergel" pile "$case_file" "${punch[@]}" --set "Pile/final depth=0.05 mm" --set "Far field/surcharge=100 kPa" --output loaded >loaded.log ||
  fail "with a surcharge: $(cat loaded.log)"
awk -F'[:,]' -v a="$(grep '"stress z at the start' a/summary.json)" '/"stress z at the start/ { split(a, of_a); print "vertical stress at the start: " of_a[2] + 0 " Pa, under a surcharge of 100 kPa " $2 + 0 " Pa"
  more = $2 - of_a[2]; exit !(more > 40e3 && more < 160e3) }' loaded/summary.json || fail "the stress under a surcharge: $(cat loaded.log)"

# Repeated from its own resolved case and from its own sample: the same bits.
"$mergel" pile a/resolved.prm --output b >b.log || fail "from resolved.prm: $(cat b.log)"
cmp a/history.csv b/history.csv || fail "a repeated run differs"
cmp <(case_of a) <(case_of b) || fail "the resolved case of a resolved case differs"
"$mergel" pile "$case_file" "${tiny[@]}" --set "Specimen/file=a/sample.h5" --output c >c.log ||
  fail "from the sample: $(cat c.log)"
cmp a/history.csv c/history.csv || fail "a run from the written sample differs"
"$mergel" sample "$case_file" "${tiny[@]}" --output d >d.log || fail "mergel sample: $(cat d.log)"
"$mergel" pile "$case_file" "${tiny[@]}" --set "Specimen/file=d/sample.h5" --output e >e.log ||
  fail "from mergel sample: $(cat e.log)"
cmp a/history.csv e/history.csv || fail "a run from mergel sample differs"

# Energy: the largest error of the balance is in the summary and below 1 %.
/usr/bin/env awk -F'[:,]' '/largest energy error/ { exit !($2 < 0.01) }' a/summary.json ||
  fail "the energy error exceeds 1 %"

# An earlier run is kept without --overwrite; with it only files of mergel are removed.
if "$mergel" pile "$case_file" "${tiny[@]}" --output a >f.log 2>&1; then fail "an earlier run was replaced"; fi
echo mine >a/notes.txt
"$mergel" pile "$case_file" "${tiny[@]}" --output a --overwrite \
  --set "Specimen/file=c/sample.h5" >g.log || fail "with --overwrite: $(cat g.log)"
[ "$(cat a/notes.txt)" = mine ] || fail "--overwrite touched a file that is not ours"

# A folder of the user, with a history of his own, is refused with and without --overwrite.
mkdir mine
echo mine >mine/history.csv
for option in "" --overwrite "--restart mine"; do
  # shellcheck disable=SC2086
  if "$mergel" pile "$case_file" "${tiny[@]}" --output mine $option >m.log 2>&1; then fail "a folder of the user was taken: $option"; fi
  grep -q '^output folder mine: holds history.csv, and no run of mergel that has written it' m.log || fail "a folder of the user: $(cat m.log)"
done
[ "$(cat mine/history.csv)" = mine ] && [ "$(ls -A mine)" = history.csv ] || fail "a folder of the user was changed: $(ls -A mine)"

# Rigid walls are stiffer than the far field: a blunt punch on an assembly that cannot break, same travel.
punch+=(--set "Specimen/file=c/sample.h5" --set "Bond/tensile strength=1e6 MPa"
  --set "Bond/compressive strength=1e6 MPa" --set "Bond/shear strength=1e6 MPa" --set "Pile/diameter=3 mm"
  --set "Pile/cone angle=170 degree" --set "Pile/final depth=0.02 mm" --set "Pile/penetration rate=0.5 m/s")
"$mergel" pile "$case_file" "${punch[@]}" --output soft >h.log || fail "the punch: $(cat h.log)"
# Held walls have no modulus and no stress: a case that gives them is refused (tests/unit/apps/void_keys.cc).
sed "/^subsection Far field/,/^end/{/Young's modulus/d; /Poisson ratio/d; /K0/d}" "$case_file" >rigid.prm
"$mergel" pile rigid.prm "${punch[@]}" --set "Far field/model=rigid" --output hard >i.log ||
  fail "the punch in rigid walls: $(cat i.log)"
for run in soft hard; do
  grep -q '"bonds broken \[-\]": 0,' $run/summary.json || fail "a bond broke under the punch"
done
last_force() { tail -1 "$1/history.csv" | cut -d, -f5; }
awk -v hard="$(last_force hard)" -v soft="$(last_force soft)" 'BEGIN { exit !(hard > 1.02 * soft && soft > 0) }' ||
  fail "rigid walls are not stiffer: $(last_force hard) N, far field $(last_force soft) N"

echo "end to end: all checks hold; punch in the far field $(last_force soft) N, in rigid walls $(last_force hard) N"
