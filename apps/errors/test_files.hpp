// The tests in folders: `.b5r` files and ballbar logs, read and fitted on all cores.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/history/history.hpp"

namespace ballbar {

struct SkippedTest {
  std::string file;
  std::string sentence;                // with the file's name
  std::optional<std::string> copy_of;  // the earlier file of which it is a copy
};

struct TestFiles {
  std::vector<MachineTest> tests;            // by name of the file
  std::vector<SkippedTest> skipped;          // with faults, or of another kind of recording
  std::vector<std::string> remarks;          // the readers'
  std::vector<std::filesystem::path> files;  // all that were read
  std::optional<double> tolerance_um;        // of the circularity, if it was given
};

// The recordings in the folders, their subfolders and archives; a path may also be a file. Ignores hidden files, links
// to folders, and files that are not recordings, unless their name ends in .b5r. Two consecutive logs that differ only
// in direction are one test. Throws Error for a path that does not exist; strict: also for the first file that would be
// skipped.
TestFiles tests_below(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated = {});

// The same without a fit: the conditions of each test. `.b5r` files without readings have their stored values.
TestFiles test_heads_below(const std::vector<std::string>& paths, const StatedCircle& stated = {});

// The same, but throws Error if there is no test.
TestFiles read_tests(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated = {});

// Whether all of them are of files without readings.
bool are_stored(const std::vector<MachineTest>& tests);

// The same tests with pass or fail.
TestFiles checked(TestFiles files, double tolerance_um);

}  // namespace ballbar
