#include "machine_errors/error_fit.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/as_instrument.hpp"
#include "machine_errors/error_set_up.hpp"
#include "machine_errors/reversal_fit.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kFromOwnReversal_deg[2] = {12.0, 63.0};  // where cyclic errors are read
constexpr double kWidthsOfSpike = 4.0;                    // to where 2 % of its height are left

// What the centre adds beyond its first order: exact length less radius, a cos and b sin. Takes it off the deviation,
// with the circle that fits it.
void free_of_second_order(JointErrorFit& fitted, const ErrorColumns& circle, const ErrorSetUp& set_up) {
  const Eigen::VectorXd measured = fitted.rows.deviation_um;
  const Eigen::MatrixXd columns = circle.values.leftCols(3), fine = circle.fine.leftCols(3);
  const Eigen::MatrixXd weighted = fitted.rows.count.asDiagonal() * columns;
  const Eigen::MatrixXd equations = columns.transpose() * weighted;
  const Eigen::LDLT<Eigen::MatrixXd> root(equations);
  fitted.second_order_um.resize(fine.rows());
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXd products = weighted.transpose() * fitted.rows.deviation_um;
    const Eigen::Vector3d fit = root.solve(products);
    const double radius_mm = set_up.length_mm + mm_from_um(fit[0]);
    for (Eigen::Index i = 0; i < fine.rows(); ++i) {
      const double a_mm = mm_from_um(fit[1]) + radius_mm * fine(i, 1),
                   b_mm = mm_from_um(fit[2]) + radius_mm * fine(i, 2);
      const double square = a_mm * a_mm + b_mm * b_mm + set_up.height_mm * set_up.height_mm;
      const double exact_um =
          um_from_mm((square - set_up.length_mm * set_up.length_mm) / (std::sqrt(square) + set_up.length_mm));
      fitted.second_order_um[i] = exact_um - fine.row(i) * fit;
    }
    fitted.rows.deviation_um = measured - fitted.rows.means(fitted.second_order_um);
  }
}

std::vector<const Effect*> effects_fitted(ErrorFit where) {
  std::vector<const Effect*> effects;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->rules.error_fit == where) effects.push_back(effect.get());
  }
  return effects;
}

// What an estimate leaves of the rows.
Eigen::VectorXd rest_of(const ErrorRows& rows, const ErrorDesign& design, const GainEstimate& estimate) {
  const Eigen::VectorXd gains = estimate.t * (design.z.transpose() * rows.deviation_um);
  const Eigen::MatrixXd columns = design.x.values(Eigen::all, estimate.columns);
  return rows.deviation_um - columns * gains;
}

void add_cyclic(ErrorDesign& design, const ErrorRows& rows, const ErrorSetUp& set_up, const Eigen::VectorXd& left) {
  std::vector<EffectDesign> cyclic;
  for (const Effect* effect : effects_fitted(ErrorFit::along_the_travel)) {
    Eigen::VectorXd weight = rows.count;
    Indices read;
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      const double from_deg = from_reversal_deg(rows.angle_rad[i], effect->rules.reversal_deg);
      const bool is_read = from_deg >= kFromOwnReversal_deg[0] && from_deg <= kFromOwnReversal_deg[1];
      if (is_read) {
        read.push_back(i);
      } else {
        weight[i] = 0.0;
      }
    }
    const std::optional<double> known = effect->rules.reversal_deg == 0.0 ? set_up.pitch_a_mm : set_up.pitch_b_mm;
    const std::vector<double> tried = known ? std::vector{*known} : effect->parameters[shape_of(*effect)].grid;
    const double pitch_mm =
        tried.size() == 1 ? tried.front() : best_shape(*effect, tried, rows_at(rows, read), left(read), weight(read));
    const ErrorColumns columns = present(effect_columns(*effect, pitch_mm, rows, true), weight);
    FittedEffect fitted;
    fitted.effect = effect;
    fitted.shape = pitch_mm;
    fitted.searched = static_cast<double>(tried.size());
    cyclic.push_back(weighted(std::move(fitted), columns, weight));
  }
  add(design, cyclic);
}

void add_where_they_show(ErrorDesign& design, const ErrorRows& rows, const Eigen::VectorXd& left,
                         const GainEstimate& together, const Eigen::VectorXd& far) {
  std::vector<EffectDesign> added;
  for (const Effect* effect : effects_fitted(ErrorFit::where_it_shows)) {
    const std::size_t shape = shape_of(*effect);
    const std::vector<double> tried = shape == kNoShape ? std::vector<double>{0.0} : effect->parameters[shape].grid;
    const double best = best_shape(*effect, tried, rows, left, far, &design, &together);
    const ErrorColumns columns = present(effect_columns(*effect, best, rows, false), far);
    FittedEffect fitted;
    fitted.effect = effect;
    if (shape != kNoShape) fitted.shape = best;
    fitted.searched = static_cast<double>(tried.size());
    added.push_back(weighted(std::move(fitted), columns, far));
  }
  add(design, added);
}

// Columns of the circles and of the errors in the fit, without spikes.
Indices smooth_in_the_fit(const ErrorDesign& design) {
  std::vector<bool> in(design.x.columns.size(), true);
  for (const FittedEffect& effect : design.effects) {
    const bool is_one = effect.in_the_fit && effect.effect->rules.error_fit != ErrorFit::at_reversals;
    for (const Eigen::Index k : effect.columns) in[static_cast<std::size_t>(k)] = is_one;
  }
  Indices columns;
  for (std::size_t k = 0; k < in.size(); ++k) {
    if (in[k]) columns.push_back(static_cast<Eigen::Index>(k));
  }
  return columns;
}

// Those that are significant before the spikes are known.
void choose_where_they_show(ErrorDesign& design, const ErrorRows& rows, const std::vector<WeightedNoise>& noise) {
  const GainEstimate all = gain_estimate(design, all_of(design));
  for (FittedEffect& effect : design.effects) {
    if (effect.effect->rules.error_fit != ErrorFit::where_it_shows) continue;
    const Eigen::MatrixXd of_effect = all.t(effect.columns, Eigen::all);
    const Eigen::MatrixXd weights = design.z * of_effect.transpose();
    const double p = p_of(weights.transpose() * rows.deviation_um, scatter_of(weights, rows, noise));
    effect.in_the_fit = effect.searched * effect.looked_at * p < kFalseErrors;
  }
}

// The noise that all but the spikes leave. What CCW and CW have together stands first, then what they differ by: the
// noise is fitted with the circles of each.
std::vector<WeightedNoise> noise_of(const ErrorRows& rows, const ErrorDesign& design) {
  Eigen::MatrixXd columns = design.x.values;
  const bool differ = columns.cols() > 3 && design.x.columns[3].effect == nullptr && !design.x.columns[3].recording;
  for (Eigen::Index k = 0; differ && k < 3; ++k) {
    const Eigen::VectorXd half = 0.5 * columns.col(k), shift = columns.col(k + 3);
    columns.col(k) = half + shift;
    columns.col(k + 3) = half - shift;
  }
  const QuietRows quiet = quiet_rows(rows, columns);
  return error_noise(quiet.rows, quiet.columns);
}

// The steps of the plays get the widths that the readings show; without a spike that a step explains. gains: of the
// design's columns.
void fit_step_widths(ErrorDesign& design, const ErrorRows& rows, const Eigen::VectorXd& gains, const Noise& noise,
                     std::vector<const Effect*>& explained) {
  const Eigen::VectorXd left = rows.deviation_um - design.x.values * gains;
  for (const Effect* spike : effects_fitted(ErrorFit::at_reversals)) {
    for (FittedEffect& step : design.effects) {
      const bool is_its = step.effect->rules.error_fit == ErrorFit::together && shape_of(*step.effect) != kNoShape &&
                          step.effect->rules.reversal_deg == spike->rules.reversal_deg;
      if (!is_its) continue;
      PlayStep play{step.effect, {}, gains(step.columns)};
      for (const Eigen::Index k : step.columns)
        play.gains.push_back(design.x.columns[static_cast<std::size_t>(k)].gain);
      const StepWidth found = step_width(play, *spike, rows, left, noise);
      if (!found.needs_spike) explained.push_back(spike);
      step.shape = found.width_deg;
      const ErrorColumns wide = effect_columns(*step.effect, found.width_deg, rows, false);
      design.x.values(Eigen::all, step.columns) = wide.values(Eigen::all, play.gains);
      design.x.fine(Eigen::all, step.columns) = wide.fine(Eigen::all, play.gains);
      const Eigen::VectorXd far = far_weight(rows);
      design.z(Eigen::all, step.columns) = far.asDiagonal() * design.x.values(Eigen::all, step.columns);
      refresh(design, step.columns);
    }
  }
}

// Combinations that the readings cannot separate: of X' W X, and those of the cyclic errors that are held at 0.
std::vector<std::string> undetermined(const ErrorDesign& design) {
  const Indices smooth = columns_of(design, {ErrorFit::together, ErrorFit::where_it_shows});
  std::vector<ErrorColumn> names, cyclic_names;
  for (const Eigen::Index k : smooth) names.push_back(design.x.columns[static_cast<std::size_t>(k)]);
  std::vector<std::string> phrases = undetermined(design.products(smooth, smooth), names);
  const Eigen::MatrixXd held =
      gain_estimate(design, columns_of(design, {ErrorFit::together, ErrorFit::along_the_travel})).held;
  for (const Eigen::Index k : columns_of(design, {ErrorFit::along_the_travel}))
    cyclic_names.push_back(design.x.columns[static_cast<std::size_t>(k)]);
  if (held.cols() > 0) phrases.push_back(undetermined_names(held.rowwise().norm(), cyclic_names));
  return phrases;
}

// All gains with their covariance. prior: on an arc, where curves are drawn with it, because two errors that the arc
// hardly separates would become large with opposite signs; an error must be significant with it, too.
void fit_all(JointErrorFit& fitted, const Eigen::MatrixXd& prior) {
  ErrorDesign& design = fitted.design;
  const ErrorRows& rows = fitted.rows;
  const Eigen::VectorXd z_data = design.z.transpose() * rows.deviation_um;
  const Indices all = all_of(design);
  const GainEstimate whole = gain_estimate(design, all);
  const Eigen::VectorXd excess = excess_of(rows, rest_of(rows, design, whole));
  const Eigen::MatrixXd scatter = scatter_of(excess.asDiagonal() * design.z, rows, fitted.noise);
  const auto scatter_only = [&](const GainEstimate& estimate) -> Gains {
    return {estimate.t * z_data, estimate.t * scatter * estimate.t.transpose()};
  };
  const auto gains_of = [&](const GainEstimate& estimate) {
    Gains gains = scatter_only(estimate);
    gains.covariance += fitted.slow_variance_um2 * estimate.open;
    return gains;
  };
  const Gains of_all = gains_of(whole);

  for (FittedEffect& effect : design.effects) {
    if (effect.effect->rules.error_fit != ErrorFit::where_it_shows) continue;
    effect.in_the_fit = corrected_p(effect, of_all, all) < kFalseErrors;
  }
  fitted.gains = of_all.values;
  const Indices smooth = smooth_in_the_fit(design), spikes = columns_of(design, {ErrorFit::at_reversals});
  Indices chosen = smooth;  // the spikes' columns are the last
  chosen.insert(chosen.end(), spikes.begin(), spikes.end());
  const GainEstimate estimate = gain_estimate(design, chosen);
  const Gains gains = gains_of(estimate);
  fitted.gains(chosen) = gains.values;
  fitted.covariance = of_all.covariance;
  fitted.covariance(chosen, Eigen::all).setZero();
  fitted.covariance(Eigen::all, chosen).setZero();
  fitted.covariance(chosen, chosen) = gains.covariance;
  for (FittedEffect& effect : design.effects) {
    if (effect.effect->rules.error_fit == ErrorFit::at_reversals)
      effect.in_the_fit = effect.is_needed && corrected_p(effect, gains, chosen) < kFalseErrors;
  }
  const GainEstimate with_prior = prior.size() > 0 ? gain_estimate(design, chosen, prior) : estimate;
  fitted.curve_gains = fitted.gains;
  fitted.curve_gains(chosen) = with_prior.t * z_data;
  fitted.map = whole.t;
  fitted.map(chosen, Eigen::all) = with_prior.t;
  const Eigen::MatrixXd spread = fitted.map * scatter * fitted.map.transpose();
  for (FittedEffect& effect : design.effects) {
    if (prior.size() > 0)
      effect.p_with_prior = p_of(fitted.curve_gains(effect.columns), spread(effect.columns, effect.columns));
  }
  // A spike is no member of a group.
  fitted.groups = inseparable(design, of_all, all, smooth, [&](const Indices& columns) {
    std::vector<Gains> fits{gains_of(gain_estimate(design, columns))};
    if (prior.size() > 0) fits.push_back(scatter_only(gain_estimate(design, columns, prior)));
    return fits;
  });
  for (PriorStatement& statement : fitted.prior) {
    const Eigen::Index p = statement.coefficients.size();
    statement.alone = statement.coefficients.dot(fitted.gains.head(p));
    const Eigen::VectorXd of_gains = fitted.covariance.topLeftCorner(p, p) * statement.coefficients;
    statement.alone_sigma = std::sqrt(std::max(0.0, statement.coefficients.dot(of_gains)));
  }
}

// The spikes, and all gains.
void fit_beside_spikes(JointErrorFit& fitted, const Eigen::MatrixXd& prior,
                       const std::vector<const Effect*>& explained) {
  ErrorDesign& design = fitted.design;
  const Eigen::VectorXd left = rest_of(fitted.rows, design, gain_estimate(design, smooth_in_the_fit(design)));
  std::vector<EffectDesign> spikes;
  for (const Effect* spike : effects_fitted(ErrorFit::at_reversals))
    spikes.push_back(spike_design(*spike, fitted.rows, left, fitted.noise.front().noise));
  add(design, spikes);
  for (FittedEffect& effect : design.effects) {
    if (std::find(explained.begin(), explained.end(), effect.effect) != explained.end()) effect.is_needed = false;
  }
  fit_all(fitted, prior);
}

// The centre of the readings: of the fit, as instrument software has it; on an arc of less than half a turn, which does
// not determine it, that of the circles alone. The radius stays, and how CCW and CW differ.
void free_of_centre(JointErrorFit& fitted, const Series& trace) {
  const ErrorColumns& x = fitted.design.x;
  Indices circle;
  for (std::size_t k = 0; k < x.columns.size() && x.columns[k].effect == nullptr; ++k) {
    circle.push_back(static_cast<Eigen::Index>(k));
    const std::string& name = x.columns[k].name;
    if (name.starts_with("centre_a") || name.starts_with("centre_b")) fitted.centres.push_back(circle.back());
  }
  if (fitted.centre_of_fit) {
    const Eigen::MatrixXd of_centres = fitted.map(fitted.centres, Eigen::all);
    fitted.centre_map = of_centres * fitted.design.z.transpose();
  } else {
    const Eigen::MatrixXd columns = x.values(Eigen::all, circle);
    const Eigen::MatrixXd weighted = fitted.rows.count.asDiagonal() * columns;
    const Eigen::MatrixXd normal = columns.transpose() * weighted;
    const Eigen::MatrixXd of_circle = normal.ldlt().solve(Eigen::MatrixXd(weighted.transpose()));
    fitted.centre_map = of_circle(fitted.centres, Eigen::all);
  }
  // The centre at the angle of each reading; all else at that of its fine row.
  const Eigen::VectorXd centre_um = fitted.centre_map * fitted.rows.deviation_um;
  Eigen::VectorXd others = Eigen::VectorXd::Zero(x.fine.rows());
  const std::vector<bool> in = fitted.in_the_fit();
  for (std::size_t k = 0; k < in.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    const bool is_centre = std::find(fitted.centres.begin(), fitted.centres.end(), column) != fitted.centres.end();
    if (in[k] && !is_centre) others += fitted.curve_gains[column] * x.fine.col(column);
  }
  const std::vector<double>& angle_rad = find_column(trace, trace_column("angle"))->values;
  const std::vector<double>& recording = find_column(trace, trace_column("recording"))->values;
  fitted.freed_um = find_column(trace, "deviation_um")->values;
  double squares = 0.0;
  for (std::size_t i = 0; i < fitted.freed_um.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(fitted.rows.fine_of[i]);
    fitted.freed_um[i] -= fitted.second_order_um[row];
    double left = fitted.freed_um[i] - others[row];
    for (std::size_t k = 0; k < fitted.centres.size(); ++k) {
      const ErrorColumn& column = x.columns[static_cast<std::size_t>(fitted.centres[k])];
      if (static_cast<double>(column.recording.value_or(static_cast<std::size_t>(recording[i]))) != recording[i])
        continue;
      const double unit = column.name.starts_with("centre_a") ? std::cos(angle_rad[i]) : std::sin(angle_rad[i]);
      fitted.freed_um[i] -= centre_um[static_cast<Eigen::Index>(k)] * unit;
      left -= fitted.curve_gains[fitted.centres[k]] * unit;
    }
    squares += left * left;
  }
  const double of_rows = fitted.residual().cwiseAbs2().dot(fitted.rows.count);
  fitted.within_um2 = std::max(0.0, (squares - of_rows) / fitted.rows.count.sum());
}

}  // namespace

Eigen::VectorXd JointErrorFit::centre_curve(const Eigen::VectorXd& fine) const {
  const Eigen::MatrixXd of_centres = design.x.fine(Eigen::all, centres), centre = centre_map * rows.means(fine);
  return of_centres * centre;
}

Eigen::VectorXd JointErrorFit::fine_curve(const Effect* effect) const {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(design.x.fine.rows());
  for (const FittedEffect& one : design.effects) {
    if (one.effect == effect) {
      const Eigen::MatrixXd columns = design.x.fine(Eigen::all, one.columns);
      const Eigen::VectorXd of_columns = curve_gains(one.columns);
      curve += columns * of_columns;
    }
  }
  return curve;
}

std::vector<bool> JointErrorFit::in_the_fit() const {
  std::vector<bool> in(design.x.columns.size(), true);
  for (const FittedEffect& effect : design.effects) {
    for (const Eigen::Index k : effect.columns) in[static_cast<std::size_t>(k)] = effect.in_the_fit;
  }
  return in;
}

Eigen::VectorXd JointErrorFit::residual() const {
  Eigen::VectorXd left = rows.deviation_um;
  const std::vector<bool> in = in_the_fit();
  for (std::size_t k = 0; k < in.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (in[k]) left -= curve_gains[column] * design.x.values.col(column);
  }
  return left;
}

double JointErrorFit::rms_um(const Eigen::VectorXd& left) const {
  return std::sqrt(within_um2 + left.cwiseAbs2().dot(rows.count) / rows.count.sum());
}

JointErrorFit joint_error_fit(const Series& trace, const MachineErrorOptions& options) {
  const ErrorSetUp set_up = set_up_of(trace);
  if (set_up.arc_rad < kShortestArc_rad) {
    throw Error(
        fmt::format("an arc of {:.0f} deg is too short for the errors of the axes: expected at least {:.0f} deg, below "
                    "which they look alike. ballbar fit gives the circle.",
                    deg_from_rad(set_up.arc_rad), deg_from_rad(kShortestArc_rad)));
  }
  JointErrorFit fitted;
  fitted.is_full = set_up.arc_rad >= kFullTurn_rad;
  fitted.centre_of_fit = set_up.arc_rad >= kPi;
  fitted.rows = error_rows(with_feed(trace));
  const ErrorRows& rows = fitted.rows;
  const Eigen::VectorXd measured = rows.deviation_um;
  const ErrorColumns circle = circle_columns(rows);
  free_of_second_order(fitted, circle, set_up);

  ErrorDesign& design = fitted.design;
  const Eigen::VectorXd far = far_weight(rows);
  std::vector<EffectDesign> of_all{weighted(FittedEffect(), circle, far)};
  for (const Effect* effect : effects_fitted(ErrorFit::together)) {
    const ErrorColumns columns = present(effect_columns(*effect, 0.0, rows, false), rows.count);
    FittedEffect one;
    one.effect = effect;
    of_all.push_back(weighted(std::move(one), columns, far));
  }
  add(design, of_all);
  fitted.at_once = design.x.fine;
  fitted.prior =
      prior_of(design.x, rows.count.sum() / static_cast<double>(rows.recordings), set_up.arc_rad, set_up.middle_rad);
  const Eigen::MatrixXd usual = precision_of(fitted.prior, design.x.size());
  const Eigen::MatrixXd prior = fitted.is_full || !options.prior ? Eigen::MatrixXd() : usual;
  const Indices together = columns_of(design, {ErrorFit::together});
  add_cyclic(design, rows, set_up, rest_of(rows, design, gain_estimate(design, together)));

  const Eigen::VectorXd as_instrument =
      gain_estimate(design, all_of(design), usual).t * (design.z.transpose() * measured);
  if (fitted.is_full) {
    const Eigen::VectorXd left = rest_of(rows, design, gain_estimate(design, all_of(design)));
    add_where_they_show(design, rows, left, gain_estimate(design, together), far);
  } else {
    for (const Effect* effect : effects_fitted(ErrorFit::where_it_shows))
      fitted.undetermined.push_back(effect->name + ", for which a full turn is needed");
  }
  fitted.noise = noise_of(rows, design);
  fitted.slow_variance_um2 = slow_variance_um2(rows, fitted.noise);
  const auto others = static_cast<double>(design.effects.size());
  for (FittedEffect& effect : design.effects) effect.looked_at = others;
  choose_where_they_show(design, rows, fitted.noise);
  std::vector<const Effect*> explained;  // spikes
  const GainEstimate smooth = gain_estimate(design, smooth_in_the_fit(design), prior);
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(design.x.size());
  gains(smooth.columns) = smooth.t * (design.z.transpose() * rows.deviation_um);
  fit_step_widths(design, rows, gains, fitted.noise.front().noise, explained);
  fit_beside_spikes(fitted, prior, explained);

  Eigen::VectorXd beyond = far;  // without the readings under a spike
  for (const FittedEffect& effect : design.effects) {
    if (effect.effect->rules.error_fit != ErrorFit::at_reversals || !effect.in_the_fit) continue;
    const double reach_deg = std::min(kNearReversal_deg, kWidthsOfSpike * effect.shape.value_or(0.0));
    for (Eigen::Index i = 0; i < rows.size(); ++i)
      if (since_reversal_deg(rows, i, effect.effect->rules.reversal_deg) <= reach_deg) beyond[i] = 0.0;
  }
  if (beyond != far) {
    remove_last(design, ErrorFit::at_reversals);
    const Indices weighted = columns_of(design, {ErrorFit::together, ErrorFit::where_it_shows});
    design.z(Eigen::all, weighted) = beyond.asDiagonal() * design.x.values(Eigen::all, weighted);
    refresh(design, weighted);
    fit_beside_spikes(fitted, prior, explained);
  }

  std::vector<std::string> phrases = undetermined(design);
  fitted.undetermined.insert(fitted.undetermined.begin(), phrases.begin(), phrases.end());
  fitted.as_instrument = Eigen::VectorXd::Constant(fitted.gains.size(), kUnknown);
  fitted.as_instrument.head(as_instrument.size()) = as_instrument;
  add_spikes_as_instrument(fitted, options.cyclic_of_runs);
  for (ErrorColumn& column : design.x.columns) {
    if (column.effect != nullptr && grows_with_feed(*column.effect) && !states_feed(trace)) column.unit = "um";
  }
  free_of_centre(fitted, trace);
  return fitted;
}

}  // namespace ballbar
