#include "bad_text.hpp"

#include <stdexcept>

#include "ballbar/formats/recordings/b5r.hpp"
#include "ballbar/formats/recordings/ballbar_log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/session_toml.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kLog = R"(# format = "ballbar-log 1"
# kind = "circle"
# motion = "linear_axes"
# plane = "XY"
# moving_ball = "spindle"
# nominal_length_mm = 100.0
# direction = "CCW"
# elapsed_s = 60
time_s,angle_deg,length_mm
0.0,45.0,100.001
0.1,135.0,100.002
0.2,225.0,100.003
)";

constexpr std::string_view kAxial = R"(# format = "ballbar-log 1"
# kind = "axial"
# nominal_length_mm = 100.0
time_s,length_mm
0.0,100.001
0.1,100.002
)";

constexpr std::string_view kSeries = R"(# format = "ballbar-series 1"
# [columns.T_air_degC]
# role = "ambient"
# [five_probe]
# spacing_mm = 60.0
time_s,speed_rpm,T_air_degC
0,3000,20.5
10,3000,
20,3000,20.7
)";

constexpr std::string_view kProbesOfOtherNames = R"(# format = "ballbar-series 1"
# [five_probe]
# spacing_mm = 60.0
# plane_1_from_nose_mm = -12.5
# resolution_um = 0.05
# linearity_percent = 0.5
# X1 = "ch1_um"
# X2 = "ch2_um"
# Z = "ch3_um"
time_s,ch1_um,ch2_um,ch3_um
0,0.10,0.20,0.30
60,1.10,,1.30
)";

constexpr std::string_view kSession = R"(format = "ballbar-session 1"
method = "two_arcs"
title = "warm-up"
[bar]
nominal_length_mm = 100.0
[[test]]
elapsed_s = 0.0
c_arc = "00-c.csv"
a_arc = "00-a.csv"
[[test]]
elapsed_s = 600.0
c_arc = "01-c.csv"
a_arc = "01-a.csv"
[signals]
files = ["temperatures.csv"]
[five_probe]
file = "five-probe.csv"
)";

constexpr std::string_view kRotation = R"(format = "ballbar-session 1"
method = "spindle_rotation"
[bar]
nominal_length_mm = 100.0
[[test]]
elapsed_s = 0.0
rotation = "00-r.csv"
axial = "00-z.csv"
)";

constexpr std::string_view kB5r = R"(<?xml version="1.0" encoding="utf-8"?>
<TEST_DOCUMENT>
  <TEST_SPEC NAME="quarter &amp; turn">
    <INSTRUMENT MODEL="old">
      <DYNAMIC_BALLBAR>
        <NOMINAL_LENGTH>100</NOMINAL_LENGTH>
        <PROGRAMMED_FEEDRATE>1000</PROGRAMMED_FEEDRATE>
        <START_ANGLE>350</START_ANGLE>
        <END_ANGLE>80</END_ANGLE>
        <PLANE VIEW="+B+A" TEST_PLANE="ZX">
          <A_AXIS_NAME>Z</A_AXIS_NAME>
          <B_AXIS_NAME>X</B_AXIS_NAME>
        </PLANE>
      </DYNAMIC_BALLBAR>
    </INSTRUMENT>
  </TEST_SPEC>
  <DATE_STARTED>20200229-120001</DATE_STARTED>
  <EQUIPMENT>
    <BALLBAR><MODEL>QC20-W</MODEL></BALLBAR>
    <SOFTWARE><VERSION>5.1</VERSION></SOFTWARE>
  </EQUIPMENT>
  <RUN_RESULTS>
    <BALLBAR_RUN>
      <RUN_DIRECTION>CW</RUN_DIRECTION>
      <RUN_TEMPERATURE>21.5</RUN_TEMPERATURE>
      <START_INDEX>1</START_INDEX>
      <END_INDEX>3</END_INDEX>
      <SAMPLE_RATE>10</SAMPLE_RATE>
      <READINGS>+0.00900 +0.00100 -0.00200 0.00300 +0.00900</READINGS>
      <FEATURE NAME="AF_BEST_RADIUS" DT="UT_LENGTH_MM">100.0007</FEATURE>
    </BALLBAR_RUN>
  </RUN_RESULTS>
  <ANALYSIS NAME="ISO230_4" version="2005">
    <FEATURE NAME="AF_BEST_RADIUS" DT="UT_LENGTH_UM">0.7</FEATURE>
    <FEATURE NAME="AF_SIN" DT="UT_LENGTH_UM" VALID="False"></FEATURE>
  </ANALYSIS>
  <ANALYSIS NAME="ANSI_B_5_57">
    <FEATURE NAME="AF_RANK" DT="UT_RANKING">2</FEATURE>
  </ANALYSIS>
</TEST_DOCUMENT>
)";

// Both runs, and all that a head and an analysis may hold. The arc is 330 to 30 deg.
constexpr std::string_view kBoth = R"(<?xml version="1.0" encoding="utf-8"?>
<TEST_DOCUMENT>
  <TEST_SPEC NAME="XY 50 mm" version="2.0">
    <INSTRUMENT MANUFACTURER="Renishaw" MODEL="QC10">
      <DYNAMIC_BALLBAR CALIBRATION_REQUIRED="true">
        <NOMINAL_LENGTH>50</NOMINAL_LENGTH>
        <PROGRAMMED_FEEDRATE>1500</PROGRAMMED_FEEDRATE>
        <START_ANGLE>330</START_ANGLE>
        <END_ANGLE>30</END_ANGLE>
        <OVERSHOOT_ANGLE>45</OVERSHOOT_ANGLE>
        <TEST_RADIUS>49.5</TEST_RADIUS>
        <PLANE VIEW="+A+B" TEST_PLANE="XY">
          <A_AXIS_NAME>X</A_AXIS_NAME>
          <B_AXIS_NAME>Y</B_AXIS_NAME>
        </PLANE>
        <RUN_SPEC>
          <RUN_DIRECTION>CCW</RUN_DIRECTION>
          <RUN_DIRECTION>CW</RUN_DIRECTION>
          <FEATURE_SPEC NAME="AF_OFFSET_A" DT="UT_LENGTH_MM">
            <TOLERANCE LEVEL="WARNING">
              <LOWER_LIMIT>-0.1</LOWER_LIMIT>
              <UPPER_LIMIT>0.1</UPPER_LIMIT>
            </TOLERANCE>
            <TOLERANCE LEVEL="ERROR">
              <UPPER_LIMIT>0.2</UPPER_LIMIT>
            </TOLERANCE>
          </FEATURE_SPEC>
        </RUN_SPEC>
        <SPINDLE_NUMBER>1</SPINDLE_NUMBER>
        <NC_PROGRAM_ID>8014</NC_PROGRAM_ID>
        <TEMP_MATERIAL_COEFFICIENT>8</TEMP_MATERIAL_COEFFICIENT>
      </DYNAMIC_BALLBAR>
    </INSTRUMENT>
    <ANALYSIS_SPEC NAME="RENISHAW_DIAGNOSTICS">
      <FEATURE_SPEC NAME="AF_CIRCULARITY" DT="UT_LENGTH_UM">
        <TOLERANCE LEVEL="WARNING"><LOWER_LIMIT>-</LOWER_LIMIT><UPPER_LIMIT>10</UPPER_LIMIT></TOLERANCE>
        <TOLERANCE LEVEL="ERROR"><UPPER_LIMIT></UPPER_LIMIT></TOLERANCE>
      </FEATURE_SPEC>
    </ANALYSIS_SPEC>
    <ANALYSIS_SPEC NAME="ISO230_4" />
  </TEST_SPEC>
  <OPERATOR> A. Meier </OPERATOR>
  <COMMENT NAME="PRE_TEST_COMMENT">cold &amp; dry</COMMENT>
  <COMMENT NAME="POST_TEST_COMMENT">door open</COMMENT>
  <DATE_STARTED>20250904-161049</DATE_STARTED>
  <DATE_COMPLETED>20250904-161149</DATE_COMPLETED>
  <MACHINE_TESTED NAME="mill 7" />
  <EQUIPMENT>
    <BALLBAR>
      <MANUFACTURER>Renishaw</MANUFACTURER>
      <MODEL>QC20</MODEL>
      <SERIAL_NUMBER>B-12</SERIAL_NUMBER>
      <SCALE_FACTOR>1</SCALE_FACTOR>
      <CERTIFICATE_NUMBER>C-34</CERTIFICATE_NUMBER>
      <LAST_CALIBRATED>20240416</LAST_CALIBRATED>
    </BALLBAR>
    <CALIBRATOR>
      <MODEL>50MM_BALLBAR_CALIBRATOR</MODEL>
      <SERIAL_NUMBER>K-56</SERIAL_NUMBER>
      <EXPANSION_COEFFICIENT>0.00</EXPANSION_COEFFICIENT>
      <CALIBRATED_LENGTH>50.0031</CALIBRATED_LENGTH>
      <TEMPERATURE>20.0</TEMPERATURE>
      <CERTIFICATE_NUMBER>-</CERTIFICATE_NUMBER>
      <LAST_CALIBRATED>20240426</LAST_CALIBRATED>
    </CALIBRATOR>
    <SOFTWARE>
      <TITLE>Ballbar 20</TITLE>
      <VERSION>20.00</VERSION>
    </SOFTWARE>
  </EQUIPMENT>
  <RUN_RESULTS>
    <BALLBAR_RUN>
      <RUN_DIRECTION>CCW</RUN_DIRECTION>
      <RUN_TEMPERATURE>20.5</RUN_TEMPERATURE>
      <START_INDEX>1</START_INDEX>
      <END_INDEX>3</END_INDEX>
      <SAMPLE_RATE>10</SAMPLE_RATE>
      <READINGS>+0.05 +0.01 -0.02 +0.03 +0.05</READINGS>
      <FEATURE NAME="AF_CENTRE_OFFSET_A" DT="UT_LENGTH_MM" STATUS="AF_TOLERANCE_OK">0.0488</FEATURE>
    </BALLBAR_RUN>
    <BALLBAR_RUN>
      <RUN_DIRECTION>CW</RUN_DIRECTION>
      <START_INDEX>0</START_INDEX>
      <END_INDEX>1</END_INDEX>
      <SAMPLE_RATE>10</SAMPLE_RATE>
      <READINGS>+0.04 +0.06</READINGS>
      <FEATURE NAME="AF_CENTRE_OFFSET_A" DT="UT_LENGTH_MM" STATUS="AF_TOLERANCE_WARNING">0.15</FEATURE>
    </BALLBAR_RUN>
  </RUN_RESULTS>
  <ANALYSIS NAME="ISO230_4" version="2005">
    <FEATURE NAME="AF_CIRCULAR_DEVIATION_CCW" DT="UT_LENGTH_UM">6.5</FEATURE>
  </ANALYSIS>
  <ANALYSIS NAME="RENISHAW_DIAGNOSTICS" version="2.1">
    <FEATURE NAME="AF_CIRCULARITY" DT="UT_LENGTH_UM">6.5</FEATURE>
    <SIMULATION NAME="AF_SIMULATED_READINGS_CCW">0.01001 -0.02002 0.03003</SIMULATION>
    <SIMULATION NAME="AF_SIMULATED_READINGS_CW">+0.04004 0.06006</SIMULATION>
  </ANALYSIS>
</TEST_DOCUMENT>
)";

}  // namespace

std::string good_text(std::string_view kind) {
  if (kind == "log") return std::string(kLog);
  if (kind == "axial") return std::string(kAxial);
  if (kind == "series") return std::string(kSeries);
  if (kind == "probes") return std::string(kProbesOfOtherNames);
  if (kind == "session") return std::string(kSession);
  if (kind == "rotation") return std::string(kRotation);
  if (kind == "b5r") return std::string(kB5r);
  if (kind == "both") return std::string(kBoth);
  throw std::logic_error("no good text of that kind");
}

std::string changed(std::string_view kind, std::string_view from, std::string_view to) {
  if (from == "*") return std::string(to);
  std::string text = good_text(kind);
  std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the good text lacks what a row changes");
  for (; at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
  return text;
}

void read(std::string_view kind, std::string_view text) {
  if (kind == "log" || kind == "axial") {
    read_ballbar_log(text, "file");
  } else if (kind == "series" || kind == "probes") {
    read_series(text, "file");
  } else if (kind == "b5r" || kind == "both") {
    read_b5r(text, "file");
  } else {
    read_session_plan(text, "file");
  }
}

}  // namespace ballbar
