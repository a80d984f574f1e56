#!/usr/bin/env bash
# What the batch scripts do, with stand-ins for srun, scancel, mpirun, scontrol and mergel: which command
# they start, and which signals they send at the time limit, when the job is cancelled or when the run fails.
#
# usage: tests/program/batch.sh
# Prints one line for each check that fails, then a count; exit code 1 if any failed.
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
batch=$root/apps/batch
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
n_checks=0 n_failed=0

# check NAME COMMAND...: the command must succeed.
check()
{
  local name=$1
  shift
  n_checks=$((n_checks + 1))
  if ! "$@" >/dev/null 2>&1; then
    n_failed=$((n_failed + 1))
    echo "FAILED  $name: $*"
    sed 's/^/        | /' log 2>/dev/null || true
  fi
}
said() { grep -Eq -- "$1" log; }
called() { grep -Fxq -- "$1" calls; }
never_called() { ! grep -q -- "^$1" calls; }
is() { [ "$1" = "$2" ]; }

## the stand-ins: each call is a line of the file `calls`
mkdir bin build
cat >bin/srun <<'STUB'
#!/usr/bin/env bash
# Starts the run. On SIGTERM, SIGINT and SIGHUP it sends SIGKILL to the run ("forcing job
# termination"). It forwards other signals (Slurm's src/srun, the manager of its signals).
echo "srun $*" >>calls
while [[ $1 == -* ]]; do shift; done
"$@" &
echo $! >ranks
trap 'n=1; echo "KILL" >>calls; kill -KILL $!' TERM INT HUP
trap 'n=1; kill -USR1 $!' USR1
n=1
while [ $n -gt 0 ]; do n=0; wait $! && code=0 || code=$?; done # a signal ends wait, not the run
exit $code
STUB
cat >bin/scancel <<'STUB'
#!/usr/bin/env bash
# With --signal: signals the steps of the job, neither its script nor srun.
echo "scancel $*" >>calls
[ ! -e no_scancel ] || exit 1
[ "$1" = --signal=TERM ] && kill -TERM "$(cat ranks)"
STUB
cat >bin/mpirun <<'STUB'
#!/usr/bin/env bash
# Forwards SIGUSR1; after SIGTERM it kills the run, as mpirun does after a second.
echo "mpirun $*" >>calls
while [[ $1 == -* ]]; do shift; [[ $1 == core ]] && shift; done
"$@" &
trap 'kill -KILL $!; exit 1' TERM
trap 'kill -USR1 $!' USR1
code=200
while [ $code -gt 128 ]; do wait $! && code=0 || code=$?; done
exit $code
STUB
cat >bin/scontrol <<'STUB'
#!/usr/bin/env bash
# Its record of the job is in the file `record`.
if [ "$1" = show ]; then cat record; else echo "scontrol $*" >>calls; fi
STUB
cat >bin/squeue <<'STUB'
#!/usr/bin/env bash
# The end of the job, as Slurm writes it.
echo "squeue $*" >>calls
cat end_of_job
STUB
cat >build/mergel <<'STUB'
#!/usr/bin/env bash
# Ends with the code in the file `code`; without one it runs until a signal, as a long run does.
# Refuses the folder of an earlier run, unless it restarts that run.
echo "mergel $*" >>calls
restart=''
while [ $# -gt 0 ]; do
  case $1 in --output) results=$2 ;; --restart) restart=$2 ;; esac
  shift
done
[ ! -e "$results/history.csv" ] || [ "$restart" = "$results" ] || exit 1
mkdir -p "$results"
: >"$results/history.csv"
write_checkpoint() { n=$(find "$results" -name 'checkpoint*' | wc -l); echo x >"$results/checkpoint_$n.h5"; }
trap 'write_checkpoint; echo "USR1" >>calls' USR1
trap '[ -e deaf ] || write_checkpoint; echo "TERM" >>calls; exit 2' TERM
[ ! -e code ] || exit "$(cat code)"
: >ready
while :; do sleep 0.05; done
STUB
chmod +x bin/* build/mergel
echo 'JobState=RUNNING PreemptEligibleTime=2026-01-02T03:04:05 PreemptTime=None' >record
export PATH=$work/bin:$PATH SLURM_SUBMIT_DIR=$work SLURM_JOB_ID=17
unset SLURM_RESTART_COUNT SLURM_ARRAY_TASK_ID MERGEL MERGEL_LAUNCHER MERGEL_MOST_RESTARTS

# run SCRIPT ARGUMENT...: to its end; leaves `code_of_script`, `log` and `calls`.
run()
{
  rm -f calls ready
  : >calls
  code_of_script=0
  timeout 900 bash "$batch/$1" "${@:2}" >log 2>&1 || code_of_script=$?
}

# interrupted SIGNAL SCRIPT ARGUMENT...: the same, with the signal once the run has started.
interrupted()
{
  local signal=$1 pid n
  rm -f calls ready code
  : >calls
  bash "$batch/$2" "${@:3}" >log 2>&1 &
  pid=$!
  for ((n = 0; n < 18000; ++n)); do [ ! -e ready ] || break; sleep 0.05; done
  kill -"$signal" $pid
  code_of_script=0
  wait $pid || code_of_script=$?
}

# stopped_by_hand RESULTS: a user stops the ranks, once they have started.
stopped_by_hand()
{
  local pid n
  rm -f calls ready code
  : >calls
  bash "$batch/requeue.sbatch" pile case.prm "$1" >log 2>&1 &
  pid=$!
  for ((n = 0; n < 18000; ++n)); do [ ! -e ready ] || break; sleep 0.05; done
  scancel --signal=TERM $SLURM_JOB_ID
  code_of_script=0
  wait $pid || code_of_script=$?
}

## the scripts themselves
for script in run array requeue; do
  check "$script.sbatch parses" bash -n "$batch/$script.sbatch"
  if command -v shellcheck >/dev/null; then
    check "$script.sbatch is clean" shellcheck -s bash "$batch/$script.sbatch"
  fi
  # Slurm reads options up to the first command only.
  check "$script.sbatch: options before commands" awk '/^#SBATCH/ && seen { exit 1 } /^[^#]/ { seen = 1 }' \
    "$batch/$script.sbatch"
done

## one run
srun='srun --mpi=pmix --cpus-per-task=1 --cpu-bind=cores --kill-on-bad-exit=1'
echo 0 >code
run run.sbatch pile "a case.prm" --output "out 1"
check "a run starts by srun with PMIx, one rank per core" called "$srun $work/build/mergel pile a case.prm --output out 1"
check "a run starts mergel" called "mergel pile a case.prm --output out 1"
check "a run that is done: exit code 0" is "$code_of_script" 0
echo 2 >code
run run.sbatch pile case.prm --output out --restart out
check "the exit code of mergel is the job's" is "$code_of_script" 2
# ends_in SECONDS: the time limit of the job
ends_in() { date -d "$1 seconds" +%Y-%m-%dT%H:%M:%S >end_of_job; }
# walltime LOW HIGH: of mergel [s]; the script takes some seconds
walltime() { awk -v low="$1" -v high="$2" '/^mergel .* --walltime [0-9]+ s$/ { t = $(NF - 1) } END { exit !(t >= low && t <= high) }' calls; }
export MERGEL_LAUNCHER="mpirun --bind-to core"
echo N/A >end_of_job
run run.sbatch pile case.prm --output out_2
check "another launcher" called "mpirun --bind-to core $work/build/mergel pile case.prm --output out_2"
check "no time limit: no --walltime, which is said" said 'run.sbatch: the job has no time limit'
ends_in 86400
run run.sbatch pile case.prm --output out_3
check "mpirun: --walltime is seven minutes less than the time limit" walltime 85000 85980
ends_in 600
run run.sbatch element case.prm --output out_4
check "mpirun: a third of a short limit" walltime 150 200
for arguments in "pile case.prm --walltime 1h" "pile case.prm --walltime=1h" "bond case.prm" "sample case.prm"; do
  # shellcheck disable=SC2086
  run run.sbatch $arguments
  check "mpirun: mergel $arguments gets no other --walltime" called "mergel $arguments"
done
unset MERGEL_LAUNCHER
run run.sbatch pile case.prm --output out_5
check "srun: no --walltime" called "mergel pile case.prm --output out_5"
run run.sbatch pile
check "too few arguments: exit code 1" is "$code_of_script" 1
MERGEL=none run run.sbatch pile case.prm
check "no program: exit code 1" is "$code_of_script" 1
check "no program: message" said 'none is not a program'
check "no program: nothing is started" never_called srun

## an array
echo 0 >code
cat >cases.txt <<'TEXT'
# friction
cases/small.prm | Pile/friction = 0.1

  # two keys
  cases/small.prm | Pile/friction = 0.3 |  Specimen/seed = 2
cases/large.prm
TEXT
SLURM_ARRAY_TASK_ID=1 run array.sbatch pile cases.txt runs
check "the first case" called "mergel pile cases/small.prm --output runs/1_small --restart runs/1_small --set Pile/friction = 0.1"
SLURM_ARRAY_TASK_ID=2 run array.sbatch pile cases.txt runs
check "the second case, two settings" called \
  "mergel pile cases/small.prm --output runs/2_small --restart runs/2_small --set Pile/friction = 0.3 --set Specimen/seed = 2"
SLURM_ARRAY_TASK_ID=3 run array.sbatch pile cases.txt runs
check "the third case, no setting" called "mergel pile cases/large.prm --output runs/3_large --restart runs/3_large"
ends_in 86400
MERGEL_LAUNCHER=mpirun SLURM_ARRAY_TASK_ID=1 run array.sbatch pile cases.txt runs
check "mpirun: a case stops before the time limit" walltime 85000 85980
for task in 0 4; do
  SLURM_ARRAY_TASK_ID=$task run array.sbatch pile cases.txt runs
  check "no case $task: exit code 1" is "$code_of_script" 1
  check "no case $task: message" said 'has 3 runs, and no run number'
  check "no case $task: nothing is started" never_called srun
done
run array.sbatch pile cases.txt runs
check "no array: message" said 'no task number'
SLURM_ARRAY_TASK_ID=3 run array.sbatch pile cases.txt runs
check "a case that was lost before its first checkpoint is resumed" is "$code_of_script" 0
: >runs/3_large/summary.json
SLURM_ARRAY_TASK_ID=3 run array.sbatch pile cases.txt runs
check "a case that is done is left alone" never_called srun
check "a case that is done: exit code 0" is "$code_of_script" 0

## a run that queues itself again
start='--output long --restart long'
interrupted USR1 requeue.sbatch pile case.prm long --set "Pile/friction=0.3"
check "a run may begin" called "mergel pile case.prm $start --set Pile/friction=0.3"
check "the time limit: SIGTERM to the ranks" called "scancel --signal=TERM 17"
check "the time limit stops the run" called TERM
check "which writes a checkpoint" test -s long/checkpoint_0.h5
check "and is not killed by srun" never_called KILL
check "and queues the job again" called "scontrol requeue 17"
check "at the checkpoint" said 'at long/checkpoint_0\.h5: queued again'
SLURM_RESTART_COUNT=1 interrupted USR1 requeue.sbatch pile case.prm long --set "Pile/friction=0.3"
check "the second time it goes on" called "mergel pile case.prm $start --set Pile/friction=0.3"
check "the second time a checkpoint is written" test -s long/checkpoint_1.h5
check "the second time is queued again" called "scontrol requeue 17"
SLURM_RESTART_COUNT=2 interrupted TERM requeue.sbatch pile case.prm long
check "SIGTERM to the script stops the run" called TERM
check "SIGTERM to the script: a checkpoint" test -s long/checkpoint_2.h5
check "SIGTERM to the script: srun gets none" never_called KILL
check "SIGTERM to the script: not queued again" never_called scontrol
stopped_by_hand long
check "stopped by hand: a checkpoint" test -s long/checkpoint_3.h5
check "stopped by hand: the exit code of mergel" is "$code_of_script" 2
check "stopped by hand: not queued again" never_called scontrol
sed -i 's/PreemptTime=None/PreemptTime=2026-01-02T03:05:06/' record
stopped_by_hand long
check "preempted with a grace time: queued again" called "scontrol requeue 17"
check "preempted with a grace time: said" said 'stopped for another job at long/checkpoint_4\.h5: queued again'
sed -i 's/PreemptTime=2026.*/PreemptTime=None/' record
: >no_scancel
SLURM_RESTART_COUNT=2 interrupted USR1 requeue.sbatch pile case.prm long
check "without scancel: srun forwards SIGUSR1" called USR1
check "without scancel: a checkpoint" test -s long/checkpoint_5.h5
check "without scancel: then the end" called KILL
check "without scancel: queued again" called "scontrol requeue 17"
rm no_scancel
SLURM_RESTART_COUNT=2 MERGEL_MOST_RESTARTS=2 interrupted USR1 requeue.sbatch pile case.prm long
check "the limit of restarts holds" never_called scontrol
check "the limit of restarts: message" said 'queued again 2 times already'
for code in 0 1 2 3; do
  echo $code >code
  SLURM_RESTART_COUNT=2 run requeue.sbatch pile case.prm long
  check "exit code $code of mergel is the job's" is "$code_of_script" $code
  check "exit code $code is not queued again" never_called scontrol
done
: >deaf
SLURM_RESTART_COUNT=2 interrupted USR1 requeue.sbatch pile case.prm long
check "no new checkpoint is not queued again" never_called scontrol
check "no new checkpoint: message" said 'without a new checkpoint'
rm deaf
: >long/summary.json
run requeue.sbatch pile case.prm long
check "a run that is done is left alone" never_called srun
check "a run that is done: exit code 0" is "$code_of_script" 0
mkdir lost
: >lost/history.csv
echo 0 >code
run requeue.sbatch pile case.prm lost
check "lost before the first checkpoint: resumed" is "$code_of_script" 0

# Queued again, as its node did not answer, while the ranks there go on.
# held SIGNAL: a run holds the lock of the folder until the script says that it waits; then the signal, or its end.
held()
{
  local pid holder n
  mkdir -p held
  rm -f calls log
  : >calls
  (flock 9 && exec sleep 3600) 9>held/.mergel.lock &
  holder=$!
  until ! flock --nonblock held/.mergel.lock true; do sleep 0.05; done
  SLURM_RESTART_COUNT=1 bash "$batch/requeue.sbatch" pile case.prm held >log 2>&1 &
  pid=$!
  for ((n = 0; n < 18000; ++n)); do ! said 'still writing in held: waiting' || break; sleep 0.05; done
  if [ "$1" = end ]; then kill $holder; else kill -"$1" $pid; fi
  code_of_script=0
  wait $pid || code_of_script=$?
  kill $holder 2>/dev/null || true
  wait $holder 2>/dev/null || true
}
echo 0 >code
held end
check "ranks of an earlier start: their end is awaited" said 'still writing in held: waiting for its end'
check "and then the run goes on" called "mergel pile case.prm --output held --restart held"
check "to its end" is "$code_of_script" 0
held USR1
check "the time limit while waiting: queued again" called "scontrol requeue 17"
check "the time limit while waiting: nothing is started" never_called srun
held TERM
check "cancelled while waiting: not queued again" never_called scontrol
check "cancelled while waiting: nothing is started" never_called srun
run requeue.sbatch pile case.prm held
check "a lock that nobody holds is not waited for" called "mergel pile case.prm --output held --restart held"
rm code
export MERGEL_LAUNCHER="mpirun --map-by core"
interrupted USR1 requeue.sbatch pile case.prm other
check "mpirun: a checkpoint first" called USR1
check "mpirun: its daemons, steps of the job, get no signal" never_called scancel
check "mpirun: then queued again" called "scontrol requeue 17"

echo "batch scripts: $((n_checks - n_failed)) of $n_checks checks hold"
[ "$n_failed" -eq 0 ]
