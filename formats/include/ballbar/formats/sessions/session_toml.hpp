// Session `session.toml`: the files of each test of a warm-up series; or a folder of `.b5r` files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/text/reader.hpp"
#include "ballbar/formats/text/source.hpp"

namespace ballbar {

// Position of the ballbar's ball along the five-probe bar, from plane 1 towards plane 2: ball_from_plane_1_mm and
// ball_sigma_mm under [five_probe].
struct BallPlace {
  std::optional<double> from_plane_1_mm;
  std::optional<double> sigma_mm;
};

// The content of the session file, with paths relative to its folder. No other file is open yet.
struct SessionPlan {
  struct Test {
    double elapsed_s = 0.0;
    std::string c_arc, a_arc, rotation, axial, circle;  // empty: not given
    std::optional<double> axial_length_mm;
  };
  // The key of each file of a test.
  struct File {
    std::string_view key;
    std::string Test::*member;
  };
  static constexpr File kFiles[] = {{"c_arc", &Test::c_arc},
                                    {"a_arc", &Test::a_arc},
                                    {"rotation", &Test::rotation},
                                    {"axial", &Test::axial},
                                    {"circle", &Test::circle}};
  Method method = Method::circles;
  std::string title;
  double nominal_length_mm = 100.0;
  bool spindle_above = true;
  std::vector<Test> tests;
  std::vector<std::string> signal_files;
  std::optional<double> bar_expansion_ppm_per_K;
  std::string five_probe_file;  // empty: none
  BallPlace ball;               // of [five_probe]
};

// `name` is used in messages. Throws Error with name:line:column, also for absolute paths and paths out of the folder.
SessionPlan read_session_plan(std::string_view bytes, std::string_view name);

std::string write_session_plan(const SessionPlan& plan);

struct TestFile {
  std::filesystem::path file;
  std::size_t test = 0;  // index into Session::tests
};

// All data of a session. Paths must stay inside its folder, links included.
struct SessionFiles {
  Session session;
  std::vector<Source> signals;  // read with the recipe of the session
  std::optional<Source> five_probe;
  BallPlace ball;
  std::vector<TestFile> recordings;          // in the order of the tests
  std::vector<std::filesystem::path> files;  // all files of the session, with the session file
  std::vector<SkippedFile> skipped;          // folder without session.toml: files that could not be read
  std::vector<std::string> remarks;          // likewise, whole sentences: how its circles were read
};

// Opens a session.toml, a folder with one, a folder of `.b5r` files, or an archive of them. Each `.b5r` is a test at
// its DATE_STARTED, counted from the first; other files are ignored. A test with results only has its stored circles.
SessionFiles open_session(const Source& source, std::span<const Reader> readers = known_readers());

}  // namespace ballbar
