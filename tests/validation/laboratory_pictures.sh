#!/usr/bin/env bash
# The pictures of tests/validation/README.md, from the runs of laboratory.sh.
#
# usage: tests/validation/laboratory_pictures.sh MERGEL_VIEW FOLDER [PICTURES]
#   FOLDER    of laboratory.sh
#   PICTURES  takes them; default tests/validation
# Without a display: xvfb-run -a tests/validation/laboratory_pictures.sh ...
set -euo pipefail
[ $# -ge 2 ] || { sed -n '2,7s/^# \{0,1\}//p' "$0" >&2; exit 1; }
pictures=$(readlink -f "${3:-$(dirname "$0")}")
view=$(readlink -f "$1")
cd "$2"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# picture FROM TO VIEW_ARGUMENT...
picture() {
  local from=$1 to=$2
  shift 2
  "$view" "$@" --output "$work/drawn" >/dev/null
  mv "$work/drawn/$from" "$pictures/$to"
}
# points FILE LABEL "X,Y" AWK-PROGRAM TABLE: rows of a table as points
points() {
  { echo "# $2"; echo "$3"; awk -F, "$4" "$5"; } >"$work/$1.csv"
}

picture isotropic.png fig14a.png bands/iso_published_1 bands/iso_conjugate_1 bands/unbonded_1 \
  --label "published flow" --label "conjugate flow" --label unbonded --size 1500x800
picture element.png fig14b.png bands/tx1_published_1 bands/tx4_published_1 bands/tx1_conjugate_1 bands/tx4_conjugate_1 --stage 2 \
  --label "1 MPa, published" --label "4 MPa, published" --label "1 MPa, conjugate" --label "4 MPa, conjugate"

confined=(0.25 0.5 1 1.5 2.5 4 6)
labels=()
for p in "${confined[@]}"; do labels+=(--label "$p MPa"); done
points yield "yield (offset 0.02 %)" "p [Pa],q [Pa]" '$1 == "published" { print $2 * 1e6 + $3 / 3 "," $3 }' fig15.csv
points end "at 20 %" "p [Pa],void ratio [-]" '$1 == "published" && $2 > 0 { print $8 "," $9 }' fig15.csv
picture element.png fig15.png "${confined[@]/#/fig15/published_}" --stage 2 "${labels[@]}" --points "$work/yield.csv" --points "$work/end.csv"
picture curve.png fig15b.png "${confined[@]/#/fig15/published_}" --stage 2 "${labels[@]}" --curve "axial strain:q/p" --size 1100x700

for rock in dense loose; do
  picture isotropic.png fig8_$rock.png fig8/${rock}_published_{2,5,10,20} --label "2 mrad" --label "5 mrad" --label "10 mrad" --label "20 mrad" --size 1500x800
done
picture isotropic.png fig9b.png fig9b/published_{0,0.01,0.1,0.2} --label "g_a = 0" --label "0.01 d00" --label "0.1 d00" --label "0.2 d00" --size 1500x800
picture element.png fig10.png fig10/published_{1,10,100}_1 fig10/published_{1,10,100}_2 --stage 2 --label "S = 1" --label "S = 10" --label "S = 100" \
  --label "S = 1, another packing" --label "S = 10, another packing" --label "S = 100, another packing"
for rock in dense loose; do
  marks=()
  for set in reference sc180 sc450 sc900 C4.5 C18 C45; do
    points "$set" "$set" "p [Pa],q [Pa]" '$1 == "'$rock'" && $2 == "published" && $3 == "'$set'" && $5 != "nan" { print $5 "," $6 }' fig7.csv
    marks+=(--points "$work/$set.csv")
  done
  picture curve.png fig7_$rock.png fig7/${rock}_published_reference_{0,0.75,1.5,3} --label "isotropic" --label "dq/dp = 0.75" --label "dq/dp = 1.5" --label "dq/dp = 3" \
    --curve "p:q" "${marks[@]}" --size 1100x800
done
