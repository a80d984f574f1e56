#!/usr/bin/env bash
# An error that only the owner of a particle detects ends the run on all ranks together, with the same
# message on any number of ranks and without MPI_Abort; only a rank that fails alone aborts the others.
#
# usage: tests/mpi/faults.sh MPI_FAULTS
faults=$(readlink -f "$1")
. "$(dirname "$0")/../program/preamble.sh"
declare -A said=([drift]="particle 1234 moves" [force]="out of the range of the exact sums" [overlap]="overlap by" [nowhere]="overlap by -*nan")
for fault in drift force overlap nowhere; do
  for n in 1 2 3; do
    on_ranks $n "$faults" $fault >$n 2>&1 || fail "$fault on $n ranks: $(cat $n)"
    cmp 1 $n || fail "$fault on $n ranks: $(cat $n), on one: $(cat 1)"
  done
  grep -q "${said[$fault]}" 1 || fail "$fault gives another message: $(cat 1)"
  echo "$fault: $(cat 1)"
done
# A rank that alone refuses its input does not wait for ever.
code=0
on_ranks 3 "$faults" input >log 2>&1 || code=$?
[ $code -eq 1 ] && grep -q '^rank 2: my input is not yours' log || fail "input refused by one rank: exit code $code, $(cat log)"
echo "faults: all checks hold"
