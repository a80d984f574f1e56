#!/usr/bin/env bash
# A small element test stopped twice by SIGTERM, on two and on three ranks, and ended on one: the
# history and all that was read off it are those of the run that was never stopped, byte for byte.
# What a restart may change and what not.
#
# usage: tests/program/element_restart.sh MERGEL
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mergel=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1

fail() { echo "FAILED: $*"; exit 1; }
code_of() { local code=0; "$@" >log 2>&1 || code=$?; echo "$code"; }
element() { timeout 300 "$mergel" element "$@"; }
lines() { cat "$1/history.csv" 2>/dev/null | wc -l; }
physics() { grep -v 'wall-clock time' "$1/summary.json"; }
case_file=$root/apps/cases/element_small.prm
# Few grains, bonds of varied strength that break, a leg that is taken up after unloading, confined sides.
tiny=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Bond/softening displacement=0.0004 mm" --set "Bond/softening rotation=0.004 rad"
  --set "Strength variability/distribution=Weibull" --set "Strength variability/coefficient of variation=0.3"
  --set "Loading/leg 1=isotropic to p = 0.4 MPa" --set "Loading/leg 2=triaxial at 0.2 MPa to axial strain = 0.5 %"
  --set "Loading/leg 3=unload-reload to q = 0.5 MPa" --set "Loading/leg 4=resume to axial strain = 0.6 %")

element "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
n=$(lines whole)
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k } END { exit !($at["broken bonds [-]"] > 5) }' whole/history.csv ||
  fail "hardly a bond broke"

# RANKS LINES ARGUMENTS...: run, and stop it once so many lines are written.
stopped() {
  local n_ranks=$1 n_lines=$2 launched one code=0
  shift 2
  timeout 300 mpirun --oversubscribe -n "$n_ranks" "$mergel" element "$@" >log 2>&1 &
  launched=$!
  for _ in $(seq 6000); do
    [ "$(lines a)" -lt "$n_lines" ] && kill -0 $launched 2>/dev/null || break
    sleep 0.02
  done
  one=$(pgrep -P "$(pgrep -P $launched mpirun)" mergel | tail -1) || fail "it ended by itself: $(tail -3 log)"
  kill -TERM "$one"
  wait $launched || code=$?
  [ "$code" -eq 2 ] && grep -q 'stopped by SIGTERM at step .* (leg .*), checkpoint a/checkpoint_' log ||
    fail "SIGTERM on $n_ranks ranks: exit code $code: $(cat log)"
  [ ! -e a/summary.json ] || fail "a stopped run has a summary"
}
stopped 2 $((n / 4)) "$case_file" "${tiny[@]}" --output a
stopped 3 $((n / 2)) --restart a
element --restart a >log || fail "the end: $(tail -3 log)"
cmp whole/history.csv a/history.csv || fail "the history differs"
diff <(physics whole) <(physics a) || fail "the summary differs"
diff -r whole/fields a/fields >log || fail "the pictures differ: $(cat log)"
cmp whole/particles.pvd a/particles.pvd || fail "the series of pictures differs"
"$mergel" info a >info || fail "info: $(cat info)"

# Legs to come may change and be added, and how a leg is read; nothing else.
newest=$(compgen -G "a/checkpoint_*.h5" | sort | tail -1)
element --restart "$newest" --output b --set "Loading/leg 5=unload to q = 0.5 MPa" --set "Analysis/yield offset=3e-4" >log ||
  fail "another leg: $(tail -3 log)"
[ "$(grep -c '"leg":' b/summary.json)" -eq $(($(grep -c '"leg":' whole/summary.json) + 1)) ] || fail "the added leg"
cmp whole/fields/particles_0001.vtp b/fields/particles_0001.vtp || fail "pictures of another folder are not brought along"
cmp <(head -n "$n" b/history.csv) whole/history.csv || fail "with a leg more the history differs before it"
[ "$(code_of element --restart "$newest" --output c --set "Loading/leg 1=isotropic to p = 0.5 MPa")" -eq 1 ] &&
  grep -q 'leg 1 = isotropic to p = 0.5 MPa: was "isotropic to p = 0.4 MPa"' log || fail "another first leg: $(cat log)"
[ "$(code_of element --restart "$newest" --output c --set "Motion/damping=0.6")" -eq 1 ] &&
  grep -q 'Motion/damping was 0.7, the case asks for 0.6' log || fail "another damping: $(cat log)"
[ ! -e c ] || fail "a refused restart wrote something"
# In time before the end of a walltime.
[ "$(code_of element "$case_file" "${tiny[@]}" --output d --walltime "0.1 s")" -eq 2 ] &&
  grep -q 'stopped before the end of --walltime' log || fail "walltime: $(cat log)"
echo "element restart: all holds, $n lines of history"
