#include "diagnosis/posterior/ascent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "diagnosis/evidence/evidence.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kRises = 0.01;         // smallest rise of the bound
constexpr double kSameScatter = 0.005;  // ln of its variance
constexpr double kSettled = 0.1;        // likewise: repeat the projection of the line
constexpr int kMostSweeps = 40;
constexpr double kHardlyThere = 0.2;       // P of a further single effect with the others fixed
constexpr double kNegligible = 1e-5;       // P of a shape that is left out of the mean
constexpr double kLeftOut = 1e-12;         // P of an identity of a single effect that later sweeps leave out
constexpr double kNoticed = 1e-4;          // total P of the left-out identities, from which all are evaluated again
constexpr int kMostChecks = 3;             // at all
constexpr double kNothingToDouble = 40.0;  // ln: a weight so far below another one is negligible

// ln of the evidence ratio of one shape against none, and the posterior of its gains given that shape.
struct ShapeEvidence {
  double log_ratio = kLogZero;
  double along = 0.0, square = 0.0;  // mean of r' b and of |X b|^2
};

// ln of the weights of the gains of a column.
struct GainWeights {
  double z2 = 0.0, most = kLogZero;
  std::array<double, kGainSizes.size()> weight;
};

struct GainSize {
  double shrink = 0.0, half_log_width = 0.0;
};

const std::array<GainSize, kGainSizes.size()> kGains = [] {
  std::array<GainSize, kGainSizes.size()> all;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k];
    all[k] = {g / (1.0 + g), 0.5 * std::log1p(g)};
  }
  return all;
}();

// r' x with a column over the root of the scatter's variance, and |x|^2.
GainWeights gains_of_column(double r, double left) {
  GainWeights result;
  result.z2 = r * r / left;
  for (std::size_t k = 0; k < kGains.size(); ++k) {
    result.weight[k] = 0.5 * result.z2 * kGains[k].shrink - kGains[k].half_log_width;
    result.most = std::max(result.most, result.weight[k]);
  }
  return result;
}

ShapeEvidence of_column(const GainWeights& gains) {
  ShapeEvidence result;
  double sum = 0.0, along = 0.0, square = 0.0;
  for (std::size_t k = 0; k < kGains.size(); ++k) {
    if (gains.weight[k] < gains.most - kNothingToDouble) continue;
    const double shrink = kGains[k].shrink, w = std::exp(gains.weight[k] - gains.most);
    sum += w;
    along += w * shrink * gains.z2;
    square += w * (shrink * shrink * gains.z2 + shrink);
  }
  result.log_ratio = gains.most + std::log(sum / static_cast<double>(kGains.size()));
  result.along = along / sum;
  result.square = square / sum;
  return result;
}

struct BlockEvidence {
  ShapeEvidence of_shape;
  Eigen::VectorXd mean;  // coefficients
};

BlockEvidence of_block(const BlockProduct& block, const Eigen::VectorXd& r, double variance) {
  const double sigma = std::sqrt(variance);
  const auto w = static_cast<double>(block.values.size());
  const Eigen::VectorXd turned = block.vectors.transpose() * (r.cwiseQuotient(block.length) / sigma);
  std::array<double, kGainSizes.size()> weight;
  double most = kLogZero;
  for (std::size_t k = 0; k < kGainSizes.size(); ++k) {
    const double g = kGainSizes[k] * kGainSizes[k] / w;
    const auto v = g * block.values.array();
    weight[k] = 0.5 * (turned.array().square() * g / (1.0 + v)).sum() - block.half_log_width[k];
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
  BlockEvidence result;
  result.of_shape.log_ratio = most + std::log(sum / static_cast<double>(kGainSizes.size()));
  result.of_shape.along = (mean * turned.array()).sum();
  result.of_shape.square = square / sum;
  result.mean = (block.vectors * mean.matrix()).cwiseQuotient(block.length) * sigma;
  return result;
}

// Some identities: their shapes, and the columns of these.
struct IdentitySubset {
  std::vector<char> identity;
  std::vector<std::size_t> shapes;
  std::vector<ColumnSpan> columns;
};

IdentitySubset chosen(const Identities& identities, const auto& is_chosen) {
  IdentitySubset result;
  const Eigen::Index c = identities.columns.cols();
  for (std::size_t i = 0; i < identities.log_prior.size(); ++i) {
    result.identity.push_back(is_chosen(i) ? 1 : 0);
    if (!result.identity.back()) continue;
    for (std::size_t s = identities.first[i]; s < identities.first[i] + identities.count[i]; ++s) {
      result.shapes.push_back(s);
      if (identities.jump == i) continue;
      const Shape& shape = identities.shapes[s];
      std::vector<ColumnSpan>& columns = result.columns;
      if (!columns.empty() && columns.back().first + columns.back().count == shape.first) {
        columns.back().count += shape.width;
      } else {
        columns.push_back({shape.first, shape.width});
      }
    }
  }
  if (identities.jump && result.identity[*identities.jump]) result.columns.push_back({c, identities.size() - c});
  return result;
}

// Fits one single effect to r = X' (residual of the others).
SingleEffect fitted_to(ColumnsAt& at, const Identities& identities, const IdentitySubset& among,
                       const SinglePrior& prior, const Eigen::VectorXd& r, double variance) {
  struct WeightedShape {
    std::size_t shape = 0;
    GainWeights gains;      // of a column
    std::size_t block = 0;  // else its place
    double log_prior = kLogZero, log_weight = kLogZero;
    ShapeEvidence of;
  };
  std::vector<WeightedShape> all;
  all.reserve(among.shapes.size());
  std::vector<BlockEvidence> of_blocks;
  const double over_sigma = 1.0 / std::sqrt(variance);
  // ln of the sum of the weights of the gains is between that of the heaviest over their number and itself.
  static const double log_gains = std::log(static_cast<double>(kGains.size()));
  std::vector<double> least_of_identity(identities.log_prior.size(), kLogZero);
  double least = prior.log_none;
  for (const std::size_t s : among.shapes) {
    const Shape& shape = identities.shapes[s];
    const double log_prior = prior.log_identity[shape.identity] + shape.log_prior;
    if (log_prior == kLogZero) continue;
    WeightedShape one{s, {}, 0, log_prior, kLogZero, {}};
    if (shape.width > 1) {
      if (!(at.left.segment(shape.first, shape.width).maxCoeff() > 0.0)) continue;
      one.block = of_blocks.size();
      of_blocks.push_back(of_block(at.block(s), r.segment(shape.first, shape.width), variance));
      one.of = of_blocks.back().of_shape;
      one.log_weight = one.log_prior + one.of.log_ratio;
      least = std::max(least, one.log_weight);
      double& of_identity = least_of_identity[shape.identity];
      of_identity = std::max(of_identity, one.log_weight);
    } else {
      if (!(at.left[shape.first] > 0.0)) continue;
      one.gains = gains_of_column(r[shape.first] * over_sigma, at.left[shape.first]);
      const double at_least = one.log_prior + one.gains.most - log_gains;
      least = std::max(least, at_least);
      double& of_identity = least_of_identity[shape.identity];
      of_identity = std::max(of_identity, at_least);
    }
    all.push_back(one);
  }
  double most = prior.log_none;
  for (WeightedShape& one : all) {
    const Shape& shape = identities.shapes[one.shape];
    if (shape.width == 1) {
      const double at_most = one.log_prior + one.gains.most;
      if (at_most < least - kNothingToDouble && at_most < least_of_identity[shape.identity]) continue;
      one.of = of_column(one.gains);
      one.log_weight = one.log_prior + one.of.log_ratio;
    }
    most = std::max(most, one.log_weight);
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
  for (const WeightedShape& one : all) {
    if (one.log_weight > most - kNothingToDouble) any += std::exp(one.log_weight - most);
  }
  const double none = prior.log_none == kLogZero ? 0.0 : std::exp(prior.log_none - most), total = any + none;
  // If none of them is near, all together are negligible against none.
  result.log_weight = std::log(any) - std::log(none);
  double expected = 0.0;
  for (const WeightedShape& one : all) {
    if (one.log_weight == kLogZero) continue;
    const Shape& shape = identities.shapes[one.shape];
    std::size_t& likeliest = result.likeliest[shape.identity];
    double& strength = result.strength[shape.identity];
    if (likeliest == kNoSignature || one.log_weight > strength) {
      likeliest = one.shape;
      strength = one.log_weight;
    }
    const double p = std::exp(one.log_weight - most) / total;
    result.p[shape.identity] += p;
    if (p < kNegligible) continue;
    expected += p * (one.of.along - 0.5 * one.of.square);
    result.spread += p * one.of.square;
    if (shape.width > 1) {
      for (Eigen::Index k = 0; k < shape.width; ++k)
        result.mean.emplace_back(shape.first + k, p * of_blocks[one.block].mean[k]);
    } else if (r[shape.first] != 0.0) {
      result.mean.emplace_back(shape.first, p * one.of.along * variance / r[shape.first]);
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

// Expected residual sum of squares of the readings.
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

void fit_again(ColumnsAt& at, const Identities& identities, const IdentitySubset& among, const SinglePrior& prior,
               Ascent& ascent, std::size_t l) {
  Eigen::VectorXd r = at.along;
  if (ascent.effects.size() > 1) r -= at.products(sum_of(ascent.effects, at, l), among.columns);
  ascent.effects[l] = fitted_to(at, identities, among, prior, r, ascent.variance);
}

// Variance of the scatter from the residual of the single effects.
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

void sweep(ColumnsAt& at, const Identities& identities, const IdentitySubset& among, const AscentOptions& options,
           Ascent& ascent) {
  for (std::size_t l = 0; l < ascent.effects.size(); ++l)
    fit_again(at, identities, among, prior_of(options, l), ascent, l);
}

// Identities that no prior of a single effect forbids.
IdentitySubset all_of(const Identities& identities, const AscentOptions& options) {
  return chosen(identities, [&](std::size_t i) {
    return std::any_of(options.priors.begin(), options.priors.end(),
                       [&](const SinglePrior& one) { return one.log_identity[i] > kLogZero; });
  });
}

// The likely identities of each single effect.
std::vector<IdentitySubset> likely_of(const Identities& identities, const Ascent& ascent) {
  std::vector<IdentitySubset> likely;
  for (const SingleEffect& one : ascent.effects)
    likely.push_back(chosen(identities, [&](std::size_t i) { return one.p[i] > kLeftOut; }));
  return likely;
}

// Sweeps until the bound rises no more, the scatter with it: the first one over all identities, the others over those
// that are likely after it, which are returned. What is known of the line is about nearly the same scatter.
std::vector<IdentitySubset> converge(ColumnsAt& at, const Identities& identities, const IdentitySubset& all,
                                     const AscentOptions& options, Ascent& ascent) {
  const KnownScatter& known = options.known;
  double last = kLogZero;
  std::vector<IdentitySubset> likely;
  for (int n = 0; n < kMostSweeps; ++n) {
    if (n == 0) {
      sweep(at, identities, all, options, ascent);
      likely = likely_of(identities, ascent);
    } else {
      for (std::size_t l = 0; l < likely.size(); ++l)
        fit_again(at, identities, likely[l], prior_of(options, l), ascent, l);
    }
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
  return likely;
}

void add_empty(const ColumnsAt& at, Ascent& ascent) {
  ascent.effects.emplace_back();
  ascent.effects.back().curve = at.curve_of({});
}

// P of what was left out of a single effect, of the one where it is largest.
double largest_beside(const std::vector<IdentitySubset>& likely, const Ascent& ascent) {
  double largest = 0.0;
  for (std::size_t l = 0; l < likely.size(); ++l) {
    const SingleEffect& one = ascent.effects[l];
    double beside = 0.0;
    for (std::size_t i = 0; i < one.p.size(); ++i) beside += likely[l].identity[i] ? 0.0 : one.p[i];
    largest = std::max(largest, beside);
  }
  return largest;
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
  while (ascent.effects.size() < options.least) add_empty(at, ascent);
  const IdentitySubset all = all_of(identities, options);
  for (int look = 0; look < kMostChecks; ++look) {
    std::vector<IdentitySubset> likely = converge(at, identities, all, options, ascent);
    while (ascent.effects.size() < options.largest) {
      if (ascent.effects.size() > options.least && ascent.effects.back().p_any() < 0.5) break;
      add_empty(at, ascent);
      const std::size_t next = ascent.effects.size() - 1;
      fit_again(at, identities, all, prior_of(options, next), ascent, next);
      if (ascent.effects.size() > options.least && ascent.effects.back().p_any() < kHardlyThere) break;
      likely = converge(at, identities, all, options, ascent);
    }
    settle(at, ascent, ascent.variance);
    sweep(at, identities, all, options, ascent);
    if (largest_beside(likely, ascent) < kNoticed) break;
  }
  ascent.bound = bound_of(ascent, at, options.known);
  return ascent;
}

}  // namespace ballbar
