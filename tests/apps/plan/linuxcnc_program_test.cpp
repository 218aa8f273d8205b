// LinuxCNC's own interpreter reads the program, and says what the machine would be told.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "ballbar/formats/schedules/iso_program.hpp"
#include "programs/child_process.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

// Of the canonical commands: what they say of spindle, dwells and stops.
struct Canonical {
  std::vector<Dwell> dwells;  // consecutive ones at one speed are merged
  int stops = 0, stops_while_turning = 0, ends = 0;
  std::string others;  // moves and messages
};

// "   18 N..... DWELL(300.0000)" is DWELL and 300.0000.
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
    const std::string inside = line.substr(open + 1, line.rfind(')') - open - 1);
    if (word == "SET_SPINDLE_SPEED") {
      speed_rpm = std::stod(inside.substr(inside.find(',') + 1));  // after the number of the spindle
    } else if (word == "START_SPINDLE_CLOCKWISE") {
      turns = true;
    } else if (word == "STOP_SPINDLE_TURNING") {
      turns = false;
    } else if (word == "DWELL") {
      const double now_rpm = turns ? speed_rpm : 0.0;
      if (found.dwells.empty() || found.dwells.back().speed_rpm != now_rpm)
        found.dwells.push_back({.speed_rpm = now_rpm});
      found.dwells.back().duration_s += std::stod(inside);
    } else if (word == "PROGRAM_STOP") {
      ++found.stops;
      if (turns) ++found.stops_while_turning;
    } else if (word == "PROGRAM_END") {
      ++found.ends;
    } else if (word.starts_with("STRAIGHT_") || word.starts_with("ARC_") || word == "MESSAGE") {
      found.others += line + "\n";
    }
  }
  return found;
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

// The titles would be commands of the interpreter's own if they stood alone in a comment, or ended it.
TEST(linuxcnc_program, its_interpreter_turns_and_dwells_as_the_schedule) {
  for (const char* title :
       {"staircase", "abort,stop here", "a) G0 X9 (b", "debug,#5420", "logopen,/tmp/no", "\n%\nM2"}) {
    const ScratchFolder scratch;
    const std::string file = scratch.write("program.nc", iso_program(sample(), title)).string();
    // It keeps its table of tools in the home folder.
    const ChildProcess child =
        child_process("rs274", {"env", "HOME=" + scratch.path().string(), "rs274", "-g", file}, "");
    if (child.status == 127) GTEST_SKIP() << "there is no rs274; on Debian: apt-get install linuxcnc-uspace";
    ASSERT_EQ(child.status, 0) << child.err;
    const Canonical canonical = canonical_of(child.out);
    std::vector<Dwell> expected = sample().dwells;
    expected.front().duration_s += 10.0;  // on trial
    ASSERT_EQ(canonical.dwells.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_NEAR(canonical.dwells[i].duration_s, expected[i].duration_s, 1e-3) << i;
      EXPECT_EQ(canonical.dwells[i].speed_rpm, expected[i].speed_rpm) << i;
    }
    EXPECT_NEAR(duration_s({.dwells = canonical.dwells}), duration_s(sample()) + 10.0, 0.6e-3);
    EXPECT_EQ(canonical.stops, 1 + 7);
    EXPECT_EQ(canonical.stops_while_turning, 0);
    EXPECT_EQ(canonical.ends, 1);
    EXPECT_EQ(canonical.others, "");
  }
}

}  // namespace
}  // namespace ballbar
