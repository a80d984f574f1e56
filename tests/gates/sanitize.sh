#!/usr/bin/env bash
# Gate: the unit tests pass in Debug under the address and undefined-behaviour sanitizers.
#
# usage: tests/gates/sanitize.sh [PROGRAM...]   default: all programs with unit tests
. "$(dirname "$(readlink -f "$0")")/common.sh"
programs=("$@")
[ $# -gt 0 ] || programs=(dem_unit fem_tests apps_unit view_unit)
build_sanitized "${programs[@]}" || failed "the unit tests do not compile"

export DEAL_II_NUM_THREADS=1 # as in tests/CMakeLists.txt

# A process a program: it starts once, and stops at the first thing that a sanitizer reports.
run()
{
  local log code=0
  log=$(mktemp)
  (ulimit -t 3000 && exec "build-sanitize/$1" "[unit]") >"$log" 2>&1 || code=$? # processor time
  if [ "$code" -ne 0 ]; then
    printf '%s ended with %d\n' "$1" "$code" | cat "$log" - >&2
  fi
  rm -f "$log"
  [ "$code" -eq 0 ]
}
export -f run
printf '%s\0' "${programs[@]}" | xargs -0 -n 1 -P "$jobs" bash -c 'run "$0"' ||
  failed "see above"
passed "unit tests of ${programs[*]}"
