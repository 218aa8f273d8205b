#include "diagnosis/verdict/candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/revision/trial.hpp"
#include "diagnosis/statistics/confirmation.hpp"
#include "diagnosis/statistics/held_out.hpp"
#include "diagnosis/surrogates/fakes.hpp"
#include "diagnosis/surrogates/trace_fakes.hpp"
#include "noise/whitened.hpp"
#include "series/cycles.hpp"

namespace ballbar {
namespace {

constexpr double kChance = 0.01;
constexpr double kHeldOutWorse = 1.05;  // of the RMSE, which a slow noise makes up by itself: not clearly more
constexpr double kInOneCycle = 0.9;     // share of what it shows
constexpr double kSameCurve = 2.0;      // chi^2 of the difference of two curves
constexpr double kSameShare = 0.01;     // of a curve's chi^2
constexpr std::size_t kFakedShapes = 8;

// The shape as fitted, and some of the grid.
TracedEffect traced(const Hypotheses& now, const Refitted& with, std::size_t place) {
  const Family& family = now.family(with.set[place]);
  const std::size_t term = now.model().terms.size() + place;
  TracedEffect result{family.effect, family.columns, {{}}, {}};
  const std::size_t first = first_parameter(with.model, term);
  for (std::size_t k = 0; k < family.effect->parameters.size(); ++k) {
    result.points.front().push_back(with.fit.parameters[first + k].value);
  }
  const std::size_t stride = 1 + (family.count - 1) / kFakedShapes;
  for (std::size_t i = family.first; family.count > 1 && i < family.first + family.count; i += stride) {
    result.points.push_back(now.at(i).point);
  }
  const std::vector<double>& added = with.fit.contribution_um[term];
  result.added_um = Eigen::VectorXd::Map(added.data(), static_cast<Eigen::Index>(added.size()));
  return result;
}

}  // namespace

double rmse_after_um(const Hypotheses& now, const Refitted& with) {
  if (now.model().level == Level::series) return with.fit.rmse_um;
  const Eigen::MatrixXd basis = orthonormal(with.leftover.model);
  const Eigen::VectorXd& r = with.leftover.residual_um;
  return (r - basis * (basis.transpose() * r)).norm() / std::sqrt(static_cast<double>(r.size()));
}

Candidate candidate_of(const Hypotheses& now, const Refitted& with, std::size_t place) {
  Candidate candidate;
  candidate.bound = now.bound(with.set[place]);
  const std::size_t term = now.model().terms.size() + place;
  const std::size_t first = first_parameter(with.model, term);
  const std::vector<Parameter>& parameters = candidate.bound.effect->parameters;
  double relative = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    const FittedParameter& fitted = with.fit.parameters[first + k];
    candidate.parameters.push_back(fitted);
    if (parameters[k].kind == ParameterKind::gain && fitted.value != 0.0) {
      const double one = std::abs(fitted.sigma / fitted.value);
      relative = std::isfinite(relative) ? std::min(relative, one) : one;
    }
  }
  const auto [low, high] =
      std::minmax_element(with.fit.contribution_um[term].begin(), with.fit.contribution_um[term].end());
  candidate.amplitude_um = *high - *low;
  candidate.amplitude_sigma_um = relative * candidate.amplitude_um;
  candidate.rmse_after_um = rmse_after_um(now, with);
  return candidate;
}

Confirmed confirmed(const Hypotheses& now, const Series& data, const Refitted& with, std::size_t place,
                    const SearchNull& null, const std::vector<std::size_t>& cycle, const DiagnosisOptions& options) {
  Confirmed result{candidate_of(now, with, place), 0.0, {}, false};
  Candidate& candidate = result.candidate;
  candidate.in_best_set = true;
  const Refitted without = now.without(with, place);
  const Effect& effect = *candidate.bound.effect;
  candidate.evidence = 2.0 * (with.log_likelihood - without.log_likelihood);
  candidate.threshold = null.threshold(effect);
  candidate.p_search = null.p_search(effect, candidate.evidence);
  const bool of_recordings = now.model().level == Level::recording;
  const Eigen::MatrixXd gains = gain_columns(with.fit, with.model, now.model().terms.size() + place);
  const std::vector<std::size_t> told = cycles_that_tell(data, with.fit.row, cycle, gains);
  const HeldOut before = held_out(without.leftover, with.noise, told, of_recordings);
  const HeldOut after = held_out(with.leftover, with.noise, told, of_recordings);
  candidate.held_out_before_um = before.rmse_um;
  candidate.held_out_after_um = after.rmse_um;
  candidate.p_same_gain = p_same_gain(with.leftover, gains, with.noise, told);
  if (!effect.time_only) {
    now.tell(fmt::format("testing {} fakes of {}", options.fakes, label_of(candidate.bound)));
    const std::optional<BestFake> fake =
        of_recordings ? best_trace_fake(traced(now, with, place), data, with.fit.row, without.leftover, with.noise,
                                        options.fakes, options.seed)
                      : best_fake(now.family(with.set[place]), now.bank(), data, without.leftover, with.noise,
                                  options.fakes, options.seed);
    if (fake) {
      candidate.best_fake_gain = fake->gain;
      candidate.beats_fakes = chi2(without.leftover, with.noise) - chi2(with.leftover, with.noise) > fake->gain;
      result.best_fake_fall = fake->fall;
    }
  }
  const auto fails = [&](const std::string& why) { result.why_not.push_back(label_of(candidate.bound) + ": " + why); };
  if (effect.time_only) {
    fails("it needs nothing but time, so that one run cannot name it as a cause.");
    return result;
  }
  if (candidate.evidence < kFewestEvidence) fails("its evidence is below 25 (d = 5).");
  if (null.p_search(effect, gain_of_many(without.leftover, gains, with.noise)) >= kChance) {
    fails("a few readings alone make it.");
  }
  if (candidate.p_search >= kChance) fails("a search without any effect shows as much too often.");
  if (candidate.p_same_gain < kSameGain) {
    fails(of_recordings ? "its gain differs from recording to recording." : "its gain differs from cycle to cycle.");
  }
  if (!of_recordings && share_of_one_cycle(without.leftover, gains, with.noise, told) > kInOneCycle) {
    fails("it shows in one cycle alone, so that no other can confirm it.");
  }
  if (!(after.chi2 < before.chi2) || after.rmse_um > kHeldOutWorse * before.rmse_um) {
    fails(of_recordings ? "recordings left out are not predicted better."
                        : "cycles left out are not predicted better.");
  }
  for (const FittedParameter& parameter : candidate.parameters) {
    const bool on_bound =
        parameter.state == ParameterState::on_lower_bound || parameter.state == ParameterState::on_upper_bound;
    if (!on_bound) continue;
    result.at_the_edge = true;
    fails(fmt::format("its {} lies on its bound, {:g} {}.", parameter.name, parameter.value, parameter.unit));
  }
  if (candidate.beats_fakes && !*candidate.beats_fakes) fails("a fake of the same smoothness does as well.");
  return result;
}

bool becomes(const BoundEffect& rich, const BoundEffect& plain) {
  return rich.effect->rules.becomes == plain.effect->name &&
         std::all_of(plain.columns.begin(), plain.columns.end(), [&](const std::string& name) {
           return std::find(rich.columns.begin(), rich.columns.end(), name) != rich.columns.end();
         });
}

namespace {

// A shape lies on its lower bound: a lag of 10 s where the plain effect has none.
bool is_at_its_least(const Hypotheses& now, const Refitted& with, std::size_t place) {
  const std::size_t term = now.model().terms.size() + place;
  const std::size_t first = first_parameter(with.model, term), count = with.model.terms[term].settings.size();
  return std::any_of(with.fit.parameters.begin() + static_cast<std::ptrdiff_t>(first),
                     with.fit.parameters.begin() + static_cast<std::ptrdiff_t>(first + count),
                     [](const FittedParameter& one) {
                       return one.kind == ParameterKind::shape && one.state == ParameterState::on_lower_bound;
                     });
}

}  // namespace

bool draws_the_same(const Hypotheses& now, const Refitted& plain, std::size_t m, const Refitted& rich, std::size_t k) {
  const BoundEffect a = now.bound(plain.set[m]), b = now.bound(rich.set[k]);
  if (!becomes(b, a)) return false;
  const Whitening whitening(plain.noise, plain.leftover.time_s, plain.leftover.sigma_um);
  const auto curve = [&](const Refitted& of, std::size_t place) -> Eigen::VectorXd {
    const std::vector<double>& um = of.fit.contribution_um[now.model().terms.size() + place];
    return whitened(whitening, Eigen::Map<const Eigen::VectorXd>(um.data(), static_cast<Eigen::Index>(um.size())));
  };
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, now.leftover().model));
  const auto freed = [&](const Eigen::VectorXd& all) -> Eigen::VectorXd {
    return all - basis * (basis.transpose() * all);
  };
  const Eigen::VectorXd one = freed(curve(plain, m)), other = freed(curve(rich, k));
  const double square = other.squaredNorm();
  if (!(square > 0.0)) return false;
  const double apart = (one - one.dot(other) / square * other).squaredNorm();
  return apart < kSameCurve || (is_at_its_least(now, rich, k) && apart < kSameShare * one.squaredNorm());
}

bool redrawn(const Hypotheses& now, const Refitted& plain, const Refitted& rich) {
  if (plain.set.size() != rich.set.size()) return false;
  std::vector<std::size_t> own, others;  // places of what the other has not
  for (std::size_t m = 0; m < rich.set.size(); ++m) {
    if (!has(now, plain.set, now.bound(rich.set[m]))) own.push_back(m);
    if (!has(now, rich.set, now.bound(plain.set[m]))) others.push_back(m);
  }
  return own.size() == 1 && others.size() == 1 && draws_the_same(now, plain, others.front(), rich, own.front());
}

namespace {

// The rest of the set is open as well: it does without.
bool is_spare(const Hypotheses& now, const Refitted& rival, std::size_t place, const Refitted& best,
              const std::vector<const Refitted*>& rivals) {
  const auto is_rest = [&](const Refitted& other) { return is_without(now, other.set, rival.set, place); };
  return is_rest(best) ||
         std::any_of(rivals.begin(), rivals.end(), [&](const Refitted* other) { return is_rest(*other); });
}

}  // namespace

std::vector<std::vector<BoundEffect>> groups_of(const Hypotheses& now, const Projected& seen, const Refitted& best,
                                                const std::vector<const Refitted*>& rivals) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const std::size_t index : best.set) groups.push_back({now.bound(index)});
  for (const Refitted* rival : rivals) {
    for (std::size_t k = 0; k < rival->set.size(); ++k) {
      const std::size_t extra = rival->set[k];
      if (has(now, best.set, now.bound(extra))) continue;
      bool same = false;
      for (std::size_t m = 0; m < best.set.size(); ++m) same = same || draws_the_same(now, best, m, *rival, k);
      if (same || is_spare(now, *rival, k, best, rivals)) continue;
      // In the place of the one it is most like.
      double most = -1.0;
      std::size_t place = groups.size();
      for (std::size_t m = 0; m < best.set.size(); ++m) {
        if (has(now, rival->set, now.bound(best.set[m]))) continue;
        const double alike =
            std::abs(seen.columns.col(now.at(best.set[m]).first).dot(seen.columns.col(now.at(extra).first)));
        if (alike > most) {
          most = alike;
          place = m;
        }
      }
      if (place == groups.size()) continue;
      std::vector<BoundEffect>& group = groups[place];
      if (std::find(group.begin(), group.end(), now.bound(extra)) == group.end()) group.push_back(now.bound(extra));
    }
  }
  return groups;
}

}  // namespace ballbar
