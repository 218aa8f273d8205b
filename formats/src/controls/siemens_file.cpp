#include <fmt/format.h>

#include <algorithm>

#include "controls/control_text.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kBytesOfReal = 4;  // of $A_DBR

}  // namespace

std::string siemens_file(const ControlLine& line) {
  std::string axis = line.axis;
  std::transform(axis.begin(), axis.end(), axis.begin(), [](char c) { return c >= 'a' && c <= 'z' ? c - 32 : c; });
  const std::vector<SensorSlope>& sensors = line.line.sensors;
  std::vector<std::string> names, in_range,
      comments{fmt::format("Temperature compensation of axis {}, SINUMERIK 840D sl; {} is its machine axis name.",
                           line.axis, axis)};
  comments.insert(comments.end(), line.comments.begin(), line.comments.end());
  const std::vector<std::string> manual{
      "",
      "Manual: Extended Functions, 03/2013, 6FC5397-1BP40-3BA1, K3 4.2:",
      "dK = K0(T) + tan beta(T) * (P - P0). K0 is SD43900, the error of the axis in mm.",
      "tan beta, SD43910, is 0: the error was measured at one position.",
      "Run this program once after power on; the PLC puts the readings, REAL, into $A_DBR",
      "(Basic Functions, 08/2005, 6FC5397-0BP10-0BA0, A2 2.2). Out of range K0 stays.",
      "IDS=1 stands for any number that is free.",
      "",
      "Sign, once: set SD43900 to 0.050 by hand and look with a dial gauge. The axis has to go",
      "0.050 mm towards minus. Where it goes towards plus, write the file with --reversed-sign.",
  };
  comments.insert(comments.end(), manual.begin(), manual.end());
  for (std::size_t j = 0; j < sensors.size(); ++j) {
    const SensorSlope& sensor = sensors[j];
    names.push_back(fmt::format("$A_DBR[{}]", kBytesOfReal * j));
    in_range.push_back(
        fmt::format("({0}>={1}) AND ({0}<={2})", names[j], decimal(sensor.low, 1), decimal(sensor.high, 1)));
    comments.emplace_back();
    comments.push_back(
        fmt::format("{} is {}. Its part of K0, for a PLC that sets SD43900 itself (FB3):", names[j], sensor.column));
    comments.push_back(fmt::format("{:>10}  {:>9}", "reading", "K0 mm"));
    for (const double reading : table_readings(sensor)) {
      comments.push_back(fmt::format("{:>10}  {:>9.4f}", fmt::format("{:.1f}", reading),
                                     kMmPerUm * sensor.slope_um_per_K * (reading - sensor.zero) + 0.0));
    }
  }
  std::string condition;
  for (const std::string& one : in_range) condition += (condition.empty() ? "" : " AND ") + one;
  return comment_lines(";", comments) + fmt::format(
                                            "N10 $MA_TEMP_COMP_TYPE[{0}]=1 ; MD32750, bit 0: K0 alone; after power on\n"
                                            "N20 $SA_TEMP_COMP_SLOPE[{0}]=0 ; SD43910\n"
                                            "N30 $SA_TEMP_COMP_REF_POSITION[{0}]=0 ; SD43920\n"
                                            "N40 IDS=1 WHENEVER {1} DO $$SA_TEMP_COMP_ABS_VALUE[{0}]={2}\n"
                                            "N50 M30\n",
                                            axis, condition, formula(line.line, names, kMmPerUm, 7));
}

}  // namespace ballbar
