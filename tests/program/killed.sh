#!/usr/bin/env bash
# A small coupled pile killed (SIGKILL) at random moments (in steps, while lists are built, while a
# checkpoint is written) and restarted each time on one or two ranks: there is always a checkpoint
# that can be read, and the result is that of a run that was never killed, bit for bit.
#
# usage: tests/program/killed.sh MERGEL [KILLS, default 4; 30 for the whole test] [SEED]
. "$(dirname "$0")/preamble.sh"
kills=${2:-4}
RANDOM=${3:-1}
tiny+=("${shallow[@]}" --set "Output/frames=3")

"$mergel" sample "$case_file" "${tiny[@]}" --output made >log || fail "the specimen: $(tail -3 log)"
tiny+=(--set "Specimen/file=$work/made/sample.h5")
start=$(date +%s%N)
"$mergel" pile "$case_file" "${tiny[@]}" --output whole >log || fail "the whole run: $(tail -3 log)"
run_ms=$((($(date +%s%N) - start) / 1000000))

newest() { compgen -G "killed/checkpoint_*.h5" | sort | tail -1 || true; }
n_killed=0 n_in_writing=0
while [ "$n_killed" -lt "$kills" ]; do
  # By turns few checkpoints, and one every other step: then most kills occur while one is written.
  every=$((n_killed % 2 ? 2 : 40))
  # Times between two kills, such that all kills occur during the run.
  pause=$((RANDOM % (2 * run_ms / kills + 200)))
  launch=("$mergel")
  [ $((n_killed % 3)) -eq 2 ] && launch=(mpirun --oversubscribe -n 2 "$mergel")
  setsid "${launch[@]}" pile "$case_file" "${tiny[@]}" --set "Output/checkpoint every=$every steps" \
    --output killed --restart killed >log 2>&1 &
  group=$!
  # Some are killed while they start, the others after they have written another checkpoint.
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
    echo "done after $n_killed kills: started again"
    continue
  fi
  kill -KILL -- "-$group" 2>/dev/null || true # the launcher and its ranks are one group
  wait "$group" 2>/dev/null || true
  n_killed=$((n_killed + 1))
  ls killed/.checkpoint_*.partial.h5 >/dev/null 2>&1 && n_in_writing=$((n_in_writing + 1))
  # Every file under its final name is complete; once there was a checkpoint there always is one.
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
diff <(physics whole) <(physics killed) ||
  fail "the summary differs"
[ "$kills" -lt 20 ] || [ "$n_in_writing" -gt 0 ] || fail "no kill occurred while a checkpoint was written"
echo "killed $n_killed times, $n_in_writing of them while a checkpoint was written: the same bits"
