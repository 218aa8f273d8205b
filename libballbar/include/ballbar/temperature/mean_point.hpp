// The best position for one sensor: the mean-value point of the temperature along a spindle.
//
//   eq. 20, 21   (T(xi) - T0) L = integral over L of (T(x) - T0) dx,     dL = alpha L (T(xi) - T0)
//
// A sensor at xi reads the mean temperature, and the axial elongation follows from this one reading. There may be
// several xi. A sensor misplaced by 1 mm causes an error of alpha L |dT/dx|, so that the xi with the smallest slope is
// the least sensitive. As the spindle warms up, T(x) changes its shape and xi moves; best_point() is one position for
// several states.
//
// T is linear between the samples; mean, points and best point are exact for this curve. An error of T that is the same
// everywhere (an offset of the scale) changes the mean but not xi.
//
// Source: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226, section 3.1. Of its table 1, model of dL, 16 of 17
// rows follow from eq. 21 to the printed digit; the row at 30.7 degC prints 18.50 um where it gives 18.40.
#pragma once

#include <span>
#include <vector>

namespace ballbar {

inline constexpr double kLargestPlace_mm = 1e6, kLargest_degC = 1e6;  // either side of 0: far beyond any machine

struct TemperatureProfile {
  std::vector<double> x_mm;        // n >= 2, rising by at least 1e-6 mm, within kLargestPlace_mm
  std::vector<double> degC;        // n, within kLargest_degC
  std::vector<double> sigma_degC;  // n, 0 to kLargest_degC, of each sample; empty: not known
};

double length_mm(const TemperatureProfile& profile);

// T at x; outside the profile that of the nearest end. O(log n). These two functions do not check the profile.
double temperature_at(const TemperatureProfile& profile, double x_mm);
double sigma_at(const TemperatureProfile& profile, double x_mm);  // NaN: not known

// (1 / L) integral of T dx.
double mean_degC(const TemperatureProfile& profile);

// The standard uncertainty of the mean if all samples have the same error, which is the upper limit: sum w_i sigma_i,
// where w_i is half the distance of the neighbours of x_i, over L. A common error (one scale, one camera, one
// reference) does not shrink with the number of samples. For n independent errors it would be about 1 / sqrt(n) of
// this. NaN if not known.
double sigma_of_mean_degC(const TemperatureProfile& profile);

// A point where T equals the level. At a crossing from_mm = x_mm = to_mm; if T stays at the level, x_mm is the middle
// of the interval.
//
// The slope is that of the chord (T(q) - T(p)) / (q - p), because the difference of neighbours is mostly scatter. p and
// q are 2 % of L before and behind, or at the samples on both sides if those are farther. Several crossings counted as
// one use their interval extended by its own length at both sides, if that is more. The slope is 0 where T stays at the
// level. Its sigma is hypot(sigma(p), sigma(q)) / (q - p); NaN if that of T is not known.
struct MeanPoint {
  double x_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;
  double slope_degC_per_mm = 0.0;
  double chord_from_mm = 0.0, chord_to_mm = 0.0;  // p, q
};
double sigma_of_slope_degC_per_mm(const TemperatureProfile& profile, const MeanPoint& point);

// All points where T equals the level, in rising order. Crossings between which T stays within same_degC (>= 0) of the
// level are one point, because a noisy curve crosses many times. The mean has at least one point. These functions and
// those below throw Error for a profile that is not as described above, or not finite.
std::vector<MeanPoint> points_at(const TemperatureProfile& profile, double level_degC, double same_degC = 0.0);
std::vector<MeanPoint> mean_points(const TemperatureProfile& profile, double same_degC = 0.0);

// Eq. 21: alpha L times the rise of the mean temperature.
double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K);

// alpha L |dT/dx|: error of dL in um per mm of misplacement of the sensor.
double misplacement_um_per_mm(const TemperatureProfile& profile, const MeanPoint& point, double expansion_ppm_per_K);

// The x, within all profiles, with the smallest root mean square of alpha L_k (T_k(x) - mean_k) over the profiles k;
// the lowest x if there are several.
struct BestPoint {
  double x_mm = 0.0;
  double rms_um = 0.0;
  std::vector<double> error_um;      // per profile: elongation from a sensor at x minus true elongation
  double misplaced_um_per_mm = 0.0;  // the largest alpha L_k |dT_k/dx| at x, slopes of chords as above
};
BestPoint best_point(std::span<const TemperatureProfile> profiles, double expansion_ppm_per_K);

// The uncertainty of a mean-value point, from a profile whose temperatures have a sigma.

// The tolerance for points_at(): two sigma of T, without the common error, where T first reaches the level. 0 if sigma
// is not known or T never reaches the level.
double same_degC(const TemperatureProfile& profile, double level_degC);

// The profile with the standard uncertainty of a scale with steps, step / sqrt(12), added to the sigma of T.
TemperatureProfile with_step(TemperatureProfile profile, double step_degC);

// Sorted by slope, the least sensitive to a misplaced sensor first.
std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points);

// sigma of xi = hypot(sigma of T over its slope, edge_sigma_mm, half the interval in which T cannot be distinguished
// from the mean). edge_sigma_mm is that of the ends of the profile. NaN if the sigma of T is not known.
double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm);

}  // namespace ballbar
