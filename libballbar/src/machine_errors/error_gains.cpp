#include "machine_errors/error_gains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLeastGain_um = 0.05;
constexpr double kBlock_deg = 10.0;
constexpr Eigen::Index kDraws = 40;

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

// Errors that are corrected together: a single one, or those of a group.
struct Correction {
  Indices columns;
  Eigen::VectorXd curve;  // fine rows
};

// Fine rows as they are about the centre that fits them. In that of the fit an error adds nothing to it.
Eigen::VectorXd about_centre(const JointErrorFit& fitted, const Eigen::VectorXd& fine) {
  return fitted.centre_of_fit ? fine : fine - fitted.centre_curve(fine);
}

Correction correction_of(const JointErrorFit& fitted, const std::vector<const Effect*>& effects) {
  Correction one{{}, Eigen::VectorXd::Zero(fitted.design.x.fine.rows())};
  for (const FittedEffect& fit : fitted.design.effects) {
    // The fit explains a group by its members in the fit alone.
    const bool is_one = std::find(effects.begin(), effects.end(), fit.effect) != effects.end();
    if (!is_one || (effects.size() > 1 && !fit.in_the_fit)) continue;
    one.curve += fitted.fine_curve(fit.effect);
    one.columns.insert(one.columns.end(), fit.columns.begin(), fit.columns.end());
  }
  one.curve = about_centre(fitted, one.curve);
  return one;
}

// Sigma of the gain of each correction.
std::vector<double> gain_sigmas_um(const std::vector<Correction>& corrections, const JointErrorFit& fitted,
                                   const Extremes& extremes) {
  // The readings in the middle of their row: what they scatter within it stays.
  Eigen::VectorXd left = 0.5 * (extremes.largest + extremes.smallest);
  for (const FittedEffect& effect : fitted.design.effects) {
    if (effect.in_the_fit) left -= about_centre(fitted, fitted.fine_curve(effect.effect));
  }
  const Blocks blocks(fitted);
  std::mt19937_64 random(1);
  Eigen::MatrixXd drawn(kDraws, static_cast<Eigen::Index>(corrections.size()));
  for (Eigen::Index draw = 0; draw < kDraws; ++draw) {
    Eigen::VectorXd change = blocks.drawn(left, random) - left;
    const Eigen::VectorXd gains = fitted.map * (fitted.design.z.transpose() * fitted.rows.means(change));
    change -= fitted.centre_curve(change);
    const Extremes now{extremes.largest + change, extremes.smallest + change};
    const double circularity_um = now.range_without(Eigen::VectorXd::Zero(change.size()));
    for (std::size_t k = 0; k < corrections.size(); ++k) {
      const auto& [columns, curve] = corrections[k];
      const Eigen::VectorXd shift = fitted.design.x.fine(Eigen::all, columns) * gains(columns);
      const double without_um = now.range_without(curve + about_centre(fitted, shift));
      drawn(draw, static_cast<Eigen::Index>(k)) = circularity_um - without_um;
    }
  }
  std::vector<double> sigmas;
  for (const auto& gains : drawn.colwise())
    sigmas.push_back(std::sqrt((gains.array() - gains.mean()).square().sum() / (kDraws - 1.0)));
  return sigmas;
}

bool has_rank(const RankedError& one) { return one.significant && one.gain_um >= kLeastGain_um; }
bool has_rank(const ErrorGroup& one) { return one.gain_um >= kLeastGain_um; }

// Ranks of the errors and groups together.
void rank(std::vector<RankedError>& ranked, std::vector<ErrorGroup>& groups) {
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedError& a, const RankedError& b) {
    if (has_rank(a) != has_rank(b)) return has_rank(a);
    return has_rank(a) ? a.gain_um > b.gain_um : a.individual_circularity_um > b.individual_circularity_um;
  });
  std::vector<std::pair<double, std::optional<std::size_t>*>> places;
  for (RankedError& one : ranked) {
    if (has_rank(one)) places.emplace_back(one.gain_um, &one.rank);
  }
  for (ErrorGroup& one : groups) {
    if (has_rank(one)) places.emplace_back(one.gain_um, &one.rank);
  }
  std::stable_sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  for (std::size_t k = 0; k < places.size(); ++k) *places[k].second = k + 1;
  // Groups by rank, those without one last.
  std::vector<std::size_t> order(groups.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place_of = [&](std::size_t k) { return groups[k].rank.value_or(places.size() + 1); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place_of(a) < place_of(b); });
  std::vector<ErrorGroup> sorted;
  sorted.reserve(groups.size());
  for (const std::size_t k : order) sorted.push_back(std::move(groups[k]));
  groups = std::move(sorted);
  for (RankedError& one : ranked) {
    if (one.group)
      one.group = static_cast<std::size_t>(std::find(order.begin(), order.end(), *one.group) - order.begin());
  }
}

}  // namespace

void add_gains(MachineErrors& found, const JointErrorFit& fitted, bool with_sigmas) {
  const Extremes extremes = extremes_of(fitted.freed_um, fitted.rows);
  found.circularity_um = extremes.largest.maxCoeff() - extremes.smallest.minCoeff();
  std::vector<Correction> corrections;  // of significant errors and groups
  std::vector<double*> sigmas;
  Eigen::VectorXd all = Eigen::VectorXd::Zero(fitted.design.x.fine.rows());
  const auto correct = [&](auto& one, const std::vector<const Effect*>& effects, bool is_significant) {
    Correction correction = correction_of(fitted, effects);
    one.circularity_without_um = extremes.range_without(correction.curve);
    one.gain_um = found.circularity_um - one.circularity_without_um;
    one.gain_sigma_um = kUnknown;
    if (!is_significant) return;
    all += correction.curve;
    corrections.push_back(std::move(correction));
    sigmas.push_back(&one.gain_sigma_um);
  };
  for (RankedError& one : found.ranked) correct(one, {one.effect}, one.significant);
  for (ErrorGroup& one : found.groups) correct(one, one.effects, true);
  found.circularity_without_all_um = extremes.range_without(all);
  if (with_sigmas) {
    const std::vector<double> of_gains = gain_sigmas_um(corrections, fitted, extremes);
    for (std::size_t k = 0; k < sigmas.size(); ++k) *sigmas[k] = of_gains[k];
  }
  rank(found.ranked, found.groups);
}

}  // namespace ballbar
