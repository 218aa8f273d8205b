// Batches of thermal tests, reduced to the moments that a regression over many of them needs.
//
// A regression of the error y on m inputs x reads each batch once. The mean and the scatter
//
//   S = sum_t (v_t - mean v) (v_t - mean v)',   v = (x, y)
//
// merge exactly with those of other batches (Chan, Golub, LeVeque 1983). Every least squares fit over any choice of
// batches, and its error on any batch, follows from them. Memory: O(m^2) per batch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// The inputs that a temperature gives to the regression: its value, its rise since the start of the batch, or both.
// Values depend on the season, rises do not.
enum class InputKind { temperature, rise, both };
std::string_view name_of(InputKind kind);

// The column of that name. Throws Error with the nearest name.
const Column& column_of(const Series& series, const std::string& name);

// Whether the column is in degC or K and was not computed from the measurement.
bool is_sensor(const Column& column);

struct BatchColumns {
  std::vector<std::string> sensors;  // temperature columns
  InputKind kind = InputKind::temperature;
  std::string target;
  std::string room;                  // empty: none, or several candidates
  std::optional<std::string> speed;  // nullopt: not logged

  bool operator==(const BatchColumns&) const = default;
};

// The columns of the first batch. Every column in degC or K is a sensor. The room is the one of role ambient, or with
// room, ambient or air in its name. The speed is the only column of role speed. `room` and `target` are the user's
// choice. Throws Error with the existing columns: no temperature, no such target.
BatchColumns batch_columns(const Series& first, InputKind kind, const std::string& target,
                           const std::optional<std::string>& room);

// Throws Error without a room temperature, which is needed to rank batches.
void expect_room(const BatchColumns& columns);

// The inputs, n rows by m: temperatures, then rises. Throws Error for a missing column or a gap, with its name.
Eigen::MatrixXd inputs_of(const Series& series, const BatchColumns& columns);

// The names of the inputs in the order of inputs_of(): "T_front_degC", for a rise "T_front_degC rise".
std::vector<std::string> input_names(const BatchColumns& columns);

// The start conditions and the mean speed of a test, by which the similarity of batches is judged.
struct BatchStart {
  double room_first_degC = 0.0;    // NaN: no room temperature
  double room_mean_degC = 0.0;     // likewise
  double sensors_mean_degC = 0.0;  // over all sensors in the first row
  double sensors_spread_K = 0.0;   // standard deviation over the sensors in the first row
  double speed_mean_rpm = 0.0;     // over the whole batch; NaN: not logged
};

struct Moments {
  double weight = 0.0;      // sum of the rows times the weights of their batches
  Eigen::VectorXd mean;     // inputs, then target: m + 1
  Eigen::MatrixXd scatter;  // (m + 1) by (m + 1)
};
Moments merged(const Moments& a, const Moments& b);

struct TargetStep {
  double time_s = 0.0;
  double um = 0.0;
};

struct Batch {
  std::string name;
  std::size_t rows = 0;
  BatchStart start;
  Moments moments;
  Eigen::VectorXd sensor_first_degC, sensor_mean_degC;  // per sensor: in the first row; mean over all rows
  // Jumps of the target that a machine cannot make: changes from row to row of more than 10 times their robust spread,
  // 0.3 of the range and 1 um, between rows at most three usual steps apart. At most 5.
  std::vector<TargetStep> steps;
};

// Throws Error as inputs_of() does, for fewer than 3 rows, and for a target with gaps.
Batch batch_of(const std::string& name, const Series& series, const BatchColumns& columns);

// The moments of all batches, each row weighted by the weight of its batch (empty: 1). At least one batch.
Moments merged(std::span<const Batch> batches, std::span<const double> weights = {});

// A sensor whose readings in some batches do not fit those of the others. Its mean in a batch, minus that of the median
// sensor, is modelled as linear in the spread of the sensors (median absolute difference, a measure of the heat). The
// line is fitted by the least median of residuals, so that nearly half of the batches may be wrong. A deviation counts
// if it exceeds 8 times the robust spread of all residuals, and 5 K; the limit rises in proportion to the heat above
// that of the median batch. Returns none for fewer than 8 batches or 6 sensors.
struct BrokenSensor {
  std::string sensor;
  std::vector<std::string> batches;  // batches with deviations
  double off_K = 0.0;                // median deviation in these
};
std::vector<BrokenSensor> broken_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// Sensors with one constant reading in all rows of all batches.
std::vector<std::string> constant_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// Leaves these sensors out. Throws Error if none remains.
void leave_out_sensors(std::vector<Batch>& batches, BatchColumns& columns, const std::vector<std::string>& sensors);

}  // namespace ballbar
