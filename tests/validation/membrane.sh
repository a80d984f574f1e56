#!/usr/bin/env bash
# The paper's rock in a membrane between platens (Figs. 13 to 16), and what its results depend on: the table of
# tests/validation/README.md. At the paper's size an hour of processor time for each test to 20 %.
#
# usage: tests/validation/membrane.sh MERGEL FOLDER [NAME...]
#   FOLDER  takes specimens, runs and the table membrane.csv; what is there is not run again, what was stopped goes on
#   NAME    small, mesh_0.17, mesh_0.23, mesh_0.33: `triaxial_small.prm`, and to 5 % on other meshes;
#           0.5MPa 1MPa 1.5MPa 2.5MPa 4MPa ucs isotropic brazilian: at the paper's size; 1MPa_2 is that of seed 2;
#           Z4_1MPa Z4_ucs: the same of a rock with a coordination of 4;
#           table: at S = 8 all of table_base, table_friction_0, table_friction_0.5, table_ends_fixed,
#           table_spherical_seat, table_carried, table_stiffness_0.7, table_stiffness_2; default: small
# Environment: RANKS, default 2; S, of the tests at the paper's size, default 5 (8: a quarter of the particles and a
# seventh of the time); STRAIN, of their shearing, default "20 %"; SET, one more setting of all runs, such as
# "Loading/wave stress=60 kPa".
set -euo pipefail
. "$(dirname "$0")/last_words.sh"
[ $# -ge 2 ] || { sed -n '2,15s/^# \{0,1\}//p' "$0" >&2; exit 1; }
cases=$(cd "$(dirname "$0")/../../apps/cases" && pwd)
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- small
# As root Open MPI asks for these two.
[ "$(id -u)" -ne 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1

# run JOB NAME CASE SETTING...: run it, or go on with it where it stopped
run() {
  local job=$1 name=$2 case=$3 settings=() setting
  shift 3
  for setting in "$@" ${SET:+"$SET"}; do settings+=(--set "$setting"); done
  [ ! -s "$name/summary.json" ] || return 0
  if compgen -G "$name/checkpoint_*.h5" >/dev/null; then
    mpirun -n "${RANKS:-2}" "$mergel" "$job" --restart "$name" >>"$name.log" 2>&1
  else
    mpirun -n "${RANKS:-2}" "$mergel" "$job" "$cases/$case.prm" "${settings[@]}" --output "$name" >"$name.log" 2>&1
  fi || echo "$name: $(last_words "$name.log")"
}

# specimen SEED S [Z]: print its file; made if it does not exist
specimen() {
  local name=specimen_$1_S$2${3:+_Z$3}
  [ -s "$name/sample.h5" ] ||
    mpirun -n "${RANKS:-2}" "$mergel" sample "$cases/triaxial_1MPa.prm" --set "Specimen/seed=$1" \
      --set "Specimen/upscaling ratio=$2" ${3:+--set "Specimen/coordination=$3"} --output "$name" >"$name.log" 2>&1
  echo "$PWD/$name/sample.h5"
}

# node_distance S: as far apart as the nodes of the membrane may be, which is the diameter of the smallest particle
node_distance() { awk -v S="$1" 'BEGIN { print 0.066 * S " mm" }'; }

# of_the_paper NAME CASE SEED [SETTING...]: a test of 12 x 24 mm; a name that begins with Z4_ has a coordination of 4
of_the_paper() {
  local name=$1 case=$2 seed=$3 Z=
  shift 3
  [[ $name != Z4_* ]] || Z=4
  [[ $case = ucs ]] || set -- "Membrane/node distance=$(node_distance "${S:-5}")" "$@"
  run triaxial "$name" "$case" "Specimen/upscaling ratio=${S:-5}" ${Z:+"Specimen/coordination=$Z"} \
    "Specimen/seed=$seed" "Specimen/file=$(specimen "$seed" "${S:-5}" $Z)" "$@"
}

# One thing at a time at S = 8, at 1 MPa to 10 %.
table_of() {
  local change=()
  case $1 in
    base) ;;
    friction_*) change=("Platens/friction=${1#friction_}") ;;
    ends_fixed) change=("Membrane/ends=fixed") ;;
    spherical_seat) change=("Platens/top=spherical seat") ;;
    carried) change=("Membrane/compression=carried") ;;
    # E t over the largest cell pressure times d50; the default is 1.
    stiffness_*) change=("Membrane/Young's modulus=$(awk -v n="${1#stiffness_}" 'BEGIN { print 3.042 * n }') MPa") ;;
    *) echo "table_$1: unknown" >&2; exit 1 ;;
  esac
  run triaxial "table_$1" triaxial_1MPa "Specimen/upscaling ratio=8" "Specimen/file=$(specimen 1 8)" \
    "Membrane/node distance=$(node_distance 8)" "Loading/stage 2=triaxial to axial strain = 10 %" "${change[@]}"
}
table="base friction_0 friction_0.5 ends_fixed spherical_seat carried stiffness_0.7 stiffness_2"

for name in "$@"; do
  seed=1
  [[ $name != *_[0-9] ]] || seed=${name##*_}
  case $name in
    small) run triaxial small triaxial_small ;;
    mesh_*) run triaxial "$name" triaxial_small "Membrane/node distance=${name#mesh_} mm" "Loading/stage 2=triaxial to axial strain = 5 %" ;;
    table) for one in $table; do table_of "$one"; done ;;
    table_*) table_of "${name#table_}" ;;
    brazilian*) run brazilian "$name" brazilian "Specimen/seed=$seed" "Specimen/upscaling ratio=${S:-5}" ;;
    ucs* | Z4_ucs*) of_the_paper "$name" ucs "$seed" ;;
    isotropic*) of_the_paper "$name" triaxial_isotropic "$seed" ;;
    *MPa*)
      pressure=${name#Z4_}
      of_the_paper "$name" "triaxial_${pressure%_[0-9]}" "$seed" "Loading/stage 2=triaxial to axial strain = ${STRAIN:-20 %}" ;;
    *) echo "$name: unknown" >&2; exit 1 ;;
  esac
done

# The last line of a history, and the largest q, by the names of the columns.
row() {
  awk -F, -v name="$1" '
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
    { if ($at["q [Pa]"] > q) { q = $at["q [Pa]"]; strain = $at["axial strain [-]"] }
      e = $at["energy error [-]"]; e = e < 0 ? -e : e; if (e > error) error = e }
    END { printf "%s,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g,%.4g\n", name, q / 1e6, 100 * strain,
          100 * $at["axial strain [-]"], $at["q [Pa]"] / 1e6, 100 * $at["volumetric strain of the middle third [-]"],
          100 * $at["membrane penetration [-]"],
          ($at["cell pressure [Pa]"] > 0 ? $at["pressure on the particles [Pa]"] / $at["cell pressure [Pa]"] : 0),
          $at["lateral stress of the middle third [Pa]"] / 1e6, $at["axial stress of the middle third [Pa]"] / 1e6,
          error }' "$1/history.csv"
}
{
  echo "test,largest q [MPa],at strain [%],last strain [%],last q [MPa],last volumetric strain [%],penetration [%],pressure delivered [-],lateral stress of the middle third [MPa],axial stress of the middle third [MPa],largest energy error [-]"
  for name in small mesh_* table_* *ucs* isotropic* *MPa*; do
    [ ! -s "$name/history.csv" ] || row "$name"
  done
} >membrane.csv
column -s, -t membrane.csv
