// Ballbar tests with known errors of the axes, from plain formulas: none of the library's effects is asked. In um,
// c = cos theta, s = sin theta, D = +1 CCW and -1 CW, sA = - sgn(s) D and sB = sgn(c) D the signs of the axes'
// velocities, v the feed in um/ms, R in m where a squareness in um/m stands:
//
//   scale + a c + b s + MM/4 cos 2th - SQ R/2 sin 2th + STA/4 sin 3th - STB/4 cos 3th
//   + D (SM v/2 sin 2th + S4/2 sin 4th + (RC + SHA c + SHB s)/2)
//   - BA(c)/2 sA c - BB(s)/2 sB s + LA(c)/2 sA s + LB(s)/2 sB c,   BA(x) = pos (1 + x)/2 + neg (1 - x)/2, likewise all
//   + c E/2 sin(2 pi R c / p + phase), with s that of B;           E forwards and backwards
//   + h exp(- d / w) after each reversal, d the angle since;  cubic: K/2 cos 4th + Q/2 sin 4th
//
// and the exact length where a centre is large: |(a, b) + (R + scale) (c, s)|.
#pragma once

#include <cmath>
#include <initializer_list>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar::made {

struct ErrorTest {
  std::map<std::string, double> errors;  // by the names of the table; what is not named is 0
  double radius_mm = 150.0;
  double feed_mm_per_min = 1000.0;
  double readings_a_second = 60.0;
  double first_deg = 180.0, arc_deg = 360.0;
  double pitch_a_mm = 10.0, pitch_b_mm = 10.0;
  bool pitch_stated = true;
  double phase_a_rad = 1.0, phase_b_rad = 2.0;
  double spike_width_deg = 2.0;
  double step_width_deg = 0.0;     // over which play is taken up after a reversal
  double sixth_harmonic_um = 0.0;  // peak to peak, in the CCW run alone: no error of the catalogue
  double white_um = 0.0, memory_um = 0.0, memory_s = 0.4;
  double resolution_um = 0.0;

  double of(const std::string& name) const {
    const auto found = errors.find(name);
    return found == errors.end() ? 0.0 : found->second;
  }
  // Of the axis at x of its travel, -1 to 1.
  double along(const std::string& name, double x) const {
    return of(name + "_pos") * (1.0 + x) / 2.0 + of(name + "_neg") * (1.0 - x) / 2.0;
  }
};

// Noise as it is measured: white, and with a memory.
inline ErrorTest noisy(ErrorTest test) {
  test.white_um = 0.1;
  test.memory_um = 0.3;
  test.resolution_um = 0.01;
  return test;
}

inline ErrorTest full_turn() { return {}; }

// 220 deg about +B in the middle of 270 - 20 to 110: as instruments drive it in planes with a spindle.
inline ErrorTest arc_220() {
  ErrorTest test;
  test.radius_mm = 100.0;
  test.readings_a_second = 66.667;
  test.first_deg = 250.0;
  test.arc_deg = 220.0;
  return test;
}

inline double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0; }

// What the errors add to the bar's length at this angle.
inline double deviation_um(const ErrorTest& test, double angle_rad, Direction direction) {
  const double D = direction == Direction::CCW ? 1.0 : -1.0;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const double sA = -sign_of(s) * D, sB = sign_of(c) * D;
  const double v = test.feed_mm_per_min / 60.0, R = test.radius_mm;

  const double path_mm = R + 1e-3 * test.of("global_scale");
  double um =
      1e3 * (std::hypot(1e-3 * test.of("centre_a") + path_mm * c, 1e-3 * test.of("centre_b") + path_mm * s) - R);
  um += test.of("scale_mismatch") / 4.0 * std::cos(2.0 * angle_rad);
  um -= test.of("squareness") * 1e-3 * R / 2.0 * std::sin(2.0 * angle_rad);
  um += test.of("straightness_a") / 4.0 * std::sin(3.0 * angle_rad);
  um -= test.of("straightness_b") / 4.0 * std::cos(3.0 * angle_rad);
  um += D * test.of("servo_mismatch") * v / 2.0 * std::sin(2.0 * angle_rad);
  um += D * test.of("sin_4_theta") / 2.0 * std::sin(4.0 * angle_rad);
  um += D * (test.of("radius_change") + test.of("offset_a_shift") * c + test.of("offset_b_shift") * s) / 2.0;
  // The sign of the velocity where play is taken up: at first still the old one.
  const auto taken_up = [&](double sign, double plus_end_deg) {
    const double travelled_deg = D * (angle_rad * 180.0 / std::numbers::pi - plus_end_deg);
    const double since_deg = travelled_deg - 180.0 * std::floor(travelled_deg / 180.0);
    return since_deg < test.step_width_deg ? sign * (2.0 * since_deg / test.step_width_deg - 1.0) : sign;
  };
  um -= test.along("backlash_a", c) / 2.0 * taken_up(sA, 0.0) * c;
  um -= test.along("backlash_b", s) / 2.0 * taken_up(sB, 90.0) * s;
  um += test.along("lateral_play_a", c) / 2.0 * sA * s + test.along("lateral_play_b", s) / 2.0 * sB * c;
  const double a_um = test.of(sA > 0.0 ? "cyclic_error_a_fwd" : "cyclic_error_a_rev");
  const double b_um = test.of(sB > 0.0 ? "cyclic_error_b_fwd" : "cyclic_error_b_rev");
  um += c * a_um / 2.0 * std::sin(2.0 * std::numbers::pi * R * c / test.pitch_a_mm + test.phase_a_rad);
  um += s * b_um / 2.0 * std::sin(2.0 * std::numbers::pi * R * s / test.pitch_b_mm + test.phase_b_rad);
  // Travelled since each of the four reversals, 0 to 360 deg; the last one of an axis counts.
  const auto spike = [&](const std::string& axis, double plus_end_deg) {
    const double travelled_deg = D * (angle_rad * 180.0 / std::numbers::pi - plus_end_deg);
    const double since_deg = travelled_deg - 360.0 * std::floor(travelled_deg / 360.0);
    const bool plus = since_deg < 180.0;
    return test.of("reversal_spike_" + axis + (plus ? "_pos" : "_neg")) *
           std::exp(-(plus ? since_deg : since_deg - 180.0) / test.spike_width_deg);
  };
  um += spike("a", 0.0) + spike("b", 90.0);
  um += test.of("cubic_error_along") / 2.0 * std::cos(4.0 * angle_rad);
  um += test.of("cubic_error_across") / 2.0 * std::sin(4.0 * angle_rad);
  if (direction == Direction::CCW) um += test.sixth_harmonic_um / 2.0 * std::cos(6.0 * angle_rad + 0.5);
  return um;
}

inline Recording run_of(const ErrorTest& test, Direction direction, std::mt19937_64& random) {
  Recording recording;
  recording.nominal_length_mm = test.radius_mm;
  recording.direction = direction;
  recording.feed_mm_per_min = test.feed_mm_per_min;
  if (test.pitch_stated) recording.pitch_a_mm = test.pitch_a_mm, recording.pitch_b_mm = test.pitch_b_mm;
  const double arc_rad = test.arc_deg * std::numbers::pi / 180.0;
  const double whole_s = test.radius_mm * arc_rad / (test.feed_mm_per_min / 60.0);
  // A multiple of 44, so that no reading is at a reversal, where no sign is right: of 360 and of 220 deg.
  const auto n = 44 * static_cast<std::size_t>(std::lround(whole_s * test.readings_a_second / 44.0));
  std::normal_distribution<double> normal;
  double memory_um = test.memory_um * normal(random);
  const double kept = std::exp(-1.0 / (test.readings_a_second * test.memory_s));
  recording.angle_rad.reserve(n);
  recording.length_mm.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double turned_deg = (static_cast<double>(i) + 0.5) * test.arc_deg / static_cast<double>(n);
    double angle_deg = test.first_deg + (direction == Direction::CCW ? turned_deg : test.arc_deg - turned_deg);
    angle_deg -= 360.0 * std::floor(angle_deg / 360.0);
    const double angle_rad = angle_deg * std::numbers::pi / 180.0;
    double um = deviation_um(test, angle_rad, direction) + memory_um + test.white_um * normal(random);
    memory_um = kept * memory_um + test.memory_um * std::sqrt(1.0 - kept * kept) * normal(random);
    if (test.resolution_um > 0.0) um = test.resolution_um * std::round(um / test.resolution_um);
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(test.radius_mm + 1e-3 * um);
  }
  return recording;
}

inline std::vector<Recording> both_runs(const ErrorTest& test, std::mt19937_64& random) {
  std::vector<Recording> recordings;
  recordings.push_back(run_of(test, Direction::CCW, random));
  recordings.push_back(run_of(test, Direction::CW, random));
  return recordings;
}

inline std::vector<Recording> both_runs(const ErrorTest& test, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  return both_runs(test, random);
}

}  // namespace ballbar::made
