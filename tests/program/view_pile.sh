#!/usr/bin/env bash
# mergel-view of a tiny pile run: the pictures of each of its frames, at 300 dpi; a measured load curve over
# load.png; a run without continuum fields.
#
# usage: tests/program/view_pile.sh MERGEL MERGEL_VIEW
if [ -z "${DISPLAY:-}" ]; then
  command -v xvfb-run >/dev/null || { echo "SKIPPED: neither a display nor xvfb-run"; exit 77; }
  # without -noreset the server restarts after each program and may refuse the next one
  exec xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" "$0" "$@"
fi
. "$(dirname "$0")/preamble.sh"
view=$(readlink -f "$2")
guarded "$mergel" pile "$case_file" "${tiny[@]}" --set "Pile/cone angle=120 degree" --set "Pile/final depth=2.3 mm" \
  --set "Output/frames=2" --output run >log || fail "the run: $(tail -3 log)"

# PICTURES ARGUMENTS...: makes these pictures and no others, each a PNG that states 300 dpi (11811 a metre)
makes() {
  local wanted=$1 picture
  shift
  rm -rf out
  "$view" --size 800x600 --output out "$@" >log 2>&1 || fail "$*: $(cat log)"
  [ "$(ls out | tr '\n' ' ')" = "$wanted " ] || fail "$*: wanted $wanted, made $(ls out | tr '\n' ' ')"
  for picture in out/*; do
    [ "$(head -c 8 "$picture" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$picture is no PNG"
    head -c 64 "$picture" | od -An -v -tx1 | tr -d ' \n' | grep -q 7048597300002e2300002e2301 || fail "$picture does not state 300 dpi"
  done
}
fields="chains.png damage.png displacement.png layers.png load.png paths.png porosity.png principal.png profiles.png shaft.png stress.png"
makes "$fields" run
cp -r out last
makes "${fields/shaft.png /}" run --frame 1 # the cone alone is in the ground
grep -q 'no shaft.png' log || fail "a frame without a ring: $(cat log)"
for picture in stress porosity layers principal chains profiles paths; do
  ! cmp -s "last/$picture.png" "out/$picture.png" || fail "$picture.png is the same at another frame"
done
makes "chains.png damage.png layers.png load.png porosity.png principal.png profiles.png stress.png" run --frame 0
grep -q 'no paths.png' log || fail "a frame before the tip has moved: $(cat log)"

# A measured curve is laid over the load, and changes no other run's picture.
printf 'depth [mm],head force [N]\n0,2\n0.8,9\n1.5,15\n' >lab.csv
makes "compare.png load.png" run --compare lab.csv
! cmp -s last/load.png out/load.png || fail "load.png does not show the measured curve"
printf 'depth [mm],Q [N]\n0,2\n1,3\n' >other.csv
code=0; "$view" --output out run --compare other.csv >log 2>&1 || code=$?
[ $code -eq 1 ] && grep -q "'Q' is no column" log || fail "an unknown heading: $code $(cat log)"

# A run of an earlier version has no fields.
rm run/fields.pvd run/contacts.pvd
makes "damage.png displacement.png load.png" run
grep -q 'no pictures of fields' log || fail "a run without fields: $(cat log)"
echo "view_pile: all checks hold"
