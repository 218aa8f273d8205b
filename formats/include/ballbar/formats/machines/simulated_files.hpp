// The files of a simulated session, and a folder of them written whole or not at all.
//
//   two_arcs           session.toml, 00-c.csv and 00-a.csv a test
//   spindle_rotation   session.toml, 00-r.csv and, where axial recordings were made, 00-z.csv a test
//   circles            session.toml, 00.b5r a test with its CCW and CW run
//   a spindle alone    series.csv
// with signals.csv and five-probe.csv where the machine has them, and shaft.csv where it keeps the temperature along
// the spindle's shaft: x_mm from the rear end, then a column T_1800s_degC for each of its times. as_b5r (circles only):
// the `.b5r` files alone, the folder as an instrument leaves it. Every file says that it is simulated. The results
// stored in a `.b5r` are ballbar's own (polar circle, ISO 230-4), so they prove nothing about ballbar.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/lab/simulation/simulate.hpp"

namespace ballbar {

struct SimulatedFile {
  std::string name;  // in the session's folder
  std::string bytes;
};

// Throws Error where `.b5r` files cannot hold the session: another method, no start date, a height of the
// balls, two tests that start in the same second.
std::vector<SimulatedFile> simulated_files(const SimulatedSession& simulated, bool as_b5r);

// Writes the files into `folder` and the truth, a series, into `truth_file`; folders are made as needed. All
// bytes are written beside `folder` before the first file gets its name. Throws Error, with everything as
// it was: `folder` holds something or `truth_file` exists and not `replace`; with `replace`, the folder holds
// a session.toml or a `.b5r` that would stay and mix with the new files.
void write_simulated(const std::vector<SimulatedFile>& files, const Series& truth, const std::filesystem::path& folder,
                     const std::filesystem::path& truth_file, bool replace);

}  // namespace ballbar
