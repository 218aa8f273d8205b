#include "ballbar/formats/recordings/circle_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/units.hpp"
#include "logs/log_sources.hpp"
#include "recordings/circle_find.hpp"
#include "recordings/circle_words.hpp"
#include "recordings/column_table.hpp"
#include "text/head.hpp"
#include "text/readers.hpp"

namespace ballbar {
namespace {

constexpr double kAgrees = 0.02;       // of the radius: a nominal one and that of the readings
constexpr double kFarFromZero = 0.01;  // of the radius: the circle's centre is no centre offset
constexpr std::string_view kSorted = ", sorted by angle";
constexpr double kLeastSpread = 0.3;  // of deviations in um; less is mm

// Readings round a circle, before they are cut into runs.
struct Readings {
  std::vector<double> angle_rad, length_mm, time_s;  // time_s may be empty
  std::optional<Direction> direction;                // that the column states
  std::string what;                                  // "X and Z in mm"
};

bool is_radius(const std::optional<double>& radius_mm) {
  return radius_mm && std::isfinite(*radius_mm) && *radius_mm > 0.0;
}

// A radius in the unit of the column, or in the likely one.
double mm_of_lengths(const NumberColumn& column, double radius, const StatedCircle& stated) {
  if (const auto known = mm_per_unit(column)) return *known;
  if (stated.radius_mm) {
    for (const double factor : {1.0, 1e-3, 1e3, 25.4}) {
      if (std::abs(factor * radius - *stated.radius_mm) <= kAgrees * *stated.radius_mm) return factor;
    }
  }
  return likely_mm_per_unit(radius);
}

std::string_view unit_of(double mm) {
  if (mm == 1.0) return "mm";
  if (mm == 1e-3) return "um";
  if (mm == 25.4) return "inch";
  return mm == 1e3 ? "m" : "nm";
}

// "in mm"; of a unit that only the size tells, that too.
std::string unit_text(double mm, const NumberColumn& column) {
  const bool by_size = !mm_per_unit(column) && mm != 1.0;
  return fmt::format("in {}{}", unit_of(mm),
                     !by_size     ? ""
                     : mm == 1e3  ? " (read as metres by their size)"
                     : mm == 25.4 ? " (read as inches by their size)"
                                  : " (read as micrometres by their size)");
}

struct NominalRadius {
  double mm = 0.0;
  bool assumed = false;
};

// As stated, as the header says, as the control wanted it, else the whole millimetre next to that of the readings.
// `radius_mm`: of these, where they have one.
NominalRadius nominal_radius(std::string_view name, const ColumnTable& table, const StatedCircle& stated,
                             const std::optional<double>& commanded_mm, const std::optional<double>& radius_mm) {
  const auto agrees = [&](const std::optional<double>& nominal_mm) {
    if (!is_radius(nominal_mm)) return false;
    return !radius_mm || std::abs(*nominal_mm - *radius_mm) <= kAgrees * *nominal_mm;
  };
  if (stated.radius_mm) {
    if (agrees(stated.radius_mm)) return {*stated.radius_mm};
    throw Error(
        fmt::format("{}: expected a circle of about the nominal radius {:g} mm that --radius states, found one of "
                    "{:.4f} mm.",
                    name, *stated.radius_mm, *radius_mm));
  }
  const std::optional<double> in_header = stated_radius_mm(table.preamble);
  if (agrees(in_header)) return {*in_header};
  if (agrees(commanded_mm)) return {std::round(1e3 * *commanded_mm) / 1e3};
  if (radius_mm) return {std::max(1.0, std::round(*radius_mm)), true};
  throw Error(fmt::format(
      "{}: expected the nominal radius of this circle, found only deviations. State it, as in --radius 100mm.", name));
}

// The first column of time; empty where there is none, or its unit is not known.
std::vector<double> times_s(const ColumnTable& table, const std::vector<std::size_t>& rows) {
  for (const NumberColumn& column : table.columns) {
    if (word_of(column) != ColumnWord::time) continue;
    const auto seconds = seconds_per_unit(column);
    if (!seconds) continue;
    std::vector<double> time_s;
    time_s.reserve(rows.size());
    for (const std::size_t row : rows) time_s.push_back(*seconds * column.values[row]);
    const bool rises = std::adjacent_find(time_s.begin(), time_s.end(), std::greater_equal<>()) == time_s.end();
    if (rises) return time_s;
  }
  return {};
}

std::optional<double> feed_of(const Readings& readings, const CircleRun& run, double radius_mm) {
  if (readings.time_s.empty()) return std::nullopt;
  const double time_s = readings.time_s[run.last] - readings.time_s[run.first];
  const double feed = radius_mm * std::abs(run.travel_rad) / time_s * 60.0;
  return std::isfinite(feed) && feed > 0.0 ? std::optional(feed) : std::nullopt;
}

void add_runs(std::vector<Recording>& recordings, const Readings& readings, const Recording& like,
              const ColumnTable& table) {
  const std::vector<double> angle_rad = unwrapped(readings.angle_rad);
  for (const CircleRun& run : runs_of(angle_rad)) {
    Recording recording = like;
    recording.direction = readings.direction.value_or(run.travel_rad > 0.0 ? Direction::CCW : Direction::CW);
    recording.feed_mm_per_min = stated_feed_mm_per_min(table.preamble);
    if (!recording.feed_mm_per_min) recording.feed_mm_per_min = feed_of(readings, run, like.nominal_length_mm);
    for (std::size_t i = run.first; i <= run.last; ++i) {
      recording.angle_rad.push_back(angle_rad[i]);
      recording.length_mm.push_back(readings.length_mm[i]);
      if (!readings.time_s.empty()) recording.time_s.push_back(readings.time_s[i] - readings.time_s[run.first]);
    }
    recordings.push_back(std::move(recording));
  }
}

Readings readings_of(const ColumnTable& table, const CoordinateCircle& circle, double mm) {
  Readings readings;
  const bool far = std::hypot(circle.centre_a, circle.centre_b) > kFarFromZero * circle.radius;
  const double a = far ? circle.centre_a : 0.0, b = far ? circle.centre_b : 0.0;
  for (const std::size_t row : circle.rows) {
    const double x = table.columns[circle.a].values[row] - a, y = table.columns[circle.b].values[row] - b;
    readings.angle_rad.push_back(std::atan2(y, x));
    readings.length_mm.push_back(mm * std::hypot(x, y));
  }
  readings.time_s = times_s(table, circle.rows);
  const std::string_view axes = circle.plane ? name_of(*circle.plane) : "XY";
  readings.what =
      fmt::format("coordinates {} and {} {}{}{}", axes[0], axes[1], unit_text(mm, table.columns[circle.a]),
                  far ? fmt::format(", from the centre of their circle at {:.4f}, {:.4f} mm", mm * a, mm * b) : "",
                  circle.sorted ? kSorted : "");
  return readings;
}

// Deviations are added to the nominal radius.
Readings readings_of(const ColumnTable& table, const PolarCircle& circle, std::size_t column, double nominal_mm,
                     double mm) {
  Readings readings;
  const NumberColumn& values = table.columns[column];
  for (const std::size_t row : circle.rows) {
    readings.angle_rad.push_back(circle.rad_per_unit * table.columns[circle.angle].values[row]);
    readings.length_mm.push_back((circle.are_lengths ? 0.0 : nominal_mm) + mm * values.values[row]);
  }
  readings.time_s = times_s(table, circle.rows);
  readings.direction = circle.values.size() == 2 ? direction_of(values) : std::nullopt;
  const std::string unit = circle.are_lengths ? unit_text(mm, values) : fmt::format("in {}", unit_of(mm));
  readings.what = fmt::format("angles in {} and {} {}{}", circle.rad_per_unit == 1.0 ? "rad" : "deg",
                              circle.are_lengths ? "lengths" : "deviations", unit, circle.sorted ? kSorted : "");
  return readings;
}

double mm_of_deviations(const NumberColumn& column) {
  if (const auto known = mm_per_unit(column)) return *known;
  const auto [low, high] = std::minmax_element(column.values.begin(), column.values.end());
  return *high - *low < kLeastSpread ? 1.0 : 1e-3;
}

void expect_lengths(std::string_view name, const RecordingFile& file) {
  for (const Recording& recording : file.recordings) {
    for (const double length_mm : recording.length_mm) {
      if (std::abs(length_mm - recording.nominal_length_mm) <= 0.1 * recording.nominal_length_mm) continue;
      throw Error(fmt::format("{}: expected readings within a tenth of the nominal radius {:g} mm, found {:g} mm.",
                              name, recording.nominal_length_mm, length_mm));
    }
  }
  if (file.recordings.empty()) {
    throw Error(fmt::format("{}: expected a run round a circle, found none.", name));
  }
}

void say(RecordingFile& file, std::string_view name, const Readings& readings, bool plane_known, bool radius_assumed) {
  std::string runs;
  for (const Recording& one : file.recordings) {
    runs += fmt::format("{}{} of {} readings", runs.empty() ? "" : ", ", name_of(one.direction), one.length_mm.size());
  }
  const Recording& first = file.recordings.front();
  file.remarks.push_back(fmt::format("{}: read as a circle from {}; plane {}{}, nominal radius {:g} mm{}; {}.", name,
                                     readings.what, name_of(first.plane), plane_known ? "" : " (not stated)",
                                     first.nominal_length_mm, radius_assumed ? " (assumed)" : "", runs));
}

RecordingFile file_of(std::string_view name, const ColumnTable& table, const CoordinateCircle& circle,
                      const StatedCircle& stated) {
  RecordingFile file;
  const double mm = mm_of_lengths(table.columns[circle.a], circle.radius, stated);
  std::optional<double> commanded_mm = circle.commanded_radius;
  if (commanded_mm) *commanded_mm *= mm;
  Recording like;
  const NominalRadius nominal = nominal_radius(name, table, stated, commanded_mm, mm * circle.radius);
  like.nominal_length_mm = nominal.mm;
  const std::optional<Plane> plane = circle.plane ? circle.plane : stated_plane(table.preamble);
  like.plane = plane.value_or(Plane::XY);
  const Readings readings = readings_of(table, circle, mm);
  add_runs(file.recordings, readings, like, table);
  expect_lengths(name, file);
  say(file, name, readings, plane.has_value(), nominal.assumed);
  return file;
}

RecordingFile file_of(std::string_view name, const ColumnTable& table, const PolarCircle& circle,
                      const StatedCircle& stated) {
  RecordingFile file;
  const NumberColumn& values = table.columns[circle.values.front()];
  const double length = median(values.values);
  const double mm = circle.are_lengths ? mm_of_lengths(values, length, stated) : mm_of_deviations(values);
  Recording like;
  const NominalRadius nominal =
      nominal_radius(name, table, stated, {}, circle.are_lengths ? std::optional(mm * length) : std::nullopt);
  like.nominal_length_mm = nominal.mm;
  const std::optional<Plane> plane = stated_plane(table.preamble);
  like.plane = plane.value_or(Plane::XY);
  Readings readings;
  for (const std::size_t column : circle.values) {
    readings = readings_of(table, circle, column, like.nominal_length_mm, mm);
    add_runs(file.recordings, readings, like, table);
  }
  expect_lengths(name, file);
  say(file, name, readings, plane.has_value(), nominal.assumed);
  return file;
}

// Of a workbook the first sheet with a circle, where none is stated.
ColumnTable table_of(std::string_view bytes, const std::string& name, const LogRecipe& recipe) {
  if (is_table_file(bytes) && recipe.sheet.empty()) {
    const WorkbookSheets sheets = workbook_sheets(bytes, name);
    for (const std::vector<std::string>& names : {sheets.alike, sheets.others}) {
      for (const std::string& sheet : names) {
        LogRecipe one = recipe;
        one.sheet = sheet;
        ColumnTable table = column_table(bytes, name, one);
        if (coordinate_circle(table, false) || polar_circle(table, false)) return table;
      }
    }
  }
  return column_table(bytes, name, recipe);
}

}  // namespace

bool holds_circle(std::string_view head) {
  if (format_name(head).starts_with("ballbar") || text_of_head(head).starts_with('<')) return false;
  const bool cut_off = head.size() >= kHeadBytes;
  // Of a workbook nothing can be read then; a MATLAB file would cost a process.
  if (is_table_file(head) && (cut_off || head.starts_with("MATLAB"))) return false;
  try {
    const ColumnTable table = table_of(head, {}, {});
    return coordinate_circle(table, cut_off) || polar_circle(table, cut_off);
  } catch (const Error&) {  // no table
    return false;
  }
}

RecordingFile read_circle_table(std::string_view bytes, std::string_view name, const StatedCircle& stated) {
  const ColumnTable table = table_of(bytes, std::string(name), stated.table);
  if (const auto circle = coordinate_circle(table, false)) return file_of(name, table, *circle, stated);
  if (const auto circle = polar_circle(table, false)) return file_of(name, table, *circle, stated);
  throw Error(
      fmt::format("{}: expected a circle, found none. A circle has coordinates on it, or an angle with a length or "
                  "a deviation. Name the columns of an arc, as in X_mm,Y_mm or angle_deg,deviation_um.",
                  name));
}

constinit const Reader readers::kCircleTable = {
    .found = "a circle in a table of numbers",
    .recording = "a table whose numbers are a circle (angle and radius, or two coordinates)",
    .is_yours = holds_circle,
    .read = read_circle_table,
};

}  // namespace ballbar
