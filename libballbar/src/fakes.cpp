#include "fakes.hpp"

#include <algorithm>
#include <cmath>

#include "scrambled.hpp"
#include "simulate_noise.hpp"
#include "whitened.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFakeGrid = 1024;
constexpr std::size_t kFakeShapes = 8;

// What a unit of the first gain adds at all rows of the data, on an even grid over the rows of the target.
std::vector<double> on_grid(const Effect& effect, const EffectRows& inputs, const std::vector<double>& point,
                            double begin_s, double end_s) {
  const std::size_t count = effect.parameters.size();
  std::vector<double> values(inputs.time_s.size()), slopes(values.size() * count);
  effect.evaluate(inputs, point.data(), values.data(), slopes.data());
  std::size_t gain = 0;
  while (gain + 1 < count && effect.parameters[gain].kind != ParameterKind::gain) ++gain;
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = slopes[i * count + gain];
  std::vector<double> grid(kFakeGrid);
  std::size_t row = 0;
  for (std::size_t i = 0; i < kFakeGrid; ++i) {
    const double t = begin_s + (end_s - begin_s) * static_cast<double>(i) / static_cast<double>(kFakeGrid - 1);
    while (row + 2 < values.size() && inputs.time_s[row + 1] < t) ++row;
    const double step = inputs.time_s[row + 1] - inputs.time_s[row];
    const double part = std::clamp((t - inputs.time_s[row]) / step, 0.0, 1.0);
    grid[i] = values[row] + part * (values[row + 1] - values[row]);
  }
  return grid;
}

}  // namespace

BestFake best_fake(const Family& family, const Bank& bank, const Series& data, const std::vector<std::size_t>& rows,
                   const Leftover& leftover, const Noise& noise, std::size_t count, std::uint64_t seed) {
  const BoundInputs bound = inputs_of(*family.effect, family.columns, data);
  const EffectRows& inputs = bound.rows;
  std::vector<Spectrum> spectra;
  const std::size_t stride = 1 + (family.count - 1) / kFakeShapes;
  for (std::size_t i = family.first; i < family.first + family.count; i += stride) {
    spectra.push_back(spectrum_of(
        on_grid(*family.effect, inputs, bank.signatures[i].point, leftover.time_s.front(), leftover.time_s.back())));
  }
  const Whitening whitening(noise, leftover.time_s, leftover.sigma_um);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  r -= basis * (basis.transpose() * r);
  const Eigen::MatrixXd plain_basis = orthonormal(leftover.model);
  const Eigen::VectorXd plain = leftover.residual_um - plain_basis * (plain_basis.transpose() * leftover.residual_um);
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 3);
  BestFake best;
  double most = 0.0;
  Eigen::VectorXd fake(static_cast<Eigen::Index>(rows.size())), white(fake.size());
  const double span = leftover.time_s.back() - leftover.time_s.front();
  for (std::size_t number = 0; number < count; ++number) {
    const std::vector<double> phases = random_phases(kFakeGrid, random);
    for (const Spectrum& spectrum : spectra) {
      const std::vector<double> grid = scrambled(spectrum, phases);
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const double place = (leftover.time_s[i] - leftover.time_s.front()) / span * static_cast<double>(kFakeGrid - 1);
        const auto at = std::min(kFakeGrid - 2, static_cast<std::size_t>(place));
        const double part = place - static_cast<double>(at);
        fake[static_cast<Eigen::Index>(i)] = grid[at] + part * (grid[at + 1] - grid[at]);
      }
      whitening.apply(fake.data(), 1, white.data(), 1);
      white -= basis * (basis.transpose() * white);
      const double square = white.squaredNorm();
      if (square > 0.0) best.gain = std::max(best.gain, std::pow(white.dot(r), 2) / square);
      fake -= plain_basis * (plain_basis.transpose() * fake);
      const double plain_square = fake.squaredNorm();
      if (plain_square > 0.0) most = std::max(most, std::pow(fake.dot(plain), 2) / plain_square);
    }
  }
  best.fall = 1.0 - std::sqrt(std::max(0.0, 1.0 - most / std::max(plain.squaredNorm(), 1e-300)));
  return best;
}

}  // namespace ballbar
