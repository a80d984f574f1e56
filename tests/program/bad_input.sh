#!/usr/bin/env bash
# Every piece of bad input gets one line that says what is wrong, exit code 1, and leaves the
# disk as it was.
#
# usage: tests/program/bad_input.sh MERGEL [CASE.prm]
#   MERGEL    the program
#   CASE.prm  a good case of the job pile; default apps/cases/pile_small.prm
# Prints one line for each check that fails, then a count; exit code 1 if any failed.
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 1; }
good=${2:+$(readlink -f "$2")}
. "$(dirname "$0")/preamble.sh"
case_file=${good:-$case_file}

# A specimen that is made in seconds, and is not the one of CASE.prm.
tiny=(--set "Specimen/diameter=6 mm" --set "Specimen/height=6 mm")
. "$root/tests/program/refusals.sh"

## the command line
refuse "unknown job" 'mergel: unknown job "piel"\. Did you mean "pile"\?' piel good.prm
refuse "no case" 'mergel pile: no case file is given\. .*' pile
refuse "a word too many" 'mergel version: "now" is one word too many\. .*' version now
refuse "keys of a job without a case" 'mergel info: --json is for jobs with a case.*' info --help --json
refuse "--json alone" 'mergel pile: --json belongs to --help: .*' pile good.prm --json
refuse "a cost of nothing" 'mergel check: --cost must be a positive number.*' check good.prm --cost 0
refuse "a check of nothing" 'mergel check: no case file is given\. .*' check
refuse "unknown option" 'mergel pile: .*--outptu.*' pile good.prm --outptu out
refuse "malformed --set" '--set "diameter": is not understood\. .*' pile good.prm --set diameter

## the case file
refuse "missing case file" 'none\.prm: no such case file\. .*' pile none.prm --output out
mkdir folder
refuse "folder as case file" 'folder: is a folder, not a case file\. .*' pile folder --output out
for job in check sample pile; do
  refuse "a device without end as case file ($job)" '/dev/zero: is larger than 1 MB and no case file\. .*' $job /dev/zero
done
edited case.prm 's/set diameter( *=.*mm)/set diametre\1/'
refuse "unknown key" 'case\.prm:[0-9]+: (Pile|Specimen)/diametre = .*: unknown key .*"diameter".*' \
  pile case.prm --output out
edited case.prm 's/subsection Pile/subsection Piles/'
# Former names: pile, element and bond.
while IFS='|' read -r job former value now; do
  refuse "the former name $former" "--set $former = .*: this key is now \`$now\`\. Rename it\." "$job" \
    "$root/apps/cases/$(case $job in pile) echo pile_small ;; element) echo element_small ;; bond) echo bond_fig5a ;; esac).prm" \
    --set "$former=$value"
done <<'NAMES'
pile|Bond/broken at damage|0.9|damage at breakage
pile|Motion/balance|1e-3|unbalanced-force tolerance
pile|Far field/growth|1.4|mesh growth ratio
pile|Far field/lip|1 mm|collar height
pile|Pile/velocity|1 m/s|penetration rate
element|Loading/leg 2|triaxial to axial strain = 2 %|stage 2
element|Loading/leg 13|resume to axial strain = 2 %|stage 13
element|Size effect/sample width|10 mm|specimen width
bond|Loading/steps per leg|10|steps per stage
NAMES
refuse "the former section Spheres" '--set Spheres/radius = 1 mm: the section "Spheres" is now "Particles"\. Rename it\.' \
  bond "$root/apps/cases/bond_fig5a.prm" --set "Spheres/radius=1 mm"
refuse "unknown section" 'case\.prm:[0-9]+: unknown section "Piles"\. Did you mean "Pile"\?' \
  pile case.prm --output out
edited case.prm '/subsection Pile/,/end/s/(set diameter *= *[0-9.]+) *[a-z]+/\1/'
refuse "value without unit" 'case\.prm:[0-9]+: Pile/diameter = [0-9.]+: has no unit.*mm\.' \
  pile case.prm --output out
edited case.prm '/subsection Pile/,/end/s/(set diameter *= *).*/\11.4 MPa/'
refuse "wrong dimension" \
  'case\.prm:[0-9]+: Pile/diameter = 1\.4 MPa: unit "MPa" has the wrong dimension.*mm\.' \
  pile case.prm --output out
edited case.prm '/subsection Bond/,/end/s/(set tensile strength *= *).*/\1-1 MPa/'
refuse "negative strength" \
  'case\.prm:[0-9]+: Bond/tensile strength = -1 MPa: must satisfy .*> 0.*' \
  pile case.prm --output out
edited case.prm '0,/^end/s/^end//'
refuse "section left open" 'case\.prm:[0-9]+: subsection .*"end".*' pile case.prm --output out
{ cat good.prm; printf 'subsection Pile\n  set diameter = 2 mm\nend\n'; } >case.prm
refuse "key given twice" 'case\.prm:[0-9]+: Pile/diameter = 2 mm: already set in line [0-9]+\. .*' \
  pile case.prm --output out

# A case of another job: job, the job of the case, its file.
mkdir begun
while read -r job of file; do
  refuse "a case of $of for $job" ".*$file\.prm: is a case of mergel $of, not of mergel $job\. Run .mergel $of .*$file\.prm.\." \
    "$job" "$root/apps/cases/$file.prm" --output out
  cp "$root/apps/cases/$file.prm" begun/resolved.prm
  refuse "a folder of $of for $job" "begun/resolved\.prm: is a case of mergel $of, not of mergel $job\. Run .mergel $of --restart begun.\." \
    "$job" --restart begun
done <<'CASES'
element pile pile_small
triaxial pile pile_small
pile element element_small
brazilian element element_small
bond triaxial triaxial_small
element triaxial triaxial_small
triaxial brazilian brazilian_small
pile brazilian brazilian_small
sample bond bond_fig5a
element bond bond_fig5a
CASES

refuse "a case for info" 'mergel info good\.prm: is a case of mergel pile\. `mergel check good\.prm` reads it\.' info good.prm

## values that contradict each other; the message names a key and its place
place='((good\.prm(:[0-9]+)?: )|--set )'
refuse_set "porosity that particles cannot reach" "${place}Specimen/porosity = 0\.2: .*" \
  "Specimen/porosity=0.2"
refuse_set "porosity that only pressure reaches" "${place}Specimen/porosity = 0\.485: .*from about 0\.[0-9]+ to 1; .*" \
  "Specimen/porosity=0.485" "Specimen/diameter=6 mm" "Specimen/height=6 mm"
refuse_set "particles too large for the region" "${place}Specimen/inner upscaling = 20: .*" \
  "Specimen/inner upscaling=20"
refuse_set "more particles than a machine holds" "${place}Specimen/smallest diameter = .*: .*2e7.*" \
  "Specimen/smallest diameter=0.001 mm" "Specimen/largest diameter=0.002 mm"
refuse_set "pile wider than the DEM region" "${place}(Pile|Specimen)/diameter = .*: .*" \
  "Pile/diameter=20 mm"
refuse_set "DEM region wider than the far field" "${place}(Specimen|Far field)/.* = .*: .*" \
  "Specimen/diameter=30 mm"

refuse_set "a surcharge that pulls" "${place}Far field/surcharge = -1 kPa: .*" \
  "Far field/surcharge=-1 kPa"
refuse_set "a chamber wall under no pressure" \
  'good\.prm(:[0-9]+)?: Far field/side pressure: must be given, .*' \
  "Far field/outer boundary=pressure"
refuse_set "a side pressure on a held wall" "${place}Far field/side pressure = 1 MPa: .*outer boundary.*" \
  "Far field/side pressure=1 MPa"
mkdir -p no_test
refuse_set "elasticity of no test" "${place}Far field/elasticity from = no_test: has no summary\\.json\\. .*" \
  "Far field/elasticity from=no_test"

## the output folder
echo text >file
refuse "a file in the way" 'output folder file: .*file" exists and is not a folder\. .*' \
  pile good.prm --output file
refuse "a file above" 'output folder file/results: .*file" exists and is not a folder\. .*' \
  pile good.prm --output file/results
mkdir earlier earlier/fields
echo '# The complete case of a run, defaults included. Of an earlier run.' >earlier/resolved.prm
echo text >earlier/history.csv
echo text >earlier/fields/particles_0000.vtp
refuse "an earlier run" \
  'output folder earlier: holds an earlier run \(fields/particles_0000\.vtp\)\. .*--overwrite\.' \
  pile good.prm --output earlier
refuse "bad input with --overwrite" '--set Pile/diameter = 1\.4: has no unit.*' \
  pile good.prm --output earlier --overwrite --set "Pile/diameter=1.4"
if [ "$(id -u)" -ne 0 ]; then # root may write everywhere
  mkdir locked
  chmod a-w locked
  refuse "a folder without permission" 'output folder locked: cannot be written: .*' \
    pile good.prm --output locked
fi

## sample files
echo "no sample" >text.h5
refuse_set "missing sample" '.*missing\.h5: there is no such file' "Specimen/file=missing.h5"
refuse_set "folder as sample" '.*folder: is not a file' "Specimen/file=folder"
refuse_set "text as sample" '.*text\.h5: is no sample: it is not an HDF5 file; .*' "Specimen/file=text.h5"
if ! "$mergel" sample good.prm "${tiny[@]}" --output tiny >tiny.log 2>&1; then
  echo "bad_input.sh: mergel sample failed:" >&2
  cat tiny.log >&2
  exit 1
fi
size=$(stat -c %s tiny/sample.h5)
head -c $((size / 2)) tiny/sample.h5 >half.h5
head -c $((size - 1)) tiny/sample.h5 >short.h5
head -c 100 tiny/sample.h5 >head.h5
: >empty.h5
for sample in half short; do
  refuse_set "truncated sample ($sample)" ".*$sample\.h5: is no sample, or is truncated; .*" \
    "Specimen/file=$sample.h5"
done
cp tiny/sample.h5 changed.h5
printf X | dd of=changed.h5 bs=1 seek=$((size / 2)) conv=notrunc status=none
refuse_set "changed sample" '.*changed\.h5: is damaged .*' "Specimen/file=changed.h5"
for sample in head empty; do
  refuse_set "truncated sample ($sample)" ".*$sample\.h5: is no sample.*" \
    "Specimen/file=$sample.h5"
done
refuse_set "sample of another case" '.*tiny/sample\.h5: was made with diameter = .*the case asks for .*' \
  "Specimen/file=tiny/sample.h5"
refuse "sample that --overwrite would remove" \
  'output folder tiny: --overwrite would remove .*sample\.h5, which this run reads\. .*' \
  pile good.prm "${tiny[@]}" --set "Specimen/file=tiny/sample.h5" --output tiny --overwrite

## specimens
sed -E "s#\.\./\.\./#$root/#" "$root/apps/cases/sample_rock.prm" >rock.prm
sample_set()
{
  local name=$1 pattern=$2 options=() setting
  shift 2
  for setting in "$@"; do options+=(--set "$setting"); done
  refuse "$name" "$pattern" sample rock.prm "${options[@]}" --output out
}
head='diameter [mm],passing [%]'
sizes() { printf '%s\n' "$head" "$@" >sizes.csv; }
curve='--set Specimen/size table = sizes\.csv: .*sizes\.csv'
sample_set "a size table that does not exist" "$curve: cannot be read: No such file or directory\. .*" "Specimen/size table=sizes.csv"
sizes 0.1,0 0.2,40 0.15,100
sample_set "sizes that do not ascend" "$curve:4: diameter = 0\.15 mm: must be above .*" \
  "Specimen/size table=sizes.csv"
sizes 0.1,0 0.2,40 0.25,30 0.3,100
sample_set "passing that decreases" "$curve:4: passing = 30 %: must not be below .*" \
  "Specimen/size table=sizes.csv"
sizes 0.1,0 0.2,40
sample_set "a curve without its end" "$curve:3: passing = 40 %: must be 100 .*" \
  "Specimen/size table=sizes.csv"
sample_set "unknown shape" '--set Specimen/shape = sphere: must be one of .*' "Specimen/shape=sphere"
sample_set "a key of another shape" '--set Specimen/diameter = 5 mm: is a key of `shape` = .*' \
  "Specimen/diameter=5 mm"
sed -E '/upscaling ratio/d; s/(set upscaling *= *)uniform/\1graded/' rock.prm >graded.prm
refuse "graded without an axis" \
  'graded\.prm:[0-9]+: Specimen/upscaling = graded: a periodic box has no axis: .*' \
  sample graded.prm --output out --set "Specimen/inner upscaling=2" \
  --set "Specimen/outer upscaling=3" --set "Specimen/inner radius=1 mm" --set "Specimen/outer radius=2 mm"
sample_set "a box smaller than its particles" '--set Specimen/upscaling ratio = 80: the largest particle, .*' \
  "Specimen/upscaling ratio=80"
sample_set "a box in which a particle touches its own image" \
  '--set Specimen/upscaling ratio = 10: the largest particle, 1\.337 mm, .*wider than .*' \
  "Specimen/upscaling ratio=10" "Specimen/edge z=2.9 mm"
sample_set "a pressure of zero" '--set Specimen/target pressure = 0 Pa: must satisfy .*> 0.*' \
  "Specimen/target pressure=0 Pa"
sample_set "a box too dense for its shells" '--set Specimen/porosity = 0\.4: must be at least 0\.[0-9]+ and at most about 0\.[0-9]+, .*' \
  "Specimen/porosity=0.4"
sample_set "a box too loose for its pressure" \
  '--set Specimen/porosity = 0\.7: cannot be reached together with .*jam at porosities between 0\.[0-9]+ .*' \
  "Specimen/porosity=0.7" "Specimen/upscaling ratio=14" "Specimen/target pressure=50 kPa"
variability="Strength variability"
sample_set "unknown distribution" \
  "--set $variability/distribution = Weibul: must be one of .*Did you mean \"Weibull\"\?" \
  "$variability/distribution=Weibul"
sample_set "a distribution without its width" ".*$variability/coefficient of variation.*" \
  "$variability/distribution=log-normal"
sample_set "strengths that vary too much" \
  "--set $variability/coefficient of variation = 1\.5: must .*" \
  "$variability/distribution=log-normal" "$variability/coefficient of variation=1.5"
refuse_set "a width without a distribution" \
  "--set $variability/coefficient of variation = 0\.3: is a key of .distribution. = .*" \
  "$variability/coefficient of variation=0.3"
# mergel sample reads all sections of a case of another job, and no section without a job.
for job in element triaxial; do
  refuse "a stage that a case of $job cannot have" '--set Loading/stage 1 = isotropic: .*' \
    sample "$root/apps/cases/${job}_small.prm" --output out --set "Loading/stage 1=isotropic"
  refuse "a specimen of $job that is read" '--set Specimen/file = text\.h5: mergel sample makes the specimen: .*' \
    sample "$root/apps/cases/${job}_small.prm" --output out --set "Specimen/file=text.h5"
done
refuse "a cell pressure without a membrane" '.*triaxial_small\.prm:[0-9]+: Loading/stage 1 = .*needs a membrane.*' \
  sample "$root/apps/cases/triaxial_small.prm" --output out --set "Membrane/membrane=false"
refuse "a specimen of two particles" '.*bond_fig5a\.prm: is a case of mergel bond, not of mergel sample\. .*' \
  sample "$root/apps/cases/bond_fig5a.prm" --output out
edited case.prm '/set symmetry/d;/set diameter .*10 mm/d;/set height/d'
refuse "a pile in a periodic box" '--set Specimen/shape = periodic box: .*half cylinder.*' \
  pile case.prm --output out --set "Specimen/shape=periodic box" --set "Specimen/edge x=5 mm" \
  --set "Specimen/edge y=5 mm" --set "Specimen/edge z=5 mm"
edited case.prm '/set symmetry/d'
refuse "faces of a full model" '--set Specimen/faces around the side = 12: unknown key .*' \
  pile case.prm --output out --set "Specimen/shape=cylinder" --set "Specimen/faces around the side=12"
refuse_set "a specimen of a pile under pressure" "${place}Specimen/packing = confined: .*use .unjammed." \
  "Specimen/packing=confined" "Specimen/target pressure=5 kPa"

## units and stages
for job in pile check; do
  refuse "a bond in mPa ($job)" '--set Bond/effective modulus = 22\.5 mPa: is less than a millionth of the tensile strength of the bond, 36 MPa\. .*' \
    $job good.prm --set "Bond/effective modulus=22.5 mPa"
  refuse "a strength beyond rock ($job)" '--set Bond/tensile strength = 1e9 GPa: is more than a million times the modulus of the bonds, .* MPa\. .*' \
    $job good.prm --set "Bond/tensile strength=1e9 GPa"
  refuse "a contact in mPa ($job)" '--set Contact/effective modulus = 0\.63 mPa: is more than a million times off .*' \
    $job good.prm --set "Contact/effective modulus=0.63 mPa"
  refuse "a far field in mPa ($job)" "--set Far field/Young's modulus = 1\\.1 mPa: is more than a million times off .*" \
    $job good.prm --set "Far field/Young's modulus=1.1 mPa"
done
refuse "a compression of 200 %" '--set Loading/stage 2 = .*: a compression of 100 % leaves nothing of the specimen: .*' \
  element "$root/apps/cases/element_small.prm" --set "Loading/stage 2=triaxial to axial strain = 200 %"
refuse "an unloading upwards" '--set Loading/stage 4 = .*: the target lies beyond that of the stage before, .*' \
  element "$root/apps/cases/element_small.prm" --set "Loading/stage 3=isotropic to p = 2 MPa" \
  --set "Loading/stage 4=unload to p = 3 MPa"

## one bond
cp "$root/apps/cases/bond_fig5a.prm" bond.prm
path='bond\.prm:[0-9]+: Loading/path = .*'
corner() { printf '%s\n' "$@" >bond_fig5a.csv; }
head='u_n [m],u_s [m],theta [rad]'
refuse "path that does not exist" "$path: .*bond_fig5a\.csv: cannot be read: No such file or directory\. .*" bond bond.prm --output out
corner 'u_n [MPa],u_s [m],theta [rad]' 0.1,0,0
refuse "path in a wrong unit" "$path: .*column 'u_n': \[MPa\] for a column in \[m\]: .*wrong dimension.*" bond bond.prm --output out
corner 'u_n,u_s [m],theta [rad]' 0.1,0,0
refuse "path without a unit" "$path: .*column 'u_n' has no unit: write it behind its name, such as 'u_n \[m\]'\." bond bond.prm --output out
corner 'u_n [m];u_s [m];theta [rad]' '1e-4,0,0'
refuse "path with two separators" "$path: .*:2: 1 values under 3 headings, separated by semicolons\." bond bond.prm --output out
printf '\xff\xfeu\0' >bond_fig5a.csv
refuse "path in UTF-16" "$path: .*is UTF-16, not UTF-8: save it as \"CSV UTF-8\" or as plain text" bond bond.prm --output out
corner 'u_n [m],theta [rad]' 1e-4,0
refuse "path without a column" "$path: .*no column 'u_s \[m\]'; .*" bond bond.prm --output out
corner "$head"
refuse "path without a corner" "$path: .*holds no record below its headings\." bond bond.prm --output out
corner "$head" 0,0,0
refuse "path that does not move" "$path: .*the only corner is the start itself.*" bond bond.prm --output out
corner "$head" 1e-4,0,0 2e-4,nan,0
refuse "path with nan" "$path: .*:3: every motion must be a finite number" bond bond.prm --output out
corner "$head" 1e-4,0,0 2e-4,,0
refuse "path with an empty value" "$path: .*:3: every motion must be a finite number" bond bond.prm --output out
corner "$head" 1e-4,0
refuse "path with a short line" "$path: .*:2: 2 values under 3 headings, separated by commas\." bond bond.prm --output out
corner "$head" 1e-4,0,0 -20e-3,0,0
refuse "path through the particles" "$path: .*:3: u_n = -0\.02 m makes the particles overlap .*at least -0\.01775 m" bond bond.prm --output out
corner "$head" 1e-4,4,0
refuse "path in metres by mistake" "$path: .*:2: a displacement exceeds 1000 radii: .*" bond bond.prm --output out --set "Particles/radius=1 mm"
cp "$root/apps/cases/bond_fig5a.csv" .
refuse "zero stiffness ratio" '--set Bond/stiffness ratio = 0: must satisfy .*> 0.*' \
  bond bond.prm --output out --set "Bond/stiffness ratio=0"
refuse "no steps" '--set Loading/steps per stage = 0: must satisfy .*' bond bond.prm --output out \
  --set "Loading/steps per stage=0"
refuse "a key of another law" 'bond\.prm:[0-9]+: Bond/compressive strength = 10 MPa: is a key of `bond law` = damage; .*' \
  bond bond.prm --output out --set "Bond/bond law=parallel"
refuse "a key of another mode" '--set Loading/rotation = 1 rad: is a key of `mode` = .*; here it is path\. .*' \
  bond bond.prm --output out --set "Loading/rotation=1 rad"
refuse "unknown loading" '--set Loading/mode = tensoin: must be one of .*Did you mean "tension"\?' \
  bond bond.prm --output out --set "Loading/mode=tensoin"

## the bench
refuse "unknown workload" 'mergel bench: --workload = "W3": must be W1, W2 or all.*' bench --workload W3
refuse "too few particles" 'mergel bench: --particles = 10: must lie in 200 to 2e7.*' bench --particles 10
refuse "no steps to time" 'mergel bench: --steps.*must be at least one block of at least one step.*' bench --steps -3
refuse "a block and a table" 'mergel bench: --(write-block excludes --output|output excludes --write-block).*' bench --write-block block.txt --output t.csv
refuse "a block and steps" 'mergel bench: --(write-block excludes --steps|steps excludes --write-block).*' bench --write-block block.txt --steps 10
refuse "a block and a checkpoint" 'mergel bench: --(write-block excludes --checkpoint|checkpoint excludes --write-block).*' \
  bench --write-block block.txt --checkpoint c.h5
refuse "a checkpoint and repeats" 'mergel bench: --(checkpoint excludes --repeat|repeat excludes --checkpoint).*' bench --checkpoint c.h5 --repeat 2
refuse "a block of W2" 'mergel bench: --write-block writes W1, and --workload W2 has no effect\. .*' bench --workload W2 --write-block b.txt
refuse "yielding without bonds" 'mergel bench: --yielding: only W1 has bonds\. Add --workload W1.*' bench --yielding 0.1

echo "bad input: $((n_checks - n_failed)) of $n_checks refused as they should be"
[ "$n_failed" -eq 0 ]
