#include "machine_errors/error_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "ballbar/circle/trace.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/as_instrument.hpp"
#include "machine_errors/cyclic_fit.hpp"
#include "machine_errors/error_blocks.hpp"
#include "machine_errors/spike_fit.hpp"
#include "numerics/not_finite.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kWidthsOfSpike = 4.0;  // to where 2 % of its height are left
constexpr double kCorrelated = 0.9;     // gains of errors that the readings hardly separate

// What the centre adds beyond its first order: exact length less radius, a cos and b sin. fine: these three columns.
Eigen::VectorXd second_order(const Eigen::VectorXd& circle, const Eigen::MatrixXd& fine, double length_mm,
                             double height_mm) {
  Eigen::VectorXd more(fine.rows());
  const double radius_mm = length_mm + mm_from_um(circle[0]);
  for (Eigen::Index i = 0; i < fine.rows(); ++i) {
    const double cos = fine(i, 1), sin = fine(i, 2);
    const double a_mm = mm_from_um(circle[1]) + radius_mm * cos, b_mm = mm_from_um(circle[2]) + radius_mm * sin;
    const double square = a_mm * a_mm + b_mm * b_mm + height_mm * height_mm;
    const double exact_um = um_from_mm((square - length_mm * length_mm) / (std::sqrt(square) + length_mm));
    more[i] = exact_um - circle[0] - circle[1] * cos - circle[2] * sin;
  }
  return more;
}

// Takes it off the deviation, with the circle that fits it.
void free_of_second_order(JointErrorFit& fitted, const ErrorColumns& circle, double length_mm, double height_mm) {
  const Eigen::VectorXd measured = fitted.rows.deviation_um;
  const Eigen::MatrixXd columns = circle.values.leftCols(3);
  const Eigen::MatrixXd weighted = fitted.rows.count.asDiagonal() * columns;
  Eigen::MatrixXd normal = columns.transpose() * weighted;
  normal.diagonal() *= 1.0 + kRidge;
  const Eigen::LLT<Eigen::MatrixXd> root(normal);
  for (int step = 0; step < 3; ++step) {
    const Eigen::VectorXd fit = root.solve(weighted.transpose() * fitted.rows.deviation_um);
    fitted.second_order_um = second_order(fit, circle.fine, length_mm, height_mm);
    fitted.rows.deviation_um = measured - fitted.rows.mean({fitted.second_order_um.data(),
                                                            static_cast<std::size_t>(fitted.second_order_um.size())});
  }
}

std::vector<const Effect*> effects_fitted(ErrorFit where) {
  std::vector<const Effect*> effects;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->rules.error_fit == where) effects.push_back(effect.get());
  }
  return effects;
}

// The circles, without an effect, and the errors that are fitted together.
Part together_part(const ErrorColumns& circle, const std::vector<const Effect*>& effects, const ErrorRows& rows) {
  std::vector<std::pair<FittedEffect, ErrorColumns>> own{{FittedEffect{}, circle}};
  own.reserve(effects.size() + 1);
  for (const Effect* effect : effects) {
    own.emplace_back(FittedEffect{effect}, present(effect_columns(*effect, 0.0, rows, false), rows.count));
  }
  Part part = part_of(own, rows);
  part.effects.erase(part.effects.begin());
  return part;
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
                                  static_cast<double>(tried.size()),
                                  1.0,
                                  false},
                     present(effect_columns(*effect, best, rows, false), weight));
  }
  return part_of(own, rows);
}

Indices columns_of(const FittedEffect& effect, Eigen::Index first) {
  Indices columns;
  columns.reserve(effect.columns.size());
  for (const std::size_t k : effect.columns) columns.push_back(first + static_cast<Eigen::Index>(k));
  return columns;
}

// Which of the extra errors are clear beside all others: then they are in the fit.
void choose(std::vector<FittedEffect>& effects, const Eigen::VectorXd& gains, const Eigen::MatrixXd& covariance,
            Eigen::Index first) {
  for (FittedEffect& effect : effects) {
    const Indices own = columns_of(effect, first);
    effect.in_the_fit =
        effect.is_needed && effect.searched * effect.looked_at * p_of(gains(own), covariance(own, own)) < kFalseErrors;
  }
}

void append(std::vector<FittedEffect>& all, std::vector<FittedEffect> effects, Eigen::Index first) {
  for (FittedEffect& effect : effects) {
    for (std::size_t& column : effect.columns) column += static_cast<std::size_t>(first);
    all.push_back(std::move(effect));
  }
}

// Whether the circles of CCW and CW are told apart.
bool differ(const ErrorColumns& together) {
  return together.size() > 3 && together.columns[3].effect == nullptr && !together.columns[3].recording;
}

// What is fitted one after another.
struct Stages {
  Part together;
  Block first;  // of the columns together, over the rows of `far`
  CyclicPart cyclic;
  Part extra;
  Spikes spikes;
};

// The first fit over other rows and with another prior, and the cyclic errors, of the same pitches, on what it leaves.
void refit(Stages& stages, const Eigen::VectorXd& far, const Eigen::MatrixXd& precision) {
  stages.first = block_of(stages.together.columns.values, far, precision);
  with_first(stages.cyclic, stages.first);
}

// Gains of a fit of the columns together, once the cyclic errors are taken off, and what both leave of the rows.
struct FirstFit {
  Eigen::VectorXd gains, left;
};
FirstFit first_fit(const Stages& stages, const Block& together, const ErrorRows& rows) {
  const Eigen::MatrixXd& columns = stages.together.columns.values;
  const Eigen::VectorXd first_left = rows.deviation_um - columns * stages.first.solve(rows.deviation_um);
  const Eigen::VectorXd without_cyclic =
      rows.deviation_um - stages.cyclic.part.columns.values * stages.cyclic.block.solve(first_left);
  FirstFit fit{together.solve(without_cyclic), {}};
  fit.left = without_cyclic - columns * fit.gains;
  return fit;
}

// Gains and their covariance.
struct Gains {
  Eigen::VectorXd values;
  Eigen::MatrixXd covariance;
};

// Largest correlation between gains of two effects.
double correlation(const Eigen::MatrixXd& covariance, const Indices& one, const Indices& other) {
  const Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(1e-300).cwiseSqrt();
  double largest = 0.0;
  for (const Eigen::Index i : one) {
    for (const Eigen::Index j : other) {
      largest = std::max(largest, std::abs(covariance(i, j)) / (sigma[i] * sigma[j]));
    }
  }
  return largest;
}

Indices joined(const std::vector<Indices>& columns, const std::vector<std::size_t>& which) {
  Indices all;
  for (const std::size_t k : which) all.insert(all.end(), columns[k].begin(), columns[k].end());
  return all;
}

// Sets of effects with correlated gains, among those that are not significant.
std::vector<std::vector<std::size_t>> correlated_sets(const std::vector<Indices>& columns,
                                                      const std::vector<std::size_t>& open,
                                                      const Eigen::MatrixXd& covariance) {
  std::vector<std::vector<std::size_t>> sets;
  for (const std::size_t k : open) {
    std::vector<std::size_t> set{k};
    std::erase_if(sets, [&](const std::vector<std::size_t>& other) {
      if (correlation(covariance, columns[k], joined(columns, other)) < kCorrelated) return false;
      set.insert(set.end(), other.begin(), other.end());
      return true;
    });
    std::sort(set.begin(), set.end());
    sets.push_back(std::move(set));
  }
  return sets;
}

// Groups among the effects together and the extra ones: in the fit of all (`whole`) no member is significant, and each
// is so in the fit (`chosen`) without the other members. `damping`: as in fit_all; each is so with it, too.
template <class Covariance>
std::vector<FittedGroup> groups_in(const Stages& stages, const GainMaps& maps, const GainMap& whole,
                                   const Indices& chosen, const Eigen::VectorXd& z_data, const Covariance& covariance,
                                   const Eigen::MatrixXd* damping) {
  std::vector<FittedEffect> effects = stages.extra.effects;
  effects.insert(effects.end(), stages.together.effects.begin(), stages.together.effects.end());
  const Gains all{whole.t * z_data, covariance(whole) + whole.open};
  std::vector<Indices> columns;
  std::vector<std::size_t> open;
  for (std::size_t k = 0; k < effects.size(); ++k) {
    const bool is_extra = k < stages.extra.effects.size();
    columns.push_back(columns_of(effects[k], is_extra ? stages.together.columns.size() : 0));
    const double p = p_of(all.values(columns[k]), all.covariance(columns[k], columns[k]));
    if (effects[k].searched * effects[k].looked_at * p >= kFalseErrors) open.push_back(k);
  }
  // What does not explain the readings alone is no member; without it the others may be other sets.
  std::vector<FittedGroup> groups;
  for (bool is_smaller = true; is_smaller;) {
    groups.clear();
    is_smaller = false;
    for (const std::vector<std::size_t>& set : correlated_sets(columns, open, all.covariance)) {
      if (set.size() < 2) continue;
      const Indices of_set = joined(columns, set);
      FittedGroup group;
      for (const std::size_t k : set) {
        Indices kept = columns[k];
        std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(kept),
                     [&](Eigen::Index one) { return std::find(of_set.begin(), of_set.end(), one) == of_set.end(); });
        const auto size = static_cast<Eigen::Index>(columns[k].size());
        const GainMap alone = maps.of(kept, {});
        const Eigen::VectorXd values = (alone.t * z_data).head(size);
        const Eigen::MatrixXd spread = (covariance(alone) + alone.open).topLeftCorner(size, size);
        double p = p_of(values, spread);
        if (damping != nullptr) {
          const GainMap damped = maps.of(kept, (*damping)(kept, kept));
          p = std::max(p, p_of((damped.t * z_data).head(size), covariance(damped).topLeftCorner(size, size)));
        }
        if (p * effects[k].looked_at * effects[k].searched >= kFalseErrors) {
          std::erase(open, k);
          is_smaller = true;
          continue;
        }
        group.p = std::min(1.0, std::min(group.p, p * static_cast<double>(set.size())));
        // In the order of JointErrorFit::effects.
        group.effects.push_back(k + (k < stages.extra.effects.size() ? 0 : stages.spikes.effects.size()));
        group.alone.push_back(values);
        group.covariance.push_back(spread);
      }
      if (group.effects.size() > 1) groups.push_back(std::move(group));
    }
  }
  return groups;
}

// The steps of the plays get the widths that the readings show. Result: the spikes that a step of some width explains.
std::vector<const Effect*> fit_step_widths(Stages& stages, const Block& together, const ErrorRows& rows,
                                           const std::vector<const Effect*>& spikes, const Noise& noise) {
  const auto [gains, left] = first_fit(stages, together, rows);
  std::vector<const Effect*> explained;
  for (const Effect* spike : spikes) {
    const auto step =
        std::find_if(stages.together.effects.begin(), stages.together.effects.end(), [&](const FittedEffect& one) {
          return shape_of(*one.effect) != kNoShape && one.effect->rules.reversal_deg == spike->rules.reversal_deg;
        });
    if (step == stages.together.effects.end()) continue;
    const Indices columns = columns_of(*step, 0);
    PlayStep play{step->effect, {}, gains(columns)};
    for (const std::size_t k : step->columns) play.gains.push_back(stages.together.columns.columns[k].gain);
    const StepWidth found = step_width(play, *spike, rows, left, noise);
    if (found.spike_evidence < kLeastSpikeEvidence) explained.push_back(spike);
    step->shape = found.width_deg;
    const ErrorColumns wide = effect_columns(*step->effect, found.width_deg, rows, false);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const auto gain = static_cast<Eigen::Index>(play.gains[k]);
      stages.together.columns.values.col(columns[k]) = wide.values.col(gain);
      stages.together.columns.fine.col(columns[k]) = wide.fine.col(gain);
    }
  }
  return explained;
}

// All gains with their covariance: those together with the extra ones that are clear, then the spikes. `damping`: on an
// arc, where curves are drawn with it, since two errors that the arc hardly tells apart would be large ones against
// each other; and an error must show with it too.
void fit_all(JointErrorFit& fitted, Stages& stages, const Eigen::VectorXd& far, const Eigen::MatrixXd* damping) {
  const ErrorRows& of = fitted.rows;
  const Eigen::Index p = stages.together.columns.size(), c = stages.cyclic.part.columns.size();
  const Eigen::Index e = stages.extra.columns.size();
  const std::vector<const ErrorColumns*> all{&stages.together.columns, &stages.cyclic.part.columns,
                                             &stages.extra.columns, &stages.spikes.columns};
  fitted.columns = joined(all, of);
  const GainMaps maps({&of, &far, &stages.first, &stages.together.columns, &stages.cyclic.part.columns,
                       &stages.cyclic.block, &stages.cyclic.of_together, &stages.cyclic.shared, &stages.extra.columns,
                       &stages.spikes.columns, &stages.spikes.filters, fitted.slow_variance_um2});
  const Eigen::VectorXd z_data = maps.z().transpose() * of.deviation_um;
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(p, p);
  const GainMap whole = maps.of(maps.all(), nothing);
  const GainMap everything = maps.joined(whole, maps.all(), whole);
  const Eigen::VectorXd left = of.deviation_um - fitted.columns.values * (everything.t * z_data);
  const Eigen::MatrixXd scatter = scatter_of(excess_of(of, left).asDiagonal() * maps.z(), of, fitted.noise);
  const auto covariance = [&](const GainMap& map) -> Eigen::MatrixXd { return map.t * scatter * map.t.transpose(); };

  const GainMap extra{whole.t.bottomRows(e), whole.open.bottomRightCorner(e, e)};
  choose(stages.extra.effects, extra.t * z_data, covariance(extra) + extra.open, 0);
  Indices chosen = range_of(0, p);
  for (const FittedEffect& effect : stages.extra.effects) {
    if (!effect.in_the_fit) continue;
    for (const Eigen::Index k : columns_of(effect, p)) chosen.push_back(k);
  }
  const GainMap map = maps.joined(whole, chosen, maps.of(chosen, nothing));
  fitted.gains = map.t * z_data;
  fitted.covariance = covariance(map) + map.open;
  fitted.map = map.t;
  fitted.weighted = maps.z();
  fitted.normal = maps.normal();
  choose(stages.spikes.effects, fitted.gains, fitted.covariance, p + c + e);
  fitted.effects.clear();
  append(fitted.effects, stages.extra.effects, p + c);
  append(fitted.effects, stages.spikes.effects, p + c + e);
  append(fitted.effects, stages.together.effects, 0);
  append(fitted.effects, stages.cyclic.part.effects, p);
  for (PriorStatement& statement : fitted.prior) {
    statement.alone = statement.coefficients.dot(fitted.gains.head(p));
    statement.alone_sigma =
        std::sqrt(statement.coefficients.dot(fitted.covariance.topLeftCorner(p, p) * statement.coefficients));
  }
  fitted.curve_gains = fitted.gains;
  fitted.groups = groups_in(stages, maps, whole, chosen, z_data, covariance, damping);
  if (damping == nullptr) return;
  const GainMap damped = maps.joined(whole, chosen, maps.of(chosen, *damping));
  const Eigen::VectorXd gains = damped.t * z_data;
  const Eigen::MatrixXd spread = covariance(damped);
  fitted.curve_gains = gains;
  fitted.map = damped.t;
  for (FittedEffect& effect : fitted.effects) {
    const Indices own = columns_of(effect, 0);
    effect.p_damped = p_of(gains(own), spread(own, own));
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

Eigen::VectorXd JointErrorFit::fine_curve(const Effect* effect) const {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(columns.fine.rows());
  for (std::size_t k = 0; k < columns.columns.size(); ++k) {
    if (columns.columns[k].effect != effect) continue;
    const auto column = static_cast<Eigen::Index>(k);
    curve += curve_gains[column] * columns.fine.col(column);
  }
  return curve;
}

std::vector<bool> JointErrorFit::in_the_fit() const {
  std::vector<bool> in(columns.columns.size(), true);
  for (const FittedEffect& effect : effects) {
    for (const std::size_t k : effect.columns) in[k] = effect.in_the_fit;
  }
  return in;
}

Eigen::VectorXd JointErrorFit::residual() const {
  Eigen::VectorXd left = rows.deviation_um;
  const std::vector<bool> in = in_the_fit();
  for (std::size_t k = 0; k < in.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (in[k]) left -= curve_gains[column] * columns.values.col(column);
  }
  return left;
}

double JointErrorFit::rms_um(const Eigen::VectorXd& left) const {
  return std::sqrt(within_um2 + left.cwiseAbs2().dot(rows.count) / rows.count.sum());
}

JointErrorFit joint_error_fit(ErrorRows rows, const MachineErrorOptions& options, const ErrorSetUp& set_up) {
  JointErrorFit fitted;
  fitted.arc_rad = set_up.arc_rad;
  fitted.rows = std::move(rows);
  const ErrorRows& of = fitted.rows;
  const Eigen::VectorXd measured = of.deviation_um;
  const ErrorColumns circle = circle_columns(of);
  free_of_second_order(fitted, circle, set_up.length_mm, set_up.height_mm);
  const bool is_full = set_up.arc_rad >= kFullTurn_rad;
  const std::vector<const Effect*> jointly = effects_fitted(ErrorFit::together);
  const std::vector<const Effect*> along_the_travel = effects_fitted(ErrorFit::along_the_travel);
  const std::vector<const Effect*> at_reversals = effects_fitted(ErrorFit::at_reversals);
  std::vector<const Effect*> where_they_show = effects_fitted(ErrorFit::where_it_shows);
  if (!is_full) {
    for (const Effect* effect : where_they_show) {
      fitted.undetermined.push_back(effect->name + ", for which a full turn is needed");
    }
    where_they_show.clear();
  }
  Stages stages{together_part(circle, jointly, of), {}, {}, {}, {}};
  const Eigen::MatrixXd& columns = stages.together.columns.values;
  const std::vector<PriorStatement> prior = prior_of(
      stages.together.columns, of.count.sum() / static_cast<double>(of.recordings), set_up.arc_rad, set_up.middle_rad);
  const Eigen::MatrixXd usual = precision_of(prior, columns.cols());
  fitted.prior = prior;
  const Eigen::MatrixXd* const damping = is_full || !options.prior ? nullptr : &usual;

  // The first fit without the reversals, and the cyclic errors on what it leaves.
  const Eigen::VectorXd far =
      of.count.cwiseProduct((of.from_reversal_deg.array() > kAtReversal_deg).cast<double>().matrix());
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
  stages.first = block_of(columns, far, nothing);
  const Eigen::VectorXd first_left = of.deviation_um - columns * stages.first.solve(of.deviation_um);
  stages.cyclic = cyclic_part(along_the_travel, of, set_up, columns, stages.first, first_left);

  // As the instrument: with its prior, and the cyclic errors taken off first.
  const Block damped{stages.first.weighted, inverse_of(stages.first.normal, usual)};
  const Block damped_waves{stages.cyclic.block.weighted, cyclic_inverse(stages.cyclic, damped.inverse).inverse};
  const Eigen::VectorXd waves = damped_waves.solve(measured - columns * damped.solve(measured));
  const Eigen::VectorXd gains = damped.solve(measured - stages.cyclic.part.columns.values * waves);

  const Eigen::VectorXd left = first_fit(stages, stages.first, of).left;
  stages.extra = extra_part(where_they_show, of, {&columns, &stages.first}, left, far);
  Eigen::MatrixXd smooth(of.size(), columns.cols() + waves.size() + stages.extra.columns.size());
  smooth.leftCols(columns.cols()) = columns;
  smooth.middleCols(columns.cols(), waves.size()) = stages.cyclic.part.columns.values;
  smooth.rightCols(stages.extra.columns.size()) = stages.extra.columns.values;
  // For what CCW and CW have together and what they differ by, which stand first, the circles of each: the noise is
  // then fitted with what each recording has of its own.
  for (Eigen::Index k = 0; differ(stages.together.columns) && k < 3; ++k) {
    const Eigen::VectorXd half = 0.5 * smooth.col(k), shift = smooth.col(k + 3);
    smooth.col(k) = half + shift;
    smooth.col(k + 3) = half - shift;
  }
  const QuietRows quiet = quiet_rows(of, smooth);
  fitted.noise = error_noise(quiet.rows, quiet.columns);
  fitted.slow_variance_um2 = slow_variance_um2(of, fitted.noise);
  fitted.at_once = stages.together.columns.fine;
  const std::vector<const Effect*> explained =
      fit_step_widths(stages, damping == nullptr ? stages.first : damped, of, at_reversals, fitted.noise.front().noise);
  const auto fit_spikes = [&] {
    stages.spikes = spikes_in(at_reversals, of, first_fit(stages, stages.first, of).left, fitted.noise.front().noise);
    for (FittedEffect& one : stages.spikes.effects)
      one.is_needed = std::find(explained.begin(), explained.end(), one.effect) == explained.end();
  };
  fit_spikes();
  const auto errors = static_cast<double>(jointly.size() + along_the_travel.size() + where_they_show.size());
  for (Part* part : {&stages.together, &stages.cyclic.part, &stages.extra}) {
    for (FittedEffect& effect : part->effects) effect.looked_at = errors;
  }
  fit_all(fitted, stages, far, damping);

  // Where a spike shows, the readings under it tell nothing of the others.
  Eigen::VectorXd beyond = far;
  for (const FittedEffect& effect : stages.spikes.effects) {
    const double reach_deg = std::min(kNearReversal_deg, kWidthsOfSpike * effect.shape.value_or(0.0));
    for (Eigen::Index i = 0; effect.in_the_fit && i < of.size(); ++i) {
      if (since_reversal_deg(of, i, effect.effect->rules.reversal_deg) <= reach_deg) beyond[i] = 0.0;
    }
  }
  if (beyond != far) {
    refit(stages, beyond, nothing);
    fit_spikes();
    fit_all(fitted, stages, beyond, damping);
  }
  std::vector<ErrorColumn> names = stages.together.columns.columns;
  names.insert(names.end(), stages.extra.columns.columns.begin(), stages.extra.columns.columns.end());
  std::vector<std::string> phrases = undetermined(fitted.normal, names);
  if (stages.cyclic.undetermined.cols() > 0) {
    phrases.push_back(
        undetermined_names(stages.cyclic.undetermined.rowwise().norm(), stages.cyclic.part.columns.columns));
  }
  fitted.undetermined.insert(fitted.undetermined.begin(), phrases.begin(), phrases.end());
  fitted.as_instrument = Eigen::VectorXd::Constant(fitted.gains.size(), kUnknown);
  fitted.as_instrument.head(gains.size()) = gains;
  fitted.as_instrument.segment(gains.size(), waves.size()) = waves;
  add_spikes_as_instrument(fitted, options.cyclic_of_runs);
  return fitted;
}

}  // namespace ballbar
