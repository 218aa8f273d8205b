// Session `session.toml`: which files belong to which test of a warm-up series; or a folder of `.b5r`.
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

// Where along the five-probe bar the ballbar's ball was, from plane 1 towards plane 2: ball_from_plane_1_mm and
// ball_sigma_mm under [five_probe].
struct BallPlace {
  std::optional<double> from_plane_1_mm;
  std::optional<double> sigma_mm;
};

// The session file as written: paths relative to its folder, nothing opened yet.
struct SessionPlan {
  struct Test {
    double elapsed_s = 0.0;
    std::string c_arc, a_arc, rotation, axial, circle;  // empty: not given
    std::optional<double> axial_length_mm;
  };
  // Which of a test's files stands under which key.
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

// `name` stands in messages. Throws Error with name:line:column; refuses paths that are absolute or leave the folder.
SessionPlan read_session_plan(std::string_view bytes, std::string_view name);

std::string write_session_plan(const SessionPlan& plan);

struct TestFile {
  std::filesystem::path file;
  std::size_t test = 0;  // of Session::tests
};

// Everything the plan names, read. A path may not leave the folder, not through a link either.
struct SessionFiles {
  Session session;
  std::vector<Source> signals;  // read as the user says of the session
  std::optional<Source> five_probe;
  BallPlace ball;
  std::vector<TestFile> recordings;          // in the order of the tests
  std::vector<std::filesystem::path> files;  // all that make up the session, itself included
  std::vector<SkippedFile> skipped;          // of a folder without session.toml: files at fault
  std::vector<std::string> remarks;          // of the same: how its circles were read, whole sentences
};

// A session.toml, or a folder: of a session.toml, else of `.b5r` files (each a test at its DATE_STARTED,
// counted from the first; other files are ignored); or an archive of `.b5r` files. A test with results alone has its
// stored circles.
SessionFiles open_session(const Source& source, std::span<const Reader> readers = known_readers());

}  // namespace ballbar
