# Sourced by the scripts that run mergel as its user does, with their arguments: the program is the first one.
#
# Sets root (the repository), mergel, work (a folder that is removed at the end, and the working folder), and
# what Open MPI needs: containers run as root, and ranks that share a processor must not wait actively.
#
# No limit here is one of wall-clock time: a test may not depend on the speed of the machine, nor on what
# else runs on it. See guarded().
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mergel=$(readlink -f "$1")
work=$(mktemp -d)
launched='' # see launch()
# A test that is ended while its run stands still, see wait_for(), lets it go on to its own end. A child of this shell
# that is ended by a signal before it runs its command has this trap too, and must leave the folder alone.
leave()
{
  [ "$BASHPID" -eq $$ ] || return 0
  [ -z "$launched" ] || signal_ranks CONT || true
  rm -rf "$work"
}
trap leave EXIT
cd "$work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1
# All ranks are on this machine, which may have no network: Open MPI 5 says so on every rank.
export OMPI_MCA_btl_tcp_if_include=lo

fail() { echo "FAILED: $*"; exit 1; }

# What a run has found, and the case that it ran: summary.json and resolved.prm without what differs from run
# to run, its time and by what, where and when it was made (apps/run/provenance.h).
physics() { grep -Ev 'wall-clock time|^  "made by": ' "$1/summary.json"; }
case_of() { grep -v '^# made on ' "$1/resolved.prm"; }

# Processor time of a process and all that it started [s].
processor_time()
{
  ps -e -o pid=,ppid=,cputimes= | awk -v root="$1" '
    { parent[$1] = $2; used[$1] = $3 }
    END { for (p in used) { for (q = p; q > 1 && q != root; q = parent[q]); if (q == root) sum += used[p] }
          print sum + 0 }'
}

# End a process that has used no processor time for five minutes: its ranks wait for each other. A process
# that waits for a processor gets some of it in this time.
end_when_stuck()
{
  local pid=$1 before=-1 now n_idle=0
  while sleep 30 && kill -0 "$pid" 2>/dev/null; do
    now=$(processor_time "$pid")
    if [ "$now" = "$before" ]; then n_idle=$((n_idle + 1)); else n_idle=0; fi
    before=$now
    if [ "$n_idle" -ge 10 ]; then
      pkill -KILL -P "$pid" || true
      kill -KILL "$pid" 2>/dev/null || true
    fi
  done
}

# bounded COMMAND...: at most so many seconds of processor time: the runs here take a few. A build with
# sanitizers asks for more (tests/CMakeLists.txt).
bounded() { (ulimit -t "${MERGEL_TEST_SECONDS:-300}" && exec "$@"); }

# guarded COMMAND...: the same, and ended when its processes wait for each other. Exit code 137 then.
guarded()
{
  local code=0 pid watch
  (ulimit -t "${MERGEL_TEST_SECONDS:-300}" && exec "$@") & # its own process, not the child of a shell
  pid=$!
  end_when_stuck $pid >/dev/null 2>&1 &
  watch=$!
  wait $pid || code=$?
  kill $watch 2>/dev/null || true
  wait $watch 2>/dev/null || true
  return $code
}

# on_ranks N COMMAND...
on_ranks()
{
  local n=$1
  shift
  guarded mpirun --oversubscribe -n "$n" "$@"
}

# launch COMMAND...: in the background; its process is $launched, for the signals of a test.
launch()
{
  (ulimit -t "${MERGEL_TEST_SECONDS:-300}" && exec "$@") &
  launched=$!
}

# What computes of that which was launched: the program itself, or the ranks that mpirun has started.
signal_ranks() { kill -"$1" "$launched" 2>/dev/null && { pkill -"$1" -P "$launched" mergel || true; }; }

# wait_for CONDITION...: until it holds, as long as $launched runs. The run stands still while the condition is
# looked at: a look takes longer than a small run where the machine is busy, and the run must be under way after.
# Between two looks it goes on for 20 ms, and for 300 ms once it has had two seconds.
wait_for()
{
  local holds n_looks=0
  while :; do
    signal_ranks STOP || { "$@" && return; fail "it ended before \"$*\": $(tail -3 log)"; }
    holds=no
    if { [ -z "${to_send:-}" ] || takes "$to_send" "$(target)"; } && "$@"; then holds=yes; fi
    [ $holds = no ] || [ -z "${to_send:-}" ] || kill -"$to_send" "$(target)" || true
    signal_ranks CONT || true
    [ $holds = no ] || return 0
    n_looks=$((n_looks + 1))
    if [ $n_looks -lt 100 ]; then sleep 0.02; else sleep 0.3; fi
  done
}
# signal_when SIGNAL CONDITION...: wait for it, and send the signal before the run goes on: to the last rank.
signal_when()
{
  local to_send=$1
  shift
  wait_for "$@"
}
target() { local rank; rank=$(last_rank || true); echo "${rank:-$launched}"; }
# takes SIGNAL PROCESS: it is mergel, which has said what it does with the signal. Before, the signal would end it: a run
# that continues another finds a history, for which a test waits, before it has begun.
takes()
{
  local mask number
  number=$(kill -l "$1")
  [ "$(cat "/proc/$2/comm")" = mergel ] || return 1
  for mask in $(sed -n 's/^Sig\(Cgt\|Ign\):\t//p' "/proc/$2/status"); do
    [ $(((0x$mask >> (number - 1)) & 1)) -eq 0 ] || return 0
  done
  return 1
}
exists() { compgen -G "$1" >/dev/null; } # a file of this pattern

# The last rank that $launched, an mpirun, has started.
last_rank() { pgrep -P "$launched" mergel | tail -1; }

# code_of COMMAND...: its exit code; what it prints is in `log`.
code_of()
{
  local code=0
  "$@" >log 2>&1 || code=$?
  echo "$code"
}

# A coupled pile of some hundred particles, until bonds break: seconds.
case_file=$root/apps/cases/pile_small.prm
tiny=(--set "Specimen/diameter=6 mm" --set "Specimen/height=6 mm" --set "Specimen/inner upscaling=5"
  --set "Specimen/outer radius=3 mm" --set "Far field/chamber diameter=12 mm"
  --set "Far field/chamber height=12 mm" --set "Motion/unbalanced-force tolerance=1e-2")
shallow=(--set "Pile/cone angle=120 degree" --set "Pile/final depth=0.15 mm")
