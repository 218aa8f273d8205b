// Where one sensor should sit: the mean-value point of a temperature along a spindle.
//
//   eq. 20, 21   (T(xi) - T0) L = integral over L of (T(x) - T0) dx,     dL = alpha L (T(xi) - T0)
//
// A sensor at xi reads the mean, and the axial elongation follows from that one reading. There may be several xi; at
// each, a sensor misplaced by 1 mm errs by alpha L |dT/dx|, so the flattest is the most forgiving. As the spindle warms
// T(x) changes its shape and xi moves: best_point is the one place for several states.
//
// Between the samples T is a straight line; mean, points and best point are exact for that line. Errors of T that are
// the same everywhere (an offset of the scale) move the mean but not xi.
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
  std::vector<double> sigma_degC;  // n, 0 to kLargest_degC, of each alone; empty where it is not known
};

double length_mm(const TemperatureProfile& profile);

// T at x; the end's outside the profile. O(log n): these two do not check the profile.
double temperature_at(const TemperatureProfile& profile, double x_mm);
double sigma_at(const TemperatureProfile& profile, double x_mm);  // NaN where it is not known

// (1 / L) integral of T dx.
double mean_degC(const TemperatureProfile& profile);

// Its standard uncertainty where all samples err alike, the most that it can be: sum w_i sigma_i, w_i the half of what
// lies between the neighbours of x_i over L. What errs alike - one scale, one camera, one reference - does not shrink
// with the number of samples; of n that err independently it is about 1 / root n of this. NaN where not known.
double sigma_of_mean_degC(const TemperatureProfile& profile);

// T equals the level. from_mm = x_mm = to_mm where it crosses; where it stays at the level, x_mm is the middle.
//
// The slope is that of the chord (T(q) - T(p)) / (q - p), for the difference of neighbours is mostly their scatter: p
// and q are 2 % of L before and behind, or the samples on both sides where those are farther; for several crossings as
// one, the stretch and as much again at both sides if that is more. It is 0 where T stays at the level. Its sigma is
// hypot(sigma(p), sigma(q)) / (q - p); NaN where that of T is not known.
struct MeanPoint {
  double x_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;
  double slope_degC_per_mm = 0.0;
  double chord_from_mm = 0.0, chord_to_mm = 0.0;  // p, q
};
double sigma_of_slope_degC_per_mm(const TemperatureProfile& profile, const MeanPoint& point);

// All points where T is the level, in rising order. Crossings between which T stays within same_degC (>= 0) of the
// level are one point: so many crossings of a curve with scatter are one. The mean has at least one point. These and
// those below throw Error for a profile that is not as above, or not finite.
std::vector<MeanPoint> points_at(const TemperatureProfile& profile, double level_degC, double same_degC = 0.0);
std::vector<MeanPoint> mean_points(const TemperatureProfile& profile, double same_degC = 0.0);

// Eq. 21, the rise that of the mean.
double mean_point_elongation_um(double expansion_ppm_per_K, double length_mm, double rise_K);

// alpha L |dT/dx|, um of dL for each mm that the sensor is off.
double misplacement_um_per_mm(const TemperatureProfile& profile, const MeanPoint& point, double expansion_ppm_per_K);

// The x that all profiles have in which the least root mean square of alpha L_k (T_k(x) - mean_k) over the profiles k
// is; the lowest x where there are several.
struct BestPoint {
  double x_mm = 0.0;
  double rms_um = 0.0;
  std::vector<double> error_um;      // one a profile: what a sensor at x tells less the elongation that is
  double misplaced_um_per_mm = 0.0;  // the largest alpha L_k |dT_k/dx| at x, slopes of chords as above
};
BestPoint best_point(std::span<const TemperatureProfile> profiles, double expansion_ppm_per_K);

// How well a mean-value point is known: its place from a profile whose temperatures have a sigma.

// Two sigma of T, without what all places share, where it first is at the level: crossings between which T stays within
// that are one point. 0 where sigma is not known or T never is at the level.
double same_degC(const TemperatureProfile& profile, double level_degC);

// With the standard uncertainty of a scale read in steps, step / root 12, in the sigma of T at each place.
TemperatureProfile with_step(TemperatureProfile profile, double step_degC);

// The most forgiving of a misplaced sensor first.
std::vector<MeanPoint> flattest_first(std::vector<MeanPoint> points);

// sigma of xi = hypot(sigma of T over its slope, edge_sigma_mm, half the stretch over which T cannot be told from the
// mean); edge_sigma_mm of the profile's ends. NaN where the sigma of T is not known.
double sigma_of_place_mm(const TemperatureProfile& profile, const MeanPoint& point, double edge_sigma_mm);

}  // namespace ballbar
