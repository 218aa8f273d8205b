#include "machine_errors/error_ranks.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kTwoSided = 1.96;  // sigma of a 95 % interval

// Columns of one row: one, or a sine and a cosine for each recording or for all.
struct RowColumns {
  std::string name;
  Indices columns;
};

std::vector<RowColumns> rows_of(const JointErrorFit& fitted) {
  std::vector<RowColumns> rows;
  for (std::size_t k = 0; k < fitted.columns().size(); ++k) {
    const ErrorColumn& column = fitted.columns()[k];
    if (column.effect == nullptr && column.recording) continue;  // the circle of a further recording
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const RowColumns& row) { return row.name == column.name; });
    RowColumns& row = same == rows.end() ? rows.emplace_back(RowColumns{column.name, {}}) : *same;
    row.columns.push_back(static_cast<Eigen::Index>(k));
  }
  return rows;
}

// The amplitude of sines and cosines, the larger of the recordings or their mean, and its slope with each gain.
struct Amplitude {
  double value = 0.0;
  Eigen::RowVectorXd slope;
  double recordings = 0.0;
};

Amplitude amplitude_of(const JointErrorFit& fitted, const Eigen::VectorXd& gains, const Indices& columns,
                       CyclicOfRuns of_runs) {
  std::map<std::size_t, Indices> pairs;  // each recording's, or that of all
  for (const Eigen::Index k : columns)
    pairs[fitted.columns()[static_cast<std::size_t>(k)].recording.value_or(0)].push_back(k);
  Amplitude all{0.0, Eigen::RowVectorXd::Zero(gains.size()), static_cast<double>(pairs.size())};
  for (const auto& [recording, pair] : pairs) {
    const double value = gains(pair).norm();
    Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(gains.size());
    for (const Eigen::Index k : pair) slope[k] = value > 0.0 ? gains[k] / value : 1.0;
    if (of_runs == CyclicOfRuns::mean) {
      all.value += value / all.recordings;
      all.slope += slope / all.recordings;
    } else if (!(value < all.value)) {
      all.value = value;
      all.slope = slope;
    }
  }
  return all;
}

// Sigma of an amplitude of this sigma by its slope. `of` amplitudes of noise reach this square over it in 5 % of cases.
double widened(const Amplitude& amplitude, double sigma, double of) {
  const double of_noise = -2.0 * std::log(1.0 - std::pow(0.95, 1.0 / of));
  const bool is_clear = amplitude.value * amplitude.value >= of_noise * sigma * sigma;
  return is_clear ? sigma : std::max(sigma, 1.0001 * amplitude.value / kTwoSided);
}

// Gains of the effect that all recordings share, as sums of gains: means over those that have their own.
Eigen::MatrixXd shared_gains(const JointErrorFit& fitted, const FittedEffect& effect) {
  std::map<std::size_t, Indices> by_gain;
  for (const Eigen::Index k : effect.columns) by_gain[fitted.columns()[static_cast<std::size_t>(k)].gain].push_back(k);
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(by_gain.size()), fitted.gains.size());
  Eigen::Index row = 0;
  for (const auto& [gain, columns] : by_gain) {
    for (const Eigen::Index k : columns) means(row, k) = 1.0 / static_cast<double>(columns.size());
    ++row;
  }
  return means;
}

// What some effects add to the rows as fitted; 0 of one that is not in the fit.
Eigen::VectorXd fitted_curve(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(fitted.rows.size());
  for (const FittedEffect& effect : fitted.design.effects) {
    if (!effect.in_the_fit || !effects.contains(effect.effect)) continue;
    const Eigen::MatrixXd columns = fitted.design.x.values(Eigen::all, effect.columns);
    const Eigen::VectorXd gains = fitted.curve_gains(effect.columns);
    curve += columns * gains;
  }
  return curve;
}

// Columns of some effects; those that recordings have of their own are put together.
Eigen::MatrixXd shared_columns(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  std::map<std::pair<const Effect*, std::size_t>, Eigen::VectorXd> by_gain;
  for (std::size_t k = 0; k < fitted.columns().size(); ++k) {
    const auto& [name, unit, effect, gain, recording] = fitted.columns()[k];
    if (!effects.contains(effect)) continue;
    Eigen::VectorXd& sum = by_gain[{effect, gain}];
    if (sum.size() == 0) sum.setZero(fitted.rows.size());
    sum += fitted.design.x.values.col(static_cast<Eigen::Index>(k));
  }
  Eigen::MatrixXd shared(fitted.rows.size(), static_cast<Eigen::Index>(by_gain.size()));
  Eigen::Index at = 0;
  for (const auto& [gain, sum] : by_gain) shared.col(at++) = sum;
  return shared;
}

// Gains of columns by least squares over rows of these weights.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight,
                              const Eigen::VectorXd& data) {
  if (columns.cols() == 0) return Eigen::VectorXd();
  const Eigen::MatrixXd weighted = weight.asDiagonal() * columns;
  return inverse_of(columns.transpose() * weighted) * (weighted.transpose() * data);
}

struct Directions {
  Eigen::VectorXd ccw, cw;  // weights of the rows

  explicit Directions(const ErrorRows& rows)
      : ccw((rows.direction.array() > 0.0).cast<double>() * rows.count.array()), cw(rows.count - ccw) {}
  bool both() const { return ccw.sum() > 0.0 && cw.sum() > 0.0; }
};

// Squares that are left in each direction, the gains of these columns from the other.
double squares_left(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data, const Directions& directions,
                    const Eigen::VectorXd& others) {
  const auto left = [&](const Eigen::VectorXd& from, const Eigen::VectorXd& to) {
    Eigen::VectorXd rest = data + others;  // of the others as measured, but for the gains
    if (columns.cols() > 0) rest -= columns * least_squares(columns, from, data);
    return to.dot(rest.cwiseAbs2());
  };
  return left(directions.ccw, directions.cw) + left(directions.cw, directions.ccw);
}

}  // namespace

ErrorTable error_table(const JointErrorFit& fitted, CyclicOfRuns cyclic_of_runs) {
  const std::vector<RowColumns> rows = rows_of(fitted);
  ErrorTable table;
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), fitted.gains.size());
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const Indices& columns = rows[r].columns;
    const ErrorColumn& first = fitted.columns()[static_cast<std::size_t>(columns.front())];
    MachineError row{rows[r].name, first.unit, 0.0, 0.0, first.effect};
    auto slope = slopes.row(static_cast<Eigen::Index>(r));
    table.extent_um.push_back(0.0);
    const bool has_instrument = !fitted.as_instrument(columns).hasNaN();
    if (columns.size() == 1) {
      slope[columns.front()] = 1.0;
      row.value = fitted.gains[columns.front()];
      row.sigma = std::sqrt(std::max(0.0, fitted.covariance(columns.front(), columns.front())));
      if (has_instrument) row.as_instrument = fitted.as_instrument[columns.front()];
      const auto unit = fitted.design.x.fine.col(columns.front());
      table.extent_um.back() = row.sigma * (unit.maxCoeff() - unit.minCoeff());
    } else {
      const Amplitude amplitude = amplitude_of(fitted, fitted.gains, columns, cyclic_of_runs);
      slope = amplitude.slope;
      double searched = 1.0;
      for (const FittedEffect& effect : fitted.design.effects) {
        if (effect.effect == first.effect) searched = effect.searched;
      }
      row.value = amplitude.value;
      row.sigma = std::sqrt(std::max(0.0, (slope * fitted.covariance * slope.transpose()).value()));
      row.sigma = widened(amplitude, row.sigma, amplitude.recordings * searched);
      if (has_instrument) row.as_instrument = amplitude_of(fitted, fitted.as_instrument, columns, cyclic_of_runs).value;
    }
    table.rows.push_back(std::move(row));
  }
  table.covariance = slopes * fitted.covariance * slopes.transpose();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    double& variance = table.covariance(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(r));
    variance = std::max(variance, table.rows[r].sigma * table.rows[r].sigma);
  }
  return table;
}

std::vector<ErrorGroup> error_groups(const JointErrorFit& fitted) {
  std::vector<ErrorGroup> groups;
  const Eigen::MatrixXd& fine = fitted.design.x.fine;
  for (const FittedGroup& one : fitted.groups) {
    ErrorGroup group;
    group.p_value = one.p;
    Eigen::VectorXd curve = Eigen::VectorXd::Zero(fine.rows());
    Indices columns;
    for (std::size_t m = 0; m < one.effects.size(); ++m) {
      const FittedEffect& effect = fitted.design.effects[one.effects[m]];
      group.effects.push_back(effect.effect);
      for (std::size_t k = 0; k < effect.columns.size(); ++k) {
        const ErrorColumn& column = fitted.columns()[static_cast<std::size_t>(effect.columns[k])];
        const auto gain = static_cast<Eigen::Index>(k);
        group.alone.push_back({column.name, column.unit, one.alone[m][gain],
                               std::sqrt(std::max(0.0, one.covariance[m](gain, gain))), effect.effect});
      }
      if (!effect.in_the_fit) continue;
      columns.insert(columns.end(), effect.columns.begin(), effect.columns.end());
      curve += fitted.fine_curve(effect.effect);
    }
    Eigen::Index highest = 0, lowest = 0;
    group.individual_circularity_um = curve.maxCoeff(&highest) - curve.minCoeff(&lowest);
    const Eigen::RowVectorXd slope = (fine.row(highest) - fine.row(lowest))(columns);
    const double variance = (slope * fitted.covariance(columns, columns) * slope.transpose()).value();
    group.sigma_um = std::sqrt(std::max(0.0, variance));
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<RankedError> ranked_errors(const JointErrorFit& fitted, const ErrorTable& table) {
  const Eigen::VectorXd residual = fitted.residual();
  const Directions directions(fitted.rows);
  std::vector<RankedError> ranked;
  double sum_um = 0.0;
  for (std::size_t place = 0; place < fitted.design.effects.size(); ++place) {
    const FittedEffect& effect = fitted.design.effects[place];
    RankedError one;
    one.effect = effect.effect;
    one.shape = effect.shape;
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      if (table.rows[r].effect == effect.effect) one.rows.push_back(r);
    }
    const Eigen::VectorXd curve = fitted.fine_curve(effect.effect);
    one.individual_circularity_um = curve.maxCoeff() - curve.minCoeff();
    sum_um += one.individual_circularity_um;
    const Eigen::MatrixXd shared = shared_gains(fitted, effect);
    const Eigen::VectorXd values = shared * fitted.gains;
    const Eigen::MatrixXd covariance = shared * fitted.covariance * shared.transpose();
    one.chi2 = values.dot(covariance.ldlt().solve(values));
    one.chi2_needed =
        chi2_exceeded(kFalseErrors / (effect.looked_at * effect.searched), static_cast<std::size_t>(values.size()));
    one.p_value = std::min(1.0, effect.searched * std::max(effect.p_with_prior, p_of(values, covariance)));
    if (directions.both()) {
      // Its gains from one direction alone, all else as fitted: do they lower the residual of the other?
      const Eigen::VectorXd data = residual + fitted_curve(fitted, {effect.effect});
      const double left =
          squares_left(shared_columns(fitted, {effect.effect}), data, directions, Eigen::VectorXd::Zero(data.size()));
      one.predicts_other_run = left < fitted.rows.count.dot(data.cwiseAbs2());
    }
    const ErrorFit kind = effect.effect->rules.error_fit;
    const bool needs_other_run = kind == ErrorFit::along_the_travel || kind == ErrorFit::at_reversals;
    one.significant = effect.is_needed && one.p_value * effect.looked_at < kFalseErrors &&
                      !(needs_other_run && one.predicts_other_run == false);
    for (std::size_t g = 0; g < fitted.groups.size(); ++g) {
      const std::vector<std::size_t>& members = fitted.groups[g].effects;
      if (std::find(members.begin(), members.end(), place) == members.end()) continue;
      one.group = g;
      one.significant = false;
    }
    ranked.push_back(std::move(one));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedError& a, const RankedError& b) {
    return a.individual_circularity_um > b.individual_circularity_um;
  });
  for (RankedError& one : ranked)
    one.share_percent = sum_um > 0.0 ? 100.0 * one.individual_circularity_um / sum_um : 0.0;
  return ranked;
}

double held_out_rms_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  const Directions directions(fitted.rows);
  if (!directions.both()) return kUnknown;
  std::set<const Effect*> all;
  for (const FittedEffect& effect : fitted.design.effects) all.insert(effect.effect);
  const Eigen::VectorXd own = fitted_curve(fitted, effects);
  const double squares = squares_left(shared_columns(fitted, effects), fitted.residual() + own, directions,
                                      fitted_curve(fitted, all) - own);
  return std::sqrt(fitted.within_um2 + squares / fitted.rows.count.sum());
}

double rms_with_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  Eigen::VectorXd left = fitted.rows.deviation_um - fitted_curve(fitted, effects);
  const auto circles = std::count_if(fitted.columns().begin(), fitted.columns().end(),
                                     [](const ErrorColumn& column) { return column.effect == nullptr; });
  const Eigen::MatrixXd columns = fitted.design.x.values.leftCols(circles);
  left -= columns * least_squares(columns, fitted.rows.count, left);
  return fitted.rms_um(left);
}

}  // namespace ballbar
