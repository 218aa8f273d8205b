// Every reader and the text it refuses, with the whole message: the table of what users are told.
#include "bad_text.hpp"

#include <gtest/gtest.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

using namespace std::string_view_literals;

struct BadText {
  std::string_view kind;  // of good_text()
  std::string_view from;
  std::string_view to;
  std::string_view message;
};

constexpr BadText kBadTexts[] = {
    {"log", "*", "", "file:1:1: expected text, found an empty file."},
    {"log", "*", "\xEF\xBB\xBF", "file:1:1: expected text, found an empty file."},
    {"log", "*", "\xFF\xFEt\0i\0"sv, "file:1:1: expected UTF-8, found UTF-16. Save the file as UTF-8."},
    {"log", "45.0", "4\0005.0"sv, "file:10:6: expected text, found a NUL byte; this is a binary file."},
    {"log", "45.0", "\xE9", "file:10:5: expected UTF-8, found the byte \"\\xE9\". Save the file as UTF-8."},
    {"log", "45.0", "\xE0\x80\x80", "file:10:5: expected UTF-8, found the byte \"\\xE0\". Save the file as UTF-8."},
    {"log", "ballbar-log 1", "ballbar-log 2",
     "file:1:12: expected \"ballbar-log 1\" for format, found the text \"ballbar-log 2\"."},
    {"log", "# format = \"ballbar-log 1\"\n", "", "file:1:1: expected the key format, found none."},
    {"log", "\"circle\"", "\"round\"",
     "file:2:10: expected one of \"circle\", \"axial\" for kind, found the text \"round\"."},
    {"log", "# kind = \"circle\"\n", "", "file:1:1: expected the key kind, found none."},
    {"log", "motion = \"linear_axes\"", "motion = linear_axes",
     "file:3:12: expected TOML, found text that its parser refuses: Error while parsing value: could not determine "
     "value type."},
    {"log", "plane = \"XY\"", "plane = \"XX\"",
     "file:4:11: expected one of \"XY\", \"YZ\", \"ZX\", \"YX\", \"ZY\", \"XZ\" for plane, found the text "
     "\"XX\"."},
    {"log", "moving_ball = \"spindle\"", "moving_ball = true",
     "file:5:17: expected one of \"spindle\", \"table\" for moving_ball, found true."},
    {"log", "nominal_length_mm = 100.0", "nominal_length_mm = 0",
     "file:6:23: expected a number above 0 for nominal_length_mm, found the integer 0."},
    {"log", "nominal_length_mm = 100.0", "nominal_length_mm = 100,0",
     "file:6:26: expected TOML, found text that its parser refuses: Error while parsing key-value pair: expected a "
     "comment or whitespace, saw ','; decimals need a point."},
    {"log", "nominal_length_mm", "nominal_lenght_mm",
     "file:6:3: expected one of the keys format, kind, motion, plane, moving_ball, nominal_length_mm, direction, "
     "elapsed_s, started, feed_mm_per_min, height_offset_mm, bar_temperature_degC, found \"nominal_lenght_mm\"; the "
     "nearest is nominal_length_mm."},
    {"log", "# nominal_length_mm = 100.0\n", "", "file:1:1: expected the key nominal_length_mm, found none."},
    {"log", "direction = \"CCW\"", "direction = \"CW\"",
     "file:7:15: expected the direction of the angles, which rise all the way (CCW), found \"CW\"."},
    {"log", "elapsed_s = 60", "elapsed_s = nan",
     "file:8:15: expected a finite number for elapsed_s, found the number nan."},
    {"log", "elapsed_s = 60", "started = \"2015-03-02\"",
     "file:8:13: expected a date and time such as 2015-03-02T09:00:00, without quotes, for started, found the text "
     "\"2015-03-02\"."},
    {"log", "elapsed_s = 60", "started = 2015-03-02T09:00:00Z",
     "file:8:13: expected a local time for started, found one with a zone."},
    {"log", "elapsed_s = 60", "feed_mm_per_min = 0",
     "file:8:21: expected a number above 0 for feed_mm_per_min, found the integer 0."},
    {"log", "elapsed_s = 60", "elapsed_min = 1",
     "file:8:3: expected one of the keys format, kind, motion, plane, moving_ball, nominal_length_mm, direction, "
     "elapsed_s, started, feed_mm_per_min, height_offset_mm, bar_temperature_degC, found \"elapsed_min\"; the nearest "
     "is elapsed_s."},
    {"log", "elapsed_s = 60", "elapsed_s = 60\n# elapsed_s = 61",
     "file:9:15: expected TOML, found text that its parser refuses: Error while parsing key-value pair: cannot "
     "redefine existing integer 'elapsed_s'."},
    {"log", "elapsed_s = 60", "a.a.a = { b = [",
     "file:8:19: expected TOML, found text that its parser refuses: Error while parsing array: encountered "
     "end-of-file."},
    {"log", "elapsed_s = 60", "bar from the shop",
     "file:8:7: expected TOML, found text that its parser refuses: Error while parsing key-value pair: expected '=', "
     "saw 'f'."},
    {"log", "length_mm\n", "length_in\n",
     "file:9:18: expected one of the columns time_s, angle_deg, length_mm, deviation_um in a circle log, in these "
     "units, found \"length_in\"."},
    {"log", "angle_deg", "angle_rad",
     "file:9:8: expected one of the columns time_s, angle_deg, length_mm, deviation_um in a circle log, in these "
     "units, found \"angle_rad\"."},
    {"log", "time_s,angle_deg", "time_s,time_s", "file:9:8: expected each column once, found \"time_s\" again."},
    {"log", "time_s,angle_deg", "time_s,", "file:9:8: expected the name of a column, found nothing."},
    {"log", "time_s,angle_deg,length_mm", "time_s,length_mm", "file:9:1: expected a column angle_deg, found none."},
    {"log", "time_s,angle_deg,length_mm", "time_s,angle_deg",
     "file:9:1: expected a column length_mm (or deviation_um), found none."},
    {"log", "time_s,angle_deg,length_mm", "\"time_s\",\"angle_deg\",\"length_mm\"",
     "file:9:1: expected column names without quotes, separated by commas, found \"\"time_s\"\"."},
    {"log", "time_s,", "deviation_um,", "file:9:1: expected either length_mm or deviation_um, found both."},
    {"log", "0.0,45.0,100.001\n0.1,135.0,100.002\n0.2,225.0,100.003\n", "",
     "file:10:1: expected at least one row of numbers, found the end of the file."},
    {"log", "time_s,angle_deg,length_mm\n0.0,45.0,100.001\n0.1,135.0,100.002\n0.2,225.0,100.003\n", "",
     "file:9:1: expected a line of column names, found the end of the file."},
    {"log", "0.1,135.0,100.002", "0,1,135,0,100,002",
     "file:11:1: expected 3 values, one for each column, found 6; decimals need a point, not a comma."},
    {"log", "0.1,135.0,100.002", "0.1,135.0", "file:11:1: expected 3 values, one for each column, found 2."},
    {"log", "0.1,135.0,100.002", "0.1;135.0;100.002",
     "file:11:4: expected values separated by commas, decimals with a point, found \"0.1;135.0;100.002\"."},
    {"log", "0.1,135.0,100.002", "", "file:11:1: expected a row of 3 values, found an empty line."},
    {"log", "0.1,135.0", "0.1,", "file:11:5: expected a number for angle_deg, found nothing."},
    {"log", "100.002", "NaN", "file:11:11: expected a finite number for length_mm, found \"NaN\"."},
    {"log", "100.002", "-inf", "file:11:11: expected a finite number for length_mm, found \"-inf\"."},
    {"log", "100.002", "1e999", "file:11:11: expected a number that a double can hold for length_mm, found \"1e999\"."},
    {"log", "100.002", "100.002 mm", "file:11:11: expected a finite number for length_mm, found \"100.002 mm\"."},
    {"log", "100.002", "0x64", "file:11:11: expected a finite number for length_mm, found \"0x64\"."},
    {"log", "100.002", "+-100.002", "file:11:11: expected a finite number for length_mm, found \"+-100.002\"."},
    {"log", "100.002", "1\r00.002", "file:11:11: expected a finite number for length_mm, found \"1\\x0D00.002\"."},
    {"log", "100.002", "100002",
     "file:11:11: expected a length in mm within a tenth of nominal_length_mm = 100, found \"100002\"."},
    {"log", "100.002", "-100.002", "file:11:11: expected a length above 0 mm, found \"-100.002\"."},
    {"log", "0.1,135", "0.0,135", "file:11:1: expected time_s above 0 of the row before, found \"0.0\"."},
    {"log", "0.2,225", "0.05,225", "file:12:1: expected time_s above 0.1 of the row before, found \"0.05\"."},
    {"axial", "nominal", "plane = \"XY\"\n# nominal",
     "file:3:11: expected no plane in an axial log, found one; only a circle has it."},
    {"axial", "time_s,length_mm", "time_s,angle_deg",
     "file:4:8: expected one of the columns time_s, length_mm, deviation_um in an axial log, in these units, found "
     "\"angle_deg\"."},
    {"axial", "time_s,length_mm\n0.0,100.001\n0.1,100.002", "length_mm\n100.001",
     "file:4:1: expected a column time_s, found none."},
    {"axial", "length_mm\n0.0,100.001", "deviation_um\n0.0,-100001",
     "file:5:5: expected a deviation that leaves a length above 0 mm, found \"-100001\"."},
    {"series", "time_s", "time_h", "file:6:1: expected time_s or time_min as the first column, found \"time_h\"."},
    {"series", "speed_rpm", "time_min", "file:6:8: expected one column of time, found \"time_min\" too."},
    {"series", "T_air_degC\n0", "T_air_F\n0",
     "file:2:12: expected one of the keys time_s, speed_rpm, T_air_F in [columns], found \"T_air_degC\"; the nearest "
     "is T_air_F."},
    {"series", "speed_rpm,T_air_degC\n", "speed_rpm,speed_rpm\n",
     "file:6:18: expected each column once, found \"speed_rpm\" again."},
    {"series", "*", "time_s,T_F\n0,68\n",
     "file:1:8: expected a name that ends in its unit, one of _um, _mm, _urad, _degC, _rpm, _A, _W, _K, _percent, "
     "_Nm, _bar, _l_per_min, _mm_per_min, _V, or a role stated for it, found "
     "\"T_F\"."},
    {"series", "*", "time_s\n0\n", "file:1:1: expected a column besides the time, found none."},
    {"series", "columns.T_air", "columns.T_oil",
     "file:2:12: expected one of the keys time_s, speed_rpm, T_air_degC in [columns], found \"T_oil_degC\"; the "
     "nearest is T_air_degC."},
    {"series", "\"ambient\"", "\"air\"",
     "file:3:10: expected one of \"structure\", \"ambient\", \"coolant\", \"bearing\", \"mean_point\", \"housing\", "
     "\"speed\", \"load\", \"event\", \"measured\" for role, found the text \"air\"."},
    {"series", "role = \"ambient\"", "roll = \"ambient\"",
     "file:3:3: expected no key but role in [T_air_degC], found \"roll\"."},
    {"series", "spacing_mm = 60.0", "spacing_mm = -60.0",
     "file:5:16: expected a number above 0 for spacing_mm, found the number -60."},
    {"probes", "spacing_mm", "distance_mm",
     "file:3:3: expected one of the keys spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent, X1, X2, "
     "Y1, Y2, Z in [five_probe], found \"distance_mm\"; the nearest is spacing_mm."},
    {"probes", "spacing_mm = 60.0", "spacing_mm = \"60\"",
     "file:3:16: expected a finite number for spacing_mm, found the text \"60\"."},
    {"probes", "spacing_mm = 60.0", "spacing_mm = inf",
     "file:3:16: expected a finite number for spacing_mm, found the number inf."},
    {"probes", "plane_1_from_nose_mm = -12.5", "plane_1_from_nose_mm = true",
     "file:4:26: expected a finite number for plane_1_from_nose_mm, found true."},
    {"probes", "plane_1_from_nose_mm = -12.5", "plane_1_from_nose_mm = nan",
     "file:4:26: expected a finite number for plane_1_from_nose_mm, found the number nan."},
    {"probes", "resolution_um = 0.05", "resolution_um = -0.05",
     "file:5:19: expected a number above 0 for resolution_um, found the number -0.05."},
    {"probes", "resolution_um = 0.05", "resolution_um = 0",
     "file:5:19: expected a number above 0 for resolution_um, found the integer 0."},
    {"probes", "linearity_percent = 0.5", "linearity_percent = 0,5",
     "file:6:24: expected TOML, found text that its parser refuses: Error while parsing key-value pair: expected a "
     "comment or whitespace, saw ','; decimals need a point."},
    {"probes", "linearity_percent = 0.5", "linearity_percent = 0",
     "file:6:23: expected a number above 0 for linearity_percent, found the integer 0."},
    {"probes", "X1 = \"ch1_um\"", "X1 = \"ch1\"",
     "file:7:8: expected a column of readings for X1, found \"ch1\"; the nearest is ch1_um."},
    {"probes", "time_s,ch1_um,ch2_um,ch3_um\n0,0.10,0.20,0.30\n60,1.10,,1.30\n", "time_s\n0\n",
     "file:7:8: expected a column of readings for X1, found \"ch1_um\"."},
    {"probes", "X1 = \"ch1_um\"", "X1 = ch1_um",
     "file:7:8: expected TOML, found text that its parser refuses: Error while parsing value: could not determine "
     "value type."},
    {"probes", "X1 = \"ch1_um\"", "X1 = 1", "file:7:8: expected a text in quotes for X1, found the integer 1."},
    {"probes", "X1 = \"ch1_um\"", "x1 = \"ch1_um\"",
     "file:7:3: expected one of the keys spacing_mm, plane_1_from_nose_mm, resolution_um, linearity_percent, X1, X2, "
     "Y1, Y2, Z in [five_probe], found \"x1\"; the nearest is X1."},
    {"probes", "X2 = \"ch2_um\"", "X2 = \"ch1_um\"",
     "file:8:8: expected a column of its own for each probe, found \"ch1_um\" for X1 and X2."},
    {"probes", "Z = \"ch3_um\"", "Z = \"ch2_um\"",
     "file:9:7: expected a column of its own for each probe, found \"ch2_um\" for X2 and Z."},
    {"probes", "Z = \"ch3_um\"", "Z = \"time_s\"",
     "file:9:7: expected a column of readings for Z, found \"time_s\"; the nearest is ch1_um."},
    {"probes", "X2 = \"ch2_um\"", "X2 = \"\"",
     "file:8:8: expected a column of readings for X2, found \"\"; the nearest is ch1_um."},
    {"probes", "# [five_probe]\n", "# five_probe = 1\n",
     "file:3:3: expected one of the keys format, title, method, reference_s, started, clock, columns, five_probe, "
     "found "
     "\"spacing_mm\"; the nearest is started."},
    {"series", "ballbar-series 1", "ballbar-series 3",
     "file:1:12: expected \"ballbar-series 1\" for format, found the text \"ballbar-series 3\"."},
    {"series", "\n10,3000,\n", "\n,3000,\n", "file:8:1: expected a number for time_s, found nothing."},
    {"series", "\n10,3000,\n", "\n10,3000\n", "file:8:1: expected 3 values, one for each column, found 2."},
    {"series", "\n10,3000,\n", "\n10,3000,inf\n", "file:8:9: expected a finite number for T_air_degC, found \"inf\"."},
    {"series", "\n10,3000,\n", "\n0,3000,\n", "file:8:1: expected time_s above 0 of the row before, found \"0\"."},
    {"series", "\n10,3000,\n", "\n10,3000,20,6\n",
     "file:8:1: expected 3 values, one for each column, found 4; decimals need a point, not a comma."},
    {"series", "time_s", "time_\x01s",
     "file:6:1: expected column names without quotes, separated by commas, found \"time_\\x01s\"."},
    {"series", "*", "\xE6\xB8\xA9\xE5\xBA\xA6,a_um\n1,2",
     "file:1:1: expected time_s or time_min as the first column, found \"温度\"."},
    {"series", "*", "time_s,\xE6\xB8\xA9_\xE5\xBA\xA6\n1,2",
     "file:1:8: expected a name that ends in its unit, one of _um, _mm, _urad, _degC, _rpm, _A, _W, _K, _percent, "
     "_Nm, _bar, _l_per_min, _mm_per_min, _V, or a role stated for it, found "
     "\"温_度\"."},
    {"session", "[bar]", "[#bar]", "file:4:2: expected TOML, found \"#\"."},
    {"session", "= 600.0", "= [}00", "file:11:14: expected TOML, found \"}\"."},
    {"session", "[[test]]", "[[ ]]",
     "file:6:4: expected TOML, found text that its parser refuses: Error while parsing table header: tables with blank "
     "bare keys are explicitly prohibited."},
    {"session", "= 600.0", "= 600.0\u00E9",
     "file:11:18: expected TOML, found text that its parser refuses: Error while parsing floating-point: expected "
     "decimal digit, saw '\u00E9'."},
    {"session", "title = ", "title.'\u00E9'.\u00E9 = ",
     "file:3:11: expected TOML, found text that its parser refuses: Error while parsing key: expected bare key "
     "starting character or string delimiter, saw '\u00E9'."},
    {"session", "two_arcs", "two_arc",
     "file:2:10: expected one of \"two_arcs\", \"spindle_rotation\", \"circles\" for method, found the text "
     "\"two_arc\"."},
    {"session", "method", "methode",
     "file:2:1: expected one of the keys format, method, title, spindle_above, bar, test, signals, five_probe, found "
     "\"methode\"; the nearest is method."},
    {"session", "ballbar-session 1", "ballbar-session",
     "file:1:10: expected \"ballbar-session 1\" for format, found the text \"ballbar-session\"."},
    {"session", "format = \"ballbar-session 1\"\n", "", "file:1:1: expected the key format, found none."},
    {"session", "[bar]\nnominal_length_mm = 100.0\n", "", "file:1:1: expected the key bar, found none."},
    {"session", "nominal_length_mm = 100.0", "length_mm = 100.0",
     "file:5:1: expected one of the keys nominal_length_mm, expansion_ppm_per_K in [bar], found \"length_mm\"; the "
     "nearest is nominal_length_mm."},
    {"session", "nominal_length_mm = 100.0", "nominal_length_mm = \"100\"",
     "file:5:21: expected a finite number for nominal_length_mm, found the text \"100\"."},
    {"session", "elapsed_s = 600.0", "elapsed_s = 0",
     "file:11:13: expected elapsed_s above 0 of the test before, found 0."},
    {"session", "elapsed_s = 600.0", "", "file:10:1: expected the key elapsed_s in [[test]] 2, found none."},
    {"session", "c_arc = \"01-c.csv\"", "", "file:10:1: expected the key c_arc in [[test]] 2, found none."},
    {"session", "c_arc = \"01-c.csv\"", "circle = \"01-c.csv\"",
     "file:12:10: expected a key of the method two_arcs (c_arc, a_arc), found circle, a key of circles."},
    {"session", "c_arc = \"01-c.csv\"", "c_arc = \"01-c.csv\"\nd_arc = \"x\"",
     "file:13:1: expected one of the keys c_arc, a_arc, elapsed_s in [[test]] 2, found \"d_arc\"; the nearest is "
     "c_arc."},
    {"session", "\"01-c.csv\"", "\"../01-c.csv\"",
     "file:12:9: expected a path to a file inside the session's folder for c_arc, found \"../01-c.csv\"."},
    {"session", "\"01-c.csv\"", "\"a/../../01-c.csv\"",
     "file:12:9: expected a path to a file inside the session's folder for c_arc, found \"a/../../01-c.csv\"."},
    {"session", "\"01-c.csv\"", "\"/etc/passwd\"",
     "file:12:9: expected a path to a file inside the session's folder for c_arc, found \"/etc/passwd\"."},
    {"session", "\"01-c.csv\"", "\"\"",
     "file:12:9: expected a path to a file inside the session's folder for c_arc, found \"\"."},
    {"session", "\"01-c.csv\"", "7", "file:12:9: expected a text in quotes for c_arc, found the integer 7."},
    {"session", "\"temperatures.csv\"", "\"temperatures.csv\", \"../t.csv\"",
     "file:15:30: expected a path to a file inside the session's folder for files, found \"../t.csv\"."},
    {"session", "\"temperatures.csv\"", "1.5",
     "file:15:10: expected an array of texts for files, found the number 1.5."},
    {"session", "[\"temperatures.csv\"]", "\"temperatures.csv\"",
     "file:15:9: expected an array of texts for files, found the text \"temperatures.csv\"."},
    {"session", "file = \"five-probe.csv\"", "", "file:16:1: expected the key file in [five_probe], found none."},
    {"session", "nominal_length_mm = 100.0", "nominal_length_mm = 100.0\nexpansion_ppm_per_K = \"11.7\"",
     "file:6:23: expected a finite number for expansion_ppm_per_K, found the text \"11.7\"."},
    {"session", "nominal_length_mm = 100.0", "nominal_length_mm = 100.0\nexpansion_ppm_per_K = inf",
     "file:6:23: expected a finite number for expansion_ppm_per_K, found the number inf."},
    {"session", "nominal_length_mm = 100.0", "nominal_length_mm = 100.0\nexpansion_ppm = 11.7",
     "file:6:1: expected one of the keys nominal_length_mm, expansion_ppm_per_K in [bar], found \"expansion_ppm\"; the "
     "nearest is expansion_ppm_per_K."},
    {"session", "file = \"five-probe.csv\"", "file = \"five-probe.csv\"\nball_from_plane_1_mm = \"25\"",
     "file:18:24: expected a finite number for ball_from_plane_1_mm, found the text \"25\"."},
    {"session", "file = \"five-probe.csv\"", "file = \"five-probe.csv\"\nball_from_plane_1_mm = nan",
     "file:18:24: expected a finite number for ball_from_plane_1_mm, found the number nan."},
    {"session", "file = \"five-probe.csv\"", "file = \"five-probe.csv\"\nball_sigma_mm = 0",
     "file:18:17: expected a number above 0 for ball_sigma_mm, found the integer 0."},
    {"session", "file = \"five-probe.csv\"", "file = \"five-probe.csv\"\nball_sigma_mm = -0.5",
     "file:18:17: expected a number above 0 for ball_sigma_mm, found the number -0.5."},
    {"session", "file = \"five-probe.csv\"", "file = \"five-probe.csv\"\nball_mm = 25",
     "file:18:1: expected one of the keys file, ball_from_plane_1_mm, ball_sigma_mm in [five_probe], found "
     "\"ball_mm\"; the nearest is file."},
    {"session", "file = \"five-probe.csv\"", "file = \"../five-probe.csv\"",
     "file:17:8: expected a path to a file inside the session's folder for file, found \"../five-probe.csv\"."},
    {"session", "file = \"five-probe.csv\"", "ball_from_plane_1_mm = 25",
     "file:16:1: expected the key file in [five_probe], found none."},
    {"session", "title = \"warm-up\"", "title = \"warm-up",
     "file:3:17: expected TOML, found text that its parser refuses: Error while parsing string: unescaped control "
     "characters other than TAB (U+0009) are explicitly prohibited."},
    {"session", "title = \"warm-up\"", "spindle_above = \"no\"",
     "file:3:17: expected true or false for spindle_above, found the text \"no\"."},
    {"session", "[[test]]\nelapsed_s = 600.0\nc_arc = \"01-c.csv\"\na_arc = \"01-a.csv\"\n", "test = 5\n",
     "file:10:1: expected one of the keys c_arc, a_arc, elapsed_s in [[test]] 1, found \"test\"; the nearest is "
     "c_arc."},
    {"session", "*", "format = \"ballbar-session 1\"\nmethod = \"circles\"\nbar.nominal_length_mm = 50\n",
     "file:1:1: expected at least one [[test]], found none."},
    {"session", "*", "format = \"ballbar-session 1\"\nmethod = \"circles\"\nbar = 50\n",
     "file:3:7: expected a table [bar] for bar, found the integer 50."},
    {"rotation", "axial = \"00-z.csv\"", "axial = \"00-z.csv\"\naxial_length_mm = 99.9",
     "file:9:19: expected either axial or axial_length_mm in [[test]] 1, found both."},
    {"rotation", "axial = \"00-z.csv\"", "",
     "file:5:1: expected either axial or axial_length_mm in [[test]] 1, found none."},
    {"rotation", "axial = \"00-z.csv\"", "axial_length_mm = 0.0",
     "file:8:19: expected a number above 0 for axial_length_mm, found the number 0."},
    {"b5r", "*", "", "file:1:1: expected text, found an empty file."},
    {"b5r", "*", "<TEST_DOCUMENT><TEST_SPEC>",
     "file:1:26: expected a complete XML file, found damage or an early end: Start-end tags mismatch. Copy the file "
     "again."},
    {"b5r", "*", "time_s,length_mm\n",
     "file:2:1: expected a complete XML file, found damage or an early end: No document element found. Copy the file "
     "again."},
    {"b5r", "TEST_DOCUMENT", "HTML", "file:2:2: expected TEST_DOCUMENT, the root of a .b5r file, found \"HTML\"."},
    {"b5r", "<TEST_DOCUMENT>", "<!DOCTYPE TEST_DOCUMENT [<!ENTITY a \"b\">]><TEST_DOCUMENT>",
     "file:2:1: expected XML without a document type, found <!DOCTYPE."},
    {"b5r", "&amp;", "&nbsp;",
     "file:3:28: expected no entity but &amp; &lt; &gt; &quot; &apos; and numbers, found \"&nbsp;\"."},
    {"b5r", "&amp;", "&", "file:3:28: expected no entity but &amp; &lt; &gt; &quot; &apos; and numbers, found \"&\"."},
    {"b5r", "<NOMINAL_LENGTH>100</NOMINAL_LENGTH>", "",
     "file:5:8: expected NOMINAL_LENGTH in DYNAMIC_BALLBAR, found none."},
    {"b5r", "<NOMINAL_LENGTH>100</NOMINAL_LENGTH>",
     "<NOMINAL_LENGTH>1</NOMINAL_LENGTH><NOMINAL_LENGTH>2</NOMINAL_LENGTH>",
     "file:6:44: expected one NOMINAL_LENGTH in DYNAMIC_BALLBAR, found another."},
    {"b5r", "<NOMINAL_LENGTH>100</", "<NOMINAL_LENGTH><B>1</B></",
     "file:6:10: expected plain text in NOMINAL_LENGTH, found elements."},
    {"b5r", "<NOMINAL_LENGTH>100", "<NOMINAL_LENGTH>0", "file:6:25: expected NOMINAL_LENGTH above 0, found \"0\"."},
    {"b5r", "<NOMINAL_LENGTH>100", "<NOMINAL_LENGTH>100,5",
     "file:6:25: expected a finite number for NOMINAL_LENGTH, decimals with a point, found \"100,5\"."},
    {"b5r", "<START_ANGLE>350", "<START_ANGLE>1e300",
     "file:8:22: expected START_ANGLE of at most ten turns, found \"1e300\"."},
    {"b5r", "<START_ANGLE>350</START_ANGLE>", "",
     "file:5:8: expected START_ANGLE and END_ANGLE, the arc of the readings in deg, found no START_ANGLE."},
    {"b5r", "<START_ANGLE>350", "<START_ANGLE>",
     "file:8:10: expected START_ANGLE and END_ANGLE, the arc of the readings in deg, found no START_ANGLE."},
    {"b5r", "<END_ANGLE>80", "<END_ANGLE> - ",
     "file:9:10: expected START_ANGLE and END_ANGLE, the arc of the readings in deg, found no END_ANGLE."},
    {"b5r", "<END_ANGLE>80", "<END_ANGLE>80 deg",
     "file:9:20: expected a finite number for END_ANGLE, decimals with a point, found \"80 deg\"."},
    {"b5r", "TEST_PLANE=\"ZX\"", "TEST_PLANE=\"XX\"",
     "file:10:10: expected a PLANE with TEST_PLANE XY, YZ or ZX, or YX, ZY or XZ, found \"XX\"."},
    {"b5r", "TEST_PLANE=\"ZX\"", "TEST_PLANE=\"YZ\"",
     "file:11:24: expected A_AXIS_NAME Y for the plane YZ, found \"Z\"."},
    {"b5r", "<RUN_DIRECTION>CW", "<RUN_DIRECTION>cw", "file:24:22: expected RUN_DIRECTION CCW or CW, found \"cw\"."},
    {"b5r", "<RUN_DIRECTION>CW</RUN_DIRECTION>", "", "file:23:6: expected RUN_DIRECTION in BALLBAR_RUN, found none."},
    {"b5r", "<RUN_TEMPERATURE>21.5", "<RUN_TEMPERATURE>warm",
     "file:25:24: expected a finite number for RUN_TEMPERATURE, decimals with a point, found \"warm\"."},
    {"b5r", "<START_INDEX>1", "<START_INDEX>4", "file:27:8: expected END_INDEX at or above START_INDEX 4, found 3."},
    {"b5r", "<START_INDEX>1", "<START_INDEX>-1", "file:26:20: expected START_INDEX as a count from 0, found \"-1\"."},
    {"b5r", "<END_INDEX>3", "<END_INDEX>5",
     "file:29:17: expected readings up to END_INDEX 5, found 5 readings, counted from 0."},
    {"b5r", "<END_INDEX>3", "<END_INDEX>2147483647",
     "file:29:17: expected readings up to END_INDEX 2147483647, found 5 readings, counted from 0."},
    {"b5r", "<END_INDEX>3", "<END_INDEX>99999999999999999999999",
     "file:27:18: expected END_INDEX as a count from 0, found \"99999999999999999999999\"."},
    {"b5r", "<SAMPLE_RATE>10", "<SAMPLE_RATE>0", "file:28:20: expected SAMPLE_RATE above 0, found \"0\"."},
    {"b5r", "-0.00200", "nan",
     "file:29:35: expected a finite number for a reading, decimals with a point, found \"nan\"."},
    {"b5r", "-0.00200", "+-0.00200",
     "file:29:35: expected a finite number for a reading, decimals with a point, found \"+-0.00200\"."},
    {"b5r", "-0.00200", "-100.5", "file:29:35: expected a reading that leaves a length above 0 mm, found \"-100.5\"."},
    {"b5r", "-0.00200", "-0,00200",
     "file:29:35: expected a finite number for a reading, decimals with a point, found \"-0,00200\"."},
    {"b5r", "-0.00200", "<B/>", "file:29:8: expected plain text in READINGS, found elements."},
    {"b5r", ">100.0007<", ">good<",
     "file:30:56: expected a finite number for AF_BEST_RADIUS, decimals with a point, found \"good\"."},
    {"b5r", "DT=\"UT_LENGTH_MM\"", "", "file:30:8: expected a FEATURE with NAME and DT, found one without."},
};

TEST(bad_text, is_refused_with_a_whole_sentence) {
  for (const BadText& bad : kBadTexts) {
    const std::string text = changed(bad.kind, bad.from, bad.to);
    try {
      read(bad.kind, text);
      ADD_FAILURE() << "read without complaint: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(std::string_view(error.what()), bad.message) << text;
    }
  }
}

TEST(good_text, is_read_with_and_without_byte_order_mark_cr_lf_and_last_newline) {
  for (const std::string_view kind : {"log", "axial", "series", "probes", "session", "rotation", "b5r", "both"}) {
    std::string text = good_text(kind);
    EXPECT_NO_THROW(read(kind, text)) << kind;
    text.pop_back();
    EXPECT_NO_THROW(read(kind, text)) << kind;
    std::string windows = "\xEF\xBB\xBF";
    for (const char c : text) windows += c == '\n' ? std::string("\r\n") : std::string(1, c);
    EXPECT_NO_THROW(read(kind, windows)) << kind;
  }
}

// Cut anywhere, a file is read or refused; nothing else happens.
TEST(good_text, cut_short_is_read_or_refused) {
  for (const std::string_view kind : {"log", "axial", "series", "probes", "session", "rotation", "b5r", "both"}) {
    const std::string text = good_text(kind);
    for (std::size_t size = 0; size < text.size(); ++size) {
      try {
        read(kind, text.substr(0, size));
      } catch (const Error& error) {
        EXPECT_TRUE(std::string_view(error.what()).starts_with("file:")) << error.what();
      }
    }
  }
}

}  // namespace
}  // namespace ballbar
