#!/usr/bin/env bash
# Section 2 of the paper in numbers: its element tests and their tables for tests/validation/README.md.
#
# usage: tests/validation/laboratory.sh MERGEL FOLDER [STUDY...]
#   FOLDER  takes specimens, runs and a table STUDY.csv of each study; what is there is not run again
#   STUDY   bands coordination fig14 fig15 fig8 fig9b fig10 fig11 fig7; default all of them in this order
# Environment: JOBS, runs at a time, default 2; SEEDS, default "1 2 3"; FLOWS, default "published conjugate".
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 1; }
cases=$(cd "$(dirname "$0")/../../apps/cases" && pwd)
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- bands coordination fig14 fig15 fig8 fig9b fig10 fig11 fig7
read -ra seeds <<<"${SEEDS:-1 2 3}"
read -ra flows <<<"${FLOWS:-published conjugate}"

# Runs are collected in a list, one line each, and run JOBS at a time; specimens first, because runs share them.
list=$(mktemp)
trap 'rm -f "$list"' EXIT
export cases mergel
tab=$'\t'

# specimen NAME CASE "Key=value; Key=value": its runs take the same keys
specimen() {
  echo "${3:-}" >"$1.keys"
  [ -s "$1/sample.h5" ] || echo "sample$tab$1$tab$2$tab$tab$tab${3:-}" >>"$list"
}
# run NAME CASE SPECIMEN "stage; stage" "Key=value; Key=value"
run() { [ -s "$1/summary.json" ] || echo "element$tab$1$tab$2$tab$3$tab$4$tab$(cat "$3.keys"); ${5:-}" >>"$list"; }
work() {
  local job name case specimen stages keys part k=0 settings=()
  IFS='|' read -r job name case specimen stages keys <<<"${1//$'\t'/|}"
  while IFS= read -r part; do [ -z "$part" ] || settings+=(--set "$part"); done <<<"${keys//; /$'\n'}"
  if [ "$job" = element ]; then
    settings+=(--set "Specimen/file=$specimen/sample.h5")
    while IFS= read -r part; do settings+=(--set "Loading/stage $((++k))=$part"); done <<<"${stages//; /$'\n'}"
    [ $k -gt 1 ] || settings+=(--set "Loading/stage 2=")
  fi
  mkdir -p "$(dirname "$name")"
  case=$cases/element_$case.prm
  if [ "$job" = sample ]; then # knows no bond's strength and no stage
    sed '/^subsection \(Bond\|Loading\)/,/^end/d' "$case" >"$name.prm"
    case=$name.prm
  fi
  "$mergel" "$job" "$case" "${settings[@]}" --output "$name" --overwrite >"$name.log" 2>&1 ||
    {
      [ ! -e "$name/summary.json" ] || mv "$name/summary.json" "$name/summary.failed.json" # it is run again
      echo "$name: $(tail -1 "$name.log")"
      return 1
    }
  if [ "$job" = element ] && ! grep -q '"outcome": "target reached"\|pulled apart' "$name/summary.json"; then
    echo "$name ended early: $(grep -m 1 '"outcome"' "$name/summary.json")"
  fi
}
export -f work
all_done() {
  sort -u "$list" | tr '\n' '\0' | xargs -0 -r -n 1 -P "${JOBS:-2}" bash -c 'work "$1"' work
  : >"$list"
}
# value NAME QUANTITY [NTH]: a value of a summary, of the NTH stage that has it; "nan" if none has
value() {
  awk -F': ' -v name="\"$2 [" -v nth="${3:-1}" 'index($1, name) && ++n == nth { v = $2 + 0; found = $2 !~ /null/ }
    END { print found ? v : "nan" }' "$1/summary.json"
}
# at NAME "column" "strain column" STRAIN: linear in a history
at() {
  awk -F, -v y="$2" -v x="$3" -v x0="$4" 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
    { X = $at[x]; Y = $at[y]; if (n++ && (px - x0) * (X - x0) <= 0 && X != px) { v = py + (Y - py) * (x0 - px) / (X - px); found = 1 }
      px = X; py = Y } END { print found ? v : "nan" }' "$1/history.csv"
}

flow() { echo "Bond/bending flow=$1"; }
unbonded="Bond/tensile strength=1 Pa; Bond/compressive strength=1 Pa; Bond/shear strength=1 Pa; Bond/softening displacement=1e-6 mm; Bond/softening rotation=1e-6 rad"
# cube EDGE-IN-MM
cube() { echo "Specimen/edge x=$1 mm; Specimen/edge y=$1 mm; Specimen/edge z=$1 mm"; }
times() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.6g", a * b }'; }
# upscaled S WIDTH-IN-MM SEED
upscaled() { echo "Specimen/upscaling ratio=$1; $(cube "$2"); Specimen/seed=$3"; }
row() { local IFS=,; echo "$*" >>"$table"; }
header() { table=$1.csv; shift; rm -f "$table"; row "$@"; }

# The calibrated rock: E, UCS, tension, isotropic yield and return, softening at 1 MPa, hardening at 4 MPa, S.
bands() {
  local s f S p
  for s in "${seeds[@]}"; do
    specimen "rock_$s" rock "Specimen/seed=$s"
    for S in 2 10; do specimen "rock_S${S}_$s" rock "$(upscaled $S "$(times 1.8226 $S)" "$S$s")"; done
  done
  all_done
  for s in "${seeds[@]}"; do
    for f in "${flows[@]}"; do
      run "bands/ucs_${f}_$s" rock "rock_$s" "compression to axial strain = 2 %" "$(flow "$f")"
      run "bands/tension_${f}_$s" rock "rock_$s" "tension to axial strain = -1.5 %" "$(flow "$f")"
      run "bands/iso_${f}_$s" rock "rock_$s" "isotropic to p = 25 MPa" "$(flow "$f")"
      for p in 1 4; do
        run "bands/tx${p}_${f}_$s" rock "rock_$s" "isotropic to p = $p MPa; triaxial to axial strain = 18 %" "$(flow "$f")"
      done
    done
    run "bands/unbonded_$s" rock "rock_$s" "isotropic to p = 25 MPa" "$unbonded"
    for S in 2 10; do run "bands/ucs_S${S}_$s" rock "rock_S${S}_$s" "compression to axial strain = 2 %"; done
  done
  all_done
  header bands flow seed "E [Pa]" nu "UCS [Pa]" "tensile strength [Pa]" "isotropic yield [Pa]" "first peak [Pa]" "dip after it [Pa]" \
    "peak q at 1 MPa [Pa]" "minimum q at 1 MPa [Pa]" "q/p at 1 MPa" "peak q at 4 MPa [Pa]" "q at 18 % at 4 MPa [Pa]" "q/p at 4 MPa" \
    "p over unbonded at 25 MPa"
  for f in "${flows[@]}"; do
    for s in "${seeds[@]}"; do
      row "$f" "$s" "$(value "bands/ucs_${f}_$s" "Young's modulus")" "$(value "bands/ucs_${f}_$s" "Poisson's ratio")" \
        "$(value "bands/ucs_${f}_$s" UCS)" "$(value "bands/tension_${f}_$s" "tensile strength")" \
        "$(value "bands/iso_${f}_$s" "isotropic yield")" "$(value "bands/iso_${f}_$s" "first peak before a collapse")" "$(value "bands/iso_${f}_$s" "minimum after the first peak")" \
        "$(value "bands/tx1_${f}_$s" "largest q")" "$(value "bands/tx1_${f}_$s" "minimum after the largest q")" "$(value "bands/tx1_${f}_$s" "q/p at the end")" \
        "$(value "bands/tx4_${f}_$s" "largest q")" "$(value "bands/tx4_${f}_$s" "q at the end")" "$(value "bands/tx4_${f}_$s" "q/p at the end")" \
        "$(over_unbonded "bands/iso_${f}_$s" "bands/unbonded_$s")"
    done
  done
  header bands_scale S seed "E [Pa]" "UCS [Pa]"
  for s in "${seeds[@]}"; do
    for S in 2 5 10; do
      local name=bands/ucs_S${S}_$s
      [ $S != 5 ] || name=bands/ucs_published_$s
      row $S "$s" "$(value "$name" "Young's modulus")" "$(value "$name" UCS)"
    done
  done
}
# p of the bonded rock near 25 MPa over p of the unbonded one at the same void ratio
over_unbonded() {
  local e p
  e=$(at "$2" "void ratio [-]" "p [Pa]" 24.9e6)
  p=$(at "$1" "p [Pa]" "void ratio [-]" "$e")
  if [ "$p" != nan ]; then awk -v p="$p" 'BEGIN { print p / 24.9e6 }'; return; fi
  e=$(at "$1" "void ratio [-]" "p [Pa]" 24.9e6)
  awk -v b="$(at "$2" "p [Pa]" "void ratio [-]" "$e")" 'BEGIN { print b == "nan" ? b : 24.9e6 / b }'
}

# The rock of Table 1 with fewer bonds: which Z = 2 N_bonds/N the table belongs to.
coordination() {
  local s Z name
  for s in "${seeds[@]}"; do
    for Z in 4 5 5.8; do specimen "rock_Z${Z}_$s" rock "Specimen/seed=$s; Specimen/coordination=$Z"; done
  done
  all_done
  for s in "${seeds[@]}"; do
    for Z in 4 5 5.8; do
      run "coordination/ucs_Z${Z}_$s" rock "rock_Z${Z}_$s" "compression to axial strain = 2 %"
      run "coordination/tension_Z${Z}_$s" rock "rock_Z${Z}_$s" "tension to axial strain = -1.5 %"
      run "coordination/tx1_Z${Z}_$s" rock "rock_Z${Z}_$s" "isotropic to p = 1 MPa; triaxial to axial strain = 10 %"
    done
  done
  all_done
  header coordination Z seed "E [Pa]" nu "UCS [Pa]" "tensile strength [Pa]" "peak q at 1 MPa [Pa]" "minimum q at 1 MPa [Pa]" \
    "q at 10 % [Pa]"
  for Z in 4 5 5.8; do
    for s in "${seeds[@]}"; do
      name=coordination/ucs_Z${Z}_$s
      row $Z "$s" "$(value "$name" "Young's modulus")" "$(value "$name" "Poisson's ratio")" "$(value "$name" UCS)" \
        "$(value "coordination/tension_Z${Z}_$s" "tensile strength")" "$(value "coordination/tx1_Z${Z}_$s" "largest q")" \
        "$(value "coordination/tx1_Z${Z}_$s" "minimum after the largest q")" "$(value "coordination/tx1_Z${Z}_$s" "q at the end")"
    done
  done
}

# Isotropic and triaxial compression of the calibrated rock, without the membrane.
fig14() {
  bands
  local f
  header fig14 flow "isotropic yield [Pa]" "largest q at 1 MPa [Pa]" "minimum [Pa]" "largest q at 4 MPa [Pa]"
  for f in "${flows[@]}"; do
    row "$f" "$(value "bands/iso_${f}_1" "isotropic yield")" "$(value "bands/tx1_${f}_1" "largest q")" \
      "$(value "bands/tx1_${f}_1" "minimum after the largest q")" "$(value "bands/tx4_${f}_1" "largest q")"
  done
}

# Triaxial tests from 0 to 6 MPa: yield points, stress ratio, critical state line, volume.
fig15() {
  local f p stages
  specimen rock_1 rock "Specimen/seed=1"
  all_done
  for f in "${flows[@]}"; do
    for p in 0 0.25 0.5 1 1.5 2.5 4 6; do
      stages="isotropic to p = $p MPa; triaxial to axial strain = 20 %"
      [ $p != 0 ] || stages="triaxial at 0 MPa to axial strain = 20 %"
      run "fig15/${f}_$p" rock rock_1 "$stages" "$(flow "$f")"
    done
  done
  all_done
  header fig15 flow "confinement [MPa]" "q at yield [Pa]" "largest q [Pa]" "minimum after the peak [Pa]" "q/p at 20 %" \
    "friction angle [degree]" "p at the end [Pa]" "e at the end"
  for f in "${flows[@]}"; do
    for p in 0 0.25 0.5 1 1.5 2.5 4 6; do
      local name=fig15/${f}_$p
      row "$f" $p "$(value "$name" "q at yield")" "$(value "$name" "largest q")" "$(value "$name" "minimum after the largest q")" \
        "$(value "$name" "q/p at the end")" "$(value "$name" "friction angle at the end")" "$(value "$name" "p at the end")" \
        "$(value "$name" "void ratio at the end")"
    done
  done
}

# Softening parameters in isotropic compression, dense and loose.
fig8() {
  local k f theta
  for k in dense loose; do specimen "$k" $k; done
  all_done
  for k in dense loose; do
    for f in "${flows[@]}"; do
      for theta in 2 5 10 20; do
        run "fig8/${k}_${f}_$theta" $k $k "isotropic to volumetric strain = 12 %" "$(flow "$f"); Bond/softening rotation=$theta mrad"
      done
    done
  done
  all_done
  header fig8 rock flow "softening rotation [mrad]" "isotropic yield [Pa]" "first peak before a collapse [Pa]" "p at 5 % [Pa]" "p at 10 % [Pa]"
  for k in dense loose; do
    for f in "${flows[@]}"; do
      for theta in 2 5 10 20; do
        local name=fig8/${k}_${f}_$theta
        row $k "$f" $theta "$(value "$name" "isotropic yield")" "$(value "$name" "first peak before a collapse")" \
          "$(at "$name" "p [Pa]" "volumetric strain [-]" 0.05)" "$(at "$name" "p [Pa]" "volumetric strain [-]" 0.1)"
      done
    done
  done
}

# Far-field contact of the loose rock: a specimen for each g_a, which is part of generation.
fig9b() {
  local f g
  for g in 0 0.01 0.1 0.2; do specimen "loose_ga$g" loose "Contact/activation gap=$(times 0.066 $g) mm"; done # pressed at 0.2
  all_done
  for f in "${flows[@]}"; do
    for g in 0 0.01 0.1 0.2; do
      run "fig9b/${f}_$g" loose "loose_ga$g" "isotropic to volumetric strain = 12 %" "$(flow "$f")"
    done
  done
  all_done
  header fig9b flow "g_a/d00" "isotropic yield [Pa]" "first peak before a collapse [Pa]" "p at 5 % [Pa]" "p at 10 % [Pa]"
  for f in "${flows[@]}"; do
    for g in 0 0.01 0.1 0.2; do
      local name=fig9b/${f}_$g
      row "$f" $g "$(value "$name" "isotropic yield")" "$(value "$name" "first peak before a collapse")" \
        "$(at "$name" "p [Pa]" "volumetric strain [-]" 0.05)" "$(at "$name" "p [Pa]" "volumetric strain [-]" 0.1)"
    done
  done
}

# Upscaling: triaxial compression at 100 kPa for S = 1, 10, 100, each its own packing.
fig10() {
  local f S s
  for s in "${seeds[@]}"; do
    for S in 1 10 100; do specimen "scale_S${S}_$s" scale "$(upscaled $S "$(times 2.333 $S)" "${#S}$s")"; done
  done
  all_done
  for f in "${flows[@]}"; do
    for s in "${seeds[@]}"; do
      for S in 1 10 100; do
        run "fig10/${f}_${S}_$s" scale "scale_S${S}_$s" "isotropic to p = 100 kPa; triaxial to axial strain = 5 %" "$(flow "$f"); Loading/reference pressure=0.1 MPa"
      done
    done
  done
  all_done
  header fig10 flow S seed "E [Pa]" "first peak of q [Pa]" "q at 5 % [Pa]" "bonds broken"
  for f in "${flows[@]}"; do
    for S in 1 10 100; do
      for s in "${seeds[@]}"; do
        local name=fig10/${f}_${S}_$s
        row "$f" $S "$s" "$(value "$name" "Young's modulus")" "$(value "$name" "first peak before a collapse")" \
          "$(value "$name" "q at the end")" "$(value "$name" "bonds broken")"
      done
    done
  done
}

# Size effect, Table 5: UCS against the width with the strengths of Eq. 18, three packings a width. The
# paper's two largest specimens (363,672 and 255,417 particles) are replaced by other ratios S of their width.
fig11() {
  local widths=("10 4" "30 12" "50 20" "80 20" "80 32" "120 48" "160 48" "160 64") f w s
  for w in "${widths[@]}"; do
    set -- $w
    for s in "${seeds[@]}"; do
      [ "$s" = 1 ] || [ "$w" != "80 20" ] || continue
      specimen "size_$1_$2_$s" scale "$(upscaled "$2" "$1" "$1$s")"
    done
  done
  all_done
  for f in "${flows[@]}"; do
    for w in "${widths[@]}"; do
      set -- $w
      for s in "${seeds[@]}"; do
        [ -s "size_$1_$2_$s/sample.h5" ] || continue
        run "fig11/${f}_$1_$2_$s" scale "size_$1_$2_$s" "compression to axial strain = 3 %" "$(flow "$f"); Size effect/size effect=true; Size effect/reference width=50 mm; Size effect/psi=1.1"
      done
    done
  done
  all_done
  header fig11 flow "B [mm]" S seed particles "UCS [Pa]" "E [Pa]"
  for f in "${flows[@]}"; do
    for w in "${widths[@]}"; do
      set -- $w
      for s in "${seeds[@]}"; do
        local name=fig11/${f}_$1_$2_$s
        [ ! -s "$name/summary.json" ] || row "$f" "$1" "$2" "$s" "$(value "$name" particles)" "$(value "$name" UCS)" "$(value "$name" "Young's modulus")"
      done
    done
  done
}

# Elastic domains: yield along radial paths for the strengths of Table 2.
fig7() {
  local k f set path name keys p
  local sets=("reference 90 9" "sc180 180 9" "sc450 450 9" "sc900 900 9" "C4.5 90 4.5" "C18 90 18" "C45 90 45")
  local paths=("0" "0.75" "1.5" "3")
  for k in dense loose; do specimen "$k" $k; done
  all_done
  for f in "${flows[@]}"; do
    for set in "${sets[@]}"; do
      set -- $set
      keys="$(flow "$f"); Bond/compressive strength=$2 MPa; Bond/shear strength=$3 MPa"
      for k in dense loose; do
        for path in "${paths[@]}"; do
          run "fig7/${k}_${f}_$1_$path" $k $k "radial dq/dp = $path to axial strain = 2.5 %" "$keys"
        done
      done
    done
    all_done
  done
  header fig7 rock flow strengths "dq/dp" "p at yield [Pa]" "q at yield [Pa]"
  for k in dense loose; do
    for f in "${flows[@]}"; do
      for set in "${sets[@]}"; do
        set -- $set
        for path in "${paths[@]}"; do
          name=fig7/${k}_${f}_$1_$path
          p=$(value "$name" "p at yield")
          # A specimen that dilates before it yields has no offset in volumetric strain: its first peak.
          [ "$p" != nan ] || p=$(value "$name" "first peak before a collapse")
          row $k "$f" "$1" "$path" "$p" "$(at "$name" "q [Pa]" "p [Pa]" "$p")"
        done
      done
    done
  done
}

for study; do
  "$study"
  echo "$study: $PWD/$study.csv"
done
