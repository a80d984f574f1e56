#!/usr/bin/env bash
# What a triaxial cell cannot do gets one line that says what is wrong, exit code 1, and leaves the disk as it
# was. What goes wrong in a run ends it with exit code 2 and keeps its data.
#
# usage: tests/program/triaxial_bad_input.sh MERGEL
# Prints one line for each check that fails, then a count; exit code 1 if any failed.
. "$(dirname "$0")/preamble.sh"
case_file=$root/apps/cases/triaxial_small.prm good_job=triaxial
. "$root/tests/program/refusals.sh"
place='((good\.prm(:[0-9]+)?: )|--set )'

## specimen
kept='the contacts of such a specimen keep their pressure, and nothing confines it in this test: '
refuse_set "an unconfined specimen that bursts" "--set Specimen/packing = expanded: ${kept}.*Use .unjammed." \
  "Specimen/packing=expanded" "Membrane/membrane=false" "Loading/stage 1=compression to axial strain = 1 %" "Loading/stage 2="
refuse_set "a stage without pressure that bursts it in the membrane" "--set Specimen/packing = expanded: ${kept}.*" \
  "Specimen/packing=expanded" "Loading/stage 1=compression to axial strain = 1 %" "Loading/stage 2="

## membrane
refuse_set "a mesh through which particles slip" \
  '--set Membrane/node distance = 0\.5 mm: particles would slip through .* at most the diameter of the smallest, 0\.33 mm' \
  "Membrane/node distance=0.5 mm"
refuse_set "a mesh too fine" '--set Membrane/node distance = 0\.0001 mm: the mesh would have more than a million nodes.*' \
  "Membrane/node distance=0.0001 mm"
# d50 is 0.114 mm at S = 1: E t = 1 MPa 0.57 mm.
refuse_set "a membrane that the pores burst" \
  "--set Membrane/Young's modulus = 1 MPa: the pores of the surface.* would burst the membrane at 1 MPa: .* which is E = 1\.90[0-9]* MPa at this thickness" \
  "Membrane/Young's modulus=1 MPa"
refuse_set "a membrane that the pores burst in a later stage" "--set Membrane/Young's modulus = 2 MPa: .* at 5 MPa: .*" \
  "Membrane/Young's modulus=2 MPa" "Loading/stage 3=triaxial at 5 MPa to axial strain = 3 %"
refuse_set "no thickness" '--set Membrane/thickness = 0 mm: must satisfy value > 0.*' "Membrane/thickness=0 mm"
refuse_set "unknown ends" '--set Membrane/ends = fixd: must be one of free \| fixed\. Did you mean "fixed"\?' "Membrane/ends=fixd"
refuse_set "unknown compression" '--set Membrane/compression = carries: must be one of wrinkles \| carried\..*' "Membrane/compression=carries"
refuse_set "no subcycle" '--set Membrane/largest subcycle = 0: must satisfy .*' "Membrane/largest subcycle=0"
refuse_set "a key of the membrane without one" '--set Membrane/thickness = 0\.2 mm: is a key of `membrane` = true; .*' \
  "Membrane/membrane=false" "Membrane/thickness=0.2 mm"

## loading stages; those of the good case go on at the second
stage() { refuse_set "$1" "--set Loading/stage 1 = .*: $2" "Loading/stage 1=$3" "Loading/stage 2=" "${@:4}"; } # NAME PATTERN STAGE [SETTING...]
cell='a triaxial cell does `isotropic`, .*; other paths are those of `mergel element`\. .*'
stage "oedometer" "$cell" "oedometer to axial strain = 1 %"
stage "axes" "$cell" "axes x = fixed, y = fixed, z = strain-controlled to axial strain = 1 %"
stage "tension" "$cell" "tension to axial strain = -1 %"
stage "radial" "$cell" "radial dq/dp = 3 to q = 1 MPa"
stage "a negative cell pressure" 'the cell pressure must not be negative' "triaxial at -1 MPa to axial strain = 1 %"
stage "a negative pressure" 'the target must be positive: a membrane cannot pull' "isotropic to p = -1 MPa"
stage "no pressure" 'the target must be positive: a membrane cannot pull' "isotropic to p = 0 MPa"
stage "nothing to resume" 'there is no stage before to resume' "resume to axial strain = 1 %"
stage "extension without a cell pressure" 'the platens do not pull: .*' "triaxial to axial strain = -1 %"
stage "a cell pressure without a membrane" 'a cell pressure needs a membrane: .*' "isotropic to p = 1 MPa" "Membrane/membrane=false"
stage "a lateral stress without a membrane" 'a cell pressure needs a membrane: .*' "triaxial at 1 MPa to axial strain = 1 %" \
  "Membrane/membrane=false"
refuse_set "the good case without a membrane" "${place}Loading/stage 1 = isotropic to p = 1 MPa: a cell pressure needs a membrane: .*" \
  "Membrane/membrane=false"
refuse_set "extension after the cell pressure is gone" '--set Loading/stage 3 = .*: the platens do not pull: .*' \
  "Loading/stage 2=triaxial at 0 MPa to axial strain = 0.1 %" "Loading/stage 3=triaxial to axial strain = -1 %"
refuse_set "no stage" '--set Loading/stage 1 = : must not be empty\. .*' "Loading/stage 1="
refuse_set "a strain limit beyond all strains" '--set Loading/strain limit = 0\.95: must satisfy .*' "Loading/strain limit=0.95"

## platens, analysis, output
refuse_set "a mass of a level platen" '--set Platens/mass = 1 g: is a key of `top` = spherical seat; .*' "Platens/mass=1 g"
refuse_set "unknown seat" '--set Platens/top = free: must be one of fixed \| spherical seat\. .*' "Platens/top=free"
refuse_set "a secant without a length" '--set Analysis/secant to = 1e-5: must be beyond `secant from`' "Analysis/secant to=1e-5"
refuse_set "an interval without pictures" '--set Output/picture every = 0\.01: is a key of `pictures` = strain; .*' "Output/picture every=0.01"

## specimen
refuse_set "half a cylinder" '--set Specimen/shape = half cylinder: a triaxial test needs a `cylinder`' "Specimen/shape=half cylinder"
sed -E '/set (diameter|height) /d' good.prm >case.prm
refuse "a periodic box" '--set Specimen/shape = periodic box: a triaxial test needs a `cylinder`' triaxial case.prm --output out \
  --set "Specimen/shape=periodic box" --set "Specimen/edge x=5 mm" --set "Specimen/edge y=5 mm" --set "Specimen/edge z=5 mm"
sed -E '/upscaling ratio/d' good.prm >case.prm
refuse "graded upscaling" '--set Specimen/upscaling = graded: a triaxial test takes `uniform`' triaxial case.prm --output out \
  --set "Specimen/upscaling=graded" --set "Specimen/inner upscaling=4" --set "Specimen/outer upscaling=6" \
  --set "Specimen/inner radius=1 mm" --set "Specimen/outer radius=2 mm"
refuse_set "particles too large for the specimen" '--set Specimen/upscaling ratio = 60: the largest particle, 8\.022 mm, does not fit .*' \
  "Specimen/upscaling ratio=60"
refuse_set "a specimen too narrow" "${place}Specimen/upscaling ratio = 5: the largest particle, 0\.6685 mm, does not fit .*" \
  "Specimen/diameter=0.5 mm"
refuse_set "a specimen too low" "${place}Specimen/upscaling ratio = 5: the largest particle, 0\.6685 mm, does not fit .*" \
  "Specimen/height=0.4 mm"
refuse_set "porosity that particles cannot reach" '--set Specimen/porosity = 0\.2: .*' "Specimen/porosity=0.2"

## faults in a run: exit code 2, one message, the data are kept
tiny=(--set "Specimen/diameter=3.6 mm" --set "Specimen/height=5 mm")
# ends_in_run NAME PATTERN OUTPUT SETTING...
ends_in_run()
{
  local name=$1 pattern=$2 out=$3 options=("${tiny[@]}") setting code=0 log=$work.log
  shift 3
  for setting in "$@"; do options+=(--set "$setting"); done
  n_checks=$((n_checks + 1))
  bounded "$mergel" triaxial good.prm "${options[@]}" --output "$out" >"$log" 2>&1 || code=$?
  if [ "$code" -ne 2 ]; then
    fail "exit code $code, not 2"
  elif ! tail -n 1 "$log" | grep -Eq -- "$pattern"; then
    fail "does not match $pattern"
  elif [ ! -s "$out/failed.json" ] || [ -e "$out/summary.json" ] || [ "$(wc -l <"$out/history.csv")" -lt 3 ]; then
    fail "no failed.json, a summary, or no history"
  fi
  rm -f "$log"
}
# A target that is a strain names no pressure: the default membrane is of latex.
ends_in_run "a membrane that bursts" '^the membrane bursts: it is stretched to 3\.[0-9]* at z = .* \(step [0-9]*, t = .* ms\): raise `Membrane/Young.s modulus` .*' \
  burst "Loading/stage 1=isotropic to volumetric strain = 2 %" "Loading/stage 2="

echo "triaxial bad input: $((n_checks - n_failed)) of $n_checks as they should be"
[ "$n_failed" -eq 0 ]
