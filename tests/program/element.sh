#!/usr/bin/env bash
# Small element tests from start to end: their files, the same bits from the resolved case, moduli and
# energy balance in the summary, failure of a specimen as a result, and loading stages that are refused.
#
# usage: tests/program/element.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
case_file=$root/apps/cases/element_small.prm
# STAGE1 STAGE2 STAGE3 STAGE4 OUTPUT [options]
run() {
  local stages=(--set "Loading/stage 1=$1" --set "Loading/stage 2=$2" --set "Loading/stage 3=$3" --set "Loading/stage 4=$4")
  local out=$5
  shift 5
  "$mergel" element "$case_file" --set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" --set "Specimen/edge z=3.9 mm" "${stages[@]}" "$@" --output "$out" >"$out.log" 2>&1
}

run "isotropic to p = 1 MPa" "triaxial to axial strain = 0.3 %" "unload-reload to q = 1 MPa" \
  "resume to axial strain = 0.6 %" a || fail "the run: $(cat a.log)"
for file in history.csv summary.json resolved.prm; do [ -s "a/$file" ] || fail "a/$file is missing"; done
[ "$(grep -c '"outcome": "target reached"' a/summary.json)" -eq 5 ] || fail "five stages end at their targets"
# They have the numbers of the case in all results: the loop is stage 3, in two parts.
stages=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  { s = $at["stage [-]"] "." $at["part [-]"]; if (s != before) printf "%s ", s; before = s }' a/history.csv)
[ "$stages" = "1.0 2.0 3.1 3.2 4.0 " ] || fail "the stages of history.csv: $stages"
[ "$(grep -o '"number": "[^"]*"' a/summary.json | cut -d'"' -f4 | tr '\n' ' ')" = "1 2 3a 3b 4 " ] || fail "the stages of summary.json"
grep -q '"stage": "unload-reload to q = 1 MPa, reloading"' a/summary.json || fail "the words of stage 3b"
grep -q '^stage 3a, unload-reload to q = 1 MPa, unloading: target reached' a.log && grep -q '^stage 4, resume to' a.log ||
  fail "the stages of the log: $(cat a.log)"
# The rock of the paper has E = 1.1 GPa; with 400 particles it scatters by a tenth.
within a "Young's modulus" 0.9e9 1.4e9
within a "bulk modulus" 0.45e9 0.8e9
# Allowed are 1e-3 of the work; measured 2e-5.
within a "largest energy error" 0 2e-4
# Lateral stress is held within 1 % in the mean of the second stage.
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  $at["stage [-]"] == 2 { x += $at["lateral stress x [Pa]"]; y += $at["lateral stress y [Pa]"]; ++n }
  END { exit !(n > 10 && x / n > 0.99e6 && x / n < 1.01e6 && y / n > 0.99e6 && y / n < 1.01e6) }' a/history.csv ||
  fail "the lateral stress is not held"
# A stage accelerates slowly enough for the servo. At a tenth of the reference pressure the lateral stresses
# stay within 3 % at every record of the elastic part; measured 1.8 %, with a ramp of 300 steps 6.3 %.
run "isotropic to p = 0.1 MPa" "triaxial to axial strain = 0.15 %" "" "" slow --set "Output/record every=2e-5" || fail "at 100 kPa: $(cat slow.log)"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  $at["stage [-]"] == 2 { for (s = 0; s < 2; ++s) { d = $at["lateral stress " (s ? "x" : "y") " [Pa]"] / 1e5 - 1; if (d < 0) d = -d; if (d > most) most = d } ++n }
  END { print "sides at 100 kPa: within " 100 * most " %"; exit !(n > 50 && most < 0.03) }' slow/history.csv ||
  fail "the lateral stresses are not held while a stage accelerates"
head -1 a/history.csv | awk -F, '{ n = NF } END { exit !(n == 58) }' || fail "the header of history.csv"

"$mergel" element a/resolved.prm --output b >b.log || fail "from resolved.prm: $(cat b.log)"
cmp a/history.csv b/history.csv || fail "a repeated run differs"
cmp <(case_of a) <(case_of b) || fail "the resolved case of a resolved case differs"

# mergel sample makes the specimen of this case, and a test that reads it has the same bits.
"$mergel" sample a/resolved.prm --output rock >rock.log || fail "the specimen: $(cat rock.log)"
"$mergel" element a/resolved.prm --set "Specimen/file=rock/sample.h5" --output read >read.log || fail "of a sample: $(cat read.log)"
cmp a/history.csv read/history.csv || fail "a test that reads its specimen differs"

# Strengths scale with the width by Eq. 18; bonds are brittle, so that the peak follows the strengths.
run "compression to axial strain = 0.7 %" "" "" "" c || fail "compression: $(cat c.log)"
run "compression to axial strain = 0.7 %" "" "" "" d --set "Size effect/size effect=true" \
  --set "Size effect/specimen width=10 mm" --set "Size effect/reference width=50 mm" --set "Size effect/psi=1.1" || fail "size effect: $(cat d.log)"
grep -q 'times 1.47' d.log || fail "psi (50/10)^0.18 = 1.47 is printed: $(head -2 d.log)"
within c "UCS" 3e6 6e6
awk -v c="$(value c UCS)" -v d="$(value d UCS)" 'BEGIN { exit !(d > 1.2 * c && d < 1.6 * c) }' ||
  fail "UCS $(value c UCS), with the size effect $(value d UCS)"

# Pictures: the start and the end of each of the five stages, and no more.
[ "$(ls a/fields | wc -l)" -eq 18 ] && [ "$(grep -c '<DataSet' a/particles.pvd)" -eq 6 ] &&
  [ "$(grep -c '<DataSet' a/bonds.pvd)" -eq 6 ] && [ "$(grep -c '<DataSet' a/contacts.pvd)" -eq 6 ] || fail "six pictures: $(ls a/fields)"
for field in radius damage displacement "stress [Pa]" "strain rate [1/s]" "coordination [-]"; do
  grep -aqF "Name=\"$field\"" a/fields/particles_0005.vtp || fail "no $field in the picture of the particles"
done
! grep -aq 'Name="strength"' a/fields/particles_0005.vtp || fail "strengths are shown that do not vary"
# 0.7 % in steps of 0.2 %, the start and the end.
run "compression to axial strain = 0.7 %" "" "" "" pictures --set "Output/pictures=strain" \
  --set "Output/picture every=0.002" --set "Strength variability/distribution=log-normal" \
  --set "Strength variability/coefficient of variation=0.3" || fail "pictures by strain: $(cat pictures.log)"
[ "$(ls pictures/fields/particles_* | wc -l)" -eq 5 ] || fail "five pictures: $(ls pictures/fields)"
grep -aq 'Name="strength"' pictures/fields/particles_0000.vtp || fail "no strength in the picture of the particles"
# Weaker particles yield first: the peak is lower and rounder than with equal strengths.
grep -q 'strengths vary: log-normal, seed 1; .*coefficient of variation 0\.[23]' pictures.log ||
  fail "the strengths drawn are not reported: $(head -4 pictures.log)"
awk -v c="$(value c UCS)" -v d="$(value pictures UCS)" 'BEGIN { exit !(d < c && d > 0.7 * c) }' ||
  fail "UCS $(value c UCS), with strengths that vary $(value pictures UCS)"
run "compression to axial strain = 0.1 %" "" "" "" bare --set "Output/pictures=none" || fail "no pictures: $(cat bare.log)"
[ ! -e bare/fields ] && [ ! -e bare/particles.pvd ] || fail "pictures in spite of pictures = none"

# A specimen that fails in tension and a path that cannot be followed are results, not errors.
run "tension to axial strain = -6 %" "" "" "" e --set "Bond/softening displacement=0.0004 mm" \
  --set "Bond/softening rotation=0.004 rad" || fail "tension: $(cat e.log)"
grep -q 'failed in tension' e/summary.json || fail "failure in tension is not reported: $(tail -5 e.log)"
within e "tensile strength" 1e6 3e6
run "isotropic to p = 0.5 MPa" "triaxial to q = 12 MPa" "compression to axial strain = 1 %" "" f ||
  fail "beyond the peak: $(cat f.log)"
grep -q 'unstable point' f/summary.json || fail "an unstable path is not reported: $(tail -5 f.log)"
[ "$(grep -c '"stage":' f/summary.json)" -eq 2 ] || fail "the test went on after it failed"

# Lateral axes that cannot bear their tension fail as a pulled axis does.
run "triaxial at -3 MPa to axial strain = 1 %" "" "" "" h --set "Bond/softening displacement=0.0004 mm" \
  --set "Bond/softening rotation=0.004 rad" || fail "lateral tension: $(cat h.log)"
grep -q 'failed in tension' h/summary.json || fail "failure of the lateral axes is not reported: $(tail -5 h.log)"
# They fail in the approach: all bonds that broke are said to have broken there.
broken=$(value h "bonds broken in the approach")
[ "$broken" -gt 20 ] && [ "$broken" -eq "$(value h "bonds broken [-]")" ] &&
  grep -q "^stage 1: $broken bonds broke in the approach" h.log ||
  fail "$broken bonds broke in the approach: $(tail -6 h.log)"
# Results of a stage include the stages that resume it: the strength is that of the last of three.
run "compression to axial strain = 0.2 %" "unload-reload to axial stress = 0.5 MPa" \
  "resume to axial strain = 0.7 %" "" i || fail "unloaded and reloaded: $(cat i.log)"
awk -v c="$(value c UCS)" -v i="$(value i UCS)" 'BEGIN { exit !(i > 0.97 * c && i < 1.03 * c) }' ||
  fail "UCS $(value c UCS), with unloading $(value i UCS)"
# An unloading that would be a loading is known only where it begins; another stage goes on from there.
code=0
run "isotropic to p = 0.5 MPa" "triaxial to axial strain = 0.1 %" "unload to q = 9 MPa" "" up \
  --set "Output/checkpoint every=200 steps" || code=$?
[ "$code" -eq 2 ] && grep -q 'stage 3, unload to q = 9 MPa: q is .* MPa where it begins, .*another `Loading/stage 3`' up.log ||
  fail "an unloading to more: $code $(tail -3 up.log)"
"$mergel" element --restart up --set "Loading/stage 3=unload to q = 0.2 MPa" >log 2>&1 || fail "another stage: $(tail -3 log)"
# The controlled stress of a stage is approached first, and its strain counts from there.
run "isotropic to p = 1 MPa" "triaxial at 0.5 MPa to axial strain = 0.1 %" "" "" j || fail "approach: $(cat j.log)"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  $at["stage [-]"] == 2 && $at["axial strain of the stage [-]"] > 2e-4 {
    s = $at["lateral stress x [Pa]"]; if (s < 0.48e6 || s > 0.52e6) bad = 1; ++n }
  END { exit bad || !(n > 2) }' j/history.csv || fail "the lateral stress was not brought to 0.5 MPa first"
# The approach does not count towards the target: the stress that it causes may decrease again.
run "isotropic to p = 0.2 MPa" "triaxial at 1 MPa to p = 1.3 MPa" "isotropic to p = 1.5 MPa" "" k || fail "approach: $(cat k.log)"
[ "$(grep -c '"outcome": "target reached"' k/summary.json)" -eq 3 ] || fail "an approach counts as a path that reversed: $(cat k.log)"

# Consolidation is isotropic: the approach to a lateral stress from zero leaves q at zero, and what follows is
# what follows isotropic compression to that stress. Measured: |q| up to 1.2 kPa; the peaks differ by 0.1 %, the
# moduli by 0.8 % and Poisson's ratios by 4 %.
run "triaxial at 3 MPa to axial strain = 1 %" "" "" "" l || fail "consolidated: $(cat l.log)"
run "isotropic to p = 3 MPa" "triaxial to axial strain = 1 %" "" "" m || fail "consolidated in a stage: $(cat m.log)"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  NR > 2 && $at["axial strain of the stage [-]"] == 0 { exit } # the approach is over
  { q = $at["q [Pa]"]; if (q < 0) q = -q; if (q > most) most = q; ++n }
  END { print "approach to 3 MPa: |q| up to " most " Pa"; exit !(n > 5 && most < 0.01e6) }' l/history.csv ||
  fail "the approach to a lateral stress shears the specimen"
for name in "Young's modulus" "largest q" "Poisson's ratio"; do
  awk -v a="$(value l "$name")" -v b="$(value m "$name")" 'BEGIN { exit !(a > 0.9 * b && a < 1.1 * b) }' ||
    fail "$name $(value l "$name"), after an isotropic stage $(value m "$name")"
done
awk -v a="$(value l "largest q")" -v b="$(value m "largest q")" 'BEGIN { exit !(a > 0.97 * b && a < 1.03 * b) }' ||
  fail "peak $(value l "largest q"), after an isotropic stage $(value m "largest q") Pa"
within l "largest q/p" 0.7 0.9
# A tension that the axis loses in an approach is no failure.
run "tension to axial stress = -1 MPa" "triaxial at 1 MPa to axial strain = -0.2 %" "" "" n || fail "relieved: $(cat n.log)"
[ "$(grep -c '"outcome": "target reached"' n/summary.json)" -eq 2 ] || fail "an approach counts as failure in tension: $(cat n.log)"

# Refused, in one line, before anything is written.
refused() {
  local what=$1
  shift
  local code=0
  run "$@" || code=$?
  [ $code -eq 1 ] && [ "$(wc -l <"$5.log")" -eq 1 ] && grep -q "$what" "$5.log" && [ ! -e "$5" ] ||
    fail "wanted \"$what\", exit 1: $code $(cat "$5.log")"
}
refused 'did you mean "isotropic"?' "isotropc to p = 1 MPa" "" "" "" g
refused 'stage 1 = .*there is no stage before' "unload to q = 1 MPa" "" "" "" g
refused 'stage 2 = .*no `to`' "isotropic to p = 1 MPa" "triaxial" "" "" g
refused 'stage 1 = .*Pa' "isotropic to p = 1 mm" "" "" "" g
refused 'does not change along the stage' "isotropic to q = 1 MPa" "" "" "" g
refused 'stage 3 = .*there is no `stage 2`' "isotropic to p = 1 MPa" "" "isotropic to p = 2 MPa" "" g
refused 'stage 2 = .*the number of cycles "0" must be' "isotropic to p = 1 MPa" "unload-reload to p = 0.5 MPa, 0 times" "" "" g
refused 'stage 2 = .*only an `unload-reload` is repeated' "isotropic to p = 1 MPa" "unload to p = 0.5 MPa, 2 times" "" "" g
refused 'must be negative' "tension to axial stress = 1 MPa" "" "" "" g
refused 'stage 2 = .*does not change along the stage' "isotropic to p = 1 MPa" "unload to q = 1 MPa" "" "" g
refused 'Loading/strain limit = 0.85' "isotropic to p = 1 MPa" "" "" "" g --set "Loading/strain limit=0.85"
refused 'Specimen/porosity' "isotropic to p = 1 MPa" "" "" "" g --set "Specimen/porosity=0.3"

echo "element: all checks hold; E $(value a "Young's modulus"), UCS $(value c UCS) Pa, with the size effect $(value d UCS) Pa"
