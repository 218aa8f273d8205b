#include "errors/test_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <thread>
#include <unordered_map>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "errors/stored_test.hpp"
#include "errors/tolerance_check.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

// By content; XML of another kind is none.
bool is_kind_of_recording(const Source& source) {
  const Reader* const reader = source.reader();
  return reader != nullptr && !reader->recording.empty();
}

// What one file came to.
struct ReadFile {
  fs::path path;
  bool is_recording = true;
  std::optional<MachineTest> test;  // of a .b5r
  std::optional<Recording> log;
  std::vector<std::string> remarks;
  std::string fault;
  std::optional<std::string> copy_of;
};

std::vector<ReadFile> found_files(const std::vector<std::string>& paths) {
  FoundFiles found = files_below(paths);
  std::vector<ReadFile> files;
  files.reserve(found.files.size() + found.faults.size());
  for (fs::path& path : found.files) files.push_back({std::move(path)});
  for (SkippedFile& fault : found.faults) {
    files.push_back({fault.file});
    files.back().fault = std::move(fault.why);
  }
  std::sort(files.begin(), files.end(),
            [](const ReadFile& left, const ReadFile& right) { return left.path < right.path; });
  return files;
}

// part(i) of every i < count. The thread that called shows how far it is, where a program that called may end it.
void parallel_with_progress(const char* what, std::size_t count, const std::function<void(std::size_t)>& part) {
  const ProgressLine progress;
  const std::thread::id here = std::this_thread::get_id();
  std::atomic<std::size_t> done{0};
  in_parallel(count, [&](std::size_t i) {
    part(i);
    ++done;
    if (std::this_thread::get_id() == here) show_progress(fmt::format("{} {} of {}", what, done.load(), count));
  });
}

void expect_two_axes(const Recording& recording) {
  if (recording.kind == Kind::circle && recording.motion == Motion::linear_axes) return;
  throw Error(recording.kind == Kind::axial ? "expected a circle of two linear axes, found an axial recording."
                                            : fmt::format("expected a circle of two linear axes, found one that is "
                                                          "driven by {}.",
                                                          name_of(recording.motion)));
}

enum class Fits { all, none };

MachineTest test_of(std::span<const Recording> recordings, const MachineErrorOptions& options, Fits fits) {
  for (const Recording& recording : recordings) expect_two_axes(recording);
  if (fits == Fits::none) return test_head(recordings);
  MachineErrorOptions values = options;
  values.details = false;  // no table of tests has them
  return machine_test(machine_errors(recordings, values), recordings);
}

MachineTest test_of(const RecordingFile& file, Fits fits) {
  MachineTest test =
      file.recordings.empty() ? stored_test(*file.b5r) : test_of(file.recordings, error_options(*file.b5r), fits);
  if (test.quantities.empty() && (fits == Fits::all || file.recordings.empty()))
    throw Error("expected readings or stored errors of the machine, found neither.");
  test.machine = file.b5r->machine;
  test.bar = file.b5r->serial_number;
  test.tolerances = stated_tolerances(*file.b5r);
  for (const LimitCheck& one : limit_checks(*file.b5r)) {
    if (one.judgement == Judgement::fail) test.beyond_limits.push_back(one.result.name);
  }
  return test;
}

// What `part` makes of the file; its Error does not name it yet.
template <class Part>
auto of_file(const fs::path& path, const Part& part) {
  try {
    return part();
  } catch (const Error& error) {
    const std::string_view why = error.what();
    throw Error(fmt::format("{}: {}{}", path.string(), why, why.ends_with('.') ? "" : "."));
  }
}

void read(ReadFile& file, const StatedCircle& stated, Fits fits) {
  if (!file.fault.empty()) return;
  try {
    const Source source(file.path);
    file.is_recording = ends_in(file.path, ".b5r") || is_kind_of_recording(source);
    if (!file.is_recording) return;
    RecordingFile opened = open_recording(source, known_readers(), stated);
    file.remarks = std::move(opened.remarks);
    if (opened.b5r) {
      file.test = of_file(file.path, [&] { return test_of(opened, fits); });
    } else if (opened.recordings.size() > 1) {  // both directions in a table
      file.test = of_file(file.path, [&] { return test_of(opened.recordings, {}, fits); });
    } else {
      of_file(file.path, [&] { expect_two_axes(opened.recordings.front()); });
      file.log = std::move(opened.recordings.front());
    }
  } catch (const Error& error) {
    file.fault = error.what();
  }
}

// Both directions of one test, one after the other.
bool are_one_test(const ReadFile& first, const ReadFile& second) {
  constexpr std::int64_t kPairGap_s = 3600;
  if (!first.log || !second.log || first.path.parent_path() != second.path.parent_path()) return false;
  if (!are_both_directions(*first.log, *second.log)) return false;
  const auto &one = first.log->started_s, &other = second.log->started_s;
  if (one.has_value() != other.has_value()) return false;
  return !one || std::abs(*one - *other) <= kPairGap_s;
}

void fit_logs(std::vector<ReadFile>& files, Fits fits) {
  struct Logs {
    std::size_t first = 0, count = 1;
  };
  std::vector<Logs> tests;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (!files[i].log) continue;
    tests.push_back({i, i + 1 < files.size() && are_one_test(files[i], files[i + 1]) ? 2U : 1U});
    i += tests.back().count - 1;
  }
  parallel_with_progress("fitting log", tests.size(), [&](std::size_t k) {
    ReadFile& file = files[tests[k].first];
    std::vector<Recording> recordings;
    recordings.reserve(tests[k].count);
    for (std::size_t i = 0; i < tests[k].count; ++i) recordings.push_back(*std::move(files[tests[k].first + i].log));
    try {
      file.test = of_file(file.path, [&] { return test_of(recordings, {}, fits); });
      if (tests[k].count == 2) file.test->second_file = files[tests[k].first + 1].path.string();
    } catch (const Error& error) {
      file.fault = error.what();
    }
  });
}

// The same numbers of the same moment under two names: a copy, which would count twice.
bool is_copy(const MachineTest& test, const MachineTest& of) {
  if (test.started_s != of.started_s || test.plane != of.plane || test.quantities.size() != of.quantities.size()) {
    return false;
  }
  return std::equal(test.quantities.begin(), test.quantities.end(), of.quantities.begin(),
                    [](const TestQuantity& left, const TestQuantity& right) {
                      return left.name == right.name && left.value == right.value;
                    });
}

std::size_t hash_of(const MachineTest& test) {
  std::size_t hash = std::hash<std::int64_t>{}(test.started_s.value_or(0));
  for (const TestQuantity& quantity : test.quantities) hash = 31 * hash + std::hash<double>{}(quantity.value);
  return hash;
}

TestFiles tests_of(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated, Fits fits) {
  std::vector<ReadFile> files = found_files(paths);
  parallel_with_progress("reading file", files.size(), [&](std::size_t i) { read(files[i], stated, fits); });
  fit_logs(files, fits);
  TestFiles found;
  std::unordered_multimap<std::size_t, std::size_t> known;  // places in tests by hash
  for (ReadFile& file : files) {
    if (!file.is_recording) continue;
    found.files.push_back(file.path);
    found.remarks.insert(found.remarks.end(), file.remarks.begin(), file.remarks.end());
    if (file.test) {
      file.test->file = file.path.string();
      const std::size_t hash = hash_of(*file.test);
      const auto [first, last] = known.equal_range(hash);
      const auto same =
          std::find_if(first, last, [&](const auto& one) { return is_copy(*file.test, found.tests[one.second]); });
      if (same == last) {
        known.emplace(hash, found.tests.size());
        found.tests.push_back(*std::move(file.test));
        continue;
      }
      file.copy_of = found.tests[same->second].file;
      file.fault = fmt::format("{}: expected a different test, found a copy of {}.", file.path.string(), *file.copy_of);
    }
    if (file.fault.empty()) continue;  // the second log of a test
    if (strict) throw Error(file.fault);
    found.skipped.push_back({file.path.string(), file.fault, file.copy_of});
  }
  return found;
}

}  // namespace

TestFiles tests_below(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated) {
  return tests_of(paths, strict, stated, Fits::all);
}

TestFiles test_heads_below(const std::vector<std::string>& paths, const StatedCircle& stated) {
  return tests_of(paths, false, stated, Fits::none);
}

bool are_stored(const std::vector<MachineTest>& tests) {
  return std::all_of(tests.begin(), tests.end(), [](const MachineTest& one) { return one.stored; });
}

TestFiles checked(TestFiles files, double tolerance_um) {
  files.tolerance_um = tolerance_um;
  for (MachineTest& test : files.tests) test.passes = passes(test, tolerance_um);
  return files;
}

TestFiles read_tests(const std::vector<std::string>& paths, bool strict, const StatedCircle& stated) {
  TestFiles found = tests_below(paths, strict, stated);
  if (found.tests.empty()) {
    if (!found.skipped.empty() && found.skipped.front().file == paths.front() && paths.size() == 1) {
      throw Error(found.skipped.front().sentence);  // a file alone
    }
    throw Error(fmt::format("{}: expected .b5r files or ballbar logs of circles, found none{}", paths.front(),
                            found.skipped.empty() ? "." : " that can be used: " + found.skipped.front().sentence));
  }
  return found;
}

}  // namespace ballbar
