#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <set>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "text/path_inside.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Readers = std::span<const Reader>;

constexpr std::string_view kOwner = "the session";

void expect_nominal_length(const Recording& recording, const fs::path& path, double nominal_length_mm) {
  if (recording.nominal_length_mm == nominal_length_mm) return;
  throw Error(fmt::format("{}: expected the session's nominal length {} mm, found {} mm.", path.string(),
                          nominal_length_mm, recording.nominal_length_mm));
}

// The circles that a file with only results stores. Returns the remarks on a circle in a table.
std::vector<std::string> add_circles(SessionTest& test, const fs::path& path, Readers readers,
                                     const StatedCircle& stated = {}) {
  RecordingFile file = open_recording(path, readers, stated);
  test.circles = std::move(file.recordings);
  if (!test.circles.empty()) return std::move(file.remarks);
  if (file.b5r) {
    for (StoredCircle& one : stored_circles(*file.b5r)) {
      test.circles.push_back(std::move(one.recording));
      test.stored.push_back(std::move(one.circle));
    }
  }
  if (test.circles.empty()) {
    throw Error(fmt::format(
        "{}: expected readings, or the stored centre and radius of a run (AF_CENTRE_OFFSET_A, AF_CENTRE_OFFSET_B, "
        "AF_BEST_RADIUS), found neither.",
        path.string()));
  }
  return {};
}

std::vector<Recording> recordings_in(const SessionPlan& plan, const fs::path& path, Readers readers) {
  RecordingFile file = open_recording(path, readers, {plan.nominal_length_mm});
  expect_readings(file, path);
  for (const Recording& recording : file.recordings) expect_nominal_length(recording, path, plan.nominal_length_mm);
  return std::move(file.recordings);
}

Recording only_recording(const SessionPlan& plan, const fs::path& path, Readers readers) {
  std::vector<Recording> recordings = recordings_in(plan, path, readers);
  if (recordings.size() == 1) return std::move(recordings.front());
  throw Error(fmt::format("{}: expected one recording, found {} runs.", path.string(), recordings.size()));
}

std::string phrase(const Recording& recording) {
  if (recording.kind == Kind::axial) return "an axial recording";
  return fmt::format("a circle in plane {} driven by {}", name_of(recording.plane), name_of(recording.motion));
}

// As `expected` in kind and motion, and in plane unless the spindle drives.
Recording recording_like(const SessionPlan& plan, const fs::path& path, std::string_view key, const Recording& expected,
                         Readers readers) {
  Recording found = only_recording(plan, path, readers);
  const bool circle = expected.kind == Kind::circle;
  const bool any_plane = expected.motion == Motion::spindle;
  if (found.kind == expected.kind &&
      (!circle || (found.motion == expected.motion && (any_plane || found.plane == expected.plane)))) {
    return found;
  }
  const std::string expected_phrase = circle && any_plane ? "a circle driven by spindle" : phrase(expected);
  throw Error(fmt::format("{}: expected {} for {}, found {}.", path.string(), expected_phrase, key, phrase(found)));
}

SessionTest test_of(const SessionPlan& plan, const SessionPlan::Test& planned, const fs::path& folder,
                    Readers readers) {
  SessionTest test;
  test.elapsed_s = planned.elapsed_s;
  if (plan.method == Method::two_arcs) {
    test.name = planned.c_arc;
    Recording expected;
    expected.motion = Motion::rotary_axis;
    test.c_arc = recording_like(plan, path_inside(folder, planned.c_arc, kOwner), "c_arc", expected, readers);
    expected.plane = Plane::YZ;
    test.a_arc = recording_like(plan, path_inside(folder, planned.a_arc, kOwner), "a_arc", expected, readers);
  } else if (plan.method == Method::spindle_rotation) {
    test.name = planned.rotation;
    Recording expected;
    expected.motion = Motion::spindle;
    test.rotation = recording_like(plan, path_inside(folder, planned.rotation, kOwner), "rotation", expected, readers);
    expected.kind = Kind::axial;
    if (!planned.axial.empty()) {
      test.axial = recording_like(plan, path_inside(folder, planned.axial, kOwner), "axial", expected, readers);
    }
    test.axial_length_mm = planned.axial_length_mm;
  } else {
    test.name = planned.circle;
    const fs::path path = path_inside(folder, planned.circle, kOwner);
    add_circles(test, path, readers, {plan.nominal_length_mm});
    for (const Recording& circle : test.circles) {
      expect_nominal_length(circle, path, plan.nominal_length_mm);
      if (circle.kind != Kind::circle)
        throw Error(fmt::format("{}: expected a circle for circle, found {}.", path.string(), phrase(circle)));
    }
  }
  return test;
}

SessionFiles planned_session(const Source& source, Readers readers) {
  const fs::path path = source.path();
  const std::string bytes = source.bytes(kLargestText);
  const Reader* const reader = reader_of(bytes, readers);
  const auto read = read_of<ReadSession>(reader);
  if (reader != nullptr && read == nullptr) {
    throw Error(
        fmt::format("{}:1:1: expected a session (a folder or a file with format = \"ballbar-session 1\"), found {}.",
                    path.string(), found_in(reader)));
  }
  // Of text of no known format read_session_plan tells what it lacks.
  const SessionPlan plan = (read != nullptr ? read : read_session_plan)(bytes, path.string());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  SessionFiles files;
  files.session.method = plan.method;
  files.session.title = plan.title;
  files.session.nominal_length_mm = plan.nominal_length_mm;
  files.session.bar_expansion_ppm_per_K = plan.bar_expansion_ppm_per_K;
  files.session.spindle_above = plan.spindle_above;
  for (const SessionPlan::Test& test : plan.tests) {
    files.session.tests.push_back(test_of(plan, test, folder, readers));
  }
  for (const std::string& file : plan.signal_files)
    files.signals.push_back(source.like(path_inside(folder, file, kOwner)));
  if (!plan.five_probe_file.empty()) files.five_probe = source.like(path_inside(folder, plan.five_probe_file, kOwner));
  files.ball = plan.ball;
  files.files = paths_of(files.signals);
  files.files.push_back(path);
  if (files.five_probe) files.files.push_back(files.five_probe->path());
  for (std::size_t i = 0; i < plan.tests.size(); ++i) {
    for (const SessionPlan::File& one : SessionPlan::kFiles) {
      const std::string& file = plan.tests[i].*one.member;
      if (file.empty()) continue;
      files.recordings.push_back({folder / file, i});
      files.files.push_back(folder / file);
    }
  }
  return files;
}

// A drift is a change: of tests of one plane each there is none, but what a machine's file says.
void expect_a_repeated_plane(const fs::path& folder, const std::vector<SessionTest>& tests,
                             const std::vector<SkippedFile>& skipped) {
  std::map<Plane, std::size_t> tests_in;
  for (const SessionTest& test : tests) {
    std::set<Plane> planes;
    for (const Recording& circle : test.circles) planes.insert(circle.plane);
    for (const Plane plane : planes) ++tests_in[plane];
  }
  std::string found;
  for (const auto& [plane, count] : tests_in) {
    if (count > 1) return;
    found += fmt::format("{}{}", found.empty() ? "" : ", ", name_of(plane));
  }
  throw Error(
      fmt::format("{0}: expected at least two tests of the same plane for a drift, found one of {1}. Use ballbar "
                  "history {0} for squareness and scales.{2}",
                  folder.string(), found, skipped.empty() ? "" : " Omitted: " + skipped.front().why));
}

// The `.b5r` files of the folder itself, or of the archive; where a folder has none, its other recordings.
std::vector<fs::path> tests_in(const fs::path& folder, Readers readers) {
  if (is_archive(folder)) return files_in_archive(folder);
  std::vector<fs::path> paths, others;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    (ends_in(entry->path(), ".b5r") ? paths : others).push_back(entry->path());
  }
  if (paths.empty()) {
    std::copy_if(others.begin(), others.end(), std::back_inserter(paths), [&](const fs::path& path) {
      const Source file(path);
      return file.is_file() && is_recording_file(file, readers);
    });
  }
  if (error) throw Error(fmt::format("{}: expected a readable folder, found: {}.", folder.string(), error.message()));
  if (paths.empty()) {
    throw Error(fmt::format("{}: expected a folder with session.toml or recordings (.b5r, circles), found neither.",
                            folder.string()));
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

struct StartedTest {
  fs::path path;
  double started_s = 0.0;
  SessionTest test;
  std::vector<std::string> remarks{};
};

// `known_s`: where a user states it, of a file without a date.
StartedTest started_test(const fs::path& path, Readers readers, std::optional<double> known_s,
                         const StatedCircle& stated) {
  StartedTest started{path};
  started.remarks = add_circles(started.test, path, readers, stated);
  started.test.name = path.filename().string();
  const std::optional<std::int64_t> started_s = started.test.circles.front().started_s;
  if (!started_s && !known_s) {
    throw Error(
        fmt::format("{}: expected DATE_STARTED, the time of this test, found none that can be read. State the interval "
                    "of the tests in order of their names, as in --every 30min.",
                    path.string()));
  }
  started.started_s = started_s ? static_cast<double>(*started_s) : *known_s;
  return started;
}

// By their times. What is at fault, and a second test of one moment, is skipped.
std::vector<StartedTest> started_tests(const std::vector<fs::path>& paths, Readers readers,
                                       std::optional<double> every_s, std::vector<SkippedFile>& skipped) {
  std::vector<StartedTest> tests;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const fs::path& path = paths[k];
    try {
      const auto known_s = every_s ? std::optional(*every_s * static_cast<double>(k)) : std::nullopt;
      // A radius that one table leaves open is that of the first.
      const StatedCircle stated{tests.empty() ? std::nullopt
                                              : std::optional(tests.front().test.circles.front().nominal_length_mm)};
      tests.push_back(started_test(path, readers, known_s, stated));
    } catch (const Error& error) {
      skipped.push_back({path.string(), error.what()});
    }
  }
  std::stable_sort(tests.begin(), tests.end(),
                   [](const StartedTest& left, const StartedTest& right) { return left.started_s < right.started_s; });
  const auto again = std::unique(tests.begin(), tests.end(), [&](const StartedTest& first, const StartedTest& second) {
    if (first.started_s != second.started_s) return false;
    skipped.push_back({second.path.string(),
                       fmt::format("{}: expected tests that started at different times, found the same DATE_STARTED as "
                                   "{} has.",
                                   second.path.string(), first.test.name)});
    return true;
  });
  tests.erase(again, tests.end());
  return tests;
}

// Each recording a test, at its own DATE_STARTED, or so far after the one before.
SessionFiles session_of_folder(const fs::path& folder, Readers readers, std::optional<double> every_s) {
  SessionFiles files;
  const std::vector<fs::path> paths = tests_in(folder, readers);
  files.files = is_archive(folder) ? std::vector{folder} : paths;
  std::vector<StartedTest> tests = started_tests(paths, readers, every_s, files.skipped);
  if (tests.empty()) {
    throw Error(files.skipped.size() == 1 ? files.skipped.front().why
                                          : fmt::format("{}: expected .b5r files that can be read, found none: {}",
                                                        folder.string(), files.skipped.front().why));
  }
  std::error_code error;
  files.session.method = Method::circles;
  files.session.title = fs::weakly_canonical(folder, error).filename().string();
  files.session.nominal_length_mm = tests.front().test.circles.front().nominal_length_mm;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    StartedTest& started = tests[i];
    for (const Recording& circle : started.test.circles) {
      if (circle.nominal_length_mm == files.session.nominal_length_mm) continue;
      throw Error(
          fmt::format("{0}: expected tests of one nominal length for a drift, found {1} mm in {2} and {3} mm in {4}. "
                      "Use ballbar history {0} for different lengths.",
                      folder.string(), files.session.nominal_length_mm, files.session.tests.front().name,
                      circle.nominal_length_mm, started.test.name));
    }
    files.remarks.insert(files.remarks.end(), started.remarks.begin(), started.remarks.end());
    started.test.elapsed_s = started.started_s - tests.front().started_s;
    files.recordings.push_back({started.path, i});
    files.session.tests.push_back(std::move(started.test));
  }
  expect_a_repeated_plane(folder, files.session.tests, files.skipped);
  return files;
}

}  // namespace

SessionFiles open_session(const Source& source, Readers readers) {
  std::error_code error;
  const fs::path path = source.path();
  if (!fs::is_directory(path, error)) {
    return source.is_archive() ? session_of_folder(path, readers, source.recipe().every_s)
                               : planned_session(source, readers);
  }
  const fs::path plan = path / "session.toml";
  return fs::exists(plan, error) ? planned_session(source.like(plan), readers)
                                 : session_of_folder(path, readers, source.recipe().every_s);
}

}  // namespace ballbar
