#include "diagnosis/posterior/single_effect_regression.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "diagnosis/signatures/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kNegligible = 1e-5;       // P of a shape that is left out of the mean
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

}  // namespace

double SingleEffect::p_none() const { return 1.0 / (1.0 + std::exp(log_odds)); }

double SingleEffect::p_any() const { return std::accumulate(alpha.begin(), alpha.end(), 0.0); }

IdentitySubset subset_of(const Identities& identities, const std::vector<char>& is_chosen) {
  IdentitySubset result;
  const Eigen::Index c = identities.columns.cols();
  for (std::size_t i = 0; i < identities.log_prior.size(); ++i) {
    if (!is_chosen[i]) continue;
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
  if (identities.jump && is_chosen[*identities.jump]) result.columns.push_back({c, identities.size() - c});
  return result;
}

SingleEffect single_effect_regression(ProjectedColumns& at, const Identities& identities, const IdentitySubset& among,
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
    if (prior.shape != kNoSignature && s != prior.shape) continue;
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
  result.alpha.assign(identities.log_prior.size(), 0.0);
  result.likeliest.assign(identities.log_prior.size(), kNoSignature);
  result.log_weight.assign(identities.log_prior.size(), kLogZero);
  if (most == kLogZero) {  // nothing may be, and nothing is left of what must be
    result.log_odds = kLogZero;
    result.curve = at.curve_of({});
    return result;
  }
  double any = 0.0;
  for (const WeightedShape& one : all) {
    if (one.log_weight > most - kNothingToDouble) any += std::exp(one.log_weight - most);
  }
  const double none = prior.log_none == kLogZero ? 0.0 : std::exp(prior.log_none - most), total = any + none;
  // If none of them is near, all together are negligible against none.
  result.log_odds = std::log(any) - std::log(none);
  double expected = 0.0;
  for (const WeightedShape& one : all) {
    if (one.log_weight == kLogZero) continue;
    const Shape& shape = identities.shapes[one.shape];
    std::size_t& likeliest = result.likeliest[shape.identity];
    double& log_weight = result.log_weight[shape.identity];
    if (likeliest == kNoSignature || one.log_weight > log_weight) {
      likeliest = one.shape;
      log_weight = one.log_weight;
    }
    const double p = std::exp(one.log_weight - most) / total;
    result.alpha[shape.identity] += p;
    if (p < kNegligible) continue;
    expected += p * (one.of.along - 0.5 * one.of.square);
    result.expected_square += p * one.of.square;
    if (shape.width > 1) {
      for (Eigen::Index k = 0; k < shape.width; ++k)
        result.mean.emplace_back(shape.first + k, p * of_blocks[one.block].mean[k]);
    } else if (r[shape.first] != 0.0) {
      result.mean.emplace_back(shape.first, p * one.of.along * variance / r[shape.first]);
    }
  }
  result.kl = expected - (most + std::log(total));
  result.curve = at.curve_of(result.mean);
  return result;
}

}  // namespace ballbar
