#!/usr/bin/env bash
# Small Brazilian tests from start to end: files, equilibrium of the plates, energy balance, breaks in history, summary and
# pictures; where failure began; the ends by load and by strain; a disc that does not break; friction; pictures; a specimen
# made before.
#
# usage: tests/program/brazilian.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"
case_file=$root/apps/cases/brazilian_small.prm
tiny=(--set "Specimen/diameter=4.5 mm" --set "Specimen/height=2.4 mm" --set "Loading/velocity=50 mm/s")
# OUTPUT [options]
run() {
  local out=$1
  shift
  bounded "$mergel" brazilian "$case_file" "${tiny[@]}" "$@" --output "$out" >"$out.log" 2>&1 || fail "$out: $(tail -5 "$out.log")"
}
# RUN PICTURES: the files of a run are there and whole, and what holds at every record. At 50 mm/s, where a wave has 33 kPa,
# the plates agree within 4 % of the load up to the peak.
sound() {
  local file kind
  for file in history.csv summary.json resolved.prm sample.h5; do [ -s "$1/$file" ] || fail "$1/$file is missing"; done
  for kind in particles bonds contacts breaks plates; do
    [ "$(compgen -G "$1/fields/${kind}_*.vtp" | wc -l)" -eq "$2" ] && [ "$(grep -c '<DataSet' "$1/$kind.pvd")" -eq "$2" ] ||
      fail "$1: $2 pictures of $kind: $(ls "$1/fields")"
  done
  bounded "$mergel" info "$1" >info || fail "info $1: $(cat info)"
  grep -q 'finished' info && grep -q "fields  *$((5 * $2)) files, none is cut" info || fail "info $1: $(cat info)"
  ! grep -qiE '(^|,)-?(nan|inf)' "$1/history.csv" || fail "$1: a number of the history is not finite"
  # Breaks by mode and by zone are all breaks. The index stress is that of the load on a disc of 4.5 x 2.4 mm.
  records "$1" '{ e = abs(c("energy error [-]")); if (e > most) most = e
      P = c("load P [N]"); d = abs(c("force on the upper plate [N]") - c("force on the lower plate [N]"))
      if (P > peak) peak = P
      if (P == peak && peak > 4 && d / peak > apart) apart = d / peak
      n = c("broken bonds [-]")
      if (n != c("broken in tension [-]") + c("broken in compression [-]") + c("broken in shear [-]") + c("broken in bending [-]")) bad = 1
      if (n != c("broken at the centre [-]") + c("broken at the plates [-]") + c("broken elsewhere along the diameter [-]") + c("broken at the sides [-]")) bad = 2
      if (abs(c("2P/(pi D t) [Pa]") - 2 * P / (3.14159265358979 * 4.5e-3 * 2.4e-3)) > 1e-6 * (1 + c("2P/(pi D t) [Pa]"))) bad = 3
      if (abs(c("diametral strain [-]") * 4.5e-3 - c("approach of the plates [m]")) > 1e-12) bad = 4
      if (P < 0 || c("stress along at the centre [Pa]") > 1e5) bad = 5 }
    END { print "'"$1"': " NR - 1 " records, energy error " most ", plates apart by " apart " of the peak, " peak " N"
      exit !(NR > 3 && !bad && most < 1e-3 && apart < 0.06) }' || fail "$1: energy, plates, breaks or stresses"
}

run a
n_pictures=$(compgen -G "a/fields/plates_*.vtp" | wc -l)
[ "$n_pictures" -ge 5 ] || fail "pictures by strain: $n_pictures"
sound a "$n_pictures"
grep -q '^stress at the start, at the centre: across the loaded diameter .* MPa' a.log || fail "the stress at the start is not said: $(head -8 a.log)"
for way in across along; do
  [ "$(records a 'NR == 2 { printf "%.6g", c("stress '$way' at the centre [Pa]") }')" = "$(printf %.6g "$(value a "stress $way at the centre at the start [Pa]")")" ] ||
    fail "the stress $way at the centre at the start is not that of the first record"
done
grep -q '"outcome": "the load fell below its final share"' a/summary.json || fail "the end: $(head -4 a.log)"
within a "2P/(pi D t) at the peak [Pa]" 3e5 1e6
within a "bonds broken [-]" 20 2000
records a '{ P = c("load P [N]"); if (P > peak) { peak = P; strain = c("diametral strain [-]") } n = P < 0.5 * peak ? n + 1 : 0 }
  END { print "peak at " 100 * strain " %"; exit !(n == 10 && strain > 2e-3 && strain < 2e-2) }' || fail "it ends after ten records below half of the peak"
# The first breaks: twenty, in order of load, where they are said to be.
[ "$(grep -c '"mode": "' a/summary.json)" -eq 20 ] || fail "twenty first breaks"
awk -F'"zone": "' '/"mode": "/ { sub(/".*/, "", $2); ++n[$2] } END { for (z in n) print n[z], z }' a/summary.json | sort -rn >zones
read -r most zone <zones
began=$(sed -n 's/.*"failure began": "\(.*\)".*/\1/p' a/summary.json)
[ "$(grep -c "^$most " zones)" -gt 1 ] || [ "$began" = "$zone" ] || fail "failure began $began, but most of the first breaks are $zone"
if [ "$began" = "at the centre" ]; then word='the tensile strength'; else word='an index'; fi
grep -q "\"2P/(pi D t) is\": \"$word\"" a/summary.json || fail "2P/(pi D t) is not called $word"
[ "$word" != 'an index' ] || grep -q 'the value is an index, not the tensile strength' a.log || fail "the closing text does not say that it is an index"
for field in radius damage displacement; do
  grep -aq "Name=\"$field\"" "$(compgen -G "a/fields/particles_*.vtp" | tail -1)" || fail "no $field in the picture of the particles"
done
for field in mode normal radius; do
  grep -aq "Name=\"$field\"" "$(compgen -G "a/fields/breaks_*.vtp" | tail -1)" || fail "no $field in the picture of the breaks"
done
bounded "$mergel" brazilian a/resolved.prm --output again >again.log || fail "from resolved.prm: $(cat again.log)"
cmp a/history.csv again/history.csv || fail "a repeated run differs"
cmp <(case_of a) <(case_of again) || fail "the resolved case of a resolved case differs"

# The specimen of the case, made before.
bounded "$mergel" sample "$case_file" "${tiny[@]}" --output rock >rock.log 2>&1 || fail "the specimen: $(cat rock.log)"
cmp a/sample.h5 rock/sample.h5 || fail "another specimen"
run limit --set "Specimen/file=$work/rock/sample.h5" --set "Loading/strain limit=0.002" --set "Output/pictures=ends"
sound limit 2
grep -q '"outcome": "the strain limit was reached"' limit/summary.json || fail "the strain limit"
n=$(wc -l <limit/history.csv)
cmp <(head -n "$n" a/history.csv) limit/history.csv || fail "a shorter test differs before its end"

# Bonds that do not break: no strength. Friction: another load.
strong=(--set "Bond/tensile strength=1e6 GPa" --set "Bond/compressive strength=1e6 GPa" --set "Bond/shear strength=1e6 GPa")
run elastic "${strong[@]}" --set "Specimen/file=$work/rock/sample.h5" --set "Loading/strain limit=0.004" --set "Output/pictures=none"
[ ! -e elastic/fields ] && [ ! -e elastic/particles.pvd ] || fail "pictures in spite of pictures = none"
grep -q 'no bond broke: 2P/(pi D t) is no strength' elastic.log || fail "no bond broke: $(cat elastic.log)"
within elastic "bonds broken [-]" 0 0
run rough "${strong[@]}" --set "Specimen/file=$work/rock/sample.h5" --set "Loading/strain limit=0.004" --set "Output/pictures=none" \
  --set "Plates/friction=0.5"
awk -v a="$(value elastic "largest load [N]")" -v b="$(value rough "largest load [N]")" 'BEGIN { print "load: " a ", with friction " b " N"
  exit !(b > a && b < 1.2 * a) }' || fail "friction of the plates"
echo "brazilian: all checks hold"
