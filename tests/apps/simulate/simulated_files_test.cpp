#include "simulate/simulated_files.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

VirtualMachine two_tests(Method method) {
  VirtualMachine machine;
  machine.method = method;
  machine.title = "a title";
  machine.truth = {{0.0, 0.0, 0.0, 0.0, 0.0}, {600.0, 1.0, 2.0, 3.0, 0.0}};
  machine.test_s = {0.0, 600.0};
  machine.c_arc.readings = machine.a_arc.readings = machine.circle.readings = 100;
  machine.started_s = 1'000'000'000;  // 2001-09-09T01:46:40
  machine.signals = {{"T_air_degC", Role::ambient, {0.0}, {20.0}, 0.0, 0.1}};
  machine.five_probe.present = true;
  return machine;
}

std::vector<std::string> names(const std::vector<SimulatedFile>& files) {
  std::vector<std::string> result;
  for (const SimulatedFile& file : files) result.push_back(file.name);
  return result;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> result;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) result.push_back(entry.path().filename());
  std::sort(result.begin(), result.end());
  return result;
}

TEST(simulated_files, names_by_method) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(names(simulated_files(simulate(two_tests(Method::two_arcs)), false)),
            (Names{"00-c.csv", "00-a.csv", "01-c.csv", "01-a.csv", "signals.csv", "five-probe.csv", "session.toml"}));
  VirtualMachine machine = two_tests(Method::spindle_rotation);
  machine.signals.clear();
  machine.five_probe.present = false;
  EXPECT_EQ(names(simulated_files(simulate(machine), false)), (Names{"00-r.csv", "01-r.csv", "session.toml"}));
  machine.axial.readings = 5;
  EXPECT_EQ(names(simulated_files(simulate(machine), false)),
            (Names{"00-r.csv", "00-z.csv", "01-r.csv", "01-z.csv", "session.toml"}));
  EXPECT_EQ(names(simulated_files(simulate(two_tests(Method::circles)), false)),
            (Names{"00.b5r", "01.b5r", "signals.csv", "five-probe.csv", "session.toml"}));
  EXPECT_EQ(names(simulated_files(simulate(two_tests(Method::circles)), true)), (Names{"00.b5r", "01.b5r"}));
}

// 2 cells of 260 mm: their middles are 130 and 390 mm from the rear end.
TEST(simulated_files, temperatures_along_the_shaft) {
  VirtualMachine machine;
  machine.series = true;
  machine.spindle = VirtualSpindle{};
  machine.spindle->body.cells = 2.0;
  machine.spindle->plan = {.time_s = {0.0}, .speed_rpm = {10000.0}, .end_s = 120.0};
  machine.spindle->mechanisms.thermostat = false;
  machine.spindle->clock.profile_s = {0.0, 97.5};
  const SimulatedSession simulated = simulate(machine);
  const std::vector<SimulatedFile> files = simulated_files(simulated, false);
  EXPECT_EQ(names(files), (std::vector<std::string>{"series.csv", "shaft.csv"}));
  const auto degC = [&](std::size_t profile, std::size_t cell) {
    return std::round(simulated.profiles.at(profile).shaft.degC.at(cell) * 1e6) / 1e6;
  };
  EXPECT_EQ(files[1].bytes, fmt::format("# # SIMULATED by ballbar simulate, not measured.\n"
                                        "x_mm,T_0s_degC,T_97.5s_degC\n"
                                        "130,{},{}\n"
                                        "390,{},{}\n",
                                        degC(0, 0), degC(1, 0), degC(0, 1), degC(1, 1)));
  EXPECT_NEAR(degC(0, 1), 20.0, 0.1);  // the room's, and a little of the pump's heat
  EXPECT_GT(degC(1, 1), 20.5);
}

TEST(simulated_files, every_file_says_that_it_is_simulated) {
  for (const Method method : {Method::two_arcs, Method::spindle_rotation, Method::circles}) {
    for (const SimulatedFile& file : simulated_files(simulate(two_tests(method)), false)) {
      EXPECT_NE(file.bytes.find("SIMULATED by ballbar"), std::string::npos) << file.name;
    }
  }
}

// A session that is written and opened again is the session.
TEST(simulated_files, read_back) {
  for (const Method method : {Method::two_arcs, Method::spindle_rotation, Method::circles}) {
    SCOPED_TRACE(name_of(method));
    const ScratchFolder scratch;
    VirtualMachine machine = two_tests(method);
    if (method == Method::two_arcs) machine.height_offset_mm = 5.0;
    const SimulatedSession simulated = simulate(machine);
    write_simulated(simulated_files(simulated, false), simulated.truth, scratch.path() / "run",
                    scratch.path() / "truth.csv", false);
    const SessionFiles again = open_session(scratch.path() / "run" / "session.toml");
    EXPECT_EQ(again.session.method, method);
    EXPECT_EQ(again.session.title, "a title");
    ASSERT_EQ(again.session.tests.size(), 2u);
    const SessionTest &one = simulated.session.tests[1], &two = again.session.tests[1];
    EXPECT_EQ(two.elapsed_s, 600.0);
    ASSERT_EQ(two.c_arc.has_value(), one.c_arc.has_value());
    if (one.c_arc) {
      EXPECT_EQ(two.c_arc->length_mm, one.c_arc->length_mm);
      EXPECT_EQ(two.c_arc->time_s, one.c_arc->time_s);
      EXPECT_EQ(two.c_arc->height_offset_mm, 5.0);
      EXPECT_EQ(two.a_arc->length_mm, one.a_arc->length_mm);
      EXPECT_EQ(two.a_arc->angle_rad, one.a_arc->angle_rad);
    }
    EXPECT_EQ(two.axial_length_mm, one.axial_length_mm);
    ASSERT_EQ(two.circles.size(), one.circles.size());
    for (std::size_t i = 0; i < one.circles.size(); ++i) {
      EXPECT_EQ(two.circles[i].direction, one.circles[i].direction);
      ASSERT_EQ(two.circles[i].length_mm.size(), one.circles[i].length_mm.size());
      for (std::size_t k = 0; k < one.circles[i].length_mm.size(); ++k) {  // five decimals of a mm
        ASSERT_NEAR(two.circles[i].length_mm[k], one.circles[i].length_mm[k], 1e-9);
        ASSERT_NEAR(two.circles[i].angle_rad[k], one.circles[i].angle_rad[k], 1e-9);
      }
    }
    EXPECT_EQ(again.signals.size(), 1u);
    ASSERT_TRUE(again.five_probe.has_value());
    EXPECT_EQ(read_series(read_bytes(again.five_probe->path(), kLargestTable), "p").five_probe->spacing_mm, 60.0);
    EXPECT_EQ(read_series(read_bytes(scratch.path() / "truth.csv", kLargestTable), "t").time_s,
              (std::vector<double>{0.0, 600.0}));
  }
}

// A log's angles are the decimals they were made of: 1000 readings over a turn from 90 deg.
TEST(simulated_files, short_decimals) {
  VirtualMachine machine = two_tests(Method::two_arcs);
  machine.c_arc.readings = 1000;
  const std::string log = simulated_files(simulate(machine), false).front().bytes;
  EXPECT_NE(log.find(",90.18,"), std::string::npos);
  EXPECT_EQ(log.find("0000000"), std::string::npos);
  EXPECT_EQ(log.find("9999999"), std::string::npos);
}

TEST(simulated_files, a_folder_of_b5r) {
  const ScratchFolder scratch;
  const SimulatedSession simulated = simulate(two_tests(Method::circles));
  write_simulated(simulated_files(simulated, true), simulated.truth, scratch.path() / "run", scratch.path() / "t.csv",
                  false);
  const SessionFiles again = open_session(scratch.path() / "run");
  ASSERT_EQ(again.session.tests.size(), 2u);
  EXPECT_EQ(again.session.tests[1].elapsed_s, 600.0);
  const B5r test = read_b5r(read_bytes(scratch.path() / "run" / "01.b5r", kLargestText), "01.b5r");
  EXPECT_EQ(test.ballbar_model, "simulated");
  EXPECT_EQ(test.test_name, "SIMULATED by ballbar, not measured: a title");
  EXPECT_EQ(test.runs.at(0).started_s, 1'000'000'600);
  // stored to 0.1 um: c = (1, 2) um, R = 100 mm; sigma of the fit is 0.2 um sqrt(2 / 100) = 0.03 um
  EXPECT_NEAR(*stored_value(test, "run 0", "AF_CENTRE_OFFSET_A", "UT_LENGTH_MM"), 0.001, 0.0002);
  EXPECT_NEAR(*stored_value(test, "run 1", "AF_CENTRE_OFFSET_B", "UT_LENGTH_MM"), 0.002, 0.0002);
  EXPECT_NEAR(*stored_value(test, "run 0", "AF_BEST_RADIUS", "UT_LENGTH_MM"), 100.0, 0.0002);
  EXPECT_TRUE(stored_value(test, "ISO230_4 2005", "AF_CIRCULAR_DEVIATION_BIDIRECTIONAL", "UT_LENGTH_UM").has_value());
}

TEST(simulated_files, what_b5r_cannot_hold) {
  const ScratchFolder scratch;
  const auto refused = [&](const VirtualMachine& machine) {
    return complaint(scratch, [&] { simulated_files(simulate(machine), true); });
  };
  EXPECT_EQ(refused(two_tests(Method::two_arcs)),
            "Only method circles makes .b5r files: expected it with --b5r, found two_arcs.");
  VirtualMachine machine = two_tests(Method::circles);
  machine.height_offset_mm = 5.0;
  EXPECT_EQ(refused(machine), "A .b5r file has no place for height_offset_mm: expected 0, found 5.");
  machine = two_tests(Method::circles);
  machine.test_s = {0.0, 0.25};
  EXPECT_EQ(refused(machine),
            "The start date of a .b5r file has whole seconds: expected tests that start in different ones, found 0 s "
            "and 0.25 s.");
  machine.started_s.reset();
  EXPECT_EQ(refused(machine),
            "A .b5r file states when its test started, and the virtual machine does not: give it a line such as "
            "started = 2024-03-04T08:00:00.");
}

TEST(write_simulated, refuses_what_is_there_and_leaves_it) {
  const ScratchFolder scratch;
  scratch.write("run/notes.txt", "mine");
  const SimulatedSession simulated = simulate(two_tests(Method::circles));
  const std::vector<SimulatedFile> files = simulated_files(simulated, true);
  const auto refused = [&](const char* truth, bool replace) {
    return complaint(scratch, [&] {
      write_simulated(files, simulated.truth, scratch.path() / "run", scratch.path() / truth, replace);
    });
  };
  EXPECT_EQ(refused("t.csv", false),
            "DIR/run: expected a new or an empty folder, found one that holds files; --force replaces those of the "
            "same names.");
  EXPECT_EQ(names_in(scratch.path()), std::vector<std::string>{"run"});
  EXPECT_EQ(refused("run/notes.txt", false),
            "DIR/run/notes.txt: expected a new file for the truth, found one; --force "
            "replaces it.");
  scratch.write("run/05.b5r", "of another session");
  EXPECT_EQ(refused("t.csv", true),
            "DIR/run: expected a folder whose recordings are all replaced, found 05.b5r, which would mix with the new "
            "ones; remove it first.");
  EXPECT_EQ(names_in(scratch.path() / "run"), (std::vector<std::string>{"05.b5r", "notes.txt"}));
  fs::remove(scratch.path() / "run" / "05.b5r");
  EXPECT_EQ(refused("t.csv", true), "no complaint");
  EXPECT_EQ(names_in(scratch.path() / "run"), (std::vector<std::string>{"00.b5r", "01.b5r", "notes.txt"}));
  EXPECT_EQ(read_bytes(scratch.path() / "run" / "notes.txt", kLargestText), "mine");
}

TEST(write_simulated, nothing_half_written) {
  const ScratchFolder scratch;
  scratch.write("file", "in the way");
  const SimulatedSession simulated = simulate(two_tests(Method::two_arcs));
  const std::vector<SimulatedFile> files = simulated_files(simulated, false);
  EXPECT_EQ(
      complaint(
          scratch,
          [&] { write_simulated(files, simulated.truth, scratch.path() / "file", scratch.path() / "t.csv", true); }),
      "DIR/file: expected a folder, found a file.");
  EXPECT_EQ(complaint(scratch, [&] { write_simulated(files, simulated.truth, "", scratch.path() / "t.csv", true); }),
            "Expected the name of a folder to write to, found an empty one.");
  // The truth cannot be written: its folder is a file.
  EXPECT_NE(complaint(scratch,
                      [&] {
                        write_simulated(files, simulated.truth, scratch.path() / "run",
                                        scratch.path() / "file" / "t.csv", true);
                      }),
            "no complaint");
  EXPECT_EQ(names_in(scratch.path()), std::vector<std::string>{"file"});
}

}  // namespace
}  // namespace ballbar
