// Common parts of the files for controls: comments, and a table of the error against a reading.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/formats/controls/control_file.hpp"

namespace ballbar {

inline constexpr double kMmPerUm = 1e-3;

// One comment line each, after `mark`, in printable ASCII.
std::string comment_lines(std::string_view mark, const std::vector<std::string>& lines);

// Readings at which a table states K: from low to high, both in it, at whole multiples of 0.1, 0.2, 0.5, 1, 2, 5 ...
// between, the finest with at most 22 readings.
std::vector<double> table_readings(const SensorSlope& sensor);

// "0.0017654*(A-20.1)-0.0002*(B-22)" of slopes times `factor`, to `decimals`; one name a sensor.
std::string formula(const LinearCompensation& line, const std::vector<std::string>& names, double factor, int decimals);

// The shortest decimal with at most so many places; never "-0".
std::string decimal(double value, int decimals);

std::string siemens_file(const ControlLine& line);
std::string beckhoff_file(const ControlLine& line);
std::string linuxcnc_file(const ControlLine& line);

}  // namespace ballbar
