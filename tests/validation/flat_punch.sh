#!/usr/bin/env bash
# A rigid flat punch on unbreakable bonded rock: the stiffness dF/dw at D_p/d50 = 6, 9 and 13, extrapolated in
# d50/D_p to no grain size, against that of an elastic layer of depth H on a rigid base,
#
#   dF/dw = 2 E a/(1 - nu^2) (1 + 1.28 a/H)
#
# E and nu are those of the same rock in a periodic cell. About twenty minutes on one core for a seed.
#
# usage: tests/validation/flat_punch.sh MERGEL [SEED...]
. "$(dirname "$0")/../program/preamble.sh"
shift
seeds=${*:-1}
here=$root/tests/validation
radius=0.7e-3 depth=28e-3 # a and H of flat_punch.prm [m]
d50=0.11406               # by mass, of diameters uniform in number between 0.066 and 0.1337 mm [mm]

found() { awk -F': ' -v key="\"$2\"" 'index($0, key) { sub(/,$/, "", $2); print $2; exit }' "$1"; }

# The moduli: uniaxial compression of a periodic cell, secant from 0.01 to 0.1 %, mean of three packings.
for seed in 1 2 3; do
  "$mergel" element "$root/apps/cases/element_rock.prm" --set "Specimen/seed=$seed" \
    --set "Bond/tensile strength=1e6 GPa" --set "Bond/compressive strength=1e6 GPa" \
    --set "Bond/shear strength=1e6 GPa" --set "Loading/stage 1=compression to axial strain = 0.12 %" \
    --output "cell_$seed" >cell.log || { cat cell.log; exit 1; }
  echo "$(found "cell_$seed/summary.json" "Young's modulus [Pa]") $(found "cell_$seed/summary.json" "Poisson's ratio [-]")"
done >moduli
read -r E nu < <(awk '{ E += $1; nu += $2 } END { print E / NR, nu / NR }' moduli)
echo "rock: E = $E Pa, nu = $nu"

# stiffness FOLDER: dF/dw of the full punch [N/m], least squares over the second half of the travel.
stiffness()
{
  awk -F, 'NR > 1 { w[NR] = $2; F[NR] = $5; last = $2 }
    END { for (k in w) if (w[k] > 0.5 * last) { n++; x += w[k]; y += F[k]; xx += w[k]^2; xy += w[k] * F[k] }
          print (xy - x * y / n) / (xx - x * x / n) }' "$1/history.csv"
}

echo "D_p/d50,seed,particles,dF/dw [N/m],over the closed form [-]" | tee table.csv
exact=$(awk "BEGIN { print 2 * $E * $radius / (1 - $nu ^ 2) * (1 + 1.28 * $radius / $depth) }")
for ratio in 6 9 13; do
  S=$(awk "BEGIN { printf \"%.4f\", 1.4 / ($ratio * $d50) }")
  for seed in $seeds; do
    out=punch_${ratio}_$seed
    "$mergel" pile "$here/flat_punch.prm" --set "Specimen/inner upscaling=$S" --set "Specimen/outer upscaling=$S" \
      --set "Specimen/seed=$seed" --set "Far field/Young's modulus=$E Pa" --set "Far field/Poisson ratio=$nu" \
      --output "$out" >"$out.log" || { tail -3 "$out.log"; exit 1; }
    k=$(stiffness "$out")
    awk "BEGIN { printf \"%d,%d,%d,%.5g,%.4f\n\", $ratio, $seed, $(found "$out/summary.json" "particles [-]"), $k, $k / $exact }"
  done
done | tee -a table.csv

# The straight line over d50/D_p, at 0.
awk -F, 'NR > 1 { n++; a = 1 / $1; x += a; y += $5; xx += a * a; xy += a * $5 }
  END { b = (n * xy - x * y) / (n * xx - x * x); at_0 = (y - b * x) / n
        printf "extrapolated: %.3f of the closed form\n", at_0; exit !(at_0 > 0.9 && at_0 < 1.1) }' table.csv \
  && echo "holds   the stiffness of a flat punch, to 10 %" || { echo "FAILED  the stiffness of a flat punch"; exit 1; }
