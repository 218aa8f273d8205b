#include "search_null.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "simulate_noise.hpp"

namespace ballbar {
namespace {

constexpr double kTail = 0.1;  // share of the draws from which a tail is told

// Path of the noise of these rows, whitened.
void draw(const Leftover& leftover, const Noise& noise, const Whitening& whitening, std::mt19937_64& random,
          Eigen::VectorXd& path) {
  double slow = 0.0;
  for (Eigen::Index i = 0; i < path.size(); ++i) {
    const auto row = static_cast<std::size_t>(i);
    double white2 = noise.white_um * noise.white_um;
    if (!leftover.sigma_um.empty()) white2 += leftover.sigma_um[row] * leftover.sigma_um[row];
    if (noise.correlated_um > 0.0) {
      const double dt = i == 0 ? -1.0 : leftover.time_s[row] - leftover.time_s[row - 1];
      const double decay = dt < 0.0 ? 0.0 : std::exp(-dt / noise.correlation_time_s);
      slow = decay * slow + noise.correlated_um * std::sqrt(1.0 - decay * decay) * simulation::normal(random);
    }
    path[i] = slow + (white2 > 0.0 ? std::sqrt(white2) * simulation::normal(random) : 0.0);
  }
  whitening.apply(path.data(), 1, path.data(), 1);
}

}  // namespace

double SearchNull::Tail::p(double value) const {
  if (value >= from) return kTail * std::exp(-(value - from) / excess);
  const auto above = sorted.end() - std::lower_bound(sorted.begin(), sorted.end(), static_cast<float>(value));
  return std::max(kTail, static_cast<double>(above) / static_cast<double>(sorted.size()));
}

double SearchNull::Tail::quantile(double chance) const {
  if (chance <= kTail) return from + excess * std::log(kTail / chance);
  const auto at = static_cast<std::size_t>((1.0 - chance) * static_cast<double>(sorted.size() - 1));
  return sorted[at];
}

SearchNull::Tail SearchNull::tail_of(std::vector<float> values) {
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

SearchNull::SearchNull(std::vector<const Effect*> effects, Eigen::MatrixXf maxima) : effects_(std::move(effects)) {
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

std::size_t SearchNull::index_of(const Effect& effect) const {
  return static_cast<std::size_t>(std::find(effects_.begin(), effects_.end(), &effect) - effects_.begin());
}

double SearchNull::p_of_effect(const Effect& effect, double score) const {
  return tails_.at(index_of(effect)).p(score);
}

double SearchNull::p_search(const Effect& effect, double score) const {
  return rarest_.p(-std::log(std::max(p_of_effect(effect, score), 1e-300)));
}

double SearchNull::threshold(const Effect& effect) const {
  const double chance = effect.time_only ? 0.001 : 0.01;
  return tails_.at(index_of(effect)).quantile(std::exp(-rarest_.quantile(chance)));
}

SearchNull search_null(const Bank& bank, const Projected& projected, const Leftover& leftover, const Noise& noise,
                       const std::vector<Noise>& plausible, std::size_t draws, std::uint64_t seed) {
  constexpr Eigen::Index kBatch = 64, kChunk = 512;
  constexpr unsigned kMostThreads = 4;
  draws = std::max<std::size_t>(draws, 100);  // fewer have no tail
  std::vector<const Effect*> effects;
  std::vector<Eigen::Index> effect_of_family;
  for (const Family& family : bank.families) {
    auto at = std::find(effects.begin(), effects.end(), family.effect);
    if (at == effects.end()) at = effects.insert(effects.end(), family.effect);
    effect_of_family.push_back(at - effects.begin());
  }
  const Eigen::MatrixXf transposed = projected.columns.transpose().cast<float>();
  const Whitening whitening(noise, leftover.time_s, leftover.sigma_um);
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 2);
  Eigen::MatrixXf maxima =
      Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(draws), static_cast<Eigen::Index>(effects.size()));
  const auto drawn = [&](Eigen::Index first) {
    Eigen::VectorXd path(leftover.residual_um.size());
    Eigen::MatrixXf paths(path.size(), std::min(kChunk, maxima.rows() - first));
    for (Eigen::Index b = 0; b < paths.cols(); ++b) {
      draw(leftover, plausible[static_cast<std::size_t>(first + b) % plausible.size()], whitening, random, path);
      paths.col(b) = path.cast<float>();
    }
    return paths;
  };
  const auto search = [&](Eigen::Index first, const auto& paths) {
    const Eigen::MatrixXf along = transposed * paths;
    for (const Signature& signature : bank.signatures) {
      const Eigen::Index effect = effect_of_family[signature.family];
      for (Eigen::Index b = 0; b < paths.cols(); ++b) {
        const float score = along.col(b).segment(signature.first, signature.width).squaredNorm();
        maxima(first + b, effect) = std::max(maxima(first + b, effect), score);
      }
    }
  };
  // Drawn in order, by one thread; batches of them are searched by all, so that nothing depends on their number.
  Eigen::MatrixXf paths = drawn(0);
  for (Eigen::Index first = 0; first < maxima.rows(); first += kChunk) {
    std::atomic<Eigen::Index> next{0};
    const auto search_batches = [&] {
      for (Eigen::Index begin = kBatch * next++; begin < paths.cols(); begin = kBatch * next++) {
        search(first + begin, paths.middleCols(begin, std::min(kBatch, paths.cols() - begin)));
      }
    };
    Eigen::MatrixXf after;
    {
      std::vector<std::jthread> helpers;
      for (unsigned k = 1; k < std::min(std::thread::hardware_concurrency(), kMostThreads); ++k) {
        helpers.emplace_back(search_batches);
      }
      if (first + kChunk < maxima.rows()) after = drawn(first + kChunk);
      search_batches();
    }
    paths = std::move(after);
  }
  return {std::move(effects), std::move(maxima)};
}

}  // namespace ballbar
