/// Text for terminals, shells and JSON.
#include "tests/support/catch.h"

#include "apps/case/words.h"

using namespace mergel::apps;

TEST_CASE("A terminal gets no control characters but newlines and tabulators",
          "[unit][apps]")
{
  CHECK(printable("a\x1b[31mb") == "a\\x1b[31mb");
  CHECK(printable("bell\a, delete\x7f, back\b") == "bell\\x07, delete\\x7f, back\\x08");
  CHECK(printable("two\nlines\tand a tabulator") == "two\nlines\tand a tabulator");
  CHECK(printable("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80") ==
        "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80"); // two, three and four bytes
  CHECK(printable("\xc2\x9b"
                  "31m") == "\\xc2\\x9b31m");   // the control sequence introducer of U+009B
  CHECK(printable("\xff\xc3") == "\\xff\\xc3"); // no UTF-8, and a character that is cut
  CHECK(printable("\xc0\xaf") == "\\xc0\\xaf"); // an overlong slash
  CHECK(printable("") == "");
}

TEST_CASE("A shell reads a quoted word back", "[unit][apps]")
{
  CHECK(in_shell("results/pile_small") == "results/pile_small");
  CHECK(in_shell("my results") == "'my results'");
  CHECK(in_shell("it's") == "'it'\\''s'");
  CHECK(in_shell("") == "''");
  CHECK(in_shell("$HOME") == "'$HOME'");
  CHECK(in_shell("a\nb") == "$'a\\x0ab'");
  CHECK(in_shell("\x1b'\\") == "$'\\x1b\\'\\\\'");
}

TEST_CASE("JSON holds no raw control characters", "[unit][apps]")
{
  CHECK(in_json("a \"b\" \\c") == "\"a \\\"b\\\" \\\\c\"");
  CHECK(in_json("a\nb\x1b") == "\"a\\u000ab\\u001b\"");
  CHECK(in_json("\xc3\xa9 \xff") == "\"\xc3\xa9 \\\\xff\"");
}
