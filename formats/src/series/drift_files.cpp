#include "ballbar/formats/series/drift_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <utility>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "series/mat_file.hpp"

namespace ballbar {
namespace {

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// A column of one value a point; left out where no point has it.
template <class Get>
void add_column(Series& series, const DriftSeries& drift, const Field<Get>& field) {
  Column column{std::string(field.name), Role::measured, {}};
  bool any = false;
  for (const DriftPoint& point : drift.points) {
    const std::optional<double> value = field.get(point).value;
    any = any || value.has_value();
    column.values.push_back(value && std::isfinite(*value) ? *value : kGap);
  }
  if (any) series.columns.push_back(std::move(column));
}

// A drift as columns, whatever it was measured by.
struct DriftColumns {
  std::string_view method;
  double reference_s = 0.0;
  Series series;
};

void write_csv(const DriftColumns& drift, const std::filesystem::path& path) {
  std::string header = series_header(drift.series);
  header.insert(header.find('\n') + 1,
                fmt::format("# method = \"{}\"\n# reference_s = {:#}\n", drift.method, drift.reference_s));
  write_series_parts(drift.series, header, path);
}

TableOf<DriftRange> ranges_of(const MeasuredDrift& drift, std::size_t begin, std::size_t end) {
  TableOf<DriftRange> ranges;
  for (const DriftAxis& axis : drift.axes) ranges.emplace_back(axis.name, range_of(axis, drift.time_s, begin, end));
  return ranges;
}

FiveProbeDrift result_of(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                         std::optional<double> stable_um) {
  FiveProbeDrift result{drift.method, drift.reference_s, series_of(drift), {}, sheet, drift.remarks};
  for (const SpeedStep& step : steps) {
    result.steps.push_back({drift.time_s[step.begin], drift.time_s[step.end - 1], step.speed_rpm,
                            sheet.test.motion_unit, ranges_of(drift, step.begin, step.end),
                            settling_of(drift, step.begin, step.end, stable_um)});
  }
  return result;
}

// Neither measured, nor a length, nor a number such as that of a part; and it changes.
bool may_cause(const Column& column) {
  const std::string_view unit = unit_of(column.name);
  if (column.role == Role::measured || unit.empty() || unit == "um" || unit == "mm") return false;
  const auto first =
      std::find_if(column.values.begin(), column.values.end(), [](double value) { return std::isfinite(value); });
  return std::any_of(first, column.values.end(), [&](double value) { return std::isfinite(value) && value != *first; });
}

void write_rows(std::ostream& out, const Series& series) {
  std::string_view time;  // the first key
  kResult<SeriesRow>.fields.each([&](const auto& field) { time = time.empty() ? field.name : time; });
  out << '[';
  for (std::size_t row = 0; row < series.time_s.size(); ++row) {
    std::string line = fmt::format("{}\n    {{\"{}\": {}", row == 0 ? "" : ",", time, series.time_s[row]);
    for (const Column& column : series.columns) {
      const double value = column.values[row];
      line += std::isfinite(value) ? fmt::format(", \"{}\": {}", column.name, value)
                                   : fmt::format(", \"{}\": null", column.name);
    }
    out << line << "}";
  }
  out << "\n  ]";
}

// The keys of a field, which may be several.
template <class Value>
void write_keys(std::ostream& out, std::string_view& before, std::string_view name, const Value& value) {
  Json json;
  KeyOf<Value>::add(json, name, value);
  for (const auto& [key, of_key] : json.items())
    out << std::exchange(before, ",") << "\n  \"" << key << "\": " << of_key.dump();
}
void write_keys(std::ostream& out, std::string_view& before, std::string_view name, const Series& series) {
  out << std::exchange(before, ",") << "\n  \"" << name << "\": ";
  write_rows(out, series);
}
void write_keys(std::ostream& out, std::string_view& before, std::string_view name, const Known<double>& known) {
  out << std::exchange(before, ",") << "\n  \"" << name << "\": " << fmt::format("{}", known.value);
}

void write_json(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                std::optional<double> stable_um, std::ostream& out) {
  const FiveProbeDrift result = result_of(drift, steps, sheet, stable_um);
  std::string_view before = "{";
  const auto write = [&](const auto& field) { write_keys(out, before, field.name, value_in(result, field.get)); };
  kResult<FiveProbeDrift>.fields.each(write);
  out << "\n}\n";
}

template <class Columns, class WriteJson>
void write_by_extension(const std::filesystem::path& path, Columns columns, WriteJson write_json) {
  const std::string extension = path.extension().string();
  if (extension == ".csv") {
    write_through(path, [&](const std::filesystem::path& temporary) { write_csv(columns(), temporary); });
  } else if (extension == ".json") {
    write_through(path, [&](const std::filesystem::path& temporary) {
      std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
      write_json(file);
      file.close();
      if (!file) throw Error(fmt::format("{}: expected space to write the series, found none.", path.string()));
    });
  } else if (extension == ".mat") {
    expect_mat(path);
    write_through(path, [&](const std::filesystem::path& temporary) {
      const DriftColumns drift = columns();
      write_mat(drift.method, drift.reference_s, drift.series, temporary);
    });
  } else {
    throw Error(fmt::format("{}: expected a name that ends in .csv, .json or .mat, found {}.", path.string(),
                            extension.empty() ? "no ending" : extension));
  }
}

}  // namespace

Series series_of(const DriftSeries& drift) {
  Series series;
  for (const DriftPoint& point : drift.points) series.time_s.push_back(point.time_s);
  kDriftPointColumns.each([&](const auto& field) { add_column(series, drift, field); });
  return series;
}

DriftSheet sheet_of(const MeasuredDrift& drift, std::span<const Series> signals, const std::vector<SpeedStep>& steps,
                    std::optional<double> stable_um) {
  const std::size_t n = drift.time_s.size();
  DriftSheet sheet;
  sheet.test = thermal_test(signals, drift.time_s.front(), drift.time_s.back());
  sheet.largest = largest_drifts(drift);
  sheet.ranges = ranges_of(drift, 0, n);
  const bool is_alone = std::all_of(signals.begin(), signals.end(), [](const Series& series) {
    return std::none_of(series.columns.begin(), series.columns.end(), &may_cause);
  });
  for (const DriftAxis& axis : drift.axes) {
    if (!is_alone || signals.empty() || drift.method != "log" || axis.unit != "um") continue;
    std::optional<Course> course = course_of(drift.time_s, axis.value);
    if (!course) continue;
    course->axis = axis.name;
    sheet.courses.push_back(std::move(*course));
  }
  const bool is_at_rest = sheet.test.kind == ThermalTestKind::environment;  // it follows the room, and does not settle
  if (steps.size() < 2 && !is_at_rest) sheet.settling = settling_of(drift, 0, n, stable_um);
  const auto is_moving = [](const SpeedStep& step) { return std::abs(step.speed_rpm) > 1.0; };
  if (steps.size() > 1 && std::count_if(steps.begin(), steps.end(), is_moving) == 1) {
    const SpeedStep& step = *std::find_if(steps.begin(), steps.end(), is_moving);
    sheet.in_motion = ranges_of(drift, step.begin, step.end);
    sheet.settling = settling_of(drift, step.begin, step.end, stable_um);
  }
  return sheet;
}

std::string json_text(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                      std::optional<double> stable_um) {
  std::ostringstream out;
  write_json(drift, steps, sheet, stable_um, out);
  return std::move(out).str();
}

void write_drift(const DriftSeries& drift, const std::filesystem::path& path) {
  write_by_extension(
      path,
      [&] {
        return DriftColumns{name_of(drift.method), drift.reference_s, series_of(drift)};
      },
      [&](std::ostream& out) { out << json_of(drift).dump(2) << '\n'; });
}

void write_drift(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const DriftSheet& sheet,
                 const std::filesystem::path& path, std::optional<double> stable_um) {
  write_by_extension(
      path,
      [&] {
        return DriftColumns{drift.method, drift.reference_s, series_of(drift)};
      },
      [&](std::ostream& out) { write_json(drift, steps, sheet, stable_um, out); });
}

}  // namespace ballbar
