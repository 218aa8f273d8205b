// The columns of a machine's errors on rows of readings, and the prior of their gains.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "machine_errors/error_rows.hpp"
#include "machine_errors/error_set_up.hpp"

namespace ballbar {

// The column of one gain, of an effect or of the circle (effect nullptr).
struct ErrorColumn {
  std::string name;  // as in the table: "squareness", "backlash_a_pos", "centre_a"
  std::string unit;
  const Effect* effect = nullptr;
  std::size_t gain = 0;                       // index among the effect's gains
  std::optional<std::size_t> recording = {};  // the one recording to which it belongs; nullopt: all
};

struct ErrorColumns {
  std::vector<ErrorColumn> columns;
  Eigen::MatrixXd values;  // rows by columns
  Eigen::MatrixXd fine;    // fine rows by columns

  Eigen::Index size() const { return values.cols(); }
};

// Centre and radius, and their differences for CW and further recordings: 3 columns per recording.
ErrorColumns circle_columns(const ErrorRows& rows);

// The columns of one effect; `recordings`: separate ones for each recording.
ErrorColumns effect_columns(const Effect& effect, double shape, const ErrorRows& rows, bool of_each_recording);

// One statement of the prior: sum of coefficients times gains = 0, with the weight of `readings` readings.
struct PriorStatement {
  std::string name;
  std::string unit;
  Eigen::VectorXd coefficients;           // one a column
  double precision = 0.0;                 // to be added to X' X
  double alone = 0.0, alone_sigma = 0.0;  // the sum from the readings without the prior
};

// The statements for this number of readings of one recording, over an arc (2 pi: a full turn) with this middle.
std::vector<PriorStatement> prior_of(const ErrorColumns& columns, double readings_of_one, double arc_rad,
                                     double middle_rad);

Eigen::MatrixXd precision_of(const std::vector<PriorStatement>& prior, Eigen::Index columns);

// Combinations of columns that the readings cannot separate, as phrases; from X' X without the prior.
std::vector<std::string> undetermined(const Eigen::MatrixXd& normal, const std::vector<ErrorColumn>& columns);

// The phrase for one combination, from the share of each column.
std::string undetermined_names(const Eigen::VectorXd& direction, const std::vector<ErrorColumn>& columns);

}  // namespace ballbar
