#!/usr/bin/env bash
# requeue.sbatch under Slurm: a run that meets its time limit, twice under srun and once under mpirun, queues itself again,
# and its history is that of the run that was never stopped, byte for byte.
#
# usage: tests/cluster/requeue.sh MERGEL     as root; see cluster.sh
task_plugin=affinity
. "$(dirname "$0")/cluster.sh"
start_cluster
whole_run

meets_its_limit by_srun 2 --ntasks-per-node=2
MERGEL_LAUNCHER="mpirun --map-by core --bind-to core" meets_its_limit by_mpirun 1 --ntasks-per-node=1
echo "requeue under Slurm: all as never stopped"
