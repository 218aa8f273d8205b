// The errors of a machine's two axes from one ballbar test: all of them fitted together, over all of its recordings.
//
// Linear in every error, so that one least squares gives them all (y: deviations in um, X: what a unit of each adds):
//
//   b = (X' X)^-1 X' y,      cov b = (X' X)^-1 X' V X (X' X)^-1
//
// Unweighted over the readings farther than 1.5 deg from a reversal. V is the covariance of the noise that this full
// model leaves: white and with a memory, by restricted likelihood, averaged over memory and share. A reversal spike is
// measured on what all others leave within 9 deg after its own reversal; where it shows, these readings are left out of
// the others' fit. The width of the spikes and the pitch of the cyclic errors are the only shapes; both are searched on
// a grid.
//
// Beside each value stands what instrument software would say (`as_instrument`): (X' X + L)^-1 X' y with precisions L
// that hold near 0 what an arc hardly tells, worked out from stored values and curves; no sigma. On an arc, curves are
// drawn with L too, and an error is significant only if it is so with L as well: two errors that the arc hardly tells
// apart are easily large ones against each other.
//
// Errors are the catalogue's effects with EffectRules::error_fit, one row a gain, or a pair of sine and cosine.
//
// Sources: the forward model is worked out from simulated curves that instrument software stores in `.b5r` files, which
// it reproduces to 0.003 um. Sandwich covariance: H. White, Econometrica 48 (1980).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/noise/noise.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class CyclicOfRuns { larger, mean };

struct MachineErrorOptions {
  bool prior = true;  // false, `--prior none`: on an arc curves and significance are without L
  // Sigmas of the gains, what is left error by error, and harmonics in it; false: faster, for tables of many tests.
  bool details = true;
  // What an amplitude of the cyclic error is of several recordings, each of which has its own.
  CyclicOfRuns cyclic_of_runs = CyclicOfRuns::larger;
};

// One row of the table.
struct MachineError {
  std::string name;  // "squareness", "backlash_a_pos", "cyclic_error_a_fwd", "centre_a", "global_scale", ...
  std::string unit;  // "um", "um/m", "ms"
  double value = 0.0;
  double sigma = 0.0;
  const Effect* effect = nullptr;  // whose it is; nullptr: of the circle (set-up and scale), which is not ranked
  std::optional<double> as_instrument = {};  // the value by the instrument's software; nothing: it has no such error
};

// What the instrument's software would say of an effect.
struct InstrumentRank {
  double individual_circularity_um = 0.0;
  double share_percent = 0.0;  // of the sum of all it ranks
  std::size_t rank = 0;        // 1: the largest circularity
};

// One effect with all of its rows: what the circle shows of it.
struct RankedError {
  const Effect* effect = nullptr;
  std::optional<double> shape;             // width of a spike, deg; pitch of a cyclic error, mm
  std::vector<std::size_t> rows;           // places in MachineErrors::errors
  double individual_circularity_um = 0.0;  // IC: peak to peak of its own curve over all recordings
  double share_percent = 0.0;              // of the sum of all IC
  std::optional<std::size_t> rank;         // 1: the largest gain; nothing: not significant, or the circularity stays
  double chi2 = 0.0;                       // of all of its gains together: z^2 of one
  double chi2_needed = 0.0;                // from which it is significant
  double p_value = 1.0;                    // of noise that shows as much, by all of its gains or by the clearest
  bool significant = false;                // p_value small enough for as many errors as were looked at
  std::optional<bool> predicts_other_run;  // its value from one run alone lowers what is left in the other
  double circularity_without_um = 0.0;     // that remains if it is mended
  double gain_um = 0.0;                    // circularity now less that
  double gain_sigma_um = 0.0;              // by resampled blocks of what is left; NaN: not asked for
  std::optional<InstrumentRank> as_instrument = {};
};

// A harmonic that is left in the residual.
struct LeftHarmonic {
  int harmonic = 0;           // waves a turn
  std::size_t recording = 0;  // the one in which it is largest
  double peak_to_peak_um = 0.0;
  double p_value = 1.0;  // after the number of harmonics and recordings looked at
  bool in_both = false;  // alike in the other direction too
};

// What the instrument's estimator holds near 0.
struct PriorOfError {
  std::string name;
  double sigma = 0.0;                     // 0 +- sigma, in the row's unit
  double alone = 0.0, alone_sigma = 0.0;  // by the readings alone
  std::string unit;
};

// One gain as it was fitted: of an effect, or of the circle (effect nullptr, gain 0 radius, 1 and 2 centre).
struct FittedGain {
  const Effect* effect = nullptr;
  std::size_t gain = 0;                  // among the effect's gains
  std::optional<std::size_t> recording;  // of this one alone
  double value = 0.0;
  double shape = 0.0;
  std::string name;        // of its row
  bool in_the_fit = true;  // false: did not show; its value is that beside all others
};

// A significant error and what is left once it is taken away too.
struct AddedError {
  const Effect* effect = nullptr;
  double rms_um = 0.0;
};

struct MachineErrors {
  std::vector<MachineError> errors;
  Eigen::MatrixXd covariance;               // of the values, in the order of errors
  std::vector<RankedError> ranked;          // by rank, then the others by falling IC
  double circularity_um = 0.0;              // max - min of all readings about the fitted centre
  double circularity_without_all_um = 0.0;  // that remains if all significant errors are mended
  double circle_rms_um = 0.0;               // that the circles alone leave
  double residual_rms_um = 0.0;             // that all errors leave
  // Significant errors one by one, each time the one that leaves least beside the circles and those before it.
  std::vector<AddedError> one_by_one;
  double repeatability_um = 0.0;     // what of the residual is not the same in both directions; NaN: one direction
  std::optional<LeftHarmonic> left;  // what the model does not explain; nothing: nothing clear
  // What the readings do not tell apart: "scale_mismatch with straightness_b, centre_a".
  std::vector<std::string> undetermined;
  std::vector<PriorOfError> prior;  // of as_instrument
  std::vector<FittedGain> gains;
  Noise noise;  // the most likely one
};

// Of both axes, from the joint covariance of scale and mismatch; nothing where the readings do not tell them.
struct AxisScales {
  double a_ppm = 0.0, b_ppm = 0.0;
  Eigen::Matrix2d covariance;  // ppm^2
};
std::optional<AxisScales> axis_scales(const MachineErrors& found, double nominal_length_mm);

// The row of the angle between the axes.
std::optional<MachineError> squareness_of(const MachineErrors& found);

// Recordings of one plane, one bar and linear axes, of one test or of several at the same place. Throws Error for
// others, and for fewer readings than the errors need. O(n) in readings, some 2 ms for 2 times 1500.
MachineErrors machine_errors(std::span<const Recording> recordings, const MachineErrorOptions& options = {});

// The same of trace_of() such recordings.
MachineErrors machine_errors_of_trace(const Series& trace, const MachineErrorOptions& options = {});

// What one ranked error, or all that are in the fit (nullptr; without the circle), adds to each reading, um; n in the
// order of the recordings.
std::vector<double> curve_of(const MachineErrors& found, const Effect* effect, std::span<const Recording> recordings);

}  // namespace ballbar
