#!/usr/bin/env bash
# What cannot be read or written is refused with the system's reason, exit code 1: a forbidden file is
# neither absent nor damaged, a file is no folder, a folder is no file.
#
# usage: tests/program/reasons.sh MERGEL
. "$(dirname "$0")/preamble.sh"
trap 'chmod -R u+rwX "$work"; rm -rf "$work"' EXIT
# PATTERN ARGUMENTS...
refused() {
  local what=$1 code
  shift
  code=$(code_of bounded "${rights[@]}" "$mergel" "$@")
  [ "$code" -eq 1 ] && grep -q -- "$what" log || fail "$*: wanted \"$what\", exit code 1: $code $(cat log)"
}
rights=()
bench=(bench --workload W1 --particles 200 --steps 4 --repeat 2)

"$mergel" sample "$case_file" "${tiny[@]}" --output made >log || fail "a specimen: $(tail -3 log)"
"$mergel" bond "$root/apps/cases/bond_fig5a.prm" --output bond >log || fail "a bond: $(tail -3 log)"
for folder in made bond; do "$mergel" info $folder >log || fail "info $folder: $(cat log)"; done

# Paths that cannot be, of whoever asks.
refused 'made/sample\.h5/x: cannot be read: Not a directory' info made/sample.h5/x
ln -s nowhere gone.h5
refused 'gone\.h5: there is no such file' info gone.h5
refused 'file = made/sample\.h5/x: .*cannot be read: Not a directory' pile "$case_file" --set "Specimen/file=made/sample.h5/x" --output none
refused 'file = gone\.h5: .*there is no such file' pile "$case_file" --set "Specimen/file=gone.h5" --output none
refused 'made/sample\.h5/history\.csv: cannot be read: Not a directory\|made/sample\.h5: is no folder' compare made/sample.h5 bond
cp -r bond odd; rm odd/history.csv; mkdir odd/history.csv
refused 'history\.csv: cannot be read: Is a directory' info odd
refused 't\.csv: the folder made/sample\.h5 is no folder' "${bench[@]}" --output made/sample.h5/t.csv
refused 't\.csv: the folder none does not exist' "${bench[@]}" --output none/t.csv
[ ! -e none ] || fail "something was written"

# What the permissions forbid. They do not bind root, without these rights.
[ "$(id -u)" -ne 0 ] ||
  rights=(setpriv --bounding-set=-dac_override,-dac_read_search --inh-caps=-dac_override,-dac_read_search)
echo x >ours; chmod 000 ours
if { [ "$(id -u)" -eq 0 ] && ! command -v setpriv >/dev/null; } || "${rights[@]}" cat ours >/dev/null 2>&1; then
  echo "reasons: all checks hold; permissions cannot be made to bind, and are left out"
  exit 0
fi
denied='cannot be read: Permission denied'
cp made/sample.h5 locked.h5; chmod 000 locked.h5
refused "locked\.h5: $denied" info locked.h5
refused "file = locked\.h5: .*$denied" pile "$case_file" --set "Specimen/file=locked.h5" --output none
mkdir closed; cp made/sample.h5 closed; chmod 000 closed
refused "closed/sample\.h5: $denied" info closed/sample.h5
refused "closed: $denied" info closed
refused "file = closed/sample\.h5: .*$denied" pile "$case_file" --set "Specimen/file=closed/sample.h5" --output none
refused "elasticity from = closed: .*$denied" pile "$case_file" --set "Far field/elasticity from=closed" --output none
refused "closed/history\.csv: $denied\|closed: $denied" compare closed bond
refused 't\.csv: .*cannot be written: Permission denied' "${bench[@]}" --output closed/t.csv
# FILE of a folder that is else whole: info names it with the reason.
forbidden() {
  rm -rf one; cp -r "$1" one
  chmod 000 "one/$2"
  refused "one/$2: $denied" info one
  chmod u+rwX "one/$2"
}
forbidden bond history.csv
forbidden bond summary.json
forbidden made fields
forbidden made fields/particles_0000.vtp
rm -rf one; cp -r made one; chmod 000 one/particles.pvd
refused 'particles\.pvd (Permission denied)' info one
chmod 644 one/particles.pvd; chmod 000 one/sample.h5
refused "sample\.h5 $denied" info one
cp -r made shut; chmod 555 shut
refused 'output folder shut: cannot be written: Permission denied' sample "$case_file" "${tiny[@]}" --output shut --overwrite
[ ! -e none ] || fail "something was written"
echo "reasons: all checks hold"
