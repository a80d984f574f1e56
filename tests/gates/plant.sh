#!/usr/bin/env bash
# Do the gates see what they are there for? Plants one fault at a time in a scratch copy of the
# working tree, and expects the gate to fail and to name the fault; before its first fault the gate
# must pass. Not in CI: ctest -L gates.
#
# usage: tests/gates/plant.sh [GATE...]   default: all that stand at the end of this file
# Prints one line a fault, then a count; exit code 1 if a gate did not do as it should.
set -euo pipefail
root=$(cd "$(dirname "$(readlink -f "$0")")/../.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
chosen=" $* "
n_checks=0 n_failed=0
export CCACHE_BASEDIR=$scratch # the objects of the working tree are in ccache under other paths

cd "$root"
git -c safe.directory='*' ls-files -z --cached --others --exclude-standard |
  tar --create --null --files-from=- --ignore-failed-read 2>/dev/null | tar --extract -C "$scratch"
cd "$scratch"
git init -q
git add --all
git -c user.name=scratch -c user.email=scratch@localhost commit -q -m "before any fault"
log=$scratch/.git/log

report()
{
  printf '%-6s %-14s %-44s %4d s\n' "$1" "$gate" "$2" $((SECONDS - began))
  if [ "$1" = FAILED ]; then
    n_failed=$((n_failed + 1))
    sed 's/^/        | /' "$log"
  fi
}

# gate NAME COMMAND...: the gate of the faults that follow; it must pass as the tree is.
gate()
{
  gate=$1
  shift
  command=("$@")
  is_chosen() { [ "$chosen" = "  " ] || [[ "$chosen" == *" $gate "* ]]; }
  is_chosen || return 0
  passes "as it is"
}

# passes WHAT: the gate must pass.
passes()
{
  is_chosen || return 0
  n_checks=$((n_checks + 1))
  began=$SECONDS
  if "${command[@]}" >"$log" 2>&1; then report green "$1"; else report FAILED "$1: is refused"; fi
}

# fault WHAT PATTERN: what is planted must make the gate fail, with a line that matches the extended
# regular expression PATTERN. Then the tree is as it was.
fault()
{
  if is_chosen; then
    local code=0
    n_checks=$((n_checks + 1))
    began=$SECONDS
    "${command[@]}" >"$log" 2>&1 || code=$?
    if [ "$code" -eq 0 ]; then
      report FAILED "$1: goes through"
    elif ! grep -Eq -- "$2" "$log"; then
      report FAILED "$1: not for this reason"
    else
      report red "$1"
    fi
  fi
  git checkout -q .
  git clean -q -f -d dem tests apps fem
}

## no build
gate line_length tests/gates/line_length.sh
printf '// %98s\n' . >dem/planted.h
fault "101 columns" '^dem/planted\.h:1: 101 characters'
printf '// %s\n' "$(printf '\303\244%.0s' {1..97})" >dem/planted.h # a umlaut
passes "100 characters of 197 bytes"
git clean -q -f dem

gate format tests/gates/format.sh
printf 'int  planted( int a );\n' >dem/planted.h
fault "two spaces" '^dem/planted\.h:1:'

gate include_rules tests/gates/include_rules.sh
printf '#include "apps/case/case_file.h"\n' >dem/math/planted.h
fault "dem includes apps" 'dem/math/planted\.h'
printf '#include "dem/planted.h"\n' >fem/planted.h
fault "fem includes dem" 'fem/planted\.h'
printf '#include <deal.II/base/tensor.h>\n' >dem/math/planted.h
fault "dem includes deal.II" 'dem/math/planted\.h'
printf '#include <deal.II/base/tensor.h>\n' >fem/planted.h
fault "fem outside fem/dealii includes deal.II" 'fem/planted\.h'
printf '#include <deal.II/base/tensor.h>\n' >apps/planted.h
fault "apps includes deal.II" 'apps/planted\.h'

printf '#include "dem/walls/mirror.h"\n' >dem/pairs/planted.h
fault "a lower floor includes a higher one" 'dem/pairs/planted\.h'
printf '#include "dem/io/state/checkpoint.h"\n' >dem/io/planted.h
fault "folders in a circle" 'dem/io/planted\.h'
printf 'std::vector<int> planted();\n' >dem/planted.h
fault "a name without its header" 'dem/planted\.h: names std::vector without #include <vector>'

gate words tests/gates/words.sh
printf '// The legs of a test.\n' >dem/planted.h
fault "a word of a comment" 'dem/planted\.h:1: "legs"'
printf 'int n_goals = 0;\n' >dem/planted.h
fault "a word in a name" 'dem/planted\.h:1: "goals"'
printf 'The ledger of a run.\n' >dem/planted.md
fault "a word of a page" 'dem/planted\.md:1: "ledger"'
printf 'const char* said = "share out the particles";\n' >apps/planted.h
fault "a word of a message" 'apps/planted\.h:1: "share out"'

## clang
listed=$(grep -v '^#' tests/gates/tidy_files.txt | head -n 1)
gate tidy tests/gates/tidy.sh "$listed"
printf '\ndouble planted(int a, int b)\n{\n  return a / b;\n}\n' >>"$listed"
fault "integer division kept as a double" "$listed:.*bugprone-integer-division"

gate clang tests/gates/clang.sh mergel_dem
cat >dem/planted.cc <<'TEXT'
class Planted {
  int planted_ = 0;
};
TEXT
fault "unused private field, which GCC lets through" 'dem/planted\.cc:2:.*Wunused-private-field'

gate sanitize tests/gates/sanitize.sh dem_unit
planted_test()
{
  printf '#include "tests/support/catch.h"\n#include <limits>\n#include <vector>\n' >"$1"
  printf 'TEST_CASE("planted", "[unit][dem]")\n{\n%s\n}\n' "$2" >>"$1"
}
planted_test tests/unit/dem/planted.cc '
  const std::vector<int> a(3);
  const volatile int behind = 3;
  CHECK(a.data()[behind] == a.data()[behind]);'
fault "read behind the end" 'AddressSanitizer: heap-buffer-overflow'
planted_test tests/unit/dem/planted.cc '
  volatile int a = std::numeric_limits<int>::max();
  a = a + 1;
  CHECK(a == a);'
fault "signed overflow" 'planted\.cc:[0-9:]+ runtime error: signed integer overflow'
planted_test tests/unit/dem/planted.cc '
  CHECK(new int(1) != nullptr);'
fault "memory left behind" 'LeakSanitizer: detected memory leaks'

## GCC and ctest
build() { cmake --preset release && cmake --build build --parallel "${JOBS:-$(nproc)}" --target "$1"; }
gate warnings build mergel_dem
printf 'int planted(int a)\n{\n  return 0;\n}\n' >dem/planted.cc
fault "unused parameter" 'dem/planted\.cc:1:.*Werror=unused-parameter'

build_and_test() { build dem_unit && ctest --test-dir build --no-tests=error -R '^dem unit:'; }
gate tests build_and_test
planted_test tests/unit/dem/planted.cc '
  CHECK(std::vector<int>(3).empty());'
fault "unit test that fails" 'dem unit: *planted \(Failed\)'

if [ "$n_checks" -eq 0 ]; then
  echo "plant.sh: no such gate: $*" >&2
  exit 1
fi
echo "$((n_checks - n_failed)) of $n_checks checks of the gates as they should be"
[ "$n_failed" -eq 0 ]
