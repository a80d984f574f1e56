#!/usr/bin/env bash
# Particles without bonds, `Specimen/coordination` = 0, in every job that makes a specimen: a sample, a periodic
# cell and a cylinder in a membrane that are sheared. What cannot be done without bonds is refused.
#
# usage: tests/program/granular.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
sand=$root/apps/cases/triaxial_granular.prm
tiny=(--set "Specimen/diameter=3 mm" --set "Specimen/height=4 mm" --set "Specimen/porosity=0.4" --set "Loading/stage 2=triaxial to axial strain = 1 %")

# A cylinder: its specimen, then the test that reads it.
bounded "$mergel" sample "$sand" "${tiny[@]}" --output rock >rock.log 2>&1 || fail "the specimen: $(cat rock.log)"
grep -q 'granular, without bonds' rock.log || fail "that there are no bonds is not said: $(cat rock.log)"
[ "$(value rock "bonds [-]")" -eq 0 ] && [ "$(value rock "coordination Z")" -eq 0 ] || fail "bonds in $(cat rock/summary.json)"
within rock "porosity [-]" 0.395 0.405
within rock "pressure [Pa]" 40e3 60e3
bounded "$mergel" info rock >info || fail "info of the specimen: $(cat info)"
bounded "$mergel" triaxial "$sand" "${tiny[@]}" --set "Specimen/file=rock/sample.h5" --output a >a.log 2>&1 || fail "triaxial: $(tail -5 a.log)"
bounded "$mergel" info a >info && grep -q finished info || fail "info of the test: $(cat info)"
[ "$(grep -c '^stage [0-9]*, .*: target reached' a.log)" -eq 2 ] || fail "two stages: $(cat a.log)"
# It begins at rest under the target pressure, with all strains zero. It bears the shear of a sand: at 1 % a
# friction angle of 25 to 45 degrees (five particles across).
records a 'NR == 2 { if (abs(c("cell pressure [Pa]") / 50e3 - 1) > 1e-6 || abs(c("axial stress [Pa]") / 50e3 - 1) > 0.03 ||
      abs(c("volumetric strain of the middle third [-]")) > 1e-9 || c("axial strain [-]") != 0 ||
      abs(c("membrane penetration [-]")) > 1e-9 || c("unbalanced-force ratio [-]") > 0.01) bad = 1 }
  c("stage [-]") == 2 { q = c("q [Pa]"); if (q > largest) { largest = q; p = c("lateral stress [Pa]") } v = c("volumetric strain of the middle third [-]") }
  { e = abs(c("energy error [-]")); if (e > most) most = e; if (c("broken bonds [-]") > 0) bad = 1 }
  END { s = (largest / (largest + 2 * p)); print "sand: largest q " largest " Pa, sin phi " s ", volumetric strain " v ", energy error " most
    exit bad || !(s > 0.42 && s < 0.71 && most < 1e-3) }' || fail "a sand under 100 kPa: $(head -3 a/history.csv)"
# The stress of its middle third is the pressure, but for the rim of five particles across: within a third.
within a "p at the start [Pa]" 33e3 67e3
grep -q '^stress at the start, of the middle third: p 0\.0' a.log || fail "the stress at the start is not said: $(cat a.log)"
# The same bits on two ranks, and from a checkpoint in the middle.
on_ranks 2 "$mergel" triaxial "$sand" "${tiny[@]}" --output b --set "Output/checkpoint every=3000 steps" >b.log 2>&1 || fail "on 2 ranks: $(tail -5 b.log)"
cmp a/history.csv b/history.csv || fail "on two ranks the history differs"
cmp rock/sample.h5 b/sample.h5 || fail "on two ranks the specimen differs"
lines() { cat "$1/history.csv" 2>/dev/null | wc -l; }
has_lines() { [ "$(lines d)" -ge "$1" ]; }
launch "$mergel" triaxial "$sand" "${tiny[@]}" --output d >d.log 2>&1
signal_when TERM has_lines $(($(lines a) / 2))
wait "$launched" && fail "SIGTERM ends with 0"
bounded "$mergel" triaxial --restart d >d.log 2>&1 || fail "the restart: $(tail -5 d.log)"
cmp a/history.csv d/history.csv || fail "after a restart the history differs"
[ "$(value d "p at the start [Pa]")" = "$(value a "p at the start [Pa]")" ] || fail "after a restart the stress at the start differs"

# A periodic cell of the rock of element_small, without its bonds: section Bond may stay.
cell=(--set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" --set "Specimen/edge z=3.9 mm" --set "Specimen/coordination=0"
  --set "Specimen/packing=confined" --set "Specimen/target pressure=100 kPa" --set "Loading/reference pressure=100 kPa")
element() { bounded "$mergel" element "$root/apps/cases/element_small.prm" "${cell[@]}" "$@"; }
element --set "Loading/stage 1=isotropic to p = 0.5 MPa" --set "Loading/stage 3=" --set "Loading/stage 4=" --output e >e.log 2>&1 ||
  fail "element: $(tail -5 e.log)"
grep -q 'granular, without bonds: section Bond has no effect' e.log || fail "what has no effect is not said: $(cat e.log)"
! grep -q 'bonds broken\|bonds begin' e.log a.log || fail "bonds are told of where there are none: $(cat e.log a.log)"
! grep -q 'section Bond' a.log || fail "a section is named that the case does not have: $(cat a.log)"
# Particles that may not spin are twice as strong: that is said, by the job and by check, and only then.
grep -q '^unusual: Motion/free rotation = false; usual without bonds is true' e.log || fail "the rotation constraint is not said: $(cat e.log)"
for spins in false true; do
  "$mergel" check "$sand" --set "Motion/free rotation=$spins" >log 2>&1 || fail "check: $(cat log)"
  [ "$(grep -c 'unusual: Motion/free rotation' log)" -eq "$([ $spins = false ] && echo 1 || echo 0)" ] || fail "free rotation = $spins: $(cat log)"
done
[ "$(grep -c '"outcome": "target reached"' e/summary.json)" -eq 2 ] || fail "two stages: $(cat e.log)"
# It begins under the pressure of its packing, which is said: that of the first record.
within e "p at the start [Pa]" 80e3 120e3
awk -v a="$(value e "p at the start [Pa]")" -v b="$(records e 'NR == 2 { print c("p [Pa]") }')" 'BEGIN { exit !(a > 0.999 * b && a < 1.001 * b) }' ||
  fail "p at the start $(value e "p at the start [Pa]") Pa: $(head -2 e/history.csv)"
grep -q '^stress at the start, of the cell: p 0\.[01]' e.log || fail "the stress at the start is not said: $(cat e.log)"
records e 'NR > 2 && (c("Z of bonds [-]") > 0 || c("Z of contacts [-]") < 3) { bad = 1 }
  c("stage [-]") == 2 { r = c("q [Pa]") / c("p [Pa]") }
  END { print "cell: q/p " r; exit bad || !(r > 0.8 && r < 1.6) }' || fail "the cell without bonds"
! grep -qiE '(^|[,: ])-?(nan|inf)\b|: null' e/history.csv e/summary.json a/history.csv a/summary.json rock/summary.json e.log ||
  fail "a number is not finite"

# Refused, in one line, before anything is written.
# NAME PATTERN JOB CASE SETTING...
refused()
{
  local name=$1 pattern=$2 job=$3 case=$4 options=() setting
  shift 4
  for setting in "$@"; do options+=(--set "$setting"); done
  [ "$(code_of bounded "$mergel" "$job" "$case" --output no "${options[@]}")" -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] &&
    grep -q -- "$pattern" log && [ ! -e no ] || fail "$name: $(cat log)"
}
rock=$root/apps/cases/element_small.prm
refused "no pressure" 'Specimen/coordination = 0: without bonds the particles hold together only under a pressure: set `packing = confined`' \
  element "$rock" "Specimen/coordination=0"
sed '/target pressure/d' "$sand" >x.prm
refused "no pressure of a sample" 'Specimen/coordination = 0: without bonds' sample x.prm "Specimen/packing=unjammed"
without='an axis would be without pressure, and particles without bonds, .*fall apart'
for stage in "compression to axial strain = 1 %" "tension to axial strain = -1 %" "triaxial at 0 MPa to axial strain = 1 %" \
  "isotropic to p = -1 MPa" "axes x = fixed, y = 0 MPa, z = strain-controlled to axial strain = 1 %"; do
  refused "$stage" "stage 1 = .*$without" element "$rock" "Specimen/coordination=0" "Specimen/packing=confined" \
    "Specimen/target pressure=100 kPa" "Loading/stage 1=$stage"
done
refused "unconfined" "stage 1 = .*$without" triaxial "$sand" "Loading/stage 1=compression to axial strain = 1 %" "Loading/stage 2="
refused "no membrane" 'Membrane/membrane = false: .*fall apart unconfined' triaxial "$sand" "Membrane/membrane=false"
refused "a pressure that nobody knows" 'Specimen/packing = expanded: .*set `confined`' triaxial x.prm "Specimen/packing=expanded"
refused "a membrane that bursts at once" "Membrane/Young's modulus = 0.01 MPa: .* would burst" triaxial "$sand" "Membrane/Young's modulus=0.01 MPa"
refused "strengths of bonds" 'Strength variability/distribution = Weibull: there are no bonds' triaxial "$sand" \
  "Strength variability/distribution=Weibull" "Strength variability/coefficient of variation=0.3"
refused "a pile" 'Specimen/coordination = 0: the specimen of a pile needs bonds' pile "$case_file" "Specimen/coordination=0"
refused "the specimen of a pile" 'Specimen/coordination = 0: the specimen of a pile needs bonds' sample "$case_file" "Specimen/coordination=0"
# With bonds their keys must be given.
refused "no section Bond" 'Bond/effective modulus: must be given' triaxial "$sand" "Specimen/coordination=5" "Specimen/bond gap=0.1 mm"
refused "no bond gap" 'Specimen/bond gap: must be given' triaxial "$sand" "Specimen/coordination=5"
echo "granular: all checks hold"
