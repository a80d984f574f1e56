#!/usr/bin/env bash
# A small Brazilian test, stopped by SIGTERM on two ranks before the peak and on three ranks while it breaks, and ended on
# one: its history, results and pictures are those of a run that was never stopped, byte for byte, and so are those of 2 and
# 3 ranks. Also tests which keys a restart may change.
#
# usage: tests/program/brazilian_restart.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
brazilian() { bounded "$mergel" brazilian "$@"; }
lines() { cat "$1/history.csv" 2>/dev/null | wc -l; }
has_lines() { [ "$(lines a)" -ge "$1" ]; }
case_file=$root/apps/cases/brazilian_small.prm
tiny=(--set "Specimen/diameter=4.5 mm" --set "Specimen/height=2.4 mm" --set "Loading/velocity=50 mm/s"
  --set "Strength variability/distribution=Weibull" --set "Strength variability/coefficient of variation=0.3")

brazilian "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
n=$(lines whole)
[ "$(value whole "bonds broken [-]")" -gt 20 ] || fail "20 bonds or fewer broke"
read -r early late < <(records whole '!early && c("load P [N]") > 5 { early = NR } !late && c("broken bonds [-]") > 10 { late = NR }
  END { print early + 0, late + 0 }')
[ "$early" -gt 2 ] && [ "$late" -gt $((early + 2)) ] && [ "$n" -gt $((late + 5)) ] || fail "lines $early, $late of $n"

# RANKS LINES ARGUMENTS...: run, stopped once it has written so many lines.
stopped() {
  local n_ranks=$1 n_lines=$2 code=0
  shift 2
  launch mpirun --oversubscribe -n "$n_ranks" "$mergel" brazilian "$@" >log 2>&1
  signal_when TERM has_lines "$n_lines"
  wait $launched || code=$?
  [ "$code" -eq 2 ] && grep -q 'stopped by SIGTERM at step .* (strain .*), checkpoint a/checkpoint_' log ||
    fail "SIGTERM on $n_ranks ranks: exit code $code: $(cat log)"
  [ ! -e a/summary.json ] || fail "a stopped run has a summary"
}
# FOLDER: equal to the whole run
same() {
  cmp whole/history.csv "$1/history.csv" || fail "the history of $1 differs"
  diff <(physics whole) <(physics "$1") || fail "the summary of $1 differs"
  diff -r whole/fields "$1/fields" >log || fail "the pictures of $1 differ: $(cat log)"
  for series in particles bonds contacts breaks plates; do
    cmp "whole/$series.pvd" "$1/$series.pvd" || fail "the series of pictures of $1 differs"
  done
}
stopped 2 "$early" "$case_file" "${tiny[@]}" --output a
stopped 3 "$late" --restart a
brazilian --restart a >log || fail "the end: $(tail -3 log)"
same a
"$mergel" info a >info || fail "info: $(cat info)"
for ranks in 2 3; do
  on_ranks $ranks "$mergel" brazilian "$case_file" "${tiny[@]}" --output on$ranks >log 2>&1 || fail "on $ranks ranks: $(tail -3 log)"
  same on$ranks
done

# Nothing is left to do, unless the end is moved; nothing else may change.
[ "$(code_of brazilian --restart a)" -eq 0 ] && grep -q 'the load fell below its final share\. To load the disc further' log ||
  fail "done twice: $(cat log)"
same a
brazilian --restart a --output b --set "Loading/final load=0.3" >log || fail "further: $(tail -3 log)"
[ "$(lines b)" -gt "$n" ] && cmp <(head -n "$n" b/history.csv) whole/history.csv || fail "a test taken further differs before its old end"
# NAME PATTERN SETTING: refused, in one line, before anything is written
refused() {
  [ "$(code_of brazilian --restart a --output c --set "$3")" -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q -- "$2" log ||
    fail "$1: $(cat log)"
  [ ! -e c ] || fail "$1: a refused restart wrote something"
}
refused "another velocity" 'Loading/velocity was 50 mm/s, the case asks for 20 mm/s' "Loading/velocity=20 mm/s"
refused "rough plates" 'Plates/friction was 0, the case asks for 0.5' "Plates/friction=0.5"
refused "another disc" 'Specimen/height was 2.4 mm, the case asks for 3 mm' "Specimen/height=3 mm"
# Before the end of a walltime.
[ "$(code_of brazilian "$case_file" "${tiny[@]}" --output d --walltime "0.1 s")" -eq 2 ] &&
  grep -q 'stopped before the end of --walltime' log || fail "walltime: $(cat log)"
echo "brazilian restart: all checks hold, $n lines of history; stopped at lines $early and $late"
