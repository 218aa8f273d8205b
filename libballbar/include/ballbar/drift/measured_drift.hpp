// A measured drift: a list of values for each axis, with an uncertainty budget by source (GUM).
//
// Every value is a change since the reference, and every sigma the standard uncertainty of that change. The
// sources are treated as independent, so that their variances add. At the reference value and sigma are 0.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/message.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

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
