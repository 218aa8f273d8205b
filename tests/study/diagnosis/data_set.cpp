#include "data_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "ballbar/numerics/range.hpp"
#include "challenge/blind_parts.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar::study {
namespace {

constexpr double kLeastShare = 0.05;
constexpr double kLargestRange = 20.0;  // in sigmas, for d = 1
constexpr double kLargestCosine = 0.9;
constexpr int kMostTries = 1000;

double student(Random& random) {
  const double w = simulation::normal(random);
  double squares = 0.0;
  for (int i = 0; i < 4; ++i) squares += std::pow(simulation::normal(random), 2);
  return w / std::sqrt(squares / 4.0) / std::sqrt(2.0);
}

std::vector<double> drawn_noise(const DataSet& set, Random& random) {
  const Scatter& scatter = set.scatter;
  std::vector<double> values;
  if (!set.base.sigma_um.empty()) {
    for (const double sigma_um : set.base.sigma_um) values.push_back(sigma_um * simulation::normal(random));
    return values;
  }
  double last = simulation::normal(random);
  for (std::size_t i = 0; i < set.base.row.size(); ++i) {
    values.push_back(scatter.sigma_um * last);
    const double w = scatter.heavy ? student(random) : simulation::normal(random);
    last = scatter.phi * last + std::sqrt(1.0 - scatter.phi * scatter.phi) * w;
  }
  return values;
}

}  // namespace

DataSet data_set(const Record& record, std::vector<Injection> believed, const Scatter& scatter) {
  DataSet set;
  set.data = record.inputs;
  set.model.targets = {kTarget};
  set.scatter = scatter;
  const std::size_t rows = set.data.time_s.size();
  set.clean_um.assign(rows, 0.0);
  for (const Injection& one : believed) {
    set.model.terms.push_back(term_of(one.bound.effect->name, one.bound.columns));
    const std::vector<double> signal = signal_of(one, set.data);
    for (std::size_t i = 0; i < rows; ++i) set.clean_um[i] += signal[i];
  }
  set.believed = std::move(believed);

  Column target{kTarget, Role::measured, set.clean_um};
  if (!record.readings.empty()) {
    Column sigma{"y_sigma_um", Role::measured, std::vector<double>(rows, std::numeric_limits<double>::quiet_NaN())};
    target.values = sigma.values;
    for (std::size_t k = 0; k < record.readings.size(); ++k) {
      target.values[record.readings[k]] = set.clean_um[record.readings[k]];
      if (!record.sigma_um.empty()) sigma.values[record.readings[k]] = record.sigma_um[k];
    }
    if (!record.sigma_um.empty()) set.data.columns.push_back(std::move(sigma));
  }
  set.data.columns.push_back(std::move(target));
  set.base = fit(set.model, set.data, 0, {.white = true});
  if (set.base.sigma_um.empty()) {
    const double interval_s = set.base.time_s[1] - set.base.time_s[0];
    set.noise = {scatter.resolution_um / std::sqrt(12.0), scatter.sigma_um, -interval_s / std::log(scatter.phi), 0.0};
  }
  return set;
}

void finish(DataSet& set, Random& random) {
  for (const Hidden& hidden : set.hidden) {
    for (std::size_t i = 0; i < set.clean_um.size(); ++i) set.clean_um[i] += hidden.signal_um[i];
  }
  set.scatter_um = drawn_noise(set, random);
  for (std::size_t k = 0; k < set.base.row.size(); ++k) {
    const std::size_t row = set.base.row[k];
    set.data.columns.back().values[row] =
        simulation::rounded(set.clean_um[row] + set.scatter_um[k], set.scatter.resolution_um);
  }
}

std::vector<Injection> friction_heat() {
  return {{{find_effect("speed_heating", Level::series), {"speed_rpm"}}, {2.0, 2500.0, 5.0 / 3.0}}};
}

bool hide(DataSet& set, Hidden hidden, double d) {
  const Survival survival = survival_of(hidden.signal_um, set.base, set.noise);
  if (!(survival.share > kLeastShare) || !std::isfinite(survival.d)) return false;
  const double scale = d / survival.d;
  const double sigma_um = set.base.sigma_um.empty() ? set.scatter.sigma_um : set.base.sigma_um.front();
  if (!(scale * range_of(hidden.signal_um) < kLargestRange * d * sigma_um)) return false;
  for (const Hidden& other : set.hidden) {
    const Survival before = survival_of(other.signal_um, set.base, set.noise);
    const double along =
        std::inner_product(before.left.begin(), before.left.end(), survival.left.begin(), 0.0) / before.d / survival.d;
    if (std::abs(along) > kLargestCosine) return false;
  }
  for (double& value : hidden.signal_um) value *= scale;
  if (hidden.injection) {
    for (std::size_t k = 0; k < hidden.injection->parameters.size(); ++k) {
      if (hidden.injection->bound.effect->parameters[k].kind == ParameterKind::gain) {
        hidden.injection->parameters[k] *= scale;
      }
    }
  }
  set.hidden.push_back(std::move(hidden));
  return true;
}

bool hide_effects(DataSet& set, std::size_t count, double d, Random& random, const std::string& only,
                  const std::string& reads) {
  for (int tries = 0; set.hidden.size() < count; ++tries) {
    if (tries == kMostTries) return false;
    const std::optional<blind::Hidden> drawn = blind::drawn_effect(built_in_catalogue(), set.model, set.data, random);
    if (!drawn) continue;
    const BoundEffect& bound = *drawn->bound;
    if (!only.empty() && bound.effect->name != only) continue;
    if (!reads.empty() && std::find(bound.columns.begin(), bound.columns.end(), reads) == bound.columns.end()) continue;
    if (is_true(set, bound)) continue;
    hide(set, {Injection{bound, drawn->parameters}, drawn->what, drawn->signal_um}, d);
  }
  return true;
}

void log_also(DataSet& set, Column column) { set.data.columns.insert(set.data.columns.begin(), std::move(column)); }

bool hide_effect(DataSet& set, const BoundEffect& bound, double d, Random& random) {
  const Injection injection = blind::drawn_injection(bound, set.data, random);
  return hide(set, {injection, label_of(bound), signal_of(injection, set.data)}, d);
}

bool is_true(const DataSet& set, const BoundEffect& bound) {
  const auto is = [&](const BoundEffect& truth) {
    return truth.effect == bound.effect && (truth.columns.empty() || truth.columns == bound.columns);
  };
  return std::any_of(set.also_true.begin(), set.also_true.end(), is) ||
         std::any_of(set.hidden.begin(), set.hidden.end(), [&](const Hidden& hidden) {
           return (hidden.injection && hidden.injection->bound == bound) ||
                  std::any_of(hidden.match.begin(), hidden.match.end(), is);
         });
}

Hidden driven_outsider(const DataSet& set, std::size_t turn) {
  const std::vector<double>& speed = find_column(set.data, "speed_rpm")->values;
  const std::vector<double>& room = find_column(set.data, "T_room_degC")->values;
  const std::vector<double>& bearing = find_column(set.data, "T_bearing_degC")->values;
  std::vector<double> signal(speed.size(), 0.0);
  const char* what = "";
  for (std::size_t i = 0; i < signal.size(); ++i) {
    if (turn % 3 == 0) {
      what = "a product of the rises of bearing and room";
      signal[i] = (bearing[i] - bearing[0]) * (room[i] - room[0]);
    } else if (turn % 3 == 1) {
      what = "a square root of the speed";
      signal[i] = std::sqrt(speed[i]);
    } else if (i > 0) {
      what = "a square of the rate of the bearing's temperature";
      signal[i] = std::pow((bearing[i] - bearing[i - 1]) / (set.data.time_s[i] - set.data.time_s[i - 1]) * 60.0, 2);
    }
  }
  return {std::nullopt, what, std::move(signal)};
}

Hidden curve_of_time(const DataSet& set, Random& random) {
  std::vector<double> signal(set.data.time_s.size(), 0.0);
  for (int wave = 0; wave < 3; ++wave) {
    const double period_s = 3600.0 * blind::log_between(random, 2.0, 12.0);
    const double phase_rad = blind::between(random, 0.0, 2.0 * std::numbers::pi);
    for (std::size_t i = 0; i < signal.size(); ++i) {
      signal[i] += std::sin(2.0 * std::numbers::pi * set.data.time_s[i] / period_s + phase_rad);
    }
  }
  return {std::nullopt, "three sinusoids of time", std::move(signal)};
}

}  // namespace ballbar::study
