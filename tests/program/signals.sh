#!/usr/bin/env bash
# The ways in which people and queues end runs: SIGTERM, Ctrl-C (SIGINT), a closed terminal (SIGHUP), a limit of
# processor time (SIGXCPU), a queue's warning (SIGUSR2), a pipe that nobody reads (SIGPIPE), nohup, a standard output that is full or closed. The run stops behind a
# checkpoint and is continued, or goes on by itself: its results are those of a run that was never
# disturbed, byte for byte.
#
# usage: tests/program/signals.sh MERGEL
. "$(dirname "$0")/preamble.sh"
case_file=$root/apps/cases/element_small.prm
tiny=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial to axial strain = 1 %"
  --set "Loading/stage 3=" --set "Loading/stage 4=")
has_lines() { [ "$(cat "$1/history.csv" 2>/dev/null | wc -l)" -ge "$2" ]; }
# Without job control a shell lets its background jobs ignore SIGINT.
begin() { launch env --default-signal=INT,HUP,PIPE "$mergel" element "$case_file" "${tiny[@]}" --output "$1" >log 2>&1; }
same() {
  cmp whole/history.csv "$1/history.csv" || fail "$1: the history differs"
  diff -r whole/fields "$1/fields" >/dev/null || fail "$1: the fields differ"
  "$mergel" info "$1" >info && grep -q 'results folder, finished' info || fail "$1: $(cat info)"
}

bounded "$mergel" element "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"

for signal in TERM INT HUP XCPU USR2 PIPE; do
  begin "$signal"
  signal_when "$signal" has_lines "$signal" 4
  code=0; wait $launched || code=$?
  if [ "$signal" = PIPE ]; then # not a request to end
    [ "$code" -eq 0 ] || fail "SIGPIPE: exit code $code: $(tail -3 log)"
  else
    [ "$code" -eq 2 ] || fail "SIG$signal: exit code $code: $(tail -3 log)"
    grep -q "stopped by SIG$signal at step .*, checkpoint $signal/checkpoint_.*Continue with: mergel element --restart $signal\$" log ||
      fail "SIG$signal: $(tail -3 log)"
    [ ! -e "$signal/summary.json" ] || fail "SIG$signal: a stopped run has a summary"
    bounded "$mergel" element --restart "$signal" >log || fail "SIG$signal, continued: $(tail -3 log)"
  fi
  same "$signal"
done

# On two ranks, of which one gets the signal.
launch env --default-signal=INT,HUP mpirun --oversubscribe -n 2 "$mergel" element "$case_file" "${tiny[@]}" --output two >log 2>&1
signal_when HUP has_lines two 4
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] && [ "$(grep -c 'stopped by SIGHUP at step' log)" -eq 1 ] || fail "SIGHUP on two ranks: exit code $code: $(tail -3 log)"
bounded "$mergel" element --restart two >log || fail "SIGHUP on two ranks, continued: $(tail -3 log)"
same two

# nohup: the closed terminal ends nothing.
launch nohup "$mergel" element "$case_file" "${tiny[@]}" --output nohup >log 2>&1
signal_when HUP has_lines nohup 4
wait $launched || fail "nohup: $(tail -3 log)"
same nohup

# A standard output that nobody reads, or that is full or closed, ends no run.
bounded "$mergel" element "$case_file" "${tiny[@]}" --output piped 2>log | head -1 >/dev/null || fail "a pipe that is closed: $(cat log)"
same piped
bounded "$mergel" element "$case_file" "${tiny[@]}" --output full 2>log >/dev/full || fail "a full standard output: $(cat log)"
same full
bounded "$mergel" element "$case_file" "${tiny[@]}" --output closed 2>log >&- || fail "a closed standard output: $(cat log)"
same closed

# Where it is the product the loss is said; a reader that has seen enough is no loss.
for arguments in "info whole" "--help" "--version" "pile --help" "bench --workload W1 --particles 200 --steps 4 --repeat 2"; do
  for closed in '>/dev/full' '>&-'; do
    code=0
    # shellcheck disable=SC2086
    eval "bounded \"\$mergel\" $arguments 2>log $closed" || code=$?
    [ "$code" -eq 2 ] && grep -q '^the standard output cannot be written: ' log || fail "mergel $arguments $closed: exit code $code: $(cat log)"
  done
  # shellcheck disable=SC2086
  bounded "$mergel" $arguments 2>log | true || fail "mergel $arguments, not read: $(cat log)"
  [ ! -s log ] || fail "mergel $arguments, not read: $(cat log)"
done

# A job without checkpoints is ended at once.
launch env --default-signal=INT,HUP "$mergel" bond "$root/apps/cases/bond_fig4a_tension.prm" --set "Loading/steps per stage=10000000" --output pair >log 2>&1
wait_for has_lines pair 2
kill -INT $launched
code=0; wait $launched || code=$?
[ "$code" -eq 130 ] || fail "SIGINT to a job without checkpoints: exit code $code: $(cat log)"
echo "signals: all checks hold"
