#include "errors/test_files.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/history/history.hpp"
#include "ballbar/lab/simulation/simulate.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

std::vector<Recording> circles_of(int number) {
  VirtualMachine machine;
  machine.method = Method::circles;
  machine.truth = {{.time_s = 0.0, .x_um = 3.0, .y_um = -2.0}};
  machine.test_s = {0.0};
  machine.circle.readings = 400;
  machine.backlash_a_um = 1.0;
  machine.seed = static_cast<std::uint64_t>(number + 1);
  std::vector<Recording> circles = simulate(machine).session.tests.at(0).circles;
  for (Recording& circle : circles) {
    circle.started_s = 1'700'000'000 + 86'400 * number;
    circle.feed_mm_per_min = 1000.0;
  }
  return circles;
}

std::string b5r_of(int number) {
  B5r test;
  test.test_name = "test";
  test.runs = circles_of(number);
  return write_b5r(test);
}

std::vector<std::string> names_of(const ScratchFolder& folder, const TestFiles& files) {
  std::vector<std::string> names;
  for (const MachineTest& test : files.tests) names.push_back(fs::path(test.file).lexically_relative(folder.path()));
  return names;
}

TEST(test_files, folders_below_without_hidden_ones_and_loops) {
  const ScratchFolder folder;
  folder.write("b.b5r", b5r_of(1));
  folder.write("2024/a.B5R", b5r_of(2));
  folder.write("2024/deep/er/c.b5r", b5r_of(3));
  folder.write(".trash/d.b5r", b5r_of(4));
  folder.write(".e.b5r", b5r_of(5));
  folder.write("notes.txt", "no recording");
  folder.write("picture.svg", "<svg/>");
  fs::create_directory_symlink(folder.path(), folder.path() / "2024" / "loop");
  const TestFiles files = read_tests({folder.path().string(), (folder.path() / "2024").string()}, true);
  EXPECT_EQ(names_of(folder, files), (std::vector<std::string>{"2024/a.B5R", "2024/deep/er/c.b5r", "b.b5r"}));
  EXPECT_TRUE(files.skipped.empty());
}

TEST(test_files, one_bad_file_is_skipped) {
  const ScratchFolder folder;
  folder.write("a.b5r", b5r_of(1));
  folder.write("b.b5r", b5r_of(2).substr(0, 900));
  folder.write("c.b5r", "");
  folder.write("d.b5r", b5r_of(1));
  Recording few = circles_of(3)[0];
  few.angle_rad.resize(9);
  few.length_mm.resize(9);
  folder.write("e.csv", write_ballbar_log(few));
  const TestFiles files = read_tests({folder.path().string()}, false);
  EXPECT_EQ(names_of(folder, files), (std::vector<std::string>{"a.b5r"}));
  ASSERT_EQ(files.skipped.size(), 4u);
  const std::string name = folder.path().string();
  EXPECT_TRUE(files.skipped[0].sentence.starts_with(name + "/b.b5r:")) << files.skipped[0].sentence;
  EXPECT_EQ(files.skipped[2].sentence, name + "/d.b5r: expected a different test, found a copy of " + name + "/a.b5r.");
  EXPECT_EQ(files.skipped[2].copy_of, name + "/a.b5r");
  EXPECT_FALSE(files.skipped[3].copy_of.has_value());
  EXPECT_TRUE(files.skipped[3].sentence.starts_with(name + "/e.csv: ")) << files.skipped[3].sentence;
  for (const SkippedTest& file : files.skipped) EXPECT_TRUE(file.sentence.ends_with('.')) << file.sentence;
  EXPECT_TRUE(complaint(folder, [&] { read_tests({name}, true); }).starts_with("DIR/b.b5r:"));
}

TEST(test_files, nothing_to_read) {
  const ScratchFolder folder;
  const std::string name = folder.path().string();
  EXPECT_EQ(complaint(folder, [&] { read_tests({name}, false); }),
            "DIR: expected .b5r files or ballbar logs of circles, found none.");
  EXPECT_TRUE(tests_below({name}, false).tests.empty()) << "and no error";
  EXPECT_EQ(complaint(folder, [&] { read_tests({name + "/no"}, false); }),
            "DIR/no: expected a folder of tests, found nothing of that name.");
  folder.write("a.b5r", "<svg/>");
  EXPECT_EQ(complaint(folder, [&] { read_tests({name}, false); }),
            "DIR: expected .b5r files or ballbar logs of circles, found none that can be used: DIR/a.b5r:1:2: expected "
            "TEST_DOCUMENT, the root of a .b5r file, found \"svg\".");
  EXPECT_EQ(complaint(folder, [&] { read_tests({name + "/a.b5r"}, false); }),
            "DIR/a.b5r:1:2: expected TEST_DOCUMENT, the root of a .b5r file, found \"svg\".");
}

// Two logs of one test are what a .b5r of both runs is.
TEST(test_files, logs_of_both_directions_are_one_test) {
  const ScratchFolder folder;
  const std::vector<Recording> circles = circles_of(1);
  folder.write("1-ccw.csv", write_ballbar_log(circles[0]));
  folder.write("1-cw.csv", write_ballbar_log(circles[1]));
  folder.write("2-ccw.csv", write_ballbar_log(circles_of(2)[0]));
  folder.write("3-cw.csv", write_ballbar_log(circles_of(3)[1]));
  const TestFiles files = read_tests({folder.path().string()}, true);
  EXPECT_EQ(names_of(folder, files), (std::vector<std::string>{"1-ccw.csv", "2-ccw.csv", "3-cw.csv"}))
      << "of two days: two tests";
  EXPECT_EQ(files.files.size(), 4u);
  EXPECT_GT(files.tests[0].quantities.size(), files.tests[1].quantities.size()) << "one direction tells less";
}

TEST(test_files, a_folder_that_cannot_be_read_is_skipped) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is closed to root";
  const ScratchFolder folder;
  folder.write("a.b5r", b5r_of(1));
  folder.write("closed/b.b5r", b5r_of(2));
  fs::permissions(folder.path() / "closed", fs::perms::none);
  const TestFiles files = read_tests({folder.path().string()}, false);
  fs::permissions(folder.path() / "closed", fs::perms::owner_all);
  EXPECT_EQ(files.tests.size(), 1u);
  EXPECT_EQ(files.skipped.size(), 1u);
}

}  // namespace
}  // namespace ballbar
