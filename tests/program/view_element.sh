#!/usr/bin/env bash
# mergel-view of element tests: which pictures it makes of which runs, that each option changes
# them, and what it refuses before it makes any.
#
# usage: tests/program/view_element.sh MERGEL_VIEW
set -euo pipefail
view=$(readlink -f "$1")
if [ -z "${DISPLAY:-}" ]; then
  command -v xvfb-run >/dev/null || { echo "SKIPPED: neither a display nor xvfb-run"; exit 77; }
  # without -noreset the server restarts after each program and may refuse the next one
  exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$0" "$view"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() { echo "FAILED: $*"; exit 1; }
# FOLDER Q: 40 records of two stages, isotropic then with q up to Q times p
history() {
  mkdir -p "$1"
  awk -v Q="$2" 'BEGIN {
    OFS = ","; OFMT = "%.17g" # a stage counts from one start to round-off
    print "time [s],stage [-],axial strain [-],volumetric strain [-],axial strain of the stage [-],volumetric strain of the stage [-],p [Pa],q [Pa],void ratio [-]"
    for (k = 0; k < 40; ++k) {
      second = k >= 20; a = 1e-3 * k; v = 2e-3 * k
      if (second) { l = 1 - (1 - a) / (1 - 0.02); w = 1 - (1 - v) / (1 - 0.04) } else { l = a; w = v }
      p = 1e5 * (k + 1)
      print 1e-5 * k, 1 + second, a, v, l, w, p, (second ? Q * p * (k - 20) / 20 : 0), 0.9 - 4e-3 * k
    }
  }' >"$1/history.csv"
}
# FOLDER: history of a triaxial test, whose strains are those of its middle third
triaxial() {
  history "$1" 1.2
  sed -i -e '1s/,volumetric strain of the stage \[-\]/,cell pressure [Pa]/; 1s/,volumetric strain \[-\]/,volumetric strain of the middle third [-]/' "$1/history.csv"
}
# FOLDER: history of a pile
pile() {
  mkdir -p "$1"
  printf 'time [s],depth/D_p [-],q_c [Pa],bonds broken [-]\n0,0,0,0\n1e-3,1,2e6,30\n' >"$1/history.csv"
}
history iso 0.005
history sheared 1.2
pile pile
triaxial cell
triaxial cell2
sed -i 's/,0.8[0-9]*$/,0.85/' cell2/history.csv
printf '# critical states\np [MPa],q [kPa]\n1,1200\n3,3500\n' >points.csv

# PICTURE ARGUMENTS...: makes this picture and no other
makes() {
  local picture=$1
  shift
  rm -rf out
  "$view" --size 800x600 --output out "$@" >log 2>&1 || fail "$*: $(cat log)"
  [ "$(ls out)" = "$picture" ] || fail "$*: wanted $picture, made $(ls out)"
  [ "$(head -c 8 "out/$picture" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$*: no PNG"
}
# as makes, and the picture differs from the one before
differs() {
  cp "out/$1" before.png
  makes "$@"
  ! cmp -s before.png "out/$1" || fail "$*: the picture is the same"
}
# Two cycles of unloading and reloading in the second stage.
mkdir cycles
awk -F, -v OFS=, 'NR == 1 { print $0, "part [-]", "cycle [-]"; next }
  { k = NR - 22; loop = k >= 0; print $0, (loop ? 1 + int(k / 5) % 2 : 0), (loop ? 1 + int(k / 10) : 0) }' sheared/history.csv >cycles/history.csv
makes isotropic.png iso
makes element.png sheared
makes element.png iso sheared # one sheared run is enough for the panels of q
makes element.png sheared
differs element.png sheared --stage 2
differs element.png sheared --stage 2 --points points.csv
makes element.png cycles --stage 2b
differs element.png cycles --stage 2a
differs element.png cycles --stage 2a-2a
differs element.png cycles --stage "2a of cycle 2"
makes triaxial.png cell
differs triaxial.png cell --stage 2
differs triaxial.png cell cell --label a --label b
makes element.png cell sheared # a cylinder beside a periodic cell
differs element.png cell cell2 sheared
makes isotropic.png cell --stage 1-1
grep -q 'no specimen.png' log || fail "a triaxial test without fields: $(cat log)"
makes isotropic.png sheared --stage 1-1 # only the stage before the shearing
makes curve.png sheared --curve "axial strain:q/p"
differs curve.png sheared --curve "axial strain:q/p [%]"
differs curve.png sheared --curve "log p [kPa]:void ratio" --curve "time:stage"
makes curve.png pile pile --label a --label b --curve "depth/D_p:q_c"
history one 1; for k in 2 3 4 5 6 7 8; do cp -r one run$k; done
makes element.png one run{2,3,4,5,6,7,8}

# WHAT ARGUMENTS...: refused in one line, exit code 1, no picture
refused() {
  local what=$1 code=0
  shift
  rm -rf out
  "$view" --output out "$@" >log 2>&1 || code=$?
  [ $code -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q -- "$what" log && [ ! -e out ] ||
    fail "wanted \"$what\", exit 1: $code $(cat log)"
}
refused 'sheared holds an element run and pile a pile run' sheared pile
refused '--leg is now --stage' sheared --leg 2
refused '--leg is now --stage' sheared --leg=2-3
refused '--stage 3-1: must be the number' sheared --stage 3-1
refused 'no record of stage 3; the last is 2' sheared --stage 3
refused '--stage 1: is for element and triaxial runs' pile --stage 1
refused '--frame 0: is for' sheared --frame 0
refused '--label: given 1 times for 2' sheared iso --label a
refused "no column 'Q'" sheared --curve "p:Q"
refused 'wrong dimension' sheared --curve "p [mm]:q"
refused 'with a colon between' sheared --curve "p"
refused 'are the axes of no panel' sheared --curve "p:void ratio" --points points.csv
refused 'are the axes of no panel' iso --points points.csv
refused '--points points.csv: is for element, triaxial and Brazilian runs' pile --points points.csv
refused 'cannot be read' sheared --points nowhere.csv
printf '1,2\n3,4\n' >bare.csv
refused 'with their names above' sheared --points bare.csv

# A picture replaces an earlier one, and no file of the user.
makes element.png sheared
"$view" --output out sheared >log 2>&1 || fail "a picture made again: $(cat log)"
echo mine >out/element.png
code=0; "$view" --output out sheared >log 2>&1 || code=$?
[ $code -eq 1 ] && grep -q 'out/element.png: exists, and this version of mergel-view has not made it' log &&
  [ "$(cat out/element.png)" = mine ] || fail "a picture of the user: $code $(cat log)"
echo mine >sheared/element.png # in the folder of its run too
code=0; "$view" sheared >log 2>&1 || code=$?
[ $code -eq 1 ] && grep -q 'sheared/element.png: exists, and this version of mergel-view has not made it' log &&
  [ "$(cat sheared/element.png)" = mine ] || fail "a picture of the user beside its run: $code $(cat log)"
rm sheared/element.png

# What the permissions forbid is neither absent nor a full disk. They do not bind root, without these rights.
bound() {
  if [ "$(id -u)" -ne 0 ]; then "$@"
  else setpriv --bounding-set=-dac_override,-dac_read_search --inh-caps=-dac_override,-dac_read_search "$@"; fi
}
forbidden() {
  local what=$1 code=0
  shift
  bound "$view" "$@" >log 2>&1 || code=$?
  [ $code -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q -- "$what" log || fail "wanted \"$what\", exit 1: $code $(cat log)"
}
refused 'sheared/history.csv/here: is no folder' sheared/history.csv/here
trap 'chmod -R u+rwX "$work"; rm -rf "$work"' EXIT
echo x >ours; chmod 000 ours
if [ "$(id -u)" -eq 0 ] && ! command -v setpriv >/dev/null || bound cat ours >/dev/null 2>&1; then
  echo "view_element: permissions cannot be made to bind, and are left out"
else
  chmod 555 sheared
  forbidden 'sheared: cannot be written: Permission denied\. Choose another folder with --output' sheared
  makes element.png sheared
  mkdir kept; chmod 555 kept
  forbidden '--output kept: cannot be written: Permission denied\. Choose another folder' --output kept sheared
  chmod 755 sheared; chmod 000 sheared/history.csv
  forbidden 'sheared/history\.csv: cannot be read: Permission denied\. Check its permissions' --output out sheared
  chmod 644 sheared/history.csv; chmod 000 sheared
  forbidden 'sheared: cannot be read: Permission denied' --output out sheared
fi

# The page of --help that cannot be printed is said; a reader that has seen enough is no loss.
for closed in '>/dev/full' '>&-'; do
  code=0
  eval "\"\$view\" --help 2>log $closed" || code=$?
  [ $code -eq 2 ] && grep -q '^mergel-view: the standard output cannot be written: ' log || fail "--help $closed: exit code $code: $(cat log)"
done
{ code=0; "$view" --help 2>log || code=$?; echo $code >code; } | true
[ "$(cat code)" = 0 ] && [ ! -s log ] || fail "--help, not read: exit code $(cat code): $(cat log)"

echo "view_element: all checks hold"
