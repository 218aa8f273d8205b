#include "ballbar/formats/schedules/iso_program.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// At rest, at a speed with more load, a short dwell that is no whole second.
Schedule sample() {
  return {.dwells = {{.duration_s = 60.0},
                     {.duration_s = 420.0, .speed_rpm = 9000.0, .load = 1.5},
                     {.duration_s = 0.25, .speed_rpm = 3000.4, .load = 1.5, .coolant_K = -2.0}}};
}

TEST(iso_program, whole) {
  EXPECT_EQ(iso_program(sample(), "Which of two", 9000.0), R"(%
(SPINDLE PROGRAM OF A THERMAL TEST, WRITTEN BY BALLBAR)
(TITLE WHICH OF TWO)
(3 DWELLS, 8 MIN IN ALL, STOPS NOT COUNTED)
(HIGHEST SPEED 9000 RPM - THE TOOL IN THE SPINDLE MUST BEAR IT)
(NO AXIS MOVES)
(BEGIN AFTER A NIGHT AT REST)
(G4 P IS A DWELL IN SECONDS - SOME CONTROLS COUNT IN MS, OR WANT X OR F INSTEAD OF P)
M5
G4 P10
M0 (TIME IT - GO ON IF THAT WAS 10 S, ELSE STOP AND CHANGE ALL DWELLS)
(DWELL 1 OF 3 - 1 MIN AT 0 RPM)
G4 P60
(1 OF 8 MIN)
(DWELL 2 OF 3 - 7 MIN AT 9000 RPM)
M0 (SET LOAD 1.5 TIMES THAT OF THE DATA)
S9000 M3
G4 P300
(6 OF 8 MIN)
G4 P120
(8 OF 8 MIN)
(DWELL 3 OF 3 - 0.25 S AT 3000 RPM)
M5
M0 (SET COOLANT -2 K)
S3000 M3
G4 P0.25
(8 OF 8 MIN)
M5
M30
%
)");
}

TEST(iso_program, warm_at_a_speed_and_back_to_rest) {
  EXPECT_EQ(iso_program({.dwells = {{.duration_s = 90.0, .speed_rpm = 1000.0},
                                    {.duration_s = 30.0, .speed_rpm = 1000.4},
                                    {.duration_s = 60.0, .speed_rpm = 0.3}},
                         .starts_warm = true},
                        ""),
            R"(%
(SPINDLE PROGRAM OF A THERMAL TEST, WRITTEN BY BALLBAR)
(3 DWELLS, 3 MIN IN ALL, STOPS NOT COUNTED)
(HIGHEST SPEED 1000 RPM - THE TOOL IN THE SPINDLE MUST BEAR IT)
(NO AXIS MOVES)
(BEGIN WHILE THE MACHINE IS STILL WARM FROM WHAT IT DID BEFORE)
(G4 P IS A DWELL IN SECONDS - SOME CONTROLS COUNT IN MS, OR WANT X OR F INSTEAD OF P)
M5
G4 P10
M0 (TIME IT - GO ON IF THAT WAS 10 S, ELSE STOP AND CHANGE ALL DWELLS)
(DWELL 1 OF 3 - 1 MIN 30 S AT 1000 RPM)
S1000 M3
G4 P90
(1.5 OF 3 MIN)
(DWELL 2 OF 3 - 30 S AT 1000 RPM)
G4 P30
(2 OF 3 MIN)
(DWELL 3 OF 3 - 1 MIN AT 0 RPM)
M5
G4 P60
(3 OF 3 MIN)
M5
M30
%
)");
}

// What the words of a program without its comments make a machine do; any other word fails.
struct Driven {
  std::vector<Dwell> dwells;  // one a block of G4
  int stops = 0;
};

Driven driven(const std::string& program) {
  Driven found;
  std::istringstream lines(program);
  long long speed_rpm = 0;
  bool is_ended = false;
  for (std::string line; std::getline(lines, line);) {
    for (const char c : line) EXPECT_TRUE(c >= 0x20 && c < 0x7F) << line;
    const std::size_t open = line.find('(');
    if (open != std::string::npos) {
      EXPECT_EQ(line.find_first_of("()", open + 1), line.size() - 1) << line;
      EXPECT_LE(line.size(), 110u) << line;
      line.erase(open > 0 ? open - 1 : 0);
    }
    if (line.empty() || line == "%") continue;
    EXPECT_FALSE(is_ended) << line;
    if (line.starts_with("G4 P")) {
      found.dwells.push_back({std::strtod(line.c_str() + 4, nullptr), static_cast<double>(speed_rpm)});
    } else if (line.starts_with("S") && line.ends_with(" M3")) {
      speed_rpm = std::stoll(line.substr(1));
      EXPECT_GT(speed_rpm, 0);
      EXPECT_EQ(line, "S" + std::to_string(speed_rpm) + " M3");
    } else if (line == "M5") {
      speed_rpm = 0;
    } else if (line == "M0") {
      EXPECT_EQ(speed_rpm, 0);
      ++found.stops;
    } else if (line == "M30") {
      EXPECT_EQ(speed_rpm, 0);
      is_ended = true;
    } else {
      ADD_FAILURE() << line;
    }
  }
  EXPECT_TRUE(is_ended);
  return found;
}

// Each dwell ends when the schedule says so, to half a millisecond: nothing adds up.
void expect_driven(const Schedule& schedule, const Driven& found) {
  ASSERT_FALSE(found.dwells.empty());
  EXPECT_EQ(found.dwells.front().duration_s, 10.0);
  EXPECT_EQ(found.dwells.front().speed_rpm, 0.0);
  std::size_t block = 1;
  long long at_ms = 0;
  double end_s = 0.0;
  for (const Dwell& dwell : schedule.dwells) {
    end_s += dwell.duration_s;
    while (at_ms < std::llround(end_s * 1e3)) {
      ASSERT_LT(block, found.dwells.size());
      EXPECT_EQ(found.dwells[block].speed_rpm, std::round(dwell.speed_rpm));
      EXPECT_LE(found.dwells[block].duration_s, 300.0);
      at_ms += std::llround(found.dwells[block++].duration_s * 1e3);
    }
    EXPECT_EQ(at_ms, std::llround(end_s * 1e3));
  }
  EXPECT_EQ(block, found.dwells.size());
  EXPECT_NEAR(static_cast<double>(at_ms) / 1e3, duration_s(schedule), 0.5e-3 + 1e-9);
}

TEST(iso_program, any_schedule_is_driven) {
  const bool holds = rc::check("any schedule is driven", [] {
    Schedule schedule;
    const int count = *rc::gen::inRange(1, 20);
    for (int i = 0; i < count; ++i) {
      schedule.dwells.push_back({.duration_s = *rc::gen::inRange(1, 40000000) / 7e3 + 1e-3,
                                 .speed_rpm = *rc::gen::inRange(0, 5) * 1234.5,
                                 .load = 1.0 + *rc::gen::inRange(0, 2)});
    }
    expect_driven(schedule, driven(iso_program(schedule, "any")));
    RC_ASSERT(!testing::Test::HasFailure());
  });
  EXPECT_TRUE(holds);
}

// A title that would end a comment, begin a block or be a command of its own.
TEST(iso_program, a_title_stays_a_comment) {
  const std::string hostile[] = {"a) G0 X1000 (",
                                 "abort,now",
                                 "%\nG0 X1\n",
                                 "\"; G0 X9",
                                 "debug, #5221",
                                 "\xC3\xA4\x01\x7F~",
                                 "[1] END PGM",
                                 std::string(500, ')'),
                                 std::string(500, 'x'),
                                 "",
                                 std::string("\0M30", 4),
                                 "7"};
  for (const std::string& title : hostile) {
    const std::string program = iso_program(sample(), title);
    const Driven found = driven(program);
    expect_driven(sample(), found);
    EXPECT_EQ(found.stops, 3);
    EXPECT_EQ(program.find("\n(TITLE ") != std::string::npos, !title.empty());
  }
}

TEST(iso_program, what_a_machine_cannot_do_is_refused) {
  try {
    iso_program(sample(), "", 8000.0);
    ADD_FAILURE() << "no message";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "Dwell 2 of the schedule, from 1 min: expected at most 8000 rpm, the highest that the machine may "
                 "turn, found 9000 rpm.");
  }
  EXPECT_THROW(iso_program({}, ""), Error);
}

}  // namespace
}  // namespace ballbar
