// The errors of a machine's two axes from one ballbar test: all of them fitted together, ranked by what their
// correction gains, with the measurement that would separate those which the recordings do not tell apart.
//
// Accuracy (tests/study, machine_errors.cpp; full circles of 150 mm, 0.1 um of white and 0.3 um of correlated noise):
// 2 sigma hold each value in 91 to 98.5 %; play is within 10 % or 2 sigma in 95.5 %; squareness and servo mismatch of
// one direction are reported as a group in 100 %. On measured files the values agree with those that instrument
// software stores within their rounding, where that software determines them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// ---- The measurement that would separate errors which recordings do not tell apart.
//
// The share of the square of an error's curve that no combination of the circles and the other errors imitates is
// 1 / (N C) of that error, N = X' X over the readings and C its inverse. Below 2 % the readings do not tell the error
// from the others. Each recording is then repeated as the measurement would have it, with a circle of its own. If a
// share rises to 10 % or more, the measurement separates that error.

enum class Measurement { other_direction, full_circle, another_feed };
std::string_view name_of(Measurement measurement);  // "other_direction"

struct NextMeasurement {
  Measurement measurement = Measurement::other_direction;
  std::string error, other;  // names of the two that it separates best, "servo_mismatch", "centre_a"
};

struct ShapedEffect {
  const Effect* effect = nullptr;
  double shape = 0.0;  // of an effect that has one
};

// Of trace_of() recordings. The first Measurement that separates one of the effects; nullopt: all are separate, none of
// these measurements helps, or there are more than 24 recordings.
std::optional<NextMeasurement> next_measurement(const Series& trace, std::span<const ShapedEffect> effects);

// ---- The errors of a machine's two axes from one ballbar test, fitted together over all of its recordings.
//
// The model is linear in every error, so that one least squares fit gives them all (y: deviations in um, X: the curves
// of unit errors):
//
//   b = (X' X)^-1 X' y,      cov b = (X' X)^-1 X' V X (X' X)^-1
//
// The fit is unweighted, over the readings farther than 1.5 deg from a reversal. V is the covariance of the residual
// noise of this full model: white and correlated, by restricted likelihood, averaged over correlation length and share.
// A reversal spike is fitted to the residual of all others within 9 deg after its own reversal. If it is significant,
// these readings are left out of the fit of the others. Play is taken up over a width of 0 to 1.5 deg after a reversal;
// a spike needs a Bayes factor of 2 ln B >= 10 beside a step of any width, linear or exponential (heights N(0, 3 um),
// equal priors of the widths). The widths of steps and spikes and the pitch of the cyclic errors are the only shapes;
// all are searched on a grid.
//
// Errors that the readings cannot separate are groups (ErrorGroup). A group is a set of effects whose gains are
// correlated by more than 0.9. None of them is significant beside the others, and each is significant without them.
//
// Each value comes with the value that instrument software would give (`as_instrument`, no sigma): (X' X + L)^-1 X' y.
// The precisions L pull errors to 0 that an arc determines poorly. They are derived from stored values and curves. On
// an arc the curves use L too, and an error is significant only if it is so with L as well: two errors that an arc
// hardly separates can become large with opposite signs.
//
// The errors are the effects of the catalogue with EffectRules::error_fit. Each gain, or pair of sine and cosine, is
// one row of the table.
//
// Sources: the forward model is derived from simulated curves that instrument software stores in `.b5r` files; it
// reproduces them to 0.003 um. Sandwich covariance: H. White, Econometrica 48 (1980).

enum class CyclicOfRuns { larger, mean };

struct MachineErrorOptions {
  bool prior = true;  // false (`--prior none`): curves and significance on an arc do not use L
  // Compute sigmas of the gains, the residual error by error, its harmonics, and the next measurement; false: faster,
  // for many tests.
  bool details = true;
  // How to combine the amplitudes of the cyclic error of several recordings.
  CyclicOfRuns cyclic_of_runs = CyclicOfRuns::larger;
};

// One row of the table.
struct MachineError {
  std::string name;  // "squareness", "backlash_a_pos", "cyclic_error_a_fwd", "centre_a", "global_scale", ...
  std::string unit;  // "um", "um/m", "ms"
  double value = 0.0;
  double sigma = 0.0;
  const Effect* effect = nullptr;  // the effect; nullptr: a value of the circle (set-up or scale), which is not ranked
  std::optional<double> as_instrument = {};  // value of the instrument's software; nullopt: it has no such error
  bool determined = true;                    // false: one sigma alone moves the readings by more than the circularity
};

// The ranking that the instrument's software would give an effect.
struct InstrumentRank {
  double individual_circularity_um = 0.0;
  double share_percent = 0.0;  // of the sum over all ranked errors
  std::size_t rank = 0;        // 1: the largest circularity
};

// One effect with all of its rows, and its influence on the circle.
struct RankedError {
  const Effect* effect = nullptr;
  std::optional<double> shape;             // width of a spike or of a step of play, deg; pitch, mm
  std::vector<std::size_t> rows;           // indices into MachineErrors::errors
  double individual_circularity_um = 0.0;  // IC: peak to peak of its own curve over all recordings
  double share_percent = 0.0;              // of the sum of all IC
  std::optional<std::size_t> rank;         // 1: largest gain; nullopt: not significant, or no gain
  double chi2 = 0.0;                       // of all of its gains together; z^2 for one gain
  double chi2_needed = 0.0;                // the error is significant from this chi2 on
  double p_value = 1.0;                    // by all of its gains together or by the most significant one
  bool significant = false;                // p_value below its limit, corrected for the number of errors
  std::optional<bool> predicts_other_run;  // the value from one run lowers the residual of the other
  double circularity_without_um = 0.0;     // circularity if this error is corrected
  double gain_um = 0.0;                    // reduction of the circularity
  double gain_sigma_um = 0.0;              // by block bootstrap of the residual; NaN: not requested
  std::optional<InstrumentRank> as_instrument = {};
  std::optional<std::size_t> group = {};  // index into MachineErrors::groups; then not significant by itself
};

// Errors that the readings show together and cannot separate: one direction does not separate squareness and servo
// mismatch. It is found from the covariance of the joint fit: no member is significant beside the others, and each one
// is significant without them.
struct ErrorGroup {
  std::vector<const Effect*> effects;
  std::vector<MachineError> alone;         // the rows of each member, if it is the only one of the group
  double individual_circularity_um = 0.0;  // peak to peak of the curve of all members
  double sigma_um = 0.0;                   // of it
  double p_value = 1.0;                    // of its most significant member, corrected for their number
  std::optional<std::size_t> rank;         // among the significant errors; nullopt: no gain
  double circularity_without_um = 0.0;     // circularity if the members are corrected
  double gain_um = 0.0;
  double gain_sigma_um = 0.0;  // NaN: not requested
};

// "squareness_or_servo_mismatch"
std::string name_of(const ErrorGroup& group);

// A harmonic in the residual.
struct LeftHarmonic {
  int harmonic = 0;           // waves per turn
  std::size_t recording = 0;  // the one in which it is largest
  double peak_to_peak_um = 0.0;
  double p_value = 1.0;  // corrected for the number of harmonics and recordings
  bool in_both = false;  // also present in the other direction
};

// A combination of errors that the instrument's estimator pulls to 0.
struct PriorOfError {
  std::string name;
  double sigma = 0.0;                     // 0 +- sigma, in the row's unit
  double alone = 0.0, alone_sigma = 0.0;  // value from the readings without the prior
  std::string unit;
};

// One fitted gain of an effect, or of the circle (effect is nullptr; gain 0: radius, 1 and 2: centre).
struct FittedGain {
  const Effect* effect = nullptr;
  std::size_t gain = 0;                  // index among the effect's gains
  std::optional<std::size_t> recording;  // the one recording to which it belongs; nullopt: all
  double value = 0.0;
  double shape = 0.0;
  std::string name;        // of its row
  bool in_the_fit = true;  // false: not significant; the value is from the fit with all others
};

// A significant error, and the RMS of the residual after adding it to the earlier ones.
struct AddedError {
  const Effect* effect = nullptr;  // of a group its first member
  std::optional<std::size_t> group = {};
  double rms_um = 0.0;
};

struct MachineErrors {
  std::vector<MachineError> errors;
  Eigen::MatrixXd covariance;               // of the values in `errors`, in that order
  std::vector<RankedError> ranked;          // by rank, then the others by falling IC
  std::vector<ErrorGroup> groups;           // by rank, those without one last
  double circularity_um = 0.0;              // max - min of all readings about the centre: the fit's, or below half
                                            // a turn that of the least-squares circles
  double circularity_without_all_um = 0.0;  // circularity if all significant errors and groups are corrected
  double circle_rms_um = 0.0;               // residual of the circles alone
  double residual_rms_um = 0.0;             // residual of all errors
  // Significant errors in the order of forward selection: each step adds the one that lowers the residual most.
  std::vector<AddedError> one_by_one;
  double repeatability_um = 0.0;     // part of the residual that differs between directions; NaN: one direction
  std::optional<LeftHarmonic> left;  // a harmonic that the model does not explain; nullopt: none is significant
  // Errors that the readings cannot separate: "scale_mismatch with straightness_b, centre_a".
  std::vector<std::string> undetermined;
  std::optional<NextMeasurement> next;  // that would separate errors; nullopt: none, or not requested
  std::vector<PriorOfError> prior;      // of as_instrument
  std::vector<FittedGain> gains;
  std::vector<double> freed_um;  // deviation of each reading from the circle about its centre: n values
  Noise noise;                   // the most likely one
};

// Whether the error is proportional to the feed.
bool grows_with_feed(const Effect& effect);

// The scale errors of both axes, from the joint covariance of scale and mismatch.
struct AxisScales {
  double a_ppm = 0.0, b_ppm = 0.0;
  Eigen::Matrix2d covariance;  // ppm^2
};
// Returns nullopt where the readings do not determine them.
std::optional<AxisScales> axis_scales(const MachineErrors& found, double nominal_length_mm);

// The row of the squareness; nullopt: there is none.
std::optional<MachineError> squareness_of(const MachineErrors& found);

// Takes recordings of one plane, one bar and linear axes, from one test or several at the same place. Throws Error for
// others, and for too few readings. O(n) in readings; about 2 ms for 2 times 1500.
MachineErrors machine_errors(std::span<const Recording> recordings, const MachineErrorOptions& options = {});

// The same for trace_of() of such recordings.
MachineErrors machine_errors_of_trace(const Series& trace, const MachineErrorOptions& options = {});

// The contribution of one ranked error, or of all fitted errors without the circle (nullptr), to each reading in um; n
// values in the order of the recordings.
std::vector<double> curve_of(const MachineErrors& found, const Effect* effect, std::span<const Recording> recordings);

}  // namespace ballbar
