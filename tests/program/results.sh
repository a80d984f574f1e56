# Sourced after preamble.sh by the scripts that read what a run has written.

# FOLDER NAME: the first value of this name in a summary
value() { awk -F': ' -v name="\"$2" 'index($1, name) { print $2 + 0; exit }' "$1/summary.json"; }

# FOLDER NAME LOW HIGH
within() {
  local v
  v=$(value "$1" "$2")
  awk -v v="$v" -v a="$3" -v b="$4" 'BEGIN { exit !(v >= a && v <= b) }' || fail "$1: $2 = $v, not in $3 to $4"
}

# FOLDER PROGRAM: awk over the records of a history, in which c("q [Pa]") is the value of this column and
# abs() the absolute value. A column that does not exist ends the test.
records() {
  local name
  while IFS= read -r name; do
    head -1 "$1/history.csv" | tr , '\n' | grep -qxF -- "$name" || { echo "$1/history.csv has no column \"$name\"" >&2; return 2; }
  done < <(grep -o 'c("[^"]*")' <<<"$2" | sed 's/^c("//; s/")$//')
  awk -F, 'function c(name) { return $at[name] + 0 }
    function abs(x) { return x < 0 ? -x : x }
    NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next } '"$2" "$1/history.csv"
}

# FOLDER OTHER...: the others have the same bytes in all its tables and fields
same_results() {
  local whole=$1 file other
  shift
  for other; do
    for file in "$whole"/*.csv "$whole"/fields/*; do
      cmp "$file" "$other/${file#"$whole"/}" || fail "$other/${file#"$whole"/} differs"
    done
  done
}
