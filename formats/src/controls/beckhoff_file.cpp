#include <fmt/format.h>

#include "controls/control_text.hpp"

namespace ballbar {
namespace {

constexpr double kTenthsPerUm = 10.0;

}  // namespace

std::string beckhoff_file(const ControlLine& line) {
  std::vector<std::string> names,
      comments{fmt::format("Temperature compensation of axis {}, TwinCAT 3 CNC TF5200 (ISG kernel).", line.axis)};
  comments.insert(comments.end(), line.comments.begin(), line.comments.end());
  for (const SensorSlope& sensor : line.line.sensors) names.push_back(sensor.column);
  const std::vector<std::string> manual{
      "",
      "Manual: TF5200 Axis Compensation, Temperature compensation; P-AXIS-00271 to 00274:",
      "ds = offset0(T) + coefficient(T) * (s - s0). offset0 is the error of the axis in 0.1 um.",
      "The coefficient is 0: the error was measured at one position.",
      "The PLC sets offset0 as the readings change, to the nearest whole number; readings stop at",
      "the ends of the table:",
      "temp_comp_offset_0 = " + formula(line.line, names, kTenthsPerUm, 3),
      "",
      "Sign, once: set offset0 to 500 by hand and look with a dial gauge. The axis has to go",
      "0.050 mm towards minus. Where it goes towards plus, write the file with --reversed-sign.",
  };
  comments.insert(comments.end(), manual.begin(), manual.end());
  for (const SensorSlope& sensor : line.line.sensors) {
    comments.emplace_back();
    comments.push_back(fmt::format("{}, its part:", sensor.column));
    comments.push_back(fmt::format("{:>10}  {:>14}", "reading", "offset0 0.1 um"));
    for (const double reading : table_readings(sensor)) {
      comments.push_back(fmt::format("{:>10}  {:>14}", fmt::format("{:.1f}", reading),
                                     decimal(kTenthsPerUm * sensor.slope_um_per_K * (reading - sensor.zero), 0)));
    }
  }
  return comment_lines("#", comments) +
         "lr_param.temp_comp              1\n"
         "lr_param.temp_comp_position_0   0\n"
         "lr_param.temp_comp_offset_0     0\n"
         "lr_param.temp_comp_coefficient  0\n";
}

}  // namespace ballbar
