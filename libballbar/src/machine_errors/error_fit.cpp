#include "machine_errors/error_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/circle/trace.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/as_instrument.hpp"
#include "machine_errors/error_blocks.hpp"
#include "machine_errors/gain_maps.hpp"
#include "machine_errors/reversal_noise.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kFromOwnReversal_deg[2] = {12.0, 63.0};  // where cyclic errors are read
constexpr double kContradicts = 5.0;                      // sigma
constexpr double kIndependentWidths = 2.0;                // of a spike: the curves of all are alike

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

// What the catalogue has, by where it is fitted.
struct ErrorKinds {
  std::vector<const Effect*> together, along_the_travel, where_they_show, at_reversals;
};

ErrorKinds error_kinds(double arc_rad, std::vector<std::string>& left_out) {
  ErrorKinds kinds;
  for (const auto& effect : built_in_catalogue()) {
    switch (effect->rules.error_fit) {
      case ErrorFit::together:
        kinds.together.push_back(effect.get());
        break;
      case ErrorFit::along_the_travel:
        kinds.along_the_travel.push_back(effect.get());
        break;
      case ErrorFit::where_it_shows:
        if (arc_rad < kFullTurn_rad) {
          left_out.push_back(effect->name + ", for which a full turn is needed");
          break;
        }
        kinds.where_they_show.push_back(effect.get());
        break;
      case ErrorFit::at_reversals:
        kinds.at_reversals.push_back(effect.get());
        break;
      case ErrorFit::none:
        break;
    }
  }
  return kinds;
}

// Some effects with their columns, those of all in one; FittedEffect::columns are places in it.
struct Part {
  ErrorColumns columns;
  std::vector<FittedEffect> effects;
};

Part part_of(const std::vector<std::pair<FittedEffect, ErrorColumns>>& own) {
  Part part;
  std::vector<const ErrorColumns*> pointers;
  pointers.reserve(own.size());
  part.effects.reserve(own.size());
  std::size_t at = 0;
  for (const auto& [effect, columns] : own) {
    pointers.push_back(&columns);
    part.effects.push_back(effect);
    for (Eigen::Index k = 0; k < columns.size(); ++k) part.effects.back().columns.push_back(at++);
  }
  part.columns = joined(pointers);
  std::erase_if(part.effects, [](const FittedEffect& effect) { return effect.columns.empty() && effect.effect; });
  return part;
}

// The circles, without an effect, and the errors that are fitted together.
Part together_part(const ErrorColumns& circle, const std::vector<const Effect*>& effects, const ErrorRows& rows) {
  std::vector<std::pair<FittedEffect, ErrorColumns>> own{{FittedEffect{}, circle}};
  own.reserve(effects.size() + 1);
  for (const Effect* effect : effects) {
    own.emplace_back(FittedEffect{effect}, present(effect_columns(*effect, 0.0, rows, false), rows.count));
  }
  Part part = part_of(own);
  part.effects.erase(part.effects.begin());
  return part;
}

struct CyclicPart {
  Part part;
  Block block;  // all of them at once, each read on its own rows: the inverse is not symmetric
};

// left: of the data after the first fit, a block of columns `together`. What that fit takes of the cyclic errors
// themselves is in the equations.
CyclicPart cyclic_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const ErrorSetUp& set_up,
                       const Eigen::MatrixXd& together, const Block& first, const Eigen::VectorXd& left) {
  std::vector<std::pair<FittedEffect, ErrorColumns>> own;
  std::vector<Eigen::MatrixXd> weighted;
  own.reserve(effects.size());
  weighted.reserve(effects.size());
  for (const Effect* effect : effects) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
    Indices read;
    read.reserve(rows.recording.size());
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      const double from_deg = from_reversal_deg(rows.angle_rad[i], effect->rules.reversal_deg);
      if (from_deg < kFromOwnReversal_deg[0] || from_deg > kFromOwnReversal_deg[1]) continue;
      weight[i] = rows.count[i];
      read.push_back(i);
    }
    const std::optional<double> known = effect->rules.reversal_deg == 0.0 ? set_up.pitch_a_mm : set_up.pitch_b_mm;
    const std::vector<double> tried = known ? std::vector<double>{*known} : effect->parameters[shape_of(*effect)].grid;
    const double pitch_mm = tried.size() == 1
                                ? tried.front()
                                : best_shape(*effect, tried, rows_at(rows, read), {}, left(read), weight(read));
    ErrorColumns columns = present(effect_columns(*effect, pitch_mm, rows, true), weight);
    weighted.emplace_back(weight.asDiagonal() * columns.values);
    own.emplace_back(FittedEffect{effect, pitch_mm, {}, static_cast<double>(tried.size())}, std::move(columns));
  }
  CyclicPart cyclic;
  cyclic.part = part_of(own);
  const Eigen::MatrixXd& columns = cyclic.part.columns.values;
  cyclic.block.weighted.resize(rows.size(), columns.cols());
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& of_one : weighted) {
    cyclic.block.weighted.middleCols(at, of_one.cols()) = of_one;
    at += of_one.cols();
  }
  const Eigen::MatrixXd taken = first.inverse * (first.weighted.transpose() * columns);
  Eigen::MatrixXd equations = cyclic.block.weighted.transpose() * (columns - together * taken);
  equations.diagonal() *= 1.0 + kRidge;
  cyclic.block.inverse = equations.partialPivLu().inverse();
  return cyclic;
}

// Of shapes the one that lowers most what all others leave, over the readings of these weights.
Part extra_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const Base& base,
                const Eigen::VectorXd& left, const Eigen::VectorXd& weight) {
  std::vector<std::pair<FittedEffect, ErrorColumns>> own;
  own.reserve(effects.size());
  for (const Effect* effect : effects) {
    const std::size_t shape = shape_of(*effect);
    const std::vector<double> tried = shape == kNoShape ? std::vector<double>{0.0} : effect->parameters[shape].grid;
    const double best = best_shape(*effect, tried, rows, base, left, weight);
    own.emplace_back(FittedEffect{effect,
                                  shape == kNoShape ? std::nullopt : std::optional<double>(best),
                                  {},
                                  tried.size() == 1 ? 1.0 : kIndependentWidths,
                                  false},
                     present(effect_columns(*effect, best, rows, false), weight));
  }
  return part_of(own);
}

struct SpikePart {
  Part part;
  Eigen::MatrixXd near;  // its columns, with the weights of the readings near their own reversal
};

// Each of the readings within reach of its own reversal, of all recordings.
SpikePart spike_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const Eigen::VectorXd& left) {
  SpikePart spikes;
  std::vector<Eigen::VectorXd> weights;
  std::vector<std::pair<FittedEffect, ErrorColumns>> own;
  for (const Effect* effect : effects) {
    Eigen::VectorXd weight = rows.count;
    Indices near;
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      if (from_reversal_deg(rows.angle_rad[i], effect->rules.reversal_deg) <= kNearReversal_deg) {
        near.push_back(i);
      } else {
        weight[i] = 0.0;
      }
    }
    if (near.empty()) continue;
    const std::vector<double>& tried = effect->parameters[shape_of(*effect)].grid;
    const double width_deg = best_shape(*effect, tried, rows_at(rows, near), {}, left(near), weight(near));
    own.emplace_back(FittedEffect{effect, width_deg, {}, kIndependentWidths, false},
                     present(effect_columns(*effect, width_deg, rows, false), weight));
    for (Eigen::Index k = 0; k < own.back().second.size(); ++k) weights.push_back(weight);
  }
  spikes.part = part_of(own);
  spikes.near = spikes.part.columns.values;
  spikes.near.conservativeResize(rows.size(), Eigen::NoChange);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    spikes.near.col(static_cast<Eigen::Index>(k)).array() *= weights[k].array();
  }
  return spikes;
}

// Which of the extra errors are clear beside all others: then they are in the fit.
void choose(std::vector<FittedEffect>& effects, const Eigen::VectorXd& gains, const Eigen::MatrixXd& covariance,
            Eigen::Index first, double looked_at) {
  for (FittedEffect& effect : effects) {
    Indices own;
    own.reserve(effect.columns.size());
    for (const std::size_t k : effect.columns) own.push_back(first + static_cast<Eigen::Index>(k));
    effect.in_the_fit = effect.searched * looked_at * p_of(gains(own), covariance(own, own)) < kFalseErrors;
  }
}

void append(std::vector<FittedEffect>& all, std::vector<FittedEffect> effects, Eigen::Index first) {
  for (FittedEffect& effect : effects) {
    for (std::size_t& column : effect.columns) column += static_cast<std::size_t>(first);
    all.push_back(std::move(effect));
  }
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

double ErrorFitted::rms_um(const Eigen::VectorXd& left) const {
  return std::sqrt(within_um2 + left.cwiseAbs2().dot(rows.count) / rows.count.sum());
}

ErrorFitted error_fitted(ErrorRows rows, const MachineErrorOptions& options, const ErrorSetUp& set_up) {
  ErrorFitted fitted;
  fitted.arc_rad = set_up.arc_rad;
  fitted.rows = std::move(rows);
  const ErrorRows& of = fitted.rows;
  const Eigen::VectorXd measured = of.deviation_um;
  const ErrorColumns circle = circle_columns(of);
  free_of_second_order(fitted, circle, set_up.length_mm, set_up.height_mm);
  const ErrorKinds kinds = error_kinds(set_up.arc_rad, fitted.undetermined);
  const Part together = together_part(circle, kinds.together, of);
  const Eigen::MatrixXd& columns = together.columns.values;
  const std::vector<PriorStatement> prior = prior_of(
      together.columns, of.count.sum() / static_cast<double>(of.recordings), set_up.arc_rad, set_up.middle_rad);
  const Eigen::MatrixXd usual = precision_of(prior, columns.cols());
  if (options.prior) fitted.prior = prior;
  const Eigen::MatrixXd precision = precision_of(fitted.prior, columns.cols());

  // The first fit without the reversals, and the cyclic errors on what it leaves; then both as the instrument has them.
  const Eigen::VectorXd far =
      of.count.cwiseProduct((of.from_reversal_deg.array() > kAtReversal_deg).cast<double>().matrix());
  const Block first = block_of(columns, far, usual);
  const Eigen::VectorXd first_left = of.deviation_um - columns * first.solve(of.deviation_um);
  const CyclicPart cyclic = cyclic_part(kinds.along_the_travel, of, set_up, columns, first, first_left);
  const Eigen::Index p = columns.cols(), c = cyclic.part.columns.size();
  const Eigen::VectorXd without_cyclic = of.deviation_um - cyclic.part.columns.values * cyclic.block.solve(first_left);

  // Errors that are fitted where they show, on what all others leave.
  const Block own = options.prior ? first : block_of(columns, far, precision);
  const Eigen::VectorXd left = without_cyclic - columns * own.solve(without_cyclic);
  Part extra = extra_part(kinds.where_they_show, of, {&columns, &own}, left, far);
  SpikePart spikes = spike_part(kinds.at_reversals, of, left);
  const ErrorColumns smooth = joined({&together.columns, &cyclic.part.columns, &extra.columns});
  const QuietRows quiet = quiet_rows(of, smooth.values);
  fitted.noise = error_noise(quiet.rows, quiet.columns);
  fitted.slow_variance_um2 = slow_variance_um2(of, fitted.noise);
  fitted.columns = joined({&smooth, &spikes.part.columns});
  const Eigen::Index e = extra.columns.size(), s = spikes.part.columns.size();
  fitted.as_instrument = Eigen::VectorXd::Constant(p + c + e + s, std::numeric_limits<double>::quiet_NaN());
  const Eigen::VectorXd waves = cyclic.block.solve(measured - columns * first.solve(measured));
  fitted.as_instrument.head(p) = first.solve(measured - cyclic.part.columns.values * waves);
  fitted.as_instrument.segment(p, c) = waves;

  const GainMaps maps({&of, &far, &first, &together.columns, &cyclic.part.columns, &cyclic.block, &extra.columns,
                       &spikes.part.columns, &spikes.near, &precision, fitted.slow_variance_um2});
  const Eigen::VectorXd z_data = maps.z().transpose() * of.deviation_um;
  const GainMap whole = maps.of(maps.all());
  const GainMap everything = maps.joined(whole, maps.all(), whole);
  const Eigen::VectorXd all_left = of.deviation_um - fitted.columns.values * (everything.t * z_data);
  const Eigen::MatrixXd scatter = scatter_of(excess_of(of, all_left).asDiagonal() * maps.z(), of, fitted.noise);
  const std::vector<std::string> alike = undetermined(maps.normal(), joined({&together.columns, &extra.columns}));
  fitted.undetermined.insert(fitted.undetermined.begin(), alike.begin(), alike.end());

  // What the prior says, by the readings alone.
  if (!fitted.prior.empty()) {
    const GainMap alone = maps.of(range_of(0, p), false);
    const Eigen::VectorXd gains = alone.t * z_data;
    const Eigen::MatrixXd covariance = alone.t * scatter * alone.t.transpose() + alone.open;
    for (PriorStatement& statement : fitted.prior) {
      statement.alone = statement.coefficients.dot(gains);
      statement.alone_sigma = std::sqrt(statement.coefficients.dot(covariance * statement.coefficients));
      const double held = fitted.slow_variance_um2 / statement.precision;
      const double apart = std::abs(statement.alone) / std::hypot(statement.alone_sigma, std::sqrt(held));
      fitted.prior_contradicted = fitted.prior_contradicted || apart > kContradicts;
    }
  }

  // All of them together tells which of the extra ones show; these are fitted with the rest, and the spikes on what
  // that leaves.
  const auto looked_at = static_cast<double>(kinds.together.size() + kinds.along_the_travel.size() +
                                             kinds.where_they_show.size() + kinds.at_reversals.size());
  choose(extra.effects, whole.t * z_data, whole.t * scatter * whole.t.transpose() + whole.open, p, looked_at);
  Indices chosen = range_of(0, p);
  for (const FittedEffect& effect : extra.effects) {
    if (!effect.in_the_fit) continue;
    for (const std::size_t k : effect.columns) chosen.push_back(p + static_cast<Eigen::Index>(k));
  }
  const GainMap map = maps.joined(whole, chosen, maps.of(chosen));
  fitted.gains = map.t * z_data;
  fitted.covariance = map.t * scatter * map.t.transpose() + map.open;
  fitted.map = map.t;
  fitted.weighted = maps.z();
  choose(spikes.part.effects, fitted.gains, fitted.covariance, p + c + e, looked_at);
  append(fitted.effects, extra.effects, p + c);
  append(fitted.effects, spikes.part.effects, p + c + e);
  append(fitted.effects, together.effects, 0);
  append(fitted.effects, cyclic.part.effects, p);
  add_spikes_as_instrument(fitted, options.cyclic_of_runs);
  return fitted;
}

}  // namespace ballbar
