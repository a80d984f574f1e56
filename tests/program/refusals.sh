# Sourced after preamble.sh by the scripts that expect refusals. Each sets case_file, a good case, and good_job when it is not
# the pile; good.prm is a copy of it in the working folder.
good_job=${good_job:-pile}
n_checks=0 n_failed=0

# Names and contents of all files below the working folder.
tree() { find . -mindepth 1 -printf '%y %p %l\n' -type f -exec cksum {} + | sort; }

fail()
{
  n_failed=$((n_failed + 1))
  printf 'FAILED  %s: %s\n' "$name" "$1"
  sed 's/^/        | /' "$log"
}

# refuse NAME PATTERN ARGUMENT...: mergel ARGUMENT... must be refused with one line that matches
# the extended regular expression PATTERN as a whole.
refuse()
{
  local name=$1 pattern=$2 before code=0
  shift 2
  local log=$work.log
  n_checks=$((n_checks + 1))
  before=$(tree)
  bounded "$mergel" "$@" >"$log" 2>&1 </dev/null || code=$?
  # Progress, where a refusal takes long, and what is unusual of a case that could be read.
  sed -i -E '/^specimen +[0-9.]+ %/d; /^unusual: /d' "$log"
  if [ "$code" -ne 1 ]; then
    fail "exit code $code, not 1"
  elif [ "$(wc -l <"$log")" -ne 1 ]; then
    fail "not one line"
  elif ! grep -Eqx -- "$pattern" "$log"; then
    fail "does not match $pattern"
  elif [ "$(tree)" != "$before" ]; then
    diff <(echo "$before") <(tree) >>"$log" || true
    fail "the disk is changed"
  fi
  rm -f "$log"
}

# refuse_set NAME PATTERN SETTING...: the same for --set over the good case.
refuse_set()
{
  local name=$1 pattern=$2 options=() setting
  shift 2
  for setting in "$@"; do options+=(--set "$setting"); done
  refuse "$name" "$pattern" "$good_job" good.prm "${options[@]}" --output out
}

# edited NAME SED: the good case, edited; it must differ.
edited()
{
  sed -E "$2" good.prm >"$1"
  if cmp -s good.prm "$1"; then
    echo "$(basename "$0"): \"$2\" changes nothing in $case_file" >&2
    exit 1
  fi
}

# In a file a relative path starts at the folder of the file: keep those of the good case valid.
sed -E "s#^([[:space:]]*set[^=]*=[[:space:]]*)(\.\.?/)#\1$(dirname "$case_file")/\2#" \
  "$case_file" >good.prm
