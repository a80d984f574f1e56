# Sourced by the scripts of this folder.

# last_words LOG: what a run said last, without what mpirun says of it afterwards
last_words()
{
  grep -Ev '^(-+|Primary job .*|a non-zero exit code.*|mpirun detected .*|the job to be terminated.*|  (Process name|Exit code): .*|)$' "$1" |
    tail -n 1
}
