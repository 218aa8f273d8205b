// Rows as they arrive: in any pieces the same, and what a line lacks is NaN.
#include "ballbar/formats/series/live_rows.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "allocations.hpp"
#include "ballbar/error.hpp"

namespace ballbar {
namespace {

using namespace std::string_literals;

// A row as one text, so that NaN equals NaN: "12 | 22.5, nan".
std::string text_of(const LiveRow& row) { return fmt::format("{} | {}", row.time_s, fmt::join(row.values, ", ")); }

// All rows of the text, that comes in pieces of so many bytes.
std::vector<std::string> rows_of(std::string_view text, std::vector<std::string> wanted,
                                 std::size_t piece = std::string_view::npos, std::size_t first = 0) {
  LiveRows rows("live.csv", std::move(wanted));
  std::vector<std::string> found;
  const auto take = [&](std::string_view bytes) {
    rows.add(bytes);
    while (const LiveRow* row = rows.next()) found.push_back(text_of(*row));
  };
  if (first > 0) take(text.substr(0, first));
  for (std::size_t at = first; at < text.size(); at += std::min(piece, text.size() - at)) take(text.substr(at, piece));
  if (const LiveRow* row = rows.last()) found.push_back(text_of(*row));
  return found;
}

using Rows = std::vector<std::string>;

TEST(live_rows, the_columns_that_are_wanted_in_their_order) {
  EXPECT_EQ(rows_of("speed_rpm,T_a_degC,time_s,note,T_b_degC\n3000,20.5,1,warm,30\n3010,+20.75,2.5,,-1e1\n",
                    {"T_b_degC", "T_a_degC"}),
            (Rows{"1 | 30, 20.5", "2.5 | -10, 20.75"}));
}

TEST(live_rows, minutes_become_seconds) {
  EXPECT_EQ(rows_of("time_min,T_a_degC\n0,20\n1.5,21\n", {"T_a_degC"}), (Rows{"0 | 20", "90 | 21"}));
}

TEST(live_rows, marks_line_ends_comments_and_blanks_do_not_matter) {
  const Rows expected{"0 | 20", "1 | 21"};
  EXPECT_EQ(rows_of("time_s,T_a_degC\n0,20\n1,21\n", {"T_a_degC"}), expected);
  EXPECT_EQ(rows_of("time_s,T_a_degC\n0,20\n1,21", {"T_a_degC"}), expected);
  EXPECT_EQ(rows_of("\xEF\xBB\xBFtime_s,T_a_degC\r\n0,20\r\n1,21\r\n", {"T_a_degC"}), expected);
  EXPECT_EQ(rows_of("\n# a, b\n \t\ntime_s , T_a_degC\n\n#5,6\n 0 ,\t20 \n\r\n1,21\r", {"T_a_degC"}), expected);
}

// Nothing is wanted by a model without effects.
TEST(live_rows, time_alone) { EXPECT_EQ(rows_of("time_s\n0\n1\n", {}), (Rows{"0 | ", "1 | "})); }

TEST(live_rows, a_cell_that_is_no_number_is_nan) {
  const std::string cells[] = {"",     " ",  "none",  "20;5",   "1.5 K", "1..5", "--1",     "+-1",   "+",
                               "0x10", "1e", "1e999", "\"20\"", "20\0"s, "\0"s,  "2\0000"s, "\xB0"s, "1_0"};
  for (const std::string& cell : cells) {
    EXPECT_EQ(rows_of("time_s,T_a_degC,T_b_degC\n7," + cell + ",30\n", {"T_a_degC", "T_b_degC"}), Rows{"7 | nan, 30"})
        << cell;
    EXPECT_EQ(rows_of("time_s,T_a_degC\n" + cell + ",30\n", {"T_a_degC"}), Rows{"nan | 30"}) << cell;
  }
}

TEST(live_rows, a_line_of_another_number_of_cells_is_nan_all_over) {
  for (const std::string line : {"7", "7,20", "7,20,30,40", "7,20,30,", ",", ",,,", "time_s,T_a_degC"}) {
    EXPECT_EQ(rows_of("time_s,T_a_degC,T_b_degC\n" + line + "\n8,21,31\n", {"T_a_degC", "T_b_degC"}),
              (Rows{"nan | nan, nan", "8 | 21, 31"}))
        << line;
  }
}

// Nothing of the row before shines through.
TEST(live_rows, a_row_begins_empty) {
  EXPECT_EQ(rows_of("time_s,T_a_degC\n1,20\n,\n2,\n", {"T_a_degC"}), (Rows{"1 | 20", "nan | nan", "2 | nan"}));
}

TEST(live_rows, every_split_gives_the_same_rows) {
  const std::string text =
      "\xEF\xBB\xBF# mine\r\n\r\nT_a_degC,x,time_min\r\n20,a,1\r\n#c\r\n,,\n21,,2\n1,2\n\0,\0,3\n\n22,b,4\n23,c,5"s;
  const Rows expected{"60 | 20", "nan | nan", "120 | 21", "nan | nan", "180 | nan", "240 | 22", "300 | 23"};
  ASSERT_EQ(rows_of(text, {"T_a_degC"}), expected);
  for (std::size_t split = 1; split < text.size(); ++split) {
    EXPECT_EQ(rows_of(text, {"T_a_degC"}, std::string::npos, split), expected) << split;
    EXPECT_EQ(rows_of(text, {"T_a_degC"}, split), expected) << split;
  }
}

constexpr std::size_t kLongest = 65536;  // 64 KiB

TEST(live_rows, a_line_of_more_than_64_KiB_is_a_row_without_values) {
  const std::string head = "time_s,T_a_degC\n";
  const auto line = [](std::size_t size) { return "1,20" + std::string(size - 4, ' '); };
  const Rows read{"1 | 20", "2 | 21"}, lost{"nan | nan", "2 | 21"};
  for (const std::size_t piece :
       {std::size_t{1}, std::size_t{999}, kLongest - 1, kLongest, kLongest + 1, 9 * kLongest}) {
    EXPECT_EQ(rows_of(head + line(kLongest - 1) + "\n2,21\n", {"T_a_degC"}, piece), read) << piece;
    EXPECT_EQ(rows_of(head + line(kLongest + 1) + "\n2,21\n", {"T_a_degC"}, piece), lost) << piece;
    EXPECT_EQ(rows_of(head + line(4 * kLongest) + "\n2,21\n", {"T_a_degC"}, piece), lost) << piece;
    EXPECT_EQ(rows_of(head + line(4 * kLongest), {"T_a_degC"}, piece), Rows{"nan | nan"}) << piece;
    EXPECT_EQ(rows_of(head + "#" + line(4 * kLongest) + "\n2,21\n", {"T_a_degC"}, piece), lost) << piece;
  }
}

// Two lines after each other: the second is whole.
TEST(live_rows, a_long_line_does_not_take_the_next_one_with_it) {
  const std::string text =
      "time_s,T_a_degC\n" + std::string(2 * kLongest, '1') + "\n" + std::string(kLongest + 5, '2') + "\n3,20\n";
  EXPECT_EQ(rows_of(text, {"T_a_degC"}, 4096), (Rows{"nan | nan", "nan | nan", "3 | 20"}));
}

TEST(live_rows, takes_no_memory_after_the_longest_line) {
  LiveRows rows("live.csv", {"T_a_degC", "T_b_degC"});
  std::string text = "time_s,T_a_degC,T_b_degC\n#" + std::string(kLongest - 2, 'x') + "\n";
  for (int i = 0; i < 2000; ++i) text += fmt::format("{},{},{}\n", i, 20.0 + 0.01 * i, i % 5 == 0 ? "" : "30.125");
  text += "#" + std::string(kLongest - 2, 'x') + "\n1,2\n";
  constexpr std::size_t kPiece = 3000;
  std::size_t before = 0, found = 0;
  for (std::size_t at = 0; at < text.size(); at += kPiece) {
    rows.add(std::string_view(text).substr(at, kPiece));
    while (rows.next()) ++found;
    if (at < kLongest + kPiece) before = allocations();
  }
  EXPECT_EQ(found, 2001u);
  EXPECT_EQ(allocations(), before);
}

TEST(live_rows, named_once_the_columns_are_known) {
  LiveRows rows("live.csv", {"T_a_degC"});
  rows.add("# c\ntime_s,T_a");
  EXPECT_EQ(rows.next(), nullptr);
  EXPECT_FALSE(rows.named());
  rows.add("_degC\n");
  EXPECT_EQ(rows.next(), nullptr);
  EXPECT_TRUE(rows.named());
  EXPECT_EQ(rows.last(), nullptr);
}

struct BadFirst {
  std::string text;
  std::string message;  // behind the file's name
};

TEST(live_rows, bad_first_lines) {
  const BadFirst cases[] = {
      {"", ": expected a line with the names of the columns, found none."},
      {"\n\n# time_s,T_a_degC\n", ": expected a line with the names of the columns, found none."},
      {"\xEF\xBB\xBF", ": expected a line with the names of the columns, found none."},
      {"0,22.5\n", ":1: expected one column time_s or time_min, found \"0,22.5\"."},
      {"T_a_degC", ":1: expected one column time_s or time_min, found \"T_a_degC\"."},
      {"\n#\n,\n", ":3: expected one column time_s or time_min, found \",\"."},
      {"Time_s,T_a_degC\n", ":1: expected one column time_s or time_min, found \"Time_s,T_a_degC\"."},
      {"time_s;T_a_degC\n", ":1: expected one column time_s or time_min, found \"time_s;T_a_degC\"."},
      {"time_s,T_a_degC,time_min\n", ":1: expected one column time_s or time_min, found more than one."},
      {"time_s,T_a_degC,time_s\n", ":1: expected one column time_s or time_min, found more than one."},
      {"# c\r\ntime_s,T_b_degC\r\n",
       ":2: expected the column T_a_degC, which the model reads, found none; the nearest is \"T_b_degC\"."},
      {"time_s\n", ":1: expected the column T_a_degC, which the model reads, found none; the nearest is \"time_s\"."},
      {"T_a_degC,time_s,T_a_degC\n", ":1: expected the column T_a_degC once, found it 2 times."},
  };
  for (const BadFirst& bad : cases) {
    for (const std::size_t piece : {std::string::npos, std::size_t{1}}) {
      try {
        rows_of(bad.text, {"T_a_degC"}, piece);
        ADD_FAILURE() << "accepted: " << bad.text;
      } catch (const Error& error) {
        EXPECT_EQ(error.what(), "live.csv" + bad.message) << bad.text;
      }
    }
  }
}

// Said at once: a stream without an end of line would never be.
TEST(live_rows, a_first_line_that_is_too_long) {
  LiveRows rows("live.csv", {});
  rows.add("\ntime_s," + std::string(kLongest, 'x'));
  try {
    rows.next();
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "live.csv:2: expected the names of the columns in at most 64 KiB, found a longer line.");
  }
}

// The time of a row is no signal; a formula has it as t.
TEST(live_rows, time_is_no_signal) {
  try {
    rows_of("time_s,T_a_degC\n1,2\n", {"T_a_degC", "time_s"});
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "live.csv:1: expected signals for the model to read, found time_s. In a formula, time is t.");
  }
}

}  // namespace
}  // namespace ballbar
