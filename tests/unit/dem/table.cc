#include "tests/support/catch.h"

#include "dem/io/table.h"

#include "dem/error.h"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

using namespace mergel;
using namespace mergel::dem;

namespace {

/// A history.csv with these contents, removed at the end.
class File {
public:
  explicit File(const std::string& contents)
  {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "mergel-history-XXXXXX").string();
    const int number = ::mkstemp(pattern.data());
    if (number >= 0) ::close(number);
    path = pattern;
    std::ofstream(path) << contents;
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

std::string message_of(const std::string& contents)
{
  const File file(contents);
  try {
    read_table(file.path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

} // namespace

TEST_CASE("lines that begin with # are remarks, and count as lines", "[unit][dem]")
{
  const File file("# critical states\np [Pa]\n 1\n  #  2 \n3\n");
  const Table table = read_table(file.path);
  CHECK(table.remarks == std::vector<std::string>{"critical states", "2"});
  CHECK(table.column("p", "Pa") == std::vector<double>{1.0, 3.0});
  CHECK(table.lines == std::vector<std::size_t>{3, 5});
}

TEST_CASE("columns are found by name and unit, in any order", "[unit][dem]")
{
  const File file("time [s],depth/D_p [-],q_c [Pa],note\n"
                  "0,0,1e6,7\r\n"
                  "\n"
                  " 1e-3 , +0.5 ,3.0000000000000004e6,8\n");
  const Table table = read_table(file.path);
  CHECK(table.n_rows == 2);
  CHECK(table.column("time", "s") == std::vector<double>{0.0, 1e-3});
  CHECK(table.column("depth/D_p", "-") == std::vector<double>{0.0, 0.5});
  CHECK(table.column("q_c", "Pa") == std::vector<double>{1e6, 3.0000000000000004e6});
  CHECK(table.column("note", "") == std::vector<double>{7.0, 8.0});
  CHECK(table.has("q_c"));
  CHECK_FALSE(table.has("q_c [Pa]"));
  CHECK_FALSE(table.is_last_line_cut);
}

TEST_CASE("a missing column is refused, and a wrong unit with the unit found",
          "[unit][dem]")
{
  const File file("time [s],q_c [MPa]\n0,1\n");
  const Table table = read_table(file.path);
  CHECK_THROWS_AS(table.column("depth", "m"), InputError);
  CHECK_THROWS_WITH(table.column("q_c", "Pa"),
                    mergel::match::Contains(file.path.string()) &&
                        mergel::match::Contains("'q_c [Pa]'") &&
                        mergel::match::Contains("'q_c [MPa]'"));
}

TEST_CASE("a missing column is refused with its likely cause", "[unit][dem]")
{
  const auto refusal = [](const std::string& contents) -> std::string {
    const File file(contents);
    try {
      read_table(file.path).column("u_n", "m");
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  CHECK_THAT(refusal("u_n (m),s [m]\n0,1\n"),
             mergel::match::Contains("'u_n (m)', 's [m]'. Units stand in square brackets"));
  CHECK_THAT(refusal("U_N [m],s [m]\n0,1\n"),
             mergel::match::Contains("'U_N [m]', 's [m]'. Capitals count."));
  CHECK_THAT(refusal("u_n [m] s [m]\n0\n"),
             mergel::match::Contains("Commas, semicolons or tabs separate columns"));
  CHECK_THAT(refusal("u_n [m] s [m]\n0 1\n"),
             mergel::match::Contains("'0 1' under 'u_n [m] s' is not a number. Commas, "
                                     "semicolons or tabs separate columns"));
  CHECK_THAT(refusal("t [s],s [m]\n0,1\n"), mergel::match::EndsWith("'s [m]'."));
}

TEST_CASE("the line a run is still writing is left out and reported", "[unit][dem]")
{
  // "1.2" may be the beginning of "1.25": a line without its end is never trusted.
  for (const char* last : {"2,1.2", "2", "2,"}) {
    const File file(std::string("time [s],depth [m]\n1,1.1\n") + last);
    const Table table = read_table(file.path);
    INFO(last);
    CHECK(table.n_rows == 1);
    CHECK(table.is_last_line_cut);
  }
}

TEST_CASE("a hand-written table may end without a newline and keeps its line numbers",
          "[unit][dem]")
{
  const File file("u [m]\n\n1\n2");
  const Table table = read_table(file.path, LastLine::whole);
  CHECK(table.column("u", "m") == std::vector<double>{1.0, 2.0});
  CHECK(table.lines == std::vector<std::size_t>{3, 4});
  CHECK_FALSE(table.is_last_line_cut);
}

TEST_CASE("missing values are NaN", "[unit][dem]")
{
  const File file("time [s],a [-],b [-]\n1,nan,\n");
  const Table table = read_table(file.path);
  CHECK(std::isnan(table.column("a", "-")[0]));
  CHECK(std::isnan(table.column("b", "-")[0]));
}

TEST_CASE("a table is the same whatever program wrote it", "[unit][dem]")
{
  const std::vector<double> u{0.0, 0.5}, s{1.0, -2e-3};
  for (const char* text :
       {"u [mm],s [m]\n0,1\n0.5,-2e-3\n",
        "\xEF\xBB\xBFu [mm],s [m]\r\n0,1\r\n0.5,-2e-3\r\n",
        "u [mm],s [m]\r0,1\r0.5,-2e-3\r", "u [mm];s [m]\r\n0;+1\r\n0,5;-2e-3\r\n",
        "u [mm]\ts [m]\n0\t1\n0,5\t-2e-3\n",
        "sep=;\r\nu [mm];s [m]\r\n0;1\r\n0,5;-2e-3\r\n;\r\n;\r\n",
        "sep=,\nu [mm],s [m]\n0,1\n , \n0.5,-2e-3\n",
        "sep=\t\nu [mm]\ts [m]\n0\t1\n0,5\t-2e-3\n"}) {
    CAPTURE(text);
    const File file(text);
    const Table table = read_table(file.path, LastLine::whole);
    CHECK(table.column("u", "mm") == u);
    CHECK(table.column("s", "m") == s);
  }
}

TEST_CASE("a column is given in any unit whose size is known", "[unit][dem]")
{
  const File file("u [mm],s\n0.5,1\n");
  const Table table = read_table(file.path, LastLine::whole);
  const UnitSize size = [](const std::string& unit, const std::string& in) {
    if (unit != "mm" || in != "m") throw InputError("[" + unit + "] is no [" + in + "]");
    return 1e-3;
  };
  CHECK(table.column_in("u", "m", size) == std::vector<double>{0.5 * 1e-3});
  CHECK(table.column_in("u", "mm", {}) == std::vector<double>{0.5});
  CHECK_THROWS_WITH(table.column_in("u", "s", size),
                    mergel::match::Contains("column 'u': [mm] is no [s]"));
  CHECK_THROWS_WITH(table.column_in("s", "m", size),
                    mergel::match::Contains("has no unit"));
  CHECK_THROWS_WITH(table.column_in("v", "m", size),
                    mergel::match::Contains("no column 'v [m]'"));
}

TEST_CASE("a column of text disturbs nothing until its numbers are asked for",
          "[unit][dem]")
{
  const std::string text =
      "q [MPa],\"remark, first\",e [-],day\n1,\"dry, \"\"as found\"\"\",\"0.9\",3 May\n"
      "2,,0.8,4 May\n";
  const File file(text);
  Table table = read_table(file.path, LastLine::whole);
  CHECK(table.column("q", "MPa") == std::vector<double>{1.0, 2.0});
  CHECK(table.column("e", "-") == std::vector<double>{0.9, 0.8});
  CHECK_THROWS_WITH(table.column("day", ""), // as the unit is
                    mergel::match::Contains(":2: '3 May' under 'day' is not a number"));
  CHECK(table.drop_text_columns() == std::vector<std::string>{"remark, first", "day"});
  CHECK(table.columns.size() == 2);
  CHECK_THAT(message_of(text),
             mergel::match::Contains("under 'remark, first'")); // of a run

  const File with_unit("q [MPa],e [-]\n1,x\n");
  Table of_numbers = read_table(with_unit.path, LastLine::whole);
  CHECK_THROWS_WITH(of_numbers.drop_text_columns(),
                    mergel::match::Contains("'x' under 'e' is not a number"));
  CHECK_THROWS_WITH(of_numbers.column_in("e", "-", {}),
                    mergel::match::Contains("'x' under 'e' is not a number"));
}

TEST_CASE("bytes that are no plain text are written out in messages", "[unit][dem]")
{
  CHECK_THAT(message_of("a [m]\n\xC2\xA0\x01\n"),
             mergel::match::Contains("'\\xc2\\xa0\\x01' under 'a' is not a number"));
}

TEST_CASE("a damaged history is refused with file and line", "[unit][dem]")
{
  const std::string head = "time [s],depth [m]\n";
  CHECK_THAT(message_of(head + "1,2\n3\n"),
             mergel::match::Contains(":3: 1 values under 2 headings"));
  CHECK_THAT(message_of(head + "1,2,3\n"),
             mergel::match::Contains(":2: 3 values under 2 headings"));
  CHECK_THAT(message_of(head + "1,two\n"),
             mergel::match::Contains(":2: 'two' under 'depth' is not a number"));
  CHECK_THAT(message_of(head + "1,2m\n"), mergel::match::Contains("'2m'"));
  CHECK_THAT(message_of(head), mergel::match::Contains("no record"));
  CHECK_THAT(message_of(""), mergel::match::Contains("no record"));
  CHECK_THAT(message_of("a [m],a [s]\n1,2\n"), mergel::match::Contains("two columns"));
  CHECK_THAT(message_of("a [m],\n1,2\n"), mergel::match::Contains("no name"));
  CHECK_THROWS_AS(read_table("/nowhere/history.csv"), InputError);
  CHECK_THROWS_AS(read_table("/tmp"), InputError);
  CHECK_THROWS_AS(read_table(std::string(300, 'x')), InputError);
}

TEST_CASE("interpolation is linear between records, constant beyond, and skips NaN",
          "[unit][dem]")
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> x{0.0, 1.0, 2.0, 4.0}, y{10.0, 20.0, none, 50.0};
  CHECK(interpolate(x, y, 0.5) == Approx(15.0));
  CHECK(interpolate(x, y, 1.0) == 20.0);
  CHECK(interpolate(x, y, 2.5) == Approx(35.0)); // between the records at 1 and 4
  CHECK(interpolate(x, y, -1.0) == 10.0);
  CHECK(interpolate(x, y, 9.0) == 50.0);
  CHECK(std::isnan(interpolate({}, {}, 0.0)));
}

TEST_CASE("the moving mean keeps a straight line and counts each row once", "[unit][dem]")
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  // Out of order, as after a hold that moves back a little; 0.2 twice.
  const std::vector<double> x{0.0, 0.1, 0.2, 0.4, 0.3, 0.2},
      y{0.0, 1.0, 2.0, 4.0, 3.0, 2.0};
  const auto mean = moving_mean(x, y, 0.21);
  CHECK(mean[1] == Approx((0.0 + 1.0 + 2.0 + 2.0) / 4.0));
  CHECK(mean[2] == Approx(2.0));
  CHECK(mean[5] == mean[2]);
  CHECK(mean[3] == Approx(3.5)); // half a window at the end

  const auto with_gap = moving_mean({0.0, 0.1, 0.2}, {1.0, none, 3.0}, 0.5);
  CHECK(with_gap[0] == Approx(2.0));
  CHECK(std::isnan(with_gap[1]));
}
