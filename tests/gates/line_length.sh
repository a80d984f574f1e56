#!/usr/bin/env bash
# Gate: no line of a source has more than 100 characters. clang-format keeps code to 92, but leaves
# comments and strings as they are.
. "$(dirname "$(readlink -f "$0")")/common.sh"
find_sources
# Perl counts characters in any locale; awk of Debian counts bytes.
perl -CSD -ne '
  chomp;
  if (length > 100) { printf "%s:%d: %d characters\n", $ARGV, $., length; $n++ }
  close ARGV if eof;
  END { $? = 1 if $n }' "${files[@]}" >&2 || failed "no line may have more than 100 characters"
passed "no line of ${#files[@]} files has more than 100 characters"
