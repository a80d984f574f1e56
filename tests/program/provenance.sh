#!/usr/bin/env bash
# Results say by what they were made: program, date, host, ranks, command and case, in summary.json and
# resolved.prm; the program alone in files that have the same bits in every run.
#
# usage: tests/program/provenance.sh MERGEL
. "$(dirname "$0")/preamble.sh"

program=$("$mergel" version | awk 'NR == 1 { name = $0 } $1 == "commit" { sub(/^commit +/, ""); print name ", commit " $0 }')
# made FOLDER KEY: of "made by" in its summary.
made() { perl -MJSON::PP -0777 -e 'print decode_json(<STDIN>)->{"made by"}{$ARGV[0]}' "$2" <"$1/summary.json"; }
# stated FOLDER RANKS CASE: both files name all of it.
stated()
{
  [ "$(made "$1" program)" = "$program" ] || fail "$1: made by $(made "$1" program), not $program"
  [[ "$(made "$1" date)" =~ ^20[0-9]{2}-[0-9]{2}-[0-9]{2}T[0-9:]{8}Z$ ]] || fail "$1: made on $(made "$1" date)"
  [ "$(made "$1" host)" = "$(uname -n)" ] || fail "$1: made on host $(made "$1" host)"
  [ "$(made "$1" ranks)" = "$2" ] || fail "$1: made with $(made "$1" ranks) ranks"
  [ "$(made "$1" case)" = "$3" ] || fail "$1: case $(made "$1" case)"
  grep -q "^# made on 20.* on $(uname -n) with $2 rank.* by $program: .*$1.*; case " "$1/resolved.prm" ||
    fail "$1: resolved.prm says $(grep '^# made' "$1/resolved.prm")"
  [ "$(sed -n '1s/\..*//p' "$1/resolved.prm")" = '# The complete case of a run, defaults included' ] || fail "$1: its first words"
}

bond=$root/apps/cases/bond_fig5a.prm
"$mergel" bond "$bond" --output bond >log || fail "bond: $(cat log)"
stated bond 1 "$bond"

# The command can be given to a shell, whatever its words are.
"$mergel" bond "$bond" --set "Bond/effective modulus=0.3 GPa" --output "it's a
folder" >log || fail "bond, a strange folder: $(cat log)"
"$mergel" info "it's a
folder" >log || fail "info of it: $(cat log)"
command=$(made "it's a
folder" command)
mv "it's a
folder" first
bash -c "$command" >log || fail "the command of a run does not run again: $command"
cmp first/history.csv "it's a
folder/history.csv" || fail "the command of a run gives another one"
"$mergel" bond "it's a
folder/resolved.prm" --output again >log || fail "its resolved case: $(cat log)"

case_file=$root/apps/cases/pile_small.prm
tiny+=("${shallow[@]}" --set "Output/frames=1" --set "Output/checkpoint every=200 steps")
"$mergel" sample "$case_file" "${tiny[@]}" --output sample >log || fail "sample: $(cat log)"
stated sample 1 "$case_file"
on_ranks 2 "$mergel" pile "$case_file" "${tiny[@]}" --set "Specimen/file=sample/sample.h5" --output pile >log ||
  fail "pile: $(cat log)"
stated pile 2 "$case_file"
"$mergel" pile "$case_file" "${tiny[@]}" --set "Specimen/file=sample/sample.h5" --output alone >log || fail "pile: $(cat log)"
diff -r pile/fields alone/fields || fail "fields differ between runs"
for file in pile/fields/*.vtp; do
  grep -aq 'Name="made by"' "$file" || fail "$file names no program"
done
# deal.II's: the codes of the letters
codes=$(printf %s "$program" | od -An -v -tu1 | tr -s ' \n' ' ' | sed 's/^ //; s/ $//')
grep -aqF "$codes 0" pile/fields/far_field_0001.vtu || fail "far_field_0001.vtu names no program"

# A run in two starts names both.
"$mergel" pile --restart pile --set "Pile/final depth=0.17 mm" >log || fail "restart: $(cat log)"
[ "$(grep -c '^# made on ' pile/resolved.prm)" = 2 ] || fail "two starts: $(grep '^# made' pile/resolved.prm)"
[ "$(made pile ranks)" = 1 ] || fail "the last start"
[ "$(made pile case)" = "$PWD/pile" ] || fail "the case of a restart: $(made pile case)"
"$mergel" info pile >log || fail "info: $(cat log)"
grep -q "made by .*$program" log || fail "info does not say by what it was made: $(cat log)"

echo "provenance: results say by what they were made"
