#!/usr/bin/env bash
# A small element test, stopped twice by SIGTERM on two and on three ranks and ended on one: its history
# and its results are those of a run that was never stopped, byte for byte. Also tests which keys a
# restart may change.
#
# usage: tests/program/element_restart.sh MERGEL
. "$(dirname "$0")/preamble.sh"
element() { bounded "$mergel" element "$@"; }
has_lines() { [ "$(lines a)" -ge "$1" ]; }
lines() { cat "$1/history.csv" 2>/dev/null | wc -l; }
case_file=$root/apps/cases/element_small.prm
# Few particles, bonds of varied strength that break, a stage that is resumed after unloading, lateral stress.
tiny=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Bond/softening displacement=0.0004 mm" --set "Bond/softening rotation=0.004 rad"
  --set "Strength variability/distribution=Weibull" --set "Strength variability/coefficient of variation=0.3"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial at 0.2 MPa to axial strain = 0.5 %"
  --set "Loading/stage 3=unload-reload to q = 0.5 MPa" --set "Loading/stage 4=resume to axial strain = 0.6 %")

element "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
n=$(lines whole)
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k } END { exit !($at["broken bonds [-]"] > 5) }' whole/history.csv ||
  fail "5 bonds or fewer broke"

# RANKS LINES ARGUMENTS...: run, stopped once it has written so many lines.
stopped() {
  local n_ranks=$1 n_lines=$2 code=0
  shift 2
  launch mpirun --oversubscribe -n "$n_ranks" "$mergel" element "$@" >log 2>&1
  signal_when TERM has_lines "$n_lines"
  wait $launched || code=$?
  [ "$code" -eq 2 ] && grep -q 'stopped by SIGTERM at step .* (stage .*), checkpoint a/checkpoint_' log ||
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

# Stopped in the unloading of a loop, and in its reloading: the loop cannot become another stage, and ends with
# the same bits. The signal may come when the next part has begun: then once more from the start.
part_is_under_way() { tail -1 l/history.csv 2>/dev/null | awk -F, -v part="$1" '{ is_it = $2 == 3 && $3 == part } END { exit !is_it }'; }
# PART ARGUMENTS...: run, stopped once it has written a record of this part of the loop.
stopped_in() {
  local part=$1 code=0
  shift
  launch "$mergel" element "$@" >log 2>&1
  signal_when TERM part_is_under_way "$part"
  wait $launched || code=$?
  [ "$code" -eq 2 ] && grep -q "stopped by SIGTERM at step .* (stage [34]" log || fail "stopped in part $part: $code $(cat log)"
}
for try in 1 2 3 4 5 6 7 8 9 10; do
  rm -rf l
  stopped_in 1 "$case_file" "${tiny[@]}" --output l
  grep -q '(stage 3a)' log && break
  [ $try -lt 10 ] || fail "the unloading was over each time that the test was stopped: $(cat log)"
done
[ "$(code_of element --restart l --set "Loading/stage 3=unload to q = 0.5 MPa")" -eq 1 ] &&
  grep -q 'the checkpoint is in stage 3a of the test: only later' log || fail "a loop becomes an unloading: $(cat log)"
stopped_in 2 --restart l
element --restart l >log || fail "the end of a stopped loop: $(tail -3 log)"
cmp whole/history.csv l/history.csv || fail "a loop that was stopped: another history"
diff <(physics whole) <(physics l) || fail "a loop that was stopped: another summary"

# Later stages may be changed and added, and the analysis of a stage may change; nothing else.
newest=$(compgen -G "a/checkpoint_*.h5" | sort | tail -1)
element --restart "$newest" --output b --set "Loading/stage 5=unload to q = 0.5 MPa" --set "Analysis/yield offset=3e-4" >log ||
  fail "another stage: $(tail -3 log)"
[ "$(grep -c '"stage":' b/summary.json)" -eq $(($(grep -c '"stage":' whole/summary.json) + 1)) ] || fail "the added stage"
cmp whole/fields/particles_0001.vtp b/fields/particles_0001.vtp || fail "pictures of the other folder are not copied"
cmp <(head -n "$n" b/history.csv) whole/history.csv || fail "with a stage more the history differs before it"
[ "$(code_of element --restart "$newest" --output c --set "Loading/stage 1=isotropic to p = 0.5 MPa")" -eq 1 ] &&
  grep -q 'stage 1 = isotropic to p = 0.5 MPa: was "isotropic to p = 0.4 MPa"' log || fail "another first stage: $(cat log)"
[ "$(code_of element --restart "$newest" --output c --set "Motion/damping=0.6")" -eq 1 ] &&
  grep -q 'Motion/damping was 0.7, the case asks for 0.6' log || fail "another damping: $(cat log)"
[ ! -e c ] || fail "a refused restart wrote something"
# Before the end of a walltime.
[ "$(code_of element "$case_file" "${tiny[@]}" --output d --walltime "0.1 s")" -eq 2 ] &&
  grep -q 'stopped before the end of --walltime' log || fail "walltime: $(cat log)"
echo "element restart: all checks hold, $n lines of history"
