#!/usr/bin/env bash
# Does physics notice the time step? Element tests on three packings and means of q_c of pile_small.prm, for
# tests/validation/README.md. Some two hours on one core.
#
# usage: tests/validation/time_step.sh MERGEL FOLDER [STUDY...]
#   FOLDER  takes samples, runs and the tables time_step_element.csv and time_step_pile.csv; what is there is not
#           run again
#   STUDY   element pile; default both
# Environment: SAFETY, of the time step, default 0.9 (a mergel before the eigenvalue step: 0.7); N, piles of the
# default, default 10; SCALED, piles of each kind of scaled inertia or mass, default 5 (0: none); TAG, name of the
# program in the tables, default "now".
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,12s/^# \{0,1\}//p' "$0" >&2; exit 1; }
cases=$(cd "$(dirname "$0")/../../apps/cases" && pwd)
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- element pile
tag=${TAG:-now} safety=${SAFETY:-0.9}

value() { awk -F': ' -v name="\"$2 [" 'index($1, name) { v = $2 + 0; found = 1; exit } END { print found ? v : "nan" }' "$1/summary.json"; }

# test_of NAME SEED STAGE...: an element test of the paper's rock
test_of() {
  local name=$1 seed=$2 k=0 keys=()
  shift 2
  [ -s "$name/summary.json" ] && return
  for stage in "$@"; do keys+=(--set "Loading/stage $((++k))=$stage"); done
  [ $k -gt 1 ] || keys+=(--set "Loading/stage 2=")
  mkdir -p "$(dirname "$name")"
  "$mergel" element "$cases/element_rock.prm" --set "Specimen/file=samples/rock_$seed/sample.h5" \
    --set "Specimen/seed=$seed" --set "Bond/bending flow=published" --set "Motion/time step safety=$safety" \
    "${keys[@]}" --output "$name" --overwrite >"$name.log" 2>&1
}

element() {
  local s
  mkdir -p samples
  [ -s time_step_element.csv ] || echo 'program,seed,E [Pa],UCS [Pa],tensile strength [Pa],isotropic yield [Pa],peak of q at 1 MPa [Pa],minimum after it [Pa],largest energy error [-],steps [-]' >time_step_element.csv
  for s in 1 2 3; do
    if [ ! -s "samples/rock_$s/sample.h5" ]; then
      sed '/^subsection \(Bond\|Loading\)/,/^end/d' "$cases/element_rock.prm" >"samples/rock_$s.prm"
      "$mergel" sample "samples/rock_$s.prm" --set "Specimen/seed=$s" --output "samples/rock_$s" --overwrite >"samples/rock_$s.log"
    fi
    test_of "$tag/ucs_$s" $s "compression to axial strain = 2 %"
    test_of "$tag/tension_$s" $s "tension to axial strain = -1.5 %"
    test_of "$tag/iso_$s" $s "isotropic to p = 10 MPa"
    test_of "$tag/tx1_$s" $s "isotropic to p = 1 MPa" "triaxial to axial strain = 8 %"
    local worst=0 steps=0 t
    for t in ucs tension iso tx1; do
      worst=$(awk -v a="$worst" -v b="$(value "$tag/${t}_$s" "largest energy error")" 'BEGIN { print (b > a ? b : a) }')
      steps=$(awk -v a="$steps" -v b="$(value "$tag/${t}_$s" steps)" 'BEGIN { print a + b }')
    done
    echo "$tag,$s,$(value "$tag/ucs_$s" "Young's modulus"),$(value "$tag/ucs_$s" UCS),$(value "$tag/tension_$s" "tensile strength"),$(value "$tag/iso_$s" "isotropic yield"),$(value "$tag/tx1_$s" "largest q"),$(value "$tag/tx1_$s" "minimum after the largest q"),$worst,$steps" >>time_step_element.csv
  done
}

# one KIND SAFETY KEYS...: a pile, and its mean q_c over 0.7 to 2.8 mm
one() {
  local kind=$1 s=$2 name
  shift 2
  name=$tag/${kind}_$s
  mkdir -p "$tag"
  [ -s "$name/summary.json" ] || "$mergel" pile "$cases/pile_small.prm" --set "Output/frames=1" --set "Motion/time step safety=$s" "$@" \
    --output "$name" --overwrite >"$name.log" 2>&1
  awk -F, -v tag="$tag" -v kind="$kind" -v safety="$s" -v steps="$(value "$name" steps)" -v broken="$(value "$name" "bonds broken")" '
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
    { e = $at["energy error [-]"]; if (e < 0) e = -e; if (e > worst) worst = e }
    $at["depth [m]"] >= 0.7e-3 && $at["depth [m]"] <= 2.8e-3 { sum += $at["q_c [Pa]"]; ++n }
    END { print tag "," kind "," safety "," sum / n "," broken "," worst "," steps }' "$name/history.csv" >>time_step_pile.csv
}

# The step of each realisation differs by up to 1 %: the piles are as different as those of several seeds.
pile() {
  local k s
  [ -s time_step_pile.csv ] || echo 'program,kind,safety [-],mean q_c [Pa],bonds broken [-],largest energy error [-],steps [-]' >time_step_pile.csv
  for ((k = 0; k < ${N:-10}; ++k)); do
    s=$(awk -v s="$safety" -v k=$k 'BEGIN { printf "%.4f", s * (0.99 + 0.0022 * k) }')
    one plain "$s"
    [ $k -lt "${SCALED:-5}" ] || continue
    one inertia_2 "$s" --set "Motion/inertia factor=2"
    one mass_1.26 "$s" --set "Motion/mass scaling=1.26" --set "Motion/mass scaling limit=1"
    one mass_1.5 "$s" --set "Motion/mass scaling=1.5" --set "Motion/mass scaling limit=1"
  done
}

for study in "$@"; do "$study"; done
[ ! -s time_step_pile.csv ] || awk -F, 'NR > 1 { k = $1 " " $2; n[k]++; sum[k] += $4; squares[k] += $4 * $4; steps[k] += $7 }
  END { for (k in n) { m = sum[k] / n[k]; v = n[k] > 1 ? (squares[k] - n[k] * m * m) / (n[k] - 1) : 0
    printf "%s: mean q_c %.2f MPa, standard error %.2f, of %d piles; %d steps\n", k, m / 1e6, sqrt(v > 0 ? v / n[k] : 0) / 1e6, n[k], steps[k] / n[k] } }' time_step_pile.csv
