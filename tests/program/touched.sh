#!/usr/bin/env bash
# Results that another program touches while a run writes them: history.csv removed, renamed, saved
# anew, emptied, a picture or the resolved case removed. The run ends with exit code 2, says what is
# lost and where the last checkpoint is, and mergel info finds what is missing.
#
# usage: tests/program/touched.sh MERGEL
. "$(dirname "$0")/preamble.sh"
has_lines() { [ "$(cat "$1/history.csv" 2>/dev/null | wc -l)" -ge "$2" ]; }
tiny_cell=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial to axial strain = 0.2 %"
  --set "Loading/stage 3=" --set "Loading/stage 4=" --set "Output/checkpoint every=50 steps")
element() { bounded "$mergel" element "$root/apps/cases/element_small.prm" "${tiny_cell[@]}" "$@"; }

# touched NAME FOLDER PATTERN COMMAND...: the commands are run in the folder of a run that is stopped meanwhile.
touched()
{
  local name=$1 folder=$2 pattern=$3 code=0
  shift 3
  launch "$mergel" element "$root/apps/cases/element_small.prm" "${tiny_cell[@]}" --output "$folder" >log 2>&1
  wait_for has_lines "$folder" 4
  wait_for exists "$folder/checkpoint_*.h5"
  kill -STOP $launched
  (cd "$folder" && "$@") || fail "$name: $*"
  kill -CONT $launched
  wait $launched || code=$?
  [ "$code" -eq 2 ] || fail "$name: exit code $code: $(tail -3 log)"
  grep -q "$pattern" log || fail "$name: $(tail -3 log)"
  grep -q "; the last good checkpoint is $folder/checkpoint_.*Continue with: mergel element --restart $folder" log ||
    fail "$name: the checkpoint is not named: $(tail -3 log)"
  grep -q '^results: ' log && fail "$name: results are named: $(tail -3 log)"
  return 0
}

saved_anew() { cp history.csv other && mv other history.csv; }
touched "removed" a 'a/history.csv: was removed, renamed or moved while the run wrote it (No such file' rm history.csv
[ "$(code_of "$mergel" info a)" -eq 1 ] && grep -q '^  missing  *history.csv$' log || fail "info without a history: $(cat log)"
touched "renamed" b 'b/history.csv: was removed, renamed or moved' mv history.csv mine.csv
touched "saved anew" c 'c/history.csv: was replaced by another file' saved_anew
touched "emptied" d 'd/history.csv: has [0-9]* bytes where the run wrote [0-9]*' truncate -s 0 history.csv
touched "a picture" e 'e: was changed while the run wrote there, and lacks fields/particles_0000.vtp' rm fields/particles_0000.vtp
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q 'results folder, not finished' log &&
  grep -q '^  missing  *fields/particles_0000.vtp$' log || fail "info without a picture: $(cat log)"
touched "the case" f 'f: was changed while the run wrote there, and lacks resolved.prm' rm resolved.prm

# A finished folder: what is removed afterwards is found, and it is not called finished.
element --output whole >log || fail "the whole run: $(tail -3 log)"
"$mergel" info whole >log || fail "info of a whole run: $(cat log)"
grep -q 'results folder, finished' log || fail "info of a whole run: $(cat log)"
for name in history.csv resolved.prm particles.pvd fields/bonds_0001.vtp; do
  rm -rf part; cp -r whole part; rm "part/$name"
  [ "$(code_of "$mergel" info part)" -eq 1 ] || fail "info without $name: $(cat log)"
  grep -q 'results folder, incomplete' log && grep -q "^  missing  *$name$" log || fail "info without $name: $(cat log)"
done

# A triaxial test has series of its own, and the specimen that mergel sample makes of its case.
cell=("$root/apps/cases/triaxial_small.prm" --set "Specimen/height=6 mm"
  --set "Loading/stage 1=isotropic to p = 0.1 MPa" --set "Loading/stage 2=")
bounded "$mergel" triaxial "${cell[@]}" --output cell >log || fail "a triaxial test: $(tail -3 log)"
bounded "$mergel" sample "${cell[@]}" --output specimens/cell >log || fail "its specimen: $(tail -3 log)"
cmp cell/sample.h5 specimens/cell/sample.h5 || fail "the specimen of a triaxial test differs"
"$mergel" info specimens/cell >log && grep -q 'results folder, finished' log || fail "info of its specimen: $(cat log)"
"$mergel" info cell >log && grep -q 'results folder, finished' log || fail "info of a triaxial test: $(cat log)"
for name in membrane.pvd fields/platens_0001.vtp; do
  rm -rf part; cp -r cell part; rm "part/$name"
  [ "$(code_of "$mergel" info part)" -eq 1 ] && grep -q "^  missing  *$name$" log || fail "info without $name: $(cat log)"
done

# A pile, and a pair: of the other jobs.
tiny+=("${shallow[@]}" --set "Output/frames=2" --set "Output/checkpoint every=20 steps")
launch "$mergel" pile "$case_file" "${tiny[@]}" --output pile >log 2>&1
wait_for has_lines pile 2
kill -STOP $launched
rm pile/history.csv
kill -CONT $launched
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] && grep -q 'pile/history.csv: was removed.*; the last good checkpoint is pile/checkpoint_' log ||
  fail "a pile: exit code $code: $(tail -3 log)"
launch "$mergel" bond "$root/apps/cases/bond_fig4a_tension.prm" --set "Loading/steps per stage=10000000" --output pair >log 2>&1
wait_for has_lines pair 2
rm pair/history.csv
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] && grep -q 'pair/history.csv: was removed' log || fail "a pair: exit code $code: $(cat log)"
# A specimen in a folder below the working folder: its series name files that are there.
"$mergel" sample "$case_file" "${tiny[@]}" --output specimens/one >log || fail "a specimen: $(tail -3 log)"
"$mergel" info specimens/one >log && grep -q 'results folder, finished' log || fail "info of a specimen: $(cat log)"
echo "touched: all checks hold"
