#!/usr/bin/env bash
# Results that another program touches while a run writes them: history.csv removed, renamed, saved
# anew, emptied: the run ends with exit code 2, says what is lost and where the last checkpoint is. Pictures removed:
# the run goes on to its end, and says it then. The resolved case is written again. mergel info finds what is missing.
#
# usage: tests/program/touched.sh MERGEL
. "$(dirname "$0")/preamble.sh"
has_lines() { [ "$(cat "$1/history.csv" 2>/dev/null | wc -l)" -ge "$2" ]; }
tiny_cell=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial to axial strain = 0.2 %"
  --set "Loading/stage 3=" --set "Loading/stage 4=" --set "Output/checkpoint every=50 steps")
element() { bounded "$mergel" element "$root/apps/cases/element_small.prm" "${tiny_cell[@]}" "$@"; }

# act_when CONDITION FOLDER COMMAND...: for wait_for, while the run stands still.
act_when()
{
  local condition=$1 folder=$2
  shift 2
  "$condition" "$folder" || return 1
  (cd "$folder" && "$@") || fail "$folder: $*"
}
has_checkpoint() { has_lines "$1" 4 && exists "$1/checkpoint_*.h5"; }
# No frame is half written, whose next files would need their folder: of each kind there are as many files, and no
# temporary one.
between_frames()
{
  has_lines "$1" 4 && [ -z "$(find "$1/fields" -name '.*')" ] &&
    [ "$(ls "$1/fields" | sed 's/_[0-9]*\..*//' | sort | uniq -c | awk '{ print $1 }' | sort -u | wc -l)" -eq 1 ]
}

# touched NAME FOLDER PATTERN COMMAND...: the commands are run in the folder of a run that is stopped meanwhile.
touched()
{
  local name=$1 folder=$2 pattern=$3 code=0
  shift 3
  launch "$mergel" element "$root/apps/cases/element_small.prm" "${tiny_cell[@]}" --output "$folder" >log 2>&1
  wait_for act_when has_checkpoint "$folder" "$@"
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

# What the run does not need to go on is no reason to lose its summary and the checkpoint of its end.
# finished_without CODE NAME FOLDER PATTERN COMMAND...
finished_without()
{
  local wanted=$1 name=$2 folder=$3 pattern=$4 code=0
  shift 4
  launch "$mergel" element "$root/apps/cases/element_small.prm" "${tiny_cell[@]}" --output "$folder" >log 2>&1
  wait_for act_when between_frames "$folder" "$@"
  wait $launched || code=$?
  [ "$code" -eq "$wanted" ] && grep -q "$pattern" log || fail "$name: exit code $code: $(tail -3 log)"
  code_of "$mergel" info "$folder" >/dev/null
  [ -s "$folder/summary.json" ] && grep -q '^  checkpoint .*, finished, step .* good' log ||
    fail "$name: a summary and the checkpoint of the end are wanted: $(ls "$folder")"
}
otherwise='\. The run is finished otherwise: its summary and the checkpoint of its end are written$'
finished_without 2 "a picture" e "^e: was changed while the run wrote there, and lacks fields/particles_0000.vtp$otherwise" rm fields/particles_0000.vtp
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q 'results folder, incomplete' log &&
  grep -q '^  missing  *fields/particles_0000.vtp$' log || fail "info without a picture: $(cat log)"
finished_without 2 "all pictures" g "^g: was changed while the run wrote there, and lacks fields/particles_0000.vtp and [0-9]* more files$otherwise" rm -r fields
exists 'g/fields/particles_*.vtp' || fail "the folder of the fields is not made again: $(ls g/fields)"
finished_without 0 "the case" f '^f/resolved.prm: was gone, and is written again$' rm resolved.prm
"$mergel" info f >log && grep -q 'results folder, finished' log || fail "info with a case that is written again: $(cat log)"

# A finished folder: what is removed afterwards is found, and it is not called finished.
element --output whole >log || fail "the whole run: $(tail -3 log)"
"$mergel" info whole >log || fail "info of a whole run: $(cat log)"
grep -q 'results folder, finished' log || fail "info of a whole run: $(cat log)"
for name in history.csv resolved.prm particles.pvd fields/bonds_0001.vtp; do
  rm -rf part; cp -r whole part; rm "part/$name"
  [ "$(code_of "$mergel" info part)" -eq 1 ] || fail "info without $name: $(cat log)"
  grep -q 'results folder, incomplete' log && grep -q "^  missing  *$name$" log || fail "info without $name: $(cat log)"
done

# The same of what is cut: at the head, with and without the heading, and at the end.
# cut FILE "HOW" COMMAND...: what the command prints of it takes its place.
cut_result()
{
  local file=$1 how=$2
  shift 2
  "$@" <"$from/$file" >cut
  rm -rf part; cp -r "$from" part; cp cut "part/$file"
  [ "$(code_of "$mergel" info part)" -eq 1 ] && grep -q 'results folder, incomplete' log && grep -q "$how" log ||
    fail "info of a $file that is cut, wanted \"$how\": $(cat log)"
}
from=whole
cut_result history.csv 'history.csv begins late, at time .*: its first records are lost' sed '2,4d'
cut_result history.csv 'history.csv does not begin with its heading (time \[s\], ...): its first lines are lost' sed '1,3d'
cut_result history.csv 'history.csv does not begin with its heading' tail -c 300
cut_result history.csv 'history.csv does not begin with its heading' true
cut_result history.csv 'history.csv is cut: its last line is not whole' head -c -5
cut_result history.csv 'history.csv is cut: it ends at time .* s, before the last fields at .* s' head -n 4
bounded "$mergel" bond "$root/apps/cases/bond_fig4a_tension.prm" --output bond >log || fail "a pair: $(tail -3 log)"
"$mergel" info bond >log || fail "info of a pair: $(cat log)"
from=bond cut_result history.csv 'history.csv begins late, at u_n .*: its first records are lost' sed '2,4d'

# A triaxial test has series of its own, and the specimen that mergel sample makes of its case.
cell=("$root/apps/cases/triaxial_small.prm" --set "Specimen/height=6 mm"
  --set "Loading/stage 1=isotropic to p = 0.1 MPa" --set "Loading/stage 2=")
bounded "$mergel" triaxial "${cell[@]}" --output cell >log || fail "a triaxial test: $(tail -3 log)"
bounded "$mergel" sample "${cell[@]}" --output specimens/cell >log || fail "its specimen: $(tail -3 log)"
cmp cell/sample.h5 specimens/cell/sample.h5 || fail "the specimen of a triaxial test differs"
"$mergel" info specimens/cell >log && grep -q 'results folder, finished' log || fail "info of its specimen: $(cat log)"
"$mergel" info cell >log && grep -q 'results folder, finished' log || fail "info of a triaxial test: $(cat log)"
from=cell cut_result localisation.csv 'localisation.csv does not begin with its heading' true
from=cell cut_result sample.h5 'sample.h5 .*' head -c 4000
for name in membrane.pvd fields/platens_0001.vtp sample.h5 localisation.csv history.csv; do
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
