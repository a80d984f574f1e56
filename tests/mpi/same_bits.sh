#!/usr/bin/env bash
# The same bits on 1, 2, 3, 4 and 8 ranks: bonded rocks that break and move across the borders
# of the ranks, with forced rebuilds and migrations in the middle; and a small coupled pile. Each scene is
# also stopped at an arbitrary step and restarted on another number of ranks, twice (the pile: restart.sh).
#
# usage: tests/mpi/same_bits.sh MPI_SCENES MERGEL
set -euo pipefail
root=$(cd "$(dirname "$0")/../.." && pwd)
scenes=$(readlink -f "$1") mergel=$(readlink -f "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# A container has no other user; ranks that share a processor must not spin.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1

fail() { echo "FAILED: $*"; exit 1; }
# A rank that waits for one that has failed would wait for ever; a build with sanitizers is ten times slower.
ranks() { local n=$1; shift; timeout "${MERGEL_TEST_SECONDS:-300}" mpirun --oversubscribe -n "$n" "$@"; }

for scene in block turning periodic element varied; do
  ranks 1 "$scenes" "$scene" >one || fail "$scene on one rank"
  [ "$(wc -l <one)" -eq 10 ] || fail "$scene: ten lines on one rank"
  ranks 1 "$scenes" "$scene" rebuild >other || fail "$scene with rebuilds"
  cmp one other || fail "$scene: a rebuild changes bits"
  for n in 2 3 4 8; do
    ranks $n "$scenes" "$scene" rebuild rebalance >other 2>errors || fail "$scene on $n ranks: $(cat errors)"
    cmp one other || fail "$scene on $n ranks differs from one"
  done
  ranks 2 "$scenes" "$scene" stop 137 a.h5 >other || fail "$scene, stopped on 2 ranks"
  ranks 3 "$scenes" "$scene" restart a.h5 stop 263 b.h5 >>other || fail "$scene, restarted on 3 ranks"
  ranks 1 "$scenes" "$scene" restart b.h5 >>other || fail "$scene, restarted on one rank"
  cmp one other || fail "$scene: restarts change bits"
  echo "$scene: $(tail -1 one | cut -d' ' -f3-6), the same bits on 1, 2, 3, 4, 8 ranks and after two restarts"
done

# A rank whose folder is another one (a disk of its own) is told, and fills no file there, nor
# an old one of that name.
mkdir apart
apart() {
  timeout 60 mpirun --oversubscribe -n 2 bash -c '[ "$OMPI_COMM_WORLD_RANK" = 0 ] || cd apart; exec "$@"' apart "$@"
}
for old in none .c.partial.h5; do
  [ $old = none ] || echo old >apart/$old
  if apart "$scenes" block stop 3 c.h5 >log 2>&1; then fail "a checkpoint in two folders was sealed"; fi
  grep -q 'c.h5: rank 1 on .* does not see the file that rank 0 on' log || fail "a checkpoint in two folders: $(cat log)"
  [ ! -e c.h5 ] && [ ! -e apart/c.h5 ] || fail "a checkpoint in two folders stands"
done
[ "$(cat apart/.c.partial.h5)" = old ] || fail "an old file was filled"

# Coupled: a small pile until bonds break.
tiny=(--set "Specimen/diameter=6 mm" --set "Specimen/height=6 mm" --set "Specimen/inner upscaling=5"
  --set "Specimen/outer radius=3 mm" --set "Far field/chamber diameter=12 mm"
  --set "Far field/chamber height=12 mm" --set "Output/frames=1" --set "Motion/balance=1e-2"
  --set "Pile/cone angle=120 degree" --set "Pile/final depth=0.15 mm")
for n in 1 2 3 4 8; do
  ranks $n "$mergel" pile "$root/apps/cases/pile_small.prm" "${tiny[@]}" --output "pile$n" >log 2>&1 ||
    fail "the pile on $n ranks: $(tail -3 log)"
  cmp pile1/history.csv "pile$n/history.csv" || fail "the pile on $n ranks differs from one"
  cmp pile1/fields/particles_0001.vtp "pile$n/fields/particles_0001.vtp" ||
    fail "the grains of the pile on $n ranks differ from one"
done
broken=$(awk -F': ' '/"bonds broken/ { print $2 + 0 }' pile1/summary.json)
[ "$broken" -gt 20 ] || fail "the pile broke only $broken bonds"
echo "pile: $broken broken, the same history and grains on 1, 2, 3, 4, 8 ranks"

# An element test with a servo, unloading included.
element=(--set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" --set "Specimen/edge z=3.9 mm" --set "Loading/leg 2=triaxial to axial strain = 0.6 %"
  --set "Loading/leg 3=unload-reload to q = 0.5 MPa" --set "Loading/leg 4=resume to axial strain = 0.7 %")
for n in 1 2 3 4; do
  ranks $n "$mergel" element "$root/apps/cases/element_small.prm" "${element[@]}" --output "element$n" >log 2>&1 ||
    fail "the element test on $n ranks: $(tail -3 log)"
  cmp element1/history.csv "element$n/history.csv" || fail "the element test on $n ranks differs from one"
done
echo "element: the same history on 1, 2, 3, 4 ranks"
# A specimen under pressure, whose settling the ranks share.
for n in 1 2 3; do
  ranks $n "$mergel" sample "$root/apps/cases/sample_rock.prm" --set "Specimen/upscaling ratio=12" \
    --set "Specimen/target pressure=20 kPa" --output "sample$n" >log 2>&1 ||
    fail "the specimen on $n ranks: $(tail -3 log)"
  cmp sample1/sample.h5 "sample$n/sample.h5" || fail "the specimen on $n ranks differs from one"
done
echo "specimen: $(grep -o '^specimen: [0-9]* grains' log), the same file on 1, 2, 3 ranks"

# A run that goes unstable is ended by all ranks together: said once, with the exit code of a failure.
code=0
ranks 3 "$mergel" pile "$root/apps/cases/pile_small.prm" "${tiny[@]}" --output fails \
  --set "Pile/velocity=2000 m/s" >log 2>&1 || code=$?
[ "$code" -eq 2 ] || fail "an unstable run on three ranks: exit code $code"
[ "$(grep -c 'time step safety' log)" -eq 1 ] && ! grep -q 'MPI_ABORT' log || fail "an unstable run is not said once: $(tail -9 log)"
grep -q '"failure": "' fails/failed.json && [ ! -e fails/summary.json ] || fail "an unstable run has no failed.json alone"
# Bad input is said once, with the exit code of bad input.
code=0
ranks 2 "$mergel" pile "$root/apps/cases/pile_small.prm" --set "Pile/diameter=-1 mm" --output none >log 2>&1 || code=$?
[ "$code" -eq 1 ] || fail "bad input on two ranks: exit code $code"
[ "$(grep -c 'Pile/diameter = -1 mm' log)" -eq 1 ] || fail "bad input on two ranks: $(cat log)"
code=0
ranks 2 "$mergel" pile "$root/apps/cases/pile_small.prm" "${tiny[@]}" --output pile1 >log 2>&1 || code=$?
[ "$code" -eq 1 ] || fail "an earlier run on two ranks: exit code $code"
code=0
ranks 3 "$mergel" bench --steps 0 >log 2>&1 || code=$?
[ "$code" -eq 1 ] && [ "$(grep -c '^mergel bench:' log)" -eq 1 ] || fail "a bad command line on three ranks: $(cat log)"
echo "same bits: all holds"
