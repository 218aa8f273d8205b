#include "simulate/fleet_toml.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "scratch_folder.hpp"
#include "simulate/fleet_files.hpp"

namespace ballbar {
namespace {

constexpr const char* kFleet = R"(format = "ballbar-fleet 1"
title = "two mills"
seed = 5
started = 2023-01-01T00:00:00
machine_name = "mill"
machines = 2
months = 4
missing_share = 0.0
other_planes_share = 0.0
bars = 1
[test]
readings = 400
noise_um = 0.05
[scatter]
tail_freedom = 5
bad_share = 0.0
[[error]]
name = "backlash"
mean = 2.0
[[story]]
machine = 2
kind = "crash"
month = 2
errors = { squareness_xy = 30.0 }
)";

std::string with(const std::string& from, const std::string& to) {
  std::string text = kFleet;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string fault_of(const std::string& text) {
  try {
    const VirtualFleet fleet = read_fleet(text, "fleet.toml");
    fleet_tests(fleet, fleet_curves(fleet));
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(fleet_toml, reads_what_is_stated) {
  const VirtualFleet fleet = read_fleet(kFleet, "fleet.toml");
  EXPECT_EQ(fleet.title, "two mills");
  EXPECT_EQ(fleet.seed, 5u);
  EXPECT_EQ(fleet.started_s, 1672531200);
  EXPECT_EQ(fleet.machines, 2u);
  EXPECT_EQ(fleet.readings, 400u);
  EXPECT_EQ(fleet.tail_freedom, 5.0);
  ASSERT_EQ(fleet.errors.size(), 1u);
  EXPECT_EQ(fleet.errors[0].mean, 2.0);
  ASSERT_EQ(fleet.stories.size(), 1u);
  EXPECT_EQ(fleet.stories[0].kind, StoryKind::crash);
  EXPECT_EQ(fleet.stories[0].errors.at("squareness_xy"), 30.0);
  EXPECT_TRUE(is_fleet(kFleet));
  EXPECT_FALSE(is_fleet("format = \"ballbar-machine 1\"\n"));
  EXPECT_FALSE(is_fleet("[["));
}

TEST(fleet_toml, says_what_is_wrong_and_where) {
  EXPECT_EQ(fault_of(with("ballbar-fleet 1", "ballbar-fleet 2")),
            "fleet.toml:1:10: expected format = \"ballbar-fleet 1\", found \"ballbar-fleet 2\".");
  EXPECT_EQ(fault_of(with("missing_share = 0.0", "missing_share = 1.5")),
            "fleet.toml:8:17: expected a number from 0 to 1 for missing_share, found 1.5.");
  EXPECT_EQ(fault_of(with("months = 4", "months = -1")),
            "fleet.toml:7:10: expected a count from 0 to 1200 for months, found -1.");
  EXPECT_EQ(
      fault_of(with("machines = 2\nmonths = 4", "machines = 100000\nmonths = 1200")),
      "fleet.toml: expected at most 1000000 months of all machines together, found 100000 machines of 1200 months.");
  EXPECT_EQ(fault_of(with("machine_name = \"mill\"", "machine_name = \"../mill\"")),
            "fleet.toml:5:16: expected a name that a folder may have, found \"../mill\".");
  EXPECT_EQ(fault_of(with("machine = 2", "machine = 3")),
            "fleet.toml: expected a story of machine 1 to 2, found machine 3.");
  EXPECT_EQ(
      fault_of(with("squareness_xy", "squareness_xz")),
      "fleet.toml: expected an error of an axis or a plane, found \"squareness_xz\"; the nearest is squareness_xy.");
  EXPECT_EQ(fault_of(with("\"backlash\"", "\"backlsh\"")),
            "fleet.toml: expected an error that a ballbar test shows, found \"backlsh\"; the nearest is backlash.");
}

TEST(fleet_files, state_machine_bar_and_date_and_have_the_errors) {
  const ScratchFolder scratch;
  const VirtualFleet fleet = read_fleet(kFleet, "fleet.toml");
  const std::filesystem::path folder = scratch.path() / "plant", truth = scratch.path() / "plant-truth.csv";
  const WrittenFleet written = write_fleet(fleet, folder, truth, false);
  EXPECT_EQ(written.machines, 2u);
  EXPECT_EQ(written.files, 8u);
  EXPECT_EQ(read_bytes(truth, kLargestText),
            "# SIMULATED by ballbar simulate, not measured.\nmachine,kind,from,error,amount\n"
            "mill-02,crash,2023-03-02,squareness_xy,30\n");
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "mill-02")) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  ASSERT_EQ(names.size(), 4u);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const B5r test = read_b5r(read_bytes(names[i], kLargestText), names[i].string());
    EXPECT_EQ(test.machine, "mill-02");
    EXPECT_FALSE(test.serial_number.empty());
    ASSERT_EQ(test.runs.size(), 2u);
    const MachineErrors found = machine_errors(test.runs);
    for (const MachineError& error : found.errors) {
      if (error.name == "squareness") {
        EXPECT_NEAR(error.value, i < 2 ? 0.0 : 30.0, 1.0) << names[i];
      } else if (error.name == "backlash_a_pos") {
        EXPECT_NEAR(error.value, 2.0, 0.2) << names[i];
      }
    }
  }
  EXPECT_THROW(write_fleet(fleet, folder, truth, false), Error) << "nothing is written over";
  write_fleet(fleet, folder, truth, true);
}

}  // namespace
}  // namespace ballbar
