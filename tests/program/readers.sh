#!/usr/bin/env bash
# Small runs of all jobs, read by other programs than mergel: Python's json, numpy, VTK and h5py open every file of every
# series, table, summary and HDF5 file. Names and units are those of apps/run/names.md, in both directions (readers.py).
#
# usage: tests/program/readers.sh MERGEL
. "$(dirname "$0")/preamble.sh"
for python in python3 /usr/bin/python3 ''; do # a user's own Python need not have Debian's packages
  [ -z "$python" ] && fail "the readers are not installed (Debian: python3-vtk9 python3-h5py python3-numpy): $(tail -1 log)"
  "$python" -c 'import h5py, numpy, vtkmodules.vtkIOXML' 2>log && break
done
read_with() { bounded "$python" -B "$root/tests/program/readers.py" "$@" "${jobs[@]}"; } # ROOT
cases=$root/apps/cases
# JOB CASE [options]
run() {
  local job=$1 case=$2
  shift 2
  bounded "$mergel" "$job" "$cases/$case" "$@" --output "$job" >"$job.log" 2>&1 || fail "$job: $(tail -5 "$job.log")"
}
varied=(--set "Strength variability/distribution=Weibull" --set "Strength variability/coefficient of variation=0.3")
cell=(--set "Specimen/edge x=3.9 mm" --set "Specimen/edge y=3.9 mm" --set "Specimen/edge z=3.9 mm")
stages=(--set "Loading/stage 3=" --set "Loading/stage 4=")

run bond bond_fig4a_tension.prm
run sample element_small.prm "${cell[@]}" --set "Specimen/packing=confined" --set "Specimen/target pressure=100 kPa"
run element element_small.prm "${cell[@]}" "${varied[@]}" --set "Loading/stage 1=isotropic to p = 0.4 MPa" \
  --set "Loading/stage 2=triaxial at 0.4 MPa to axial strain = 0.2 %" \
  --set "Loading/stage 3=unload-reload to q = 0.5 MPa, 2 times" --set "Loading/stage 4="
grep -q '"number": "3b of cycle 2"' element/summary.json || fail "the cycles of the element test: $(cat element/summary.json)"
run triaxial triaxial_small.prm --set "Specimen/diameter=3.6 mm" --set "Specimen/height=5 mm" "${stages[@]}" \
  --set "Loading/stage 1=isotropic to p = 0.2 MPa" --set "Loading/stage 2=triaxial at 0.2 MPa to axial strain = 0.05 %" \
  --set "Membrane/density=20000 kg/m3" --set "Output/localisation every=1e-4"
run brazilian brazilian_small.prm --set "Specimen/diameter=4.5 mm" --set "Specimen/height=2.4 mm" --set "Loading/velocity=50 mm/s"
run pile pile_small.prm "${tiny[@]}" --set "Pile/cone angle=120 degree" --set "Pile/final depth=2.3 mm" --set "Output/frames=3"

jobs=(bond sample element triaxial brazilian pile)
read_with "$root" || fail "the readers"

# The readers see what is wrong: a value that is no number, a series that names a file that is not there, a name that the
# page does not have, and one that no run has.
# WHAT [ROOT]
broken() {
  local what=$1
  ! read_with "${2:-$root}" >log 2>&1 && grep -q -- "$what" log || fail "not seen: $what: $(cat log)"
}
cp element/summary.json kept.json
sed -i 's/"p at the end \[Pa\]": [^,]*/"p at the end [Pa]": NaN/' element/summary.json
broken 'element/summary.json: NaN is no JSON'
sed 's/"p at the end \[Pa\]"/"p somewhere [Pa]"/' kept.json >element/summary.json
broken 'element/summary.json: "p somewhere \[Pa\]" is not on the page'
broken 'summary.json of element, triaxial: no run of element has `p at the end`'
cp kept.json element/summary.json
mv pile/fields/contacts_0001.vtp kept.vtp
broken 'pile/contacts.pvd names fields/contacts_0001.vtp, which is not there'
head -c 4000 kept.vtp >pile/fields/contacts_0001.vtp
broken 'pile/fields/contacts_0001.vtp: '
mv kept.vtp pile/fields/contacts_0001.vtp
mkdir -p page/apps/run
sed 's/^| `void ratio`, `porosity` | - | by sphere/| `void ratio`, `porosity` | m | by sphere/' "$root/apps/run/names.md" >page/apps/run/names.md
broken 'element/history.csv: "porosity \[-\]" is not on the page with this unit' "$PWD/page"
echo "readers: all checks hold"
