#include "ballbar/machine_errors/machine_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "machine_errors/as_instrument.hpp"
#include "machine_errors/error_fit.hpp"
#include "machine_errors/error_gains.hpp"
#include "machine_errors/error_ranks.hpp"
#include "machine_errors/error_set_up.hpp"
#include "machine_errors/left_harmonic.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kFewestReadings = 120;  // of a recording

void expect_one_plane(std::span<const Recording> recordings) {
  if (recordings.empty()) throw Error("expected recordings, found none.");
  const Recording& first = recordings.front();
  for (std::size_t k = 0; k < recordings.size(); ++k) {
    const Recording& one = recordings[k];
    const auto expected = [&](std::string_view what, std::string_view found) {
      throw Error(fmt::format("recording {}: expected {}, found {}.", k + 1, what, found));
    };
    if (one.kind != Kind::circle) expected("a circle", "an axial recording, which has no angles");
    if (one.motion != Motion::linear_axes) {
      expected("a circle that two linear axes drive, whose errors these are", name_of(one.motion));
    }
    if (one.plane != first.plane) {
      expected(fmt::format("the plane {} of the first, since each plane has errors of its own", name_of(first.plane)),
               name_of(one.plane));
    }
    if (one.nominal_length_mm != first.nominal_length_mm) {
      expected(fmt::format("the bar of {:g} mm of the first", first.nominal_length_mm),
               fmt::format("one of {:g} mm", one.nominal_length_mm));
    }
    if (one.length_mm.size() < kFewestReadings) {
      expected(fmt::format("at least {} readings", kFewestReadings), fmt::format("{}", one.length_mm.size()));
    }
  }
}

std::vector<AddedError> one_by_one(const JointErrorFit& fitted, const MachineErrors& found) {
  std::vector<std::pair<AddedError, std::vector<const Effect*>>> open;  // and what it stands for
  for (const RankedError& one : found.ranked) {
    if (one.significant) open.push_back({{one.effect}, {one.effect}});
  }
  for (std::size_t g = 0; g < found.groups.size(); ++g)
    open.push_back({{found.groups[g].effects.front(), g}, found.groups[g].effects});
  std::vector<AddedError> added;
  added.reserve(open.size());
  std::set<const Effect*> taken;
  while (!open.empty()) {
    for (auto& [one, effects] : open) {
      std::set<const Effect*> with = taken;
      with.insert(effects.begin(), effects.end());
      one.rms_um = rms_with_um(fitted, with);
    }
    const auto best = std::min_element(open.begin(), open.end(),
                                       [](const auto& a, const auto& b) { return a.first.rms_um < b.first.rms_um; });
    added.push_back(best->first);
    taken.insert(best->second.begin(), best->second.end());
    open.erase(best);
  }
  return added;
}

// Those of the fit that are not of the reversals or of the travel alone.
std::vector<ShapedEffect> smooth_errors(const JointErrorFit& fitted) {
  std::vector<ShapedEffect> errors;
  for (const FittedEffect& one : fitted.design.effects) {
    const ErrorFit kind = one.effect->rules.error_fit;
    if (!one.in_the_fit || (kind != ErrorFit::together && kind != ErrorFit::where_it_shows)) continue;
    errors.push_back({one.effect, one.shape.value_or(0.0)});
  }
  return errors;
}

}  // namespace

MachineErrors machine_errors(std::span<const Recording> recordings, const MachineErrorOptions& options) {
  expect_one_plane(recordings);
  return machine_errors_of_trace(trace_of(recordings), options);
}

MachineErrors machine_errors_of_trace(const Series& trace, const MachineErrorOptions& options) {
  const JointErrorFit fitted = joint_error_fit(trace, options);
  MachineErrors found;
  const ErrorTable table = error_table(fitted, options.cyclic_of_runs);
  found.errors = table.rows;
  found.covariance = table.covariance;
  found.ranked = ranked_errors(fitted, table);
  found.groups = error_groups(fitted);
  found.undetermined = fitted.undetermined;
  found.freed_um = fitted.freed_um;
  found.noise = fitted.noise.front().noise;
  found.prior.reserve(fitted.prior.size());
  for (const PriorStatement& statement : fitted.prior) {
    found.prior.push_back({statement.name, std::sqrt(fitted.slow_variance_um2 / statement.precision), statement.alone,
                           statement.alone_sigma, statement.unit});
  }
  const std::vector<bool> in_the_fit = fitted.in_the_fit();
  for (std::size_t k = 0; k < fitted.columns().size(); ++k) {
    const ErrorColumn& column = fitted.columns()[k];
    double shape = 0.0;
    for (const FittedEffect& effect : fitted.design.effects) {
      if (effect.effect == column.effect) shape = effect.shape.value_or(0.0);
    }
    found.gains.push_back({column.effect, column.gain, column.recording,
                           fitted.curve_gains[static_cast<Eigen::Index>(k)], shape, column.name, in_the_fit[k]});
  }
  add_ranks_as_instrument(fitted, found.errors, found.ranked);
  add_gains(found, fitted, options.details);
  for (std::size_t k = 0; k < found.errors.size(); ++k)
    found.errors[k].determined = table.extent_um[k] <= found.circularity_um;
  found.circle_rms_um = rms_with_um(fitted, {});
  if (options.details) found.one_by_one = one_by_one(fitted, found);
  const Eigen::VectorXd residual = fitted.residual();
  found.residual_rms_um = fitted.rms_um(residual);
  const double repeats_um = repeatability_um(fitted.rows, residual);
  found.repeatability_um = std::sqrt(fitted.within_um2 + repeats_um * repeats_um);  // of readings, as the residual
  if (options.details) {
    found.next = next_measurement(with_feed(trace), smooth_errors(fitted));
    const bool has_waves = longest_arc_rad(trace) >= kPi;  // a shorter arc does not separate its waves
    if (has_waves) found.left = left_harmonic(fitted.rows, fitted.design.x.values, residual, fitted.noise);
  }
  return found;
}

bool grows_with_feed(const Effect& effect) {
  return std::any_of(effect.inputs.begin(), effect.inputs.end(),
                     [](const Input& input) { return input.role == "feed"; });
}

std::string name_of(const ErrorGroup& group) {
  std::string name;
  for (const Effect* effect : group.effects) name += (name.empty() ? "" : "_or_") + effect->name;
  return name;
}

std::optional<AxisScales> axis_scales(const MachineErrors& found, double nominal_length_mm) {
  std::optional<std::size_t> scale, mismatch;
  for (std::size_t k = 0; k < found.errors.size(); ++k) {
    const Effect* effect = found.errors[k].effect;
    if (effect == nullptr && found.errors[k].name == "global_scale") scale = k;
    if (effect != nullptr && effect->rules.relation == AxisRelation::scale) mismatch = k;
  }
  if (!scale || !mismatch) return std::nullopt;
  // (scale +- mismatch / 4) / R; um over m are ppm
  const auto s = static_cast<Eigen::Index>(*scale), m = static_cast<Eigen::Index>(*mismatch);
  const double radius_m = 1e-3 * nominal_length_mm;
  Eigen::Matrix2d of_rows;
  of_rows << 1.0, 0.25, 1.0, -0.25;
  of_rows /= radius_m;
  Eigen::Matrix2d joint;
  joint << found.covariance(s, s), found.covariance(s, m), found.covariance(m, s), found.covariance(m, m);
  const Eigen::Vector2d scales = of_rows * Eigen::Vector2d(found.errors[*scale].value, found.errors[*mismatch].value);
  return AxisScales{scales[0], scales[1], of_rows * joint * of_rows.transpose()};
}

std::optional<MachineError> squareness_of(const MachineErrors& found) {
  for (const MachineError& error : found.errors) {
    if (error.effect != nullptr && error.effect->rules.relation == AxisRelation::angle) return error;
  }
  return std::nullopt;
}

std::vector<double> curve_of(const MachineErrors& found, const Effect* effect, std::span<const Recording> recordings) {
  const Series trace = with_feed(trace_of(recordings));
  const std::vector<double>& recording = find_column(trace, trace_column("recording"))->values;
  std::vector<double> curve(trace.time_s.size(), 0.0);
  Eigen::MatrixXd unit;
  const Effect* of = nullptr;
  for (const FittedGain& gain : found.gains) {
    if (gain.effect == nullptr || (effect != nullptr && gain.effect != effect)) continue;
    if (effect == nullptr && !gain.in_the_fit) continue;
    if (gain.effect != of) unit = unit_curves(*gain.effect, trace, gain.shape);
    of = gain.effect;
    for (std::size_t i = 0; i < curve.size(); ++i) {
      if (gain.recording && static_cast<double>(*gain.recording) != recording[i]) continue;
      curve[i] += gain.value * unit(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(gain.gain));
    }
  }
  return curve;
}

}  // namespace ballbar
