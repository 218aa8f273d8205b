// Effects on a recording, fitted jointly to the CCW and CW readings of measured `.b5r` files, beside what the
// instrument's software stored (RENISHAW_DIAGNOSTICS) and beside what its model leaves of the readings
// (AF_SIMULATED_READINGS).
//
// A plain least squares: Gauss-Newton on the effects' own derivatives. One circle for both directions, as a radius for
// each direction and lateral play are nearly the same. Readings within 8 deg of a reversal are left out on both sides
// of every comparison: real spikes last 2 to 5 deg, each of its own form, and the stored model follows each.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "ballbar/circle/trace.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/units.hpp"
#include "external_data.hpp"

namespace ballbar {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

struct BoundTerm {
  const Effect* effect = nullptr;
  EffectRows rows;
  std::vector<double> p;
  bool held = false;  // all of it
};

class Joint {
 public:
  // Readings nearer than that to a reversal of either axis are left out.
  Joint(const std::vector<Recording>& recordings, double left_out_deg) : trace_(trace_of(recordings)) {
    const std::vector<double>& y = find_column(trace_, "deviation_um")->values;
    y_ = measured_ = Eigen::Map<const VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
    used_ = VectorXd::Ones(y_.size());
    const std::vector<double>& angle_rad = find_column(trace_, "angle_rad")->values;
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      const double nearest_deg = std::abs(std::remainder(deg_from_rad(angle_rad[i]), 90.0));
      if (nearest_deg < left_out_deg) used_[static_cast<Eigen::Index>(i)] = 0.0;
    }
  }

  // Adds a term. A shape starts where `shape` says, at the best point of its grid otherwise.
  void add(const Effect& effect, double start_of_shape = NAN) {
    BoundTerm term{&effect, {trace_.time_s, {}}, {}};
    for (const Input& input : effect.inputs) {
      term.rows.inputs.emplace_back(find_column(trace_, trace_column(input.role))->values);
    }
    for (const Parameter& parameter : effect.parameters) term.p.push_back(parameter.start);
    terms_.push_back(std::move(term));
    for (std::size_t k = 0; k < terms_.back().p.size(); ++k) {
      const Parameter& shape = effect.parameters[k];
      if (shape.held || shape.kind == ParameterKind::gain) continue;
      if (!std::isnan(start_of_shape)) {
        terms_.back().p[k] = start_of_shape;
        continue;
      }
      double best = INFINITY, best_value = shape.start;
      for (const double value : shape.grid) {
        terms_.back().p[k] = value;
        const double left = linear_fit();
        if (left < best) best = left, best_value = value;
      }
      terms_.back().p[k] = best_value;
    }
    linear_fit();
  }

  // Gauss-Newton over gains and shapes, halving steps that make it worse.
  void solve() {
    double square = residual().squaredNorm();
    for (int iteration = 0; iteration < 100; ++iteration) {
      const MatrixXd jacobian = derivatives(true);
      const VectorXd step = least_squares(jacobian, residual());
      const std::vector<BoundTerm> before = terms_;
      double scale = 1.0, now = square;
      for (; scale > 1e-4; scale /= 2.0) {
        terms_ = before;
        move(step * scale, true);
        now = residual().squaredNorm();
        if (now < square) break;
      }
      if (!(now < square)) {
        terms_ = before;
        return;
      }
      const bool done = square - now < 1e-10 * square;
      square = now;
      if (done) return;
    }
  }

  // Holds the first parameter of an effect that has but one.
  void hold(std::string_view name, double value) {
    for (BoundTerm& term : terms_) {
      if (term.effect->name == name) term.p[0] = value, term.held = true;
    }
  }

  double value(std::string_view name, std::size_t k = 0) const {
    for (const BoundTerm& term : terms_) {
      if (term.effect->name == name) return term.p[k];
    }
    return NAN;
  }

  // White residual: widths are too narrow where the residual has a memory.
  double sigma(std::string_view name, std::size_t k = 0) const {
    const MatrixXd jacobian = derivatives(true);
    const VectorXd scale = jacobian.colwise().norm().cwiseMax(1e-12);
    const MatrixXd unit = jacobian * scale.cwiseInverse().asDiagonal();
    const MatrixXd inverse = (unit.transpose() * unit).ldlt().solve(MatrixXd::Identity(scale.size(), scale.size()));
    Eigen::Index column = 0;
    for (const BoundTerm& term : terms_) {
      for (std::size_t j = 0; j < term.p.size(); ++j) {
        if (!is_free(term, j, true)) continue;
        if (term.effect->name == name && j == k) return rms_um() * std::sqrt(inverse(column, column)) / scale[column];
        ++column;
      }
    }
    return NAN;
  }

  VectorXd residual() const {
    VectorXd left = y_;
    for (const BoundTerm& term : terms_) {
      VectorXd values(y_.size());
      term.effect->evaluate(term.rows, term.p.data(), values.data(), nullptr);
      left -= values;
    }
    return left.cwiseProduct(used_);
  }

  double rms_um() const { return rms_um(residual()); }
  double rms_um(const VectorXd& left) const { return std::sqrt(left.cwiseProduct(used_).squaredNorm() / used_.sum()); }
  const VectorXd& measured() const { return measured_; }
  void explain(const VectorXd& other) { y_ = other; }

 private:
  static bool is_free(const BoundTerm& term, std::size_t k, bool shapes) {
    const Parameter& parameter = term.effect->parameters[k];
    return !term.held && !parameter.held && (shapes || parameter.kind == ParameterKind::gain);
  }

  MatrixXd derivatives(bool shapes) const {
    std::vector<VectorXd> columns;
    for (const BoundTerm& term : terms_) {
      const auto count = static_cast<Eigen::Index>(term.p.size());
      VectorXd values(y_.size());
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> block(y_.size(), count);
      term.effect->evaluate(term.rows, term.p.data(), values.data(), block.data());
      for (std::size_t k = 0; k < term.p.size(); ++k) {
        if (is_free(term, k, shapes)) columns.emplace_back(block.col(static_cast<Eigen::Index>(k)).cwiseProduct(used_));
      }
    }
    MatrixXd jacobian(y_.size(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) jacobian.col(static_cast<Eigen::Index>(k)) = columns[k];
    return jacobian;
  }

  static VectorXd least_squares(const MatrixXd& jacobian, const VectorXd& right) {
    const VectorXd scale = jacobian.colwise().norm().cwiseMax(1e-12);
    MatrixXd unit = jacobian * scale.cwiseInverse().asDiagonal();
    MatrixXd normal = unit.transpose() * unit;
    normal.diagonal().array() += 1e-10;
    return normal.ldlt().solve(unit.transpose() * right).cwiseQuotient(scale);
  }

  void move(const VectorXd& step, bool shapes) {
    Eigen::Index column = 0;
    for (BoundTerm& term : terms_) {
      for (std::size_t k = 0; k < term.p.size(); ++k) {
        if (!is_free(term, k, shapes)) continue;
        const Parameter& parameter = term.effect->parameters[k];
        term.p[k] = std::clamp(term.p[k] + step[column++], parameter.lower, parameter.upper);
      }
    }
  }

  // The gains alone, shapes where they are; the circle is nearly linear: two steps.
  double linear_fit() {
    for (int i = 0; i < 2; ++i) move(least_squares(derivatives(false), residual()), false);
    return residual().squaredNorm();
  }

  Series trace_;
  VectorXd y_, measured_;
  VectorXd used_;  // 1 or 0
  std::vector<BoundTerm> terms_;
};

// The stored model's own readings, um: CCW then CW or as `order` says.
VectorXd simulated_um(const std::filesystem::path& path, const std::vector<Recording>& recordings) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  const std::string bytes = text.str();
  std::vector<double> all;
  for (const Recording& recording : recordings) {
    const std::string key = fmt::format("<SIMULATION NAME=\"AF_SIMULATED_READINGS_{}\">", name_of(recording.direction));
    const std::size_t start = bytes.find(key) + key.size();
    std::istringstream numbers(bytes.substr(start, bytes.find('<', start) - start));
    for (double value_mm = 0.0; numbers >> value_mm;) all.push_back(value_mm * 1e3);
  }
  return Eigen::Map<VectorXd>(all.data(), static_cast<Eigen::Index>(all.size()));
}

// A term of the stored model that the catalogue does not have: dir (u / 2) sin 4 theta. On 220 deg it shares what is
// near a reversal with backlash and servo mismatch, so values can be compared only where both models have it.
const Effect kSin4Theta{
    "sin_4_theta",
    Level::recording,
    {},
    {{"angle", {"rad"}, ""}, {"direction", {"1"}, ""}},
    {{"size_um", "um", ParameterKind::gain, 0.0, -100.0, 100.0, {}, ""}},
    [](const EffectRows& rows, const double* p, double* values, double* derivatives) {
      for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
        const double one = 0.5 * rows.inputs[1][i] * std::sin(4.0 * rows.inputs[0][i]);
        values[i] = p[0] * one;
        if (derivatives != nullptr) derivatives[i] = one;
      }
    },
};

struct Stored {
  const B5r& test;
  double operator()(const char* name, const char* unit = "UT_LENGTH_UM") const {
    for (const StoredFeature& feature : test.stored) {
      if (feature.parent.starts_with("RENISHAW_DIAGNOSTICS") && feature.name == name && feature.data_type == unit) {
        return feature.value;
      }
    }
    ADD_FAILURE() << name << " is not stored";
    return NAN;
  }
};

struct File {
  RecordingFile file;
  VectorXd simulated;
};

File opened(const std::filesystem::path& path) {
  RecordingFile file = open_recording(path);
  VectorXd simulated = simulated_um(path, file.recordings);
  return {std::move(file), std::move(simulated)};
}

constexpr double kLeftOut_deg = 8.0;

const Effect& on_recording(std::string_view name) { return *find_effect(name, Level::recording); }

// Without scale mismatch where the software could not find it either (half a circle).
Joint joint_of(const File& file, bool scale) {
  Joint joint(file.file.recordings, kLeftOut_deg);
  joint.add(on_recording("circle"));
  for (const char* name : {"squareness", "servo_mismatch", "backlash_a", "backlash_b", "lateral_play_a",
                           "lateral_play_b", "straightness_a", "straightness_b"}) {
    joint.add(on_recording(name));
  }
  if (scale) joint.add(on_recording("scale_mismatch"));
  joint.add(kSin4Theta);
  const Stored stored{*file.file.b5r};
  // the stored pitches are where the pitches start
  joint.add(on_recording("cyclic_error_a"), stored("AF_CYCLIC_PITCH_A", "UT_LENGTH_MM"));
  joint.add(on_recording("cyclic_error_b"), stored("AF_CYCLIC_PITCH_B", "UT_LENGTH_MM"));
  return joint;
}

struct Compared {
  std::string what;
  double ours = 0.0;
  double sigma = 0.0;
  double stored = 0.0;
  double um_per_unit = 1.0;  // largest change of the length, peak to valley, for one unit

  double apart_um() const { return (ours - stored) * um_per_unit; }
  bool agrees() const { return std::abs(apart_um()) <= std::max(0.15 * std::abs(stored * um_per_unit), 0.3); }
};

std::vector<Compared> compared(const File& file, const Joint& joint) {
  const double radius_mm = file.file.recordings[0].nominal_length_mm;
  const double feed_um_per_ms = *file.file.recordings[0].feed_mm_per_min / 60.0;
  const Stored stored{*file.file.b5r};
  std::vector<Compared> table;
  const auto add = [&](const char* effect, double stored_value, double um_per_unit) {
    if (std::isnan(joint.value(effect))) return;
    table.push_back({effect, joint.value(effect), joint.sigma(effect, 0), stored_value, um_per_unit});
  };
  add("squareness", stored("AF_SQUARENESS", "UT_SQUARENESS"), radius_mm / 1e3);
  add("scale_mismatch", stored("AF_SCALE_MISMATCH") * 1e3 / (2.0 * radius_mm), radius_mm / 1e3);
  add("servo_mismatch", stored("AF_SERVO_MISMATCH", "UT_SERVO_MISMATCH"), feed_um_per_ms);
  add("backlash_a", stored("AF_BACKLASH_A_GLOBAL"), 1.0);
  add("backlash_b", stored("AF_BACKLASH_B_GLOBAL"), 1.0);
  add("lateral_play_a", stored("AF_LATERAL_PLAY_A_GLOBAL"), 1.0);
  add("lateral_play_b", stored("AF_LATERAL_PLAY_B_GLOBAL"), 1.0);
  add("straightness_a", stored("AF_STRAIGHTNESS_A"), 1.0);
  add("straightness_b", stored("AF_STRAIGHTNESS_B"), 1.0);
  add("sin_4_theta", stored("AF_SIN_4_THETA"), 1.0);
  return table;
}

void print(const File& file, const Joint& joint, const std::vector<Compared>& table) {
  const Stored stored{*file.file.b5r};
  for (const Compared& row : table) {
    fmt::print("  {:<16} ours {:8.3f} +- {:5.3f}   stored {:8.3f}   apart by {:5.2f} um {}\n", row.what, row.ours,
               row.sigma, row.stored, row.apart_um(), row.agrees() ? "" : "DIFFERS");
  }
  for (const auto& [effect, pitch, forward, reverse] :
       {std::array{"cyclic_error_a", "AF_CYCLIC_PITCH_A", "AF_CYCLIC_ERROR_A_FWD", "AF_CYCLIC_ERROR_A_REV"},
        std::array{"cyclic_error_b", "AF_CYCLIC_PITCH_B", "AF_CYCLIC_ERROR_B_FWD", "AF_CYCLIC_ERROR_B_REV"}}) {
    fmt::print("  {}: pitch ours {:.2f} mm, stored {:.2f}; peak to valley ours {:.2f} um, stored {:.1f} and {:.1f}\n",
               effect, joint.value(effect, 2), stored(pitch, "UT_LENGTH_MM"),
               2.0 * std::hypot(joint.value(effect, 0), joint.value(effect, 1)), stored(forward), stored(reverse));
  }
  fmt::print("  centre ours ({:.2f}, {:.2f}), stored ({:.1f}, {:.1f}); radius ours {:.2f} um, stored {:.1f}\n",
             joint.value("circle", 0), joint.value("circle", 1), stored("AF_CENTRE_OFFSET_A"),
             stored("AF_CENTRE_OFFSET_B"), joint.value("circle", 2), stored("AF_GLOBAL_SCALE"));
}

// The readings of the stored model itself, fitted with our effects, give back what is stored: signs and sizes are the
// same, on a full circle and on an arc.
TEST(StoredDiagnostics, AreGivenBackFromTheStoredModelsOwnReadings) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : {"xy-360-50mm.b5r", "zx-220-100mm.b5r"}) {
    const File file = opened(data / "ballbar-b5r" / name);
    Joint joint = joint_of(file, name[0] == 'x');
    joint.explain(file.simulated);
    joint.solve();
    const std::vector<Compared> table = compared(file, joint);
    fmt::print("{}, the stored model's readings\n", name);
    print(file, joint, table);
    fmt::print("  RMS of what is left {:.4f} um\n", joint.rms_um());
    for (const Compared& row : table) EXPECT_TRUE(row.agrees()) << name << " " << row.what << " " << row.apart_um();
    EXPECT_LT(joint.rms_um(), 0.16) << name;
  }
}

// On the readings themselves. On 220 deg backlash of A, servo mismatch and sin 4 theta share what is near the one
// reversal of A: with the stored values of the first two held, what is left hardly grows, so that the readings do not
// tell.
TEST(StoredDiagnostics, AreFoundInTheReadings) {
  REQUIRE_EXTERNAL_DATA(data);
  for (const char* name : {"xy-360-50mm.b5r", "zx-220-100mm.b5r"}) {
    const bool full_circle = name[0] == 'x';
    const File file = opened(data / "ballbar-b5r" / name);
    Joint joint = joint_of(file, full_circle);
    joint.solve();
    const std::vector<Compared> table = compared(file, joint);
    fmt::print("{}, the readings\n", name);
    print(file, joint, table);
    const double theirs_um = joint.rms_um(joint.measured() - file.simulated);
    const double first_um = joint.rms_um();
    fmt::print("  RMS of what is left: ours {:.4f} um, the stored model's {:.4f} um\n", first_um, theirs_um);
    for (const Compared& row : table) {
      const bool shared = !full_circle && (row.what == "backlash_a" || row.what == "servo_mismatch");
      EXPECT_EQ(row.agrees(), !shared) << name << " " << row.what << " " << row.apart_um();
    }
    if (!full_circle) {
      Joint held = joint;
      held.hold("backlash_a", Stored{*file.file.b5r}("AF_BACKLASH_A_GLOBAL"));
      held.hold("servo_mismatch", Stored{*file.file.b5r}("AF_SERVO_MISMATCH", "UT_SERVO_MISMATCH"));
      held.solve();
      fmt::print("  with the stored backlash_a and servo_mismatch held {:.4f} um\n", held.rms_um());
      EXPECT_LT(held.rms_um(), 1.01 * first_um);
    }
    // What the stored model does not have; five lobes are the best for the full circle of 3 to 15.
    Effect five_lobes = on_recording("lobing");
    five_lobes.parameters[2].start = 5.0;
    joint.add(on_recording("sweep_drift"));
    joint.solve();
    fmt::print("  and sweep_drift {:.2f} um/min: {:.4f} um\n", joint.value("sweep_drift"), joint.rms_um());
    joint.add(on_recording("vibration"));
    joint.solve();
    fmt::print("  and vibration {:.2f} Hz, {:.2f} um CCW, {:.2f} um CW: {:.4f} um\n", joint.value("vibration", 4),
               std::hypot(joint.value("vibration", 0), joint.value("vibration", 1)),
               std::hypot(joint.value("vibration", 2), joint.value("vibration", 3)), joint.rms_um());
    joint.add(five_lobes);
    joint.solve();
    fmt::print("  and lobing, 5 lobes, {:.2f} um: {:.4f} um\n",
               std::hypot(joint.value("lobing"), joint.value("lobing", 1)), joint.rms_um());
    EXPECT_LE(joint.rms_um(), theirs_um) << name;
  }
}

}  // namespace
}  // namespace ballbar
