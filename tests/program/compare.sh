#!/usr/bin/env bash
# mergel compare: the table, tests.csv and tests.json of several tests, by their readers; what it
# leaves out with a reason, and what it refuses before it writes.
#
# usage: tests/program/compare.sh MERGEL
. "$(dirname "$(readlink -f "$0")")/preamble.sh"
. "$root/tests/program/results.sh"
. "$root/tests/program/laboratory_runs.sh"

# FILE ROW-TEST "COLUMN": the cell of this column in the first row for which the awk expression holds
cell() {
  awk -F, -v name="$3" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k; if (!at) exit 2; next } '"$2"' { print $at; exit }' "$1"
}
# A B TOLERANCE: relative
same() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { d = a - b; if (d < 0) d = -d; exit !(a != "" && b != "" && d <= t * (b < 0 ? -b : b)) }'; }
# FILE "NAME": the first number of this name
number() { awk -F': ' -v name="\"$2\"" 'index($1, name) { print $2 + 0; exit }' "$1"; }

# Two realisations of a real test.
for s in 1 2; do
  bounded "$mergel" element "$root/apps/cases/element_small.prm" --set "Specimen/edge x=3.5 mm" --set "Specimen/edge y=3.5 mm" \
    --set "Specimen/edge z=3.5 mm" --set "Specimen/seed=$s" --set "Loading/inertial number=2e-3" --set "Output/pictures=none" \
    --set "Loading/stage 1=isotropic to p = 0.5 MPa" --set "Loading/stage 2=triaxial to axial strain = 1 %" \
    --set "Loading/stage 3=" --set "Loading/stage 4=" --output "real_$s" >log 2>&1 || fail "a run: $(tail -3 log)"
done
"$mergel" compare real_1 real_2 --output real >log 2>&1 || fail "compare: $(cat log)"
for name in "Young's modulus" "Poisson's ratio"; do
  unit="[Pa]"; [ "$name" = "Young's modulus" ] || unit="[-]"
  for s in 1 2; do
    [ "$(cell real/tests.csv '$1 == "real_'$s'"' "$name $unit")" = "$(awk -F': ' -v n="\"$name" 'index($1, n) || index($1, "      " n) { sub(",", "", $2); print $2; exit }' "real_$s/summary.json")" ] ||
      fail "$name of real_$s is not that of its summary"
  done
done
E1=$(cell real/tests.csv '$1 == "real_1"' "Young's modulus [Pa]") E2=$(cell real/tests.csv '$1 == "real_2"' "Young's modulus [Pa]")
same "$(cell real/tests.csv '$1 == "mean"' "Young's modulus [Pa]")" "$(awk -v a="$E1" -v b="$E2" 'BEGIN { print (a + b) / 2 }')" 1e-5 || fail "the mean of E"
same "$(cell real/tests.csv '$1 == "standard error"' "Young's modulus [Pa]")" "$(awk -v a="$E1" -v b="$E2" 'BEGIN { d = (a - b) / 2; print d < 0 ? -d : d }')" 1e-4 ||
  fail "the standard error of E"
same "$(cell real/tests.csv '$1 == "real_1"' "q at the peak [Pa]")" \
  "$(records real_1 '{ if (c("stage [-]") == 2 && c("q [Pa]") > top) top = c("q [Pa]") } END { print top }')" 1e-6 || fail "the peak of real_1"
grep -q 'mean of 2, 0.5[0-9]* MPa' log || fail "no mean on the terminal: $(cat log)"
grep -q 'ends at 1 % of axial strain, before 10 %' log || fail "no reason for the missing critical state: $(cat log)"

# Tests with known answers.
for s in 0.5 1 2; do exact_run "exact_$s" "$s" 1; done
exact_run exact_1_again 1 2
"$mergel" compare exact_0.5 exact_1 exact_1_again exact_2 --output exact >log 2>&1 || fail "compare: $(cat log)"
for expected in "c [Pa]|1e6" "phi [degree]|30" "Gamma [-]|1.3" "lambda [-]|0.0114" "M [-]|1.36363636"; do
  same "$(number exact/tests.json "${expected%|*}")" "${expected#*|}" 1e-4 || fail "$expected: $(grep -F "${expected%|*}" exact/tests.json)"
done
n=$(head -1 exact/tests.csv | tr -cd , | wc -c)
awk -F, -v n="$n" '!/^#/ && NF != n + 1 { exit 1 }' exact/tests.csv || fail "tests.csv: a line of another length"
[ "$(grep -vc '^#' exact/tests.csv)" -eq 7 ] || fail "tests.csv: four tests, a mean and its error wanted: $(cat exact/tests.csv)"
cmp -s <("$mergel" compare exact_0.5 exact_1 exact_1_again exact_2) <(grep -v '^exact/tests' log) || fail "the table differs without --output"
if command -v python3 >/dev/null; then
  python3 - exact <<'PY' || fail "a reader of CSV or JSON"
import csv, json, sys
rows = list(csv.DictReader(line for line in open(sys.argv[1] + "/tests.csv") if not line.startswith("#")))
assert [r["test"] for r in rows] == ["exact_0.5", "exact_1", "exact_1_again", "exact_2", "mean", "standard error"], rows
assert abs(float(rows[1]["q at the minimum after the peak [Pa]"]) - 2.5e6) < 1
tests = json.load(open(sys.argv[1] + "/tests.json"))
assert len(tests["tests"]) == 4 and tests["tests that differ only by seed"][0]["tests"] == ["exact_1", "exact_1_again"]
assert set(tests["made by"]) == {"program", "date", "host", "ranks", "command"}, tests["made by"]
assert tests["Coulomb line in the critical state"]["tests"] == [t["test"] for t in tests["tests"]]
PY
fi

# Both say by what they were made: the last line of the one, a member of the other.
program=$("$mergel" version | awk 'NR == 1 { name = $0 } $1 == "commit" { sub(/^commit +/, ""); print name ", commit " $0 }')
command='mergel compare exact_0.5 exact_1 exact_1_again exact_2 --output exact'
tail -1 exact/tests.csv | grep -q "^# made on 20[0-9T:-]*Z on $(uname -n) with 1 rank by $program: $command\$" || fail "tests.csv says: $(tail -1 exact/tests.csv)"
for member in "\"program\": \"$program\"" "\"host\": \"$(uname -n)\"" "\"command\": \"$command\""; do
  grep -qF "$member" exact/tests.json || fail "tests.json lacks $member: $(tail -3 exact/tests.json)"
done

# A run that has not finished is read without its moduli; the same seed twice is told.
cp -r exact_2 begun; rm begun/summary.json
"$mergel" compare begun exact_1 >log 2>&1 || fail "a run that goes on: $(cat log)"
grep -q 'begun: has no summary.json' log || fail "not told: $(cat log)"
cp -r exact_1 twin
"$mergel" compare twin exact_1 >log 2>&1 || fail "twins: $(cat log)"
grep -q 'exact_1 has the case and the seed of twin' log || fail "not told: $(cat log)"

# WHAT ARGUMENTS...: refused in one line, exit code 1, nothing written
refused() {
  local what=$1 code
  shift
  rm -rf out
  code=$(code_of "$mergel" compare "$@" --output out)
  [ "$code" -eq 1 ] && [ "$(wc -l <log)" -eq 1 ] && grep -q -- "$what" log && [ ! -e out ] || fail "wanted \"$what\", exit 1: $code $(cat log)"
}
mkdir empty
refused 'nowhere: is no folder' exact_1 nowhere
refused 'empty/history.csv: cannot be read' exact_1 empty
refused 'is given twice' exact_1 ./exact_1
refused '--label: given 1 times for 2' exact_1 exact_2 --label a
cp -r exact_1 caseless; rm caseless/resolved.prm
refused 'caseless/resolved.prm' exact_1 caseless
cp -r exact_1 broken; echo '{"a"' >broken/summary.json
refused 'broken/summary.json' exact_1 broken
mkdir pile; printf 'time [s],depth/D_p [-],q_c [Pa],bonds broken [-]\n0,0,0,0\n1e-3,1,2e6,30\n' >pile/history.csv; cp exact_1/resolved.prm pile
refused 'is the history of no element, triaxial or Brazilian test' exact_1 pile
[ "$(code_of "$mergel" compare)" -eq 1 ] || fail "no folder: $(cat log)"

# Files that are there are replaced on demand only, and those of the user never.
cp exact/tests.csv before
[ "$(code_of "$mergel" compare exact_1 exact_2 --output exact)" -eq 1 ] && grep -q 'exact/tests.csv: exists. Take --overwrite' log || fail "$(cat log)"
cmp -s before exact/tests.csv || fail "tests.csv was replaced without --overwrite"
"$mergel" compare exact_1 exact_2 --output exact --overwrite >log 2>&1 || fail "$(cat log)"
[ "$(grep -vc '^#' exact/tests.csv)" -eq 3 ] || fail "tests.csv was not replaced: $(cat exact/tests.csv)"
for name in tests.csv tests.json; do
  for option in "" --overwrite; do
    rm -rf own && mkdir own && echo mine >"own/$name"
    # shellcheck disable=SC2086
    [ "$(code_of "$mergel" compare exact_1 exact_2 --output own $option)" -eq 1 ] &&
      grep -q "own/$name: exists, and mergel compare has not written it" log || fail "a user's $name, $option: $(cat log)"
    [ "$(cat "own/$name")" = mine ] && [ "$(ls own)" = "$name" ] || fail "a user's $name, $option: own was changed"
  done
done

echo "compare: all checks hold"
