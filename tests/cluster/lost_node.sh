#!/usr/bin/env bash
# A node is lost while it runs requeue.sbatch: Slurm queues the job again, on the other node, where it goes on from
# its last checkpoint, once the ranks of the first start are gone. Its history is that of the run that was never
# stopped, byte for byte.
#
# usage: tests/cluster/lost_node.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

submit --ntasks-per-node=1 "$batch/requeue.sbatch" element "$case_file" lost "${cell[@]}" --set "Output/checkpoint every=50 steps"
halt_ranks "$job" has_checkpoint lost
record "$job"
first=$(field "$job" NodeList)
lose_node "$first"
wait_until is_node "$first" 'down*'
to_its_end "$job" COMPLETED 0:0
has "$job" Restarts 1 || fail "the job was not queued again"
[ "$(field "$job" NodeList)" != "$first" ] || fail "the job is on $first again"
says "$job" "restart from lost/checkpoint_"
same_as_whole lost

# A node whose slurmd does not answer, but whose ranks still run: the job waits for them on the other node, and goes on
# once that node is lost too.
start_node "${first#n}"
wait_until is_node "$first" idle
submit --ntasks-per-node=1 "$batch/requeue.sbatch" element "$case_file" deaf "${cell[@]}" --set "Output/checkpoint every=50 steps"
halt_ranks "$job" has_checkpoint deaf
first=$(field "$job" NodeList)
kill -KILL "$(pgrep -x slurmd -P "$(first_process "$first")")"
waits() { log_of "$job" | grep -q 'still writing in deaf: waiting for its end'; }
wait_until waits
record "$job"
[ "$(pgrep -xc mergel)" -eq 1 ] || fail "two runs in one folder"
lose_node "$first"
to_its_end "$job" COMPLETED 0:0
says "$job" "restart from deaf/checkpoint_"
same_as_whole deaf
echo "a lost node: the run went on elsewhere"
