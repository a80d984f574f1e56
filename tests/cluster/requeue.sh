#!/usr/bin/env bash
# requeue.sbatch under Slurm: a run that meets its time limit twice, started by srun and by mpirun, is queued again by
# itself, and its history is that of the run that was never stopped, byte for byte.
#
# usage: tests/cluster/requeue.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

# meets_its_limit RESULTS SIGNAL SBATCH_OPTION...: twice. SIGNAL is the first that reaches the ranks.
meets_its_limit()
{
  local results=$1 signal=$2 lap n=0
  shift 2
  submit "$@" "$batch/requeue.sbatch" element "$case_file" "$results" "${cell[@]}"
  for lap in 1 2; do
    while_running "$job" has_lines "$results" $((n + 4))
    at_time_limit "$job" "$signal"
    while_running "$job" has "$job" Restarts $lap
    record "$job"
    scontrol update "JobId=$job" TimeLimit=60
    n=$(wc -l <"$results/history.csv")
  done
  to_its_end "$job" COMPLETED 0:0
  [ "$(log_of "$job" | grep -Ec "stopped for the time limit at $results/checkpoint_.*: queued again")" -eq 2 ] ||
    fail "not queued again twice: $(log_of "$job" | grep requeue)"
  same_as_whole "$results"
}

meets_its_limit by_srun TERM --ntasks-per-node=2
meets_its_limit on_two_nodes TERM --nodes=2 --ntasks-per-node=1
MERGEL_LAUNCHER="mpirun --map-by core --bind-to core" meets_its_limit by_mpirun USR1 --ntasks-per-node=2
echo "requeue under Slurm: all as never stopped"
