#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/column_unit.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/series/series.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

constexpr const char* kSeries = R"(Named columns over time.

Parameters
----------
time_s : (n,) array
    s, strictly rising.
columns : dict of (n,) arrays
    Names end in a unit: ``T_room_degC``, ``speed_rpm``, ``z_um``. NaN, None, NA and what a mask covers are gaps.
roles : dict
    Of columns whose role is not the usual one of their unit: ``{"T_room_degC": "ambient"}``.
headers : dict
    Other names that find a column: ``{"T_room_degC": "T_room_degF"}``.
has_clock : bool
    False: `time_s` numbers the rows, for nothing tells the time.
started : str
    Wall clock at time 0, ``2026-11-22T13:05:10``.
five_probe : dict
    Of five probes: ``spacing_mm``, ``plane_1_from_nose_mm``, ``resolution_um``, ``linearity_percent``, and ``columns``, the
    five in the order X1, X2, Y1, Y2, Z.

Raises
------
BallbarError
    A time that does not rise, a column of another length, of no numbers, or of a name that no file could have.

Examples
--------
>>> import ballbar, numpy as np
>>> series = ballbar.Series(60.0 * np.arange(3), {"z_um": [0.0, None, 2.0]})
>>> series["z_um"]
array([ 0., nan,  2.])
)";

Role role_of(const std::string& column, const std::map<std::string, std::string>& roles) {
  const auto stated = roles.find(column);
  if (stated == roles.end()) return role_from_unit(unit_of(column));
  if (const auto role = role_from_name(stated->second)) return *role;
  throw Error(fmt::format("{}: expected a role such as ambient, structure or speed, found {}.", column,
                          in_quotes(stated->second)));
}

constexpr const char* kOfProbes[] = {"spacing_mm", "plane_1_from_nose_mm", "resolution_um", "linearity_percent"};

std::optional<double>& value_of(FiveProbe& probes, std::size_t k) {
  std::optional<double>* const values[] = {&probes.spacing_mm, &probes.plane_1_from_nose_mm, &probes.resolution_um,
                                           &probes.linearity_percent};
  return *values[k];
}

FiveProbe probes_from(const py::dict& stated) {
  FiveProbe probes;
  for (const auto& [key, value] : stated) {
    const std::string name = py::str(key);
    const auto known = std::find(std::begin(kOfProbes), std::end(kOfProbes), name);
    if (known == std::end(kOfProbes) && name != "columns") {
      throw Error(
          fmt::format("five_probe: expected {} or columns, found {}.", fmt::join(kOfProbes, ", "), in_quotes(name)));
    }
    try {
      if (name == "columns") {
        probes.columns = py::cast<std::array<std::string, 5>>(value);
      } else {
        value_of(probes, static_cast<std::size_t>(known - std::begin(kOfProbes))) =
            py::cast<std::optional<double>>(value);
      }
    } catch (const py::cast_error&) {
      throw Error(fmt::format("five_probe, {}: expected {}, found {}.", name,
                              name == "columns" ? "five names" : "a number", py::cast<std::string>(py::repr(value))));
    }
  }
  return probes;
}

py::object of_probes(Series& series) {
  if (!series.five_probe) return py::none();
  py::dict stated;
  for (std::size_t k = 0; k < std::size(kOfProbes); ++k) {
    if (const auto& value = value_of(*series.five_probe, k)) stated[kOfProbes[k]] = *value;
  }
  stated["columns"] = series.five_probe->columns;
  return std::move(stated);
}

// Such as the first line of a series .csv can hold.
void expect_name(const Series& series, const std::string& name) {
  const auto breaks = [](unsigned char byte) { return byte < ' ' || byte == ',' || byte == '"'; };
  if (name.empty() || std::any_of(name.begin(), name.end(), breaks) || name.front() == ' ' || name.back() == ' ') {
    throw Error(
        fmt::format("columns: expected a name without comma, quote and line break, found {}.", in_quotes(name)));
  }
  if (name == "time_s" || name == "time_min" || find_column(series, name) != nullptr) {
    throw Error(fmt::format("columns: expected each name once, and no second time, found {}.", in_quotes(name)));
  }
}

void expect_rising(const std::vector<double>& time_s) {
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    if (std::isfinite(time_s[i]) && (i == 0 || time_s[i] > time_s[i - 1])) continue;
    throw Error(fmt::format("time_s, row {}: expected a time that is finite and later than the row before, found {}.",
                            i, time_s[i]));
  }
}

Column column_of(const std::string& name, const py::object& data, Role role, std::size_t rows) {
  Column column{name, role, vector_of(data, name)};
  if (column.values.size() != rows) {
    throw Error(
        fmt::format("{}: expected as many values as time_s has, {}, found {}.", name, rows, column.values.size()));
  }
  const auto infinite =
      std::find_if(column.values.begin(), column.values.end(), [](double v) { return std::isinf(v); });
  if (infinite == column.values.end()) return column;
  throw Error(fmt::format("{}, row {}: expected a finite value, or NaN for a gap, found {}.", name,
                          infinite - column.values.begin(), *infinite));
}

std::shared_ptr<Series> series_of(const py::object& time_s, const py::dict& columns,
                                  const std::map<std::string, std::string>& roles,
                                  const std::map<std::string, std::string>& headers, bool has_clock,
                                  const std::optional<std::string>& started, const std::optional<py::dict>& probes) {
  auto series = std::make_shared<Series>();
  series->has_clock = has_clock;
  series->time_s = vector_of(time_s, "time_s");
  expect_rising(series->time_s);
  if (started && !seconds_of_stamp(*started)) {
    throw Error(
        fmt::format("started: expected a date and time such as 2026-11-22T13:05:10, found {}.", in_quotes(*started)));
  }
  series->started = started;
  if (probes) series->five_probe = probes_from(*probes);
  for (const auto& [key, data] : columns) {
    const std::string name = py::str(key);
    expect_name(*series, name);
    series->columns.push_back(
        column_of(name, py::reinterpret_borrow<py::object>(data), role_of(name, roles), series->time_s.size()));
    if (const auto header = headers.find(name); header != headers.end()) series->columns.back().header = header->second;
  }
  for (const auto& [name, role] : roles) {
    if (find_column(*series, name) != nullptr) continue;
    throw Error(fmt::format("roles: expected names of columns, found {}.", in_quotes(name)));
  }
  return series;
}

// All that there is of it: one that was read from a file may know more than the constructor takes.
py::tuple state_of(Series& series) {
  py::list columns, runs;
  for (const Column& one : series.columns) {
    columns.append(py::make_tuple(one.name, static_cast<int>(one.role), array_of(one.values), one.header));
  }
  for (const RunOrigin& one : series.runs) runs.append(py::make_tuple(one.name, static_cast<int>(one.start)));
  return py::make_tuple(array_of(series.time_s), columns, series.started, of_probes(series), runs, series.has_clock);
}

std::shared_ptr<Series> series_from(const py::tuple& state) {
  auto series = std::make_shared<Series>();
  series->time_s = vector_of(state[0], "time_s");
  using StateOfColumn = std::tuple<std::string, int, py::object, std::string>;
  for (const auto& [name, role, values, header] : py::cast<std::vector<StateOfColumn>>(state[1])) {
    series->columns.push_back({name, static_cast<Role>(role), vector_of(values, name), header});
  }
  series->started = py::cast<std::optional<std::string>>(state[2]);
  if (!state[3].is_none()) series->five_probe = probes_from(py::cast<py::dict>(state[3]));
  for (const auto& [name, start] : py::cast<std::vector<std::pair<std::string, int>>>(state[4])) {
    series->runs.push_back({name, static_cast<RunStart>(start)});
  }
  series->has_clock = py::cast<bool>(state[5]);
  return series;
}

}  // namespace

void bind_series(py::module_& module) {
  py::class_<Series, std::shared_ptr<Series>>(module, "Series", kSeries)
      .def(py::init(&series_of), py::arg("time_s"), py::arg("columns"), py::kw_only(),
           py::arg("roles") = std::map<std::string, std::string>{},
           py::arg("headers") = std::map<std::string, std::string>{}, py::arg("has_clock") = true,
           py::arg("started") = py::none(), py::arg("five_probe") = py::none())
      .def_property_readonly(
          "time_s", [](const py::object& self) { return view_of(py::cast<const Series&>(self).time_s, self); },
          "(n,) s, strictly rising; read-only.")
      .def_property_readonly("names", &column_names, "Of the columns, in order.")
      .def_property_readonly(
          "roles",
          [](const Series& series) {
            std::map<std::string, std::string> roles;
            for (const Column& one : series.columns) roles[one.name] = std::string(name_of(one.role));
            return roles;
          },
          "What each column stands for in a model.")
      .def_property_readonly(
          "units",
          [](const Series& series) {
            std::map<std::string, std::string> units;
            for (const Column& one : series.columns) units[one.name] = std::string(unit_of(one.name));
            return units;
          },
          "The unit of each column, as its name ends; empty: none.")
      .def_property_readonly("five_probe", &of_probes, "What is stated of five probes, or None.")
      .def_readonly("started", &Series::started, "Wall clock at time 0, or None.")
      .def_readonly("has_clock", &Series::has_clock, "False: time_s numbers the rows, for no file tells the time.")
      .def(
          "__getitem__",
          [](const py::object& self, const std::string& name) {
            const Column* const column = find_column(py::cast<const Series&>(self), name);
            if (column == nullptr) throw py::key_error(name);
            return view_of(column->values, self);
          },
          "A column, (n,), in the unit of its name; read-only.")
      .def(
          "__contains__",
          [](const Series& series, const py::object& name) {
            return py::isinstance<py::str>(name) && find_column(series, py::cast<std::string>(name)) != nullptr;
          },
          "Whether there is a column of that name.")
      .def(
          "__iter__", [](const Series& series) { return py::iter(py::cast(column_names(series))); },
          "Over the names of the columns, as a DataFrame's.")
      .def(
          "__len__", [](const Series& series) { return series.time_s.size(); }, "Rows.")
      .def(
          "write",
          [](const Series& series, const std::filesystem::path& path) {
            const py::gil_scoped_release free;
            write_series(series, path);
          },
          py::arg("path"),
          "Writes a series .csv, which reads back to the same numbers; a gap is an empty cell.\n\n"
          "Raises\n------\nBallbarError\n    Where the file cannot be written.")
      .def("__eq__", [](Series& one, const py::object& other) { return equal(one, other, &state_of); })
      .def("__repr__",
           [](const Series& series) {
             return fmt::format("<ballbar.Series {} rows of {}>", series.time_s.size(),
                                fmt::join(column_names(series), ", "));
           })
      .def(py::pickle(&state_of, &series_from));
  module.def(
      "unit_of", [](const std::string& name) { return std::string(unit_of(name)); }, py::arg("name"));
  module.def(
      "column_unit",
      [](const std::string& unit) -> py::object {
        const auto known = column_unit(unit);
        return known ? py::object(py::make_tuple(known->canonical, known->factor, known->offset)) : py::none();
      },
      py::arg("unit"));
  module.def(
      "in_unit_of_series",
      [](const std::string& name) -> py::object {
        const auto known = in_unit_of_series(name);
        return known ? py::object(py::make_tuple(known->name, known->unit.factor, known->unit.offset)) : py::none();
      },
      py::arg("name"));
  module.def(
      "read_series",
      [](const std::filesystem::path& path) {
        return Listener(py::none()).hear([&] { return std::make_shared<Series>(open_series(path)); });
      },
      py::arg("path"),
      "The columns of a series .csv, or of a logger's file as `import_log` takes it.\n\n"
      "Parameters\n----------\npath : path\n\nReturns\n-------\nSeries\n\n"
      "Raises\n------\nBallbarError\n    A file that is no series, with line and column.");
}

}  // namespace ballbar::python
