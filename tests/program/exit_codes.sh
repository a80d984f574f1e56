#!/usr/bin/env bash
# The exit code of every job: 0 done, 1 bad input, 2 numerical or system failure
# (apps/run/run_guard.h; 3, a bug, cannot be caused from outside: tests/unit/apps/run_guard.cc). A
# limit on the size of a file stands for a full disk.
#
# usage: tests/program/exit_codes.sh MERGEL
# Prints one line for each check that fails, then a count; exit code 1 if any failed.
. "$(dirname "$0")/preamble.sh"
n_checks=0 n_failed=0
# Open MPI and PMIx have files of their own, which would reach the limit first.
export PMIX_MCA_gds=hash OMPI_MCA_btl=self

# ends NAME CODE PATTERN ARGUMENT...: mergel ends with this code; its last line on std::cerr matches.
# The variable `kib`, when set, is the largest file it may write.
ends()
{
  local name=$1 wanted=$2 pattern=$3 code=0
  shift 3
  n_checks=$((n_checks + 1))
  (
    trap '' XFSZ # otherwise the signal ends the program before the write fails
    ulimit -c 0 -f "${kib:-unlimited}"
    ulimit -t "${MERGEL_TEST_SECONDS:-300}"
    exec "$mergel" "$@" 2>&1 >/dev/null
  ) | tail -n 1 >errors || code=$?
  if [ "$code" -ne "$wanted" ] || { [ -n "$pattern" ] && ! grep -Eq -- "$pattern" errors; }; then
    n_failed=$((n_failed + 1))
    printf 'FAILED  %s: exit code %s, wanted %s: %s\n' "$name" "$code" "$wanted" "$(head -c 400 errors)"
  fi
}

long=$(printf 'x%.0s' {1..300}) # no file system takes such a name
tiny+=(--set "Output/frames=1")
pile=$root/apps/cases/pile_small.prm bond=$root/apps/cases/bond_fig5a.prm
bench=(bench --workload W1 --particles 200 --steps 4 --repeat 2)
no_run=(bench --workload W1 --particles 200)

ends "bench, done" 0 '' "${bench[@]}" --output t.csv
ends "bench, a folder that does not exist" 1 'none/t\.csv: the folder none does not exist' "${bench[@]}" --output none/t.csv
ends "bench, a block into such a folder" 1 'none/b: the folder none does not exist' "${no_run[@]}" --write-block none/b
ends "bench, a name too long" 1 'File name too long' "${bench[@]}" --output "$long"
echo mine >mine.txt
ends "bench, a block in place of another file" 1 'mine\.txt: exists, and is not what this option writes' "${no_run[@]}" --write-block mine.txt
ends "bench, a checkpoint in place of another file" 1 'mine\.txt: exists, and is not what this option writes' "${no_run[@]}" --checkpoint mine.txt
ends "bench, a table in place of another file" 1 'mine\.txt: exists and is not a table' "${bench[@]}" --output mine.txt
[ "$(cat mine.txt)" = mine ] || { echo "FAILED  bench replaced a file of the user"; n_failed=$((n_failed + 1)); }
for file in block.bin block.bin; do ends "bench, a block twice" 0 '' "${no_run[@]}" --write-block "$file"; done
for file in bench.h5 bench.h5; do ends "bench, a checkpoint twice" 0 '' "${no_run[@]}" --checkpoint "$file"; done
kib=1 ends "bench, the disk is full" 2 'block\.txt: cannot be written: File too large' "${no_run[@]}" --write-block block.txt

ends "bond, done" 0 '' bond "$bond" --output bond
ends "bond, a results folder with a name too long" 1 'cannot be created: File name too long' bond "$bond" --output "$long"
ends "bond, a path with a name too long" 1 'cannot be read: File name too long' bond "$bond" --set "Loading/path=$long" --output none
kib=8 ends "bond, the disk is full" 2 'history\.csv: cannot be written any further' bond "$bond" --output full_bond

ends "bond, a walltime" 1 'mergel bond: --walltime 4h: the job writes no checkpoints' bond "$bond" --walltime 4h --output none
ends "sample, a walltime" 1 'mergel sample: --walltime 4h: the job writes no checkpoints' sample "$pile" --walltime 4h --output none

ends "sample, done" 0 '' sample "$pile" "${tiny[@]}" --output sample
kib=16 ends "sample, the disk is full" 2 'sample\.h5: cannot be written: File too large' sample "$pile" "${tiny[@]}" --output full_sample

ends "pile, a sample with a name too long" 1 'cannot be read: File name too long' pile "$pile" --set "Specimen/file=$long" --output none
ends "pile, the run is unstable" 2 '[a-z]' pile "$pile" "${tiny[@]}" --set "Specimen/file=sample/sample.h5" \
  --set "Pile/penetration rate=2000 m/s" --output fast
kib=56 ends "pile, the disk is full" 2 '(particles|bonds)_0000\.vtp: cannot be written: File too large' pile "$pile" "${tiny[@]}" \
  --set "Specimen/file=sample/sample.h5" --output full_pile
ends "pile, done" 0 '' pile "$pile" "${tiny[@]}" --set "Specimen/file=sample/sample.h5" --set "Pile/cone angle=150 degree" \
  --set "Pile/final depth=0.02 mm" --output pile
ends "no job" 1 'no job is given'
ends "help" 0 '' --help

[ ! -e full_sample/sample.h5 ] || { echo "FAILED  a sample exists that could not be written"; n_failed=$((n_failed + 1)); }
echo "exit codes: $((n_checks - n_failed)) of $n_checks as they should be"
[ "$n_failed" -eq 0 ]
