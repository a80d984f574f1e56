#!/usr/bin/env bash
# What a new user tries first: no argument, help, version, a template, completion, pages of man.
#
# usage: tests/program/front_door.sh MERGEL
. "$(dirname "$0")/preamble.sh"
jobs=(bench bond brazilian check compare element info pile sample triaxial)
with_case=(bond brazilian element pile sample triaxial)
json() { perl -MJSON::PP -0777 -ne 'decode_json($_)' || fail "$1 is no JSON"; }

## nothing, help, version
[ "$(code_of "$mergel")" = 1 ] || fail "without a job: $(tail -1 log)"
for job in "${jobs[@]}"; do grep -q "^  $job " log || fail "without a job it lists no $job"; done
"$mergel" >out 2>/dev/null || true
[ ! -s out ] || fail "without a job something stands on standard output"
cmp <("$mergel" help) <("$mergel" --help) || fail "help and --help differ"
for job in "${jobs[@]}"; do
  cmp <("$mergel" help "$job") <("$mergel" "$job" --help) || fail "help $job and $job --help differ"
  "$mergel" "$job" --help | grep -q "^usage: mergel $job [^ ]" || fail "the usage of $job names no argument"
done
"$mergel" info --help | grep -qx 'usage: mergel info PATH' || fail "info --help lacks PATH"
[ "$(code_of "$mergel" help piel)" = 1 ] && grep -q 'Did you mean "pile"' log || fail "help piel: $(cat log)"
[ "$(code_of "$mergel" help pile element)" = 1 ] || fail "help with two jobs"
for option in version --version -V; do "$mergel" $option >"out.$option" || fail "$option"; done
cmp out.version out.--version && cmp out.version out.-V || fail "three versions"
grep -Eqx 'mergel [0-9]+\.[0-9]+\.[0-9]+' out.version && grep -Eq '^commit +([0-9a-f]{7,40} of 20[0-9-]+|unknown)' out.version ||
  fail "version: $(cat out.version)"
for word in compiler deal.II PETSc VTK HDF5 Eigen MPI; do grep -q "$word" out.version || fail "version names no $word"; done
grep -Eq 'deal.II [0-9.]+, PETSc [0-9.]+, VTK [0-9.]+, HDF5 [0-9.]+, Eigen [0-9.]+, CLI11 [0-9.]+' out.version ||
  fail "a library without its version: $(cat out.version)"

## repeated stages are one line
for job in element triaxial pile; do
  for form in --help --template; do
    "$mergel" $job $form | grep -E '^(  |[ #]+set )stage [0-9N]' >stages || fail "no stage: $job $form"
    [ "$(wc -l <stages)" -eq 1 ] || fail "stages are repeated: $job $form: $(cat stages)"
  done
done

## a terminal pages what is longer than it; a pipe never
on_terminal() { script -qec "stty rows 20; $*" /dev/null </dev/null | tr -d '\r'; }
cat >pager <<'PAGER'
#!/bin/sh
sed 's/^/paged: /'
PAGER
chmod +x pager
export PAGER=$PWD/pager
on_terminal "$mergel" help pile >paged
[ "$(grep -c '^paged: ' paged)" = "$("$mergel" help pile | wc -l)" ] || fail "help is not paged on a terminal: $(head -3 paged)"
on_terminal "$mergel" version >paged
grep -q '^mergel' paged || fail "a short text is paged"
! "$mergel" help pile | grep -q '^paged: ' || fail "help is paged into a pipe"
PAGER=no_such_program on_terminal "$mergel" help pile >paged
grep -q '^usage: mergel pile' paged || fail "without a pager nothing is printed"
PAGER= on_terminal "$mergel" help pile >paged
grep -q '^usage: mergel pile' paged || fail "PAGER= prints nothing"
unset PAGER

## JSON and templates
for job in "${with_case[@]}"; do
  "$mergel" "$job" --help --json >keys.json
  json "$job --help --json" <keys.json
  for word in section key unit default range meaning required; do
    grep -q "\"$word\": " keys.json || fail "$job --help --json lacks $word"
  done
done
for job in bench compare info check; do
  [ "$(code_of "$mergel" $job --help --json)" = 1 ] || fail "$job has keys"
  [ "$(code_of "$mergel" $job --template)" = 1 ] || fail "$job has a template"
done
# filled JOB CASE: the template of the job, with the values of the case where it gives some.
filled()
{
  "$mergel" "$1" --template | awk '
    function trim(s) { sub(/^[ \t]+/, "", s); sub(/[ \t]+$/, "", s); return s }
    { line = $0; sub(/#.*/, "", line); at = index(line, "=") }
    line ~ /^ *subsection / { section = line; sub(/^ *subsection /, "", section); section = trim(section) }
    line ~ /^ *set / && at { key = substr(line, 1, at - 1); sub(/^ *set +/, "", key); id = section "/" trim(key) }
    FNR == NR { if (line ~ /^ *set / && at) value[id] = trim(substr(line, at + 1)); next }
    line ~ /^ *set / && (line ~ /REQUIRED/ || id in value) { print substr(line, 1, at) " " value[id]; next }
    { print }' "$2" -
}
for pair in pile:pile_small element:element_small triaxial:triaxial_small brazilian:brazilian_small sample:sample_rock bond:bond_fig5a; do
  job=${pair%:*} case=${pair#*:}
  # A choice that is not the default makes other keys necessary: the user takes their '#' away.
  [ "$("$mergel" "$job" --template | grep -c 'set [a-z].*= REQUIRED')" -gt 0 ] || fail "$job: no required key is marked"
  "$mergel" "$job" --template >empty.prm
  [ "$(code_of "$mergel" "$job" empty.prm --output none)" = 1 ] && grep -q 'REQUIRED' log || fail "$job: a template that is not filled in: $(cat log)"
done
filled element "$root/apps/cases/element_small.prm" >element.prm
! grep -q 'REQUIRED *$' element.prm || fail "element: values are left"
"$mergel" check element.prm >log 2>&1 || fail "the template of element: $(cat log)"
filled triaxial "$root/apps/cases/triaxial_small.prm" >triaxial.prm
"$mergel" check triaxial.prm >log 2>&1 || fail "the template of triaxial: $(cat log)"
filled brazilian "$root/apps/cases/brazilian_small.prm" >brazilian.prm
"$mergel" check brazilian.prm >log 2>&1 || fail "the template of brazilian: $(cat log)"
filled pile "$root/apps/cases/pile_small.prm" >pile.prm
"$mergel" check pile.prm >log 2>&1 || fail "the template of pile: $(cat log)"
filled bond "$root/apps/cases/bond_fig5a.prm" | sed "s#path = bond#path = $root/apps/cases/bond#" >bond.prm
"$mergel" bond bond.prm --output bond >log 2>&1 || fail "the template of bond does not run: $(cat log)"
cp "$root/apps/cases/bond_fig5a.csv" .
"$mergel" bond "$root/apps/cases/bond_fig5a.prm" --output shipped >/dev/null
cmp bond/history.csv shipped/history.csv || fail "the template of bond, filled in as bond_fig5a.prm, gives another history"

## completion, as bash asks for it
"$mergel" completion bash >completion
[ "$(code_of "$mergel" completion zsh)" = 1 ] || fail "completion zsh"
# complete WORD...: what bash would offer for the last word.
complete_words()
{
  bash -c '. ./completion; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); compopt() { :; }; _mergel; printf "%s\n" "${COMPREPLY[@]}"' mergel-completion "$@"
}
[ "$(complete_words mergel tri)" = triaxial ] || fail "mergel tri<TAB>: $(complete_words mergel tri)"
[ "$(complete_words mergel help pi)" = pile ] || fail "mergel help pi<TAB>"
[ "$(complete_words mergel pile --res)" = --restart ] || fail "mergel pile --res<TAB>"
[ "$(complete_words mergel sample --wal)" = "" ] || fail "mergel sample --wal<TAB>"
[ "$(complete_words mergel pile --set '"Pile/fin')" = 'Pile/final depth=' ] || fail "mergel pile --set \"Pile/fin<TAB>: $(complete_words mergel pile --set '"Pile/fin')"
[ "$(complete_words mergel pile --set Pile/fin)" = 'Pile/final\ depth=' ] || fail "mergel pile --set Pile/fin<TAB>"
touch some.prm some.txt
complete_words mergel pile som | grep -qx some.prm && ! complete_words mergel pile som | grep -q some.txt || fail "cases: $(complete_words mergel pile som)"
# In a shell of one's own, by the key itself.
cat >rc <<'RC'
. ./completion
mergel() { echo "called with $*"; exit; }
PS1='ready '
RC
mkfifo keys
script -qec "bash --noprofile --rcfile rc -i" /dev/null <keys >interactive 2>&1 &
launched=$!
exec 3>keys
wait_for grep -q ready interactive
printf 'mergel tri\t\n' >&3
exec 3>&-
wait $launched || true
grep -q 'called with triaxial' interactive || fail "TAB in a shell: $(cat -v interactive)"

## pages of man
command -v groff >/dev/null || fail "groff, which formats the pages of man, is not installed (Debian: groff-base)"
for job in "" "${jobs[@]}"; do
  "$mergel" man $job >page.1
  groff -man -Tutf8 -ww page.1 >page.txt 2>warnings || fail "man $job"
  [ ! -s warnings ] || fail "man $job: $(head -3 warnings)"
  [ "$(wc -l <page.txt)" -gt 15 ] || fail "man $job has no text"
done
"$mergel" man pile | groff -man -Tutf8 | sed 's/\x1b\[[0-9;]*m//g; s/.\x08//g' >page.txt
for word in 'final depth' 'EXIT STATUS' '\-\-restart' 'SEE ALSO'; do grep -q -- "$word" page.txt || fail "man pile lacks $word"; done

echo "front door: help, version, templates, completion and pages are as they should be"
