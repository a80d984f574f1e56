#!/usr/bin/env bash
# The pile of the paper at full scale (`pile_paper.prm`), one run a packing, and the findings of the paper's section 3
# as numbers. What is there is not run again, what was stopped goes on from its checkpoint.
#
# usage: tests/validation/pile_paper.sh MERGEL FOLDER [SEED...]     default seed: 1
#   FOLDER  takes seed_1, seed_2, ... and the tables findings.csv (a line a packing), resistance.csv (mean q_c of each
#           diameter of depth) and what it prints: each finding with its mean and standard error over the packings
# Environment: RANKS, default 2; WALLTIME, after which a run stops with a checkpoint, as in 50min; SET, one more
# setting of all runs; UCS [MPa] of the rock, default 4.14 (README.md, first table).
set -euo pipefail
. "$(dirname "$0")/last_words.sh"
[ $# -ge 2 ] || { sed -n '2,11s/^# \{0,1\}//p' "$0" >&2; exit 1; }
case_file=$(cd "$(dirname "$0")/../../apps/cases" && pwd)/pile_paper.prm
mergel=$(readlink -f "$1")
mkdir -p "$2"
cd "$2"
shift 2
[ $# -gt 0 ] || set -- 1
if [ "$(id -u)" -eq 0 ]; then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi

for seed in "$@"; do
  out=seed_$seed
  [ ! -s "$out/summary.json" ] || continue
  stop=(${WALLTIME:+--walltime "$WALLTIME"})
  if compgen -G "$out/checkpoint_*.h5" >/dev/null; then
    mpirun --oversubscribe -n "${RANKS:-2}" "$mergel" pile --restart "$out" "${stop[@]}" >>"$out.log" 2>&1
  else
    mpirun --oversubscribe -n "${RANKS:-2}" "$mergel" pile "$case_file" --set "Specimen/seed=$seed" ${SET:+--set "$SET"} \
      --output "$out" "${stop[@]}" >"$out.log" 2>&1
  fi || { echo "$out: $(last_words "$out.log")" >&2; continue; }
done

# number FOLDER NAME: of summary.json; nothing where it has none.
number() { awk -v name="\"$2\":" 'index($0, name) { sub(/.*: /, ""); sub(/,$/, ""); print; exit }' "$1/summary.json"; }
# of_table FOLDER/TABLE PROGRAM: awk over its lines with c("column")
of_table() {
  awk -F, 'function c(name) { if (!(name in at)) { print "no column " name > "/dev/stderr"; exit 1 } return $at[name] + 0 }
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next } '"$2" "$1"
}

names=("depth/D_p [-]" "mean q_c from 3 D_p on [MPa]" "its scatter over 0.5 D_p [MPa]" "q_c over UCS [-]" "head force at the end [N]"
  "shaft force at the end [N]" "needle penetration index [N/mm]" "UCS by that index [MPa]" "bonds broken between particles [-]"
  "of these below the shoulder within 2 D_p of the tip [%]" "within 2 D_p of the axis [%]" "above the shoulder away from the shaft [%]"
  "porosity at the start [-]" "porosity below the tip [-]" "porosity beside the shaft [-]" "thinning of the diameter below the tip [%]"
  "angle of the major principal stress above the shoulder [degree]" "at the shoulder [degree]" "below the tip [degree]"
  "largest tension [MPa]" "its distance from the axis [D_p]" "its height above the tip [D_p]"
  "exponent of the shaft stress over h/R [-]" "its standard error [-]" "exponent by Chalk ICP-18 [-]"
  "crushed annulus [D_p]" "crushed annulus [d50]" "largest overlap [-]" "largest energy error [-]" "steps [-]" "particles [-]")
line_of() { # FOLDER
  local d=$1 q
  # The scatter is the standard deviation of the means over 0.5 D_p.
  q=$(of_table "$d/history.csv" '{ d = c("depth/D_p [-]") } d >= 3 { k = int(2 * d); s[k] += c("q_c [Pa]") / 1e6; ++n[k]; all += c("q_c [Pa]") / 1e6; ++m }
    END { for (k in s) if (n[k] > 5) { x = s[k] / n[k]; a += x; b += x * x; ++l }
      printf "%s,%s\n", (m ? all / m : "nan"), (l > 1 ? sqrt((b - a * a / l) / (l - 1)) : "nan") }')
  local broken; broken=$(number "$d" "broken between particles [-]")
  of_share() { awk -v a="$(number "$d" "$1")" -v b="$broken" 'BEGIN { print (b > 0 ? 100 * a / b : 0) }'; }
  scaled() { awk -v a="$(number "$d" "$1")" -v f="$2" 'BEGIN { if (a == "") print ""; else print f * a }'; }
  local values=("$(of_table "$d/history.csv" '{ d = c("depth/D_p [-]") } END { print d }')" "$q"
    "$(awk -v q="${q%%,*}" -v u="${UCS:-4.14}" 'BEGIN { print q / u }')" "$(scaled "head force of the full pile [N]" 1)"
    "$(scaled "shaft force of the full pile [N]" 1)" "$(scaled "needle penetration index [N/mm]" 1)"
    "$(scaled "UCS by the needle penetration index, from memory [Pa]" 1e-6)" "$broken"
    "$(of_share "broken below the shoulder within 2 D_p of the tip [-]")" "$(of_share "broken within 2 D_p of the axis [-]")"
    "$(of_share "broken above the shoulder away from the shaft [-]")"
    "$(of_table "$d/tip_profile.csv" 'c("time [s]") == 0 { s += c("porosity [-]"); ++n } END { print s / n }')"
    "$(scaled "porosity below the tip [-]" 1)" "$(scaled "porosity beside the shaft [-]" 1)"
    "$(scaled "thinning of the diameter below the tip [-]" 100)"
    "$(scaled "angle of the major principal stress to the vertical above the shoulder [degree]" 1)"
    "$(scaled "angle of the major principal stress to the vertical at the shoulder [degree]" 1)"
    "$(scaled "angle of the major principal stress to the vertical below the tip [degree]" 1)"
    "$(scaled "largest tension [Pa]" 1e-6)" "$(scaled "its distance from the axis over D_p [-]" 1)"
    "$(scaled "its height above the tip over D_p [-]" 1)" "$(scaled "exponent of the radial stress over h/R [-]" 1)"
    "$(scaled "standard error of that exponent [-]" 1)" "$(scaled "exponent by Chalk ICP-18 [-]" 1)"
    "$(scaled "annulus of damage above 0.5 over D_p [-]" 1)" "$(scaled "annulus of damage above 0.5 over d50 [-]" 1)"
    "$(number "$d" "largest overlap [-]")" "$(number "$d" "largest energy error [-]")" "$(number "$d" "steps [-]")"
    "$(number "$d" "particles [-]")")
  (IFS=,; echo "$d,${values[*]}")
}
(IFS=,; echo "run,${names[*]}") >findings.csv
echo "run,depth from [D_p],to [D_p],mean q_c [MPa],shaft force [N]" >resistance.csv
for d in seed_*/; do
  d=${d%/}
  [ -s "$d/summary.json" ] || continue
  line_of "$d" >>findings.csv
  of_table "$d/history.csv" '{ d = c("depth/D_p [-]") } d >= 0 { k = int(d); q[k] += c("q_c [Pa]") / 1e6; f[k] += c("shaft force of the full pile [N]"); ++n[k]; if (k > most) most = k }
    END { for (k = 0; k <= most; ++k) if (n[k] > 10) printf "'"$d"',%d,%d,%.4g,%.4g\n", k, k + 1, q[k] / n[k], f[k] / n[k] }' >>resistance.csv
done
# Each finding: mean, standard error, number of packings.
awk -F, 'NR == 1 { n = NF; for (k = 2; k <= NF; ++k) name[k] = $k; next }
  { for (k = 2; k <= n; ++k) if ($k != "" && $k != "nan") { s[k] += $k; s2[k] += $k * $k; ++m[k] } }
  END { printf "%-66s %12s %12s %s\n", "finding", "mean", "error", "packings"
    for (k = 2; k <= n; ++k) if (m[k]) { a = s[k] / m[k]; v = s2[k] / m[k] - a * a
      printf "%-66s %12.4g %12s %d\n", name[k], a, (m[k] > 1 ? sprintf("%.2g", sqrt((v > 0 ? v : 0) / (m[k] - 1))) : "-"), m[k] } }' findings.csv
