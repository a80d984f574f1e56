#!/usr/bin/env bash
# The same bits on 1, 2, 3, 4 and 8 ranks: bonded assemblies that break and move across the borders of the
# ranks, with forced rebuilds and migrations and a new largest frequency in the middle; and a small coupled pile. Each scene is also
# stopped at an arbitrary step and restarted on another number of ranks, twice (the pile: restart.sh).
#
# usage: tests/mpi/same_bits.sh MPI_SCENES MERGEL
scenes=$(readlink -f "$1")
shift
. "$(dirname "$0")/../program/preamble.sh"
ranks() { on_ranks "$@"; }

ranks 1 "$scenes" sums >one || fail "sums on one rank"
[ "$(wc -l <one)" -eq 40 ] || fail "sums: forty lines on one rank"
for n in 2 3 4 8; do
  ranks $n "$scenes" sums >other || fail "sums on $n ranks"
  cmp one other || fail "sums on $n ranks differ from one"
done
for scene in block turning debris periodic hertz element varied; do
  ranks 1 "$scenes" "$scene" >one || fail "$scene on one rank"
  [ "$(wc -l <one)" -eq 11 ] || fail "$scene: ten lines and a frame on one rank"
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
  echo "$scene: $(sed -n 10p one | cut -d' ' -f3-6), the same bits on 1, 2, 3, 4, 8 ranks and after two restarts"
done

# A rank that sees another folder (a local disk) is reported. It writes no file there and leaves an old
# one of that name as it is.
mkdir apart
apart() {
  on_ranks 2 bash -c '[ "$OMPI_COMM_WORLD_RANK" = 0 ] || cd apart; exec "$@"' apart "$@"
}
for old in none .c.partial.h5; do
  [ $old = none ] || echo old >apart/$old
  if apart "$scenes" block stop 3 c.h5 >log 2>&1; then fail "a checkpoint in two folders was sealed"; fi
  grep -q 'c.h5: rank 1 on .* does not see the file that rank 0 on' log || fail "a checkpoint in two folders: $(cat log)"
  [ ! -e c.h5 ] && [ ! -e apart/c.h5 ] || fail "a checkpoint in two folders is left"
done
[ "$(cat apart/.c.partial.h5)" = old ] || fail "an old file was overwritten"

# Coupled: a small pile until bonds break.
tiny+=("${shallow[@]}" --set "Output/frames=1")
for n in 1 2 3 4 8; do
  ranks $n "$mergel" pile "$root/apps/cases/pile_small.prm" "${tiny[@]}" --output "pile$n" >log 2>&1 ||
    fail "the pile on $n ranks: $(tail -3 log)"
  cmp pile1/history.csv "pile$n/history.csv" || fail "the pile on $n ranks differs from one"
  cmp pile1/sample.h5 "pile$n/sample.h5" || fail "the specimen of the pile on $n ranks differs from one"
  for file in fields/{particles_0001.vtp,bonds_0001.vtp,contacts_0001.vtp,fields_0001.vti} \
    {shaft,tip,radial}_profile.csv stress_path.csv; do
    cmp "pile1/$file" "pile$n/$file" || fail "$file of the pile on $n ranks differs from that on one"
  done
done
broken=$(awk -F': ' '/"bonds broken/ { print $2 + 0 }' pile1/summary.json)
[ "$broken" -gt 20 ] || fail "the pile broke only $broken bonds"
echo "pile: $broken bonds broken, the same specimen, history, profiles and frames on 1, 2, 3, 4, 8 ranks"

# An element test with a servo and unloading.
element=(--set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" --set "Specimen/edge z=3.9 mm" --set "Loading/stage 2=triaxial to axial strain = 0.6 %"
  --set "Loading/stage 3=unload-reload to q = 0.5 MPa" --set "Loading/stage 4=resume to axial strain = 0.7 %")
for n in 1 2 3 4; do
  ranks $n "$mergel" element "$root/apps/cases/element_small.prm" "${element[@]}" --output "element$n" >log 2>&1 ||
    fail "the element test on $n ranks: $(tail -3 log)"
  cmp element1/history.csv "element$n/history.csv" || fail "the element test on $n ranks differs from one"
done
echo "element: the same history on 1, 2, 3, 4 ranks"
# A specimen under pressure; all ranks share the settling.
for n in 1 2 3; do
  ranks $n "$mergel" sample "$root/apps/cases/sample_rock.prm" --set "Specimen/upscaling ratio=12" \
    --set "Specimen/target pressure=20 kPa" --output "sample$n" >log 2>&1 ||
    fail "the specimen on $n ranks: $(tail -3 log)"
  cmp sample1/sample.h5 "sample$n/sample.h5" || fail "the specimen on $n ranks differs from one"
done
echo "specimen: $(grep -o '^specimen: [0-9]* particles' log), the same file on 1, 2, 3 ranks"

# All ranks end an unstable run together: one message and the exit code of a failure.
code=0
ranks 3 "$mergel" pile "$root/apps/cases/pile_small.prm" "${tiny[@]}" --output fails \
  --set "Pile/penetration rate=2000 m/s" >log 2>&1 || code=$?
[ "$code" -eq 2 ] || fail "an unstable run on three ranks: exit code $code"
[ "$(grep -c 'time step safety' log)" -eq 1 ] && ! grep -q 'MPI_ABORT' log || fail "an unstable run does not give one message: $(tail -9 log)"
grep -q '"failure": "' fails/failed.json && [ ! -e fails/summary.json ] || fail "an unstable run has no failed.json alone"
# Bad input gives one message and the exit code of bad input.
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
echo "same bits: all checks hold"
