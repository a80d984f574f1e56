#!/usr/bin/env bash
# A run that is continued after its project folder, its size table or its older results have gone: a
# path is no identity, and what a restart does not need is not read. The same bits from there on.
#
# usage: tests/program/moved.sh MERGEL
. "$(dirname "$0")/preamble.sh"
element() { bounded "$mergel" element "$@"; }
has_lines() { [ "$(cat "$1/history.csv" 2>/dev/null | wc -l)" -ge "$2" ]; }
same() {
  cmp whole/history.csv "$1/history.csv" || fail "$1: the history differs"
  diff -r whole/fields "$1/fields" >/dev/null || fail "$1: the fields differ"
  "$mergel" info "$1" >info && grep -q 'results folder, finished' info || fail "$1: $(cat info)"
}

# A project: a case, beside it the size table that it names, and a run that was stopped.
mkdir project
printf 'diameter [mm],passing [%%]\n0.07,0\n0.1,40\n0.13,100\n' >project/sizes.csv
sed -e '/set smallest diameter/d; /set largest diameter/d' \
  -e 's/set sizes .*/set sizes = table\n  set size table = sizes.csv/' \
  -e 's/\(set edge [xyz] *=\).*/\1 3.5 mm/' \
  -e "s/set porosity .*/set porosity = 0.56/" -e 's/set stage 1 .*/set stage 1 = isotropic to p = 0.4 MPa/' \
  -e 's/set stage 2 .*/set stage 2 = triaxial to axial strain = 0.6 %/' -e '/set stage [34]/d' \
  "$root/apps/cases/element_small.prm" >project/case.prm
element project/case.prm --output whole >log || fail "the whole run: $(tail -3 log)"
launch "$mergel" element project/case.prm --output project/run >log 2>&1
signal_when TERM has_lines project/run $(($(wc -l <whole/history.csv) / 4))
code=0; wait $launched || code=$?
[ "$code" -eq 2 ] || fail "the stopped run: exit code $code: $(tail -3 log)"

# The whole project moved: from the folder alone, and with the case that moved too.
mv project moved
for arguments in "" moved/case.prm; do
  rm -rf one; cp -r moved/run one
  # shellcheck disable=SC2086
  element $arguments --restart one >log || fail "a moved project, case \"$arguments\": $(tail -3 log)"
  same one
done
# The table gone, or another one in its place: the checkpoint knows the curve.
mv moved/sizes.csv kept.csv
for arguments in "" moved/case.prm; do
  rm -rf one; cp -r moved/run one
  # shellcheck disable=SC2086
  element $arguments --restart one >log || fail "no table, case \"$arguments\": $(tail -3 log)"
  same one
done
sed 's/0.1,40/0.1,50/' kept.csv >moved/sizes.csv
rm -rf one; cp -r moved/run one
element --restart one >log || fail "another table: $(tail -3 log)"
same one
# A case that asks for that one is another case, whatever the path.
for arguments in "moved/case.prm" "--set Specimen/size\ table=moved/sizes.csv"; do
  rm -rf one; cp -r moved/run one
  [ "$(eval "code_of element $arguments --restart one")" -eq 1 ] && grep -q 'Specimen/size table sum' log ||
    fail "another table is asked for by $arguments: $(cat log)"
done
# The same table elsewhere is the same.
rm moved/sizes.csv
rm -rf one; cp -r moved/run one
element --restart one --set "Specimen/size table=kept.csv" >log || fail "the same table elsewhere: $(tail -3 log)"
same one
# A run repeated from its resolved case needs no table either; a changed one is refused.
element whole/resolved.prm --output again >log || fail "from the resolved case: $(tail -3 log)"
cmp whole/history.csv again/history.csv || fail "from the resolved case the history differs"
mkdir project
sed 's/0.1,40/0.1,50/' kept.csv >project/sizes.csv
[ "$(code_of element whole/resolved.prm --output none)" -eq 1 ] &&
  grep -q 'size table sum.*was changed after this case was resolved' log || fail "a changed table: $(cat log)"
rm -r project

# A checkpoint alone in a new folder: the history begins there, the series list what is there.
mkdir alone
cp "$(compgen -G "moved/run/checkpoint_*.h5" | sort | tail -1)" alone
element --restart alone >log || fail "a checkpoint alone: $(tail -3 log)"
grep -q '^alone/history.csv: is missing, and begins at the checkpoint$' log || fail "a checkpoint alone: $(cat log)"
grep -q '^of [0-9]* frames before the checkpoint [0-9]* are missing in alone/fields: ' log || fail "a checkpoint alone: $(cat log)"
n=$(($(wc -l <alone/history.csv) - 2)) # below a remark and the heading
[ "$n" -gt 2 ] || fail "a checkpoint alone: $n lines of history"
cmp <(head -1 whole/history.csv; tail -n $n whole/history.csv) <(tail -n +2 alone/history.csv) || fail "a checkpoint alone: the history differs"
for file in alone/fields/*; do cmp "$file" "whole/${file#alone/}" || fail "a checkpoint alone: $file differs"; done
[ "$(grep -c '<DataSet' alone/particles.pvd)" -eq "$(ls alone/fields/particles_* | wc -l)" ] || fail "a checkpoint alone: its series"
diff <(physics whole) <(physics alone) || fail "a checkpoint alone: the summary"
"$mergel" info alone >info && grep -q 'results folder, finished' info || fail "a checkpoint alone: $(cat info)"
# Continued once more from the same checkpoint, as after a kill: the same.
cp alone/history.csv once.csv
element --restart alone >log || fail "a checkpoint alone, twice: $(tail -3 log)"
cmp once.csv alone/history.csv || fail "a checkpoint alone, twice: the history differs"
# The same into another folder, and from a folder that lacks one older frame.
element --restart "$(compgen -G "moved/run/checkpoint_*.h5" | sort | tail -1)" --output other >log || fail "elsewhere: $(tail -3 log)"
same other
rm -rf one; cp -r moved/run one; rm one/fields/particles_0000.vtp
element --restart one >log || fail "an older frame is missing: $(tail -3 log)"
grep -q '^of [0-9]* frames before the checkpoint 1 are missing in one/fields: ' log || fail "an older frame: $(cat log)"
cmp whole/history.csv one/history.csv || fail "an older frame is missing: the history differs"
grep -q 'particles_0000' one/particles.pvd && fail "a series names a frame that is not there"
"$mergel" info one >info || fail "an older frame is missing: $(cat info)"
echo "moved: all checks hold"
