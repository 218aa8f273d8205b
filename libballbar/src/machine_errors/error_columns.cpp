#include "machine_errors/error_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/circle/recording.hpp"
#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr double kShiftReadings = 80.0;  // of what CCW and CW differ by, on an arc
constexpr double kRadiusReadings =
    20.0;  // of how their radii differ, on a full turn: nearly that of both lateral plays
constexpr double kUsualReadings = 1550.0;  // of a recording, by which these are meant
constexpr double kOpenSideReadings = 2.0;  // of the centre, along the middle of the arc
constexpr double kLeftOfNormal = 0.01;     // share of a combination's square that readings must see
constexpr double kLoading = 0.3;           // of a name in a combination

struct CirclePart {
  const char* mean;
  const char* shift;  // CCW less CW
};
constexpr CirclePart kCircleParts[] = {
    {"global_scale", "radius_change"}, {"centre_a", "offset_a_shift"}, {"centre_b", "offset_b_shift"}};

double circle_part(std::size_t part, double angle_rad) {
  return part == 0 ? 1.0 : part == 1 ? std::cos(angle_rad) : std::sin(angle_rad);
}

double share_of(Damping::Where where, double arc_rad, double middle_rad) {
  const bool full = arc_rad >= kFullTurn_rad;
  if (full) return 0.0;
  const double cos = std::cos(middle_rad), cos_2 = std::cos(2.0 * middle_rad);
  switch (where) {
    case Damping::Where::arcs_on_a:
      return cos * cos;
    case Damping::Where::arcs_on_b:
      return 1.0 - cos * cos;
    case Damping::Where::arcs_on_axes:
      return cos_2 * cos_2;
    case Damping::Where::arcs_on_diagonals:
      return 1.0 - cos_2 * cos_2;
    default:
      return 1.0;
  }
}

// The name that a combination of an effect's gains goes by: its rows' where it is one gain, else the effect's.
std::string statement_name(const ErrorColumns& columns, std::size_t first, const Damping& damping) {
  if (damping.gains.size() == 1) return columns.columns[first].name;
  std::vector<std::string> parts;
  for (std::size_t k = 0; k < damping.gains.size(); ++k) {
    if (damping.gains[k] == 0.0) continue;
    parts.push_back(fmt::format("{}{}",
                                damping.gains[k] < 0.0 ? "-"
                                : parts.empty()        ? ""
                                                       : "+",
                                columns.columns[first + k].name));
  }
  return parts.size() == 1 ? parts.front() : fmt::format("({})/2", fmt::join(parts, ""));
}

void add(std::vector<PriorStatement>& prior, const ErrorColumns& columns, std::string name, std::string unit,
         Eigen::VectorXd coefficients, double readings) {
  // A statement on the sum s = k' b: as so many readings at the largest of its curve for s = 1.
  const Eigen::VectorXd unit_gains = coefficients / coefficients.squaredNorm();
  const double largest = (columns.values * unit_gains).cwiseAbs().maxCoeff();
  const double precision = readings * largest * largest;
  if (readings > 0.01) prior.push_back({std::move(name), std::move(unit), std::move(coefficients), precision});
}

}  // namespace

ErrorColumns circle_columns(const ErrorRows& rows) {
  ErrorColumns circle;
  const std::vector<double>& angle_rad = find_column(rows.fine, trace_column("angle"))->values;
  const std::vector<double>& direction = find_column(rows.fine, trace_column("direction"))->values;
  const std::size_t n = angle_rad.size();
  std::vector<double> recording_of(n);
  for (std::size_t i = 0; i < n; ++i) recording_of[i] = static_cast<double>(rows.recording[rows.row_of[i]]);
  // The first of each direction differ by a shift; every further one has a circle of its own beside them.
  std::vector<std::size_t> further;
  bool has_ccw = false, has_cw = false;
  for (std::size_t k = 0, i = 0; k < rows.recordings; ++k) {
    while (i < n && static_cast<std::size_t>(recording_of[i]) < k) ++i;
    bool& has_one = direction[i] > 0.0 ? has_ccw : has_cw;
    if (has_one) further.push_back(k);
    has_one = true;
  }
  const bool both = has_ccw && has_cw;
  const std::size_t parts = 3 * ((both ? 2 : 1) + further.size());
  circle.fine.setZero(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(parts));
  Eigen::Index column = 0;
  for (std::size_t part = 0; part < 3; ++part, ++column) {
    circle.columns.push_back({kCircleParts[part].mean, "um"});
    for (std::size_t i = 0; i < n; ++i) {
      circle.fine(static_cast<Eigen::Index>(i), column) = circle_part(part, angle_rad[i]);
    }
  }
  for (std::size_t part = 0; both && part < 3; ++part, ++column) {
    circle.columns.push_back({kCircleParts[part].shift, "um"});
    circle.fine.col(column) = circle.fine.col(static_cast<Eigen::Index>(part));
    for (std::size_t i = 0; i < n; ++i) circle.fine(static_cast<Eigen::Index>(i), column) *= 0.5 * direction[i];
  }
  for (const std::size_t recording : further) {
    for (std::size_t part = 0; part < 3; ++part, ++column) {
      circle.columns.push_back(
          {fmt::format("{}_of_recording_{}", kCircleParts[part].mean, recording + 1), "um", nullptr, 0, recording});
      for (std::size_t i = 0; i < n; ++i) {
        if (static_cast<std::size_t>(recording_of[i]) != recording) continue;
        circle.fine(static_cast<Eigen::Index>(i), column) = circle_part(part, angle_rad[i]);
      }
    }
  }
  circle.values = rows.means(circle.fine);
  return circle;
}

ErrorColumns effect_columns(const Effect& effect, double shape, const ErrorRows& rows, bool of_each_recording) {
  ErrorColumns columns;
  Eigen::MatrixXd curves = unit_curves(effect, rows.fine, shape);
  const std::vector<std::size_t> gains = gains_of(effect);
  const std::size_t copies = of_each_recording ? rows.recordings : 1;
  if (of_each_recording) columns.fine.setZero(curves.rows(), curves.cols() * static_cast<Eigen::Index>(copies));
  for (std::size_t copy = 0; copy < copies; ++copy) {
    for (std::size_t k = 0; k < gains.size(); ++k) {
      const Parameter& gain = effect.parameters[gains[k]];
      const Eigen::Index column = static_cast<Eigen::Index>(copy * gains.size() + k);
      columns.columns.push_back(
          {gain.row.empty() ? effect.name : fmt::format("{}_{}", effect.name, gain.row), gain.unit, &effect, k});
      if (!of_each_recording) continue;
      columns.columns.back().recording = copy;
      for (Eigen::Index i = 0; i < curves.rows(); ++i) {
        if (rows.recording[rows.row_of[static_cast<std::size_t>(i)]] != copy) continue;
        columns.fine(i, column) = curves(i, static_cast<Eigen::Index>(k));
      }
    }
  }
  if (!of_each_recording) columns.fine = std::move(curves);
  columns.values = rows.means(columns.fine);
  return columns;
}

std::vector<PriorStatement> prior_of(const ErrorColumns& columns, double readings_of_one, double arc_rad,
                                     double middle_rad) {
  std::vector<PriorStatement> prior;
  const auto unit_vector = [&](std::size_t column) {
    return Eigen::VectorXd(Eigen::VectorXd::Unit(columns.size(), static_cast<Eigen::Index>(column)));
  };
  const bool full = arc_rad >= kFullTurn_rad;
  const double share = readings_of_one / kUsualReadings;
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    const ErrorColumn& column = columns.columns[k];
    if (column.effect == nullptr) {
      if (column.recording) continue;
      for (std::size_t part = 0; part < 3; ++part) {
        const double shift = !full ? kShiftReadings : part == 0 ? kRadiusReadings : 0.0;
        if (column.name == kCircleParts[part].shift)
          add(prior, columns, column.name, "um", unit_vector(k), share * shift);
        if (full || part == 0 || column.name != kCircleParts[part].mean) continue;
        const double along = circle_part(part, middle_rad);
        add(prior, columns, column.name, "um", unit_vector(k), share * kOpenSideReadings * along * along);
      }
      continue;
    }
    if (column.gain != 0 || column.recording) continue;
    for (const Damping& damping : column.effect->rules.damping) {
      Eigen::VectorXd coefficients = Eigen::VectorXd::Zero(columns.size());
      for (std::size_t gain = 0; gain < damping.gains.size(); ++gain) {
        coefficients[static_cast<Eigen::Index>(k + gain)] = damping.gains[gain];
      }
      add(prior, columns, statement_name(columns, k, damping), column.unit, coefficients,
          share * damping.readings * share_of(damping.where, arc_rad, middle_rad));
    }
  }
  return prior;
}

Eigen::MatrixXd precision_of(const std::vector<PriorStatement>& prior, Eigen::Index columns) {
  Eigen::MatrixXd precision = Eigen::MatrixXd::Zero(columns, columns);
  for (const PriorStatement& statement : prior) {
    precision += statement.precision * statement.coefficients * statement.coefficients.transpose();
  }
  return precision;
}

std::string undetermined_names(const Eigen::VectorXd& direction, const std::vector<ErrorColumn>& columns) {
  std::vector<std::size_t> order(columns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto loading = [&](std::size_t i) { return std::abs(direction[static_cast<Eigen::Index>(i)]); };
  // What is alike but for rounding stays in the order of the columns, whatever computer rounds.
  const auto place = [&](std::size_t i) { return std::llround(1e6 * loading(i)); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) > place(b); });
  std::vector<std::string> names;
  for (const std::size_t i : order) {
    if (loading(i) < kLoading * loading(order.front())) break;
    const ErrorColumn& column = columns[i];
    const std::string& name = column.effect == nullptr ? column.name : column.effect->name;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} with {}", names.front(),
                     fmt::join(std::vector<std::string>(names.begin() + 1, names.end()), ", "));
}

std::vector<std::string> undetermined(const Eigen::MatrixXd& normal, const std::vector<ErrorColumn>& columns) {
  const Eigen::VectorXd size = normal.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::MatrixXd scaled = size.cwiseInverse().asDiagonal() * normal * size.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(scaled);
  std::vector<std::string> phrases;
  for (Eigen::Index k = 0; k < scaled.cols() && solved.eigenvalues()[k] < kLeftOfNormal; ++k) {
    const std::string phrase = undetermined_names(solved.eigenvectors().col(k), columns);
    if (phrase.empty()) continue;
    if (std::find(phrases.begin(), phrases.end(), phrase) == phrases.end()) phrases.push_back(phrase);
  }
  return phrases;
}

}  // namespace ballbar
