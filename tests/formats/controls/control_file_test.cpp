#include "ballbar/formats/controls/control_file.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <regex>
#include <sstream>

#include "ballbar/error.hpp"

// What is written is read back here, by code that knows the manuals' formulas and no writer.
namespace ballbar {
namespace {

LinearCompensation one_sensor(Control control) {
  return {{{"T_rear_degC", 3.1672, 0.1, 20.4, 18.0, 43.9}}, increment_of(control, 0.1)};
}

LinearCompensation two_sensors(Control control) {
  return {{{"T_motor_degC", -5.6251, 0.2, 20.6, 19.3, 33.2}, {"T_housing_degC", 4.1216, 0.1, -2.5, -4.3, 53.0}},
          increment_of(control, 0.1)};
}

std::string file_of(Control control, const LinearCompensation& line) {
  return control_file(control, {"z", line, 0.2, {"Model m.toml on \x01 K\xc3\xa4lte.csv."}});
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Readings across the ranges of one or two sensors.
std::vector<std::vector<double>> grid(const LinearCompensation& line) {
  std::vector<std::vector<double>> readings;
  const auto at = [&](std::size_t sensor, int k) {
    const SensorSlope& of = line.sensors[sensor];
    return of.low + (of.high - of.low) * k / 37.0;
  };
  for (int k = 0; k <= 37; ++k) {
    if (line.sensors.size() == 1) readings.push_back({at(0, k)});
    for (int l = 0; line.sensors.size() == 2 && l <= 37; ++l) readings.push_back({at(0, k), at(1, l)});
  }
  return readings;
}

// "0.0031672*($A_DBR[0]-20.4)+..." of names and their values.
double value_of(const std::string& formula, const std::map<std::string, double>& values) {
  static const std::regex kPart(R"(([+-]?[0-9.]+)\*\(([^()]+?)([+-][0-9.]+)\))");
  double sum = 0.0;
  std::size_t taken = 0;
  for (std::sregex_iterator part(formula.begin(), formula.end(), kPart), end; part != end; ++part) {
    sum += std::stod((*part)[1]) * (values.at((*part)[2]) + std::stod((*part)[3]));
    taken += part->length();
  }
  EXPECT_EQ(taken, formula.size()) << formula;
  return sum;
}

// A table of two numbers a row after a line of comment that holds `heading`.
std::vector<std::pair<double, double>> table_after(const std::string& text, const std::string& heading) {
  std::vector<std::pair<double, double>> rows;
  bool there = false;
  static const std::regex kRow(R"([;#] +(-?[0-9.]+) +(-?[0-9.]+))");
  for (const std::string& line : lines_of(text)) {
    std::smatch row;
    if (!there) {
      there = line.find(heading) != std::string::npos;
    } else if (std::regex_match(line, row, kRow)) {
      rows.emplace_back(std::stod(row[1]), std::stod(row[2]));
    } else if (!rows.empty()) {
      break;
    }
  }
  return rows;
}

double interpolated(const std::vector<std::pair<double, double>>& rows, double reading) {
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (reading > rows[i].first + 1e-9) continue;
    const double share = (reading - rows[i - 1].first) / (rows[i].first - rows[i - 1].first);
    return rows[i - 1].second + share * (rows[i].second - rows[i - 1].second);
  }
  ADD_FAILURE() << reading << " is beyond the table";
  return 0.0;
}

void expect_plain(const std::string& text) {
  for (const char c : text) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7F)) << static_cast<int>(c);
  EXPECT_NE(text.find("Model m.toml on ? K??lte.csv."), std::string::npos);
}

// dK = K0(T) + tan beta (P - P0), Extended Functions K3 4.2, in mm: K0 of the synchronized action and of the table.
TEST(ControlFile, OfSiemensIsTheManualsFormula) {
  for (const LinearCompensation& line : {one_sensor(Control::siemens), two_sensors(Control::siemens)}) {
    const std::string text = file_of(Control::siemens, line);
    expect_plain(text);
    std::map<std::string, std::string> data;  // by the name of the machine or setting datum
    std::string condition;
    static const std::regex kDatum(R"(N\d+ \$([MS]A_[A-Z_]+)\[Z\]=(\S+)( ;.*)?)");
    static const std::regex kAction(R"(N\d+ IDS=1 WHENEVER (.+) DO \$\$(SA_[A-Z_]+)\[Z\]=(\S+))");
    for (const std::string& one : lines_of(text)) {
      std::smatch found;
      if (std::regex_match(one, found, kDatum)) data[found[1]] = found[2];
      if (std::regex_match(one, found, kAction)) {
        condition = found[1];
        data[found[2]] = found[3];
      }
    }
    EXPECT_EQ(data["MA_TEMP_COMP_TYPE"], "1");
    const double slope = std::stod(data["SA_TEMP_COMP_SLOPE"]), P0_mm = std::stod(data["SA_TEMP_COMP_REF_POSITION"]);
    for (const std::vector<double>& readings : grid(line)) {
      std::map<std::string, double> values;
      double by_tables_mm = 0.0;
      for (std::size_t j = 0; j < readings.size(); ++j) {
        values["$A_DBR[" + std::to_string(4 * j) + "]"] = readings[j];
        by_tables_mm += interpolated(table_after(text, "] is " + line.sensors[j].column), readings[j]);
      }
      const double P_mm = 123.0;
      const double dK_mm = value_of(data["SA_TEMP_COMP_ABS_VALUE"], values) + slope * (P_mm - P0_mm);
      // Half an increment, by which the library rounds; of the tables a twentieth of 1 um more for each.
      EXPECT_NEAR(1000.0 * dK_mm, error_um(line, readings), 0.05 + 1e-9);
      EXPECT_NEAR(1000.0 * by_tables_mm, error_um(line, readings),
                  0.05 + 0.05 * static_cast<double>(readings.size()) + 1e-9);
    }
    std::string expected;
    for (std::size_t j = 0; j < line.sensors.size(); ++j) {
      const SensorSlope& sensor = line.sensors[j];
      const std::string reading = "($A_DBR[" + std::to_string(4 * j) + "]";
      expected += (j > 0 ? " AND " : "") + reading + ">=" + fmt::format("{}", sensor.low) + ") AND " + reading +
                  "<=" + fmt::format("{}", sensor.high) + ")";
    }
    EXPECT_EQ(condition, expected);
  }
}

// ds = offset0(T) + coefficient(T) (s - s0), TF5200: 0.1 um, um/m, 0.1 um. offset0 as the PLC makes it of the formula
// in the comments, and of the table.
TEST(ControlFile, OfBeckhoffIsTheManualsFormula) {
  for (const LinearCompensation& line : {one_sensor(Control::beckhoff), two_sensors(Control::beckhoff)}) {
    const std::string text = file_of(Control::beckhoff, line);
    expect_plain(text);
    std::map<std::string, double> parameters;
    std::string formula;
    static const std::regex kParameter(R"(lr_param\.(temp_comp\w*) +(-?\d+))");
    static const std::regex kFormula(R"(# temp_comp_offset_0 = (\S+))");
    for (const std::string& one : lines_of(text)) {
      std::smatch found;
      if (std::regex_match(one, found, kParameter)) parameters[found[1]] = std::stod(found[2]);
      if (std::regex_match(one, found, kFormula)) formula = found[1];
      EXPECT_TRUE(one.front() == '#' || one.starts_with("lr_param.")) << one;
    }
    EXPECT_EQ(parameters.size(), 4U);
    EXPECT_EQ(parameters["temp_comp"], 1.0);
    for (const std::vector<double>& readings : grid(line)) {
      std::map<std::string, double> values;
      double by_tables = 0.0;
      for (std::size_t j = 0; j < readings.size(); ++j) {
        values[line.sensors[j].column] = readings[j];
        by_tables += interpolated(table_after(text, "# " + line.sensors[j].column + ", its part:"), readings[j]);
      }
      const double s = 1e6, offset0 = std::round(value_of(formula, values));
      const double ds = offset0 + 1e-6 * parameters["temp_comp_coefficient"] * (s - parameters["temp_comp_position_0"]);
      // The same whole 0.1 um, but where the three decimals of the formula's slopes fall on the other side of a half.
      EXPECT_NEAR(0.1 * ds, error_um(line, readings), 0.1 + 1e-9);
      EXPECT_NEAR(0.1 * by_tables, error_um(line, readings), 0.05 + 0.05 * static_cast<double>(readings.size()) + 1e-9);
    }
  }
}

// lincurve(9): straight between the points, the values at the ends beyond them; sum2(9); conv_float_s32(9) cuts off
// what is left of a count; the offset of the axis is counts times the scale, minus the error.
TEST(ControlFile, OfLinuxCncIsWhatItsComponentsDo) {
  for (const LinearCompensation& line : {one_sensor(Control::linuxcnc), two_sensors(Control::linuxcnc)}) {
    const std::string text = file_of(Control::linuxcnc, line);
    expect_plain(text);
    std::map<std::string, double> pins;
    static const std::regex kSetp(R"(setp (\S+) (-?[0-9.]+))");
    for (const std::string& one : lines_of(text)) {
      std::smatch found;
      if (std::regex_match(one, found, kSetp)) pins[found[1]] = std::stod(found[2]);
    }
    std::vector<std::vector<double>> all = grid(line);
    all.push_back(std::vector<double>(line.sensors.size(), 100.0));
    all.push_back(std::vector<double>(line.sensors.size(), -100.0));
    for (const std::vector<double>& readings : all) {
      double sum = 0.0;
      for (std::size_t j = 0; j < readings.size(); ++j) {
        const std::string curve = "ballbar-z-curve-" + std::to_string(j + 1) + ".";
        const double x0 = pins.at(curve + "x-val-00"), x1 = pins.at(curve + "x-val-01");
        const double y0 = pins.at(curve + "y-val-00"), y1 = pins.at(curve + "y-val-01");
        sum += y0 + (y1 - y0) * (std::clamp(readings[j], x0, x1) - x0) / (x1 - x0);
      }
      const double offset_mm = std::trunc(sum) * pins.at("axis.z.eoffset-scale");
      // The same count, but where the four decimals of the curves fall on the other side of a whole one.
      EXPECT_NEAR(-1000.0 * offset_mm, error_um(line, readings), 0.1 + 1e-9);
    }
    EXPECT_EQ(pins.at("ballbar-z-rate.maxv"), 2.0);  // 0.2 um/s
  }
}

TEST(ControlFile, SaysWhichControlsThereAre) {
  const auto message_of = [](const auto& work) {
    try {
      work();
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_EQ(message_of([] { control_of("okuma"); }),
            "expected one of the controls siemens, beckhoff, linuxcnc, found \"okuma\".");
  EXPECT_EQ(
      message_of([] { control_of("fanuc"); }),
      "fanuc: not written, because the public FANUC manual has no formula of temperatures: thermal growth compensation "
      "along the tool (Series 15i, 16i) takes a length from the PMC. Send it the offsets of --signals, --format word.");
  EXPECT_EQ(message_of([] {
              control_file(Control::linuxcnc, {"z1", one_sensor(Control::linuxcnc), 0.2, {}});
            }),
            "--to: expected the letter of a linear axis of LinuxCNC, one of x y z u v w, found \"z1\".");
  for (const ControlKind& kind : control_kinds()) EXPECT_EQ(control_of(kind.word), kind.control);
}

}  // namespace
}  // namespace ballbar
