#!/usr/bin/env bash
# Two nodes that do not share everything: under the name `own` each has a folder of its own, as a disk of the node is.
# A run whose results, case or specimen lie there is refused before it writes a result, by one message that names
# what differs, and where.
#
# usage: tests/cluster/own_folders.sh MERGEL     as root; see cluster.sh
. "$(dirname "$0")/cluster.sh"
mkdir own own_of_n2
start_cluster "mount --bind $work/own_of_n2 $work/own"
"$mergel" sample "$case_file" "${cell[@]}" --output rock >rock.log 2>&1 || fail "the specimen: $(tail -3 rock.log)"
"$mergel" sample "$case_file" "${cell[@]}" --set "Specimen/seed=2" --output rock_2 >rock.log 2>&1 || fail "the specimen: $(tail -3 rock.log)"
cp rock/sample.h5 own/rock.h5
cp rock_2/sample.h5 own_of_n2/rock.h5
cp "$case_file" own/differs.prm
sed 's/seed .*= 1/seed = 2/' "$case_file" >own_of_n2/differs.prm
cp "$case_file" own/on_n1.prm

# is_refused RESULTS MESSAGE ARGUMENT...: of mergel element, one rank a node
is_refused()
{
  local results=$1 message=$2
  shift 2
  submit --nodes=2 --ntasks-per-node=1 "$batch/run.sbatch" element "$@" "${cell[@]}" --output "$results"
  to_its_end "$job" FAILED 1:0
  says "$job" "$message"
  [ "$(log_of "$job" | grep -Ec "$message")" -eq 1 ] || fail "more than one message: $(log_of "$job")"
  ! exists "$results/history.csv" || fail "$results: refused, but there are results"
  log_of "$job" | grep -Ev '^(srun|slurmstepd)' | tail -3
}
exists() { compgen -G "$1" >/dev/null || compgen -G "own_of_n2${1#own}" >/dev/null; }

is_refused own/results 'output folder .*rank 1 on n2' "$case_file"
is_refused results_1 'rank 1' own/differs.prm
is_refused results_2 'rank 1|own/on_n1.prm' own/on_n1.prm
is_refused results_3 'rank 1' "$case_file" --set "Specimen/file=own/rock.h5"

# The same folder on both: not refused.
submit --nodes=2 --ntasks-per-node=1 "$batch/run.sbatch" element "$case_file" "${cell[@]}" --output results_4
to_its_end "$job" COMPLETED 0:0
echo "folders of one node only: refused"
