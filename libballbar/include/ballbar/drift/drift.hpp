// Drift of the spindle relative to the table over the tests of a session.
//
// Every test gives a position; drift is its change since the reference test, so that constant set-up
// errors cancel:
//   moving_ball = spindle (linear axes drive the circle)                       drift = +(c_t - c_0)
//   moving_ball = table   (a rotary axis drives it, spindle ball near the axis) drift = -(c_t - c_0)
//
// two_arcs (He, Fu, Chen 2015). Spindle ball O = (x, y, z) from the point where the axes meet; the
// table's ball travels about C (plane XY) and about A (plane YZ); h_C, h_A height differences, 0 as printed:
//   L1^2 = (R_C cos t - x)^2 + (R_C sin t - y)^2 + (z - h_C)^2
//   L2^2 = (R_A cos t - y)^2 + (R_A sin t - z)^2 + (x - h_A)^2
// joint: both arcs in one Ceres problem, unknowns x, y, z, R_C, R_A, full covariance, each arc weighted
// by its own noise. sequential, as in the paper: arc 1 gives x, y; y enters arc 2, which gives z (its sigma
// includes that of y). robust: readings that the robust fit of each arc discounts are left out.
//
// spindle_rotation (Huang, Li, Zhao 2022). radial = |c_t - c_0|, the centre shift in the frame that turns
// with the spindle; radius_change: change of the distance from the axis to the table's ball, the
// fixed-frame drift along the bar; axial: elongation L_0 - L_t, positive towards the table
// (spindle_above; the other way round otherwise), which also corrects the radial test.
//
// circles. One or more circle recordings a test (a `.b5r` has two, CCW and CW): the centres of one
// plane are averaged with equal weights and give that plane's two axes. A test without readings uses its stored circles
// instead of fits; their sigma is not known (NaN). Each plane has its own reference, because tests may take the planes
// in turn. An axis that two planes of one test measure is averaged. On arcs the drift is that of the least-squares
// circles, because the oval of the path cancels; the position of a test allows for the oval (circle.hpp).
//
// Every sigma is that of the difference to the reference test (covariance_of_change_um2 of circle.hpp). A residual
// that repeats from test to test cancels. All rows share the contribution of the reference. The row of the reference is
// 0 by definition, with sigma 0. These do not cancel: drift of the table and of its rotary axes, thermal growth of the
// bar, a ball moved between tests.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/circle/recording.hpp"
#include "ballbar/message.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

enum class Method { two_arcs, spindle_rotation, circles };

struct SessionTest {
  double elapsed_s = 0.0;
  std::vector<Recording> circles;  // circles: one or more
  std::vector<Circle> stored;      //   stored circles of recordings without readings, sigma NaN; else empty
  std::optional<Recording> c_arc;  // two_arcs
  std::optional<Recording> a_arc;
  std::optional<Recording> rotation;  // spindle_rotation
  std::optional<Recording> axial;     //   or
  std::optional<double> axial_length_mm;
  std::string name;  // for messages: the file the test came from
};

struct Session {
  Method method = Method::circles;
  std::string title;
  double nominal_length_mm = 100.0;
  std::optional<double> bar_expansion_ppm_per_K;  // of the bar, where it is known
  bool spindle_above = true;
  std::vector<SessionTest> tests;  // elapsed_s strictly rising
};

struct DriftOptions {
  std::optional<double> reference_s;  // the nearest test is the reference; nullopt: the first
  bool sequential = false;            // two_arcs
  bool equal_radii = false;           // two_arcs, joint: R_C = R_A
  CircleOptions circle;               // robust, elongation_form; two_arcs ignores model; elongation_um is
                                      // set for each test
};

// A value and its standard uncertainty. sigma is NaN if not known (a length read off a display), and infinite if
// the readings do not determine the value.
struct Estimate {
  double value_um = 0.0;
  double sigma_um = 0.0;
};

struct DriftPoint {
  double time_s = 0.0;
  std::optional<Estimate> x, y, z;                 // two_arcs; circles as far as the plane goes
  std::optional<Estimate> radial, axial;           // spindle_rotation
  std::optional<Estimate> shift_a, shift_b;        // spindle_rotation: the components of radial, rotating frame
  std::optional<Estimate> radius_change;           // circle, or path about C
  std::optional<Estimate> radius_change_a;         // two_arcs: path about A
  std::optional<double> elongation_correction_um;  // spindle_rotation: taken off the radial test
  std::optional<double> correlation_y_z;           // two_arcs: of the test's own y and z
};

// A quantity that drifts, with its member of DriftPoint.
struct DriftQuantity {
  const char* name;
  std::optional<Estimate> DriftPoint::*member;
};
inline constexpr std::array kDriftQuantities{
    DriftQuantity{"x", &DriftPoint::x}, DriftQuantity{"y", &DriftPoint::y}, DriftQuantity{"z", &DriftPoint::z},
    DriftQuantity{"radial", &DriftPoint::radial}, DriftQuantity{"axial", &DriftPoint::axial}};

// The root of the sum of squares of x, y and z, as far as two of them or three are known; its sigma by the law of
// propagation, the axes as independent. It is never negative: noise alone gives about its own size.
std::optional<Estimate> combined_drift(const DriftPoint& point);

// Where the spindle ball was at each test, before the difference is taken (set-up errors included).
struct Position {
  double time_s = 0.0;
  std::optional<Estimate> x, y, z;             // two_arcs: from the point where the axes meet
  std::optional<Estimate> centre_a, centre_b;  // spindle_rotation and circles: c of the (first) plane
  std::optional<double> length_mm;             // spindle_rotation: axial length
  double radius_mm = 0.0;
  std::size_t discounted = 0;  // robust: readings discounted in this test
  bool converged = false;
};

struct DriftSeries {
  Method method = Method::circles;
  double reference_s = 0.0;
  std::vector<DriftPoint> points;   // one a test, in the order of time
  std::vector<Position> positions;  // same order
  Paragraph not_cancelled;          // a sentence for the report: what does not cancel
};

// Throws Error where a test lacks a recording its method needs, or a recording cannot be fitted; the
// sentence names the test.
DriftSeries drift_of(const Session& session, const DriftOptions& options = {});

std::string_view name_of(Method method);

// ---- A measured drift: a list of values for each axis, with an uncertainty budget by source (GUM).
//
// Every value is a change since the reference, and every sigma the standard uncertainty of that change. The
// sources are treated as independent, so that their variances add. At the reference value and sigma are 0.

struct Contribution {
  std::string source;         // "circle fits", "probe resolution"
  std::vector<double> sigma;  // n rows, in the axis' unit; NaN: not known
  bool shared = false;        // one error common to all rows, such as a scale error; sigma is its size in each row
  bool noise = false;         // found in the scatter of the rows, or rounding: a curve through many rows has less
};

struct DriftAxis {
  std::string name;                  // "x", "tilt_a": the column's name without its unit
  std::string unit;                  // "um", "urad"
  std::vector<double> value;         // n rows; a gap is NaN
  std::vector<Contribution> budget;  // empty: no uncertainty stated
};

struct MeasuredDrift {
  std::string what;    // "ballbar, two_arcs", or the file: for reports
  std::string method;  // "two_arcs", "five_probe", "log"
  double reference_s = 0.0;
  std::vector<double> time_s;  // n rows, strictly rising
  std::vector<DriftAxis> axes;
  std::vector<Paragraph> remarks;  // whole sentences: what is not known, what was assumed
};

// Root of the sum of squares of the known contributions in this row; NaN if none is known.
double sigma_of(const DriftAxis& axis, std::size_t row);

// The axis of that name, or nullptr.
const DriftAxis* find_axis(const MeasuredDrift& drift, std::string_view name);

// x, y, z, radial and axial of a ballbar session, with the sources
//   circle fits          the sigma of the drift series
//   bar's thermal growth alpha L |T_t - T_0| / sqrt(3), where the recordings state the bar's temperature and the
//                        session its expansion: limits of a rectangular distribution, because the readings are
//                        not corrected for it. It is 0 for x, y, z and radial: a bar longer by the same amount at
//                        all angles changes the fitted radius, not the centre. It enters axial drift in full.
MeasuredDrift measured(const DriftSeries& drift, const Session& session);

// Every measured column (unit um, mm or urad) of a series, its sigma from the column NAME_sigma_UNIT. The values are
// those of the columns: since_reference() makes changes of them.
// Throws Error: no row.
MeasuredDrift measured(const Series& series, std::string what);

// Changes since the value of each axis in the row nearest to reference_s (nullopt: the first), or in the first row
// after it that has one, else the last before it; mm become um. The sigma is that of the difference, the noise of the
// two rows as independent: the stated one, else the scatter of the rows, or their rounding if that is larger. Readings
// far from their neighbours (far_readings.hpp) become gaps, and an axis is left out that has no value, does not change,
// or changes by more than 1 mm, as a position does and no thermal drift; each with a remark.
MeasuredDrift since_reference(MeasuredDrift drift, std::optional<double> reference_s);

// Readings that were taken at a few positions in turn (a column of the series in mm or um that changes by more than 1
// mm, at most 12 values, 6 rows or more at each) become an axis a position, "error at 800 mm", where they scatter less
// than half as much about a slow drift there. Other rows are gaps. `drift` is that of the series.
MeasuredDrift at_each_position(MeasuredDrift drift, const Series& series);

// With the change of length between two positions: of two axes in um whose names have mm and differ in digits alone,
// the second less the first. Where readings take them in turn, the last one of each. Call it after since_reference().
MeasuredDrift with_lengths(MeasuredDrift drift);

// Columns NAME_UNIT and, where any is known, NAME_sigma_UNIT.
Series series_of(const MeasuredDrift& drift);

}  // namespace ballbar
