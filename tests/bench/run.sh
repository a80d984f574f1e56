#!/usr/bin/env bash
# The rows of the table in README.md: both workloads at 5,000, 50,000 and 500,000 particles, and
# W1 with a tenth of its bonds yielding. Some eight minutes and 1 GB on one core.
#
# usage: tests/bench/run.sh MERGEL [TABLE.csv]
#   MERGEL     the program
#   TABLE.csv  gets all numbers, one line per row; default bench.csv; may exist
# Prints the rows in Markdown. The machine should have nothing else to do.
set -euo pipefail
[ $# -ge 1 ] || { sed -n '2,8s/^# \{0,1\}//p' "$0" >&2; exit 1; }
mergel=$(readlink -f "$1")
table=${2:-bench.csv}
before=0
[ -e "$table" ] && before=$(($(wc -l <"$table") - 1))

row() { "$mergel" bench --output "$table" "$@" >&2; }
row --particles 5000
row --particles 50000
row --particles 500000 --steps 500
row --particles 50000 --workload W1 --yielding 0.1

awk -F, -v skip="$before" -v day="$(date +%F)" '
  NR == 1 { for (k = 1; k <= NF; ++k) column[$k] = k; next }
  NR <= 1 + skip { next }
  {
    yields = $column["bonds yielding in a step [%]"]
    printf "| %s | | %s%s | %d | %d | %.0f (%.0f-%.0f) | %.0f | %.0f | %.1f |\n", day, $1,
      (yields > 0 ? sprintf(", %.0f %% yielding", yields) : ""), $column["particles [-]"],
      $column["ranks [-]"], $column["time per particle-step [ns]"],
      $column["time per particle-step smallest [ns]"], $column["time per particle-step largest [ns]"],
      $column["time per pair-step [ns]"], $column["memory per particle [byte]"],
      $column["triad [GB/s]"]
  }' "$table"
