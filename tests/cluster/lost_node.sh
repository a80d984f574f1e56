#!/usr/bin/env bash
# A node is lost while it runs requeue.sbatch: Slurm queues the job again, on the other node, where it goes on from
# its last checkpoint. Its history is that of the run that was never stopped, byte for byte.
#
# usage: tests/cluster/lost_node.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

submit --ntasks-per-node=1 "$batch/requeue.sbatch" element "$case_file" lost "${cell[@]}" --set "Output/checkpoint every=50 steps"
while_running "$job" has_checkpoint lost
record "$job"
first=$(field "$job" NodeList)
lose_node "$first"
wait_until is_node "$first" 'down*'
to_its_end "$job" COMPLETED 0:0
has "$job" Restarts 1 || fail "the job was not queued again"
[ "$(field "$job" NodeList)" != "$first" ] || fail "the job is on $first again"
says "$job" "restart from lost/checkpoint_"
same_as_whole lost
echo "a lost node: the run went on elsewhere"
