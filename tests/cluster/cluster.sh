# Sourced by the scripts of this folder: a cluster of two nodes on this machine, with Debian's Slurm.
#
# The nodes n1 and n2 are namespaces of Linux: each has its host name, network, processes, mounts and slurmd of
# its own, two cores, and its own /dev/shm and temporary folder. $work is on all hosts, as on a file system that
# nodes share. The script, slurmctld and munged run on the host `head`. No process and no
# network is left behind, however the script ends: the kernel ends the processes of a namespace with its first one. Its
# folder stays only where the script itself gets SIGKILL.
#
# usage: SCRIPT MERGEL     as root, who may make namespaces. Where something is missing the test fails.
#
# Sets root (the repository), batch (apps/batch), mergel, and work (a folder that is removed at the end, and the
# working folder). Slurm's record of each job that ends is printed.
set -euo pipefail

fail() { echo "FAILED: $*"; exit 1; }

require_cluster()
{
  local missing=() program
  for program in pgrep munged slurmctld slurmd sbatch srun mpirun ip unshare setpriv; do
    command -v "$program" >/dev/null || missing+=("$program")
  done
  [ ${#missing[@]} -eq 0 ] || fail "the cluster needs ${missing[*]}: ./bootstrap cluster installs what is missing"
  [ "$(id -u)" -eq 0 ] || fail "the cluster needs root: it makes namespaces and starts Slurm's daemons"
  unshare --mount --uts --ipc --net --pid --fork true 2>/dev/null ||
    fail "the cluster needs namespaces, which this container does not allow: give it CAP_SYS_ADMIN and CAP_NET_ADMIN"
}

# Begin again as the first process of the host `head`, with a parent that removes the folder.
if [ -z "${MERGEL_CLUSTER:-}" ]; then
  require_cluster
  MERGEL_CLUSTER=$(mktemp -d)
  export MERGEL_CLUSTER
  chmod 755 "$MERGEL_CLUSTER" # munged and its clients ask for that
  child=''
  trap '[ -z "$child" ] || kill -KILL "$child" 2>/dev/null || true; wait; rm -rf "$MERGEL_CLUSTER"' EXIT
  trap 'exit 1' TERM INT HUP
  setpriv --pdeathsig KILL unshare --mount --uts --ipc --net --pid --fork --kill-child --mount-proc "$0" "$@" &
  child=$! code=0
  wait "$child" || code=$?
  exit $code
fi

root=$(cd "$(dirname "$0")/../.." && pwd)
batch=$root/apps/batch
mergel=$(readlink -f "$1")
work=$MERGEL_CLUSTER
cd "$work"
export SLURM_CONF=$work/slurm.conf MERGEL=$mergel
unset MERGEL_LAUNCHER MERGEL_MOST_RESTARTS
# Ranks of both nodes share the processors of this machine: they must not wait actively.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1

## the cluster

# Slurm binds ranks only where the script says task_plugin=affinity: the first ranks of both nodes would be bound to
# one processor. Credentials that expire soon: a job that is queued again waits for that. Nodes that do not answer are down
# after 9 s, which is 5 minutes by default.
write_configuration()
{
  printf '127.0.0.1 localhost\n10.9.0.100 head\n10.9.0.1 n1\n10.9.0.2 n2\n' >hosts
  mount --bind hosts /etc/hosts
  (umask 077 && head -c 1024 /dev/urandom >munge.key)
  cat >slurm.conf <<CONF
ClusterName=mergel
SlurmctldHost=head
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket,cred_expire=5
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool.%n
TmpFS=$work/tmp
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.%n.pid
SlurmctldLogFile=$work/slurmctld.daemon
SlurmdLogFile=$work/slurmd.%n.daemon
ProctrackType=proctrack/linuxproc
TaskPlugin=task/${task_plugin:-none}
JobAcctGatherType=jobacct_gather/linux
JobCompType=jobcomp/filetxt
JobCompLoc=$work/completed.txt
SchedulerParameters=batch_sched_delay=0,bf_interval=2
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdTimeout=9
KillWait=5
MinJobAge=86400
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=n[1-2] Sockets=1 CoresPerSocket=2 ThreadsPerCore=1 RealMemory=8000
${partitions:-PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP}
CONF
}

declare -A node=() # process on `head` that started the node

# first_process NODE: that of the node, as `head` sees it. Its end is that of the node.
first_process() { pgrep -P "${node[$1]}"; }

# start_node NUMBER [COMMAND]: the command runs on the node before its slurmd.
start_node()
{
  local n=$1
  mkdir -p "spool.n$n" tmp
  ip link add "to_n$n" type veth peer name "eth$n"
  ip link set "to_n$n" master nodes up
  unshare --mount --uts --ipc --net --pid --fork --kill-child --mount-proc bash -c "
    hostname n$n
    until ip link show eth$n >/dev/null 2>&1; do sleep 0.05; done
    ip link set lo up && ip address add 10.9.0.$n/24 dev eth$n && ip link set eth$n up
    mount -t tmpfs none $work/tmp && mount -t tmpfs none /dev/shm
    ${2:-:}
    slurmd -D -N n$n &
    wait
    sleep infinity" >"node.n$n.daemon" 2>&1 &
  node[n$n]=$!
  wait_until pgrep -P "${node[n$n]}" >/dev/null
  ip link set "eth$n" netns "$(first_process "n$n")"
}

# lose_node NODE: as by a power cut.
lose_node()
{
  kill -KILL "$(first_process "$1")"
  wait "${node[$1]}" 2>/dev/null || true
}

is_node() { [ "$(sinfo -h -n "$1" -o %T 2>/dev/null)" = "$2" ]; } # NODE STATE

# start_cluster [COMMAND]: the command runs on n2 before its slurmd.
start_cluster()
{
  mkdir state
  write_configuration
  hostname head
  ip link set lo up
  ip link add nodes type bridge
  ip address add 10.9.0.100/24 dev nodes
  ip link set nodes up
  munged --foreground --socket="$work/munge.socket" --key-file="$work/munge.key" --pid-file="$work/munge.pid" \
    --seed-file="$work/munge.seed" --log-file="$work/munge.daemon" >head.daemon 2>&1 &
  wait_until test -S munge.socket
  slurmctld -D >>head.daemon 2>&1 &
  start_node 1
  start_node 2 "${1:-:}"
  wait_until is_node n1 idle
  wait_until is_node n2 idle
}

## waiting: never for a time, as a test may not depend on the speed of the machine; these are limits of hangs

# wait_until CONDITION...
wait_until()
{
  local n
  for ((n = 0; n < 3000; ++n)); do
    "$@" && return
    sleep 0.2
  done
  tail -n 20 "$work"/*.daemon "$work"/*.log 2>/dev/null || true
  fail "not after ten minutes: $*"
}

## jobs

# submit OPTION... SCRIPT ARGUMENT...: leaves the number of the job in `job`.
submit() { job=$(sbatch --parsable "$@"); }

# field JOB NAME: of Slurm's record. A task of an array is JOB_TASK.
field() { scontrol --oneliner show job "$1" | tr ' ' '\n' | sed -n "s/^$2=//p" | head -1; }

has() { [ "$(field "$1" "$2")" = "$3" ]; } # JOB NAME VALUE
is_over() { case $(field "$1" JobState) in PENDING | RUNNING | COMPLETING | CONFIGURING | REQUEUED) false ;; esac; }

record()
{
  local name line="job $1:"
  for name in JobState Reason ExitCode Restarts TimeLimit RunTime NodeList NumCPUs; do
    line+=" $name=$(field "$1" "$name")"
  done
  echo "$line"
}

# to_its_end JOB STATE [EXIT_CODE]
to_its_end()
{
  wait_until is_over "$1"
  record "$1"
  has "$1" JobState "$2" || fail "job $1 is $(field "$1" JobState), not $2: $(tail -3 "$(field "$1" StdOut)")"
  [ $# -lt 3 ] || has "$1" ExitCode "$3" || fail "job $1: exit code $(field "$1" ExitCode), not $3: $(tail -3 "$(field "$1" StdOut)")"
}

log_of() { cat "$(field "$1" StdOut)"; }
says() { log_of "$1" | grep -Eq -- "$2" || fail "job $1 does not say \"$2\": $(log_of "$1" | tail -5)"; }

# halt_ranks JOB CONDITION...: as soon as it holds. A run here takes a second where nothing else runs.
halt_ranks()
{
  local job=$1 n=0
  shift
  until "$@"; do
    sleep 0.005
    [ $((++n % 200)) -ne 0 ] || ! is_over "$job" || "$@" ||
      fail "job $job ended before \"$*\": $(log_of "$job" | tail -3)"
  done
  pkill -STOP -x mergel || fail "job $job has no ranks after \"$*\": $(log_of "$job" | tail -3)"
  wait_until are_halted
}

# The ranks go on, once a signal has reached one of them.
go_on()
{
  wait_until are_signalled
  pkill -CONT -x mergel || true # they may have ended
}

has_lines() { local l; { mapfile -t l <"$1/history.csv"; } 2>/dev/null && [ ${#l[@]} -ge "$2" ]; } # FOLDER N
has_checkpoint() { compgen -G "$1/checkpoint*.h5" >/dev/null; }

## ranks

# state_of_ranks: a line for each, its state and the mask of signals that wait for it
state_of_ranks()
{
  local pid
  for pid in $(pgrep -x mergel); do
    awk '/^State/ { state = $2 } /^ShdPnd/ { print state, $2 }' "/proc/$pid/status" 2>/dev/null || true
  done
}
are_halted() { ! state_of_ranks | grep -qv '^[Tt]'; }
# Whether a signal waits for a halted rank, or has woken it: Slurm sends SIGCONT with some.
are_signalled() { ! are_halted || state_of_ranks | grep -qv ' 0*$' || ! pgrep -x mergel >/dev/null; }

# meets_limit JOB: Slurm finds, when it looks next, that the job is near its time limit. It looks twice a minute.
meets_limit()
{
  local minutes=$((($(date +%s) - $(date -d "$(field "$1" StartTime)" +%s)) / 60))
  scontrol update "JobId=$1" "TimeLimit=$((minutes + 2))"
}

was_restarted() { has "$1" Restarts "$2" || is_over "$1"; }
newest() { local c=("$1"/checkpoint*.h5); echo "${c[-1]}"; }
has_newer() { local c=("$1"/checkpoint*.h5); [ -e "${c[-1]}" ] && [ "${c[-1]}" != "$2" ]; } # FOLDER CHECKPOINT

## the run: a periodic cell of some hundred particles under triaxial compression

case_file=$root/apps/cases/element_small.prm
cell=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm"
  --set "Loading/stage 1=isotropic to p = 0.4 MPa" --set "Loading/stage 2=triaxial to axial strain = 0.2 %"
  --set "Loading/stage 3=" --set "Loading/stage 4=" --set "Loading/inertial number=2e-3")

# Without Slurm, on one rank and never stopped.
whole_run() { "$mergel" element "$case_file" "${cell[@]}" --output whole >whole.log 2>&1 || fail "the run without Slurm: $(tail -3 whole.log)"; }
same_as_whole() { cmp whole/history.csv "$1/history.csv" || fail "$1: its history is not that of the run that was never stopped"; }

# meets_its_limit RESULTS N SBATCH_OPTION...: requeue.sbatch, whose job meets its time limit N times.
meets_its_limit()
{
  local results=$1 n_limits=$2 lap n=0 before=none
  shift 2
  submit "$@" "$batch/requeue.sbatch" element "$case_file" "$results" "${cell[@]}"
  for ((lap = 1; lap <= n_limits; ++lap)); do
    halt_ranks "$job" has_lines "$results" $((n + 3))
    meets_limit "$job"
    go_on
    # What mpirun starts is not stopped at its checkpoint, but by the script, which looks once a second.
    [ -z "${MERGEL_LAUNCHER:-}" ] || halt_ranks "$job" has_newer "$results" "$before"
    wait_until was_restarted "$job" $lap
    has "$job" Restarts $lap || fail "not queued again: $(log_of "$job" | tail -3)"
    before=$(newest "$results")
    record "$job"
    scontrol update "JobId=$job" TimeLimit=60
    n=$(wc -l <"$results/history.csv")
  done
  to_its_end "$job" COMPLETED 0:0
  [ "$(log_of "$job" | grep -Ec "stopped for the time limit at $results/checkpoint_.*: queued again")" -eq "$n_limits" ] ||
    fail "not queued again $n_limits times: $(log_of "$job" | grep requeue)"
  same_as_whole "$results"
}
