#!/usr/bin/env bash
# The pictures of dem/laws/README.md: the paper's Figs. 4 and 5 from apps/cases/bond_*.prm.
#
# usage: tests/validation/bond_figures.sh MERGEL MERGEL_VIEW [FOLDER]
#   FOLDER  takes the pictures; default dem/laws
# Without a display: xvfb-run -a tests/validation/bond_figures.sh ...
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,6s/^# \{0,1\}//p' "$0" >&2; exit 1; }
root=$(cd "$(dirname "$0")/../.." && pwd)
mergel=$(readlink -f "$1") view=$(readlink -f "$2")
pictures=$(readlink -f "${3:-$root/dem/laws}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

run() { for name; do "$mergel" bond "$root/apps/cases/bond_$name.prm" --output "$name"; done; }
# picture FROM TO VIEW_ARGUMENT...
picture()
{
  local from=$1 to=$2
  shift 2
  "$view" "$@" --output drawn
  mv "drawn/$from" "$pictures/$to"
}

run fig4a_compression_ga{1.5,1.0,0} fig4a_tension fig4b_tension fig4b_compression fig5a fig5b
picture loads.png fig4a_compression.png fig4a_compression_ga{1.5,1.0,0} \
  --label "g_a = 1.5 mm" --label "g_a = 1 mm" --label "g_a = 0" --size 1400x1050
picture loads.png fig4a_tension.png fig4a_tension --size 1400x1050
picture loads.png fig4b.png fig4b_tension fig4b_compression --label tension --label compression --size 1400x1050
picture surface.png fig5a.png fig5a --size 1400x1050
picture surface.png fig5b.png fig5b
