#include "ballbar/formats/schedules/schedule_csv.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/reader.hpp"

namespace ballbar {
namespace {

constexpr const char* kText = R"(# format = "ballbar-schedule 1"
# reading_s = 30.0
# starts = "warm"
begin_min,duration_min,speed_rpm,load,room_K,coolant_K
0,30,0,1,0,0
30,0.33333333,9000,1.5,0,-2
30.33333333,120,4500.5,1,0.25,0
)";

void expect_same(const Schedule& left, const Schedule& right) {
  EXPECT_EQ(left.reading_s, right.reading_s);
  EXPECT_EQ(left.starts_warm, right.starts_warm);
  ASSERT_EQ(left.dwells.size(), right.dwells.size());
  for (std::size_t i = 0; i < left.dwells.size(); ++i) {
    const Dwell &a = left.dwells[i], &b = right.dwells[i];
    EXPECT_EQ(a.duration_s, b.duration_s) << i;
    EXPECT_EQ(a.speed_rpm, b.speed_rpm) << i;
    EXPECT_EQ(a.load, b.load) << i;
    EXPECT_EQ(a.room_K, b.room_K) << i;
    EXPECT_EQ(a.coolant_K, b.coolant_K) << i;
  }
}

TEST(schedule_csv, what_is_written_is_this_and_reads_back) {
  const Schedule schedule{.dwells = {{.duration_s = 1800.0},
                                     {.duration_s = 20.0, .speed_rpm = 9000.0, .load = 1.5, .coolant_K = -2.0},
                                     {.duration_s = 7200.0, .speed_rpm = 4500.5, .room_K = 0.25}},
                          .reading_s = 30.0,
                          .starts_warm = true};
  EXPECT_EQ(write_schedule_csv(schedule), kText);
  expect_same(read_schedule_csv(kText, "file"), schedule);
}

TEST(schedule_csv, by_hand_two_columns_are_enough) {
  const Schedule read =
      read_schedule_csv("# format = \"ballbar-schedule 1\"\nspeed_rpm,duration_min\n3000,1.5\n", "file");
  expect_same(read, {.dwells = {{.duration_s = 90.0, .speed_rpm = 3000.0}}});
}

// Any whole microseconds and any values within the limits.
TEST(schedule_csv, any_schedule_comes_back) {
  const bool holds = rc::check("any schedule comes back", [] {
    Schedule schedule;
    const int count = *rc::gen::inRange(1, 40);
    const auto share = [](double low, double high) {
      return low + (high - low) * *rc::gen::inRange(0, 1000000007) / 1000000007.0;
    };
    for (int i = 0; i < count; ++i) {
      const double duration_s = static_cast<double>(*rc::gen::inRange<long long>(1000, 60000000000)) / 1e6;
      schedule.dwells.push_back(
          {duration_s, share(0.0, 1e6), share(0.0, 100.0), share(-100.0, 100.0), share(-100.0, 100.0)});
    }
    schedule.reading_s = share(0.001, 86400.0);
    schedule.starts_warm = *rc::gen::arbitrary<bool>();
    expect_same(read_schedule_csv(write_schedule_csv(schedule), "file"), schedule);
    RC_ASSERT(!testing::Test::HasFailure());
  });
  EXPECT_TRUE(holds);
}

TEST(schedule_csv, the_list_of_readers_knows_it) { EXPECT_EQ(found_in(reader_of(kText)), "the schedule of a test"); }

std::string changed(std::string_view from, std::string_view to) {
  std::string text = kText;
  if (from == "*") return std::string(to);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes");
  return text.replace(at, from.size(), to);
}

TEST(schedule_csv, bad_text_and_what_is_said) {
  struct Row {
    std::string_view from, to;
    const char* message;
  };
  const Row table[] = {
      {"*", "", "file:1:1: expected text, found an empty file."},
      {"*", "duration_min,speed_rpm\n1,2\n", "file:1:1: expected the key format, found none."},
      {"schedule 1", "schedule 2",
       "file:1:12: expected \"ballbar-schedule 1\" for format, found the text \"ballbar-schedule 2\"."},
      {"reading_s = 30.0", "reading_s = 0", "file:2:15: expected a number above 0 for reading_s, found the integer 0."},
      {"reading_s = 30.0", "reading_s = 1e9",
       "file:2:15: expected 0.001 s to 31 days for reading_s, found 1000000000 s."},
      {"reading_s", "readings_s",
       "file:2:3: expected one of the keys format, reading_s, starts, found \"readings_s\"; the nearest is reading_s."},
      {"\"warm\"", "\"hot\"", "file:3:12: expected one of \"cold\", \"warm\" for starts, found the text \"hot\"."},
      {"speed_rpm", "speed",
       "file:4:24: expected one of the columns begin_min, duration_min, speed_rpm, load, room_K, "
       "coolant_K, found \"speed\"."},
      {"duration_min", "begin_min", "file:4:11: expected each column once, found \"begin_min\" again."},
      {"*", "# format = \"ballbar-schedule 1\"\nbegin_min,speed_rpm\n0,1\n",
       "file:2:1: expected a column duration_min, found none."},
      {"*", "# format = \"ballbar-schedule 1\"\nduration_min\n1\n",
       "file:2:1: expected a column speed_rpm, found none."},
      {"*", "# format = \"ballbar-schedule 1\"\nduration_min,speed_rpm\n",
       "file:3:1: expected at least one row of numbers, found the end of the file."},
      {"30,0.33333333", "31,0.33333333",
       "file:6:1: expected 30 min for begin_min, where the row before ends, found \"31\"."},
      {"0,30,0,1", "0,-30,0,1", "file:5:3: expected a duration of 1 ms to 31 days, found \"-30\"."},
      {"0,30,0,1", "0,0.00001,0,1", "file:5:3: expected a duration of 1 ms to 31 days, found \"0.00001\"."},
      {"0,30,0,1", "0,50000,0,1", "file:5:3: expected a duration of 1 ms to 31 days, found \"50000\"."},
      {"333,120,", "333,44639,", "file:7:13: expected 31 days at most in all, found \"44639\"."},
      {",9000,", ",-9000,", "file:6:15: expected a speed of 0 to 1000000 rpm, found \"-9000\"."},
      {",9000,", ",nan,", "file:6:15: expected a finite number for speed_rpm, found \"nan\"."},
      {",9000,", ",,", "file:6:15: expected a number for speed_rpm, found nothing."},
      {"1.5,0,-2", "-1,0,-2", "file:6:20: expected a load of 0 to 100 times that of the data, found \"-1\"."},
      {"0.25,0", "125,0", "file:7:26: expected a room within 100 K of that of the data, found \"125\"."},
      {"0.25,0", "0.25,-101", "file:7:31: expected a coolant within 100 K of that of the data, found \"-101\"."},
  };
  for (const Row& row : table) {
    try {
      read_schedule_csv(changed(row.from, row.to), "file");
      ADD_FAILURE() << row.to << ": no message";
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), row.message);
    }
  }
}

TEST(schedule_csv, at_most_ten_thousand_dwells) {
  std::string text = "# format = \"ballbar-schedule 1\"\nduration_min,speed_rpm\n";
  for (int i = 0; i < 10000; ++i) text += "1,0\n";
  EXPECT_EQ(read_schedule_csv(text, "file").dwells.size(), 10000u);
  try {
    read_schedule_csv(text + "1,0\n", "file");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "file:3:1: expected at most 10000 rows, found 10001.");
  }
}

TEST(schedule_csv, what_no_file_holds_is_not_written) {
  const std::pair<Schedule, const char*> table[] = {
      {{}, "The schedule: expected 1 to 10000 dwells, found 0."},
      {{.dwells = {{.duration_s = 60.0}, {.duration_s = 0.0}}},
       "Dwell 2 of the schedule: expected a duration of 1 ms to 31 days, found 0 s."},
      {{.dwells = {{.duration_s = NAN}}},
       "Dwell 1 of the schedule: expected a duration of 1 ms to 31 days, found nan s."},
      {{.dwells = {{.duration_s = 60.0, .speed_rpm = INFINITY}}},
       "Dwell 1 of the schedule: expected a speed of 0 to 1000000 rpm, found inf."},
      {{.dwells = {{.duration_s = 2e6}, {.duration_s = 2e6}}},
       "The schedule: expected 31 days at most, found 46.2962962962963 days."},
      {{.dwells = {{.duration_s = 60.0}}, .reading_s = 0.0},
       "The schedule: expected a reading every 1 ms to 31 days, found every 0 s."},
  };
  for (const auto& [schedule, message] : table) {
    try {
      write_schedule_csv(schedule);
      ADD_FAILURE() << message;
    } catch (const Error& error) {
      EXPECT_STREQ(error.what(), message);
    }
  }
}

}  // namespace
}  // namespace ballbar
