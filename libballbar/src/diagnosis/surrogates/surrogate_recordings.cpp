#include "diagnosis/surrogates/surrogate_recordings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "ballbar/units.hpp"
#include "diagnosis/signatures/signature_library.hpp"
#include "diagnosis/surrogates/phase_randomised.hpp"
#include "effects/effect_at.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

constexpr double kNothingLeftOfASurrogate = 1e-6;  // share of its square, read off a grid, that is rounding
constexpr double kMostAreItself = 0.01;            // share of the surrogates
constexpr double kSurrogateIsItself = 0.95;        // coherence
constexpr double kSameOnRecordings = 0.01;         // share of the square by which curves on recordings may differ
constexpr std::size_t kFewestOfASweep = 16;        // readings
constexpr std::size_t kTraceGrid = 512;            // values over the angle

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
  return static_cast<double>(i) / static_cast<double>(sweep.whole_turn ? kTraceGrid : kTraceGrid - 1);
}

// A column of the fit's rows on the sweep's grid, straight lines between readings.
std::vector<double> on_grid(const Sweep& sweep, const Eigen::VectorXd& column) {
  std::vector<double> grid(kTraceGrid);
  const std::size_t n = sweep.row.size();
  std::size_t after = 0;
  for (std::size_t i = 0; i < kTraceGrid; ++i) {
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
  const double at = place * static_cast<double>(sweep.whole_turn ? kTraceGrid : kTraceGrid - 1);
  const auto left = std::min(kTraceGrid - 1, static_cast<std::size_t>(at));
  const std::size_t right = sweep.whole_turn ? (left + 1) % kTraceGrid : std::min(kTraceGrid - 1, left + 1);
  return grid[left] + (at - static_cast<double>(left)) * (grid[right] - grid[left]);
}

void add_phase_randomised(const Sweep& sweep, const Spectrum& spectrum, const std::vector<double>& phases,
                          Eigen::Ref<Eigen::VectorXd> column) {
  const std::vector<double> grid = phase_randomised(spectrum, phases);
  for (std::size_t i = 0; i < sweep.row.size(); ++i) column[sweep.row[i]] = at_reading(sweep, grid, sweep.place[i]);
}

// Sweeps on which the effect adds the same become one group.
void group(std::vector<Sweep>& sweeps, const Eigen::VectorXd& added_um) {
  std::vector<std::vector<double>> curves;
  std::size_t groups = 0;
  for (Sweep& sweep : sweeps) {
    curves.push_back(on_grid(sweep, added_um));
    sweep.group = groups;
    for (std::size_t before = 0; before + 1 < curves.size() && sweep.group == groups; ++before) {
      double distance = 0.0, square = 0.0;
      for (std::size_t i = 0; i < kTraceGrid; ++i) {
        distance += std::pow(curves.back()[i] - curves[before][i], 2);
        square += std::pow(curves.back()[i], 2);
      }
      const bool same = distance <= kSameOnRecordings * square && sweep.whole_turn == sweeps[before].whole_turn;
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

// Made orthonormal, as far as more than rounding is left of what each column was.
Eigen::MatrixXd orthonormal_of(Eigen::MatrixXd columns, const Eigen::RowVectorXd& square_before) {
  orthonormalise(columns, square_before, kNothingLeftOfASurrogate);
  return columns;
}

// Surrogates of one effect on some recordings, with the phases of each group of them drawn.
class Surrogates {
 public:
  Surrogates(std::vector<Sweep> sweeps, const SurrogateSource& traced, const EffectRows& inputs,
             const std::vector<std::size_t>& rows)
      : sweeps_(std::move(sweeps)), n_(static_cast<Eigen::Index>(rows.size())) {
    for (const std::vector<double>& point : traced.points) {
      spectra_.push_back(
          spectra_of(sweeps_, effect_at(*traced.bound.effect, inputs, point, rows).gains(*traced.bound.effect)));
    }
  }

  std::vector<std::vector<double>> phases(std::mt19937_64& random) const {
    std::vector<std::vector<double>> result;
    for (std::size_t s = 0; s < sweeps_.size(); ++s) result.push_back(random_phases(kTraceGrid, random));
    return result;
  }

  Eigen::Index width() const { return static_cast<Eigen::Index>(spectra_.front().front().size()); }  // gains

  // The columns of one point after those of the other.
  Eigen::MatrixXd at(const std::vector<std::vector<double>>& phases) const {
    Eigen::MatrixXd columns(n_, width() * static_cast<Eigen::Index>(spectra_.size()));
    Eigen::Index first = 0;
    for (const std::vector<std::vector<Spectrum>>& point : spectra_) {
      for (std::size_t s = 0; s < sweeps_.size(); ++s) {
        for (std::size_t g = 0; g < point[s].size(); ++g) {
          add_phase_randomised(sweeps_[s], point[s][g], phases[sweeps_[s].group],
                               columns.col(first + static_cast<Eigen::Index>(g)));
        }
      }
      first += width();
    }
    return columns;
  }

 private:
  std::vector<Sweep> sweeps_;
  Eigen::Index n_;
  std::vector<std::vector<std::vector<Spectrum>>> spectra_;  // of each point, sweep, gain
};

struct SurrogateFit {
  double gain = 0.0, fall = 0.0;  // of chi^2, of the square
  bool is_itself = false;
};

}  // namespace

std::optional<BestSurrogate> best_recording_surrogate(const SurrogateSource& traced, const Series& data,
                                                      const std::vector<std::size_t>& rows,
                                                      const Background& background, std::size_t count,
                                                      std::uint64_t seed) {
  std::vector<Sweep> sweeps = sweeps_of(data, rows);
  const bool enough =
      std::all_of(sweeps.begin(), sweeps.end(), [](const Sweep& sweep) { return sweep.row.size() >= kFewestOfASweep; });
  if (!enough || traced.points.empty() || count == 0) return std::nullopt;
  group(sweeps, traced.added_um);
  const BoundInputs inputs = inputs_of(*traced.bound.effect, traced.bound.columns, data);
  const Surrogates surrogates(std::move(sweeps), traced, inputs.rows, rows);
  const ModelProjection &white = background.white, &plain = background.plain;
  const Eigen::MatrixXd added = background.whiten(traced.added_um);
  const Eigen::VectorXd own = orthonormal_of(orthogonal_part(added, white.basis), added.colwise().squaredNorm());
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 4);
  std::vector<std::vector<std::vector<double>>> phases;
  for (std::size_t number = 0; number < count; ++number) phases.push_back(surrogates.phases(random));
  std::vector<SurrogateFit> found(count);
  in_parallel(count, [&](std::size_t number) {
    const Eigen::MatrixXd surrogate = surrogates.at(phases[number]), filtered = background.whiten(surrogate);
    const Eigen::RowVectorXd square = filtered.colwise().squaredNorm(),
                             plain_square = surrogate.colwise().squaredNorm();
    const Eigen::MatrixXd left = orthogonal_part(filtered, white.basis),
                          plain_left = orthogonal_part(surrogate, plain.basis);
    SurrogateFit& one = found[number];
    for (Eigen::Index first = 0; first < surrogate.cols(); first += surrogates.width()) {
      const Eigen::MatrixXd u =
          orthonormal_of(left.middleCols(first, surrogates.width()), square.segment(first, surrogates.width()));
      if ((u.transpose() * own).norm() > kSurrogateIsItself) {
        one.is_itself = true;
        continue;
      }
      const Eigen::MatrixXd v = orthonormal_of(plain_left.middleCols(first, surrogates.width()),
                                               plain_square.segment(first, surrogates.width()));
      one.gain = std::max(one.gain, (u.transpose() * white.residual).squaredNorm());
      one.fall = std::max(one.fall, (v.transpose() * plain.residual).squaredNorm());
    }
  });
  BestSurrogate best;
  double most = 0.0;
  std::size_t copies = 0;
  for (const SurrogateFit& one : found) {
    best.gain = std::max(best.gain, one.gain);
    most = std::max(most, one.fall);
    copies += one.is_itself ? 1 : 0;
  }
  if (static_cast<double>(copies) > kMostAreItself * static_cast<double>(count)) return std::nullopt;
  best.fall = 1.0 - std::sqrt(std::max(0.0, 1.0 - most / std::max(plain.residual.squaredNorm(), 1e-300)));
  return best;
}

}  // namespace ballbar
