// The tests in folders: `.b5r` files and ballbar logs, read and fitted on all cores.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/history/machine_test.hpp"

namespace ballbar {

struct SkippedTest {
  std::string file;
  std::string sentence;                // with the file's name
  std::optional<std::string> copy_of;  // the file before it of whose test it is a copy
};

struct TestFiles {
  std::vector<MachineTest> tests;            // by name of the file
  std::vector<SkippedTest> skipped;          // with faults, or of another kind of recording
  std::vector<std::string> remarks;          // the readers'
  std::vector<std::filesystem::path> files;  // all that were read
};

// Recordings in the folders and those below them, and in archives; a path may be a file too. Hidden ones and links to
// folders are passed over, and files that are no recording, unless their name ends in .b5r. Two logs that stand one
// after the other and differ in direction alone are one test. Throws Error for a path that is not there; strict: at the
// first file that would be skipped.
TestFiles tests_below(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated = {});

// The same without a fit: what each test was made with. Of `.b5r` files without readings with what they store.
TestFiles test_heads_below(const std::vector<std::string>& paths, const StatedCircle& stated = {});

// The same, where no test at all is an Error.
TestFiles read_tests(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated = {});

}  // namespace ballbar
