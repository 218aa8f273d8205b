#include "ballbar/formats/drift_files.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/bytes.hpp"
#include "ballbar/formats/series_csv.hpp"

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

std::string csv_of(const DriftSeries& drift) {
  std::string csv = write_series(series_of(drift));
  csv.insert(csv.find('\n') + 1,
             fmt::format("# method = \"{}\"\n# reference_s = {:#}\n", name_of(drift.method), drift.reference_s));
  return csv;
}

void write_variable(mat_t* file, const std::string& name, matio_classes class_type, matio_types type, std::size_t rows,
                    std::size_t columns, const void* data) {
  std::size_t size[] = {rows, columns};
  // matio copies the data.
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(name.c_str(), class_type, type, 2, size, const_cast<void*>(data), 0), &Mat_VarFree);
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) != 0) {
    throw Error(fmt::format("{}: expected room to write this variable of the .mat file, found none.", name));
  }
}

void write_mat(const DriftSeries& drift, const std::filesystem::path& path) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(
      Mat_CreateVer(path.c_str(), "MATLAB 5.0 MAT-file, drift series of ballbar", MAT_FT_MAT5), &Mat_Close);
  if (!file) throw Error(fmt::format("{}: expected a folder to write a .mat file to, found none.", path.string()));
  const auto vector = [&](const std::string& name, const std::vector<double>& values) {
    write_variable(file.get(), name, MAT_C_DOUBLE, MAT_T_DOUBLE, values.size(), 1, values.data());
  };
  const std::string method(name_of(drift.method));
  write_variable(file.get(), "method", MAT_C_CHAR, MAT_T_UTF8, 1, method.size(), method.data());
  vector("reference_s", {drift.reference_s});
  const Series series = series_of(drift);
  vector("time_s", series.time_s);
  for (const Column& column : series.columns) vector(column.name, column.values);
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

void write_drift(const DriftSeries& drift, const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".csv") {
    write_bytes(path, csv_of(drift));
  } else if (extension == ".json") {
    write_bytes(path, json_of(drift).dump(2) + "\n");
  } else if (extension == ".mat") {
    write_through(path, [&](const std::filesystem::path& temporary) { write_mat(drift, temporary); });
  } else {
    throw Error(fmt::format("{}: expected a name that ends in .csv, .json or .mat, found {}.", path.string(),
                            extension.empty() ? "no ending" : extension));
  }
}

}  // namespace ballbar
