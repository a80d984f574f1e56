#!/usr/bin/env bash
# deal.II is loaded with the first mesh and not before: the program starts and runs jobs without a mesh where its
# library is missing, damaged or of another build, and a job with a mesh then says so and writes nothing.
#
# usage: tests/program/mesh_library.sh MERGEL
. "$(dirname "$0")/preamble.sh"
library=libmergel_dealii.so
bond=(bond "$root/apps/cases/bond_fig5a.prm")
pile=(pile "$case_file" "${tiny[@]}" "${shallow[@]}" --output "$work/out")

ldd "$mergel" >of_program
ldd "$(dirname "$mergel")/$library" >of_library
if grep -iq 'deal.ii' of_program; then fail "the program itself is linked with deal.II"; fi
grep -iq 'deal.ii' of_library || fail "$library is not linked with deal.II"
# A name that it shared with another library would be taken from the one that was loaded first.
names=$(nm -D --defined-only "$(dirname "$mergel")/$library" | awk '{ print $NF }')
[ "$(sort <<<"$names" | xargs)" = "mergel_build mergel_mesh_library" ] || fail "$library shows other names: $(head -3 <<<"$names")"

mkdir bin
cp "$mergel" bin/mergel
refused() { # WHAT MESSAGE
  [ "$(code_of bin/mergel "${bond[@]}" --output "bond $1")" -eq 0 ] || fail "$1: a job without a mesh: $(cat log)"
  for n in 1 2; do
    code=0
    on_ranks $n bin/mergel "${pile[@]}" >log 2>&1 || code=$?
    [ $code -eq 2 ] || fail "$1 on $n ranks: exit code $code: $(tail -3 log)"
    grep -Eq "^$2" log || fail "$1 on $n ranks: $(tail -3 log)" # once, and not as "rank N: ..."
    for file in history.csv sample.h5 fields; do [ ! -e "out/$file" ] || fail "$1: there is $file"; done
    rm -rf out
  done
}
refused "no library" "the finite-element library of the program is missing: there is no $work/bin/$library and no $work/lib.*/mergel/$library\. "
folder=$(sed -n "s|.* and no \($work/lib.*\)/$library\..*|\1|p" log | head -1)
echo "no library" >bin/$library
refused "a damaged library" "the finite-element library cannot be loaded: $work/bin/$library.*"
sed 's/mergel \([0-9.]*, [A-Z]\)/other! \1/' "$(dirname "$mergel")/$library" >bin/$library
cmp -s bin/$library "$(dirname "$mergel")/$library" && fail "the library does not name its build"
refused "a library of another build" "$work/bin/$library: is of .*, the program is of .*Build or install both together\."

# Installed, it is in another folder.
rm bin/$library
mkdir -p "$folder"
cp "$(dirname "$mergel")/$library" "$folder"
[ "$(code_of bin/mergel "${pile[@]}")" -eq 0 ] || fail "installed: $(tail -3 log)"
echo "the program starts without $library, and names it where a mesh needs it"
