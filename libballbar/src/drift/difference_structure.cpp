#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "ballbar/drift/compare.hpp"
#include "ballbar/internal/numerics/range.hpp"
#include "ballbar/units.hpp"
#include "drift/slope_of_rows.hpp"
#include "numerics/autocorrelation.hpp"
#include "numerics/median.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kChanceOfPart = 0.01;    // of any part named where there is none
constexpr double kChanceOfRest = 0.01;    // below it the rest is too large for what is stated
constexpr std::size_t kFewestStated = 6;  // rows
constexpr std::size_t kFewestUnstated = 12;
constexpr double kShareOfMedian = 0.37;  // efficiency of the median of |x| as a sigma
constexpr double kCollinear = 1e-6;
constexpr double kMoreThanScatter = 2.0;  // a column's squares, times what scatter alone makes of them
constexpr int kMostRounds = 200;
constexpr double kLeastGain = 0.05, kLargestGain = 20.0;  // beyond them the two have no curve in common

using Free = std::array<bool, 4>;
using Parts = std::array<double, 4>;
constexpr Parts kNoDifference{0.0, 1.0, 0.0, 0.0};
constexpr std::size_t kOffset = 0, kGain = 1, kLag = 2, kDrift = 3;  // as kDifferenceKinds

// b - model linearised there: rows x 4, whitened by each row's own variance; the zero has no weight.
struct Linearised {
  Eigen::MatrixXd columns, shared;
  Eigen::VectorXd rest;
  Parts scatter{};  // squares that the errors of the curve alone make in a column
  bool has_slope = false;
};

// The curve that both show: a and what b says of it, weighted. Its errors are independent of those of b - gain a.
Linearised linearised_at(const DifferenceRows& rows, const Parts& at) {
  const auto n = static_cast<Eigen::Index>(rows.time_s.size());
  const double gain = at[kGain], lag_s = at[kLag];
  std::vector<double> curve = rows.a, variance(rows.time_s.size(), 0.0);
  std::optional<Slopes> slopes;
  const auto hours = [&](std::size_t i) { return min_from_s(rows.time_s[i] - rows.time_s[rows.zero]) / 60.0; };
  // b is a change since its own reading at the zero, which is as late.
  const auto slope_at = [&](std::size_t i) { return slopes->per_s[i] - slopes->per_s[rows.zero]; };
  std::vector<double> rest(rows.time_s.size());
  // The slope of the curve needs the curve, the curve needs the rest with the slope: once is enough for a small lag.
  for (int pass = 0; pass < 2; ++pass) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] = rows.b[i] - gain * rows.a[i];
      if (i == rows.zero) continue;
      rest[i] -= at[kOffset] + at[kDrift] * hours(i) + (slopes ? gain * lag_s * slope_at(i) : 0.0);
      const double total = rows.variance_b[i] + gain * gain * rows.variance_a[i];
      curve[i] = rows.a[i] + gain * rows.variance_a[i] / total * rest[i];
      variance[i] = rows.variance_a[i] * rows.variance_b[i] / total;
    }
    if (pass == 0) slopes = slopes_of_rows(rows.time_s, curve, variance);
    if (lag_s == 0.0 || !slopes) break;
  }
  Linearised made;
  made.has_slope = slopes.has_value();
  made.columns = Eigen::MatrixXd::Zero(n, 4);
  made.rest = Eigen::VectorXd::Zero(n);
  made.shared = Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(1 + rows.shared.size()));
  const double reference = std::sqrt(rows.reference_variance_b + gain * gain * rows.reference_variance_a);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (i == rows.zero) continue;
    const auto row = static_cast<Eigen::Index>(i);
    const double total = rows.variance_b[i] + gain * gain * rows.variance_a[i];
    const double weight = 1.0 / std::sqrt(total);
    made.rest[row] = weight * rest[i];
    made.columns.row(row) << weight, weight * curve[i], slopes ? weight * gain * slope_at(i) : 0.0, weight * hours(i);
    made.scatter[kGain] += variance[i] / total;
    if (slopes) made.scatter[kLag] += gain * gain * slopes->variance[i] / total;
    made.shared(row, 0) = weight * reference;
    for (std::size_t k = 0; k < rows.shared.size(); ++k) {
      made.shared(row, static_cast<Eigen::Index>(k + 1)) = weight * rows.shared[k][i];
    }
  }
  return made;
}

struct Solved {
  std::array<std::optional<double>, 4> step, information;  // nothing: not free, or not determined
  double chi2_before = 0.0, chi2_after = 0.0;
  std::size_t rank = 0;
  Eigen::VectorXd rest;  // whitened, n rows
};

// V = D + U U': least squares with one unknown more a column of U, each with the reading "0, sigma 1".
Solved solved(const Linearised& at, const Free& free) {
  const Eigen::Index n = at.rest.size(), shared = at.shared.cols();
  std::vector<std::size_t> kinds;
  for (std::size_t kind = 0; kind < free.size(); ++kind) {
    if (free[kind] && (kind != kLag || at.has_slope) && at.columns.col(static_cast<Eigen::Index>(kind)).norm() > 0.0)
      kinds.push_back(kind);
  }
  const auto parts = static_cast<Eigen::Index>(kinds.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n + shared, shared + parts);
  all.topLeftCorner(n, shared) = at.shared;
  all.bottomLeftCorner(shared, shared).setIdentity();
  for (Eigen::Index k = 0; k < parts; ++k) {
    const auto column = at.columns.col(static_cast<Eigen::Index>(kinds[static_cast<std::size_t>(k)]));
    all.col(shared + k).head(n) = column / column.norm();
  }
  Eigen::VectorXd reading = Eigen::VectorXd::Zero(n + shared);
  reading.head(n) = at.rest;
  Solved result;
  const auto rest_after = [&](const Eigen::MatrixXd& matrix, const Eigen::VectorXd& of) -> Eigen::VectorXd {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(kCollinear);
    qr.compute(matrix);
    return of - matrix * qr.solve(of);
  };
  result.chi2_before = rest_after(all.leftCols(shared), reading).squaredNorm();
  const Eigen::VectorXd rest = rest_after(all, reading);
  result.chi2_after = rest.squaredNorm();
  result.rest = rest.head(n);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kCollinear);
  qr.compute(all);
  result.rank = static_cast<std::size_t>(qr.rank() - shared);
  for (Eigen::Index k = 0; k < parts; ++k) {
    Eigen::MatrixXd others(all.rows(), all.cols() - 1);
    others << all.leftCols(shared + k), all.rightCols(parts - k - 1);
    const Eigen::VectorXd own = rest_after(others, all.col(shared + k));
    if (own.norm() < kCollinear) continue;
    const std::size_t kind = kinds[static_cast<std::size_t>(k)];
    const double norm = at.columns.col(static_cast<Eigen::Index>(kind)).norm();
    result.step[kind] = own.dot(reading) / own.squaredNorm() / norm;
    result.information[kind] = own.squaredNorm() * norm * norm;
  }
  return result;
}

struct Fitted {
  Parts at = kNoDifference;
  Solved last;
  Linearised linearised;
  bool settled = false;
};

// Gauss and Newton, with the curve estimated anew each time: it ends where rest' V^-1 rest is least.
Fitted fitted(const DifferenceRows& rows, const Free& free) {
  Fitted fit;
  for (int round = 0; round < kMostRounds; ++round) {
    fit.linearised = linearised_at(rows, fit.at);
    fit.last = solved(fit.linearised, free);
    double largest = 0.0;  // in sigma
    for (std::size_t kind = 0; kind < free.size(); ++kind) {
      if (!fit.last.step[kind]) continue;
      fit.at[kind] += *fit.last.step[kind];
      largest = std::max(largest, std::abs(*fit.last.step[kind]) * std::sqrt(*fit.last.information[kind]));
    }
    if (!(fit.at[kGain] > kLeastGain && fit.at[kGain] < kLargestGain)) return fit;
    if (largest < 1e-9) {
      fit.settled = true;
      return fit;
    }
  }
  return fit;
}

// A sigma above it says nothing of the part: half of the scale, a quarter of the time, the range of the drifts.
std::array<double, 4> most_sigma_of(const DifferenceRows& rows) {
  const double range = std::max(range_of(rows.a), range_of(rows.b));
  const double length_s = rows.time_s.back() - rows.time_s.front();
  return {range, 0.5, 0.25 * length_s, range / (length_s / 3600.0)};
}

// Parts as they are estimated, their chances as tested where there is no difference.
DifferenceParts parts_of(const DifferenceRows& rows, const Linearised& none, const Free& free, double widened_by,
                         double degrees) {
  const Solved tested = solved(none, free);
  const Fitted fit = fitted(rows, free);
  const std::array<double, 4> most_sigma = most_sigma_of(rows);
  const std::array<std::string, 4> units{rows.unit, "", "s", rows.unit + "_per_h"};
  DifferenceParts parts;
  for (std::size_t kind = 0; kind < free.size(); ++kind) {
    if (!tested.step[kind]) continue;
    // A curve that changes no more than its scatter determines neither scale nor clock.
    if (*tested.information[kind] < kMoreThanScatter * none.scatter[kind]) continue;
    DifferencePart part;
    part.unit = units[kind];
    const double z = *tested.step[kind] * std::sqrt(*tested.information[kind]) / widened_by;
    part.explains = z * z;
    part.chance = student_tails(z, degrees);
    const bool better = fit.settled && fit.last.information[kind];
    const double information = better ? *fit.last.information[kind] : *tested.information[kind];
    const double scatter = better ? fit.linearised.scatter[kind] : none.scatter[kind];
    part.value = better ? fit.at[kind] : kNoDifference[kind] + *tested.step[kind];
    part.sigma = widened_by * std::sqrt(information) / std::max(information - scatter, 0.5 * information);
    if (part.sigma <= most_sigma[kind] || part.chance < kChanceOfPart) parts[kind] = part;
  }
  return parts;
}

DifferenceRows rows_that_count(const DifferenceRows& rows) {
  DifferenceRows kept = rows;
  kept.time_s.clear(), kept.a.clear(), kept.b.clear(), kept.variance_a.clear(), kept.variance_b.clear();
  for (std::vector<double>& one : kept.shared) one.clear();
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
    const double variance_a = rows.stated ? rows.variance_a[i] : 0.5;
    const double variance_b = rows.stated ? rows.variance_b[i] : 0.5;
    double sum = variance_a + variance_b + rows.a[i] + rows.b[i];
    for (const std::vector<double>& one : rows.shared) sum += one[i];
    if (i != rows.zero && (!std::isfinite(sum) || !(variance_a + variance_b > 0.0))) continue;
    if (i == rows.zero) kept.zero = kept.time_s.size();
    kept.time_s.push_back(rows.time_s[i]);
    kept.a.push_back(rows.a[i]);
    kept.b.push_back(rows.b[i]);
    kept.variance_a.push_back(variance_a);
    kept.variance_b.push_back(variance_b);
    for (std::size_t k = 0; k < rows.shared.size(); ++k) kept.shared[k].push_back(rows.shared[k][i]);
  }
  if (!rows.stated) kept.reference_variance_a = kept.reference_variance_b = 0.5;
  return kept;
}

}  // namespace

std::optional<DifferenceStructure> difference_structure(const DifferenceRows& all_rows) {
  const DifferenceRows rows = rows_that_count(all_rows);
  DifferenceStructure found;
  const std::size_t count = rows.time_s.size() - 1;
  found.unit = rows.unit;
  if (count < (rows.stated ? kFewestStated : kFewestUnstated)) return std::nullopt;
  const Linearised none = linearised_at(rows, kNoDifference);
  constexpr Free kAll{true, true, true, true};
  const Solved together = solved(none, kAll);
  const double freedom = static_cast<double>(count - together.rank);
  double degrees = kInfinite;
  Eigen::ArrayXd rest(together.rest.size() - 1);
  const auto zero = static_cast<Eigen::Index>(rows.zero);
  rest << together.rest.head(zero).array(), together.rest.tail(rest.size() - zero).array();
  const least_squares::Autocorrelation rho = least_squares::autocorrelation_of(rest);
  const double wider = 1.0 + 2.0 * rho.share * rho.phi / (1.0 - std::min(rho.phi, 0.99));
  if (rows.stated) {
    const bool too_large = chi2_upper_tail(together.chi2_after, count - together.rank) < kChanceOfRest;
    if (too_large || wider > 1.0) {
      const double variance = wider * together.chi2_after / freedom;
      if (variance > 1.0) {
        found.noise = NoiseOfDifference::widened;
        found.widened_by = std::sqrt(variance);
        degrees = freedom / wider;
      }
    }
  } else {
    found.noise = NoiseOfDifference::from_rows;
    found.widened_by = median_sigma(rest) * std::sqrt(static_cast<double>(count) / freedom * wider);
    degrees = std::max(1.0, kShareOfMedian * freedom / wider);
    if (!(found.widened_by > 0.0)) return std::nullopt;
  }
  const double variance = found.widened_by * found.widened_by;
  const double explained = (together.chi2_before - together.chi2_after) / variance;
  found.whole = {rows.stated ? together.chi2_before : together.chi2_before / variance, count, {}, {}};
  found.together = {explained,
                    together.rank,
                    fisher_upper_tail(explained / static_cast<double>(together.rank), together.rank, degrees),
                    {}};
  found.parts = parts_of(rows, none, kAll, found.widened_by, degrees);
  for (std::size_t kind = 0; kind < kDifferenceKinds.size(); ++kind) {
    Free one{};
    one[kind] = true;
    found.alone[kind] = parts_of(rows, none, one, found.widened_by, degrees)[kind];
  }
  return found;
}

DifferenceStructure judged(DifferenceStructure structure, std::size_t axes) {
  const auto kinds = static_cast<double>(kDifferenceKinds.size());
  structure.limit_of_part = kChanceOfPart / (kinds * static_cast<double>(axes));
  structure.together.limit = kChanceOfPart / ((kinds + 1.0) * static_cast<double>(axes));
  structure.stands_out = structure.together.chance < structure.together.limit;
  const auto name = [&](DifferenceParts& parts, double limit) {
    for (std::optional<DifferencePart>& part : parts) {
      if (!part) continue;
      part->named = part->chance < limit;
      structure.stands_out = structure.stands_out || part->named;
    }
  };
  name(structure.parts, structure.limit_of_part);
  name(structure.alone, *structure.together.limit);
  return structure;
}

std::vector<DifferenceKind> sufficient_alone(const DifferenceStructure& structure) {
  std::vector<DifferenceKind> kinds;
  for (std::size_t kind = 0; kind < kDifferenceKinds.size(); ++kind) {
    const std::optional<DifferencePart>& part = structure.alone[kind];
    if (!part || !part->named) continue;
    const double missing = structure.together.chi2 - part->explains;
    if (structure.together.freedom > 1 && chi2_upper_tail(missing, structure.together.freedom - 1) < kChanceOfPart)
      continue;
    kinds.push_back(kDifferenceKinds[kind]);
  }
  return kinds;
}

std::vector<DifferenceKind> named_differences(const DifferenceStructure& structure) {
  const auto part_of = [&](DifferenceKind kind) { return structure.parts[static_cast<std::size_t>(kind)]; };
  std::vector<DifferenceKind> named;
  for (const DifferenceKind kind : kDifferenceKinds) {
    if (part_of(kind) && part_of(kind)->named) named.push_back(kind);
  }
  std::stable_sort(named.begin(), named.end(),
                   [&](DifferenceKind a, DifferenceKind b) { return part_of(a)->explains > part_of(b)->explains; });
  return named;
}

}  // namespace ballbar
