#!/usr/bin/env bash
# Checkpoints of a small coupled pile: stopped by SIGTERM on two ranks, restarted on one and three
# with the same bits; SIGUSR1; --walltime; a full disk; a damaged newest checkpoint; a changed
# case; mergel info.
#
# usage: tests/program/restart.sh MERGEL
. "$(dirname "$0")/preamble.sh"
tiny+=("${shallow[@]}" --set "Output/frames=2")
pile() { bounded "$mergel" pile "$@"; }
ranks() { on_ranks "$1" "$mergel" pile "${@:2}"; }
checkpoints() { compgen -G "$1/checkpoint_*.h5" | wc -l; }
newest() { compgen -G "$1/checkpoint_*.h5" | sort | tail -1; }
same() {
  cmp whole/history.csv "$1/history.csv" || fail "$1: the history differs"
  for file in whole/fields/*; do cmp "$file" "$1/${file#whole/}" || fail "$1: $file differs"; done
}

pile "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
[ "$(checkpoints whole)" -eq 1 ] && "$mergel" info whole | grep -q ', finished, step .* good' ||
  fail "not one checkpoint, at the end: $(ls whole)"
cp whole/sample.h5 .
tiny+=(--set "Specimen/file=$work/sample.h5")

# SIGTERM to one of two ranks, while the assembly settles.
launch mpirun --oversubscribe -n 2 "$mergel" pile "$case_file" "${tiny[@]}" --output a \
  --set "Output/checkpoint every=20 steps" >log 2>&1
signal_when TERM exists "a/checkpoint_*.h5"
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] || fail "SIGTERM on two ranks: exit code $code: $(tail -3 log)"
[ "$(grep -c 'stopped by SIGTERM at step .*(settling), checkpoint a/checkpoint_' log)" -eq 1 ] ||
  fail "SIGTERM on two ranks: $(tail -3 log)"
grep -q 'Continue with: mergel pile --restart a$' log || fail "how to continue: $(tail -3 log)"
[ "$(checkpoints a)" -le 2 ] || fail "$(checkpoints a) checkpoints are kept, not two"
# Restarted on three ranks without a case file; SIGUSR1 asks for a checkpoint and the run continues,
# then SIGTERM during the penetration.
launch mpirun --oversubscribe -n 3 "$mergel" pile --restart a --set "Output/checkpoint every=never" >log 2>&1
wait_for exists "a/fields/particles_0000.vtp"
first=$(pgrep -P "$launched" mergel | head -1)
rm a/checkpoint_*.h5
kill -USR1 "$first"
wait_for exists "a/checkpoint_*.h5"
kill -TERM "$first"
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] || fail "SIGTERM on three ranks: exit code $code: $(tail -3 log)"
grep -q '(penetration), checkpoint a/' log || fail "not in the penetration: $(tail -3 log)"
"$mergel" info a >info || fail "info: $(cat info)"
grep -q 'not finished' info && grep -q 'penetration, step .* good' info || fail "info: $(cat info)"
pile --restart a >log || fail "the end on one rank: $(tail -3 log)"
same a

# The walltime ends a run; a run into another folder begins with what the first one wrote.
[ "$(code_of pile "$case_file" "${tiny[@]}" --output b --walltime "1 s")" -eq 2 ] || fail "walltime: $(tail -3 log)"
grep -q 'stopped before the end of --walltime' log || fail "walltime: $(tail -3 log)"
pile --restart b --output c >log || fail "another folder: $(tail -3 log)"
same c
[ "$(checkpoints b)" -gt 0 ] || fail "a restart into another folder changed the first"

# A full disk, as a file-size limit: no file can be written, then none as large as a checkpoint. The
# limit holds for the ranks, but not for their shared memory: they speak by TCP.
limited() { # blocks of 1024 bytes
  PMIX_MCA_gds=hash OMPI_MCA_btl=self,tcp on_ranks 2 \
    bash -c 'ulimit -f "$1"; shift; exec "$@"' limited "$1" "$mergel" pile "${@:2}"
}
for blocks in 8 150; do
  rm -rf d; cp -r b d
  held=$(newest d)
  cp "$held" held.h5; cp d/history.csv held.csv
  code=$(code_of limited $blocks --restart d --set "Output/checkpoint every=20 steps")
  [ "$code" -eq 2 ] || fail "a file-size limit of $blocks kB: exit code $code: $(cat log)"
  cmp "$held" held.h5 || fail "the last good checkpoint was touched"
  if [ "$blocks" -eq 150 ]; then
    grep -q 'checkpoint_.*cannot be written: File too large.*the last good checkpoint is d/checkpoint_' log ||
      fail "a full disk: $(cat log)"
    [ "$(grep -c 'cannot be written' log)" -eq 1 ] || fail "a full disk is reported more than once: $(cat log)"
    grep -q HDF5-DIAG log && fail "HDF5 prints its errors: $(cat log)"
    cmp held.csv d/history.csv || fail "the history was touched"
    [ -z "$(find d -name '.*partial*')" ] || fail "left over: $(find d -name '.*partial*')"
  fi
  "$mergel" info d >info || fail "after a full disk: $(cat info)"
done
pile --restart d >log || fail "after a full disk: $(tail -3 log)"
same d

# A damaged newest checkpoint is reported, and the older one used.
rm -rf e; cp -r b e
older=$(basename "$(newest e)")
head -c 20000 "e/$older" >e/checkpoint_999999999999.h5
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q 'truncated' log || fail "info of a damaged one: $(cat log)"
[ "$(code_of pile --restart e/checkpoint_999999999999.h5)" -eq 1 ] || fail "a damaged one: $(cat log)"
grep -q "is no checkpoint, or is truncated; .*a good one is e/$older" log || fail "a damaged one: $(cat log)"
# Lines of the history after the checkpoint are dropped, a cut one too.
printf '1,2,3\n4,5' >>e/history.csv
# A changed case is refused with the key; keys of the output may change.
[ "$(code_of pile "$case_file" "${tiny[@]}" --restart e --set "Pile/friction=0.3")" -eq 1 ] || fail "a changed case"
grep -q 'Pile/friction was 0.2, the case asks for 0.3' log || fail "a changed case: $(cat log)"
pile --restart e --set "Output/frames=1" >log || fail "a changed number of frames: $(tail -3 log)"
grep -q "cannot be used: e/checkpoint_999999999999.h5: is no checkpoint" log || fail "the damaged one is not reported: $(cat log)"
grep -q 'Output/frames was 2, is now 1' log || fail "the change is not reported: $(cat log)"
cmp whole/history.csv e/history.csv || fail "the history differs"
[ "$(ls e/fields | wc -l)" -eq 12 ] || fail "frames: $(ls e/fields)"
grep -q 'set aside: e/checkpoint_999999999999.h5.aside' log && [ -e e/checkpoint_999999999999.h5.aside ] ||
  fail "the damaged one was not kept: $(ls e)"

# After an instability the same step would fail again: a restart may have another share of the stable step,
# with effect at once. Both steps are columns of the history.
column() { # NAME FILE: of all lines
  awk -F, -v name="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k; next } { print $at }' "$2"
}
takes() { # FOLDER SHARE: of the stable step, in the last line, to the digits of the history
  paste -d' ' <(column "time step [s]" "$1/history.csv") <(column "stable step [s]" "$1/history.csv") |
    awk -v share="$2" '{ s = $1 / $2 } END { exit !(s > share * (1 - 1e-4) && s < share * (1 + 1e-4)) }'
}
takes whole 0.9 || fail "the default share of the stable step is not 0.9: $(tail -1 whole/history.csv)"
for safety in 0.45 0.95; do
  rm -rf e; cp -r b e
  pile --restart e --set "Motion/time step safety=$safety" >log || fail "time step safety $safety: $(tail -3 log)"
  grep -q "Motion/time step safety was 0.9, is now $safety" log || fail "the change is not reported: $(cat log)"
  takes e "$safety" || fail "the share of the stable step is not $safety: $(tail -1 e/history.csv)"
done
[ "$(code_of pile --restart b --output none --set "Motion/time step safety=1.6")" -eq 1 ] &&
  grep -q 'Motion/time step safety = 1.6' log || fail "a share of 1.6: $(cat log)"
[ ! -e none ] || fail "a refused restart wrote something"

# A newer checkpoint that is not damaged is not passed over: of another user, of a newer program, here a
# link to nowhere.
rm -rf e; cp -r b e
ln -s /nowhere e/checkpoint_999999999999.h5
[ "$(code_of pile --restart e)" -eq 1 ] || fail "a newer checkpoint was passed over: $(cat log)"
grep -q "there is no such file. It may be complete.*choose an older one with --restart e/$older" log || fail "an unreadable one: $(cat log)"
[ -L e/checkpoint_999999999999.h5 ] || fail "the unreadable one is gone"

# A file that one rank cannot see ends the run on all of them, before anything is written.
cp "$case_file" case.prm
mkdir elsewhere
blind() {
  on_ranks 2 bash -c '[ "$OMPI_COMM_WORLD_RANK" = 0 ] || cd elsewhere; exec "$@"' blind "$mergel" pile "$@"
}
for arguments in "--restart b" "--restart b/$older" "case.prm"; do
  # shellcheck disable=SC2086
  [ "$(code_of blind $arguments --output none)" -eq 1 ] || fail "$arguments, seen by one rank of two: $(cat log)"
  grep -q '^rank 1: .*\(there is no such file\|no such case file\)' log || fail "$arguments, seen by one rank of two: $(cat log)"
  [ ! -e none ] || fail "$arguments, seen by one rank of two: something was written"
done

# The same for files that differ between the ranks: an edited case, another checkpoint of the same name.
sed 's/set friction *= .*/set friction = 0.3/' case.prm >elsewhere/case.prm
[ "$(code_of blind case.prm --output none)" -eq 1 ] || fail "two cases: $(cat log)"
grep -q '^rank 1: Pile/friction is 0.3 here and 0.2 on the first rank' log || fail "two cases: $(cat log)"
cp -r b elsewhere/b
cp "$(newest a)" "elsewhere/b/$older"
[ "$(code_of blind --restart b --output none)" -eq 1 ] || fail "two checkpoints: $(cat log)"
grep -q '^rank 1: --restart b/.*its content differs from that on the first rank' log || fail "two checkpoints: $(cat log)"
[ ! -e none ] || fail "read differently: something was written"
# A local results folder on a node is reported before the first step, not at the first checkpoint.
[ "$(code_of blind "$work/case.prm" "${tiny[@]}" --output none)" -eq 1 ] || fail "a local folder: $(cat log)"
grep -q '^rank 1: output folder none: rank 1 on .* does not see the file that rank 0' log || fail "a local folder: $(cat log)"
rm -rf none elsewhere/*

# One run at a time in a folder; a killed run does not block it.
rm -rf g; cp -r b g
"$mergel" pile --restart g >log_of_first 2>&1 &
first=$!
launched=$first
wait_for test -s "g/.mergel.lock" # it names the process that holds it
kill -STOP $first
[ "$(code_of pile --restart g)" -eq 1 ] || fail "two runs in a folder: $(cat log)"
grep -q "output folder g: another run (process $first on .*) is writing there" log || fail "two runs in a folder: $(cat log)"
kill -KILL $first
wait $first 2>/dev/null || true
pile --restart g >log 2>&1 || fail "after a killed run: $(tail -3 log)"
same g
[ ! -e g/.mergel.lock ] || fail "the lock is left over"

name=$(basename "$(newest b)")
# A run that is just ending writes another checkpoint: the next run waits, then continues from it.
rm -rf g; cp -r b g
"$mergel" pile --restart g --set "Output/checkpoint every=10 steps" >log_of_first 2>&1 &
first=$!
launched=$first
has_another() { [ "$(basename "$(newest g)")" != "$name" ]; }
wait_for has_another
kill -STOP $first
before=$(newest g)
"$mergel" pile --restart g --walltime "0.1 s" >log 2>&1 &
next=$!
sleep 1
kill -TERM $first
kill -CONT $first
wait $first || true
wait $next || true
taken=$(grep -o 'checkpoint g/checkpoint_[0-9]*.h5' log_of_first | tail -1)
[ "${taken#checkpoint }" != "$before" ] || fail "the ending run wrote none: $(cat log_of_first)"
grep -q "^restart from ${taken#checkpoint }: " log || fail "not from ${taken#checkpoint }: $(cat log)"
grep -q 'set aside' log && fail "the newer checkpoint was set aside: $(cat log)"

# In another folder the checkpoint is written first: without it the next restart would start anew.
mkdir -p h/resolved.prm
[ "$(code_of pile --restart b --output h)" -eq 2 ] || fail "a folder in the way: $(cat log)"
[ "$(checkpoints h)" -eq 1 ] || fail "the checkpoint was not written first: $(ls h)"

# Another folder can be restarted at once: the checkpoint is copied to it.
[ "$(code_of pile --restart b --output f --set "Output/checkpoint every=never" --walltime "0.1 s")" -eq 2 ] ||
  fail "another folder, ended at once: $(tail -3 log)"
[ "$(checkpoints f)" -gt 0 ] || fail "no checkpoint was copied: $(ls f)"
pile --restart f >log || fail "the other folder: $(tail -3 log)"
same f

# A run that starts anew removes no results.
"$mergel" bond "$root/apps/cases/bond_fig4a_tension.prm" --output bond >log || fail "bond: $(cat log)"
[ "$(code_of "$mergel" bond --restart bond)" -eq 1 ] && grep -q 'holds a finished run' log || fail "a finished bond: $(cat log)"
[ "$(code_of "$mergel" bond "$root/apps/cases/bond_fig4a_tension.prm" --restart b)" -eq 1 ] && grep -q 'holds a run with checkpoints' log || fail "bond over a pile: $(cat log)"
[ -e "b/$name" ] || fail "the checkpoint of b is gone"

# A lost history is reported, and begins at the checkpoint; another one is refused.
rm -rf e; cp -r b e; rm e/history.csv
pile --restart e >log || fail "a lost history: $(tail -3 log)"
grep -q '^e/history.csv: is missing, and begins at the checkpoint$' log || fail "a lost history: $(cat log)"
cmp <(tail -n +3 e/history.csv) <(tail -n "$(($(wc -l <e/history.csv) - 2))" whole/history.csv) ||
  fail "after a lost history other lines follow"
[ "$(sed -n 2p e/history.csv)" = "$(head -1 whole/history.csv)" ] || fail "a history without its heading"
head -1 e/history.csv | grep -q '^# begins behind' || fail "a history does not say that it lacks its beginning"
rm -rf e; cp -r b e; sed -i '1s/time/Time/' e/history.csv
[ "$(code_of pile --restart e)" -eq 1 ] && grep -q 'history.csv: does not begin as it did.*or move it away' log ||
  fail "another history: $(cat log)"
[ "$(code_of pile --restart sample.h5)" -eq 1 ] && grep -q 'sample.h5: is no checkpoint' log || fail "a sample: $(cat log)"
long=$(printf 'x%.0s' {1..300})
[ "$(code_of pile --restart "$long")" -eq 1 ] && grep -q 'File name too long' log || fail "a long name: $(cat log)"
[ "$(code_of pile --restart nowhere)" -eq 1 ] && grep -q 'holds neither a checkpoint nor' log || fail "nowhere: $(cat log)"
# mergel info: another folder, a failed run, a lost frame, checkpoints set aside, and a run that writes.
[ "$(code_of "$mergel" info elsewhere)" -eq 1 ] && grep -q 'is no results folder' log || fail "info of another folder: $(cat log)"
rm -rf e; cp -r whole e
"$mergel" info e >info || fail "info: $(cat info)"
grep -q 'summary.json, good' info && grep -q 'results folder, finished' info || fail "info: $(cat info)"
frame=$(ls e/fields/bonds_* | tail -1)
head -c 500 "$frame" >cut; mv cut "$frame"
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q "$frame: is cut" log || fail "info of a cut frame: $(cat log)"
rm -rf e; cp -r whole e
echo '{ "work' >e/summary.json
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q 'summary.json cannot be read' log || fail "info of a cut summary: $(cat log)"
rm e/summary.json; echo '{ "failure": "the sides are unstable" }' >e/failed.json
"$mergel" info e >info && grep -q 'failed: the sides are unstable' info || fail "info of a failed run: $(cat info)"
rm -rf e; cp -r a e
rm "$(ls e/fields/bonds_* | head -1)"
[ "$(code_of "$mergel" info e)" -eq 1 ] && grep -q '^  missing  *fields/bonds_0000.vtp$' log || fail "info of a lost frame: $(cat log)"
rm -rf e; cp -r b e; cp "e/$name" "e/$name.aside"
flock e/.mergel.lock bash -c 'touch held; until [ -e release ] || [ ! -e held ]; do sleep 0.05; done' &
launched=$!
wait_for exists held
"$mergel" info e >info || fail "info: $(cat info)"
touch release
grep -q 'is writing there' info && grep -q 'set aside *1 checkpoints' info || fail "info: $(cat info)"
wait
"$mergel" info sample.h5 >info && grep -q 'porosity' info || fail "info of a sample: $(cat info)"
echo "restart: all checks hold"
