#!/usr/bin/env bash
# Gate: who may know whom, and every source includes what it names. The same as the tests include_rules and
# own_includes, without a build.
. "$(dirname "$(readlink -f "$0")")/common.sh"
quietly cmake -DROOT="$PWD" -P tests/include_rules.cmake || failed "an #include against the rules"
needs perl
quietly tests/own_includes.pl || failed "an #include is missing"
passed "every #include keeps tests/include_rules.cmake"
