#include "diagnosis/posterior/ascent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "ballbar/numerics/parallel.hpp"
#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kRises = 0.01;         // of the bound: less is no rise
constexpr double kSameScatter = 0.005;  // ln of its variance
constexpr double kSettled = 0.1;        // the same: the line is taken off anew
constexpr int kMostSweeps = 40;
constexpr double kHardlyThere = 0.2;    // P of a further single effect beside the others as they are
constexpr double kNegligible = 1e-5;    // P of a shape that adds nothing to the mean
constexpr std::size_t kRivals = 6;      // of a single effect, that are put in its place
constexpr double kLeastRival = 1e-3;    // P of one
constexpr std::size_t kMostRounds = 3;  // of such changes

// ln of the ratio of evidence of one shape against none, and the posterior of its gains where it is that shape.
struct OfShape {
  double log_ratio = kLogZero;
  double along = 0.0, square = 0.0;  // mean of r' b and of |X b|^2
};

OfShape of_column(double r, double left) {
  OfShape result;
  if (!(left > 0.0)) return result;
  static const std::array<double, kGainSizes.size()> log_widths = [] {
    std::array<double, kGainSizes.size()> all;
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = std::log1p(kGainSizes[k] * kGainSizes[k]);
    return all;
  }();
  const double z2 = r * r / left;
  std::array<double, kGainSizes.size()> weight;
  double most = kLogZero;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k];
    weight[k] = 0.5 * (z2 * g / (1.0 + g) - log_widths[k]);
    most = std::max(most, weight[k]);
  }
  double sum = 0.0, along = 0.0, square = 0.0;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k], shrink = g / (1.0 + g), w = std::exp(weight[k] - most);
    sum += w;
    along += w * shrink * z2;
    square += w * (shrink * shrink * z2 + shrink);
  }
  result.log_ratio = most + std::log(sum / static_cast<double>(kGainSizes.size()));
  result.along = along / sum;
  result.square = square / sum;
  return result;
}

struct OfBlock {
  OfShape of_shape;
  Eigen::VectorXd mean;  // coefficients
};

OfBlock of_block(const BlockProduct& block, const Eigen::VectorXd& r, double variance) {
  const double sigma = std::sqrt(variance);
  const auto w = static_cast<double>(block.values.size());
  const Eigen::VectorXd turned = block.vectors.transpose() * (r.cwiseQuotient(block.length) / sigma);
  std::array<double, kGainSizes.size()> weight;
  double most = kLogZero;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k] / w;
    const Eigen::ArrayXd v = g * block.values.array();
    weight[k] = 0.5 * ((turned.array().square() * g / (1.0 + v)).sum() - v.log1p().sum());
    most = std::max(most, weight[k]);
  }
  double sum = 0.0;
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(turned.size());
  double square = 0.0;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k] / w, p = std::exp(weight[k] - most);
    const Eigen::ArrayXd shrink = g / (1.0 + g * block.values.array());
    sum += p;
    mean += p * shrink * turned.array();
    square += p * (block.values.array() * ((shrink * turned.array()).square() + shrink)).sum();
  }
  mean /= sum;
  OfBlock result;
  result.of_shape.log_ratio = most + std::log(sum / static_cast<double>(kGainSizes.size()));
  result.of_shape.along = (mean * turned.array()).sum();
  result.of_shape.square = square / sum;
  result.mean = (block.vectors * mean.matrix()).cwiseQuotient(block.length) * sigma;
  return result;
}

// Fits one single effect to r = X' (what the others leave).
SingleEffect fitted_to(const ColumnsAt& at, const Identities& identities, const SinglePrior& prior,
                       const Eigen::VectorXd& r, double variance) {
  const std::size_t shapes = identities.shapes.size();
  std::vector<OfShape> of(shapes);
  std::vector<double> weight(shapes, kLogZero);
  std::vector<OfBlock> of_blocks(at.blocks.size());
  std::size_t b = 0;
  double most = prior.log_none;
  for (std::size_t s = 0; s < shapes; ++s) {
    const Shape& shape = identities.shapes[s];
    const double log_prior = prior.log_identity[shape.identity] + shape.log_prior;
    const bool is_block = shape.width > 1;
    const std::size_t place = is_block ? b++ : 0;
    if (log_prior == kLogZero || !(at.left.segment(shape.first, shape.width).maxCoeff() > 0.0)) continue;
    if (is_block) {
      of_blocks[place] = of_block(at.blocks[place], r.segment(shape.first, shape.width), variance);
      of[s] = of_blocks[place].of_shape;
    } else {
      of[s] = of_column(r[shape.first] / std::sqrt(variance), at.left[shape.first]);
    }
    weight[s] = log_prior + of[s].log_ratio;
    most = std::max(most, weight[s]);
  }
  SingleEffect result;
  result.p.assign(identities.log_prior.size(), 0.0);
  result.likeliest.assign(identities.log_prior.size(), kNoSignature);
  result.strength.assign(identities.log_prior.size(), kLogZero);
  if (most == kLogZero) {  // nothing may be, and nothing is left of what must be
    result.log_weight = kLogZero;
    result.curve = at.curve_of({});
    return result;
  }
  double any = 0.0;
  for (std::size_t s = 0; s < shapes; ++s) {
    if (weight[s] != kLogZero) any += std::exp(weight[s] - most);
  }
  const double none = prior.log_none == kLogZero ? 0.0 : std::exp(prior.log_none - most), total = any + none;
  result.log_weight = std::log(any) - std::log(none);
  double expected = 0.0;
  b = 0;
  for (std::size_t s = 0; s < shapes; ++s) {
    const Shape& shape = identities.shapes[s];
    const std::size_t place = shape.width > 1 ? b++ : 0;
    if (weight[s] == kLogZero) continue;
    const double p = std::exp(weight[s] - most) / total;
    result.p[shape.identity] += p;
    std::size_t& likeliest = result.likeliest[shape.identity];
    if (likeliest == kNoSignature || weight[s] > weight[likeliest]) likeliest = s;
    result.strength[shape.identity] = weight[likeliest];
    if (p < kNegligible) continue;
    expected += p * (of[s].along - 0.5 * of[s].square);
    result.spread += p * of[s].square;
    if (shape.width > 1) {
      for (Eigen::Index k = 0; k < shape.width; ++k)
        result.mean.emplace_back(shape.first + k, p * of_blocks[place].mean[k]);
    } else if (r[shape.first] != 0.0) {
      result.mean.emplace_back(shape.first, p * of[s].along * variance / r[shape.first]);
    }
  }
  result.divergence = expected - (most + std::log(total));
  result.curve = at.curve_of(result.mean);
  return result;
}

// Of all but one of them; of all where `without` is none of them.
ColumnsAt::Curve sum_of(const std::vector<SingleEffect>& effects, const ColumnsAt& at, std::size_t without) {
  ColumnsAt::Curve sum = at.curve_of({});
  for (std::size_t l = 0; l < effects.size(); ++l) {
    if (l == without) continue;
    sum.white += effects[l].curve.white;
    sum.line += effects[l].curve.line;
  }
  return sum;
}

double along_of(const SingleEffect& effect, const ColumnsAt& at) {
  double sum = 0.0;
  for (const auto& [column, coefficient] : effect.mean) sum += coefficient * at.along[column];
  return sum;
}

// Expected square of what is left of the readings.
double square_left(const std::vector<SingleEffect>& effects, const ColumnsAt& at, double variance) {
  const ColumnsAt::Curve all = sum_of(effects, at, effects.size());
  double result = at.square + at.product(all, all);
  for (const SingleEffect& one : effects)
    result += variance * one.spread - at.product(one.curve, one.curve) - 2.0 * along_of(one, at);
  return std::max(result, 1e-12 * at.square + 1e-300);
}

double bound_of(const Ascent& ascent, const ColumnsAt& at, const KnownScatter& known) {
  double bound =
      at.constant - 0.5 * (at.degrees + known.readings) * std::log(ascent.variance) -
      0.5 * (square_left(ascent.effects, at, ascent.variance) + known.readings * known.variance) / ascent.variance;
  for (const SingleEffect& one : ascent.effects) bound -= one.divergence;
  return bound;
}

const SinglePrior& prior_of(const AscentOptions& options, std::size_t l) {
  return options.priors[std::min(l, options.priors.size() - 1)];
}

void fit_again(ColumnsAt& at, const Identities& identities, const SinglePrior& prior, Ascent& ascent, std::size_t l) {
  Eigen::VectorXd r = at.along;
  if (ascent.effects.size() > 1) r -= at.products(sum_of(ascent.effects, at, l));
  ascent.effects[l] = fitted_to(at, identities, prior, r, ascent.variance);
}

// Variance of the scatter by what the single effects leave.
double scatter_of(const ColumnsAt& at, const AscentOptions& options, const Ascent& ascent) {
  const KnownScatter& known = options.known;
  const double left = square_left(ascent.effects, at, ascent.variance) + known.readings * known.variance;
  return std::max(left / (at.degrees + known.readings), options.least_variance);
}

void settle(ColumnsAt& at, Ascent& ascent, double variance) {
  ascent.variance = variance;
  at.settle(variance);
  for (SingleEffect& one : ascent.effects) one.curve = at.curve_of(one.mean);
}

void sweep(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent& ascent) {
  for (std::size_t l = 0; l < ascent.effects.size(); ++l) fit_again(at, identities, prior_of(options, l), ascent, l);
}

// Sweeps until the bound rises no more, the scatter with it. What is known of the line is about nearly the same
// scatter.
void converge(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent& ascent) {
  const KnownScatter& known = options.known;
  double last = kLogZero;
  for (int n = 0; n < kMostSweeps; ++n) {
    sweep(at, identities, options, ascent);
    const double next = scatter_of(at, options, ascent);
    const bool same = std::abs(std::log(next / ascent.variance)) < kSameScatter;
    ascent.variance = next;
    if (std::abs(std::log(next / at.settled)) > kSettled) {
      settle(at, ascent, next);
      last = kLogZero;
      continue;
    }
    ascent.bound = bound_of(ascent, at, known);
    if (same && ascent.bound - last < kRises) break;
    last = ascent.bound;
  }
}

}  // namespace

double SingleEffect::p_none() const { return 1.0 / (1.0 + std::exp(log_weight)); }

double SingleEffect::p_any() const { return std::accumulate(p.begin(), p.end(), 0.0); }

Ascent ascended(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent start) {
  Ascent ascent = std::move(start);
  if (!(ascent.variance > 0.0)) {
    ascent.variance =
        (at.square + options.known.readings * options.known.variance) / (at.degrees + options.known.readings);
  }
  settle(at, ascent, std::max(ascent.variance, options.least_variance));
  while (ascent.effects.size() < options.least) {
    ascent.effects.emplace_back();
    ascent.effects.back().curve = at.curve_of({});
  }
  converge(at, identities, options, ascent);
  while (ascent.effects.size() < options.largest) {
    if (ascent.effects.size() > options.least && ascent.effects.back().p_any() < 0.5) break;
    ascent.effects.emplace_back();
    ascent.effects.back().curve = at.curve_of({});
    fit_again(at, identities, prior_of(options, ascent.effects.size() - 1), ascent, ascent.effects.size() - 1);
    if (ascent.effects.size() > options.least && ascent.effects.back().p_any() < kHardlyThere) break;
    converge(at, identities, options, ascent);
  }
  settle(at, ascent, ascent.variance);
  sweep(at, identities, options, ascent);
  ascent.bound = bound_of(ascent, at, options.known);
  return ascent;
}

namespace {

// From where one single effect is an identity and the others follow it.
Ascent ascended_with(ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent start,
                     std::size_t l, std::size_t identity) {
  settle(at, start, start.variance);
  SinglePrior alone = prior_of(options, l);
  const double log_prior = alone.log_identity[identity];
  alone.log_identity.assign(alone.log_identity.size(), kLogZero);
  alone.log_identity[identity] = log_prior;
  alone.log_none = kLogZero;
  fit_again(at, identities, alone, start, l);
  for (std::size_t j = 0; j < start.effects.size(); ++j) {
    if (j != l) fit_again(at, identities, prior_of(options, j), start, j);
  }
  start.variance = scatter_of(at, options, start);  // that of the forced effect, else the next sweep undoes it
  return ascended(at, identities, options, std::move(start));
}

// The strongest identities of a single effect that it is not.
std::vector<std::size_t> rivals_of(const SingleEffect& effect) {
  std::vector<std::size_t> rivals(effect.p.size());
  std::iota(rivals.begin(), rivals.end(), std::size_t{0});
  std::stable_sort(rivals.begin(), rivals.end(),
                   [&](std::size_t a, std::size_t b) { return effect.p[a] > effect.p[b]; });
  rivals.resize(std::min(kRivals, rivals.size()));
  std::erase_if(rivals, [&](std::size_t i) { return !(effect.p[i] > kLeastRival); });
  const bool is_there = effect.p_any() >= 0.5;
  if (is_there && !rivals.empty()) rivals.erase(rivals.begin());
  return rivals;
}

}  // namespace

Ascent rearranged(const ColumnsAt& at, const Identities& identities, const AscentOptions& options, Ascent best) {
  for (std::size_t round = 0; round < kMostRounds; ++round) {
    bool better = false;
    for (std::size_t l = 0; l < best.effects.size(); ++l) {
      const std::vector<std::size_t> rivals = rivals_of(best.effects[l]);
      std::vector<Ascent> others(rivals.size());
      in_parallel(rivals.size(), [&](std::size_t k) {
        ColumnsAt there = at;
        others[k] = ascended_with(there, identities, options, best, l, rivals[k]);
      });
      const auto first = std::find_if(others.begin(), others.end(),
                                      [&](const Ascent& other) { return other.bound > best.bound + 10.0 * kRises; });
      if (first == others.end()) continue;
      best = std::move(*first);
      better = true;
    }
    if (!better) break;
  }
  return best;
}

}  // namespace ballbar
