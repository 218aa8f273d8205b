// The files of a simulated session, and a folder of them written whole or not at all.
//
//   two_arcs           session.toml; per test 00-c.csv and 00-a.csv
//   spindle_rotation   session.toml; per test 00-r.csv and, with axial recordings, 00-z.csv
//   circles            session.toml; per test 00.b5r with its CCW and CW run
//   a spindle alone    series.csv
// and signals.csv and five-probe.csv if the machine has them, and shaft.csv if it keeps the temperature along the shaft
// of the spindle: x_mm from the rear end, then a column T_1800s_degC for each of its times. as_b5r (circles only): only
// the `.b5r` files, as an instrument writes them. Every file states that it is simulated. The results stored in a
// `.b5r` are ballbar's own (polar circle, ISO 230-4), so they do not validate ballbar.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {

struct SimulatedFile {
  std::string name;  // in the session's folder
  std::string bytes;
};

// Throws Error if `.b5r` files cannot hold the session: another method, no start date, balls at different heights,
// two tests that start in the same second.
std::vector<SimulatedFile> simulated_files(const SimulatedSession& simulated, bool as_b5r);

// Writes the files into `folder` and the truth, a series, into `truth_file`; makes folders as needed. All bytes are
// written next to `folder` before the first file gets its name. Without `replace`, throws Error if `folder` is not
// empty or `truth_file` exists. With `replace`, throws Error if an old session.toml or `.b5r` would mix with the new
// files. After an error everything is unchanged.
void write_simulated(const std::vector<SimulatedFile>& files, const Series& truth, const std::filesystem::path& folder,
                     const std::filesystem::path& truth_file, bool replace);

// Throws Error where `folder` holds something or `truth_file` exists and not `replace`; with `replace`, where a
// session.toml or a `.b5r` would stay and mix with the files of these names, below the folder.
void expect_room(const std::set<std::filesystem::path>& names, const std::filesystem::path& folder,
                 const std::filesystem::path& truth_file, bool replace);

// With its parents. Throws Error.
void make_folder(const std::filesystem::path& folder);

}  // namespace ballbar
