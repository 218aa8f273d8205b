// Batches of thermal tests: what a regression over many of them needs of each, whatever its length.
//
// A regression of the error y on m inputs x reads a batch once: the mean and the scatter
//
//   S = sum_t (v_t - mean v) (v_t - mean v)',   v = (x, y)
//
// merge exactly with those of other batches (Chan, Golub, LeVeque 1983), and every least-squares fit over any choice of
// batches, as well as its error on any batch, follows from them. Memory is O(m^2) a batch.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ballbar/series/series.hpp"

namespace ballbar {

// What of a temperature goes into the regression: itself, its rise since the batch began, or both. Temperatures know
// the season, rises forget it.
enum class InputKind { temperature, rise, both };
std::string_view name_of(InputKind kind);

// The column of that name. Throws Error, with the nearest name.
const Column& column_of(const Series& series, const std::string& name);

// A column in degC or K that was not computed from the measurement.
bool is_sensor(const Column& column);

struct BatchColumns {
  std::vector<std::string> sensors;  // of temperatures
  InputKind kind = InputKind::temperature;
  std::string target;
  std::string room;                  // empty: none, or several that could be
  std::optional<std::string> speed;  // nothing: none logged

  bool operator==(const BatchColumns&) const = default;
};

// Of a first batch: every column in degC or K is a sensor; the room is the one of role ambient, or whose name says room
// or ambient or air; a speed where there is one column of that role. `room` or `target`: named by the user. Throws
// Error with what there is: no temperature, no such target.
BatchColumns batch_columns(const Series& first, InputKind kind, const std::string& target,
                           const std::optional<std::string>& room);

// That a room is known, by which batches are ranked. Throws Error.
void expect_room(const BatchColumns& columns);

// n rows by m inputs: temperatures, then rises. Throws Error naming the column: missing, or a gap in it.
Eigen::MatrixXd inputs_of(const Series& series, const BatchColumns& columns);

// "T_front_degC", and of a rise "T_front_degC rise"; as inputs_of.
std::vector<std::string> input_names(const BatchColumns& columns);

// How a test begins and what was driven: by which batches are near each other or not.
struct BatchStart {
  double room_first_degC = 0.0;    // NaN: no room is known
  double room_mean_degC = 0.0;     // the same
  double sensors_mean_degC = 0.0;  // of all sensors in the first row
  double sensors_spread_K = 0.0;   // their standard deviation there
  double speed_mean_rpm = 0.0;     // of the whole batch; NaN: not logged
};

struct Moments {
  double weight = 0.0;      // rows, times the weights of their batches
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
  Eigen::VectorXd sensor_first_degC, sensor_mean_degC;  // of each sensor: in the first row, over all
  // What the target does from one row to the next and a machine does not: more than 10 times the robust spread of such
  // changes, 0.3 of its range and 1 um, rows no farther apart than three usual steps. At most 5.
  std::vector<TargetStep> steps;
};

// Throws Error as inputs_of; a batch of fewer than 3 rows; a target with gaps.
Batch batch_of(const std::string& name, const Series& series, const BatchColumns& columns);

// Sums of all batches, each row counted by its batch's weight (nothing: once). At least one batch.
Moments merged(std::span<const Batch> batches, std::span<const double> weights = {});

// A sensor that in some batches is far from what the others suggest. Its mean in a batch, less that of the median
// sensor, is a straight line over how far the sensors are apart there (median of the absolute differences: the heat),
// fitted so that nearly half of the batches may be wrong (least median of residuals). Far is more than 8 times the
// robust spread of all such residuals, and 5 K; more in a batch of more heat than the median one, in proportion. None
// is told with fewer than 8 batches or 6 sensors.
struct BrokenSensor {
  std::string sensor;
  std::vector<std::string> batches;  // where it is off
  double off_K = 0.0;                // median there
};
std::vector<BrokenSensor> broken_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// Sensors that read the same in every row of every batch.
std::vector<std::string> constant_sensors(std::span<const Batch> batches, const BatchColumns& columns);

// The batches without these sensors.
struct FewerSensors {
  BatchColumns columns;
  std::vector<Batch> batches;
};
FewerSensors without_sensors(std::vector<Batch> batches, const BatchColumns& columns,
                             const std::vector<std::string>& sensors);

}  // namespace ballbar
