#!/usr/bin/env bash
# Gate: every source is as clang-format 14 writes it. clang-format -i FILE mends one.
. "$(dirname "$(readlink -f "$0")")/common.sh"
needs clang-format
find_sources
clang-format --dry-run -Werror "${files[@]}" || failed "clang-format -i mends these files"
passed "${#files[@]} files are as clang-format writes them"
