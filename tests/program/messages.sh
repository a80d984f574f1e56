#!/usr/bin/env bash
# Messages: nothing acts on the terminal, what is to be typed can be typed, numbers stay readable, and
# what is possible but unusual is said in one line.
#
# usage: tests/program/messages.sh MERGEL
. "$(dirname "$0")/preamble.sh"
pile=$root/apps/cases/pile_small.prm bond=$root/apps/cases/bond_fig5a.prm element=$root/apps/cases/element_small.prm
plain() { ! LC_ALL=C grep -q $'[\x01-\x08\x0b-\x1f\x7f]' "$1" || fail "$2: control characters: $(cat -v "$1")"; }

## control characters of names and values
escape=$'\x1b[31mred\x07'
sed "s/set diameter   /set ${escape} = 1\n  set diameter   /" "$pile" >case.prm
[ "$(code_of "$mergel" pile case.prm --output none)" = 1 ] || fail "a key of escape codes"
plain log "a key"
grep -qF '\x1b[31mred\x07' log || fail "the key is not named: $(cat -v log)"
[ "$(code_of "$mergel" pile "$pile" --set "Pile/friction=$escape" --output none)" = 1 ] || fail "a value of escape codes"
plain log "a value"
[ "$(code_of "$mergel" "$escape")" = 1 ] || fail "a job of escape codes"
plain log "a job"
[ "$(code_of "$mergel" pile "$escape.prm")" = 1 ] || fail "a case of escape codes"
plain log "a case"
[ "$(code_of "$mergel" bond "$bond" --output "$escape")" = 0 ] || fail "a folder of escape codes: $(cat -v log)"
plain log "the results of a folder"
[ "$(code_of "$mergel" info "$escape")" = 0 ] || fail "info of it: $(cat -v log)"
plain log "info of a folder"

## a case from a pipe; its relative paths start at the working folder
cp "$root/apps/cases/bond_fig5a.csv" .
for case in "$pile" "$bond" "$element"; do
  "$mergel" check /dev/stdin <"$case" >log || fail "check of standard input, $case: $(cat log)"
  cat "$case" | "$mergel" check /dev/stdin >piped || fail "check of a pipe, $case: $(cat piped)"
  cmp -s log piped || fail "$case: a pipe is another case: $(diff log piped)"
done
cat "$root/apps/cases/pile_small.prm" | "$mergel" sample /dev/stdin "${tiny[@]}" --output piped_rock >log || fail "sample of a pipe: $(cat log)"

## what is to be typed
"$mergel" bond "$bond" --output "my results" >log
grep -qF "mergel-view 'my results'" log || fail "a folder with a blank, bond: $(tail -1 log)"
"$mergel" sample "$pile" "${tiny[@]}" --output "my rock" >log
hint=$(sed -n 's/^use it with //p' log)
bash -c "\"$mergel\" check \"$pile\" ${tiny[*]@Q} $hint" >log || fail "the hint of mergel sample: $hint: $(cat log)"
grep -q 'my rock/sample.h5' log || fail "the hint names no specimen: $(cat log)"

## long values
digits=$(printf '1%.0s' {1..300})
for value in "$digits mm" "0.$digits MPa" "1e300 mm"; do
  [ "$(code_of "$mergel" pile "$pile" --set "Pile/diameter=$value" --output none)" = 1 ] || fail "a diameter of $value"
  [ "$(wc -c <log)" -lt 400 ] || fail "the message on a long value has $(wc -c <log) characters: $(cat log)"
done

## standard output that is full
for arguments in "" help "help pile" version "pile --help" "pile --help --json" "pile --template" "man pile" "completion bash" \
  "info bond" "check $pile" "bench --workload W1 --particles 200 --steps 4 --repeat 2"; do
  [ -n "$arguments" ] || continue
  code=0
  # shellcheck disable=SC2086
  "$mergel" $arguments >/dev/full 2>errors || code=$?
  [ "$arguments" != "info bond" ] || continue
  [ "$code" = 2 ] && grep -q 'standard output cannot be written' errors || fail "mergel $arguments into a full device: exit code $code, $(cat errors)"
done

## the bench
"$mergel" bench --workload W1 --particles 200 --steps 4 --repeat 2 >log
grep -q 'per particle-step  *[0-9.]* ns' log && ! grep -q 'particle-step[0-9]' log || fail "a blank is missing: $(cat log)"

## what is unusual is said, by check and by the job
says() { grep -q "^unusual: $1" log || fail "$2: $(cat log)"; }
"$mergel" check "$pile" --set "Pile/diameter=0.4 mm" >log
says 'D_p/d50 = [0-9.]*; usual is 8 or more' "a thin pile"
"$mergel" check "$pile" --set "Far field/chamber diameter=11 mm" >log
says 'chamber diameter/D_p = 7.86; usual is 10 or more' "a narrow chamber"
"$mergel" check "$pile" --set "Pile/penetration rate=100 m/s" >log
says 'inertial number v d50/D_p sqrt(rho/p) = ' "a fast pile"
"$mergel" check "$pile" --set "Specimen/porosity=0.75" >log
says 'volume fraction of the particles' "a loose specimen"
"$mergel" check "$element" --set "Loading/inertial number=0.05" >log
says 'Loading/inertial number = 0.05; usual is 0.001 or less' "a fast test"
"$mergel" check "$element" --set "Contact/effective modulus=1 MPa" >log
says 'moduli of bond and contact, the larger over the smaller = ' "a soft contact"
"$mergel" check "$element" --set "Bond/tensile strength=1 kPa" >log
says 'bond modulus/tensile strength = ' "weak bonds"
"$mergel" check "$pile" --set "Pile/penetration rate=1e-12 m/s" >log
says 'number of steps = [0-9.]*e+[0-9]*; usual is 1e+09 or less' "a pile that nobody sees arrive"
says 'hours on one rank = ' "the hours of this pile"
# SETTING TEXT: said by check of each job, and not without it
for setting in "Contact/friction=5|Contact/friction = 5; usual is 2 or less" "Motion/damping=0.99|Motion/damping = 0.99; usual is 0.95 or less" \
  "Specimen/grain density=2.6 kg/m3|Specimen/grain density .* = 2.6; usual is 500 or more" \
  "Specimen/grain density=2556 g/cm3|Specimen/grain density .* usual is 1e+04 or less" \
  "Bond/tensile strength=300 MPa|Bond/tensile strength/compressive strength = 1.52; usual is 1 or less" \
  "Bond/softening displacement=4 mm|Bond/softening displacement/radius of the smallest particle = 121; usual is 1 or less"; do
  for case in "$pile" "$element" "$root/apps/cases/triaxial_small.prm" "$root/apps/cases/brazilian_small.prm"; do
    "$mergel" check "$case" --set "${setting%|*}" >log
    says "${setting#*|}" "$case with ${setting%|*}"
    "$mergel" check "$case" >log
    ! grep -q "^unusual: ${setting#*|}" log || fail "$case: $(cat log)"
  done
done
small=(--set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" --set "Specimen/edge z=3.5 mm")
"$mergel" sample "$element" "${small[@]}" --set "Specimen/coordination=20" --output many >log || fail "many bonds: $(cat log)"
says 'Specimen/coordination = 20; usual is 8 or less' "many bonds wanted"
says 'Specimen/coordination = 20 is wanted, and pairs up to `bond gap` give ' "many bonds reached"

## what cannot be is refused, by both
for job in check element; do
  for setting in "Bond/effective modulus=22.5 mPa" "Contact/effective modulus=0.63 mPa" "Loading/stage 2=triaxial to axial strain = 200 %" \
    "Loading/stage 2=unload to p = 7 MPa"; do
    options=(--set "$setting")
    [[ "$setting" != *unload* ]] || options+=(--set "Loading/stage 1=isotropic to p = 5 MPa" --set "Loading/stage 3=" --set "Loading/stage 4=")
    [ "$(code_of "$mergel" "$job" "$element" "${options[@]}")" = 1 ] && [ "$(wc -l <log)" = 1 ] || fail "$job with $setting: $(cat log)"
  done
done
[ "$(code_of "$mergel" check "$pile" --set "Far field/Young's modulus=1 mPa")" = 1 ] || fail "a far field of 1 mPa: $(cat log)"
[ "$(code_of "$mergel" check "$pile" --set "Specimen/porosity=0.9999")" = 0 ] || fail "a porosity of 0.9999: $(cat log)"
says 'volume fraction of the particles' "a porosity of 0.9999"
[ ! -e results ] || fail "mergel check has written results"

echo "messages: plain, short, and to be typed as they are"
