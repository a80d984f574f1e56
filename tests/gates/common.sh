# Sourced by the gates. A gate runs from any folder, prints what is wrong as file:line and ends
# with 1, or prints one line and ends with 0. Settings from the environment: JOBS (jobs at a time).
set -euo pipefail
gate=$(basename "$0" .sh)
cd "$(dirname "$(readlink -f "$0")")/../.."
jobs=${JOBS:-$(nproc)}
# Clones of one user share what ccache holds.
export CCACHE_BASEDIR=${CCACHE_BASEDIR:-$PWD} CCACHE_NOHASHDIR=1

passed() { printf 'gate %-12s passed in %4d s: %s\n' "$gate" "$SECONDS" "$*"; }

failed()
{
  printf 'gate %s FAILED: %s\n' "$gate" "$*" >&2
  exit 1
}

needs()
{
  command -v "$1" >/dev/null || failed "$1 is not installed; ./bootstrap gates installs it"
}

# The sources under version control, and new ones that are not ignored. A clone may belong to
# another user (containers): git then wants to be told that it is safe.
sources()
{
  git -c safe.directory='*' ls-files --cached --others --exclude-standard -- '*.cc' '*.h' |
    while IFS= read -r file; do [ ! -e "$file" ] || printf '%s\n' "$file"; done
}

# All C++ in $files, and their number: a gate that sees no file has failed.
find_sources()
{
  mapfile -t files < <(sources)
  [ ${#files[@]} -gt 0 ] || failed "found no sources in $PWD"
}

# quietly COMMAND...: its output appears only if it fails.
quietly()
{
  local log code=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || code=$?
  [ "$code" -eq 0 ] || cat "$log" >&2
  rm -f "$log"
  return "$code"
}

# build_sanitized TARGET...: these targets (default: all) by clang in Debug with the sanitizers.
# Two gates share the folder, because one such build costs less than a plain one beside it. Each source by itself: it
# must include what it names.
build_sanitized()
{
  needs clang++
  quietly cmake --preset sanitize -DMERGEL_JOIN=OFF || failed "cmake --preset sanitize"
  local targets=()
  [ $# -eq 0 ] || targets=(--target "$@")
  quietly cmake --build build-sanitize --parallel "$jobs" "${targets[@]}" -- -k 0
}
