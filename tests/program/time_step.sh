#!/usr/bin/env bash
# A step beyond the stable one shows: the alarm of the energy error in log and summary, and a run that
# stops with its message. The keys that lengthen the step: what they report, and what is refused.
#
# usage: tests/program/time_step.sh MERGEL
. "$(dirname "$0")/preamble.sh"
# element OUTPUT [options]: a small cell, compressed
element() {
  local out=$1
  shift
  bounded "$mergel" element "$root/apps/cases/element_small.prm" --set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" \
    --set "Specimen/edge z=3.9 mm" --set "Loading/stage 1=isotropic to p = 1 MPa" \
    --set "Loading/stage 2=triaxial to axial strain = 0.6 %" --set "Loading/stage 3=" --set "Loading/stage 4=" "$@" --output "$out" >"$out.log" 2>&1
}
# FILE NAME: the value of this name in a summary
value() { awk -F': ' -v name="\"$2" 'index($1, name) { print $2 + 0; exit }' "$1/summary.json"; }
# FILE: the stable step of the first record
stable() { awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k } NR == 2 { print $at["stable step [s]"] }' "$1/history.csv"; }
holds() { awk "BEGIN { exit !($1) }" || fail "$2: $1"; }

element usual || fail "at the default: $(tail -1 usual.log)"
grep -q 'time step .* 0.9 of the stable one, ruled by rotation of particle' usual.log || fail "the log: $(cat usual.log)"
grep -q 'risen\|beyond the stable' usual.log && fail "an alarm at the default: $(grep risen usual.log)"
element close --set "Motion/time step safety=0.95" || fail "at 0.95: $(tail -1 close.log)"
element beyond --set "Motion/time step safety=1.02" || fail "at 1.02: $(tail -1 beyond.log)"
grep -q 'time step safety = 1.02: the step is beyond the stable one' beyond.log || fail "no warning: $(cat beyond.log)"
[ "$(grep -c 'the energy error has risen to .* lower .Motion/time step safety' beyond.log)" -eq 2 ] ||
  fail "the alarm is said when it is raised, and at the end: $(cat beyond.log)"
holds "$(value beyond "energy error of the alarm") > 1e-5" "the alarm in the summary"
holds "$(value beyond "largest energy error") > 10 * $(value close "largest energy error")" "the energy error at 1.02 and 0.95"
code=0
element far --set "Motion/time step safety=1.3" || code=$?
[ "$code" -eq 2 ] && [ -s far/failed.json ] && [ ! -e far/summary.json ] || fail "at 1.3: exit code $code"
grep -q 'lower `Motion/time step safety`' far.log || fail "at 1.3: $(tail -1 far.log)"
code=0
bounded "$mergel" pile "$case_file" "${tiny[@]}" --set "Motion/time step safety=1.4" --output pile >pile.log 2>&1 || code=$?
[ "$code" -eq 2 ] || fail "a pile at 1.4: exit code $code: $(tail -1 pile.log)"
grep -q 'lower `Motion/time step safety`' pile.log || fail "a pile at 1.4: $(tail -1 pile.log)"

# The block bound is below the limit. More inertia and more mass lengthen the step, by what was asked for at most.
element bound --set "Motion/time step=block bound" || fail "block bound: $(tail -1 bound.log)"
grep -q 'set time step safety *= 0.98' bound/resolved.prm || fail "the safety of the block bound: $(grep safety bound/resolved.prm)"
holds "$(stable bound) < $(stable usual)" "the block bound"
element inertia --set "Motion/inertia factor=2" || fail "inertia factor: $(tail -1 inertia.log)"
holds "$(stable inertia) > 1.1 * $(stable usual)" "twice the inertia"
element mass --set "Motion/mass scaling=1.2" --set "Motion/mass scaling limit=0.2" || fail "mass scaling: $(tail -1 mass.log)"
holds "$(stable mass) > 1.05 * $(stable usual) && $(stable mass) <= 1.2 * $(stable usual)" "scaled masses"
holds "$(value mass "particles with added mass") >= 1 && $(value mass "added mass over true mass") < 0.2" "what was scaled"
grep -q '^mass scaling, all: .* particles, mass + ' mass.log || fail "what was scaled: $(head -5 mass.log)"
code=0
element heavy --set "Motion/mass scaling=3" || code=$?
[ "$code" -eq 1 ] && [ ! -e heavy/history.csv ] || fail "too much mass: exit code $code"
grep -q 'Motion/mass scaling = 3: it would add .* with S = 5: at most 5 %; lower it, or raise `Motion/mass scaling limit`' heavy.log ||
  fail "too much mass: $(tail -1 heavy.log)"
echo "time_step: all checks hold; energy error $(value close "largest energy error") at 0.95, $(value beyond "largest energy error") at 1.02"
