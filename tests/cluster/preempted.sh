#!/usr/bin/env bash
# requeue.sbatch under Slurm, where a job of another partition takes its node, at once and with a grace time: it is queued
# again, and its history is that of the run that was never stopped, byte for byte.
#
# usage: tests/cluster/preempted.sh MERGEL     as root; see cluster.sh
partitions='PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
PartitionName=at_once Nodes=ALL PriorityTier=1 MaxTime=INFINITE State=UP
PartitionName=with_grace Nodes=ALL PriorityTier=1 GraceTime=600 MaxTime=INFINITE State=UP
PartitionName=first Nodes=ALL PriorityTier=10 PreemptMode=OFF MaxTime=INFINITE State=UP'
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

for partition in at_once with_grace; do
  submit --ntasks-per-node=1 --partition=$partition "$batch/requeue.sbatch" element "$case_file" $partition "${cell[@]}" \
    --set "Output/checkpoint every=50 steps"
  halt_ranks "$job" has_checkpoint $partition
  sbatch --partition=first --nodes=2 --exclusive --wrap "sleep 1"
  wait_until was_restarted "$job" 1
  to_its_end "$job" COMPLETED 0:0
  has "$job" Restarts 1 || fail "$partition: not queued again: $(log_of "$job" | tail -3)"
  same_as_whole $partition
done
says "$job" 'stopped for another job at with_grace/checkpoint_.*: queued again'
echo "preempted jobs: all as never stopped"
