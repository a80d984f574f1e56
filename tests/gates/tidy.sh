#!/usr/bin/env bash
# Gate: clang-tidy finds nothing in the files of tidy_files.txt, a list that grows, nor in our
# headers that these include. What it looks for, and why: .clang-tidy.
#
# usage: tests/gates/tidy.sh [FILE...]   default: the list
. "$(dirname "$(readlink -f "$0")")/common.sh"
needs clang-tidy
needs clang++
files=("$@")
[ $# -gt 0 ] || mapfile -t files < <(grep -v '^#' tests/gates/tidy_files.txt)
for file in "${files[@]}"; do
  [ -e "$file" ] || failed "tests/gates/tidy_files.txt: $file does not exist"
done
# A folder of its own: clang-tidy cannot make precompiled headers, and looks at one source at a time.
quietly cmake --preset sanitize -B build-tidy -DMERGEL_PCH=OFF -DMERGEL_JOIN=OFF || failed "cmake --preset sanitize"

# What it prints of a clean file ("1234 warnings generated", all in system headers) is noise.
check()
{
  local out
  out=$(clang-tidy --quiet -p build-tidy "$1" 2>&1) || { printf '%s\n' "$out" >&2; return 1; }
}
export -f check
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'check "$0"' ||
  failed "clang-tidy finds what is above"
passed "${#files[@]} files are clean"
