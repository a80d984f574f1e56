#!/usr/bin/env bash
# A small triaxial test, stopped by SIGTERM on two ranks in the approach to a cell pressure and on three ranks in
# the middle of shearing, and ended on one: its history and its results are those of a run that was never
# stopped, byte for byte, and so are those of 2, 3 and 4 ranks. Also tests which keys a restart may change.
#
# usage: tests/program/triaxial_restart.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
triaxial() { bounded "$mergel" triaxial "$@"; }
lines() { cat "$1/history.csv" 2>/dev/null | wc -l; }
has_lines() { [ "$(lines a)" -ge "$1" ]; }
case_file=$root/apps/cases/triaxial_small.prm
# Few particles, bonds of varied strength that break, a platen that tilts, a membrane so heavy that its own forces
# act at every second step, a stage that is resumed after unloading.
tiny=(--set "Specimen/diameter=3.6 mm" --set "Specimen/height=5 mm" --set "Platens/top=spherical seat"
  --set "Bond/softening displacement=0.0004 mm" --set "Bond/softening rotation=0.004 rad"
  --set "Strength variability/distribution=Weibull" --set "Strength variability/coefficient of variation=0.3"
  --set "Membrane/density=20000 kg/m3" --set "Membrane/largest subcycle=4" --set "Output/record every=5e-5"
  --set "Output/localisation every=1e-4"
  --set "Loading/stage 1=isotropic to p = 0.2 MPa" --set "Loading/stage 2=triaxial at 0.4 MPa to axial strain = 0.05 %"
  --set "Loading/stage 3=unload-reload to q = 0.2 MPa" --set "Loading/stage 4=resume to axial strain = 0.06 %")

triaxial "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
n=$(lines whole)
[ "$(value whole "bonds broken [-]")" -gt 5 ] || fail "5 bonds or fewer broke"
[ "$(wc -l <whole/localisation.csv)" -gt 6 ] || fail "bands are not looked for: $(cat whole/localisation.csv)"
[ "$(value whole "steps from kick to kick")" -gt 1 ] || fail "the membrane's own forces act at every step"
# Lines written in the approach of stage 2, and in the middle of its shearing.
read -r approach shearing < <(records whole 'c("stage [-]") == 2 { ++m
    if (m == 2) approach = NR
    if (c("axial strain of the stage [-]") > 0.0002 && !shearing) shearing = NR }
  END { print approach + 0, shearing + 0 }')
[ "$approach" -gt 2 ] && [ "$shearing" -gt $((approach + 2)) ] && [ "$n" -gt $((shearing + 10)) ] ||
  fail "no approach or shearing: lines $approach, $shearing of $n"

# RANKS LINES ARGUMENTS...: run, stopped once it has written so many lines.
stopped() {
  local n_ranks=$1 n_lines=$2 code=0
  shift 2
  launch mpirun --oversubscribe -n "$n_ranks" "$mergel" triaxial "$@" >log 2>&1
  signal_when TERM has_lines "$n_lines"
  wait $launched || code=$?
  [ "$code" -eq 2 ] && grep -q 'stopped by SIGTERM at step .* (stage 2), checkpoint a/checkpoint_' log ||
    fail "SIGTERM on $n_ranks ranks: exit code $code: $(cat log)"
  [ ! -e a/summary.json ] || fail "a stopped run has a summary"
}
# FOLDER: equal to the whole run
same() {
  cmp whole/history.csv "$1/history.csv" || fail "the history of $1 differs"
  cmp whole/localisation.csv "$1/localisation.csv" || fail "the bands of $1 differ"
  diff <(physics whole) <(physics "$1") || fail "the summary of $1 differs"
  diff -r whole/fields "$1/fields" >log || fail "the pictures of $1 differ: $(cat log)"
  for series in particles bonds contacts platens membrane; do
    cmp "whole/$series.pvd" "$1/$series.pvd" || fail "the series of pictures of $1 differs"
  done
}
stopped 2 "$approach" "$case_file" "${tiny[@]}" --output a
stopped 3 "$shearing" --restart a
triaxial --restart a >log || fail "the end: $(tail -3 log)"
same a
"$mergel" info a >info || fail "info: $(cat info)"
for ranks in 2 3 4; do
  on_ranks $ranks "$mergel" triaxial "$case_file" "${tiny[@]}" --output on$ranks >log 2>&1 || fail "on $ranks ranks: $(tail -3 log)"
  same on$ranks
done

# Later stages may be changed and added as long as the membrane holds, and the analysis may change; nothing else.
newest=$(compgen -G "a/checkpoint_*.h5" | sort | tail -1)
triaxial --restart "$newest" --output b --set "Loading/stage 5=unload to q = 0.2 MPa" --set "Analysis/yield offset=3e-4" \
  --set "Analysis/secant from=2e-4" --set "Analysis/secant to=5e-4" --set "Loading/strain limit=0.4" >log || fail "another stage: $(tail -3 log)"
[ "$(grep -c '^stage [0-9ab]*, .*: target reached' log)" -eq 6 ] || fail "the added stage: $(cat log)"
cmp whole/fields/particles_0001.vtp b/fields/particles_0001.vtp || fail "pictures of the other folder are not copied"
cmp <(head -n "$n" b/history.csv) whole/history.csv || fail "with a stage more the history differs before it"
# NAME PATTERN SETTING...: refused, in one line, before anything is written
refused() {
  local name=$1 pattern=$2 options=() setting
  shift 2
  for setting in "$@"; do options+=(--set "$setting"); done
  [ "$(code_of triaxial --restart "$newest" --output c "${options[@]}")" -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] &&
    grep -q -- "$pattern" log || fail "$name: $(cat log)"
  [ ! -e c ] || fail "$name: a refused restart wrote something"
}
refused "another first stage" 'stage 1 = isotropic to p = 0.5 MPa: was "isotropic to p = 0.2 MPa"' "Loading/stage 1=isotropic to p = 0.5 MPa"
refused "another damping" 'Motion/damping was 0.7, the case asks for 0.6' "Motion/damping=0.6"
refused "another mesh" "Membrane/node distance was .*, the case asks for 0.25 mm" "Membrane/node distance=0.25 mm"
refused "another membrane" "Membrane/thickness was 0.3 mm, the case asks for 0.4 mm" "Membrane/thickness=0.4 mm"
refused "no membrane" "Membrane" "Membrane/membrane=false"
refused "other ends" "Membrane/ends was free, the case asks for fixed" "Membrane/ends=fixed"
refused "another seat" "Platens/" "Platens/top=fixed"
refused "another specimen" "Specimen/height was 5 mm, the case asks for 6 mm" "Specimen/height=6 mm"
# The default stiffness of the membrane follows from the largest cell pressure of all stages.
refused "a pressure that the membrane does not follow" "Membrane/Young's modulus" "Loading/stage 5=triaxial at 2 MPa to axial strain = 0.2 %"
# Nothing is left to do.
[ "$(code_of triaxial --restart a)" -eq 0 ] && grep -q 'all its stages are done' log || fail "done twice: $(cat log)"
same a
# Before the end of a walltime.
[ "$(code_of triaxial "$case_file" "${tiny[@]}" --output d --walltime "0.1 s")" -eq 2 ] &&
  grep -q 'stopped before the end of --walltime' log || fail "walltime: $(cat log)"
echo "triaxial restart: all checks hold, $n lines of history; stopped at lines $approach and $shearing"
