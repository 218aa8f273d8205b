#include <gtest/gtest.h>

#include <string>

#include "terminal/terminal_table.hpp"

namespace {

using namespace ballbar;

std::string lines_of(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += "line\n";
  return text;
}

TEST(OnAScreen, leaves_nothing_out_that_fits) {
  EXPECT_EQ(on_a_screen({{"a\n"}, {"", "nothing"}, {"b\n", "b"}}, false), "a\n\nb\n");
  EXPECT_EQ(lines_in(on_a_screen({{lines_of(20)}, {lines_of(19), "the table"}}, false)), kScreenLines);
}

TEST(OnAScreen, leaves_out_and_names_what_does_not_fit) {
  const std::vector<ScreenPart> parts{{lines_of(10)}, {lines_of(30), "the table"}, {lines_of(10), "the remarks"}};
  const std::string text = on_a_screen(parts, false);
  EXPECT_EQ(text, lines_of(10) + "\n" + lines_of(10) + "\n--details shows the table.\n");
  EXPECT_EQ(lines_in(on_a_screen(parts, true)), 52U);
}

TEST(OnAScreen, keeps_the_parts_that_no_screen_can_do_without) {
  EXPECT_EQ(on_a_screen({{lines_of(50)}}, false), lines_of(50));
}

}  // namespace
