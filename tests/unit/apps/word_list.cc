#include "tests/support/catch.h"

#include "apps/case/word_list.h"

#include "dem/error.h"

using namespace mergel;
using namespace mergel::apps;
using mergel::match::Contains;

TEST_CASE("A list is read at its blanks, but for those in double quotes", "[unit][apps]")
{
  const std::vector<std::string> words{"a", "state B", "/c d/e", "f"};
  CHECK(words_of("a \"state B\"\t\"/c d/e\"   f ") == words);
  CHECK(words_of("  ").empty());
  CHECK(words_of("\"\"") == std::vector<std::string>{""});
  CHECK(words_of("it's") == std::vector<std::string>{"it's"});
}

TEST_CASE("A word is written as a list reads it", "[unit][apps]")
{
  std::string list;
  const std::vector<std::string> words{"plain", "with a blank", "", "tab\tin it", "ü#'"};
  for (const std::string& word : words) list += as_word(word) + ' ';
  CHECK(words_of(list) == words);
  CHECK(as_word("plain") == "plain");
  CHECK_THROWS_WITH(as_word("a\"b"), Contains("Rename it"));
}

TEST_CASE("A quotation mark that is not closed, or inside a name, is refused",
          "[unit][apps]")
{
  CHECK_THROWS_WITH(words_of("a \"state B"), Contains("is never closed"));
  for (const char* list : {"a\"b", "\"a\"b", "a\"b c\"", "\"a\"\"b\""})
    CHECK_THROWS_WITH(words_of(list), Contains("quotation mark inside a name"));
}
