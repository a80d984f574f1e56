#!/usr/bin/env bash
# One run on two nodes under Slurm: to its end, stopped by hand, and at its time limit, which it meets twice. Its
# history is that of the run without Slurm, byte for byte.
#
# usage: tests/cluster/two_nodes.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run
run=(--nodes=2 --ntasks-per-node=1 "$batch/run.sbatch" element "$case_file" "${cell[@]}")

submit "${run[@]}" --output both
to_its_end "$job" COMPLETED 0:0
has "$job" NodeList 'n[1-2]' || fail "the job is on $(field "$job" NodeList)"
same_as_whole both

submit "${run[@]}" --output stopped
halt_ranks "$job" has_lines stopped 4
scancel --signal=TERM "$job"
go_on
to_its_end "$job" FAILED 2:0
says "$job" 'stopped by SIGTERM at step .*, checkpoint stopped/checkpoint_'
submit "${run[@]}" --output stopped --restart stopped
to_its_end "$job" COMPLETED 0:0
same_as_whole stopped

meets_its_limit limited 2 --nodes=2 --ntasks-per-node=1
echo "two nodes under Slurm: all as on one rank"
