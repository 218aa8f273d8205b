#include "ballbar/formats/series/drift_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "ballbar/drift/five_probes.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "series/mat_file.hpp"

namespace ballbar {
namespace {

using Member = std::optional<Estimate> DriftPoint::*;

constexpr std::pair<std::string_view, Member> kEstimates[] = {
    {"x", &DriftPoint::x},
    {"y", &DriftPoint::y},
    {"z", &DriftPoint::z},
    {"radial", &DriftPoint::radial},
    {"axial", &DriftPoint::axial},
    {"shift_a", &DriftPoint::shift_a},
    {"shift_b", &DriftPoint::shift_b},
    {"radius_change", &DriftPoint::radius_change},
    {"radius_change_a", &DriftPoint::radius_change_a},
};

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

// A column of one value a point; left out where no point has it.
template <class ValueOf>
void add_column(Series& series, const DriftSeries& drift, std::string name, ValueOf value_of) {
  Column column{std::move(name), Role::measured, {}};
  bool any = false;
  for (const DriftPoint& point : drift.points) {
    const std::optional<double> value = value_of(point);
    any = any || value.has_value();
    column.values.push_back(value && std::isfinite(*value) ? *value : kGap);
  }
  if (any) series.columns.push_back(std::move(column));
}

nlohmann::ordered_json json_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return value;
}

// Where the test itself found the spindle's ball, set-up errors included.
nlohmann::ordered_json json_of(const Position& position) {
  constexpr std::pair<std::string_view, std::optional<Estimate> Position::*> kParts[] = {
      {"x", &Position::x},
      {"y", &Position::y},
      {"z", &Position::z},
      {"centre_a", &Position::centre_a},
      {"centre_b", &Position::centre_b},
  };
  nlohmann::ordered_json row;
  row["time_s"] = position.time_s;
  for (const auto& [name, member] : kParts) {
    if (!(position.*member)) continue;
    row[fmt::format("{}_um", name)] = json_number((position.*member)->value_um);
    row[fmt::format("{}_sigma_um", name)] = json_number((position.*member)->sigma_um);
  }
  if (position.length_mm) row["length_mm"] = *position.length_mm;
  row["radius_mm"] = json_number(position.radius_mm);
  row["converged"] = position.converged;
  row["discounted"] = position.discounted;
  return row;
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

nlohmann::ordered_json json_of(const DriftRange& range, const std::string& unit) {
  const std::pair<const char*, const std::optional<Estimate>&> parts[] = {{"first_60_min", range.first_60_min},
                                                                          {"after_60_min", range.after_60_min},
                                                                          {"total", range.total},
                                                                          {"first_to_last", range.at_end}};
  nlohmann::ordered_json json;
  for (const auto& [name, part] : parts) {
    if (!part) continue;
    json[fmt::format("{}_{}", name, unit)] = json_number(part->value_um);
    json[fmt::format("{}_sigma_{}", name, unit)] = json_number(part->sigma_um);
  }
  return json;
}

nlohmann::ordered_json ranges_of(const MeasuredDrift& drift, std::size_t begin, std::size_t end) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const DriftAxis& axis : drift.axes)
    json[axis.name] = json_of(range_of(axis, drift.time_s, begin, end), axis.unit);
  return json;
}

void write_json(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, std::ostream& out) {
  const Series series = series_of(drift);
  out << fmt::format("{{\n  \"method\": \"five_probe\",\n  \"reference_s\": {},\n  \"points\": [", drift.reference_s);
  for (std::size_t row = 0; row < series.time_s.size(); ++row) {
    std::string line = fmt::format("{}\n    {{\"time_s\": {}", row == 0 ? "" : ",", series.time_s[row]);
    for (const Column& column : series.columns) {
      const double value = column.values[row];
      line += std::isfinite(value) ? fmt::format(", \"{}\": {}", column.name, value)
                                   : fmt::format(", \"{}\": null", column.name);
    }
    out << line << "}";
  }
  nlohmann::ordered_json step_rows = nlohmann::ordered_json::array();
  for (const SpeedStep& step : steps) {
    step_rows.push_back({{"from_s", drift.time_s[step.begin]},
                         {"to_s", drift.time_s[step.end - 1]},
                         {"speed_rpm", json_number(step.speed_rpm)},
                         {"ranges", ranges_of(drift, step.begin, step.end)}});
  }
  const nlohmann::ordered_json remarks = drift.remarks;
  out << "\n  ],\n  \"ranges\": " << ranges_of(drift, 0, drift.time_s.size()).dump()
      << ",\n  \"steps\": " << step_rows.dump() << ",\n  \"remarks\": " << remarks.dump() << "\n}\n";
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
      if (!file) throw Error(fmt::format("{}: expected room to write the series, found none.", path.string()));
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
  for (const auto& [name, member] : kEstimates) {
    const auto part = [member = member](double Estimate::*value) {
      return [member, value](const DriftPoint& point) {
        const std::optional<Estimate>& estimate = point.*member;
        return estimate ? std::optional(*estimate.*value) : std::nullopt;
      };
    };
    add_column(series, drift, fmt::format("{}_um", name), part(&Estimate::value_um));
    add_column(series, drift, fmt::format("{}_sigma_um", name), part(&Estimate::sigma_um));
  }
  add_column(series, drift, "elongation_correction_um",
             [](const DriftPoint& point) { return point.elongation_correction_um; });
  return series;
}

nlohmann::ordered_json json_of(const DriftSeries& drift) {
  nlohmann::ordered_json json;
  json["method"] = name_of(drift.method);
  json["reference_s"] = drift.reference_s;
  json["points"] = nlohmann::ordered_json::array();
  for (const DriftPoint& point : drift.points) {
    nlohmann::ordered_json row;
    row["time_s"] = point.time_s;
    for (const auto& [name, member] : kEstimates) {
      if (point.*member) row[fmt::format("{}_um", name)] = json_number((point.*member)->value_um);
    }
    for (const auto& [name, member] : kEstimates) {
      if (point.*member) row[fmt::format("{}_sigma_um", name)] = json_number((point.*member)->sigma_um);
    }
    if (point.elongation_correction_um) row["elongation_correction_um"] = json_number(*point.elongation_correction_um);
    if (point.correlation_y_z) row["correlation_y_z"] = json_number(*point.correlation_y_z);
    json["points"].push_back(std::move(row));
  }
  json["positions"] = nlohmann::ordered_json::array();
  for (const Position& position : drift.positions) json["positions"].push_back(json_of(position));
  json["not_cancelled"] = drift.not_cancelled;
  return json;
}

std::string json_text(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps) {
  std::ostringstream out;
  write_json(drift, steps, out);
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

void write_drift(const MeasuredDrift& drift, const std::vector<SpeedStep>& steps, const std::filesystem::path& path) {
  write_by_extension(
      path,
      [&] {
        return DriftColumns{"five_probe", drift.reference_s, series_of(drift)};
      },
      [&](std::ostream& out) { write_json(drift, steps, out); });
}

}  // namespace ballbar
