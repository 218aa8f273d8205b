// Measured `.b5r` files in a machine's history: scales and squareness beside what the instrument's software stores.
#include "ballbar/history/history.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ballbar/formats/recordings/recording_file.hpp"
#include "errors/stored_test.hpp"
#include "errors/test_files.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

const TestQuantity* found_in(const MachineTest& test, const std::string& name) {
  for (const TestQuantity& quantity : test.quantities) {
    if (quantity.name == name) return &quantity;
  }
  return nullptr;
}

// 3 um/m and 3 sigma: two readings of the same curve.
TEST(history_of_measured_files, scales_and_squareness_are_those_stored) {
  REQUIRE_EXTERNAL_DATA(folder);
  const TestFiles files = read_tests({(folder / "ballbar-b5r").string()}, true);
  ASSERT_EQ(files.tests.size(), 2u);
  std::size_t compared = 0;
  for (const MachineTest& test : files.tests) {
    const MachineTest stored = stored_test(*open_recording(test.file).b5r);
    ASSERT_TRUE(test.squareness && stored.squareness) << test.file;
    EXPECT_NEAR(test.squareness->value, stored.squareness->value, 3.0) << test.file;
    for (const char* name : {"scale_x", "scale_y", "scale_z"}) {
      const TestQuantity *ours = found_in(test, name), *theirs = found_in(stored, name);
      if (ours == nullptr || theirs == nullptr) continue;
      EXPECT_NEAR(ours->value, theirs->value, 3.0) << test.file << ' ' << name;
      EXPECT_NEAR(ours->value, theirs->value, 3.0 * ours->sigma) << test.file << ' ' << name;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 2u) << "of the arc of 220 deg the file declines both";
  const History history = history_of(files.tests);
  ASSERT_EQ(history.machines.size(), 1u);
  EXPECT_EQ(history.machines[0].groups.size(), 2u);
  EXPECT_FALSE(machine_geometry(files.tests).within_a_day);
}

}  // namespace
}  // namespace ballbar
