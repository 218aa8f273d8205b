#include "machine_errors/error_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "ballbar/circle/trace.hpp"
#include "ballbar/units.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kFromOwnReversal_deg[2] = {12.0, 63.0};  // where cyclic errors are read
constexpr double kClearExcess = 1.5;                      // of variances
constexpr double kIndependentWidths = 2.0;                // of a spike: the curves of all are alike
constexpr double kRidge = 1e-9;                           // of a column's own square
constexpr double kAbsent = 1e-5;                          // mean square of a unit's curve: not in these readings

using Indices = std::vector<Eigen::Index>;

Indices range(Eigen::Index first, Eigen::Index count) {
  Indices indices(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < indices.size(); ++i) indices[i] = first + static_cast<Eigen::Index>(i);
  return indices;
}

Indices joined_indices(Indices first, const Indices& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

// What the centre adds beyond its first order, at these angles: exact length less radius, a cos and b sin.
Eigen::VectorXd second_order(const Eigen::VectorXd& circle, std::span<const double> angle_rad, double length_mm,
                             double height_mm) {
  Eigen::VectorXd more(static_cast<Eigen::Index>(angle_rad.size()));
  const double radius_mm = length_mm + mm_from_um(circle[0]);
  for (std::size_t i = 0; i < angle_rad.size(); ++i) {
    const double cos = std::cos(angle_rad[i]), sin = std::sin(angle_rad[i]);
    const double a_mm = mm_from_um(circle[1]) + radius_mm * cos, b_mm = mm_from_um(circle[2]) + radius_mm * sin;
    const double square = a_mm * a_mm + b_mm * b_mm + height_mm * height_mm;
    const double exact_um = um_from_mm((square - length_mm * length_mm) / (std::sqrt(square) + length_mm));
    more[static_cast<Eigen::Index>(i)] = exact_um - circle[0] - circle[1] * cos - circle[2] * sin;
  }
  return more;
}

// Takes it off the deviation, with the circle that fits it.
void free_of_second_order(ErrorFitted& fitted, const ErrorColumns& circle, double length_mm, double height_mm) {
  const std::vector<double>& angle_rad = find_column(fitted.rows.fine, trace_column("angle"))->values;
  const Eigen::VectorXd measured = fitted.rows.deviation_um;
  const Eigen::MatrixXd columns = circle.values.leftCols(3);
  const Eigen::MatrixXd weighted = fitted.rows.count.asDiagonal() * columns;
  Eigen::MatrixXd normal = columns.transpose() * weighted;
  normal.diagonal() *= 1.0 + kRidge;
  const Eigen::LLT<Eigen::MatrixXd> root(normal);
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXd fit = root.solve(weighted.transpose() * fitted.rows.deviation_um);
    fitted.second_order_um = second_order(fit, angle_rad, length_mm, height_mm);
    fitted.rows.deviation_um = measured - fitted.rows.mean({fitted.second_order_um.data(),
                                                            static_cast<std::size_t>(fitted.second_order_um.size())});
  }
}

// Rows beyond the reach of a reversal: of what a spike is there beside its form, the noise is not to learn.
Indices quiet_rows(const ErrorRows& rows) {
  Indices quiet;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] > kNearReversal_deg) quiet.push_back(i);
  }
  return quiet;
}

ErrorRows some_rows(const ErrorRows& rows, const Indices& kept) {
  ErrorRows some;
  some.count = rows.count(kept);
  some.time_s = rows.time_s(kept);
  some.angle_rad = rows.angle_rad(kept);
  some.interval_s = rows.interval_s(kept);
  some.deviation_um = rows.deviation_um(kept);
  some.recordings = rows.recordings;
  some.recording.reserve(kept.size());
  for (const Eigen::Index i : kept) some.recording.push_back(rows.recording[static_cast<std::size_t>(i)]);
  return some;
}

// By how much the readings within the reach of a reversal scatter more than the others: the form of a spike is never
// quite that of the model.
Eigen::VectorXd excess_of(const ErrorRows& rows, const Eigen::VectorXd& residual) {
  double squares[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kAtReversal_deg) continue;
    const std::size_t near = rows.from_reversal_deg[i] <= kNearReversal_deg ? 1 : 0;
    squares[near] += rows.count[i] * residual[i] * residual[i];
    count[near] += rows.count[i];
  }
  Eigen::VectorXd excess = Eigen::VectorXd::Ones(rows.size());
  if (!(count[0] > 0.0) || !(count[1] > 0.0) || !(squares[0] > 0.0)) return excess;
  const double ratio = (squares[1] / count[1]) / (squares[0] / count[0]);
  if (ratio < kClearExcess) return excess;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (rows.from_reversal_deg[i] <= kNearReversal_deg) excess[i] = std::sqrt(ratio);
  }
  return excess;
}

// Columns that say something in these readings.
ErrorColumns present(const ErrorColumns& all, const ErrorRows& rows) {
  const Eigen::VectorXd squares =
      (all.values.array().square().colwise() * rows.count.array()).colwise().sum().transpose() / rows.count.sum();
  Indices kept;
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    if (squares[k] > kAbsent * std::min(1.0, all.fine.col(k).cwiseAbs().maxCoeff())) kept.push_back(k);
  }
  ErrorColumns columns;
  columns.values = all.values(Eigen::all, kept);
  columns.fine = all.fine(Eigen::all, kept);
  columns.columns.reserve(kept.size());
  for (const Eigen::Index k : kept) columns.columns.push_back(all.columns[static_cast<std::size_t>(k)]);
  return columns;
}

// Least squares of some columns over some rows: (X' X + L)^-1 and X' with the rows' weights.
struct Block {
  Eigen::MatrixXd weighted;  // rows by columns
  Eigen::MatrixXd inverse;   // of X' X + L

  Eigen::VectorXd solve(const Eigen::VectorXd& data) const { return inverse * (weighted.transpose() * data); }
};

Block block_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& weight, const Eigen::MatrixXd& precision) {
  Block block;
  block.weighted = weight.asDiagonal() * columns;
  Eigen::MatrixXd normal = columns.transpose() * block.weighted;
  normal.diagonal() *= 1.0 + kRidge;
  normal += precision;
  normal.diagonal().array() += 1e-12;
  block.inverse = normal.llt().solve(Eigen::MatrixXd::Identity(normal.rows(), normal.cols()));
  return block;
}

// The shape of `shapes` whose columns lower the squares that `base` leaves most.
double best_shape(const Effect& effect, const std::vector<double>& shapes, const ErrorRows& rows,
                  const Eigen::MatrixXd& base, const Block& base_fit, const Eigen::VectorXd& left,
                  const Eigen::VectorXd& weight, bool of_each_recording) {
  double best = shapes.front(), most = -1.0;
  for (const double shape : shapes) {
    const ErrorColumns columns = present(effect_columns(effect, shape, rows, of_each_recording), rows);
    if (columns.size() == 0) continue;
    const Eigen::MatrixXd weighted = weight.asDiagonal() * columns.values;
    Eigen::MatrixXd normal = columns.values.transpose() * weighted;
    if (base.cols() > 0) {
      const Eigen::MatrixXd shared = base_fit.weighted.transpose() * columns.values;
      normal -= shared.transpose() * base_fit.inverse * shared;
    }
    normal.diagonal() *= 1.0 + kRidge;
    const Eigen::VectorXd seen = weighted.transpose() * left;
    const double lowers = seen.dot(normal.ldlt().solve(seen));
    if (lowers > most) most = lowers, best = shape;
  }
  return best;
}

std::optional<double> known_pitch(const Effect& effect, const ErrorSetUp& set_up) {
  return effect.rules.reversal_deg == 0.0 ? set_up.pitch_a_mm : set_up.pitch_b_mm;
}

}  // namespace

double p_of(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance) {
  const auto number = static_cast<std::size_t>(values.size());
  const double together = chi2_upper_tail(values.dot(covariance.ldlt().solve(values)), number);
  const double clearest = values.cwiseAbs2().cwiseQuotient(covariance.diagonal().cwiseMax(1e-300)).maxCoeff();
  const double alone = static_cast<double>(number) * chi2_upper_tail(clearest, 1);
  return std::min(1.0, std::min(together, alone));
}

Eigen::VectorXd ErrorFitted::fine_curve(const Effect* effect) const {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(columns.fine.rows());
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    if (columns.columns[k].effect != effect) continue;
    const auto column = static_cast<Eigen::Index>(k);
    curve += gains[column] * columns.fine.col(column);
  }
  return curve;
}

Eigen::VectorXd ErrorFitted::residual() const {
  Eigen::VectorXd left = rows.deviation_um;
  std::vector<bool> out(columns.columns.size(), false);
  for (const FittedEffect& effect : effects) {
    for (const std::size_t k : effect.columns) out[k] = !effect.in_the_fit;
  }
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (!out[k]) left -= gains[column] * columns.values.col(column);
  }
  return left;
}

ErrorFitted error_fitted(ErrorRows rows, const MachineErrorOptions& options, const ErrorSetUp& set_up) {
  ErrorFitted fitted;
  fitted.arc_rad = set_up.arc_rad;
  fitted.rows = std::move(rows);
  const ErrorRows& of = fitted.rows;
  const ErrorColumns circle = circle_columns(of);
  free_of_second_order(fitted, circle, set_up.length_mm, set_up.height_mm);
  const Eigen::VectorXd far =
      of.count.cwiseProduct((of.from_reversal_deg.array() > kAtReversal_deg).cast<double>().matrix());

  std::vector<const Effect*> cyclic_effects, extra_effects;
  std::vector<ErrorColumns> parts{circle};
  for (const auto& effect : built_in_catalogue()) {
    switch (effect->rules.error_fit) {
      case ErrorFit::together:
        parts.push_back(present(effect_columns(*effect, 0.0, of, false), of));
        break;
      case ErrorFit::along_the_travel:
        cyclic_effects.push_back(effect.get());
        break;
      case ErrorFit::where_it_shows:
        if (set_up.arc_rad < kFullTurn_rad) {
          fitted.undetermined.push_back(effect->name + ", for which a full turn is needed");
          break;
        }
        [[fallthrough]];
      case ErrorFit::at_reversals:
        extra_effects.push_back(effect.get());
        break;
      case ErrorFit::none:
        break;
    }
  }
  std::vector<const ErrorColumns*> pointers;
  pointers.reserve(parts.size());
  for (const ErrorColumns& part : parts) pointers.push_back(&part);
  const ErrorColumns together = joined(pointers);
  const std::vector<PriorStatement> statements = prior_of(together, set_up.arc_rad, set_up.middle_rad);
  if (options.prior) fitted.prior = statements;
  const Eigen::MatrixXd precision = precision_of(fitted.prior, together.size());

  // The first fit, and the cyclic errors on what it leaves.
  const Block first = block_of(together.values, far, precision);
  const Eigen::VectorXd first_gains = first.solve(of.deviation_um);
  const Eigen::VectorXd first_left = of.deviation_um - together.values * first_gains;
  std::vector<ErrorColumns> cyclic_parts;
  std::vector<Block> cyclic_blocks;
  std::vector<double> pitches;
  std::vector<double> pitches_tried;
  for (const Effect* effect : cyclic_effects) {
    Eigen::VectorXd weight = of.count;
    for (Eigen::Index i = 0; i < of.size(); ++i) {
      const double from_deg = from_reversal_deg(of.angle_rad[i], effect->rules.reversal_deg);
      if (from_deg < kFromOwnReversal_deg[0] || from_deg > kFromOwnReversal_deg[1]) weight[i] = 0.0;
    }
    const std::optional<double> known = known_pitch(*effect, set_up);
    const Parameter& pitch = effect->parameters[shape_of(*effect)];
    const std::vector<double> tried = known ? std::vector<double>{*known} : pitch.grid;
    pitches.push_back(tried.size() == 1 ? tried.front()
                                        : best_shape(*effect, tried, of, {}, {}, first_left, weight, false));
    pitches_tried.push_back(static_cast<double>(tried.size()));
    cyclic_parts.push_back(present(effect_columns(*effect, pitches.back(), of, true), of));
    const Eigen::Index n = cyclic_parts.back().size();
    cyclic_blocks.push_back(block_of(cyclic_parts.back().values, weight, Eigen::MatrixXd::Zero(n, n)));
  }
  pointers.clear();
  for (const ErrorColumns& part : cyclic_parts) pointers.push_back(&part);
  const ErrorColumns cyclic = joined(pointers);
  Eigen::VectorXd cyclic_gains(cyclic.size());
  for (Eigen::Index k = 0, at = 0; k < static_cast<Eigen::Index>(cyclic_blocks.size()); ++k) {
    const Block& block = cyclic_blocks[static_cast<std::size_t>(k)];
    cyclic_gains.segment(at, block.inverse.rows()) = block.solve(first_left);
    at += block.inverse.rows();
  }
  const Eigen::VectorXd without_cyclic = of.deviation_um - cyclic.values * cyclic_gains;

  // Errors that are fitted where they show.
  const Block all_rows = block_of(together.values, of.count, precision);
  const Eigen::VectorXd left = without_cyclic - together.values * all_rows.solve(without_cyclic);
  std::vector<ErrorColumns> extra_parts;
  std::vector<std::optional<double>> extra_shapes;
  std::vector<double> shapes_tried;
  for (const Effect* effect : extra_effects) {
    const std::size_t shape = shape_of(*effect);
    const std::vector<double> tried = shape == kNoShape ? std::vector<double>{0.0} : effect->parameters[shape].grid;
    const double best = tried.size() == 1
                            ? tried.front()
                            : best_shape(*effect, tried, of, together.values, all_rows, left, of.count, false);
    extra_parts.push_back(present(effect_columns(*effect, best, of, false), of));
    extra_shapes.push_back(shape == kNoShape ? std::nullopt : std::optional<double>(best));
    shapes_tried.push_back(tried.size() == 1 ? 1.0 : kIndependentWidths);
  }
  pointers.clear();
  for (const ErrorColumns& part : extra_parts) pointers.push_back(&part);
  const ErrorColumns extra = joined(pointers);

  fitted.columns = joined({&together, &cyclic, &extra});
  const Eigen::Index p = together.size(), c = cyclic.size(), e = extra.size();
  const Indices quiet = quiet_rows(of);
  fitted.noise = error_noise(some_rows(of, quiet), fitted.columns.values(quiet, Eigen::all));
  fitted.slow_variance_um2 = slow_variance_um2(of, fitted.noise);

  {
    const ErrorColumns told_apart = joined({&together, &extra});
    const Eigen::MatrixXd weighted = of.count.asDiagonal() * told_apart.values;
    const std::vector<std::string> alike = undetermined(told_apart.values.transpose() * weighted, told_apart);
    fitted.undetermined.insert(fitted.undetermined.begin(), alike.begin(), alike.end());
  }

  // Z: together and extra without the reversals, cyclic, together and extra with them.
  const Eigen::MatrixXd together_extra =
      fitted.columns.values(Eigen::all, joined_indices(range(0, p), range(p + c, e)));
  Eigen::MatrixXd z(of.size(), 2 * (p + e) + c);
  z.leftCols(p + e) = far.asDiagonal() * together_extra;
  for (Eigen::Index k = 0, at = p + e; k < static_cast<Eigen::Index>(cyclic_blocks.size()); ++k) {
    const Block& block = cyclic_blocks[static_cast<std::size_t>(k)];
    z.middleCols(at, block.weighted.cols()) = block.weighted;
    at += block.weighted.cols();
  }
  z.rightCols(p + e) = of.count.asDiagonal() * together_extra;
  const Eigen::MatrixXd scatter = scatter_of(excess_of(of, left).asDiagonal() * z, of, fitted.noise);
  const Eigen::VectorXd z_data = z.transpose() * of.deviation_um;

  // Gains as T Z' y. Cyclic: G (C' y - C' M b0), b0 of the first fit.
  Eigen::MatrixXd t_first = Eigen::MatrixXd::Zero(p, z.cols());
  t_first.leftCols(p) = first.inverse;
  Eigen::MatrixXd t_cyclic = Eigen::MatrixXd::Zero(c, z.cols());
  for (Eigen::Index k = 0, at = 0; k < static_cast<Eigen::Index>(cyclic_blocks.size()); ++k) {
    const Block& block = cyclic_blocks[static_cast<std::size_t>(k)];
    const Eigen::Index n = block.inverse.rows();
    t_cyclic.block(at, p + e + at, n, n) = block.inverse;
    t_cyclic.middleRows(at, n) -= block.inverse * (block.weighted.transpose() * together.values) * t_first;
    at += n;
  }
  // Some columns of together and extra over the rows with or without reversals, freed of the cyclic errors.
  const auto fit_of = [&](const Indices& chosen, bool with_reversals) {
    const Eigen::Index first_column = with_reversals ? p + e + c : 0;
    Indices in_z;
    in_z.reserve(chosen.size());
    for (const Eigen::Index k : chosen) in_z.push_back(first_column + k);
    const Eigen::MatrixXd columns = together_extra(Eigen::all, chosen);
    const auto n = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixXd normal = columns.transpose() * z(Eigen::all, in_z);
    normal.diagonal() *= 1.0 + kRidge;
    normal.topLeftCorner(p, p) += precision;
    normal.diagonal().array() += 1e-12;
    const Eigen::MatrixXd inverse = normal.llt().solve(Eigen::MatrixXd::Identity(n, n));
    Eigen::MatrixXd t = Eigen::MatrixXd::Zero(n, z.cols());
    t(Eigen::all, in_z) = inverse;
    t -= inverse * (z(Eigen::all, in_z).transpose() * cyclic.values) * t_cyclic;
    // What the prior leaves open: N^-1 L T L N^-1 with L T = s^2.
    Eigen::MatrixXd open = Eigen::MatrixXd::Zero(n, n);
    open.topLeftCorner(p, p) = precision;
    return std::pair<Eigen::MatrixXd, Eigen::MatrixXd>(t, fitted.slow_variance_um2 * inverse * open * inverse);
  };

  // All of them together tells which of the extra ones show.
  Indices chosen = range(0, p);
  bool with_reversals = false;
  const std::pair<Eigen::MatrixXd, Eigen::MatrixXd> whole = fit_of(range(0, p + e), true);
  const Eigen::VectorXd whole_gains = whole.first * z_data;
  const Eigen::MatrixXd whole_covariance = whole.first * scatter * whole.first.transpose() + whole.second;
  const double looked_at = static_cast<double>(parts.size() - 1 + cyclic_effects.size() + extra_effects.size());
  Eigen::Index at = p;
  for (std::size_t k = 0; k < extra_parts.size(); ++k) {
    const Indices own = range(at, extra_parts[k].size());
    at += extra_parts[k].size();
    FittedEffect effect{extra_effects[k], extra_shapes[k], {}, shapes_tried[k], false};
    for (const Eigen::Index i : own) effect.columns.push_back(static_cast<std::size_t>(i + c));
    if (!own.empty()) {
      const double p_value = p_of(whole_gains(own), whole_covariance(own, own)) * effect.searched;
      effect.in_the_fit = p_value * looked_at < kFalseErrors;
      if (effect.in_the_fit) {
        chosen = joined_indices(chosen, own);
        with_reversals = with_reversals || extra_effects[k]->rules.error_fit == ErrorFit::at_reversals;
      }
      fitted.effects.push_back(effect);
    }
  }
  const std::pair<Eigen::MatrixXd, Eigen::MatrixXd> final_fit = fit_of(chosen, with_reversals);

  // One matrix over all columns, in their order.
  Eigen::MatrixXd t(p + c + e, z.cols());
  Eigen::MatrixXd open = Eigen::MatrixXd::Zero(p + c + e, p + c + e);
  t.middleRows(p, c) = t_cyclic;
  t.bottomRows(e) = whole.first.bottomRows(e);
  const auto place = [&](Eigen::Index k) { return k < p ? k : k + c; };
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    t.row(place(chosen[i])) = final_fit.first.row(static_cast<Eigen::Index>(i));
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      open(place(chosen[i]), place(chosen[j])) =
          final_fit.second(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    }
  }
  fitted.gains = t * z_data;
  fitted.covariance = t * scatter * t.transpose() + open;

  Eigen::Index column = circle.size();
  for (std::size_t k = 1; k < parts.size(); ++k) {
    if (parts[k].size() == 0) continue;
    FittedEffect effect{parts[k].columns.front().effect, std::nullopt, {}};
    for (const Eigen::Index i : range(column, parts[k].size())) effect.columns.push_back(static_cast<std::size_t>(i));
    column += parts[k].size();
    fitted.effects.push_back(effect);
  }
  for (std::size_t k = 0; k < cyclic_parts.size(); ++k) {
    FittedEffect effect{cyclic_effects[k], pitches[k], {}, pitches_tried[k]};
    for (const Eigen::Index i : range(column, cyclic_parts[k].size()))
      effect.columns.push_back(static_cast<std::size_t>(i));
    column += cyclic_parts[k].size();
    fitted.effects.push_back(effect);
  }
  return fitted;
}

}  // namespace ballbar
