#!/usr/bin/env bash
# run.sbatch and array.sbatch under Slurm on one node: a run with its ranks bound, cancelled, at its time limit
# under srun and under mpirun; an array of seeds whose tests are read together at the end. The histories are those of
# the run that was never stopped, byte for byte.
#
# usage: tests/cluster/runs.sh MERGEL     as root; see cluster.sh
task_plugin=affinity
. "$(dirname "$0")/cluster.sh"
start_cluster
run=("$batch/run.sbatch" element "$case_file" "${cell[@]}")

# One run, each rank on a core of its own.
cores_of_ranks() { for pid in $(pgrep -x mergel); do awk '/^Cpus_allowed_list/ { print $2 }' "/proc/$pid/status"; done | sort | tr '\n' ' '; }
submit --ntasks-per-node=2 "${run[@]}" --output one
halt_ranks "$job" has_lines one 2
cores=$(cores_of_ranks)
[ "$cores" = "0 1 " ] || fail "the ranks are bound to the processors $cores"
pkill -CONT -x mergel
one=$job
whole_run
to_its_end "$one" COMPLETED 0:0
same_as_whole one

# Cancelled: the ranks get SIGTERM, and so does srun, which kills them at once. What counts is the checkpoint before.
submit --ntasks-per-node=1 "${run[@]}" --output cancelled --set "Output/checkpoint every=50 steps"
halt_ranks "$job" has_checkpoint cancelled
scancel "$job"
to_its_end "$job" CANCELLED
submit --ntasks-per-node=1 "${run[@]}" --output cancelled --restart cancelled
to_its_end "$job" COMPLETED 0:0
same_as_whole cancelled

# The time limit.
submit --ntasks-per-node=1 "${run[@]}" --output limited
halt_ranks "$job" has_lines limited 4
meets_limit "$job"
go_on
to_its_end "$job" FAILED 2:0
says "$job" 'stopped by SIGTERM at step .*, checkpoint limited/checkpoint_'
submit --ntasks-per-node=1 "${run[@]}" --output limited --restart limited
to_its_end "$job" COMPLETED 0:0
same_as_whole limited

# The time limit of a job whose ranks no signal reaches: mergel knows it.
export MERGEL_LAUNCHER="mpirun --map-by core --bind-to core"
long=("${run[@]/strain = 0.2 %/strain = 20 %}") # some minutes, of which it gets 20 s
submit --ntasks-per-node=1 --time=1 "${long[@]/2e-3/1e-4}" --output in_time
to_its_end "$job" FAILED 2:0
says "$job" 'stopped before the end of --walltime at step .*, checkpoint in_time/checkpoint_'
submit --ntasks-per-node=1 "${run[@]}" --output by_mpirun
to_its_end "$job" COMPLETED 0:0
same_as_whole by_mpirun
unset MERGEL_LAUNCHER

# An array of seeds, two at a time, read together when all are done.
for seed in 1 2 3; do
  printf '%s' "$case_file"
  for ((k = 1; k < ${#cell[@]}; k += 2)); do printf ' | %s' "${cell[k]}"; done
  printf ' | Specimen/seed = %s\n' "$seed"
done >cases.txt
submit --array=1-3%2 --ntasks-per-node=1 "$batch/array.sbatch" element cases.txt study
array=$job
submit --dependency="afterok:$array" --output=together.log --wrap "$mergel compare study/* --output together"
for task in 1 2 3; do to_its_end "${array}_$task" COMPLETED 0:0; done
to_its_end "$job" COMPLETED 0:0
grep -q 'mean of 3' together.log || fail "the seeds are not read together: $(cat together.log)"
same_as_whole study/1_element_small
! cmp -s study/1_element_small/history.csv study/2_element_small/history.csv || fail "two seeds have one history"
sacct --completion --format=JobID,JobName,NNodes,NodeList,State 2>/dev/null # of arrays it says that it does not know a column
echo "runs under Slurm: all as without it"
