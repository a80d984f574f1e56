#!/usr/bin/env bash
# Gate: everything compiles and links with clang, without a warning. In the folder and with the
# flags of the gate sanitize: one build serves both.
#
# usage: tests/gates/clang.sh [TARGET...]   default: all
. "$(dirname "$(readlink -f "$0")")/common.sh"
build_sanitized "$@" || failed "clang refuses what is above"
passed "$(clang++ -dumpversion) builds ${*:-everything} without a warning"
