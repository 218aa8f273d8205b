#include "machine_errors/error_gains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "ballbar/circle/trace.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLeastGain_um = 0.05;
constexpr double kBlock_deg = 10.0;
constexpr int kDraws = 40;

// Largest and smallest reading of each fine row: what a curve that is constant in it makes of the circularity.
struct Extremes {
  Eigen::VectorXd largest, smallest;

  double range_without(const Eigen::VectorXd& curve) const {
    return (largest - curve).maxCoeff() - (smallest - curve).minCoeff();
  }
};

Extremes extremes_of(const std::vector<double>& freed, const ErrorRows& rows) {
  const auto n = static_cast<Eigen::Index>(rows.row_of.size());
  Extremes extremes{Eigen::VectorXd::Constant(n, -std::numeric_limits<double>::infinity()),
                    Eigen::VectorXd::Constant(n, std::numeric_limits<double>::infinity())};
  for (std::size_t i = 0; i < freed.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(rows.fine_of[i]);
    extremes.largest[row] = std::max(extremes.largest[row], freed[i]);
    extremes.smallest[row] = std::min(extremes.smallest[row], freed[i]);
  }
  return extremes;
}

// Rows of one recording, cut into blocks of equal angle; a drawn block is laid over another from its first row on.
struct Blocks {
  std::vector<std::vector<Eigen::Index>> rows;

  explicit Blocks(const JointErrorFit& fitted) {
    const std::vector<double>& angle_rad = find_column(fitted.rows.fine, trace_column("angle"))->values;
    std::size_t recording = fitted.rows.recordings;
    double first_rad = 0.0;
    for (std::size_t i = 0; i < angle_rad.size(); ++i) {
      const std::size_t of = fitted.rows.recording[fitted.rows.row_of[i]];
      if (of != recording || std::abs(angle_rad[i] - first_rad) > rad_from_deg(kBlock_deg)) {
        rows.emplace_back();
        recording = of;
        first_rad = angle_rad[i];
      }
      rows.back().push_back(static_cast<Eigen::Index>(i));
    }
  }

  Eigen::VectorXd drawn(const Eigen::VectorXd& left, std::mt19937_64& random) const {
    Eigen::VectorXd values(left.size());
    for (const std::vector<Eigen::Index>& block : rows) {
      const std::vector<Eigen::Index>& from = rows[random() % rows.size()];
      for (std::size_t k = 0; k < block.size(); ++k) values[block[k]] = left[from[k % from.size()]];
    }
    return values;
  }
};

struct Curves {
  std::vector<Eigen::VectorXd> of_each;  // in the order of the ranked errors
  Eigen::VectorXd significant;           // all of them together
};

Curves curves_of(const JointErrorFit& fitted, const std::vector<RankedError>& ranked) {
  Curves curves;
  curves.significant = Eigen::VectorXd::Zero(fitted.columns.fine.rows());
  for (const RankedError& one : ranked) {
    curves.of_each.push_back(fitted.fine_curve(one.effect));
    if (one.significant) curves.significant += curves.of_each.back();
  }
  return curves;
}

void add_sigmas(std::vector<RankedError>& ranked, const JointErrorFit& fitted, const Extremes& extremes,
                const Curves& curves) {
  // The readings in the middle of their row: what they scatter within it stays.
  const Eigen::VectorXd middle = 0.5 * (extremes.largest + extremes.smallest);
  Eigen::VectorXd fit = Eigen::VectorXd::Zero(middle.size());
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    const auto of = std::find_if(fitted.effects.begin(), fitted.effects.end(),
                                 [&](const FittedEffect& effect) { return effect.effect == ranked[k].effect; });
    if (of->in_the_fit) fit += curves.of_each[k];
  }
  const Eigen::VectorXd left = middle - fit;
  const Blocks blocks(fitted);
  std::mt19937_64 random(1);
  std::vector<double> sums(ranked.size(), 0.0), squares(ranked.size(), 0.0);
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd change = blocks.drawn(left, random) - left;
    const Eigen::VectorXd gains =
        fitted.map *
        (fitted.weighted.transpose() * fitted.rows.mean({change.data(), static_cast<std::size_t>(change.size())}));
    for (std::size_t c = 0; c < fitted.columns.columns.size(); ++c) {
      const auto column = static_cast<Eigen::Index>(c);
      if (is_centre(fitted.columns.columns[c])) change -= gains[column] * fitted.columns.fine.col(column);
    }
    const Extremes now{extremes.largest + change, extremes.smallest + change};
    const double circularity_um = now.range_without(Eigen::VectorXd::Zero(change.size()));
    for (std::size_t k = 0; k < ranked.size(); ++k) {
      if (!ranked[k].significant) continue;
      Eigen::VectorXd curve = curves.of_each[k];
      for (std::size_t c = 0; c < fitted.columns.columns.size(); ++c) {
        const auto column = static_cast<Eigen::Index>(c);
        if (fitted.columns.columns[c].effect == ranked[k].effect)
          curve += gains[column] * fitted.columns.fine.col(column);
      }
      const double gain = circularity_um - now.range_without(curve);
      sums[k] += gain;
      squares[k] += gain * gain;
    }
  }
  for (std::size_t k = 0; k < ranked.size(); ++k) {
    if (!ranked[k].significant) continue;
    const double mean = sums[k] / kDraws;
    ranked[k].gain_sigma_um = std::sqrt(std::max(0.0, squares[k] / kDraws - mean * mean) * kDraws / (kDraws - 1.0));
  }
}

void rank(std::vector<RankedError>& ranked) {
  const auto has_rank = [](const RankedError& one) { return one.significant && one.gain_um >= kLeastGain_um; };
  std::stable_sort(ranked.begin(), ranked.end(), [&](const RankedError& a, const RankedError& b) {
    if (has_rank(a) != has_rank(b)) return has_rank(a);
    return has_rank(a) ? a.gain_um > b.gain_um : a.individual_circularity_um > b.individual_circularity_um;
  });
  std::size_t place = 0;
  for (RankedError& one : ranked) {
    if (has_rank(one)) one.rank = ++place;
  }
}

}  // namespace

void add_gains(MachineErrors& found, const JointErrorFit& fitted, bool with_sigmas) {
  const Extremes extremes = extremes_of(fitted.freed_um, fitted.rows);
  const Curves curves = curves_of(fitted, found.ranked);
  found.circularity_um = extremes.largest.maxCoeff() - extremes.smallest.minCoeff();
  found.circularity_without_all_um = extremes.range_without(curves.significant);
  for (std::size_t k = 0; k < found.ranked.size(); ++k) {
    RankedError& one = found.ranked[k];
    one.circularity_without_um = extremes.range_without(curves.of_each[k]);
    one.gain_um = found.circularity_um - one.circularity_without_um;
    one.gain_sigma_um = kUnknown;
  }
  if (with_sigmas) add_sigmas(found.ranked, fitted, extremes, curves);
  rank(found.ranked);
}

}  // namespace ballbar
