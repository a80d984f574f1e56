#!/usr/bin/env bash
# What the resistance of a small pile (`pile_small.prm`) depends on: scatter of realisations, and one thing at a
# time. The tables of tests/validation/README.md. A run takes about a minute of one core, unless said otherwise.
#
# usage: tests/validation/installation.sh MERGEL FOLDER [NAME...]
#   FOLDER  takes the runs and the table installation.csv; what is there is not run again, what was stopped goes on
#   NAME    VARIANT_SEED or a group of them:
#           scatter    base_1 to base_5, and step_1 to step_5: seed 1 with a step up to 1 % smaller
#           scatter_2, scatter_1.5   the same with S = 2 and 1.5 around the pile: D_p/d50 6.8 and 9 (3, 8 minutes)
#           single     three seeds of each variant below; default: scatter single
#   VARIANT base, velocity_0.5 velocity_0.25 (of the penetration rate; 2 and 4 minutes), damping_0.3 damping_0.1,
#           mass_1.26 mass_1.5 mass_2.27, inertia_2, chamber_0.7 region_0.75 (of the diameters), frictional
#           (interface), rigid (far field), conjugate (bending flow), full (model; 2 minutes)
# Environment: JOBS, runs at a time, default 1; SET, one more setting of all runs.
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,17s/^# \{0,1\}//p' "$0" >&2; exit 1; }
small=$(cd "$(dirname "$0")/../../apps/cases" && pwd)/pile_small.prm
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- scatter single
variants="base velocity_0.5 velocity_0.25 damping_0.3 damping_0.1 mass_1.26 mass_1.5 mass_2.27 inertia_2 chamber_0.7 region_0.75 frictional rigid conjugate full"

# scaled FACTOR VALUE UNIT
scaled() { awk -v f="$1" -v x="$2" -v u="$3" 'BEGIN { print f * x " " u }'; }

# run NAME: a variant and its seed, after the inner upscaling if it is not 3
run() {
  local name=$1 variant=${1%_*} seed=${1##*_} case=$small change=() setting settings=()
  [ ! -s "$name/summary.json" ] || return 0
  case $variant in
    S*) change=("Specimen/inner upscaling=${variant%%_*}"); change[0]=${change[0]/=S/=}; variant=${variant#*_} ;;
  esac
  case $variant in
    base) ;;
    # Realisations of one packing: steps that differ by less than 1 % part after the first breaks.
    step) change+=("Motion/time step safety=$(scaled "$seed" -0.0015 "" | awk '{ print 0.9 + $1 }')"); seed=1 ;;
    velocity_*) change+=("Pile/penetration rate=$(scaled "${variant#*_}" 1.35 m/s)") ;;
    damping_*) change+=("Motion/damping=${variant#*_}") ;;
    mass_*) change+=("Motion/mass scaling=${variant#*_}" "Motion/mass scaling limit=1") ;;
    inertia_*) change+=("Motion/inertia factor=${variant#*_}") ;;
    chamber_*) change+=("Far field/chamber diameter=$(scaled "${variant#*_}" 25 mm)" "Far field/chamber height=$(scaled "${variant#*_}" 40 mm)") ;;
    region_*) change+=("Specimen/diameter=$(scaled "${variant#*_}" 10 mm)" "Specimen/height=$(scaled "${variant#*_}" 12 mm)"
      "Specimen/outer radius=$(scaled "${variant#*_}" 5 mm)" "Far field/collar height=2 mm") ;;
    frictional) change+=("Far field/interface=frictional") ;;
    rigid)
      case=rigid.prm
      sed "/^subsection Far field/,/^end/{/Young's modulus/d; /Poisson ratio/d; /K0/d}" "$small" >rigid.prm
      change+=("Far field/model=rigid") ;;
    conjugate) change+=("Bond/bending flow=conjugate") ;;
    full)
      case=full.prm
      sed '/set symmetry/d' "$small" >full.prm
      change+=("Specimen/shape=cylinder") ;;
    *) echo "$name: unknown" >&2; return 1 ;;
  esac
  for setting in "${change[@]}" "Specimen/seed=$seed" "Output/frames=1" ${SET:+"$SET"}; do settings+=(--set "$setting"); done
  if compgen -G "$name/checkpoint_*.h5" >/dev/null; then
    "$mergel" pile --restart "$name" >>"$name.log" 2>&1
  else
    "$mergel" pile "$case" "${settings[@]}" --output "$name" >"$name.log" 2>&1
  fi || echo "$name: $(tail -1 "$name.log")"
}

scatter() { for k in 1 2 3 4 5; do echo "$1base_$k"; done; for k in 1 2 3 4 5; do echo "$1step_$k"; done; }
names=()
for name in "$@"; do
  case $name in
    scatter) names+=($(scatter "")) ;;
    scatter_*) names+=($(scatter "S${name#*_}_")) ;;
    single) for v in $variants; do names+=("${v}_1" "${v}_2" "${v}_3"); done ;;
    *) names+=("$name") ;;
  esac
done
for name in "${names[@]}"; do
  while [ "$(jobs -rp | wc -l)" -ge "${JOBS:-1}" ]; do wait -n || true; done
  run "$name" &
done
wait

# One line a run, from history.csv by the names of its columns and from summary.json: the mean of q_c from 1 to 2
# diameters, the standard deviation of its means over windows of 0.5 D there, and what the program says of itself.
number() { sed -n "s/^ *\"$2\": \([^,]*\),*\$/\1/p" "$1/summary.json" | head -1; }
{
  echo "run,mean q_c from 1 to 2 D_p [MPa],mean q_c from 0.5 to 2 D_p [MPa],shaft force at the end [N],bonds broken [-],of these within 2 D_p [%],largest energy error [-],steps [-],particles [-]"
  for folder in *_[0-9]; do
    [ -s "$folder/summary.json" ] || continue
    awk -F, -v name="$folder" -v broken="$(number "$folder" 'broken between particles \[-\]')" \
      -v near="$(number "$folder" 'broken within 2 D_p of the axis \[-\]')" -v error="$(number "$folder" 'largest energy error \[-\]')" \
      -v steps="$(number "$folder" 'steps \[-\]')" -v n="$(number "$folder" 'particles \[-\]')" '
      NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
      { d = $at["depth/D_p [-]"]; q = $at["q_c [Pa]"] / 1e6; shaft = $at["shaft force of the full pile [N]"] }
      d >= 1 && d <= 2 { late += q; ++n_late }
      d >= 0.5 && d <= 2 { all += q; ++n_all }
      END { printf "%s,%.4g,%.4g,%.4g,%d,%.4g,%.2g,%d,%d\n", name, late / n_late, all / n_all, shaft, broken,
            100 * near / broken, error, steps, n }' "$folder/history.csv"
  done
} >installation.csv
# By variant: number of runs, mean and standard error of q_c from 0.5 to 2 D_p and of the broken bonds.
awk -F, 'NR > 1 { v = $1; sub(/_[0-9]$/, "", v); if (!(v in n)) order[++m] = v; ++n[v]
    q[v] += $3; q2[v] += $3 * $3; b[v] += $5; b2[v] += $5 * $5; s[v] += $8; if ($7 > e[v]) e[v] = $7 }
  function error(sum, sum2, n) { return n > 1 ? sqrt((sum2 / n - (sum / n) ^ 2 > 0 ? sum2 / n - (sum / n) ^ 2 : 0) / (n - 1)) : 0 }
  END { print "variant,runs,mean q_c from 0.5 to 2 D_p [MPa],standard error [MPa],bonds broken [-],standard error [-],steps [-],largest energy error [-]"
    for (k = 1; k <= m; ++k) { v = order[k]
      printf "%s,%d,%.4g,%.2g,%.0f,%.0f,%.0f,%.2g\n", v, n[v], q[v] / n[v], error(q[v], q2[v], n[v]), b[v] / n[v],
        error(b[v], b2[v], n[v]), s[v] / n[v], e[v] } }' installation.csv >variants.csv
column -s, -t variants.csv
