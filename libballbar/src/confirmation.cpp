#include "confirmation.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <unsupported/Eigen/SpecialFunctions>

#include "ballbar/speed_steps.hpp"
#include "ballbar/units.hpp"
#include "interpolation.hpp"
#include "simulate_noise.hpp"
#include "whitened.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostCycles = 12;
constexpr std::size_t kParts = 5;
constexpr std::size_t kPartsOfASweep = 4;
constexpr double kNowhere = 1e-12;  // share of a column's square that is none
constexpr std::size_t kFakeGrid = 1024;
constexpr std::size_t kFakeShapes = 8;

Whitening whitening_of(const Leftover& leftover, const Noise& noise) {
  return {noise, leftover.time_s, leftover.sigma_um};
}

std::vector<std::size_t> parts_of(const std::vector<double>& time_s, const std::vector<std::size_t>& rows,
                                  std::size_t parts) {
  std::vector<std::size_t> cycle;
  const double begin = time_s[rows.front()], span = time_s[rows.back()] - begin;
  for (const std::size_t row : rows) {
    const double place = span > 0.0 ? (time_s[row] - begin) / span : 0.0;
    cycle.push_back(std::min(parts - 1, static_cast<std::size_t>(place * static_cast<double>(parts))));
  }
  return cycle;
}

// Whole numbers: 0, 1, 2 ... in the order they come in, those of the same recording the same; at most kMostCycles, of
// more recordings neighbours together.
std::vector<std::size_t> recordings_of(const Column& recording, const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> cycle;
  std::size_t now = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && recording.values[rows[i]] != recording.values[rows[i - 1]]) ++now;
    cycle.push_back(now);
  }
  const std::size_t count = now + 1;
  if (count > kMostCycles) {
    for (std::size_t& one : cycle) one = one * kMostCycles / count;
  }
  return cycle;
}

// The same part of every sweep.
std::vector<std::size_t> parts_of_sweeps(const Column& recording, const std::vector<double>& time_s,
                                         const std::vector<std::size_t>& rows) {
  std::vector<std::size_t> cycle;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t last = first;
    while (last < rows.size() && recording.values[rows[last]] == recording.values[rows[first]]) ++last;
    const std::vector<std::size_t> sweep(rows.begin() + static_cast<std::ptrdiff_t>(first),
                                         rows.begin() + static_cast<std::ptrdiff_t>(last));
    const std::vector<std::size_t> parts = parts_of(time_s, sweep, kPartsOfASweep);
    cycle.insert(cycle.end(), parts.begin(), parts.end());
    first = last;
  }
  return cycle;
}

// Spectrum of a signal on an even grid, the line through its ends taken off.
struct Spectrum {
  std::vector<std::complex<double>> bins;
  double first = 0.0, last = 0.0;
};

Spectrum spectrum_of(std::vector<double> values, Eigen::FFT<double>& fft) {
  Spectrum spectrum;
  spectrum.first = values.front();
  spectrum.last = values.back();
  const auto n = static_cast<double>(values.size() - 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] -= spectrum.first + (spectrum.last - spectrum.first) * static_cast<double>(i) / n;
  }
  fft.fwd(spectrum.bins, values);
  return spectrum;
}

std::vector<double> scrambled(const Spectrum& spectrum, const std::vector<double>& phases, Eigen::FFT<double>& fft) {
  std::vector<std::complex<double>> bins = spectrum.bins;
  const std::size_t n = bins.size();
  for (std::size_t k = 1; 2 * k < n; ++k) {
    bins[k] *= std::polar(1.0, phases[k]);
    bins[n - k] = std::conj(bins[k]);
  }
  std::vector<double> values;
  fft.inv(values, bins);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] +=
        spectrum.first + (spectrum.last - spectrum.first) * static_cast<double>(i) / static_cast<double>(n - 1);
  }
  return values;
}

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

const Column* recording_numbers(const Series& data) {
  return find_column(data, "angle_rad") == nullptr ? nullptr : find_column(data, "recording");
}

std::vector<std::size_t> cycles_of(const Series& data, const std::vector<std::size_t>& rows) {
  if (const Column* recording = recording_numbers(data)) {
    const bool several = recording->values[rows.front()] != recording->values[rows.back()];
    return several ? recordings_of(*recording, rows) : parts_of_sweeps(*recording, data.time_s, rows);
  }
  const auto speed = std::find_if(data.columns.begin(), data.columns.end(),
                                  [](const Column& column) { return column.role == Role::speed; });
  if (speed == data.columns.end()) return parts_of(data.time_s, rows, kParts);
  const std::vector<SpeedStep> steps = speed_steps(data.time_s, *speed);
  std::vector<std::size_t> step_of(data.time_s.size(), 0);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    for (std::size_t row = steps[s].begin; row < steps[s].end; ++row) step_of[row] = s;
  }
  // A cycle ends with a step once it holds its share of the rows.
  const std::size_t fewest = std::max<std::size_t>(2, rows.size() / kMostCycles);
  std::vector<std::size_t> cycle;
  std::size_t now = 0, held = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (i > 0 && step_of[rows[i]] != step_of[rows[i - 1]] && held >= fewest && rows.size() - i >= fewest / 2) {
      ++now;
      held = 0;
    }
    cycle.push_back(now);
    ++held;
  }
  return now == 0 ? parts_of(data.time_s, rows, kParts) : cycle;
}

std::vector<std::size_t> cycles_that_tell(const Series& data, const std::vector<std::size_t>& rows,
                                          const std::vector<std::size_t>& cycle, const Eigen::MatrixXd& columns) {
  const Column* recording = recording_numbers(data);
  if (recording == nullptr) return cycle;
  const std::size_t cycles = *std::max_element(cycle.begin(), cycle.end()) + 1;
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(cycles), columns.cols());
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    square.row(static_cast<Eigen::Index>(cycle[i])) += columns.row(static_cast<Eigen::Index>(i)).cwiseAbs2();
  }
  const Eigen::RowVectorXd all = square.colwise().sum();
  for (Eigen::Index out = 0; out < square.rows(); ++out) {
    if (((all - square.row(out)).array() <= kNowhere * all.array()).any()) {
      return parts_of_sweeps(*recording, data.time_s, rows);
    }
  }
  return cycle;
}

HeldOut held_out(const Leftover& leftover, const Noise& noise, const std::vector<std::size_t>& cycle,
                 bool of_recordings) {
  const std::size_t cycles = *std::max_element(cycle.begin(), cycle.end()) + 1;
  HeldOut result;
  for (std::size_t out = 0; out < cycles; ++out) {
    std::vector<Eigen::Index> kept, left;
    Leftover rest, own;
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      if (cycle[i] == out) {
        left.push_back(row);
        own.time_s.push_back(leftover.time_s[i]);
        if (!leftover.sigma_um.empty()) own.sigma_um.push_back(leftover.sigma_um[i]);
        continue;
      }
      kept.push_back(row);
      rest.time_s.push_back(leftover.time_s[i]);
      if (!leftover.sigma_um.empty()) rest.sigma_um.push_back(leftover.sigma_um[i]);
    }
    std::vector<Eigen::Index> shared, of_its_own;
    for (Eigen::Index j = 0; j < leftover.model.cols(); ++j) {
      const bool elsewhere = leftover.model(kept, j).squaredNorm() > kNowhere * leftover.model.col(j).squaredNorm();
      (elsewhere || !of_recordings ? shared : of_its_own).push_back(j);
    }
    Eigen::VectorXd error = leftover.residual_um(left);
    const Whitening whitening = whitening_of(rest, noise), own_whitening = whitening_of(own, noise);
    const auto free_of = [&](const std::vector<Eigen::Index>& columns, const Eigen::MatrixXd& x,
                             const Eigen::VectorXd& r) {
      if (columns.empty() || x.rows() == 0) return;
      Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
      solver.setThreshold(1e-6);
      solver.compute(x);
      error -= leftover.model(left, columns) * solver.solve(r);
    };
    free_of(shared, whitened(whitening, leftover.model(kept, shared)), whitened(whitening, leftover.residual_um(kept)));
    free_of(of_its_own, whitened(own_whitening, leftover.model(left, of_its_own)), whitened(own_whitening, error));
    result.rmse_um += error.squaredNorm();
    result.chi2 += whitened(own_whitening, error).squaredNorm();
  }
  result.rmse_um = std::sqrt(result.rmse_um / static_cast<double>(cycle.size()));
  return result;
}

double chi2(const Leftover& leftover, const Noise& noise) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  const Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  return r.squaredNorm() - (basis.transpose() * r).squaredNorm();
}

std::size_t first_parameter(const Model& model, std::size_t term) {
  std::size_t first = 1;
  for (std::size_t t = 0; t < term; ++t) first += model.terms[t].settings.size();
  return first;
}

Eigen::MatrixXd gain_columns(const Fit& fit, const Model& model, std::size_t term) {
  std::vector<Eigen::Index> gains;
  const std::vector<Parameter>& parameters = model.terms[term].effect->parameters;
  const std::size_t first = first_parameter(model, term);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].kind == ParameterKind::gain) gains.push_back(static_cast<Eigen::Index>(first + k));
  }
  return fit.jacobian(Eigen::all, gains);
}

double p_same_gain(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                   const std::vector<std::size_t>& cycle) {
  const auto cycles = static_cast<Eigen::Index>(*std::max_element(cycle.begin(), cycle.end()) + 1);
  const Whitening whitening = whitening_of(leftover, noise);
  Eigen::MatrixXd together(columns.rows(), leftover.model.cols() + columns.cols());
  together << leftover.model, columns;
  Eigen::MatrixXd apart = Eigen::MatrixXd::Zero(columns.rows(), columns.cols() * cycles);
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    apart.block(row, static_cast<Eigen::Index>(cycle[i]) * columns.cols(), 1, columns.cols()) = columns.row(row);
  }
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, together));
  Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  r -= basis * (basis.transpose() * r);
  Eigen::MatrixXd left = whitened(whitening, apart);
  left -= basis * (basis.transpose() * left);
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(left);
  qr.setThreshold(1e-3);
  const Eigen::Index degrees = qr.rank();
  if (degrees == 0) return 1.0;
  const Eigen::MatrixXd directions = qr.householderQ() * Eigen::MatrixXd::Identity(left.rows(), degrees);
  return Eigen::numext::igammac(0.5 * static_cast<double>(degrees), 0.5 * (directions.transpose() * r).squaredNorm());
}

double share_of_one_cycle(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise,
                          const std::vector<std::size_t>& cycle) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::MatrixXd added = whitened(whitening, columns);
  added -= basis * (basis.transpose() * added);
  std::vector<double> square(*std::max_element(cycle.begin(), cycle.end()) + 1, 0.0);
  for (std::size_t i = 0; i < cycle.size(); ++i)
    square[cycle[i]] += added.row(static_cast<Eigen::Index>(i)).squaredNorm();
  const double all = added.squaredNorm();
  return all > 0.0 ? *std::max_element(square.begin(), square.end()) / all : 0.0;
}

double gain_of_many(const Leftover& leftover, const Eigen::MatrixXd& columns, const Noise& noise) {
  const Whitening whitening = whitening_of(leftover, noise);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::MatrixXd added = whitened(whitening, columns);
  added -= basis * (basis.transpose() * added);
  const Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  return (orthonormal(added).transpose() * clipped(r - basis * (basis.transpose() * r))).squaredNorm();
}

BestFake best_fake(const Family& family, const Bank& bank, const Series& data, const std::vector<std::size_t>& rows,
                   const Leftover& leftover, const Noise& noise, std::size_t count, std::uint64_t seed) {
  const BoundInputs bound = inputs_of(*family.effect, family.columns, data);
  const EffectRows& inputs = bound.rows;
  Eigen::FFT<double> fft;
  std::vector<Spectrum> spectra;
  const std::size_t stride = 1 + (family.count - 1) / kFakeShapes;
  for (std::size_t i = family.first; i < family.first + family.count; i += stride) {
    spectra.push_back(spectrum_of(
        on_grid(*family.effect, inputs, bank.signatures[i].point, leftover.time_s.front(), leftover.time_s.back()),
        fft));
  }
  const Whitening whitening = whitening_of(leftover, noise);
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
    std::vector<double> phases(kFakeGrid);
    for (double& phase : phases) phase = 2.0 * kPi * simulation::uniform(random);
    for (const Spectrum& spectrum : spectra) {
      const std::vector<double> grid = scrambled(spectrum, phases, fft);
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
