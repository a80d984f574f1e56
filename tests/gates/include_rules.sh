#!/usr/bin/env bash
# Gate: who may know whom. The same as the test include_rules, without a build.
. "$(dirname "$(readlink -f "$0")")/common.sh"
quietly cmake -DROOT="$PWD" -P tests/include_rules.cmake || failed "an #include against the rules"
passed "every #include keeps tests/include_rules.cmake"
