#!/usr/bin/env bash
# Specimens of a few particles: the same bits on five ranks, some of which own nothing, as on one, or the
# same refusal, said once. One particle is no specimen, and equal ones are as wanted.
#
# usage: tests/mpi/degenerate.sh MERGEL
. "$(dirname "$0")/../program/preamble.sh"

# A box of 2.6 mm with room for 112.4 (1 - n) particles of 0.6685 mm.
few=("$root/apps/cases/element_small.prm" --set "Specimen/edge x=2.6 mm" --set "Specimen/edge y=2.6 mm"
  --set "Specimen/edge z=2.6 mm" --set "Specimen/smallest diameter=0.1337 mm" --set "Specimen/bond gap=0.1 mm"
  --set "Specimen/coordination=1" --set "Loading/strain limit=0.02")
test=(--set "Loading/stage 1=isotropic to volumetric strain = 0.1 %" --set "Loading/stage 2=" --set "Loading/stage 3="
  --set "Loading/stage 4=")
mkdir one five
figure() { awk -F': ' -v name="\"$2\"" 'index($0, name) { sub(/,$/, "", $2); print $2 }' "$1/summary.json"; } # as it stands there

# same NAME FILE COMMAND...: FILE of the results, or the last line of a refusal, on 1 and 5 ranks
same()
{
  local name=$1 file=$2 one=0 five=0 said
  shift 2
  (cd one && bounded "$mergel" "$@" --output "$name") >"$name.one" 2>&1 || one=$?
  (cd five && on_ranks 5 "$mergel" "$@" --output "$name") >"$name.five" 2>&1 || five=$?
  [ $one -eq $five ] || fail "$name: exit code $one on one rank, $five on five: $(tail -5 "$name.five")"
  if [ $one -eq 0 ]; then
    cmp "one/$name/$file" "five/$name/$file" || fail "$name: $file on five ranks differs from one"
  else
    said=$(tail -1 "$name.one")
    [ "$(grep -cF -- "$said" "$name.five")" -eq 1 ] || fail "$name: \"$said\" is not said once: $(cat "$name.five")"
  fi
}

for case in "4 0.964" "3 0.9733" "2 0.9822"; do
  read -r n porosity <<<"$case"
  same "sample$n" sample.h5 sample "${few[@]}" --set "Specimen/porosity=$porosity"
  [ "$(figure "one/sample$n" "particles [-]")" = "$n" ] || fail "not $n particles: $(cat "sample$n.one")"
  [ "$(figure "one/sample$n" "largest difference of the size curves by mass [-]")" = 0 ] &&
    [ "$(figure "one/sample$n" "largest difference of the size curves by number [-]")" = 0 ] ||
    fail "equal particles are not as wanted: $(cat "sample$n.one")"
  grep -q ': null' "five/sample$n/summary.json" && fail "a number of summary.json is not finite"
  same "element$n" history.csv element "${few[@]}" "${test[@]}" --set "Specimen/porosity=$porosity"
  echo "$n particles: sample and element test alike on 1 and 5 ranks; $(tail -1 "element$n.one")"
done

for case in "1 0.9911" "0 0.9999"; do
  read -r n porosity <<<"$case"
  for job in sample element; do
    same "$job$n" none "$job" "${few[@]}" --set "Specimen/porosity=$porosity"
    [ "$(code_of "$mergel" "$job" "${few[@]}" --set "Specimen/porosity=$porosity" --output "none$n")" -eq 1 ] &&
      grep -q "Specimen/porosity = $porosity: leaves room for fewer than two particles" log || fail "$job of $n particles: $(cat log)"
    [ ! -e "none$n" ] || fail "results of $n particles"
  done
done
echo "degenerate: all checks hold"
