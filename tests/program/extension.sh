#!/usr/bin/env bash
# A finished run taken further from its last checkpoint. A pile pushed deeper: the curve of the first
# push stays, and a second push that was stopped ends with the same bits. An element test with further
# stages, or a larger strain limit: the bits of a test that had them from the start. Where nothing is
# left to do, nothing is changed.
#
# usage: tests/program/extension.sh MERGEL
. "$(dirname "$0")/preamble.sh"
checkpoints() { compgen -G "$1/checkpoint_*.h5" | wc -l; }
newest() { compgen -G "$1/checkpoint_*.h5" | sort | tail -1; }
lines() { wc -l <"$1/history.csv"; }
# Names, times and bytes of all files of a folder.
state_of() { (cd "$1" && find . -type f -printf '%p %T@\n' -exec cksum {} + | sort); }
# JOB FOLDER PATTERN: restarted as it is, it says this and changes nothing.
says() {
  local before
  before=$(state_of "$2")
  [ "$(code_of bounded "$mergel" "$1" --restart "$2")" -eq 0 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q "$3" log ||
    fail "$2 restarted as it is: $(cat log)"
  [ "$(state_of "$2")" = "$before" ] || fail "$2 restarted as it is: something changed"
}
finished() { "$mergel" info "$1" >info && grep -q 'results folder, finished' info && grep -q ', finished, step .* good' info; }

# --- pile ---------------------------------------------------------------------------------------
pile() { bounded "$mergel" pile "$@"; }
tiny+=(--set "Pile/cone angle=120 degree" --set "Output/frames=2")
pile "$case_file" "${tiny[@]}" --set "Pile/final depth=0.03 mm" --output first >log || fail "the first push: $(tail -3 log)"
[ "$(checkpoints first)" -eq 1 ] && finished first || fail "the first push is not finished: $(cat info)"
says pile first '^first holds the finished run: the pile is at its final depth, 0.03 mm\.'

deeper=(--set "Pile/final depth=0.15 mm")
pile --restart first --output whole "${deeper[@]}" >log || fail "the second push: $(tail -3 log)"
grep -q 'starts again from rest, .* the curve is that of 2 pushes' log || fail "two pushes are not said: $(cat log)"
grep -q '"pushes \[-\]": 1,' first/summary.json && grep -q '"pushes \[-\]": 2,' whole/summary.json || fail "the number of pushes"
[ "$(checkpoints first)" -eq 1 ] && finished first || fail "a push in another folder changed the first"
cmp <(head -n "$(lines first)" whole/history.csv) first/history.csv || fail "the curve of the first push changed"
awk -F, 'END { exit !($2 >= 0.15e-3 && $2 < 0.151e-3) }' whole/history.csv || fail "the depth: $(tail -1 whole/history.csv)"
# It starts at a hundredth of the penetration rate and speeds up.
awk -F, -v first="$(lines first)" 'NR == first { t = $1; d = $2 } NR == first + 1 { v = ($2 - d) / ($1 - t) }
  END { exit !(v > 0.01 * 1.35 && v < 1.35) }' whole/history.csv || fail "the second push starts at its full rate"

# In its own folder, stopped in the second push on two ranks.
cp -r first second
launch mpirun --oversubscribe -n 2 "$mergel" pile --restart second "${deeper[@]}" >log 2>&1
grown() { [ "$(lines second)" -gt "$(($(lines first) + 3))" ]; }
signal_when TERM grown
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] && grep -q 'stopped by SIGTERM at step .* (penetration)' log || fail "stopped in the second push: $(tail -3 log)"
pile --restart second >log || fail "the rest of the second push: $(tail -3 log)"
grep -q 'starts again' log && fail "a third push: $(cat log)"
cmp whole/history.csv second/history.csv || fail "the second push, stopped and continued: another history"
diff -r whole/fields second/fields >log || fail "the second push, stopped and continued: $(cat log)"
diff <(physics whole) <(physics second) || fail "the second push, stopped and continued: another summary"
says pile second 'the pile is at its final depth, 0.15 mm'

# Not upwards, and not while it slows down.
[ "$(code_of pile --restart first --set "Pile/final depth=0.02 mm")" -eq 1 ] && grep -q 'final depth.*it can only go deeper' log ||
  fail "upwards: $(cat log)"
pile "$case_file" "${tiny[@]}" --set "Pile/final depth=0.03 mm" --set "Specimen/file=first/sample.h5" --output slow \
  --set "Output/checkpoint every=20 steps" --set "Output/checkpoint at end=false" >log || fail "with checkpoints: $(tail -3 log)"
[ "$(checkpoints slow)" -eq 2 ] || fail "the checkpoint at the end was not left out: $(ls slow)"
[ "$(code_of pile --restart slow "${deeper[@]}")" -eq 1 ] && grep -q 'final depth.*has begun to slow down' log ||
  fail "while it slows down: $(cat log)"
cmp first/history.csv slow/history.csv || fail "a refused restart changed the history"
rm slow/checkpoint_*
[ "$(code_of pile --restart slow)" -eq 1 ] && grep -q 'holds a finished run' log || fail "without a checkpoint: $(cat log)"
# Killed before its summary was written.
rm slow/summary.json; cp "$(newest first)" slow
pile --restart slow >log || fail "without a summary: $(tail -3 log)"
diff <(physics first) <(physics slow) || fail "the summary, written again, differs"

# --- element ------------------------------------------------------------------------------------
element() { bounded "$mergel" element "$@"; }
case_file=$root/apps/cases/element_small.prm
tiny=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Bond/softening displacement=0.0004 mm" --set "Bond/softening rotation=0.004 rad"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial at 0.2 MPa to axial strain = 0.3 %")
none=(--set "Loading/stage 3=" --set "Loading/stage 4=")
more=(--set "Loading/stage 3=unload-reload to q = 0.3 MPa" --set "Loading/stage 4=resume to axial strain = 0.4 %")
element "$case_file" "${tiny[@]}" "${more[@]}" --output all >log || fail "all stages: $(tail -3 log)"
element "$case_file" "${tiny[@]}" "${none[@]}" --output two >log || fail "two stages: $(tail -3 log)"
finished two || fail "two stages: $(cat info)"
says element two '^two holds the finished run: all its stages are done\.'
[ "$(code_of element --restart two --set "Loading/stage 2=triaxial at 0.2 MPa to axial strain = 0.4 %")" -eq 1 ] &&
  grep -q 'add a stage such as `resume to axial strain' log || fail "another target of the last stage: $(cat log)"

same_as_all() {
  cmp all/history.csv "$1/history.csv" || fail "$1: another history"
  diff <(physics all) <(physics "$1") || fail "$1: another summary"
}
cp -r two extended
on_ranks 2 "$mergel" element --restart extended "${more[@]}" >log || fail "more stages: $(tail -3 log)"
same_as_all extended
diff -r all/fields extended/fields >log || fail "the pictures: $(cat log)"
says element extended 'all its stages are done'

# Two cycles are one and another one; each unloads to below the target.
loop="Loading/stage 3=unload-reload to q = 0.3 MPa"
cp -r two once
cp -r two twice
element --restart once --set "$loop" >log || fail "a cycle: $(tail -3 log)"
element --restart once --set "$loop, 2 times" >log || fail "another cycle: $(tail -3 log)"
element --restart twice --set "$loop, 2 times" >log || fail "two cycles: $(tail -3 log)"
cmp once/history.csv twice/history.csv || fail "two cycles differ from one and another one"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  { q = $at["q [Pa]"] } q > 0.31e6 { loaded = 1 } loaded && q < 0.305e6 { ++n; loaded = 0 }
  END { exit n != 2 }' twice/history.csv || fail "the specimen was not unloaded twice"
stages=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  { s = $at["stage [-]"] "." $at["part [-]"] "." $at["cycle [-]"]; if (s != before) printf "%s ", s; before = s }' once/history.csv)
[ "$stages" = "1.0.0 2.0.0 3.1.1 3.2.1 3.1.2 3.2.2 " ] || fail "the stages of two cycles: $stages"
# Read beside the test without a loop: as stiff, and with no other peak, such as where it was unloaded.
"$mergel" compare two twice --output compared >log 2>&1 || fail "compare: $(cat log)"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  /^#/ { next } # where it was made
  { n = NR; E[NR] = $at["Young\047s modulus [Pa]"]; kind[NR] = $at["kind"]; peak[NR] = $at["q at the peak [Pa]"] }
  END { exit !(n == 3 && E[2] > 0 && E[3] == E[2] && kind[3] == "triaxial" && peak[3] == peak[2]) }' compared/tests.csv ||
  fail "two cycles in mergel compare: $(cat compared/tests.csv)"
[ "$(code_of element --restart twice --set "$loop")" -eq 1 ] && grep -q 'only later stages may change' log ||
  fail "a cycle less: $(cat log)"
[ "$(code_of element --restart twice --set "$loop" --set "${loop/stage 3/stage 4}")" -eq 1 ] && grep -q 'only later stages may change' log ||
  fail "a cycle becomes a stage of its own: $(cat log)"

# The analysis alone: nothing is loaded.
element --restart two --set "Analysis/yield offset=1e-4" >log || fail "another analysis: $(tail -3 log)"
awk -F': ' '/"yield offset/ { x = $2 + 0 } END { exit x != 1e-4 }' two/summary.json || fail "the analysis was not repeated: $(cat two/summary.json)"
[ "$(lines two)" -lt "$(lines all)" ] && finished two || fail "another analysis loaded the specimen: $(cat info)"

# The states of other runs, from folders with and without a blank in the name: the run knows them from then on.
mkdir "state A" state_B elsewhere
head -n -3 all/history.csv >"state A/history.csv"
head -n -6 all/history.csv >state_B/history.csv
element "$case_file" "${tiny[@]}" "${none[@]}" --set 'Analysis/critical states="state A" state_B' --output fitted >log || fail "critical states: $(tail -3 log)"
grep -Eq '"critical states fitted \[-\]": 3(,|$)' fitted/summary.json || fail "critical states: $(cat fitted/summary.json)"
grep -qF "set critical states = \"$(pwd -P)/state A\" $(pwd -P)/state_B" fitted/resolved.prm || fail "critical states: $(grep critical fitted/resolved.prm)"
# None of them is a critical state, after a percent of strain: that is said of each.
cp all/resolved.prm state_B
"$mergel" check fitted/resolved.prm >log || fail "check: $(cat log)"
grep -q 'unusual: Analysis/critical states: .*/state A: nobody knows whether it is a critical state: ' log &&
  grep -q 'unusual: Analysis/critical states: .*/state_B: no critical state: ' log || fail "no critical states, and nothing says so: $(cat log)"
fitted() { grep '"critical state line' fitted/summary.json; }
fitted >line
rm -r "state A" state_B
(cd elsewhere && element --restart ../fitted --set "Analysis/yield offset=1e-4") >log || fail "critical states from elsewhere: $(tail -3 log)"
cmp line <(fitted) || fail "critical states from elsewhere: $(cat fitted/summary.json)"
[ "$(code_of element --restart fitted --set 'Analysis/critical states="state C"')" -eq 1 ] &&
  grep -q 'critical states = "state C": .*/state C holds no results of an element test: ' log || fail "no such state: $(cat log)"

# A test that ended at its strain limit.
element "$case_file" "${tiny[@]}" "${more[@]}" --set "Loading/strain limit=0.002" --output limited >log || fail "a strain limit: $(tail -3 log)"
grep -q 'the strain limit was reached' limited/summary.json || fail "the strain limit: $(cat limited/summary.json)"
says element limited 'ended the test: the strain limit was reached .* larger `Loading/strain limit`'
element --restart limited --set "Loading/strain limit=0.5" >log || fail "a larger strain limit: $(tail -3 log)"
same_as_all limited
echo "extension: all checks hold"
