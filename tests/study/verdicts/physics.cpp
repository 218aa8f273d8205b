#include "physics.hpp"

#include <algorithm>
#include <cmath>

namespace ballbar::verdicts {
namespace {

template <class Value>
Track track_of(std::size_t length, Value value) {
  Track result(length);
  for (std::size_t i = 0; i < length; ++i) result[i] = value(i);
  return result;
}

}  // namespace

Track low_pass(const Track& input, double time_constant_s) {
  const double towards = -std::expm1(-1.0 / time_constant_s);
  double x = input[0];
  return track_of(input.size(), [&](std::size_t i) {
    const double now = x;
    x += towards * (input[i] - x);
    return now;
  });
}

Track power_of_speed(const Track& speed_rpm, double exponent) {
  return track_of(speed_rpm.size(),
                  [&](std::size_t i) { return speed_rpm[i] > 0.0 ? std::pow(speed_rpm[i] / 1000.0, exponent) : 0.0; });
}

Track rise(const Track& track) {
  return track_of(track.size(), [&](std::size_t i) { return track[i] - track[0]; });
}

Track difference(const Track& one, const Track& other) {
  return track_of(one.size(), [&](std::size_t i) { return one[i] - other[i]; });
}

Track heat_with_two_lags(const Track& speed_rpm, double exponent, double turning_s, double at_rest_s) {
  const Track heat = power_of_speed(speed_rpm, exponent);
  double x = heat[0];
  return track_of(heat.size(), [&](std::size_t i) {
    const double now = x;
    x += -std::expm1(-1.0 / (speed_rpm[i] > 0.0 ? turning_s : at_rest_s)) * (heat[i] - x);
    return now;
  });
}

Track thinning_friction(const Track& speed_rpm, const Track& temperature, double loss_per_K) {
  return track_of(speed_rpm.size(), [&](std::size_t i) {
    return speed_rpm[i] / 1000.0 * std::exp(-loss_per_K * (temperature[i] - temperature[0]));
  });
}

Track ring_growth(const Track& inner, const Track& outer) {
  constexpr double kAlpha_per_K = 13.6e-6, kInner_um = 27.34e3, kOuter_um = 37.66e3;
  return track_of(inner.size(), [&](std::size_t i) {
    return kAlpha_per_K * (kOuter_um * (outer[i] - outer[0]) - kInner_um * (inner[i] - inner[0]));
  });
}

Track beyond(const Track& track, double threshold) {
  return track_of(track.size(), [&](std::size_t i) { return std::max(0.0, track[i] - track[0] - threshold); });
}

Track held_back(const Track& track, double half_width) {
  double follower = 0.0;
  return track_of(track.size(), [&](std::size_t i) {
    const double u = track[i] - track[0];
    follower = std::clamp(follower, u - half_width, u + half_width);
    return follower - u;
  });
}

double range(const Track& track) {
  const auto [low, high] = std::minmax_element(track.begin(), track.end());
  return *high - *low;
}

}  // namespace ballbar::verdicts
