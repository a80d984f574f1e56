#!/usr/bin/env bash
# requeue.sbatch under Slurm: a run that meets its time limit twice, started by srun and by mpirun, queues itself again,
# and its history is that of the run that was never stopped, byte for byte.
#
# usage: tests/cluster/requeue.sh MERGEL     as root; see cluster.sh
task_plugin=affinity
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

meets_its_limit by_srun --ntasks-per-node=2
MERGEL_LAUNCHER="mpirun --map-by core --bind-to core" meets_its_limit by_mpirun --ntasks-per-node=1
echo "requeue under Slurm: all as never stopped"
