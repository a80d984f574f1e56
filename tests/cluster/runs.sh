#!/usr/bin/env bash
# run.sbatch and array.sbatch under Slurm: one run on one node and on two, stopped by hand, cancelled, at its time
# limit; an array of seeds whose tests are read together at the end. The histories are those of the run that was never
# stopped, byte for byte.
#
# usage: tests/cluster/runs.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
start_cluster
run=("$batch/run.sbatch" element "$case_file" "${cell[@]}")

# One run.
submit --ntasks-per-node=2 "${run[@]}" --output one
one=$job
whole_run
to_its_end "$one" COMPLETED 0:0
says "$one" '2 ranks'
same_as_whole one
submit --nodes=2 --ntasks-per-node=1 "${run[@]}" --output both
to_its_end "$job" COMPLETED 0:0
same_as_whole both

# Stopped by hand on two nodes, and continued.
submit --nodes=2 --ntasks-per-node=1 "${run[@]}" --output stopped
while_running "$job" has_lines stopped 4
scancel --signal=TERM "$job"
to_its_end "$job" FAILED 2:0
says "$job" 'stopped by SIGTERM at step .*, checkpoint stopped/checkpoint_'
submit --ntasks-per-node=2 "${run[@]}" --output stopped --restart stopped
to_its_end "$job" COMPLETED 0:0
same_as_whole stopped

# Cancelled: what the last checkpoint has.
submit --ntasks-per-node=2 "${run[@]}" --output cancelled --set "Output/checkpoint every=50 steps"
while_running "$job" has_checkpoint cancelled
scancel "$job"
to_its_end "$job" CANCELLED 0:15
submit --ntasks-per-node=2 "${run[@]}" --output cancelled --restart cancelled
to_its_end "$job" COMPLETED 0:0
same_as_whole cancelled

# The time limit.
submit --ntasks-per-node=2 "${run[@]}" --output limited
while_running "$job" has_lines limited 4
at_time_limit "$job" TERM
to_its_end "$job" FAILED 2:0
says "$job" 'stopped by SIGTERM at step .*, checkpoint limited/checkpoint_'
submit --ntasks-per-node=2 "${run[@]}" --output limited --restart limited
to_its_end "$job" COMPLETED 0:0
same_as_whole limited

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
sacct --completion --format=JobID,JobName,NNodes,NodeList,State
echo "runs under Slurm: all as without it"
