#include "diagnosis/search/max_score_null.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "ballbar/diagnosis/statistics/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "noise/whitening.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

// Draws first, first + 1 ... of `draws`, whitened by one noise; each of them is of one of `plausible`, which follow one
// another in equal shares.
class Paths {
 public:
  Paths(const LinearisedFit& linearised, const Noise& noise, const std::vector<Noise>& plausible, Eigen::Index draws,
        std::uint64_t seed)
      : linearised_(linearised),
        whitening_(noise, linearised.time_s, linearised.sigma_um),
        plausible_(plausible),
        draws_(draws),
        seed_(seed) {}

  // Rows by draws. Random numbers by the first draw.
  Eigen::MatrixXf drawn(Eigen::Index first, Eigen::Index count) const {
    std::mt19937_64 random =
        simulation::stream_of(seed_, simulation::Stream::signal, kKey | static_cast<std::uint64_t>(first));
    Eigen::VectorXd path(linearised_.residual_um.size());
    Eigen::MatrixXf paths(path.size(), count);
    std::optional<Colouring> colouring;
    std::size_t coloured = plausible_.size();
    for (Eigen::Index b = 0; b < count; ++b) {
      const std::size_t which = noise_of_draw(first + b);
      if (which != coloured) colouring.emplace(plausible_[coloured = which], linearised_.time_s, linearised_.sigma_um);
      simulation::fill_normal({path.data(), static_cast<std::size_t>(path.size())}, random);
      colouring->apply(path);
      whitening_.apply(path.data(), 1, path.data(), 1);
      paths.col(b) = path.cast<float>();
    }
    return paths;
  }

 private:
  static constexpr std::uint64_t kKey = std::uint64_t{2} << 32;

  std::size_t noise_of_draw(Eigen::Index draw) const {
    return static_cast<std::size_t>(draw) * plausible_.size() / static_cast<std::size_t>(draws_);
  }

  const LinearisedFit& linearised_;
  Whitening whitening_;
  const std::vector<Noise>& plausible_;
  Eigen::Index draws_;
  std::uint64_t seed_;
};

}  // namespace

double MaxScoreNull::Tail::p(double value) const {
  if (value >= from) return kTail * std::exp(-(value - from) / excess);
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), static_cast<float>(value));
  return std::max(kTail, static_cast<double>(above) / static_cast<double>(sorted.size()));
}

double MaxScoreNull::Tail::quantile(double chance) const {
  if (chance <= kTail) return from + excess * std::log(kTail / chance);
  const auto at = static_cast<std::size_t>((1.0 - chance) * static_cast<double>(sorted.size() - 1));
  return sorted[at];
}

MaxScoreNull::Tail MaxScoreNull::tail_of(std::vector<float> values) {
  std::sort(values.begin(), values.end());
  Tail tail;
  const auto begin = static_cast<std::size_t>((1.0 - kTail) * static_cast<double>(values.size()));
  tail.from = values[std::min(begin, values.size() - 1)];
  double sum = 0.0;
  for (std::size_t i = begin; i < values.size(); ++i) sum += values[i] - tail.from;
  tail.excess = std::max(sum / static_cast<double>(std::max<std::size_t>(1, values.size() - begin)), 1e-6);
  tail.sorted = std::move(values);
  return tail;
}

MaxScoreNull::MaxScoreNull(std::vector<const Effect*> effects, Eigen::MatrixXf maxima) : effects_(std::move(effects)) {
  const auto column = [](const auto& values) { return std::vector<float>(values.begin(), values.end()); };
  for (Eigen::Index e = 0; e < maxima.cols(); ++e) tails_.push_back(tail_of(column(maxima.col(e))));
  std::vector<float> rarest(static_cast<std::size_t>(maxima.rows()), 0.0F);
  for (Eigen::Index b = 0; b < maxima.rows(); ++b) {
    for (std::size_t e = 0; e < tails_.size(); ++e) {
      const double p = tails_[e].p(maxima(b, static_cast<Eigen::Index>(e)));
      rarest[static_cast<std::size_t>(b)] =
          std::max(rarest[static_cast<std::size_t>(b)], static_cast<float>(-std::log(std::max(p, 1e-30))));
    }
  }
  rarest_ = tail_of(std::move(rarest));
}

std::size_t MaxScoreNull::index_of(const Effect& effect) const {
  return static_cast<std::size_t>(std::find(effects_.begin(), effects_.end(), &effect) - effects_.begin());
}

double MaxScoreNull::p_of_effect(const Effect& effect, double score) const {
  return tails_.at(index_of(effect)).p(score);
}

double MaxScoreNull::p_search(const Effect& effect, double score) const {
  return rarest_.p(-std::log(std::max(p_of_effect(effect, score), 1e-300)));
}

double MaxScoreNull::threshold(const Effect& effect) const {
  const double chance = effect.time_only ? kErrorOfTimeOnly : kErrorOfASearch;
  return tails_.at(index_of(effect)).quantile(std::exp(-rarest_.quantile(chance)));
}

MaxScoreNull max_score_null(const SignatureLibrary& library, const Projected& projected,
                            const LinearisedFit& linearised, const Noise& noise, const std::vector<Noise>& plausible,
                            std::size_t draws, std::uint64_t seed) {
  constexpr Eigen::Index kBatch = 250;
  const auto count = static_cast<Eigen::Index>(std::max(draws, kFewestDraws));
  std::vector<const Effect*> effects;
  std::vector<Eigen::Index> effect_of_family;
  for (const Family& family : library.families) {
    auto at = std::find(effects.begin(), effects.end(), family.bound.effect);
    if (at == effects.end()) at = effects.insert(effects.end(), family.bound.effect);
    effect_of_family.push_back(at - effects.begin());
  }
  const Eigen::MatrixXf columns = projected.columns.cast<float>();
  const Paths paths(linearised, noise, plausible, count, seed);
  Eigen::MatrixXf maxima = Eigen::MatrixXf::Zero(count, static_cast<Eigen::Index>(effects.size()));
  in_parallel(static_cast<std::size_t>((count + kBatch - 1) / kBatch), [&](std::size_t batch) {
    const Eigen::Index first = kBatch * static_cast<Eigen::Index>(batch), now = std::min(kBatch, count - first);
    const Eigen::MatrixXf along = paths.drawn(first, now).transpose() * columns;
    for (const Signature& signature : library.signatures) {
      Eigen::ArrayXf score = along.col(signature.first).array().square();
      for (Eigen::Index j = 1; j < signature.width; ++j) score += along.col(signature.first + j).array().square();
      auto most = maxima.col(effect_of_family[signature.family]).segment(first, now);
      most = most.cwiseMax(score.matrix());
    }
  });
  return {std::move(effects), std::move(maxima)};
}

}  // namespace ballbar
