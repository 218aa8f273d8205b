#include "trace_fakes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/units.hpp"
#include "scrambled.hpp"
#include "simulate_noise.hpp"
#include "whitened.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kGrid = 512;
constexpr std::size_t kFewestReadings = 16;
constexpr double kSameCurve = 0.01;    // share of the square by which curves on two recordings may differ
constexpr double kItself = 0.95;       // coherence
constexpr double kMostAlike = 0.01;    // share of the fakes
constexpr double kNothingLeft = 1e-6;  // share of a column's square

// Readings of one recording by their place on the circle: 0 to 1, of a whole turn from +A round to +A, else from one
// end of the arc to the other.
struct Sweep {
  std::vector<Eigen::Index> row;  // of the fit, by rising place
  std::vector<double> place;
  bool whole_turn = false;
  std::size_t group = 0;  // of recordings on which the effect adds the same
};

Sweep sweep_of(const std::vector<double>& angle_rad, const std::vector<std::size_t>& rows, Eigen::Index first,
               Eigen::Index count) {
  std::vector<double> angle(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < angle.size(); ++i) {
    angle[i] = angle_rad[rows[static_cast<std::size_t>(first) + i]];
    if (i > 0) angle[i] -= 2.0 * kPi * std::round((angle[i] - angle[i - 1]) / (2.0 * kPi));
  }
  const auto [low, high] = std::minmax_element(angle.begin(), angle.end());
  const double begin = *low, span = *high - *low;
  Sweep sweep;
  sweep.whole_turn = span > 2.0 * kPi * (1.0 - 1.5 / static_cast<double>(count));
  for (double& value : angle) {
    const double turns = value / (2.0 * kPi);
    value = sweep.whole_turn ? turns - std::floor(turns) : span > 0.0 ? (value - begin) / span : 0.0;
  }
  std::vector<std::size_t> order(angle.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return angle[a] < angle[b]; });
  for (const std::size_t i : order) {
    sweep.row.push_back(first + static_cast<Eigen::Index>(i));
    sweep.place.push_back(angle[i]);
  }
  return sweep;
}

std::vector<Sweep> sweeps_of(const Series& data, const std::vector<std::size_t>& rows) {
  const std::vector<double>& angle = find_column(data, "angle_rad")->values;
  const std::vector<double>& number = find_column(data, "recording")->values;
  std::vector<Sweep> sweeps;
  const auto n = static_cast<Eigen::Index>(rows.size());
  for (Eigen::Index first = 0; first < n;) {
    Eigen::Index last = first;
    while (last < n && number[rows[static_cast<std::size_t>(last)]] == number[rows[static_cast<std::size_t>(first)]]) {
      ++last;
    }
    sweeps.push_back(sweep_of(angle, rows, first, last - first));
    first = last;
  }
  return sweeps;
}

double place_on_grid(const Sweep& sweep, std::size_t i) {
  return static_cast<double>(i) / static_cast<double>(sweep.whole_turn ? kGrid : kGrid - 1);
}

// A column of the fit's rows on the sweep's grid, straight lines between readings.
std::vector<double> on_grid(const Sweep& sweep, const Eigen::VectorXd& column) {
  std::vector<double> grid(kGrid);
  const std::size_t n = sweep.row.size();
  std::size_t after = 0;
  for (std::size_t i = 0; i < kGrid; ++i) {
    const double place = place_on_grid(sweep, i);
    while (after < n && sweep.place[after] < place) ++after;
    const bool round = sweep.whole_turn && (after == 0 || after == n);
    const std::size_t right = after == n ? (round ? 0 : n - 1) : after;
    const std::size_t left = after == 0 ? (round ? n - 1 : 0) : after - 1;
    double step = sweep.place[right] - sweep.place[left], from = place - sweep.place[left];
    if (round) {
      step += 1.0;
      if (from < 0.0) from += 1.0;
    }
    const double part = step > 0.0 ? std::clamp(from / step, 0.0, 1.0) : 0.0;
    grid[i] = column[sweep.row[left]] + part * (column[sweep.row[right]] - column[sweep.row[left]]);
  }
  return grid;
}

double at_reading(const Sweep& sweep, const std::vector<double>& grid, double place) {
  const double at = place * static_cast<double>(sweep.whole_turn ? kGrid : kGrid - 1);
  const auto left = std::min(kGrid - 1, static_cast<std::size_t>(at));
  const std::size_t right = sweep.whole_turn ? (left + 1) % kGrid : std::min(kGrid - 1, left + 1);
  return grid[left] + (at - static_cast<double>(left)) * (grid[right] - grid[left]);
}

void add_scrambled(const Sweep& sweep, const Spectrum& spectrum, const std::vector<double>& phases,
                   Eigen::VectorXd& column) {
  const std::vector<double> grid = scrambled(spectrum, phases);
  for (std::size_t i = 0; i < sweep.row.size(); ++i) column[sweep.row[i]] = at_reading(sweep, grid, sweep.place[i]);
}

// A column a gain, at the rows of the fit.
Eigen::MatrixXd gains_at(const Effect& effect, const EffectRows& inputs, const std::vector<double>& point,
                         const std::vector<std::size_t>& rows) {
  const std::size_t count = effect.parameters.size();
  std::vector<double> values(inputs.time_s.size()), slopes(values.size() * count);
  effect.evaluate(inputs, point.data(), values.data(), slopes.data());
  std::vector<std::size_t> gains;
  for (std::size_t k = 0; k < count; ++k) {
    if (effect.parameters[k].kind == ParameterKind::gain) gains.push_back(k);
  }
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(gains.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < gains.size(); ++k) {
      columns(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = slopes[rows[i] * count + gains[k]];
    }
  }
  return columns;
}

// Sweeps on which the effect adds the same become one group.
void group(std::vector<Sweep>& sweeps, const Eigen::VectorXd& added_um) {
  std::vector<std::vector<double>> curves;
  std::size_t groups = 0;
  for (Sweep& sweep : sweeps) {
    curves.push_back(on_grid(sweep, added_um));
    sweep.group = groups;
    for (std::size_t before = 0; before + 1 < curves.size() && sweep.group == groups; ++before) {
      double apart = 0.0, square = 0.0;
      for (std::size_t i = 0; i < kGrid; ++i) {
        apart += std::pow(curves.back()[i] - curves[before][i], 2);
        square += std::pow(curves.back()[i], 2);
      }
      const bool same = apart <= kSameCurve * square && sweep.whole_turn == sweeps[before].whole_turn;
      if (same) sweep.group = sweeps[before].group;
    }
    if (sweep.group == groups) ++groups;
  }
}

// Of each sweep and gain.
std::vector<std::vector<Spectrum>> spectra_of(const std::vector<Sweep>& sweeps, const Eigen::MatrixXd& gains) {
  std::vector<std::vector<Spectrum>> spectra;
  for (const Sweep& sweep : sweeps) {
    spectra.emplace_back();
    for (Eigen::Index g = 0; g < gains.cols(); ++g) {
      spectra.back().push_back(spectrum_of(on_grid(sweep, gains.col(g)), sweep.whole_turn));
    }
  }
  return spectra;
}

// Columns freed of a basis and made orthonormal; those of which nothing is left become 0.
Eigen::MatrixXd freed(Eigen::MatrixXd columns, const Eigen::MatrixXd& basis) {
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    const double all = columns.col(j).squaredNorm();
    columns.col(j) -= basis * (basis.transpose() * columns.col(j));
    for (Eigen::Index i = 0; i < j; ++i) columns.col(j) -= columns.col(i) * columns.col(i).dot(columns.col(j));
    const double left = columns.col(j).squaredNorm();
    if (left > kNothingLeft * all) {
      columns.col(j) /= std::sqrt(left);
    } else {
      columns.col(j).setZero();
    }
  }
  return columns;
}

}  // namespace

std::optional<BestFake> best_trace_fake(const TracedEffect& traced, const Series& data,
                                        const std::vector<std::size_t>& rows, const Leftover& leftover,
                                        const Noise& noise, std::size_t count, std::uint64_t seed) {
  std::vector<Sweep> sweeps = sweeps_of(data, rows);
  const bool enough =
      std::all_of(sweeps.begin(), sweeps.end(), [](const Sweep& sweep) { return sweep.row.size() >= kFewestReadings; });
  if (!enough || traced.points.empty() || count == 0) return std::nullopt;
  group(sweeps, traced.added_um);
  const BoundInputs inputs = inputs_of(*traced.effect, traced.columns, data);
  std::vector<std::vector<std::vector<Spectrum>>> spectra;  // of each point, sweep, gain
  for (const std::vector<double>& point : traced.points) {
    spectra.push_back(spectra_of(sweeps, gains_at(*traced.effect, inputs.rows, point, rows)));
  }
  const Whitening whitening(noise, leftover.time_s, leftover.sigma_um);
  const Eigen::MatrixXd basis = orthonormal(whitened(whitening, leftover.model));
  Eigen::VectorXd r = whitened(whitening, leftover.residual_um);
  r -= basis * (basis.transpose() * r);
  const Eigen::MatrixXd plain_basis = orthonormal(leftover.model);
  const Eigen::VectorXd plain = leftover.residual_um - plain_basis * (plain_basis.transpose() * leftover.residual_um);
  const Eigen::VectorXd own = freed(whitened(whitening, traced.added_um), basis);
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 4);
  BestFake best;
  double most = 0.0;
  std::size_t alike = 0;
  Eigen::MatrixXd fake;
  for (std::size_t number = 0; number < count; ++number) {
    std::vector<std::vector<double>> phases;  // of each group
    for (std::size_t s = 0; s < sweeps.size(); ++s) phases.push_back(random_phases(kGrid, random));
    bool is_itself = false;
    for (const std::vector<std::vector<Spectrum>>& point : spectra) {
      fake.resize(static_cast<Eigen::Index>(rows.size()), static_cast<Eigen::Index>(point.front().size()));
      for (std::size_t s = 0; s < sweeps.size(); ++s) {
        for (std::size_t g = 0; g < point[s].size(); ++g) {
          Eigen::VectorXd column = fake.col(static_cast<Eigen::Index>(g));
          add_scrambled(sweeps[s], point[s][g], phases[sweeps[s].group], column);
          fake.col(static_cast<Eigen::Index>(g)) = column;
        }
      }
      const Eigen::MatrixXd white = freed(whitened(whitening, fake), basis);
      if ((white.transpose() * own).norm() > kItself) {
        is_itself = true;
        continue;
      }
      best.gain = std::max(best.gain, (white.transpose() * r).squaredNorm());
      most = std::max(most, (freed(fake, plain_basis).transpose() * plain).squaredNorm());
    }
    if (is_itself) ++alike;
  }
  if (static_cast<double>(alike) > kMostAlike * static_cast<double>(count)) return std::nullopt;
  best.fall = 1.0 - std::sqrt(std::max(0.0, 1.0 - most / std::max(plain.squaredNorm(), 1e-300)));
  return best;
}

}  // namespace ballbar
