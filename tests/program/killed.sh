#!/usr/bin/env bash
# A small coupled pile killed (SIGKILL) at random moments, in steps, in list building and in the
# middle of writing a checkpoint, and restarted each time on one or two ranks: there is always a
# checkpoint that can be read, and the result is that of the run that was never killed, bit for
# bit.
#
# usage: tests/program/killed.sh MERGEL [KILLS, default 4; 30 for the whole test] [SEED]
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
mergel=$(readlink -f "$1") kills=${2:-4}
RANDOM=${3:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1

fail() { echo "FAILED: $*"; exit 1; }
tiny=(--set "Specimen/diameter=6 mm" --set "Specimen/height=6 mm" --set "Specimen/inner upscaling=5"
  --set "Specimen/outer radius=3 mm" --set "Far field/chamber diameter=12 mm"
  --set "Far field/chamber height=12 mm" --set "Output/frames=3" --set "Motion/balance=1e-2"
  --set "Pile/cone angle=120 degree" --set "Pile/final depth=0.15 mm")
case_file=$root/apps/cases/pile_small.prm

"$mergel" sample "$case_file" "${tiny[@]}" --output made >log || fail "the specimen: $(tail -3 log)"
tiny+=(--set "Specimen/file=$work/made/sample.h5")
start=$(date +%s%N)
"$mergel" pile "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
run_ms=$((($(date +%s%N) - start) / 1000000))

newest() { compgen -G "killed/checkpoint_*.h5" | sort | tail -1 || true; }
n_killed=0 n_in_writing=0
while [ "$n_killed" -lt "$kills" ]; do
  # By turns few checkpoints, and one every other step: then most kills fall into the writing.
  every=$((n_killed % 2 ? 2 : 40))
  # Pieces of the run between two kills, so that all of them fall into it.
  pause=$((RANDOM % (2 * run_ms / kills + 200)))
  launch=("$mergel")
  [ $((n_killed % 3)) -eq 2 ] && launch=(mpirun --oversubscribe -n 2 "$mergel")
  setsid "${launch[@]}" pile "$case_file" "${tiny[@]}" --set "Output/checkpoint every=$every steps" \
    --output killed --restart killed >log 2>&1 &
  group=$!
  # Some die while they start, the others once they go on: after another checkpoint.
  before=$(newest)
  [ $((n_killed % 5)) -eq 4 ] || for _ in $(seq 1000); do
    if [ "$(newest)" != "$before" ] || ! kill -0 "$group" 2>/dev/null; then break; fi
    sleep 0.02
  done
  code=0
  timeout $((pause / 1000)).$(printf %03d $((pause % 1000))) tail --pid=$group -f /dev/null || code=$?
  if [ "$code" -ne 124 ]; then # it was done before it could be killed
    wait "$group" || fail "it ended by itself: $(tail -3 log)"
    [ "$n_killed" -gt 0 ] || fail "the run is too short to be killed"
    rm -rf killed had_one
    echo "done after $n_killed kills: begun again"
    continue
  fi
  kill -KILL -- "-$group" 2>/dev/null || true # the launcher and its ranks are one group
  wait "$group" 2>/dev/null || true
  n_killed=$((n_killed + 1))
  ls killed/.checkpoint_*.partial.h5 >/dev/null 2>&1 && n_in_writing=$((n_in_writing + 1))
  # Every file under its final name is whole; once there was a checkpoint there always is one.
  if [ -e killed ]; then
    "$mergel" info killed >info || fail "after kill $n_killed: $(cat info)"
    if grep -q 'checkpoint_.*good' info; then
      touch had_one
    elif [ -e had_one ] && [ "$(ls killed/checkpoint_*.h5 2>/dev/null | wc -l)" -eq 0 ]; then
      fail "after kill $n_killed no checkpoint is left"
    fi
  fi
done
"$mergel" pile "$case_file" "${tiny[@]}" --output killed --restart killed >log || fail "the end: $(tail -3 log)"

cmp whole/history.csv killed/history.csv || fail "the history differs"
for file in whole/fields/* whole/*.pvd; do
  cmp "$file" "killed/${file#whole/}" || fail "${file#whole/} differs"
done
diff <(ls -A whole/fields) <(ls -A killed/fields) || fail "other fields"
diff <(grep -v wall-clock whole/summary.json) <(grep -v wall-clock killed/summary.json) ||
  fail "the summary differs"
[ "$kills" -lt 20 ] || [ "$n_in_writing" -gt 0 ] || fail "no kill fell into the writing of a checkpoint"
echo "killed $n_killed times, $n_in_writing of them while a checkpoint was written: the same bits"
