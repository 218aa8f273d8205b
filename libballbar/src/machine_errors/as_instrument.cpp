#include "machine_errors/as_instrument.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/units.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kStep_deg = 0.3;  // after a reversal: there the step of the play is not over

// Fine rows of the curve of the effects that are fitted together, play being taken up at once, and of the circles
// (nullptr).
Eigen::VectorXd curve_as_instrument(const JointErrorFit& fitted, const Effect* effect) {
  Eigen::VectorXd curve = Eigen::VectorXd::Zero(fitted.design.x.fine.rows());
  for (std::size_t k = 0; k < fitted.columns().size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    if (fitted.columns()[k].effect != effect || std::isnan(fitted.as_instrument[column])) continue;
    const bool is_first = column < fitted.at_once.cols();
    curve += fitted.as_instrument[column] * (is_first ? fitted.at_once.col(column) : fitted.design.x.fine.col(column));
  }
  return curve;
}

Eigen::VectorXd left_as_instrument(const JointErrorFit& fitted) {
  const std::vector<double>& deviation_um = find_column(fitted.rows.fine, "deviation_um")->values;
  Eigen::VectorXd left = Eigen::VectorXd::Map(deviation_um.data(), static_cast<Eigen::Index>(deviation_um.size())) -
                         curve_as_instrument(fitted, nullptr);
  for (const FittedEffect& effect : fitted.design.effects) {
    if (effect.effect->rules.error_fit == ErrorFit::together) left -= curve_as_instrument(fitted, effect.effect);
  }
  return left;
}

// The largest within reach after the reversal at this angle, of one recording; NaN: it does not pass there.
double spike_of(const JointErrorFit& fitted, const Eigen::VectorXd& left, double reversal_deg, std::size_t recording) {
  const std::vector<double>& angle_rad = find_column(fitted.rows.fine, trace_column("angle"))->values;
  const std::vector<double>& direction = find_column(fitted.rows.fine, trace_column("direction"))->values;
  double largest = kUnknown;
  for (std::size_t i = 0; i < angle_rad.size(); ++i) {
    if (fitted.rows.recording[fitted.rows.row_of[i]] != recording) continue;
    const double since_deg = direction[i] * std::remainder(deg_from_rad(angle_rad[i]) - reversal_deg, 360.0);
    if (since_deg < kStep_deg || since_deg > kNearReversal_deg) continue;
    const double value = left[static_cast<Eigen::Index>(i)];
    if (!(std::abs(value) <= std::abs(largest))) largest = value;
  }
  return largest;
}

}  // namespace

void add_spikes_as_instrument(JointErrorFit& fitted, CyclicOfRuns of_runs) {
  const Eigen::VectorXd left = left_as_instrument(fitted);
  for (const FittedEffect& effect : fitted.design.effects) {
    if (effect.effect->rules.error_fit != ErrorFit::at_reversals) continue;
    for (const std::size_t k : effect.columns) {
      const double half_turn_deg = fitted.columns()[k].gain == 0 ? 0.0 : 180.0;  // its + end first
      double largest = 0.0, sum = 0.0, count = 0.0;
      for (std::size_t recording = 0; recording < fitted.rows.recordings; ++recording) {
        const double one = spike_of(fitted, left, effect.effect->rules.reversal_deg + half_turn_deg, recording);
        if (std::isnan(one)) continue;
        if (std::abs(one) > std::abs(largest)) largest = one;
        sum += one;
        count += 1.0;
      }
      if (count == 0.0) continue;
      fitted.as_instrument[static_cast<Eigen::Index>(k)] = of_runs == CyclicOfRuns::mean ? sum / count : largest;
    }
  }
}

void add_ranks_as_instrument(const JointErrorFit& fitted, const std::vector<MachineError>& rows,
                             std::vector<RankedError>& ranked) {
  std::vector<InstrumentRank*> places;
  double sum_um = 0.0;
  for (RankedError& one : ranked) {
    const EffectRules& rules = one.effect->rules;
    if (rules.ranked_by_instrument == RankedByInstrument::never) continue;
    if (rules.ranked_by_instrument == RankedByInstrument::on_full_turns && !fitted.is_full) continue;
    double circularity_um = -1.0;
    if (rules.error_fit == ErrorFit::together) {
      const Eigen::VectorXd curve = curve_as_instrument(fitted, one.effect);
      circularity_um = curve.maxCoeff() - curve.minCoeff();
    } else {
      for (const std::size_t row : one.rows) {
        if (rows[row].as_instrument) circularity_um = std::max(circularity_um, std::abs(*rows[row].as_instrument));
      }
    }
    if (circularity_um < 0.0) continue;  // the software does not have it
    one.as_instrument = InstrumentRank{circularity_um};
    sum_um += circularity_um;
    places.push_back(&*one.as_instrument);
  }
  std::stable_sort(places.begin(), places.end(), [](const InstrumentRank* a, const InstrumentRank* b) {
    return a->individual_circularity_um > b->individual_circularity_um;
  });
  for (std::size_t k = 0; k < places.size(); ++k) {
    places[k]->rank = k + 1;
    places[k]->share_percent = sum_um > 0.0 ? 100.0 * places[k]->individual_circularity_um / sum_um : 0.0;
  }
}

}  // namespace ballbar
