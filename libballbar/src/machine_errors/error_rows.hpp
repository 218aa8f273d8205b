// Averages the readings of recordings to rows, to which the errors of a machine are fitted.
//
// There are two steps, because effects need a finer resolution than the least squares fit. Effects are evaluated on
// fine rows of up to 0.4 deg (single readings within 1.5 deg of a reversal). The fit uses rows of up to 1 deg, means of
// fine ones. No row crosses a reversal, or the limit of 1.5 deg from one.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr double kAtReversal_deg = 1.5;    // nearer readings do not show the path
inline constexpr double kNearReversal_deg = 9.0;  // length of a spike

struct ErrorRows {
  Series fine;                                                 // columns of trace_of, means of readings
  std::vector<std::size_t> fine_of;                            // n readings: their fine row
  std::vector<std::size_t> row_of;                             // of each fine row
  Eigen::VectorXd fine_count;                                  // readings of each fine row
  Eigen::VectorXd count;                                       // of each row
  Eigen::VectorXd interval_s;                                  // between the readings of its recording
  Eigen::VectorXd time_s, angle_rad, direction, deviation_um;  // means of each row
  Eigen::VectorXd from_reversal_deg;                           // to the nearest, of either axis
  std::vector<std::size_t> recording;                          // of each row
  std::size_t recordings = 0;

  Eigen::Index size() const { return count.size(); }
  // Means over the rows of values of fine rows.
  Eigen::VectorXd mean(std::span<const double> of_fine) const;
  Eigen::MatrixXd means(const Eigen::MatrixXd& of_fine) const;  // column by column
};

// Of trace_of(recordings).
ErrorRows error_rows(const Series& trace);

// These rows alone, ascending; without fine_of, which is of readings.
ErrorRows rows_at(const ErrorRows& rows, const std::vector<Eigen::Index>& which);

// Angle from the nearest end of an axis' travel, which reverses at this angle and opposite: 0 to 90 deg.
double from_reversal_deg(double angle_rad, double reversal_deg);

// Angle travelled at a row since an axis that turns back at this angle and opposite did so last: 0 to 180 deg.
double since_reversal_deg(const ErrorRows& rows, Eigen::Index row, double reversal_deg);

// What a unit of each gain of the effect adds at each fine row, its shapes as they are given: fine rows by gains.
Eigen::MatrixXd unit_curves(const Effect& effect, const Series& fine, double shape);

// The same for one shape after the other, to rounding.
class UnitCurves {
 public:
  UnitCurves(const Effect& effect, const Series& fine);  // both are referred to
  const Eigen::MatrixXd& at(double shape);

 private:
  const Effect& effect_;
  const Series& fine_;
  UnitCurvesAt fast_;  // of an effect that has them
  Eigen::MatrixXd curves_;
};

// Places of the gains and of the one shape among an effect's parameters; no_shape: none.
std::vector<std::size_t> gains_of(const Effect& effect);
inline constexpr std::size_t kNoShape = static_cast<std::size_t>(-1);
std::size_t shape_of(const Effect& effect);

}  // namespace ballbar
