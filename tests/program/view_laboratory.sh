#!/usr/bin/env bash
# mergel-view of several tests, and of runs beside measured curves: which pictures it makes, what it
# says of those that it does not make, and what it refuses before it makes any.
#
# usage: tests/program/view_laboratory.sh MERGEL_VIEW
set -euo pipefail
view=$(readlink -f "$1")
here=$(dirname "$(readlink -f "$0")")
if [ -z "${DISPLAY:-}" ]; then
  command -v xvfb-run >/dev/null || { echo "SKIPPED: neither a display nor xvfb-run"; exit 77; }
  # without -noreset the server restarts after each program and may refuse the next one
  exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$0" "$view"
fi
. "$here/laboratory_runs.sh"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "FAILED: $*"; exit 1; }

for s in 0.5 1 2; do exact_run "run_$s" "$s" 1; done
exact_run run_1_again 1 2
mkdir pile
printf 'time [s],depth [m],depth/D_p [-],tip depth [m],tip force of the full pile [N],shaft force of the full pile [N],q_c [Pa],bonds broken [-]\n0,0,0,1.2e-3,0,0,0,0\n1e-3,1.4e-3,1,2.6e-3,3,1,2e6,30\n2e-3,4e-3,2.9,5.2e-3,12,2,8e6,90\n' >pile/history.csv

# "PICTURES" ARGUMENTS...: makes these and no others, each a PNG of 300 dpi whose chunks are whole
makes() {
  local pictures=$1 p
  shift
  rm -rf out
  "$view" --output out "$@" >log 2>&1 || fail "$*: $(cat log)"
  [ "$(cd out && echo *)" = "$pictures" ] || fail "$*: wanted $pictures, made $(ls out): $(cat log)"
  for p in $pictures; do
    [ "$(head -c 8 "out/$p" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$p: no PNG"
    [ "$(head -c 54 "out/$p" | tail -c 21 | od -An -v -tx1 | tr -d ' \n')" = 000000097048597300002e2300002e230178a53f76 ] || fail "$p: not 300 dpi"
  done
}
# PICTURE: differs from the one before
differs() { ! cmp -s "before.png" "out/$1" || fail "$1 is the same: $(cat log)"; }

makes "critical_state.png element.png mohr.png yield.png" run_0.5 run_1 run_1_again run_2
! grep -q '^no ' log || fail "a picture that is not made: $(cat log)"
cp out/element.png before.png
makes "critical_state.png element.png mohr.png yield.png" run_0.5 run_1 run_1_again run_2 --mean
differs element.png
makes element.png run_1
makes "element.png yield.png" run_1 run_1_again # one confining pressure
grep -q 'no mohr.png at the peak: peaks of q at 1 confining pressure; two are needed' log || fail "$(cat log)"
grep -q 'no critical_state.png: critical states at 1 confining pressure; three are needed' log || fail "$(cat log)"
cp -r run_2 caseless; rm caseless/resolved.prm
makes element.png run_1 caseless
grep -q 'no mohr.png, critical_state.png and yield.png: caseless/resolved.prm' log || fail "$(cat log)"

# Measured curves.
printf 'axial strain [%%],q [MPa],void ratio\n0,0,1.1\n0.4,5,1.1\n5,2.5,1.15\n' >lab.csv
printf 'q [kPa],axial strain [-],remark\n0,0,"wet, by hand"\n3000,,\n2500,0.05,\n' >other.csv
printf 'depth [mm],q_c [MPa]\n0,0\n1,3\n3,7\n' >cpt.csv
makes compare.png run_1 --compare lab.csv
grep -q 'run_1: strains from stage 2 on, triaxial' log || fail "$(cat log)"
cp out/compare.png before.png
makes compare.png run_1 --compare lab.csv --compare other.csv
grep -q "^other.csv: 'remark' holds text, which is not drawn$" log || fail "a column of text: $(cat log)"
differs compare.png
grep -q "other.csv: 1 of 3 values of 'axial strain' are missing" log || fail "$(cat log)"
makes compare.png run_1 --compare lab.csv --stage 1
differs compare.png
makes compare.png run_1 run_1_again --mean --compare lab.csv
makes "compare.png load.png" pile --compare cpt.csv
makes "compare.png load.png" pile --compare cpt.csv --label ours

# WHAT ARGUMENTS...: refused in one line, exit code 1, no picture
refused() {
  local what=$1 code=0
  shift
  rm -rf out
  "$view" --output out "$@" >log 2>&1 || code=$?
  [ $code -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q -- "$what" log && [ ! -e out ] || fail "wanted \"$what\", exit 1: $code $(cat log)"
}
printf 'axial strian [%%],q [MPa]\n1,2\n' >bad.csv
refused "bad.csv: 'axial strian' is no column of run_1/history.csv; did you mean 'axial strain'? There are 'time', 'stage'" run_1 --compare bad.csv
printf 'axial strain [%%],q\n1,2\n' >bad.csv
refused "'q' has no unit" run_1 --compare bad.csv
printf 'axial strain [%%],q [mm]\n1,2\n' >bad.csv
refused "wrong dimension" run_1 --compare bad.csv
printf 'axial strain [%%],q [MPa]\n' >bad.csv
refused "holds no record" run_1 --compare bad.csv
: >bad.csv
refused "bad.csv: holds no record" run_1 --compare bad.csv
printf 'axial strain [%%],q [MPa]\n1,two\n' >bad.csv
refused "'two' under 'q' is not a number" run_1 --compare bad.csv
refused 'nowhere.csv: cannot be read' run_1 --compare nowhere.csv
refused 'leave out --curve and --points' run_1 --compare lab.csv --curve "p:q"
refused 'is no column of pile/history.csv' pile --compare lab.csv
# An earlier version counted an unload-reload as two stages. Before it has begun the numbers are those of the case.
cp -r run_1 begun
sed -i 's/^  set stage 2 = .*/&\n  set stage 3 = unload-reload to q = 1 MPa/' begun/resolved.prm
makes element.png begun --stage 2
makes compare.png begun --compare lab.csv
cp -r begun old
awk -F, -v OFS=, 'NR > 150 { $2 = 3 } { print }' begun/history.csv >old/history.csv
makes element.png old
refused "old/history.csv: has no column 'part \[-\]'" old --stage 2
refused "old/history.csv: has no column 'part \[-\]'" old --compare lab.csv
refused "old/history.csv: has no column 'part \[-\]'" old --curve "axial strain:q" --stage 3
refused '--mean: is for element and triaxial runs' pile --mean
refused 'no two of the runs differ only by seed' run_1 run_2 --mean

echo "view_laboratory: all checks hold"
