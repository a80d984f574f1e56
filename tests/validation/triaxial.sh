#!/usr/bin/env bash
# The paper's rock in a membrane between platens, beside the same rock in a periodic cell: the table of
# tests/validation/README.md. At the paper's size an hour and more for each test to 20 %.
#
# usage: tests/validation/triaxial.sh MERGEL FOLDER [NAME...]
#   FOLDER  takes the runs and the table triaxial.csv; what is there is not run again
#   NAME    small mesh_0.17 mesh_0.23 mesh_0.33 ucs 0.5MPa 1MPa 1.5MPa 2.5MPa 4MPa; default: small
# Environment: RANKS, default 2; STRAIN, of the shearing at the paper's size, default "20 %"; SET, more
# settings, such as "Loading/wave stress=60 kPa".
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,9s/^# \{0,1\}//p' "$0" >&2; exit 1; }
cases=$(cd "$(dirname "$0")/../../apps/cases" && pwd)
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- small

# test NAME CASE SETTING...: run it, or go on with it where it stopped
test_of() {
  local name=$1 case=$2 settings=() setting
  shift 2
  for setting in "$@" ${SET:+"$SET"}; do settings+=(--set "$setting"); done
  [ ! -s "$name/summary.json" ] || return 0
  if compgen -G "$name/checkpoint_*.h5" >/dev/null; then
    mpirun -n "${RANKS:-2}" "$mergel" triaxial --restart "$name" >>"$name.log" 2>&1
  else
    mpirun -n "${RANKS:-2}" "$mergel" triaxial "$cases/$case.prm" "${settings[@]}" --output "$name" >"$name.log" 2>&1
  fi || echo "$name: $(tail -1 "$name.log")"
}
for name in "$@"; do
  case $name in
    small) test_of small triaxial_small ;;
    mesh_*) test_of "$name" triaxial_small "Membrane/node distance=${name#mesh_} mm" "Loading/stage 2=triaxial to axial strain = 5 %" ;;
    ucs) test_of ucs ucs ;;
    *) test_of "$name" "triaxial_$name" "Loading/stage 2=triaxial to axial strain = ${STRAIN:-20 %}" ;;
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
  for name in small mesh_0.17 mesh_0.23 mesh_0.33 ucs 0.5MPa 1MPa 1.5MPa 2.5MPa 4MPa; do
    [ ! -s "$name/history.csv" ] || row "$name"
  done
} >triaxial.csv
column -s, -t triaxial.csv
