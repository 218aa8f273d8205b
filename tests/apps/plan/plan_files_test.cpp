#include "plan/plan_files.hpp"

#include <gtest/gtest.h>

#include <set>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

PlanContents sample() {
  return {.schedule = {.dwells = {{.duration_s = 1800.0}, {.duration_s = 5400.0, .speed_rpm = 12000.0}}},
          .title = "Which of two",
          .text = "Two effects explain the data.",
          .curves = {{"one", 0.6, {0.0, 7200.0}, {0.0, 9.0}, {0.5, 0.5}}, {"two", 0.4, {0.0, 7200.0}, {0.0, 3.0}, {}}},
          .separation = {0.0, 2.0},
          .columns_to_log = {"T_room_degC"},
          .max_rpm = 12000.0};
}

TEST(plan_files, a_folder_that_a_shop_can_run) {
  const ScratchFolder scratch;
  const PlanContents contents = sample();
  write_plan(scratch.path() / "plan", contents);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(scratch.path() / "plan")) names.insert(entry.path().filename());
  EXPECT_EQ(names, (std::set<std::string>{"checklist.txt", "plan.svg", "program.nc", "schedule.csv"}));
  const auto bytes = [&](std::string_view name) { return read_bytes(scratch.path() / "plan" / name, kLargestText); };
  EXPECT_TRUE(bytes("schedule.csv").ends_with("\n30,90,12000,1,0,0\n"));
  EXPECT_NE(bytes("program.nc").find("(TITLE WHICH OF TWO)\n"), std::string::npos);
  EXPECT_NE(bytes("program.nc").find("S12000 M3\n"), std::string::npos);
  EXPECT_TRUE(bytes("program.nc").ends_with("(120 OF 120 MIN)\nM5\nM30\n%\n"));
  EXPECT_TRUE(bytes("checklist.txt").starts_with("Which of two\n2 h in all"));
  EXPECT_NE(bytes("checklist.txt").find("[ ] T_room_degC\n"), std::string::npos);
  EXPECT_TRUE(bytes("plan.svg").ends_with("</svg>\n"));
}

TEST(plan_files, all_or_nothing_and_never_over_another) {
  const ScratchFolder scratch;
  PlanContents contents = sample();
  const auto write = [&](std::string_view name) {
    return complaint(scratch, [&] { write_plan(scratch.path() / name, contents); });
  };
  EXPECT_EQ(write("plan"), "no complaint");
  EXPECT_EQ(
      write("plan"),
      "DIR/plan: expected a new or an empty folder, found one that holds a plan; name another, or remove this one.");
  scratch.write("other/schedule.csv", "mine");
  EXPECT_EQ(write("other"), "DIR/other: expected a new or an empty folder, found one that holds files.");
  contents.max_rpm = 6000.0;
  EXPECT_EQ(write("slow"),
            "Dwell 2 of the schedule, from 30 min: expected at most 6000 rpm, the highest that the machine may turn, "
            "found 12000 rpm.");
  EXPECT_FALSE(fs::exists(scratch.path() / "slow"));
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.path()), fs::directory_iterator()), 2);
}

}  // namespace
}  // namespace ballbar
