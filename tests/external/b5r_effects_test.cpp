// Errors of the machine beside what the instrument's software stored of them (RENISHAW_DIAGNOSTICS) in measured `.b5r`
// files: our effects against its own simulated curves, and our fit to the readings against its values.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/machine_errors/machine_errors.hpp"
#include "ballbar/units.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char* kFiles[] = {"xy-360-50mm.b5r", "zx-220-100mm.b5r"};

RecordingFile opened(const std::filesystem::path& data, const char* name) {
  return open_recording(data / "ballbar-b5r" / name);
}

// What a unit of each row adds to every reading, and the names of the rows. A cyclic error is each run's own.
struct Columns {
  std::vector<std::string> names;
  std::vector<VectorXd> values;
};

void add_effect(Columns& columns, const Effect& effect, const Series& trace, double pitch_mm, double run) {
  const auto n = static_cast<Eigen::Index>(trace.time_s.size());
  EffectRows rows{trace.time_s, {}};
  for (const Input& input : effect.inputs) {
    rows.inputs.emplace_back(find_column(trace, trace_column(input.role))->values);
  }
  const std::vector<double>& recording = find_column(trace, "recording")->values;
  for (std::size_t k = 0; k < effect.parameters.size(); ++k) {
    if (effect.parameters[k].kind != ParameterKind::gain) continue;
    std::vector<double> parameters;
    for (const Parameter& parameter : effect.parameters) {
      parameters.push_back(parameter.kind == ParameterKind::gain ? 0.0 : pitch_mm);
    }
    parameters[k] = 1.0;
    VectorXd values(n);
    effect.evaluate(rows, parameters.data(), values.data(), nullptr);
    for (Eigen::Index i = 0; run >= 0.0 && i < n; ++i) {
      if (recording[static_cast<std::size_t>(i)] != run) values[i] = 0.0;
    }
    const std::string& row = effect.parameters[k].row;
    columns.names.push_back((row.empty() ? effect.name : effect.name + "_" + row) +
                            (run >= 0.0 ? fmt::format(" of run {}", run) : ""));
    columns.values.push_back(values);
  }
}

Columns stored_model(const RecordingFile& file, const Series& trace) {
  Columns columns;
  const std::vector<double>& angle = find_column(trace, "angle_rad")->values;
  const std::vector<double>& direction = find_column(trace, "direction")->values;
  const auto add = [&](const char* name, double (*part)(double), bool shift) {
    VectorXd values(static_cast<Eigen::Index>(angle.size()));
    for (std::size_t i = 0; i < angle.size(); ++i) {
      values[static_cast<Eigen::Index>(i)] = part(angle[i]) * (shift ? 0.5 * direction[i] : 1.0);
    }
    columns.names.emplace_back(name);
    columns.values.push_back(values);
  };
  const auto one = [](double) { return 1.0; };
  const auto cos = [](double x) { return std::cos(x); };
  const auto sin = [](double x) { return std::sin(x); };
  add("global_scale", one, false);
  add("centre_a", cos, false);
  add("centre_b", sin, false);
  add("radius_change", one, true);
  add("offset_a_shift", cos, true);
  add("offset_b_shift", sin, true);
  for (const auto& effect : built_in_catalogue()) {
    if (effect->rules.error_fit == ErrorFit::together) add_effect(columns, *effect, trace, 0.0, -1.0);
    if (effect->rules.error_fit != ErrorFit::along_the_travel) continue;
    const char axis = effect->rules.reversal_deg == 0.0 ? 'A' : 'B';
    for (const double run : {0.0, 1.0}) add_effect(columns, *effect, trace, *stored_pitch_mm(*file.b5r, axis), run);
  }
  return columns;
}

// Least squares of the stored model's own curve, 10 nm a step, on our effects. Within 11.5 deg of a reversal it draws
// the spike as a polyline in place of the cyclic error.
TEST(StoredDiagnostics, ForwardModelIsThatOfTheSimulatedCurves) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : kFiles) {
    const RecordingFile file = opened(data, name);
    const Series trace = trace_of(file.recordings);
    const Columns columns = stored_model(file, trace);
    const std::vector<double>& angle = find_column(trace, "angle_rad")->values;
    std::vector<double> curve;
    for (const Recording& recording : file.recordings) {
      const SimulatedCurve* simulated = simulated_curve(*file.b5r, recording.direction);
      ASSERT_NE(simulated, nullptr) << name;
      curve.insert(curve.end(), simulated->deviation_um.begin(), simulated->deviation_um.end());
    }
    ASSERT_EQ(curve.size(), angle.size()) << name;
    std::vector<Eigen::Index> far;
    for (std::size_t i = 0; i < angle.size(); ++i) {
      if (std::abs(std::remainder(deg_from_rad(angle[i]), 90.0)) > 11.5) far.push_back(static_cast<Eigen::Index>(i));
    }
    MatrixXd x(static_cast<Eigen::Index>(far.size()), static_cast<Eigen::Index>(columns.names.size()));
    for (std::size_t k = 0; k < columns.values.size(); ++k) {
      x.col(static_cast<Eigen::Index>(k)) = columns.values[k](far);
    }
    const VectorXd y = VectorXd::Map(curve.data(), static_cast<Eigen::Index>(curve.size()))(far);
    const VectorXd found = x.completeOrthogonalDecomposition().solve(y);
    const double rms_um = std::sqrt((y - x * found).squaredNorm() / static_cast<double>(far.size()));
    fmt::print("{}: our forward model less the stored curves {:.4f} um rms over {} readings\n", name, rms_um,
               far.size());
    EXPECT_LE(rms_um, 0.004) << name;

    // The stored values are printed to 0.1 um, um/m, 0.01 ms: what is found on the curve is within half of that, where
    // the curve tells it: its own steps of 10 nm scatter it by `sigma`.
    const MatrixXd covariance = (x.transpose() * x).completeOrthogonalDecomposition().pseudoInverse();
    for (std::size_t k = 0; k < columns.names.size(); ++k) {
      const std::optional<double> stored = stored_error(*file.b5r, columns.names[k]);
      if (!stored) continue;
      const auto i = static_cast<Eigen::Index>(k);
      const double digit = columns.names[k] == "servo_mismatch" ? 0.01 : 0.1;
      const double sigma = 0.003 * std::sqrt(covariance(i, i));
      fmt::print("  {:<20} {:9.3f} ± {:.3f}, stored {:7.2f}\n", columns.names[k], found[i], sigma, *stored);
      EXPECT_NEAR(found[i], *stored, 0.5 * digit + 3.0 * sigma + 1e-6) << name << " " << columns.names[k];
    }
  }
}

struct Limit {
  const char* name;  // starts with
  double limit;
};

constexpr Limit kLimits[] = {
    {"centre", 0.1},     {"global_scale", 0.1},    {"offset", 0.1},       {"radius_change", 0.1},
    {"backlash", 0.3},   {"lateral_play", 0.3},    {"straightness", 0.3}, {"scale_mismatch", 0.3},
    {"squareness", 2.5}, {"servo_mismatch", 0.02}, {"cyclic_error", 0.3},
};

MachineErrors found_in(const RecordingFile& file) {
  MachineErrorOptions options;
  if (stores_cyclic_means(*file.b5r)) options.cyclic_of_runs = CyclicOfRuns::mean;
  return machine_errors(file.recordings, options);
}

TEST(StoredDiagnostics, ValuesAreFoundInTheReadings) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : kFiles) {
    const RecordingFile file = opened(data, name);
    const MachineErrors found = found_in(file);
    fmt::print("{}\n", name);
    int compared = 0;
    for (const MachineError& row : found.errors) {
      const std::optional<double> stored = stored_error(*file.b5r, row.name);
      if (!stored) continue;
      ASSERT_TRUE(row.as_instrument.has_value()) << name << " " << row.name;
      fmt::print("  {:<22} {:9.3f} ± {:.3f} {:<4}, as instrument {:8.3f}, stored {:7.2f}\n", row.name, row.value,
                 row.sigma, row.unit, *row.as_instrument, *stored);
      for (const Limit& limit : kLimits) {
        if (!row.name.starts_with(limit.name)) continue;
        ++compared;
        EXPECT_NEAR(*row.as_instrument, *stored, limit.limit + 1e-6) << name << " " << row.name;
      }
    }
    EXPECT_GE(compared, 19) << name;
  }
}

// The reversal spikes apart: the software draws each as a polyline of its own, by a rule that is not known, and stores
// a largest point of it; ours is the largest reading.
bool is_of_reversals(const std::string& effect) { return effect.starts_with("reversal_spike"); }

TEST(StoredDiagnostics, CircularitiesSharesAndRanksAreFoundInTheReadings) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : kFiles) {
    const RecordingFile file = opened(data, name);
    const MachineErrors found = found_in(file);
    fmt::print("{}\n", name);
    struct Place {
      const RankedError* error;
      double stored_um;
      int stored_rank;
    };
    std::vector<Place> places;
    double without_spikes = 0.0, stored_without_spikes = 0.0;  // sums of IC
    for (const RankedError& one : found.ranked) {
      const std::optional<double> stored_um = stored_individual_circularity_um(*file.b5r, one.effect->name);
      EXPECT_EQ(one.as_instrument.has_value(), stored_um.has_value()) << name << " " << one.effect->name;
      if (!stored_um || !one.as_instrument) continue;
      const InstrumentRank& ours = *one.as_instrument;
      fmt::print("  {:<16} IC {:.2f} um, stored {:.1f}, share {:.1f} %, rank {}, stored {}\n", one.effect->name,
                 ours.individual_circularity_um, *stored_um, ours.share_percent, ours.rank,
                 stored_rank(*file.b5r, one.effect->name).value_or(0));
      if (is_of_reversals(one.effect->name)) continue;
      EXPECT_NEAR(ours.individual_circularity_um, *stored_um, 0.3 + 1e-6) << name << " " << one.effect->name;
      places.push_back({&one, *stored_um, *stored_rank(*file.b5r, one.effect->name)});
      without_spikes += ours.individual_circularity_um;
      stored_without_spikes += *stored_um;
    }
    EXPECT_GE(places.size(), 8U) << name;
    for (const Place& a : places) {
      // Of the sum without spikes: 0.3 um of it.
      EXPECT_NEAR(a.error->as_instrument->individual_circularity_um / without_spikes,
                  a.stored_um / stored_without_spikes, 0.3 / stored_without_spikes)
          << name << " " << a.error->effect->name;
      for (const Place& b : places) {
        // Two that differ by more than both limits stand in the same order.
        if (a.stored_um - b.stored_um <= 0.1 || a.stored_rank > b.stored_rank) continue;
        EXPECT_LT(a.error->as_instrument->rank, b.error->as_instrument->rank)
            << name << " " << a.error->effect->name << " " << b.error->effect->name;
      }
    }
  }
}

TEST(StoredDiagnostics, CircularityIsThatOfTheFile) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : kFiles) {
    const RecordingFile file = opened(data, name);
    const std::optional<double> stored = stored_error(*file.b5r, "circularity");
    ASSERT_TRUE(stored.has_value()) << name;
    EXPECT_NEAR(found_in(file).circularity_um, *stored, 0.1) << name;
  }
}

}  // namespace
}  // namespace ballbar
