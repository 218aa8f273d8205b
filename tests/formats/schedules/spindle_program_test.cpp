#include "ballbar/formats/schedules/spindle_program.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/schedules/dry_run.hpp"

namespace ballbar {
namespace {

// At rest, at a speed with more load, a short dwell that is no whole second, back.
Schedule sample() {
  return {.dwells = {{.duration_s = 60.0},
                     {.duration_s = 420.0, .speed_rpm = 9000.0, .load = 1.5},
                     {.duration_s = 0.25, .speed_rpm = 3000.4, .load = 1.5, .coolant_K = -2.0}}};
}

void expect_driven(const Schedule& schedule, const DryRun& run, Dialect dialect) {
  const std::vector<Dwell> expected = driven_dwells(schedule);
  ASSERT_EQ(run.dwells.size(), expected.size()) << name_of(dialect);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(run.dwells[i].duration_s, expected[i].duration_s) << name_of(dialect) << " " << i;
    EXPECT_EQ(run.dwells[i].speed_rpm, expected[i].speed_rpm) << name_of(dialect) << " " << i;
  }
  EXPECT_NEAR(run.duration_s, duration_s(schedule), 0.5e-3) << name_of(dialect);  // whole milliseconds
  EXPECT_LE(run.longest_wait_s, 300.0) << name_of(dialect);
}

void expect_plain(const std::string& program) {
  std::size_t length = 0;
  for (const char c : program) {
    length = c == '\n' ? 0 : length + 1;
    ASSERT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7F)) << static_cast<int>(c);
    ASSERT_LE(length, 80u) << program;
  }
}

TEST(spindle_program, each_control_drives_the_schedule) {
  for (const Dialect dialect : kDialects) {
    const std::string program = spindle_program(sample(), dialect, {});
    expect_plain(program);
    const DryRun run = dry_run_of(program, dialect);
    expect_driven(sample(), run, dialect);
    EXPECT_EQ(run.duration_s, 480.25);
    EXPECT_EQ(run.highest_rpm, 9000.0);
    EXPECT_EQ(run.stops, (std::vector<std::string>{"SET LOAD 1.5 TIMES", "SET COOLANT -2 K"}));
    EXPECT_TRUE(run.circles.empty());
    EXPECT_EQ(run.driven_s, 0.0);
  }
}

// Both circles of a test are 2 pi 150 mm at 1500 mm/min, 37.7 s; each way in and out is 1.5 mm, 0.06 s.
TEST(spindle_program, ballbar_tests_stand_before_and_after_each_dwell) {
  const ProgramOptions options{.ballbar = BallbarTest{.radius_mm = 150.0, .feed_mm_per_min = 1500.0, .orient = true}};
  for (const Dialect dialect : kDialects) {
    const std::string program = spindle_program(sample(), dialect, options);
    expect_plain(program);
    const DryRun run = dry_run_of(program, dialect);
    expect_driven(sample(), run, dialect);
    ASSERT_EQ(run.circles.size(), 8u) << name_of(dialect);
    const double after_s[] = {0.0, 60.0, 480.0, 480.25};
    for (std::size_t i = 0; i < run.circles.size(); ++i) {
      const DrivenCircle& circle = run.circles[i];
      EXPECT_EQ(circle.is_ccw, i % 2 == 0);
      EXPECT_EQ(circle.radius_mm, 150.0);
      EXPECT_EQ(circle.centre_x_mm, 0.0);
      EXPECT_EQ(circle.centre_y_mm, 0.0);
      EXPECT_EQ(circle.feed_mm_per_min, 1500.0);
      EXPECT_EQ(circle.after_s, after_s[i / 2]);
    }
    EXPECT_EQ(run.orientations, 4);
    EXPECT_NEAR(run.driven_s, 4 * (2 * 37.699112 + 4 * 0.06), 1e-4);
    ASSERT_EQ(run.stops.size(), 1u + 4u * 2u + 2u);
    EXPECT_EQ(run.stops[0], "NEXT THE AXES GO TO X151.5 Y0 - CHECK ZERO, HEIGHT, WAY");
    EXPECT_EQ(run.stops[1], "MOUNT THE BAR, START ITS CAPTURE - TEST 1");
    EXPECT_EQ(run.stops[2], "TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR");
  }
}

// 8 min 0.25 s with a test every 3 min: at 0, 3, 6 min and at the end.
TEST(spindle_program, ballbar_tests_by_the_clock) {
  const ProgramOptions options{.ballbar = BallbarTest{.every_min = 3.0}};
  for (const Dialect dialect : kDialects) {
    const DryRun run = dry_run_of(spindle_program(sample(), dialect, options), dialect);
    expect_driven(sample(), run, dialect);
    std::vector<double> after_s;
    for (const DrivenCircle& circle : run.circles) after_s.push_back(circle.after_s);
    EXPECT_EQ(after_s, (std::vector<double>{0, 0, 180, 180, 360, 360, 480.25, 480.25}));
  }
}

TEST(spindle_program, any_schedule_is_driven_by_every_control) {
  const bool holds = rc::check("any schedule is driven", [] {
    Schedule schedule;
    const int count = *rc::gen::inRange(1, 20);
    for (int i = 0; i < count; ++i) {
      schedule.dwells.push_back({.duration_s = *rc::gen::inRange(1, 40000000) / 7e3 + 1e-3,
                                 .speed_rpm = *rc::gen::inRange(0, 5) * 1234.5,
                                 .load = 1.0 + *rc::gen::inRange(0, 2)});
    }
    ProgramOptions options;
    if (*rc::gen::arbitrary<bool>()) options.ballbar = BallbarTest{.every_min = *rc::gen::inRange(0, 50) * 1.0};
    for (const Dialect dialect : kDialects) {
      const std::string program = spindle_program(schedule, dialect, options);
      expect_driven(schedule, dry_run_of(program, dialect), dialect);
      RC_ASSERT(!testing::Test::HasFailure());
    }
  });
  EXPECT_TRUE(holds);
}

// The parts that each control says in its own way, word for word: what the dry run shares with the writer it cannot
// hold.
TEST(spindle_program, the_words_of_each_control) {
  const Schedule schedule{.dwells = {{.duration_s = 330.5, .speed_rpm = 4000.0}}, .starts_warm = true};
  const ProgramOptions options{.name = "warm up", .ballbar = BallbarTest{.orient = true}, .range_m = 42};
  const auto body = [&](Dialect dialect) {
    std::string out, program = spindle_program(schedule, dialect, options);
    for (std::size_t at = 0, end; at < program.size(); at = end + 1) {
      end = program.find('\n', at);
      std::string line = program.substr(at, end - at);
      if (dialect == Dialect::heidenhain) line.erase(0, line.find(' ') + 1);
      const bool is_comment = line.starts_with("; ") || (line.starts_with("(") && !line.starts_with("(MSG"));
      if (!is_comment) out += line + "\n";
    }
    return out;
  };
  const std::string program = body(Dialect::fanuc);
  EXPECT_EQ(program, R"(%
O1100 (WARMUP)
G21
G17 G90 G94 G40
G54
M42
M05
M00 (NEXT THE AXES GO TO X101.5 Y0 - CHECK ZERO, HEIGHT, WAY)
G01 X101.5 Y0. F1000.
M19
M00 (MOUNT THE BAR, START ITS CAPTURE - TEST 1)
G01 X100. Y0. F1000.
G03 X100. Y0. I-100. J0.
G01 X101.5 Y0. F1000.
G01 X100. Y0. F1000.
G02 X100. Y0. I-100. J0.
G01 X101.5 Y0. F1000.
M00 (TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR)
S4000 M03
G04 X300.
G04 X30.5
M05
M19
M00 (MOUNT THE BAR, START ITS CAPTURE - TEST 2)
G01 X100. Y0. F1000.
G03 X100. Y0. I-100. J0.
G01 X101.5 Y0. F1000.
G01 X100. Y0. F1000.
G02 X100. Y0. I-100. J0.
G01 X101.5 Y0. F1000.
M00 (TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR)
M30
%
)");
  const auto begin_of = [&](Dialect dialect, std::string_view last) {
    const std::string text = body(dialect);
    return text.substr(0, text.find(last) + last.size());
  };
  EXPECT_EQ(begin_of(Dialect::siemens, "G4 F30.5\nM5\n"), R"(G710 G17 G90 G94 G40
G54
M42
M5
MSG("NEXT THE AXES GO TO X101.5 Y0 - CHECK ZERO, HEIGHT, WAY")
M0
MSG()
G1 X101.5 Y0 F1000
SPOS=0
MSG("MOUNT THE BAR, START ITS CAPTURE - TEST 1")
M0
MSG()
G1 X100 Y0 F1000
G3 X100 Y0 I-100 J0
G1 X101.5 Y0 F1000
G1 X100 Y0 F1000
G2 X100 Y0 I-100 J0
G1 X101.5 Y0 F1000
MSG("TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR")
M0
MSG()
S4000 M3
G4 F300
G4 F30.5
M5
)");
  EXPECT_EQ(begin_of(Dialect::heidenhain, "DWELL 30.5\nM5\n"), R"(BEGIN PGM WARMUP MM
M42
M5
M0
L X+101.5 Y+0 R0 F1000
CYCL DEF 13.0 ORIENTATION
CYCL DEF 13.1 ANGLE 0
M19
M0
L X+100 Y+0 R0 F1000
CC X+0 Y+0
C X+100 Y+0 DR+
L X+101.5 Y+0 R0 F1000
L X+100 Y+0 R0 F1000
CC X+0 Y+0
C X+100 Y+0 DR-
L X+101.5 Y+0 R0 F1000
M0
TOOL CALL Z S4000
M3
CYCL DEF 9.0 DWELL TIME
CYCL DEF 9.1 DWELL 300
CYCL DEF 9.0 DWELL TIME
CYCL DEF 9.1 DWELL 30.5
M5
)");
  EXPECT_EQ(begin_of(Dialect::linuxcnc, "G4 P30.5\nM5\n"), R"(G21 G17 G90 G91.1 G94 G40
G54
M5
(MSG,NEXT THE AXES GO TO X101.5 Y0 - CHECK ZERO, HEIGHT, WAY)
M0
G1 X101.5 Y0 F1000
M19 R0
(MSG,MOUNT THE BAR, START ITS CAPTURE - TEST 1)
M0
G1 X100 Y0 F1000
G3 X100 Y0 I-100 J0
G1 X101.5 Y0 F1000
G1 X100 Y0 F1000
G2 X100 Y0 I-100 J0
G1 X101.5 Y0 F1000
(MSG,TAKE THE BAR OFF, SAVE THE CAPTURE, CLOSE THE DOOR)
M0
S4000 M3
G4 P300
G4 P30.5
M5
)");
}

TEST(spindle_program, the_head_says_what_it_is) {
  const std::string program = spindle_program(sample(), Dialect::linuxcnc, {.title = "which of two"});
  EXPECT_EQ(program.substr(0, program.find("G21")), R"((PROGRAM WARMUP)
)");
  EXPECT_NE(program.find(R"((SPINDLE PROGRAM OF A THERMAL TEST, WRITTEN BY BALLBAR)
(TITLE WHICH OF TWO)
(3 DWELLS, 0.13 H IN ALL, STOPS AND TESTS NOT COUNTED)
(HIGHEST SPEED 9000 RPM - THE TOOL IN THE SPINDLE MUST BEAR IT)
(CHECK CLEARANCES - NO AXIS MOVES BUT IN THE BALLBAR TESTS)
(BEGIN AFTER A NIGHT AT REST)
(NO BALLBAR TEST IN THIS PROGRAM, NO AXIS MOVES)
(DWELL 1 OF 3 - 1 MIN AT 0 RPM)
M5
G4 P60
(1 OF 8 MIN)
(DWELL 2 OF 3 - 7 MIN AT 9000 RPM)
)"),
            std::string::npos)
      << program;
}

// A name or a title that would end a comment, begin a block or be a command of its own.
TEST(spindle_program, texts_of_the_user_stay_comments) {
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
                                 "7"};
  for (const std::string& text : hostile) {
    for (const Dialect dialect : kDialects) {
      const std::string program = spindle_program(sample(), dialect, {.name = text, .title = text});
      expect_plain(program);
      const DryRun run = dry_run_of(program, dialect);
      expect_driven(sample(), run, dialect);
      EXPECT_EQ(run.stops.size(), 2u);
    }
  }
  EXPECT_TRUE(spindle_program(sample(), Dialect::heidenhain, {.name = "7 up"}).starts_with("0 BEGIN PGM P7UP MM\n"));
}

TEST(spindle_program, what_a_machine_cannot_do_is_refused) {
  const std::pair<ProgramOptions, const char*> table[] = {
      {{.max_rpm = 8000.0},
       "Dwell 2 of the schedule, from 1 min: expected at most 8000 rpm, the highest that the machine may turn, found "
       "9000 rpm."},
      {{.number = 0}, "A program's O number: expected 1 to 9999, found 0."},
      {{.range_m = 30}, "A program's M function of the spindle's range: expected 40 to 49, found 30."},
      {{.ballbar = BallbarTest{.radius_mm = NAN}}, "A program's radius in mm: expected 10 to 2000, found nan."},
      {{.ballbar = BallbarTest{.feed_mm_per_min = 0.0}}, "A program's feed in mm/min: expected 1 to 50000, found 0."},
      {{.ballbar = BallbarTest{.feed_in_mm = -1.0}},
       "A program's way of feeding in, in mm: expected 0.1 to 10, found -1."},
      {{.ballbar = BallbarTest{.every_min = -3.0}},
       "A program's minutes between two tests: expected 1 to 44640, found -3."},
  };
  for (const auto& [options, message] : table) {
    for (const Dialect dialect : kDialects) {
      try {
        spindle_program(sample(), dialect, options);
        ADD_FAILURE() << message;
      } catch (const Error& error) {
        EXPECT_STREQ(error.what(), message);
      }
    }
  }
  EXPECT_THROW(spindle_program({}, Dialect::fanuc, {}), Error);
}

}  // namespace
}  // namespace ballbar
