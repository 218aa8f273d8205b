// The simulated sample runs: made by their machine.toml byte for byte, and recovered by drift_of.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "ballbar/drift/drift.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "simulate/machine_toml.hpp"
#include "simulate/simulated_files.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFile_bytes = 1'000'000;

fs::path folder_of(const std::string& run) { return fs::path(BALLBAR_SAMPLE_RUNS) / run; }

struct SampleRun {
  const char* name;
  bool as_b5r;
};
constexpr SampleRun kSimulated[] = {
    {"two-arcs-he2015", false}, {"spindle-rotation-huang2022", false}, {"qc20-style-b5r", true}};

VirtualMachine machine_of(const std::string& run) {
  const fs::path file = folder_of(run) / "machine.toml";
  return read_machine(read_bytes(file, kLargestText), file.string());
}

TEST(sample_runs, are_what_their_machine_makes) {
  for (const SampleRun& run : kSimulated) {
    SCOPED_TRACE(run.name);
    std::set<std::string> expected = {"README.md", "machine.toml", "mean-point.toml", "model.toml", "truth"};
    for (const SimulatedFile& file : simulated_files(simulate(machine_of(run.name)), run.as_b5r)) {
      EXPECT_TRUE(read_bytes(folder_of(run.name) / file.name, kLargestTable) == file.bytes) << file.name;
      EXPECT_LT(file.bytes.size(), kLargestFile_bytes) << file.name;
      expected.insert(file.name);
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(run.name))) {
      EXPECT_TRUE(expected.contains(entry.path().filename().string())) << entry.path();
    }
  }
}

Series truth_of(const std::string& run) {
  const fs::path file = folder_of(run) / "truth" / "truth.csv";
  return read_series(read_bytes(file, kLargestTable), file.string());
}

TEST(sample_runs, truth_files_are_the_truth) {
  for (const SampleRun& run : kSimulated) {
    SCOPED_TRACE(run.name);
    const Series made = simulate(machine_of(run.name)).truth, shipped = truth_of(run.name);
    EXPECT_EQ(shipped.time_s, made.time_s);
    ASSERT_EQ(shipped.columns.size(), made.columns.size());
    for (std::size_t i = 0; i < made.columns.size(); ++i) {
      EXPECT_EQ(shipped.columns[i].name, made.columns[i].name);
      EXPECT_EQ(shipped.columns[i].values, made.columns[i].values);
    }
  }
}

double true_um(const Series& truth, const char* column, std::size_t i) { return find_column(truth, column)->values[i]; }

// He 2015, table 2: (3.0, 2.1, 3.9) um at 0, (7.4, 32.2, 8.5) um at 64 min, difference (4.4, 30.1, 4.6) um. One
// sigma of a difference is about 0.02 um in x and y and 0.03 um in z, so 0.1 um is 3 sigma of the worst.
TEST(sample_runs, he2015_table_2) {
  const SessionFiles files = open_session(folder_of("two-arcs-he2015"));
  const Series truth = truth_of("two-arcs-he2015");
  for (const bool sequential : {false, true}) {
    SCOPED_TRACE(sequential ? "sequential" : "joint");
    DriftOptions options;
    options.sequential = sequential;
    const DriftSeries drift = drift_of(files.session, options);
    const Position &cold = drift.positions.at(0), &warm = drift.positions.at(8);
    EXPECT_EQ(warm.time_s, 64.0 * 60.0);
    EXPECT_NEAR(cold.x->value_um, 3.0, 0.1);
    EXPECT_NEAR(cold.y->value_um, 2.1, 0.1);
    EXPECT_NEAR(cold.z->value_um, 3.9, 0.1);
    EXPECT_NEAR(warm.x->value_um, 7.4, 0.1);
    EXPECT_NEAR(warm.y->value_um, 32.2, 0.1);
    EXPECT_NEAR(warm.z->value_um, 8.5, 0.1);
    EXPECT_NEAR(drift.points.at(8).x->value_um, 4.4, 0.1);
    EXPECT_NEAR(drift.points.at(8).y->value_um, 30.1, 0.1);
    EXPECT_NEAR(drift.points.at(8).z->value_um, 4.6, 0.1);
    for (std::size_t i = 0; i < drift.points.size(); ++i) {
      EXPECT_NEAR(drift.points[i].x->value_um, true_um(truth, "x_um", i), 0.1);
      EXPECT_NEAR(drift.points[i].y->value_um, true_um(truth, "y_um", i), 0.1);
      EXPECT_NEAR(drift.points[i].z->value_um, true_um(truth, "z_um", i), 0.12);  // 4 sigma over 14 tests
      EXPECT_LT(drift.positions[i].z->sigma_um, 0.05);
    }
  }
}

// The seed is not a lucky one: over other seeds the centres' errors at 64 min are as large as their sigma says.
// Mean square of 3 * 20 errors in sigma: 1 +- sqrt(2 / 60) = 0.18, sigma itself being estimated; within 4 of these.
TEST(sample_runs, he2015_with_other_seeds) {
  double sum = 0.0;
  constexpr int kSeeds = 20;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    VirtualMachine machine = machine_of("two-arcs-he2015");
    machine.seed = static_cast<std::uint64_t>(seed);
    machine.test_s = {64.0 * 60.0};
    const Position warm = drift_of(simulate(machine).session).positions.at(0);
    sum += std::pow((warm.x->value_um - 7.4) / warm.x->sigma_um, 2);
    sum += std::pow((warm.y->value_um - 32.2) / warm.y->sigma_um, 2);
    sum += std::pow((warm.z->value_um - 8.5) / warm.z->sigma_um, 2);
  }
  EXPECT_NEAR(sum / (3.0 * kSeeds), 1.0, 4.0 * 0.18);
}

// What the README says of the other files. Gains hold to the noise of single readings (0.05 K and 0.03 K of rounding,
// over at least 5 K); five probes to 0.1 um of noise, 5 sigma, and the first reading's share.
TEST(sample_runs, he2015_signals_and_five_probes) {
  const SimulatedSession run = simulate(machine_of("two-arcs-he2015"));
  const auto at = [](const Series& series, const char* column, double time_s) {
    const auto row = std::find(series.time_s.begin(), series.time_s.end(), time_s) - series.time_s.begin();
    return find_column(series, column)->values.at(static_cast<std::size_t>(row));
  };
  for (std::size_t i = 2; i + 2 < run.truth.time_s.size(); ++i) {
    const double t_s = run.truth.time_s[i];
    const double bearing_K = at(run.signals, "T_bearing_degC", t_s) - 21.0;
    const double housing_K = at(run.signals, "T_housing_degC", t_s) - 20.5;
    EXPECT_NEAR(true_um(run.truth, "z_um", i) / bearing_K, 4.6 / 17.9, 0.05 * 4.6 / 17.9);
    EXPECT_NEAR(true_um(run.truth, "y_um", i) / housing_K, 30.1 / 8.5, 0.05 * 30.1 / 8.5);
    const double x1_um = at(run.five_probe, "X1_um", t_s), x2_um = at(run.five_probe, "X2_um", t_s);
    const double y1_um = at(run.five_probe, "Y1_um", t_s), y2_um = at(run.five_probe, "Y2_um", t_s);
    EXPECT_NEAR(x1_um, 0.9 * true_um(run.truth, "x_um", i), 0.5);
    EXPECT_NEAR(y1_um, 1.1 * true_um(run.truth, "y_um", i), 0.5);
    EXPECT_NEAR(x1_um + (x2_um - x1_um) * 25.0 / 80.0, true_um(run.truth, "x_um", i), 0.5);
    EXPECT_NEAR(y1_um + (y2_um - y1_um) * 25.0 / 80.0, true_um(run.truth, "y_um", i), 0.5);
    EXPECT_NEAR(at(run.five_probe, "Z_um", t_s), true_um(run.truth, "z_um", i), 0.5);
  }
}

// The correction named in the README: 2 nm with a level bar, 1 um at h = 5 mm.
TEST(sample_runs, huang2022_elongation_correction) {
  VirtualMachine machine = machine_of("spindle-rotation-huang2022");
  EXPECT_NEAR(*drift_of(simulate(machine).session).points.back().elongation_correction_um, 0.002, 0.0001);
  machine.height_offset_mm = 5.0;
  EXPECT_NEAR(*drift_of(simulate(machine).session).points.back().elongation_correction_um, 1.0, 0.01);
}

// Huang 2022: first centre (-9.2, 2.1) um, first axial length 99.9874 mm, elongation 20.1 um (table 1) and radial
// error 5.93 um at the end. sigma is 0.02 um radial, 0.04 um axial.
TEST(sample_runs, huang2022) {
  const SessionFiles files = open_session(folder_of("spindle-rotation-huang2022"));
  const Series truth = truth_of("spindle-rotation-huang2022");
  const DriftSeries drift = drift_of(files.session);
  ASSERT_EQ(drift.points.size(), 17u);
  EXPECT_NEAR(drift.positions[0].centre_a->value_um, -9.2, 0.1);
  EXPECT_NEAR(drift.positions[0].centre_b->value_um, 2.1, 0.1);
  EXPECT_NEAR(*drift.positions[0].length_mm, 99.9874, 0.0001);
  EXPECT_NEAR(drift.points.back().axial->value_um, 20.1, 0.15);
  EXPECT_NEAR(drift.points.back().radial->value_um, 5.93, 0.1);
  for (std::size_t i = 0; i < drift.points.size(); ++i) {
    EXPECT_NEAR(drift.points[i].axial->value_um, true_um(truth, "axial_um", i), 0.15);
    EXPECT_NEAR(drift.points[i].radial->value_um, true_um(truth, "radial_um", i), 0.1);
    EXPECT_NEAR(drift.points[i].radius_change->value_um, true_um(truth, "radius_change_um", i), 0.1);
  }
}

TEST(sample_runs, qc20_style) {
  const SessionFiles files = open_session(folder_of("qc20-style-b5r"));
  const Series truth = truth_of("qc20-style-b5r");
  const DriftSeries drift = drift_of(files.session);
  ASSERT_EQ(drift.points.size(), 6u);
  for (std::size_t i = 0; i < drift.points.size(); ++i) {
    EXPECT_NEAR(drift.points[i].time_s, 600.0 * static_cast<double>(i), 0.0);
    EXPECT_NEAR(drift.points[i].x->value_um, true_um(truth, "x_um", i), 0.05);
    EXPECT_NEAR(drift.points[i].y->value_um, true_um(truth, "y_um", i), 0.05);
  }
}

}  // namespace
}  // namespace ballbar
