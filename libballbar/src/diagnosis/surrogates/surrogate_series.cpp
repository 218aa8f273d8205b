#include "diagnosis/surrogates/surrogate_series.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "ballbar/series/runs.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/surrogates/phase_randomised.hpp"
#include "effects/effect_at.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kSurrogateGrid = 1024;  // values over the time
constexpr std::size_t kSurrogateShapes = 8;   // of an effect

// What a unit of the first gain adds at all rows of the data, on an even grid over the rows of the target.
std::vector<double> on_grid(const Effect& effect, const EffectRows& inputs, const std::vector<double>& point,
                            double begin_s, double end_s) {
  std::vector<std::size_t> rows(inputs.time_s.size());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  const Eigen::VectorXd gain = effect_at(effect, inputs, point, rows).gains(effect).col(0);
  const std::vector<double> values(gain.begin(), gain.end());
  const std::vector<double> time_s = unrolled(inputs.time_s);
  std::vector<double> grid(kSurrogateGrid);
  std::size_t row = 0;
  for (std::size_t i = 0; i < kSurrogateGrid; ++i) {
    const double t = begin_s + (end_s - begin_s) * static_cast<double>(i) / static_cast<double>(kSurrogateGrid - 1);
    while (row + 2 < values.size() && time_s[row + 1] < t) ++row;
    const double step = time_s[row + 1] - time_s[row];
    const double part = std::clamp((t - time_s[row]) / step, 0.0, 1.0);
    grid[i] = values[row] + part * (values[row + 1] - values[row]);
  }
  return grid;
}

// Places of the rows on the grid, for straight lines between its points.
class Places {
 public:
  explicit Places(const std::vector<double>& time_s) {
    const double span_s = time_s.back() - time_s.front();
    for (const double t_s : time_s) {
      const double place = (t_s - time_s.front()) / span_s * static_cast<double>(kSurrogateGrid - 1);
      at_.push_back(std::min(kSurrogateGrid - 2, static_cast<std::size_t>(place)));
      part_.push_back(place - static_cast<double>(at_.back()));
    }
  }

  void read(const std::vector<double>& grid, double* column) const {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      column[i] = grid[at_[i]] + part_[i] * (grid[at_[i] + 1] - grid[at_[i]]);
    }
  }

 private:
  std::vector<std::size_t> at_;
  std::vector<double> part_;
};

// Largest fall of the square of what the model leaves by one of the columns.
double largest_fall(const ModelProjection& model, Eigen::MatrixXd columns) {
  columns = orthogonal_part(std::move(columns), model.basis);
  const Eigen::VectorXd along = columns.transpose() * model.residual;
  double most = 0.0;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    const double square = columns.col(k).squaredNorm();
    if (square > 0.0) most = std::max(most, along[k] * along[k] / square);
  }
  return most;
}

std::vector<double> on_clock(const std::vector<double>& time_s, const std::vector<std::size_t>& rows) {
  std::vector<double> result;
  result.reserve(rows.size());
  for (const std::size_t row : rows) result.push_back(time_s[row]);
  return result;
}

std::vector<Spectrum> spectra_of(const SurrogateSource& source, const Series& data, const std::vector<double>& time_s) {
  const Effect& effect = *source.bound.effect;
  const BoundInputs bound = inputs_of(effect, source.bound.columns, data);
  std::vector<Spectrum> spectra;
  const std::size_t stride = 1 + (source.points.size() - 1) / kSurrogateShapes;
  for (std::size_t i = 0; i < source.points.size(); i += stride) {
    spectra.push_back(spectrum_of(on_grid(effect, bound.rows, source.points[i], time_s.front(), time_s.back())));
  }
  return spectra;
}

}  // namespace

BestSurrogate best_surrogate(const SurrogateSource& effect, const Series& data, const Background& background,
                             std::size_t count, std::uint64_t seed) {
  constexpr std::size_t kTogether = 8;
  const std::vector<double> time_s = on_clock(unrolled(data.time_s), background.row);
  const std::vector<Spectrum> spectra = spectra_of(effect, data, time_s);
  const ModelProjection &white = background.white, &plain = background.plain;
  const Places places(time_s);
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 3);
  std::vector<std::vector<double>> phases;
  for (std::size_t number = 0; number < count; ++number) phases.push_back(random_phases(kSurrogateGrid, random));
  const std::size_t batches = (count + kTogether - 1) / kTogether;
  std::vector<double> gain(batches, 0.0), fall(batches, 0.0);
  in_parallel(batches, [&](std::size_t batch) {
    const std::size_t first = batch * kTogether, last = std::min(count, first + kTogether);
    Eigen::MatrixXd surrogates(static_cast<Eigen::Index>(time_s.size()),
                               static_cast<Eigen::Index>((last - first) * spectra.size()));
    Eigen::Index column = 0;
    for (std::size_t number = first; number < last; ++number) {
      for (const Spectrum& spectrum : spectra) {
        places.read(phase_randomised(spectrum, phases[number]), surrogates.col(column++).data());
      }
    }
    gain[batch] = largest_fall(white, background.whiten(surrogates));
    fall[batch] = largest_fall(plain, std::move(surrogates));
  });
  BestSurrogate best;
  double most = 0.0;
  for (std::size_t batch = 0; batch < batches; ++batch) {
    best.gain = std::max(best.gain, gain[batch]);
    most = std::max(most, fall[batch]);
  }
  best.fall = 1.0 - std::sqrt(std::max(0.0, 1.0 - most / std::max(plain.residual.squaredNorm(), 1e-300)));
  return best;
}

}  // namespace ballbar
