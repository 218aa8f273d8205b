#include "text/cells.hpp"

#include <gtest/gtest.h>

namespace ballbar {
namespace {

std::vector<std::string> cells_of(std::string_view line, char delimiter) {
  std::vector<std::string_view> cells;
  split_cells(line, delimiter, cells);
  return {cells.begin(), cells.end()};
}

TEST(cells, stand_between_delimiters) {
  using Cells = std::vector<std::string>;
  EXPECT_EQ(cells_of("1,2,", ','), (Cells{"1", "2", ""}));
  EXPECT_EQ(cells_of("", ','), Cells{""});
  EXPECT_EQ(cells_of("1;2,5", ';'), (Cells{"1", "2,5"}));
  EXPECT_EQ(cells_of(R"( "a,b" ,c)", ','), (Cells{R"( "a,b" )", "c"}));
  EXPECT_EQ(cells_of(R"("a ""b,c"" d",e)", ','), (Cells{R"("a ""b,c"" d")", "e"}));
  EXPECT_EQ(cells_of(R"("a,b)", ','), (Cells{"\"a", "b"}));
  EXPECT_EQ(cells_of(R"(2" pipe,b")", ','), (Cells{"2\" pipe", "b\""}));
}

TEST(cells, between_runs_of_blanks) {
  using Cells = std::vector<std::string>;
  EXPECT_EQ(cells_of("  1 \t2  ", ' '), (Cells{"1", "2"}));
  EXPECT_EQ(cells_of(R"("T 1" 2)", ' '), (Cells{R"("T 1")", "2"}));
  EXPECT_EQ(cells_of(" \t", ' '), Cells{});
}

TEST(cells, are_what_is_within_their_quotes) {
  EXPECT_EQ(unquoted(R"("a ""b""")"), R"(a "b")");
  EXPECT_EQ(unquoted("\"a"), "\"a");
  EXPECT_EQ(unquoted("\""), "\"");
  EXPECT_EQ(trimmed(" \ta b\t"), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
}

TEST(cells, lines_are_without_their_end) {
  const std::string_view bytes = "a\r\nb";
  EXPECT_EQ(line_at(bytes, 0).text, "a");
  EXPECT_EQ(line_at(bytes, 0).next, 3u);
  EXPECT_EQ(line_at(bytes, 3).text, "b");
  EXPECT_EQ(line_at(bytes, 3).next, 4u);
}

}  // namespace
}  // namespace ballbar
