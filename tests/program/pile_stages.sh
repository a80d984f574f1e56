#!/usr/bin/env bash
# The loading stages of a small coupled pile: all kinds, stopped and restarted inside each of them and on
# other numbers of ranks with the same bits, energies that balance, a head without force at the end of an
# unloading, the cone resistance again after it; a finished run taken further; what may not change. Overlaps:
# what is said of them, and a run that stops at a limit and goes on with another.
#
# usage: tests/program/pile_stages.sh MERGEL
. "$(dirname "$0")/preamble.sh"
pile() { bounded "$mergel" pile "$@"; }
newest() { compgen -G "$1/checkpoint_*.h5" | sort | tail -1; }
# FOLDER STAGE NAME: values of a column in the lines of a stage
column() {
  awk -F, -v stage="$2" -v name="$3" 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k }
    NR > 1 && $at["stage [-]"] == stage { print $at[name] }' "$1/history.csv"
}
last() { column "$@" | tail -1; }
holds() { awk "BEGIN { exit !($1) }" || fail "$2: $1"; }

sed '/set final depth/d' "$case_file" >stages.prm
case_file=stages.prm
options=("${tiny[@]}" --set "Pile/cone angle=120 degree" --set "Output/frames=2"
  --set "Loading/unbalanced-force tolerance=2e-2")
pile "$case_file" "${options[@]}" --set "Loading/stage 1=penetrate to depth = 0.01 mm" --output first >log || fail "the first stage: $(tail -3 log)"
options+=(--set "Specimen/file=$work/first/sample.h5" --set "Loading/stage 1=penetrate to depth = 0.15 mm")
more=(--set "Loading/stage 2=hold for 0.02 ms" --set "Loading/stage 3=unload to head force = 0 N"
  --set "Loading/stage 4=penetrate to depth = 0.2 mm" --set "Loading/stage 5=hold" --set "Loading/stage 6=unload to head force = 10 N"
  --set "Loading/stage 7=load to head force = 20 N" --set "Loading/stage 8=push to displacement = 0.01 mm at height = 1 mm"
  --set "Loading/stage 9=hold for 0.005 ms")
pile "$case_file" "${options[@]}" "${more[@]}" --output whole >whole.log || fail "all stages: $(tail -3 whole.log)"
for k in 1 2 3 4 5 6 7 8 9; do
  grep -q "^stage $k (.*) *done" whole.log || fail "stage $k is not said: $(grep -a stage whole.log)"
  [ -n "$(last whole "$k" "stage [-]")" ] || fail "stage $k has no line"
done

# What the stages do.
holds "$(last whole 1 "depth [m]") >= 0.15e-3 && $(last whole 1 "depth [m]") < 0.151e-3" "the depth of stage 1"
holds "$(last whole 2 "time [s]") - $(last whole 1 "time [s]") >= 0.02e-3" "the time of the hold"
peak=$(last whole 1 "head force of the full pile [N]")
# The particles resist with the head force, within the tolerance of the largest one.
for k in 3 6 7; do
  F=$(last whole "$k" "head force of the full pile [N]")
  tip=$(last whole "$k" "tip force of the full pile [N]") shaft=$(last whole "$k" "shaft force of the full pile [N]")
  holds "sqrt(($tip + $shaft - $F)^2) < 0.05 * $peak" "the forces at the end of stage $k"
done
holds "$(last whole 3 "head force of the full pile [N]") == 0" "the head force at the end of stage 3"
holds "$(last whole 6 "head force of the full pile [N]") == 10 && $(last whole 7 "head force of the full pile [N]") == 20" "head forces"
holds "$(last whole 3 "depth [m]") < $(last whole 2 "depth [m]")" "unloaded, the pile does not move up"
holds "$(column whole 4 "q_c [Pa]" | sort -g | tail -1) > 0.7 * $(column whole 1 "q_c [Pa]" | sort -g | tail -1)" "q_c after the unloading"
holds "$(last whole 8 "lateral displacement of the head [m]") >= 0.01e-3" "the push"
holds "$(last whole 8 "lateral head force of the full pile [N]") != 0" "the lateral force"
holds "$(last whole 8 "rotation of the head [rad]") > 0" "the rotation"
holds "$(last whole 7 "rotation of the head [rad]") == 0" "a rotation before the push"
# Work of the head: on the particles, and damped.
holds "sqrt(($(last whole 9 "head work of the half model [J]") - $(last whole 9 "pile work of the half model [J]") - $(last whole 9 "damping of the half pile [J]"))^2) < 1e-2 * $(last whole 9 "head work of the half model [J]")" "the work of the head"
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == "energy error [-]") c = k } NR > 1 && ($c > 1e-3 || $c < -1e-3) { bad = 1 } END { exit bad }' \
  whole/history.csv || fail "the energy error"

same() {
  cmp whole/history.csv "$1/history.csv" || fail "$1: the history differs"
  for file in whole/fields/*; do cmp "$file" "$1/${file#whole/}" || fail "$1: $file differs"; done
}
# Stopped inside each stage but the last, which is over at once, and continued on another number of ranks, from one to three.
begin=("$case_file" "${options[@]}" "${more[@]}" --output a)
for k in 2 3 4 5 6 7 8; do
  launch mpirun --oversubscribe -n $((k % 3 + 1)) "$mergel" pile "${begin[@]}" >log 2>&1
  begin=(--restart a)
  under_way() { [ -f a/history.csv ] && [ -n "$(last a "$k" "stage [-]")" ]; }
  signal_when TERM under_way
  code=0; wait $launched || code=$?
  [ "$code" -eq 0 ] && break # it ended before the signal came
  [ "$code" -eq 2 ] && grep -q "stopped by SIGTERM at step .* (stage " log || fail "stopped in stage $k: exit code $code: $(tail -3 log)"
done
[ "$code" -eq 0 ] || pile --restart a >log || fail "the end of the restarted run: $(tail -3 log)"
same a

# A finished run is taken further, with the bits of a run that had all stages; what is done may not change.
three=("${more[@]:0:4}")
pile "$case_file" "${options[@]}" "${three[@]}" --output b >log || fail "three stages: $(tail -3 log)"
# Overlaps: a limit that is passed stops the run, and a restart with another one goes on.
overlap=$(awk -F': ' '/"largest overlap/ { print $2 + 0 }' whole/summary.json)
holds "$overlap > 0 && $overlap <= 0.9" "the largest overlap"
limit=$(awk "BEGIN { print 0.8 * $overlap }")
code=$(code_of pile "$case_file" "${options[@]}" "${more[@]}" --set "Motion/largest overlap=$limit" --set "Output/checkpoint every=100 steps" --output d)
[ "$code" -eq 2 ] && grep -q 'overlap by .* of the smaller radius (at most .*`Motion/largest overlap`' log || fail "the limit: exit code $code: $(tail -3 log)"
[ -s d/failed.json ] || fail "no failed.json"
pile --restart d --set "Motion/largest overlap=0.9" >log || fail "with another limit: $(tail -3 log)"
cmp whole/history.csv d/history.csv || fail "d: the history differs"

pile --restart b >log && grep -q 'all its loading stages are done. .*`Loading/stage 4`' log || fail "nothing to do: $(cat log)"
[ "$(code_of pile --restart b --set "Loading/stage 3=unload to head force = 1 N")" -eq 1 ] &&
  grep -q 'Loading/stage 3 = .*: was `unload to head force = 0 N`, which is done' log || fail "a done stage changed: $(cat log)"
[ "$(code_of pile --restart b --set "Loading/stage 3=")" -eq 1 ] && grep -q 'Loading/stage 3 was .*which is done' log || fail "a done stage left out: $(cat log)"
[ "$(code_of pile --restart b "${more[@]:4}" --set "Pile/mass=1 g")" -eq 1 ] && grep -q 'Pile/mass = 1 g: was .*has begun with it' log || fail "the mass: $(cat log)"
on_ranks 2 "$mergel" pile --restart b "${more[@]:4}" >log || fail "taken further: $(tail -3 log)"
same b

# An unloading that would be a loading is known only where it begins; another stage goes on from there.
[ "$(code_of pile "$case_file" "${options[@]}" --set "Loading/stage 2=unload to head force = 1 kN" --set "Output/checkpoint every=20 steps" \
  --output c)" -eq 2 ] && grep -q 'stage 2, unload to head force = 1000 N: the head force is .*another `Loading/stage 2`' log ||
  fail "an unloading to more: $(tail -3 log)"
pile --restart c --set "Loading/stage 2=hold for 0.001 ms" >log || fail "with another stage: $(tail -3 log)"

# A hold finds its equilibrium where the far field's own forces act at every third step or less often: they do not
# meanwhile. As impulses they shake the particles at the interface by 3e-3 of the mean force.
pile "$case_file" "${tiny[@]}" --set "Pile/cone angle=120 degree" --set "Output/frames=2" --set "Specimen/file=$work/first/sample.h5" \
  --set "Loading/stage 1=penetrate to depth = 0.15 mm" --set "Loading/stage 2=hold" --set "Loading/unbalanced-force tolerance=3e-4" \
  --set "Motion/time step safety=0.3" --output held >log || fail "a hold: $(tail -3 log)"
limit=$(sed -n 's/^ *"limit of these steps \[-\]": \([^,]*\),*$/\1/p' held/summary.json)
holds "$limit > 3" "the far field would act at every step anyway"
holds "$(last held 2 "unbalanced-force ratio [-]") <= 3e-4" "the hold ended without equilibrium"

echo "pile_stages: all checks hold; q_c after the unloading $(column whole 4 "q_c [Pa]" | sort -g | tail -1) Pa, before $(column whole 1 "q_c [Pa]" | sort -g | tail -1) Pa"
