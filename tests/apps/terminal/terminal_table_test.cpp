// Tables and numbers for the terminal.
#include "terminal/terminal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ballbar {
namespace {

TEST(text, numbers_that_nobody_could_read_get_an_exponent) {
  EXPECT_EQ(fixed(-0.001, 2), "0.00");
  EXPECT_EQ(fixed(123456789.0, 1), "123456789.0");
  EXPECT_EQ(fixed(1.357e190, 3), "1.36e+190");
  EXPECT_EQ(fixed(-std::numeric_limits<double>::infinity(), 3), "-inf");
  EXPECT_EQ(with_sigma(7.4, 0.021, 2), "7.40 ± 0.02");
  EXPECT_EQ(with_sigma(7.4, 1e300, 2), "7.40 ± 1e+300");
  EXPECT_EQ(with_sigma(7.4, std::nan(""), 2), "7.40 ± ?");
}

TEST(text, shortened_is_one_line_that_a_terminal_does_not_obey) {
  EXPECT_EQ(shortened("a\n  b", 10), "a b");
  EXPECT_EQ(shortened("0123456789", 8), "01234...");
  EXPECT_EQ(shortened("a\x1B[31m", 10), "a?[31m");
}

TEST(text, wrapped_breaks_at_spaces) {
  EXPECT_EQ(wrapped("one two three", 8), "one two\nthree\n");
  EXPECT_EQ(wrapped("one", 8), "one\n");
}

// "\u00b5" has two bytes: the break goes before it.
TEST(text, wrapped_breaks_a_long_word_and_keeps_every_character_of_it) {
  EXPECT_EQ(wrapped("abcdefghij", 4), "abcd\nefgh\nij\n");
  EXPECT_EQ(wrapped("abc\u00b5def", 4), "abc\n\u00b5de\nf\n");
}

TEST(text, a_table_row_whose_last_cell_goes_on_below) {
  Table table({"effect", "what"});
  table.add_wrapped({"a", "one two three"}, 8);
  EXPECT_EQ(table.left_aligned(), "effect  what\na       one two\n        three\n");
}

// Three columns of 20, 9 and 3 characters and 4 between them are 36; the widest gives way, and nothing is left out.
TEST(text, a_table_no_wider_than_asked) {
  Table table({"first", "second", "3rd"});
  table.add({"expansion(T1a_degC)", "123456789", "x"});
  table.add({"abcdefghijklmnopqrst", "1", "\u00b5"});
  EXPECT_EQ(table.text(),
            "first                    second  3rd\nexpansion(T1a_degC)   123456789    x\n"
            "abcdefghijklmnopqrst          1    \u00b5\n");
  EXPECT_EQ(table.text(31),
            "first               second  3rd\nexpansion(       123456789    x\n  T1a_degC)\n"
            "abcdefghijklmno          1    \u00b5\n  pqrst\n");
}

// At a space where there is one beyond the middle.
TEST(text, a_cell_that_goes_on_below) {
  Table table({"effect", "n"});
  table.add({"gradient_bending(T9_degC, T16_degC)", "1"});
  EXPECT_EQ(table.text(30), "effect                       n\ngradient_bending(T9_degC,    1\n  T16_degC)\n");
}

TEST(text, a_name_is_whole) {
  EXPECT_EQ(one_line("a\x1b[31m\nb"), "a?[31m b");
  EXPECT_EQ(one_line(std::string(300, 'a')), std::string(300, 'a'));
  EXPECT_EQ(one_line(std::string(301, 'a')), std::string(297, 'a') + "...");
}

}  // namespace
}  // namespace ballbar
