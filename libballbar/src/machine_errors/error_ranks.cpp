#include "machine_errors/error_ranks.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kTwoSided = 1.96;  // sigma of a 95 % interval

// Columns of one row: one, or a sine and a cosine for each recording or for all.
struct RowColumns {
  std::string name;
  std::vector<std::size_t> columns;
};

std::vector<RowColumns> rows_of(const ErrorColumns& columns) {
  std::vector<RowColumns> rows;
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    const ErrorColumn& column = columns.columns[k];
    if (column.effect == nullptr && column.recording) continue;  // the circle of a further recording
    const auto same =
        std::find_if(rows.begin(), rows.end(), [&](const RowColumns& row) { return row.name == column.name; });
    if (same == rows.end()) {
      rows.push_back({column.name, {k}});
    } else {
      same->columns.push_back(k);
    }
  }
  return rows;
}

// Largest square of an amplitude over its sigma that noise reaches in 5 % of cases: of `of` amplitudes of two parts.
double noise_square(double of) { return -2.0 * std::log(1.0 - std::pow(0.95, 1.0 / of)); }

struct Amplitude {
  double value = 0.0;
  double sigma = 0.0;
  Eigen::RowVectorXd slope;  // of the value with each gain
};

// The same of the instrument's gains; nothing where it has none.
std::optional<double> amplitude_as_instrument(const JointErrorFit& fitted, const std::vector<std::size_t>& columns,
                                              CyclicOfRuns of_runs) {
  std::map<std::size_t, double> squares;
  for (const std::size_t k : columns) {
    const double gain = fitted.as_instrument[static_cast<Eigen::Index>(k)];
    if (std::isnan(gain)) return std::nullopt;
    squares[fitted.columns.columns[k].recording.value_or(0)] += gain * gain;
  }
  double largest = 0.0, sum = 0.0;
  for (const auto& [recording, square] : squares) {
    largest = std::max(largest, std::sqrt(square));
    sum += std::sqrt(square);
  }
  return of_runs == CyclicOfRuns::mean ? sum / static_cast<double>(squares.size()) : largest;
}

Amplitude amplitude_of(const JointErrorFit& fitted, const std::vector<std::size_t>& columns, CyclicOfRuns of_runs,
                       double searched) {
  // Each recording's, or that of all.
  std::map<std::size_t, std::vector<Eigen::Index>> pairs;
  for (const std::size_t k : columns) {
    pairs[fitted.columns.columns[k].recording.value_or(0)].push_back(static_cast<Eigen::Index>(k));
  }
  Amplitude all{0.0, 0.0, Eigen::RowVectorXd::Zero(fitted.gains.size())};
  for (const auto& [recording, pair] : pairs) {
    Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(fitted.gains.size());
    double square = 0.0;
    for (const Eigen::Index k : pair) square += fitted.gains[k] * fitted.gains[k];
    const double value = std::sqrt(square);
    for (const Eigen::Index k : pair) slope[k] = value > 0.0 ? fitted.gains[k] / value : 1.0;
    if (of_runs == CyclicOfRuns::mean) {
      all.value += value / static_cast<double>(pairs.size());
      all.slope += slope / static_cast<double>(pairs.size());
    } else if (value >= all.value) {
      all.value = value;
      all.slope = slope;
    }
  }
  all.sigma = std::sqrt(std::max(0.0, (all.slope * fitted.covariance * all.slope.transpose()).value()));
  if (all.value * all.value < noise_square(static_cast<double>(pairs.size()) * searched) * all.sigma * all.sigma) {
    all.sigma = std::max(all.sigma, 1.0001 * all.value / kTwoSided);
  }
  return all;
}

// Gains of the effect that all recordings share: means over those that have their own.
Eigen::MatrixXd shared_gains(const JointErrorFit& fitted, const FittedEffect& effect) {
  std::map<std::size_t, std::vector<std::size_t>> by_gain;
  for (const std::size_t k : effect.columns) by_gain[fitted.columns.columns[k].gain].push_back(k);
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(by_gain.size()), fitted.gains.size());
  Eigen::Index row = 0;
  for (const auto& [gain, columns] : by_gain) {
    for (const std::size_t k : columns) {
      means(row, static_cast<Eigen::Index>(k)) = 1.0 / static_cast<double>(columns.size());
    }
    ++row;
  }
  return means;
}

// What some effects add to the rows as fitted; 0 of one that is not in the fit.
Eigen::VectorXd fitted_curve(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(fitted.rows.size());
  for (const FittedEffect& effect : fitted.effects) {
    if (!effect.in_the_fit || !effects.contains(effect.effect)) continue;
    for (const std::size_t k : effect.columns) {
      const auto column = static_cast<Eigen::Index>(k);
      curve += fitted.curve_gains[column] * fitted.columns.values.col(column);
    }
  }
  return curve;
}

// Columns of some effects, those that recordings have of their own put together, and what they add as fitted.
struct OwnColumns {
  Eigen::MatrixXd columns;
  Eigen::VectorXd fitted;
};
OwnColumns own_columns(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  const Eigen::Index n = fitted.rows.size();
  std::map<std::pair<const Effect*, std::size_t>, Eigen::VectorXd> by_gain;
  OwnColumns own{{}, fitted_curve(fitted, effects)};
  for (const FittedEffect& effect : fitted.effects) {
    if (!effects.contains(effect.effect)) continue;
    for (const std::size_t k : effect.columns) {
      const std::pair key{effect.effect, fitted.columns.columns[k].gain};
      by_gain.try_emplace(key, Eigen::VectorXd::Zero(n)).first->second +=
          fitted.columns.values.col(static_cast<Eigen::Index>(k));
    }
  }
  own.columns.resize(n, static_cast<Eigen::Index>(by_gain.size()));
  Eigen::Index at = 0;
  for (const auto& [key, column] : by_gain) own.columns.col(at++) = column;
  return own;
}

struct Directions {
  Eigen::VectorXd ccw, cw;  // weights of the rows

  bool both() const { return ccw.sum() > 0.0 && cw.sum() > 0.0; }
};
Directions directions_of(const ErrorRows& rows) {
  const Eigen::VectorXd ccw = (rows.direction.array() > 0.0).cast<double>() * rows.count.array();
  return {ccw, rows.count - ccw};
}

// Squares that are left in each direction, the gains from the other; `others`: left in the data, but not where the
// gains are from.
double squares_left(const OwnColumns& own, const Eigen::VectorXd& data, const Directions& directions,
                    const Eigen::VectorXd& others) {
  double left = 0.0;
  for (const auto& [from, to] :
       {std::pair{&directions.ccw, &directions.cw}, std::pair{&directions.cw, &directions.ccw}}) {
    Eigen::VectorXd predicted = Eigen::VectorXd::Zero(data.size());
    if (own.columns.cols() > 0) {
      const Eigen::MatrixXd weighted = from->asDiagonal() * own.columns;
      Eigen::MatrixXd normal = own.columns.transpose() * weighted;
      normal.diagonal() *= 1.0 + 1e-9;
      normal.diagonal().array() += 1e-12;
      predicted = own.columns * normal.llt().solve(weighted.transpose() * data);
    }
    left += to->dot((data + others - predicted).cwiseAbs2());
  }
  return left;
}

// Its gains from the rows of one direction alone, all else as fitted: do they lower what is left in the other?
std::optional<bool> predicts_other(const JointErrorFit& fitted, const FittedEffect& effect,
                                   const Eigen::VectorXd& residual, const Directions& directions) {
  if (!directions.both()) return std::nullopt;
  const OwnColumns own = own_columns(fitted, {effect.effect});
  const Eigen::VectorXd data = residual + own.fitted;
  return squares_left(own, data, directions, Eigen::VectorXd::Zero(data.size())) <
         fitted.rows.count.dot(data.cwiseAbs2());
}

}  // namespace

ErrorTable error_table(const JointErrorFit& fitted, CyclicOfRuns cyclic_of_runs) {
  const std::vector<RowColumns> rows = rows_of(fitted.columns);
  ErrorTable table;
  table.rows.reserve(rows.size());
  Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), fitted.gains.size());
  std::vector<double> widened(rows.size(), 0.0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ErrorColumn& first = fitted.columns.columns[rows[r].columns.front()];
    MachineError row{rows[r].name, first.unit, 0.0, 0.0, first.effect};
    if (rows[r].columns.size() == 1) {
      const auto k = static_cast<Eigen::Index>(rows[r].columns.front());
      row.value = fitted.gains[k];
      row.sigma = std::sqrt(std::max(0.0, fitted.covariance(k, k)));
      if (!std::isnan(fitted.as_instrument[k])) row.as_instrument = fitted.as_instrument[k];
      slopes(static_cast<Eigen::Index>(r), k) = 1.0;
    } else {
      double searched = 1.0;
      for (const FittedEffect& effect : fitted.effects) {
        if (effect.effect == first.effect) searched = effect.searched;
      }
      const Amplitude amplitude = amplitude_of(fitted, rows[r].columns, cyclic_of_runs, searched);
      row.value = amplitude.value;
      row.sigma = amplitude.sigma;
      row.as_instrument = amplitude_as_instrument(fitted, rows[r].columns, cyclic_of_runs);
      slopes.row(static_cast<Eigen::Index>(r)) = amplitude.slope;
    }
    table.rows.push_back(std::move(row));
  }
  table.covariance = slopes * fitted.covariance * slopes.transpose();
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto k = static_cast<Eigen::Index>(r);
    const double sigma = table.rows[r].sigma;
    table.covariance(k, k) = std::max(table.covariance(k, k), sigma * sigma);
  }
  return table;
}

std::vector<ErrorGroup> error_groups(const JointErrorFit& fitted) {
  std::vector<ErrorGroup> groups;
  for (const FittedGroup& one : fitted.groups) {
    ErrorGroup group;
    group.p_value = one.p;
    Eigen::VectorXd curve = Eigen::VectorXd::Zero(fitted.columns.fine.rows());
    std::vector<Eigen::Index> columns;
    for (std::size_t m = 0; m < one.effects.size(); ++m) {
      const FittedEffect& effect = fitted.effects[one.effects[m]];
      group.effects.push_back(effect.effect);
      for (std::size_t k = 0; k < effect.columns.size(); ++k) {
        const ErrorColumn& column = fitted.columns.columns[effect.columns[k]];
        const auto gain = static_cast<Eigen::Index>(k);
        group.alone.push_back({column.name, column.unit, one.alone[m][gain],
                               std::sqrt(std::max(0.0, one.covariance[m](gain, gain))), effect.effect});
        if (effect.in_the_fit) columns.push_back(static_cast<Eigen::Index>(effect.columns[k]));
      }
      if (effect.in_the_fit) curve += fitted.fine_curve(effect.effect);
    }
    Eigen::Index highest = 0, lowest = 0;
    group.individual_circularity_um = curve.maxCoeff(&highest) - curve.minCoeff(&lowest);
    const Eigen::RowVectorXd slope = (fitted.columns.fine.row(highest) - fitted.columns.fine.row(lowest))(columns);
    const double variance = (slope * fitted.covariance(columns, columns) * slope.transpose()).value();
    group.sigma_um = std::sqrt(std::max(0.0, variance));
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<RankedError> ranked_errors(const JointErrorFit& fitted, const ErrorTable& table) {
  const Eigen::VectorXd residual = fitted.residual();
  const Directions directions = directions_of(fitted.rows);
  std::vector<RankedError> ranked;
  ranked.reserve(fitted.effects.size());
  double sum_um = 0.0;
  for (std::size_t place = 0; place < fitted.effects.size(); ++place) {
    const FittedEffect& effect = fitted.effects[place];
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
    one.p_value = std::min(1.0, effect.searched * std::max(effect.p_damped, p_of(values, covariance)));
    one.predicts_other_run = predicts_other(fitted, effect, residual, directions);
    one.significant = effect.is_needed && one.p_value * effect.looked_at < kFalseErrors;
    const bool of_each_recording = fitted.columns.columns[effect.columns.front()].recording.has_value();
    const bool is_spike = effect.effect->rules.error_fit == ErrorFit::at_reversals;
    if ((of_each_recording || is_spike) && one.predicts_other_run == false) one.significant = false;
    for (std::size_t g = 0; g < fitted.groups.size(); ++g) {
      if (std::find(fitted.groups[g].effects.begin(), fitted.groups[g].effects.end(), place) ==
          fitted.groups[g].effects.end())
        continue;
      one.group = g;
      one.significant = false;
    }
    ranked.push_back(std::move(one));
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedError& a, const RankedError& b) {
    return a.individual_circularity_um > b.individual_circularity_um;
  });
  for (RankedError& one : ranked) {
    one.share_percent = sum_um > 0.0 ? 100.0 * one.individual_circularity_um / sum_um : 0.0;
  }
  return ranked;
}

double held_out_rms_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  const Directions directions = directions_of(fitted.rows);
  if (!directions.both()) return kUnknown;
  std::set<const Effect*> all;
  for (const FittedEffect& effect : fitted.effects) all.insert(effect.effect);
  const OwnColumns own = own_columns(fitted, effects);
  const Eigen::VectorXd others = fitted_curve(fitted, all) - own.fitted;
  const double squares = squares_left(own, fitted.residual() + own.fitted, directions, others);
  return std::sqrt(fitted.within_um2 + squares / fitted.rows.count.sum());
}

double rms_with_um(const JointErrorFit& fitted, const std::set<const Effect*>& effects) {
  Eigen::VectorXd left = fitted.rows.deviation_um - fitted_curve(fitted, effects);
  const auto circles = std::count_if(fitted.columns.columns.begin(), fitted.columns.columns.end(),
                                     [](const ErrorColumn& column) { return column.effect == nullptr; });
  const Eigen::MatrixXd columns = fitted.columns.values.leftCols(circles);
  const Eigen::MatrixXd weighted = fitted.rows.count.asDiagonal() * columns;
  Eigen::MatrixXd normal = columns.transpose() * weighted;
  normal.diagonal() *= 1.0 + 1e-9;
  left -= columns * normal.llt().solve(weighted.transpose() * left);
  return fitted.rms_um(left);
}

}  // namespace ballbar
