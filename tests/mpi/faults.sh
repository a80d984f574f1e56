#!/usr/bin/env bash
# What the owner of one grain alone finds wrong ends the run on all ranks together, in the same words
# on any number of ranks, and without MPI_Abort; only a rank that leaves alone takes the others down.
#
# usage: tests/mpi/faults.sh MPI_FAULTS
set -euo pipefail
faults=$(readlink -f "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# A container has no other user; ranks that share a processor must not spin.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1

fail() { echo "FAILED: $*"; exit 1; }
declare -A said=([drift]="particle 1234 moves" [force]="out of the range of the exact sums" [overlap]="overlap by" [nowhere]="overlap by -*nan")
for fault in drift force overlap nowhere; do
  for n in 1 2 3; do
    timeout 120 mpirun --oversubscribe -n $n "$faults" $fault >$n 2>&1 || fail "$fault on $n ranks: $(cat $n)"
    cmp 1 $n || fail "$fault on $n ranks: $(cat $n), on one: $(cat 1)"
  done
  grep -q "${said[$fault]}" 1 || fail "$fault is taken for something else: $(cat 1)"
  echo "$fault: $(cat 1)"
done
# A rank that refuses its input alone does not wait for ever.
code=0
timeout 60 mpirun --oversubscribe -n 3 "$faults" input >log 2>&1 || code=$?
[ $code -eq 1 ] && grep -q '^rank 2: my input is not yours' log || fail "input refused by one rank: exit code $code, $(cat log)"
echo "faults: all holds"
