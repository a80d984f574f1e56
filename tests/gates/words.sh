#!/usr/bin/env bash
# Gate: code, messages and pages use the field's words. The same as the test words, without a build.
. "$(dirname "$(readlink -f "$0")")/common.sh"
quietly tests/words.pl || failed "a word that is not used"
passed "none of the words that tests/words.pl refuses"
