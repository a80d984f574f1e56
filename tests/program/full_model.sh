#!/usr/bin/env bash
# The full model of a pile: it has no symmetry plane, its forces are not doubled, its energies are those
# of all of it, and its bits do not depend on the ranks or on a restart.
#
# usage: tests/program/full_model.sh MERGEL
. "$(dirname "$0")/preamble.sh"
tiny+=("${shallow[@]}" --set "Output/frames=1" --set "Specimen/shape=cylinder")
sed '/set symmetry/d' "$case_file" >full.prm

bounded "$mergel" pile full.prm "${tiny[@]}" --output one >log 2>&1 || fail "the full pile: $(tail -3 log)"
head -1 one/history.csv | grep -q 'pile work of the full model \[J\]' || fail "energies: $(head -1 one/history.csv)"
! head -1 one/history.csv | grep -q 'half model' || fail "a half model is left: $(head -1 one/history.csv)"
cells() { sed -n 's/.*far field: \([0-9]*\) cells.*/\1/p' "$1" | head -1; }
full=$(cells log)

# The pile's force is that on its surface: work = force times travel, where the half model's is twice that.
column() { awk -F, -v name="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k; next } { print $at }' one/history.csv; }
paste -d, <(column "tip depth [m]") <(column "tip force of the full pile [N]") <(column "shaft force of the full pile [N]") \
  <(column "pile work of the full model [J]") >work.csv
awk -F, '{ sum += ($2 + $3) * ($1 - before); before = $1; work = $4 }
  END { ratio = work / sum; print "work over force times travel: " ratio; exit !(ratio > 0.95 && ratio < 1.05) }' work.csv >ratio ||
  fail "forces and work do not belong together: $(cat ratio)"

# Particles on both sides of y = 0, and a whole pile.
"$mergel" info one >info 2>&1 || fail "info: $(cat info)"

on_ranks 3 "$mergel" pile full.prm "${tiny[@]}" --output three >log3 2>&1 || fail "on three ranks: $(tail -3 log3)"
cmp one/history.csv three/history.csv || fail "three ranks give another history"
for file in one/fields/*; do cmp "$file" "three/${file#one/}" || fail "three ranks: $file differs"; done

bounded "$mergel" pile "$case_file" "${tiny[@]:0:${#tiny[@]}-2}" --output half >loghalf 2>&1 || fail "the half pile: $(tail -3 loghalf)"
half=$(cells loghalf)
[ -n "$full" ] && [ "$full" -eq $((2 * half)) ] || fail "the full model has '$full' cells, the half '$half'"
bounded "$mergel" pile --restart one --set "Pile/final depth=0.17 mm" >logmore 2>&1 || fail "further: $(tail -3 logmore)"
awk -F, 'END { exit !($2 > 0.169e-3) }' one/history.csv || fail "the full pile was not pushed further: $(tail -1 one/history.csv)"
echo "full model: all checks hold; $full cells, $(cat ratio)"
