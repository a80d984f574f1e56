#!/usr/bin/env bash
# A pile whose surface is read from an STL file: forces near those of the exact shape, the same bits on two ranks
# and after a restart, which needs no file, and refusals that change nothing on the disk.
#
# usage: tests/program/pile_surface.sh MERGEL
. "$(dirname "$0")/preamble.sh"
. "$root/tests/program/results.sh"

# A pile of 1.4 mm with a cone of 120 degrees, N chords around: stl N [LENGTH] [SIGN] [Y]
stl() {
  awk -v n="$1" -v L="${2:-3}" -v side="${3:-1}" -v y0="${4:-0}" '
    function corner(r, z, k) { return sprintf("%.9g %.9g %.9g", r * cos(k * a), r * sin(k * a) + y0, z) }
    function facet(p, q, s) {
      if (side < 0) { t = q; q = s; s = t }
      printf "facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n", p, q, s
    }
    BEGIN {
      a = 2 * atan2(0, -1) / n; R = 0.7; h = R / sqrt(3); print "solid pile"
      for (k = 0; k < n; ++k) {
        j = k + 1 < n ? k + 1 : 0
        facet(corner(0, 0, 0), corner(R, h, j), corner(R, h, k))
        facet(corner(R, h, k), corner(R, h, j), corner(R, L, j))
        facet(corner(R, h, k), corner(R, L, j), corner(R, L, k))
        facet(corner(R, L, k), corner(R, L, j), corner(0, L, 0))
      }
      print "endsolid pile"
    }'
}
stl 64 >pile.stl
sed -e '/set diameter *= 1.4 mm/d' -e 's/set cone angle .*/set tip = surface\n  set surface = pile.stl/' \
  -e 's/set final depth .*/set final depth = 0.15 mm/' "$case_file" >case.prm
tiny+=(--set "Output/frames=2")

guarded "$mergel" pile case.prm "${tiny[@]}" --set "Output/checkpoint every=2000 steps" --output a >log ||
  fail "the run: $(tail -3 log)"
grep -q '^pile: 256 triangles, 3 mm long; .* D_p = 1.39[0-9]* mm, the tip is 0.404[0-9]* mm high' log || fail "what was read is not said: $(cat log)"
within a "D_p [m]" 1.395e-3 1.4e-3
within a "largest energy error [-]" 0 5e-3
for k in 0 1 2; do
  grep -aq '<VTKFile type="PolyData"' "a/fields/pile_000$k.vtp" || fail "frame $k has no surface of the pile"
done

# Near the exact shape: facets of 64 chords lie 0.12 % of the radius below it.
guarded "$mergel" pile "$case_file" "${tiny[@]}" "${shallow[@]}" --output exact >log || fail "the exact shape: $(tail -3 log)"
mean() { records "$1" '{ sum += c("head force of the full pile [N]"); n += 1 } END { print sum / n }'; }
awk -v a="$(mean a)" -v b="$(mean exact)" 'BEGIN { print "mean head force over the exact one: " a / b; exit !(a > 0.8 * b && a < 1.25 * b) }' >ratio ||
  fail "not the force of the exact shape: $(cat ratio)"

# The same bits on two ranks, and from a checkpoint in the middle when the file is gone.
on_ranks 2 "$mergel" pile case.prm "${tiny[@]}" --output b >log || fail "two ranks: $(tail -3 log)"
mv pile.stl kept.stl
cp -r a c
checkpoints=(c/checkpoint_*.h5)
[ "${#checkpoints[@]}" -ge 2 ] || fail "no checkpoint in the middle"
guarded "$mergel" pile --restart "${checkpoints[0]}" --output d >log || fail "the restart: $(tail -3 log)"
same_results a b d
on_ranks 2 "$mergel" pile --restart b --set "Pile/final depth=0.16 mm" >log || fail "further on two ranks: $(tail -3 log)"
awk -F, 'END { exit !($2 > 0.159e-3) }' b/history.csv || fail "the pile was not pushed further: $(tail -1 b/history.csv)"
"$mergel" check a/resolved.prm >log 2>&1 || fail "a resolved case needs the file: $(cat log)"
mv kept.stl pile.stl

# Check and help know the keys.
"$mergel" check case.prm >log 2>&1 || fail "check: $(cat log)"
"$mergel" pile --help >log || fail "help: $(cat log)"
for key in surface "surface unit" "tip height"; do grep -q "^ *$key  " log || fail "help does not know \"$key\""; done

# Refusals: one line, and no folder.
refused() { # WHAT PATTERN SETTING...
  local what=$1 pattern=$2 options=() code
  shift 2
  for setting in "$@"; do options+=(--set "$setting"); done
  code=$(code_of "$mergel" pile case.prm "${tiny[@]}" "${options[@]}" --output none)
  [ "$code" -eq 1 ] && [ "$(grep -vc '^unusual: ' log)" -eq 1 ] && grep -Eq "$pattern" log && [ ! -e none ] || fail "$what: $code $(cat log)"
}
stl 16 3 -1 >other.stl
refused "inside out" 'Pile/surface = other\.stl: is inside out' "Pile/surface=other.stl"
stl 16 3 1 0.1 >other.stl
refused "not symmetric" 'Pile/surface = other\.stl: is not symmetric' "Pile/surface=other.stl"
stl 16 0.5 >other.stl
refused "too short" 'Pile/surface = other\.stl: the pile is 0\.5 mm long' "Pile/surface=other.stl"
sed '3,9d' pile.stl >other.stl
refused "a facet cut out" 'Pile/surface = other\.stl: ' "Pile/surface=other.stl"
head -c 1000 pile.stl >other.stl
refused "cut off" 'Pile/surface = other\.stl: .*other\.stl:[0-9]+: ' "Pile/surface=other.stl"
refused "no file" 'Pile/surface = none\.stl: .*No such file' "Pile/surface=none.stl"
refused "in inches" 'is `surface unit` right' "Pile/surface unit=inch"
refused "a diameter" 'Pile/diameter = 1\.4 mm: is a key of `tip`' "Pile/diameter=1.4 mm"
echo "pile surface: all checks hold; $(cat ratio)"
