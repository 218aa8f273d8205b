// A ballbar recording in numbers: the circle with its uncertainty, the length of an axial recording, and the quantities
// of ISO 230-4 (G, F, H, D).
//
//   fit_circle()     centre, radius, covariance            a path of at least 5 deg
//   axial_length()   mean length                           a bar along the spindle's axis
//   circularity()    G, F max, F min of one direction      about a fitted circle
//   bidirectional()  G of both directions, H, D            of a CCW and a CW recording
//
// Accuracy. Of simulated full circles, 1500 readings of 100 mm with noise of 0.2 um, the intervals of 95 % hold centre
// and radius in 93 to 97 %, at an autocorrelation of 0.9 in 90 to 97 %; the bias is below 0.005 um (tests/study,
// circle.cpp). Of arcs of 60 to 300 deg with an oval 2 sigma hold the centre in 95 to 99 % (arc.cpp). G differs from
// the values that instrument software stores by at most 0.1 um on the measured files (tests/external).
//
// Sources: length equation, He, Fu, Chen 2015 and Huang, Li, Zhao 2022; quantities, ISO 230-4.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"

namespace ballbar {

// sigma is that of the mean under the residual's autocorrelation (as in circle.hpp); NaN for one reading.
struct AxialLength {
  double length_mm = 0.0;
  double sigma_um = 0.0;
  double rms_um = 0.0;  // of the readings about their mean
  double autocorrelation = 0.0;
};

// Throws Error for a circle recording or one without readings.
AxialLength axial_length(const Recording& recording);

// Elongation of the spindle in a spindle-rotation test (Huang, Li, Zhao 2022, section 4, eq. 34).
//
// While the spindle has grown by dL normal to the plane of the radial test, every length of that test is
// too long, because the bar no longer lies where it lay:
//
//   eq34   dr = r / cos(dL / r) - r                       balls level (h = 0), as printed in the paper
//   exact  dr = sqrt(R^2 + (h + dL)^2) - sqrt(R^2 + h^2)  rho = sqrt(L^2 - (h + dL)^2)
//
// At dL = 20 um, r = 100 mm, h = 0 both give 0.002 um; at h = 5 mm the exact form gives 1.0 um.

enum class ElongationForm { exact, eq34 };

// Size of the correction, um: how much longer the readings of a radial test are than at elongation_um = 0.
// radius_mm > 0 is the in-plane distance R from the axis to the table's ball (exact), or the bar's
// length r (eq34, which ignores height_offset_mm).
double elongation_correction_um(ElongationForm form, double radius_mm, double height_offset_mm, double elongation_um);

// ---- Fits a circle to the readings of one recording: centre, radius and their covariance.
//
// The length equation of recording.hpp is solved by Ceres for c = (a, b) and R, in all readings at once;
// the algebraic circle (hyper) is the start. Instrument software reports another circle, the unweighted
// geometric one through the polar points (L cos theta, L sin theta): `CircleModel::polar`. They differ by
// about |c|^2 / 2R: nothing at 5 um of offset, 1.2 um at 0.5 mm on a 100 mm bar.
//
// Uncertainty. sigma of a reading comes from the residual; the covariance of a, b, R from Ceres. The
// residual of a machine's circle is not white, so the covariance is that of ordinary least squares under
// an autocorrelated residual,
//
//   C = s^2 H^-1 S H^-1,  H = sum J_i J_i',  S = sum_ij rho(|i-j|) J_i J_j',  rho(k) = q phi^k (k > 0),
//
// with phi and q from the residual's autocorrelation at lags 1 to 8 (ARMA(1,1): noise on top of a slow
// residual), s^2 = residual sum of squares / (n - trace(H^-1 S)). White residual: phi = 0, C = s^2 H^-1.
// A negative autocorrelation does not narrow the interval. Readings are taken as equally spaced in time for this.
//
// Arcs below 359 deg of linear axes. What the axes do to the path is an oval in the first place, and on an arc an oval
// looks like another centre: 2 um of it move the least-squares centre of 120 deg by up to 6 um. So centre and radius
// come from a Gaussian linear model of circle, form of the path and noise (src/circle/arc_estimate.hpp):
//
//   - cos 2 theta and sin 2 theta, each 0 +- s. s = 2.1 um at 100 mm is usual: 20 um/m, and 0.5 um whatever the radius.
//     Half of it, once, twice and four times are averaged by their likelihood.
//   - a third harmonic, which is most likely 0
//   - white noise, and noise that is correlated over up to a quarter of the arc, averaged likewise
//
// The polar circle keeps the values of the instrument's software, and its covariance is about these. On a full circle
// the form of the path does not move the centre; there, for rotary axes and for spindles the circle is fitted alone.
//
// Measured coverage of the intervals: tests/study, circle.cpp and arc.cpp.
//
// Throws Error: not a circle recording, fewer than 4 readings, arc under 5 deg, a reading shorter than
// the height difference of the balls. Linear time, at most 64 bytes a reading besides the recording.

enum class CircleModel { length_equation, polar };

struct CircleOptions {
  CircleModel model = CircleModel::length_equation;
  bool robust = false;         // Tukey's biweight, 95 % efficient at normal noise; holds while less
                               // than a quarter of the readings are off to one side
  double elongation_um = 0.0;  // dL of the spindle during this recording; corrected inside the fit
  ElongationForm elongation_form = ElongationForm::exact;
  bool oval = true;  // false: the least-squares circle of an arc too, for what its oval does not change: G of
                     // ISO 230-4, and the difference of two recordings of one path
};

struct Circle {
  CircleModel model = CircleModel::length_equation;
  double centre_a_um = 0.0;  // c: from the fixed ball to the path's centre
  double centre_b_um = 0.0;
  double radius_mm = 0.0;                                    // R
  Eigen::Matrix3d covariance_um2 = Eigen::Matrix3d::Zero();  // of (a, b, R); infinite where undetermined
  double sigma_reading_um = 0.0;                             // from the residual
  double rms_um = 0.0;                                       // of the residual; of an arc, of circle and oval
  double autocorrelation = 0.0;                              // phi, 0 where the residual is white
  double effective_readings = 0.0;        // n s^2(white) / s^2(autocorrelated) for the worst of a, b, R
  double oval_um = 0.0;                   // usual size of an oval that the values allow for; 0: none
  double elongation_correction_um = 0.0;  // absolute value of what was subtracted
  std::vector<std::size_t> discounted;    // robust: readings given less than a tenth of full weight
  std::size_t readings = 0;
  double arc_deg = 0.0;
  bool converged = false;
  std::string outcome;                // message of Ceres
  double height_mm = 0.0;             // h (+ dL) used in the fit; radii_mm() needs it
  double length_correction_um = 0.0;  // subtracted from every length before use (eq34)

  double sigma_centre_a_um() const;
  double sigma_centre_b_um() const;
  double sigma_radius_um() const;
  double correlation_a_b() const;  // NaN where undetermined
  double correlation_a_radius() const;
  double correlation_b_radius() const;
};

Circle fit_circle(const Recording& recording, const CircleOptions& options = {});

// Covariance of (a, b, R) of `now` minus those of `reference`, um^2. Where both recordings have the same angles in
// the same order, it comes from the difference of the two residuals: what repeats from test to test - the
// form of the path - cancels in the difference, and only what does not repeat makes it uncertain. Where
// the angles differ, the sum of the two covariances.
Eigen::Matrix3d covariance_of_change_um2(const Recording& now, const Circle& now_circle, const Recording& reference,
                                         const Circle& reference_circle);

// Radius of the path at each reading about the fitted centre, mm, n values: the r_i that solves the
// length equation, or the distance of the polar point from the centre.
Eigen::ArrayXd radii_mm(const Recording& recording, const Circle& circle);

// The residual of the fit: reading minus fitted length, um, n values.
Eigen::ArrayXd residual_um(const Recording& recording, const Circle& circle);

// A circle in the plane, in the units of the points.
struct PlaneCircle {
  double centre_x = 0.0;
  double centre_y = 0.0;
  double radius = 0.0;
  double rms = 0.0;  // of the distances of the points from the circle
};

// Algebraic circle: minimises sum (A z + B x + C y + D)^2, z = x^2 + y^2, under the constraint called hyper
// (Al-Sharadqah and Chernov 2009). QR and SVD; no iteration. Throws Error for fewer than 3 points or points
// on one line.
PlaneCircle algebraic_circle(const Eigen::ArrayXd& x, const Eigen::ArrayXd& y);

// ---- ISO 230-4 quantities of one circle or of a CCW/CW pair, as instrument software stores them.

// One direction. G is the range of radii about the least-squares centre; the extremes are given from the
// fitted radius (circular) and from the nominal length (radial, F), with the angle where they lie.
struct Circularity {
  double circular_deviation_um = 0.0;        // G = max - min, >= 0
  double circular_deviation_sigma_um = 0.0;  // of the two extreme readings and of the centre
  double max_circular_um = 0.0;
  double max_at_deg = 0.0;  // [0, 360)
  double min_circular_um = 0.0;
  double min_at_deg = 0.0;
  double max_radial_um = 0.0;  // F max: from the nominal circle
  double min_radial_um = 0.0;  // F min
};

// `circle`: the least-squares one (CircleOptions::oval = false on an arc) gives the G of ISO 230-4.
// sigma: the extremes are single readings, so each carries the readings' short-term noise
// (sigma of successive differences / sqrt 2); the centre's covariance adds its share. The range of n
// noisy readings is also biased upwards; that is not in sigma.
Circularity circularity(const Recording& recording, const Circle& circle);

// Whether the recordings are the two directions of one test: same plane, same length of the bar, same motion.
bool are_both_directions(const Recording& first, const Recording& second);

// Both directions of one test.
struct Bidirectional {
  double bidirectional_2005_um = 0.0;  // range of all radii about the mean of the two centres
  double bidirectional_1996_um = 0.0;  // the larger of the two G
  double mean_radial_um = 0.0;         // D: mean radius of both minus the nominal length
  double hysteresis_um = 0.0;          // H: largest |r_CCW - r_CW| at one angle, not re-centred
  double hysteresis_at_deg = 0.0;
};

// For H the recordings are interpolated at the CCW angles. Throws Error unless one is CCW and one CW,
// in one plane, with a common part of the arc.
Bidirectional bidirectional(const Recording& first, const Circle& first_circle, const Recording& second,
                            const Circle& second_circle);

}  // namespace ballbar
