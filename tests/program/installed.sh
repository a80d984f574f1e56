#!/usr/bin/env bash
# The program as it is installed: below a prefix of its own, with its pages, completion and cases.
#
# usage: tests/program/installed.sh MERGEL BUILD_FOLDER
build=$(readlink -f "$2")
. "$(dirname "$0")/preamble.sh"

# Only what is built: mergel-view may not be there yet.
mkdir prefix
cmake --install "$build" --prefix "$work/prefix" >log 2>&1 || {
  grep -q 'mergel-view' log && fail "mergel-view is not built: build all before this test: $(tail -2 log)"
  fail "cmake --install: $(tail -3 log)"
}
for file in bin/mergel share/man/man1/mergel.1 share/man/man1/mergel-pile.1 share/bash-completion/completions/mergel \
  share/mergel/apps/cases/pile_small.prm share/mergel/apps/cases/README.md share/mergel/meshes/psd/maastricht.csv \
  share/mergel/apps/batch/run.sbatch share/doc/mergel/README.md share/doc/mergel/apps/pile/README.md share/doc/mergel/LICENSE; do
  [ -s "prefix/$file" ] || fail "$file is not installed"
done
cd "$work"
PATH=$work/prefix/bin:$PATH
[ "$(command -v mergel)" = "$work/prefix/bin/mergel" ] || fail "mergel is $(command -v mergel)"
cmp <(mergel version) <("$mergel" version) || fail "another version is installed"
mergel bond prefix/share/mergel/apps/cases/bond_fig5a.prm --output bond >log || fail "the installed program: $(cat log)"
[ -s prefix/lib*/mergel/libmergel_dealii.so ] || [ -s prefix/lib/*/mergel/libmergel_dealii.so ] ||
  fail "the library of the meshes is not installed"
mergel pile "$case_file" "${tiny[@]}" "${shallow[@]}" --output pile >log 2>&1 || fail "a job with a mesh: $(tail -3 log)"
mergel check prefix/share/mergel/apps/cases/sample_rock.prm >log || fail "a case that names a file beside it: $(cat log)"

command -v man >/dev/null || command -v groff >/dev/null ||
  fail "neither man nor groff is installed, to format the pages (Debian: groff-base)"
for page in prefix/share/man/man1/*.1; do
  if command -v man >/dev/null; then
    LC_ALL=C.UTF-8 MANWIDTH=80 man --warnings -l "$page" >text 2>warnings </dev/null || fail "man -l $page: $(cat warnings)"
  else
    groff -man -Tutf8 -ww "$page" >text 2>warnings || fail "$page: $(cat warnings)"
  fi
  [ ! -s warnings ] || fail "$page: $(head -2 warnings)"
  grep -q 'EXIT STATUS' text || fail "$page has no text"
done

# By the shell itself, as bash-completion loads the file.
offered=$(bash -c '. prefix/share/bash-completion/completions/mergel
  COMP_WORDS=(mergel tri) COMP_CWORD=1; _mergel; echo "${COMPREPLY[@]}"')
[ "$offered" = triaxial ] || fail "mergel tri<TAB> gives \"$offered\""

echo "installed: program, pages, completion and cases are where they should be"
