// Ballbar recordings with an effect of the catalogue hidden in them.
#pragma once

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/model/recording_base_model.hpp"

namespace ballbar::made {

struct Sweep {
  Direction direction = Direction::CCW;
  double feed_mm_per_min = 2000.0;
};

inline std::vector<Sweep> one_way() { return {{Direction::CCW, 2000.0}}; }
inline std::vector<Sweep> both_ways() { return {{Direction::CCW, 2000.0}, {Direction::CW, 2000.0}}; }
// A-B-B-A: what grows from sweep to sweep is no feed.
inline std::vector<Sweep> two_feeds() {
  return {{Direction::CCW, 2000.0}, {Direction::CW, 2000.0}, {Direction::CCW, 4000.0}, {Direction::CW, 4000.0},
          {Direction::CCW, 4000.0}, {Direction::CW, 4000.0}, {Direction::CCW, 2000.0}, {Direction::CW, 2000.0}};
}

struct Plan {
  std::vector<Sweep> sweeps = both_ways();
  std::size_t readings = 240;  // of each sweep
  double noise_um = 0.3;
  double detectability = 10.0;  // d of what is hidden, freed of the circles
};

// Full circles of 100 mm, a centre for each direction, a radius 5 um too large; the bar warms 0.2 K a sweep.
inline Series circles(const Plan& plan) {
  std::vector<Recording> recordings;
  for (const Sweep& sweep : plan.sweeps) {
    Recording recording;
    recording.direction = sweep.direction;
    recording.feed_mm_per_min = sweep.feed_mm_per_min;
    recording.bar_temperature_degC = 20.0 + 0.2 * static_cast<double>(recordings.size() % 3);
    const double sign = sweep.direction == Direction::CCW ? 1.0 : -1.0;
    for (std::size_t i = 0; i < plan.readings; ++i) {
      const double turn = (static_cast<double>(i) + 0.5) / static_cast<double>(plan.readings);
      const double angle = 2.0 * std::numbers::pi * (sign > 0.0 ? turn : 1.0 - turn);
      recording.angle_rad.push_back(angle);
      const double um = 5.0 + (12.0 + 0.3 * sign) * std::cos(angle) - 7.0 * std::sin(angle);
      recording.length_mm.push_back(100.0 + 1e-3 * um);
    }
    recordings.push_back(std::move(recording));
  }
  return trace_of(recordings);
}

inline Series circles(std::vector<Sweep> sweeps, std::size_t readings) {
  Plan plan;
  plan.sweeps = std::move(sweeps);
  plan.readings = readings;
  return circles(plan);
}

inline std::vector<std::size_t> all_rows(const Series& data) {
  std::vector<std::size_t> rows(data.time_s.size());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
  return rows;
}

// What the effect adds with these parameters.
inline Eigen::VectorXd added_um(const Term& term, const std::vector<double>& parameters, const Series& trace) {
  EffectRows rows{trace.time_s, {}};
  for (const std::string& name : term.columns) rows.inputs.emplace_back(find_column(trace, name)->values);
  std::vector<double> values(trace.time_s.size());
  term.effect->evaluate(rows, parameters.data(), values.data(), nullptr);
  return Eigen::VectorXd::Map(values.data(), static_cast<Eigen::Index>(values.size()));
}

// Gains drawn, shapes between points of their grid; waves that 120 readings a sweep show.
inline std::vector<double> drawn(const Effect& effect, const Series& trace, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  std::vector<double> parameters;
  for (const Parameter& parameter : effect.parameters) {
    if (parameter.kind == ParameterKind::gain) {
      const double gain = normal(random);
      parameters.push_back(gain + std::copysign(0.5, gain));
    } else if (parameter.name == "onset_s") {
      parameters.push_back(trace.time_s.back() * (0.2 + 0.6 * uniform(random)));
    } else if (parameter.name == "pitch_mm") {
      parameters.push_back(15.0 + 25.0 * uniform(random));
    } else if (parameter.name == "frequency_Hz") {
      parameters.push_back(1.2 + uniform(random));
    } else if (parameter.name == "lobes") {
      parameters.push_back(3.0 + std::floor(10.0 * uniform(random)));
    } else if (parameter.held || parameter.grid.size() < 2) {
      parameters.push_back(parameter.start);
    } else {
      const auto last = static_cast<double>(parameter.grid.size() - 1);
      const double place = last * (0.1 + 0.6 * uniform(random));
      const auto low = static_cast<std::size_t>(place);
      parameters.push_back(parameter.grid[low] +
                           (place - static_cast<double>(low)) * (parameter.grid[low + 1] - parameter.grid[low]));
    }
  }
  return parameters;
}

// `effect` hidden at the plan's d under white noise; nullptr: nothing. An effect that the circles make whole is hidden
// at 5 times the noise.
inline Series recordings(const Plan& plan, const Effect* effect, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal(0.0, plan.noise_um);
  Series trace = circles(plan);
  std::vector<double>& target = trace.columns.front().values;
  if (effect != nullptr) {
    const Term term = term_of(effect->name, {}, Level::recording);
    const std::vector<double> parameters = drawn(*effect, trace, random);
    const Eigen::VectorXd added = added_um(term, parameters, trace);
    const Fit base = fit(recording_base_model(trace), trace, 0, {.white = true});
    Eigen::Index free = 0;
    Eigen::MatrixXd columns(base.jacobian.rows(), base.jacobian.cols());
    for (Eigen::Index k = 0; k < base.jacobian.cols(); ++k) {
      if (base.parameters[static_cast<std::size_t>(k)].state != ParameterState::held) {
        columns.col(free++) = base.jacobian.col(k);
      }
    }
    columns.conservativeResize(Eigen::NoChange, free);
    const Eigen::VectorXd left = added - columns * columns.colPivHouseholderQr().solve(added);
    const double share = left.norm() / added.norm();
    const double scale = share > 1e-3 ? plan.detectability * plan.noise_um / left.norm()
                                      : 5.0 * plan.noise_um / added.cwiseAbs().maxCoeff();
    for (std::size_t i = 0; i < target.size(); ++i) target[i] += scale * added[static_cast<Eigen::Index>(i)];
  }
  for (double& value : target) value += normal(random);
  return trace;
}

}  // namespace ballbar::made
