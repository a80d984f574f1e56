# Sourced by the tests of what reads several runs: writes results folders of tests with known answers.

# FOLDER SIGMA_3 SEED PEAK END: 1 MPa is 1. Isotropic to sigma_3, then sheared: q to PEAK at 0.4 % of axial strain,
# to END at 2 %, constant up to 20 %. The void ratio at the end is on 1.3 - 0.0114 (p/p_a)^0.7.
lab_run() {
  mkdir -p "$1"
  awk -v s="$2" -v peak="$4" -v end="$5" 'BEGIN {
    OFS = ","
    print "time [s],stage [-],axial strain [-],volumetric strain [-],axial strain of the stage [-],volumetric strain of the stage [-],p [Pa],q [Pa],void ratio [-]"
    print 0, 1, 0, 0, 0, 0, 0, 0, 1.08
    print 1e-3, 1, 1e-3, 3e-3, 1e-3, 3e-3, s * 1e6, 0, 1.08
    e_end = 1.3 - 0.0114 * ((s + end / 3) * 1e6 / 101325) ^ 0.7
    for (k = 0; k <= 200; ++k) {
      a = 1e-3 * k
      q = a <= 0.004 ? peak * a / 0.004 : a >= 0.02 ? end : peak + (end - peak) * (a - 0.004) / 0.016
      v = -0.1 * a
      printf "%.12g,2,%.15g,%.15g,%.15g,%.15g,%.12g,%.12g,%.12g\n", 2e-3 + 1e-5 * k, 1 - 0.999 * (1 - a), 1 - 0.997 * (1 - v), a, v,
        (s + q / 3) * 1e6, q * 1e6, a < 0.1 ? 1.08 + (e_end - 1.08) * a / 0.1 : e_end
    }
  }' >"$1/history.csv"
  cat >"$1/resolved.prm" <<CASE
subsection Specimen
  set seed = $3
end
subsection Loading
  set stage 1 = isotropic to p = $2 MPa
  set stage 2 = triaxial to axial strain = 20 %
end
CASE
  cat >"$1/summary.json" <<JSON
{
  "stages": [
    {
      "stage": "isotropic to p = $2 MPa"
    },
    {
      "stage": "triaxial to axial strain = 20 %",
      "Young's modulus [Pa]": 1.1e9,
      "q at yield [Pa]": 1e6,
      "strain at yield [-]": 0.003
    }
  ],
  "p at the end [Pa]": 1e6
}
JSON
}

# Peaks on c = 1 MPa and phi = 30 degrees: q = 2 sqrt(3) + 2 sigma_3. Ends on q = 2.5 sigma_3, phi = 33.75 degrees.
peak_at() { awk -v s="$1" 'BEGIN { print 2 * sqrt(3) + 2 * s }'; }
exact_run() { lab_run "$1" "$2" "$3" "$(peak_at "$2")" "$(awk -v s="$2" 'BEGIN { print 2.5 * s }')"; }
