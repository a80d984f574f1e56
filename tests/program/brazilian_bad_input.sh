#!/usr/bin/env bash
# Every case of mergel brazilian that is refused gives one line that names file or option, section/key, value and what is
# expected, exit code 1, and leaves the disk as it is.
#
# usage: tests/program/brazilian_bad_input.sh MERGEL
. "$(dirname "$0")/preamble.sh"
case_file=$root/apps/cases/brazilian_small.prm good_job=brazilian
. "$root/tests/program/refusals.sh"
place='((good\.prm(:[0-9]+)?: )|--set )'

## loading
refuse_set "plates at rest" '--set Loading/velocity = 0 mm/s: must satisfy value > 0\..*' "Loading/velocity=0 mm/s"
refuse_set "plates that part" '--set Loading/velocity = -1 mm/s: must satisfy value > 0\..*' "Loading/velocity=-1 mm/s"
refuse_set "a velocity in another dimension" '--set Loading/velocity = 1 MPa: .*' "Loading/velocity=1 MPa"
refuse_set "no strain" '--set Loading/strain limit = 0: must satisfy .*' "Loading/strain limit=0"
refuse_set "a strain that leaves no disc" '--set Loading/strain limit = 0\.5: must satisfy .*' "Loading/strain limit=0.5"
refuse_set "a load that never falls so far" '--set Loading/final load = 1: must satisfy .*' "Loading/final load=1"
refuse_set "a negative load" '--set Loading/final load = -0\.1: must satisfy .*' "Loading/final load=-0.1"
refuse_set "loading stages" '--set Loading/stage 1 = .*: unknown key in section "Loading"\. Its keys are velocity, strain limit, final load\.' "Loading/stage 1=compression to axial strain = 1 %"
refuse_set "a key written wrongly" '--set Loading/velocty = 1 mm/s: unknown key .* Did you mean "velocity"\?' "Loading/velocty=1 mm/s"

## plates, motion
refuse_set "plates that pull along the rim" '--set Plates/friction = -0\.1: must satisfy .*' "Plates/friction=-0.1"
refuse_set "soft plates" '--set Plates/contact modulus = 0 GPa: must satisfy .*' "Plates/contact modulus=0 GPa"
refuse_set "a platen" '--set Platens/friction = 0\.1: unknown section "Platens"\. Did you mean "Plates"\?' "Platens/friction=0.1"
refuse_set "a membrane" '--set Membrane/membrane = true: unknown section "Membrane"\. .*' "Membrane/membrane=true"
refuse_set "damping that stops all" '--set Motion/damping = 1: must satisfy .*' "Motion/damping=1"

## output
refuse_set "one record" '--set Output/record every = 0\.05: must be below `Loading/strain limit`' "Output/record every=0.05"
refuse_set "no records" '--set Output/record every = 0: must satisfy .*' "Output/record every=0"
refuse_set "an interval without pictures" '--set Output/picture every = 0\.01: is a key of `pictures` = strain; .*' \
  "Output/pictures=ends" "Output/picture every=0.01"
refuse_set "unknown pictures" '--set Output/pictures = stages: must be one of none \| ends \| strain\..*' "Output/pictures=stages"

## specimen
refuse_set "half a cylinder" '--set Specimen/shape = half cylinder: a Brazilian test needs a `cylinder`' "Specimen/shape=half cylinder"
sed -E '/set (diameter|height) /d' good.prm >case.prm
refuse "a periodic box" '--set Specimen/shape = periodic box: a Brazilian test needs a `cylinder`' brazilian case.prm --output out \
  --set "Specimen/shape=periodic box" --set "Specimen/edge x=5 mm" --set "Specimen/edge y=5 mm" --set "Specimen/edge z=5 mm"
sed -E '/upscaling ratio/d' good.prm >case.prm
refuse "graded upscaling" '--set Specimen/upscaling = graded: a Brazilian test takes `uniform`' brazilian case.prm --output out \
  --set "Specimen/upscaling=graded" --set "Specimen/inner upscaling=4" --set "Specimen/outer upscaling=6" \
  --set "Specimen/inner radius=1 mm" --set "Specimen/outer radius=2 mm"
refuse_set "a disc thinner than its particles" "${place}Specimen/upscaling ratio = 5: the largest particle, 0\.6685 mm, does not fit .*" \
  "Specimen/height=0.4 mm"
refuse_set "a disc of one particle" "${place}Specimen/upscaling ratio = 5: the largest particle, 0\.6685 mm, does not fit .*" \
  "Specimen/diameter=0.5 mm"
kept='the contacts of such a specimen keep their pressure, and nothing confines it in this test: '
refuse_set "a disc that bursts" "--set Specimen/packing = expanded: ${kept}.*Use .unjammed." "Specimen/packing=expanded"
# The bonds bear 36 MPa, their rock some twentieth of it.
refuse_set "a disc that breaks before it is loaded" \
  "--set Specimen/target pressure = 1 MPa: ${kept}.* at most 0\.9 MPa, .*packing = unjammed." \
  "Specimen/packing=confined" "Specimen/target pressure=1 MPa"
refuse_set "a disc without bonds" '--set Specimen/coordination = 0: .*' "Specimen/coordination=0" "Specimen/packing=confined" \
  "Specimen/target pressure=5 kPa"
refuse_set "a specimen that is not there" '.*Specimen/file = .*none\.h5: .*' "Specimen/file=none.h5"
refuse "no case" '.*none\.prm.*' brazilian none.prm --output out

echo "brazilian bad input: $((n_checks - n_failed)) of $n_checks as they should be"
[ "$n_failed" -eq 0 ]
