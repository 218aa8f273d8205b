// LinuxCNC's own interpreter reads the programs that are made for it, and says what the machine would be told.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "ballbar/formats/schedules/dry_run.hpp"
#include "ballbar/formats/schedules/spindle_program.hpp"
#include "programs/child_process.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

struct Circle {
  double first = 0.0, second = 0.0, centre_first = 0.0, centre_second = 0.0;
  int turns = 0;  // 1: CCW
};

// Of the canonical commands: what they say of spindle, dwells and circles.
struct Canonical {
  std::vector<Dwell> dwells;
  double duration_s = 0.0;
  std::vector<Circle> circles;
  std::vector<std::string> messages;
  int stops = 0, moves = 0, ends = 0, stops_while_turning = 0;
};

// "   18 N..... DWELL(300.0000)" is DWELL and 300.0000; nothing else than these is looked at.
Canonical canonical_of(const std::string& text) {
  Canonical found;
  double speed_rpm = 0.0;
  bool turns = false;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find("N..... ");
    const std::size_t open = line.find('(');
    if (begin == std::string::npos || open == std::string::npos) continue;
    const std::string word = line.substr(begin + 7, open - begin - 7);
    std::string inside = line.substr(open + 1, line.rfind(')') - open - 1);
    std::vector<double> values;
    if (word != "MESSAGE" && word != "COMMENT") {
      std::string numbers = inside;
      std::replace(numbers.begin(), numbers.end(), ',', ' ');
      std::istringstream stream(numbers);
      for (double value = 0.0; stream >> value;) values.push_back(value);
    }
    if (word == "SET_SPINDLE_SPEED") {
      speed_rpm = values.at(1);  // after the number of the spindle
    } else if (word == "START_SPINDLE_CLOCKWISE") {
      turns = true;
    } else if (word == "STOP_SPINDLE_TURNING") {
      turns = false;
    } else if (word == "DWELL") {
      const double now_rpm = turns ? speed_rpm : 0.0;
      if (found.dwells.empty() || found.dwells.back().speed_rpm != now_rpm)
        found.dwells.push_back({.speed_rpm = now_rpm});
      found.dwells.back().duration_s += values.at(0);
      found.duration_s += values.at(0);
    } else if (word == "ARC_FEED") {
      found.circles.push_back({values.at(0), values.at(1), values.at(2), values.at(3), static_cast<int>(values.at(4))});
    } else if (word == "STRAIGHT_FEED") {
      ++found.moves;
    } else if (word == "PROGRAM_STOP") {
      ++found.stops;
      if (turns) ++found.stops_while_turning;
    } else if (word == "MESSAGE") {
      found.messages.push_back(inside.substr(1, inside.size() - 2));
    } else if (word == "PROGRAM_END") {
      ++found.ends;
    }
  }
  return found;
}

// Skips the test where there is no interpreter.
#define CANONICAL_OR_SKIP(canonical, program)                                                               \
  const ScratchFolder scratch;                                                                              \
  const std::string file = scratch.write("program.ngc", program).string();                                  \
  /* It keeps its table of tools in the home folder. */                                                     \
  const ChildProcess child =                                                                                \
      child_process("rs274", {"env", "HOME=" + scratch.path().string(), "rs274", "-g", file}, "");          \
  if (child.status == 127) GTEST_SKIP() << "there is no rs274; on Debian: apt-get install linuxcnc-uspace"; \
  ASSERT_EQ(child.status, 0) << child.err;                                                                  \
  const Canonical canonical = canonical_of(child.out)

void expect_driven(const Schedule& schedule, const Canonical& canonical) {
  const std::vector<Dwell> expected = driven_dwells(schedule);
  ASSERT_EQ(canonical.dwells.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(canonical.dwells[i].duration_s, expected[i].duration_s, 1e-6) << i;
    EXPECT_EQ(canonical.dwells[i].speed_rpm, expected[i].speed_rpm) << i;
  }
  EXPECT_NEAR(canonical.duration_s, duration_s(schedule), 0.5e-3);
  EXPECT_EQ(canonical.ends, 1);
  EXPECT_EQ(canonical.stops_while_turning, 0);
}

// A staircase of 12 h with steps of load and coolant, dwells that are no whole minutes, and rest at both ends.
Schedule sample() {
  Schedule schedule{.dwells = {{.duration_s = 600.0}}};
  for (int i = 1; i <= 12; ++i) {
    schedule.dwells.push_back({.duration_s = 3333.333 + i,
                               .speed_rpm = i * 1000.0,
                               .load = i > 6 ? 1.25 : 1.0,
                               .coolant_K = i % 4 == 0 ? 2.0 : 0.0});
  }
  schedule.dwells.push_back({.duration_s = 1800.0});
  return schedule;
}

TEST(linuxcnc_program, its_interpreter_turns_and_dwells_as_the_schedule) {
  CANONICAL_OR_SKIP(canonical, spindle_program(sample(), Dialect::linuxcnc, {.title = "staircase"}));
  expect_driven(sample(), canonical);
  EXPECT_TRUE(canonical.circles.empty());
  EXPECT_EQ(canonical.moves, 0);
  const std::vector<std::string> expected = {"SET COOLANT +2 K",
                                             "SET COOLANT AS BEFORE",
                                             "SET LOAD 1.25 TIMES",
                                             "SET COOLANT +2 K",
                                             "SET COOLANT AS BEFORE",
                                             "SET COOLANT +2 K",
                                             "SET LOAD AS BEFORE, COOLANT AS BEFORE"};
  EXPECT_EQ(canonical.messages, expected);
  EXPECT_EQ(canonical.stops, 7);
}

TEST(linuxcnc_program, its_interpreter_drives_the_circles) {
  const ProgramOptions options{.ballbar = BallbarTest{.radius_mm = 150.0, .every_min = 120.0, .orient = true}};
  CANONICAL_OR_SKIP(canonical, spindle_program(sample(), Dialect::linuxcnc, options));
  expect_driven(sample(), canonical);
  // 11.78 h: at 0, 2, 4, 6, 8, 10 h and at the end
  ASSERT_EQ(canonical.circles.size(), 14u);
  for (std::size_t i = 0; i < canonical.circles.size(); ++i) {
    const Circle& circle = canonical.circles[i];
    EXPECT_EQ(circle.first, 150.0);
    EXPECT_EQ(circle.second, 0.0);
    EXPECT_EQ(circle.centre_first, 0.0);
    EXPECT_EQ(circle.centre_second, 0.0);
    EXPECT_EQ(circle.turns, i % 2 == 0 ? 1 : -1);
  }
  EXPECT_EQ(canonical.moves, 1 + 7 * 4);
  EXPECT_EQ(canonical.stops, 1 + 7 * 2 + 7);
}

// What would be a command of the interpreter's own if it stood in a comment.
TEST(linuxcnc_program, its_interpreter_finds_no_command_in_a_title) {
  for (const char* title : {"abort,stop here", "a) G0 X9 (b", "debug,#5420", "logopen,/tmp/no", "\n%\nM2"}) {
    CANONICAL_OR_SKIP(canonical, spindle_program(sample(), Dialect::linuxcnc, {.name = title, .title = title}));
    expect_driven(sample(), canonical);
    EXPECT_EQ(canonical.moves, 0);
    EXPECT_EQ(canonical.messages.size(), 7u);
  }
}

}  // namespace
}  // namespace ballbar
