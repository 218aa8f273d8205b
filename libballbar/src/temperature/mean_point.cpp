#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/temperature/temperature.hpp"
#include "numerics/interpolation.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

constexpr double kLeastStep_mm = 1e-6;
constexpr double kChord = 0.02;  // of L, to each side

void check_profile(const TemperatureProfile& profile) {
  const std::size_t n = profile.x_mm.size();
  if (n < 2 || profile.degC.size() != n) {
    throw Error(
        fmt::format("a temperature along x needs at least two places and as many temperatures; there are {} and {}", n,
                    profile.degC.size()));
  }
  for (std::size_t i = 0; i < n; ++i) {
    // Written so that what is not a number fails too.
    if (!(std::abs(profile.x_mm[i]) <= kLargestPlace_mm) || !(std::abs(profile.degC[i]) <= kLargest_degC)) {
      throw Error(
          fmt::format("a temperature along x must be finite, within {:g} degC and {:g} mm of 0; found {} degC at {} mm",
                      kLargest_degC, kLargestPlace_mm, profile.degC[i], profile.x_mm[i]));
    }
    if (i > 0 && !(profile.x_mm[i] - profile.x_mm[i - 1] >= kLeastStep_mm)) {
      throw Error(
          fmt::format("the places of a temperature along x must rise by at least {:g} mm; found {} mm after {} mm",
                      kLeastStep_mm, profile.x_mm[i], profile.x_mm[i - 1]));
    }
    if (profile.sigma_degC.size() != n) continue;
    if (!(profile.sigma_degC[i] >= 0.0 && profile.sigma_degC[i] <= kLargest_degC)) {
      throw Error(fmt::format("the sigma of a temperature along x must be 0 to {:g} degC; found {} degC at {} mm",
                              kLargest_degC, profile.sigma_degC[i], profile.x_mm[i]));
    }
  }
}

// Straight lines through (x, y), the end's value outside.
double line_at(const std::vector<double>& x, const std::vector<double>& y, double at) {
  return value_at(y, *place_of(x, std::clamp(at, x.front(), x.back())));
}

// Crossings, and stretches at the level, of the straight lines alone.
std::vector<MeanPoint> crossings(const TemperatureProfile& profile, double level_degC) {
  std::vector<MeanPoint> points;
  const auto add = [&](const MeanPoint& point) {
    if (!points.empty() && points.back().to_mm == point.from_mm) {  // one point of two lines, or a stretch goes on
      MeanPoint& last = points.back();
      // Where one of both lines is level, the point lies on it; else the mean of both slopes stands for a corner.
      const bool level = last.slope_degC_per_mm == 0.0 || point.slope_degC_per_mm == 0.0;
      last.slope_degC_per_mm = level ? 0.0 : 0.5 * (last.slope_degC_per_mm + point.slope_degC_per_mm);
      last.to_mm = point.to_mm;
      last.x_mm = 0.5 * (last.from_mm + last.to_mm);
    } else {
      points.push_back(point);
    }
  };
  for (std::size_t i = 1; i < profile.x_mm.size(); ++i) {
    const double p = profile.x_mm[i - 1], q = profile.x_mm[i];
    const double at_p = profile.degC[i - 1] - level_degC, at_q = profile.degC[i] - level_degC;
    const double slope = (at_q - at_p) / (q - p);
    if (at_p == 0.0 && at_q == 0.0) {
      add({.x_mm = 0.5 * (p + q), .from_mm = p, .to_mm = q});
    } else if (at_p == 0.0) {
      add({.x_mm = p, .from_mm = p, .to_mm = p, .slope_degC_per_mm = slope});
    } else if (at_q == 0.0) {
      add({.x_mm = q, .from_mm = q, .to_mm = q, .slope_degC_per_mm = slope});
    } else if ((at_p < 0.0) != (at_q < 0.0)) {
      const double x = std::clamp(p + (q - p) * at_p / (at_p - at_q), p, q);
      add({.x_mm = x, .from_mm = x, .to_mm = x, .slope_degC_per_mm = slope});
    }
  }
  return points;
}

// The largest distance of T from the level between two places.
double excursion(const TemperatureProfile& profile, double level_degC, double from_mm, double to_mm) {
  double largest = 0.0;
  for (std::size_t i = 0; i < profile.x_mm.size(); ++i) {
    if (profile.x_mm[i] <= from_mm || profile.x_mm[i] >= to_mm) continue;
    largest = std::max(largest, std::abs(profile.degC[i] - level_degC));
  }
  return largest;
}

// The point with its chord.
MeanPoint with_chord(const TemperatureProfile& profile, MeanPoint point) {
  const std::vector<double>& x = profile.x_mm;
  const double beyond = std::max(point.to_mm - point.from_mm, kChord * (x.back() - x.front()));
  double p = point.from_mm - beyond, q = point.to_mm + beyond;
  if (point.from_mm == point.to_mm) {
    const auto not_before = std::lower_bound(x.begin(), x.end(), point.x_mm);
    const auto behind = std::upper_bound(x.begin(), x.end(), point.x_mm);
    if (not_before != x.begin()) p = std::min(p, *(not_before - 1));
    if (behind != x.end()) q = std::max(q, *behind);
  }
  p = std::max(p, x.front());
  q = std::min(q, x.back());
  point.chord_from_mm = p;
  point.chord_to_mm = q;
  const bool level = point.from_mm < point.to_mm && point.slope_degC_per_mm == 0.0;
  if (!level) point.slope_degC_per_mm = (temperature_at(profile, q) - temperature_at(profile, p)) / (q - p);
  return point;
}

constexpr double kSame = 2.0;  // sigma: crossings not farther apart than that in T are one

}  // namespace

double length_mm(const TemperatureProfile& profile) {
  check_profile(profile);
  return profile.x_mm.back() - profile.x_mm.front();
}

double temperature_at(const TemperatureProfile& profile, double x_mm) {
  return line_at(profile.x_mm, profile.degC, x_mm);
}

double sigma_at(const TemperatureProfile& profile, double x_mm) {
  if (profile.sigma_degC.size() != profile.x_mm.size()) return kUnknown;
  return line_at(profile.x_mm, profile.sigma_degC, x_mm);
}

double mean_degC(const TemperatureProfile& profile) {
  double sum = 0.0;  // of T dx, in degC mm, twice
  const double length = length_mm(profile);
  for (std::size_t i = 1; i < profile.x_mm.size(); ++i) {
    sum += (profile.x_mm[i] - profile.x_mm[i - 1]) * (profile.degC[i - 1] + profile.degC[i]);
  }
  return 0.5 * sum / length;
}

double sigma_of_mean_degC(const TemperatureProfile& profile) {
  const double length = length_mm(profile);
  const std::size_t n = profile.x_mm.size();
  if (profile.sigma_degC.size() != n) return kUnknown;
  double sigma = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double w = 0.5 * (profile.x_mm[std::min(i + 1, n - 1)] - profile.x_mm[i == 0 ? 0 : i - 1]) / length;
    sigma += w * profile.sigma_degC[i];
  }
  return sigma;
}

double sigma_of_slope_degC_per_mm(const TemperatureProfile& profile, const MeanPoint& point) {
  const double p = point.chord_from_mm, q = point.chord_to_mm;
  return std::hypot(sigma_at(profile, p), sigma_at(profile, q)) / (q - p);
}

std::vector<MeanPoint> points_at(const TemperatureProfile& profile, double level_degC, double same_degC) {
  check_profile(profile);
  std::vector<MeanPoint> points;
  for (const MeanPoint& next : crossings(profile, level_degC)) {
    if (same_degC == 0.0 || points.empty() ||
        excursion(profile, level_degC, points.back().to_mm, next.from_mm) > same_degC) {
      points.push_back(next);
      continue;
    }
    MeanPoint& last = points.back();
    last.to_mm = next.to_mm;
    last.x_mm = 0.5 * (last.from_mm + last.to_mm);
    last.slope_degC_per_mm = kUnknown;  // until it has its chord
  }
  for (MeanPoint& point : points) point = with_chord(profile, point);
  return points;
}

std::vector<MeanPoint> mean_points(const TemperatureProfile& profile, double same_degC) {
  // A mean of equal temperatures may be off by its rounding: then it is still their own.
  const auto [low, high] = std::minmax_element(profile.degC.begin(), profile.degC.end());
  const double mean = mean_degC(profile);
  return points_at(profile, std::clamp(mean, *low, *high), same_degC);
}

double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K) {
  return 1e-3 * expansion_ppm_per_K * length_mm * rise_K;
}

double misplacement_um_per_mm(const TemperatureProfile& profile, const MeanPoint& point, double expansion_ppm_per_K) {
  return std::abs(mean_point_elongation_um(expansion_ppm_per_K, length_mm(profile), point.slope_degC_per_mm));
}

// Between two neighbouring places of all profiles every error e_k is a straight line in x, so the sum of squares is a
// parabola: with x = p + s (q - p), e_k = a_k + s b_k, its least is at s = - sum a b / sum b b.
BestPoint best_point(std::span<const TemperatureProfile> profiles, double expansion_ppm_per_K) {
  if (profiles.empty()) throw Error("a best point needs at least one temperature along x; there is none");
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  std::vector<double> places, means, um_per_K;
  for (const TemperatureProfile& profile : profiles) {
    means.push_back(mean_degC(profile));
    um_per_K.push_back(mean_point_elongation_um(expansion_ppm_per_K, length_mm(profile), 1.0));
    low = std::max(low, profile.x_mm.front());
    high = std::min(high, profile.x_mm.back());
    places.insert(places.end(), profile.x_mm.begin(), profile.x_mm.end());
  }
  if (!(high > low)) throw Error(fmt::format("the temperatures have no stretch in common; {} to {} mm", low, high));
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  std::erase_if(places, [&](double x) { return x < low || x > high; });

  const auto errors_at = [&](double x_mm) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < profiles.size(); ++k) {
      errors.push_back(um_per_K[k] * (line_at(profiles[k].x_mm, profiles[k].degC, x_mm) - means[k]));
    }
    return errors;
  };
  const auto squares = [](const std::vector<double>& errors) {
    double sum = 0.0;
    for (const double e : errors) sum += e * e;
    return sum;
  };
  BestPoint best{places.front(), 0.0, errors_at(places.front()), 0.0};
  std::vector<double> at_p = best.error_um;
  for (std::size_t i = 1; i < places.size(); ++i) {
    const double p = places[i - 1], q = places[i];
    std::vector<double> at_q = errors_at(q);
    double ab = 0.0, bb = 0.0;
    for (std::size_t k = 0; k < at_p.size(); ++k) {
      ab += at_p[k] * (at_q[k] - at_p[k]);
      bb += (at_q[k] - at_p[k]) * (at_q[k] - at_p[k]);
    }
    const double s = bb > 0.0 ? std::clamp(-ab / bb, 0.0, 1.0) : 0.0;
    const double x = p + s * (q - p);
    std::vector<double> errors = errors_at(x);
    if (squares(errors) < squares(best.error_um)) best = {x, 0.0, std::move(errors), 0.0};
    at_p = std::move(at_q);
  }
  best.rms_um = std::sqrt(squares(best.error_um) / static_cast<double>(best.error_um.size()));
  for (std::size_t k = 0; k < profiles.size(); ++k) {
    const MeanPoint here = with_chord(profiles[k], {.x_mm = best.x_mm, .from_mm = best.x_mm, .to_mm = best.x_mm});
    best.misplaced_um_per_mm = std::max(best.misplaced_um_per_mm, um_per_K[k] * std::abs(here.slope_degC_per_mm));
  }
  return best;
}

double same_degC(const TemperatureProfile& profile, double level_degC) {
  const std::vector<MeanPoint> crossings = points_at(profile, level_degC);
  if (crossings.empty() || profile.sigma_degC.empty()) return 0.0;
  return kSame * sigma_at(profile, crossings.front().x_mm);
}

TemperatureProfile with_step(TemperatureProfile profile, double step_degC) {
  for (double& sigma : profile.sigma_degC) sigma = std::hypot(sigma, step_degC / std::sqrt(12.0));
  return profile;
}

std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points) {
  std::stable_sort(points.begin(), points.end(), [](const MeanPoint& a, const MeanPoint& b) {
    return std::abs(a.slope_degC_per_mm) < std::abs(b.slope_degC_per_mm);
  });
  return points;
}

double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm) {
  const double along = sigma_at(profile, point.x_mm) / std::abs(point.slope_degC_per_mm);
  return std::hypot(along, edge_sigma_mm, 0.5 * (point.to_mm - point.from_mm));
}

}  // namespace ballbar
