#include "python/arrays.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/nearest_name.hpp"
#include "ballbar/series/series.hpp"
#include "ballbar/units.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

Role role_of(const std::string& column, const std::map<std::string, std::string>& roles) {
  const auto stated = roles.find(column);
  if (stated == roles.end()) return role_from_unit(unit_of(column));
  if (const auto role = role_from_name(stated->second)) return *role;
  throw Error(fmt::format("{}: expected a role such as ambient, structure or speed, found {}.", column,
                          in_quotes(stated->second)));
}

std::shared_ptr<Series> series_of(const Numbers& time_s, const py::dict& columns,
                                  const std::map<std::string, std::string>& roles,
                                  const std::optional<std::string>& started) {
  auto series = std::make_shared<Series>();
  series->time_s = vector_of(time_s, "time_s");
  series->started = started;
  for (std::size_t i = 0; i < series->time_s.size(); ++i) {
    if (!std::isfinite(series->time_s[i]) || (i > 0 && !(series->time_s[i] > series->time_s[i - 1]))) {
      throw Error(fmt::format("time_s, row {}: expected a time that is finite and later than the row before, found {}.",
                              i, series->time_s[i]));
    }
  }
  for (const auto& [key, array] : columns) {
    const std::string name = py::str(key);
    Column column{name, role_of(name, roles), vector_of(py::cast<Numbers>(array), name.c_str())};
    if (column.values.size() != series->time_s.size()) {
      throw Error(fmt::format("{}: expected as many values as time_s has, {}, found {}.", name, series->time_s.size(),
                              column.values.size()));
    }
    series->columns.push_back(std::move(column));
  }
  return series;
}

const Column& column_of(const Series& series, const std::string& name) {
  if (const Column* const column = find_column(series, name)) return *column;
  throw py::key_error(name);
}

std::shared_ptr<Series> read_any_series(const std::filesystem::path& path) {
  const py::gil_scoped_release free;
  return std::make_shared<Series>(open_series(path));
}

template <class Value>
Value named(const char* what, const std::string& name, std::initializer_list<Value> values) {
  std::string known;
  for (const Value value : values) {
    if (name_of(value) == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name_of(value));
  }
  throw Error(fmt::format("{}: expected one of {}, found {}.", what, known, in_quotes(name)));
}

struct OfRecording {
  std::string plane = "XY", direction = "CCW", motion = "linear_axes";
  double nominal_length_mm = 100.0, height_offset_mm = 0.0;
  std::optional<double> feed_mm_per_min;
};

std::shared_ptr<Recording> recording_of(const Numbers& length_mm, const std::optional<Numbers>& angle_deg,
                                        const std::optional<Numbers>& time_s, const OfRecording& of) {
  auto recording = std::make_shared<Recording>();
  recording->length_mm = vector_of(length_mm, "length_mm");
  if (time_s) recording->time_s = vector_of(*time_s, "time_s");
  recording->kind = angle_deg ? Kind::circle : Kind::axial;
  if (angle_deg) {
    recording->angle_rad = vector_of(*angle_deg, "angle_deg");
    for (double& angle : recording->angle_rad) angle = rad_from_deg(angle);
  }
  const std::size_t n = recording->length_mm.size();
  const std::pair<const char*, std::size_t> beside[] = {{"angle_deg", recording->angle_rad.size()},
                                                        {"time_s", recording->time_s.size()}};
  for (const auto& [name, count] : beside) {
    if (count == 0 && !(name == std::string("angle_deg") && angle_deg)) continue;
    if (count != n) throw Error(fmt::format("{}: expected {} values, as length_mm has, found {}.", name, n, count));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_angle = recording->angle_rad.empty() || std::isfinite(recording->angle_rad[i]);
    if (std::isfinite(recording->length_mm[i]) && recording->length_mm[i] > 0.0 && is_angle) continue;
    throw Error(fmt::format("reading {}: expected a finite angle and a length above 0, found {} mm.", i,
                            recording->length_mm[i]));
  }
  recording->plane = named("plane", of.plane, {Plane::XY, Plane::YZ, Plane::ZX});
  recording->direction = named("direction", of.direction, {Direction::CCW, Direction::CW});
  recording->motion = named("motion", of.motion, {Motion::linear_axes, Motion::rotary_axis, Motion::spindle});
  recording->nominal_length_mm = of.nominal_length_mm;
  recording->height_offset_mm = of.height_offset_mm;
  recording->feed_mm_per_min = of.feed_mm_per_min;
  return recording;
}

void bind_series(py::module_& module) {
  py::class_<Series, std::shared_ptr<Series>>(module, "Series",
                                              "Named columns over time.\n\n"
                                              "time_s: (n,) strictly rising; columns: (n,) each, names end in a "
                                              "unit (T_room_degC, speed_rpm, z_um), NaN is a gap; roles: of "
                                              "columns whose role is not the usual one of their unit; started: "
                                              "wall clock at time 0, 2026-11-22T13:05:10.")
      .def(py::init(&series_of), py::arg("time_s"), py::arg("columns"), py::kw_only(),
           py::arg("roles") = std::map<std::string, std::string>{}, py::arg("started") = py::none())
      .def_property_readonly("time_s",
                             [](const py::object& self) { return view_of(py::cast<const Series&>(self).time_s, self); })
      .def_property_readonly("names",
                             [](const Series& series) {
                               std::vector<std::string> names;
                               for (const Column& column : series.columns) names.push_back(column.name);
                               return names;
                             })
      .def_property_readonly("roles",
                             [](const Series& series) {
                               std::map<std::string, std::string> roles;
                               for (const Column& one : series.columns)
                                 roles[one.name] = std::string(name_of(one.role));
                               return roles;
                             })
      .def_readonly("started", &Series::started)
      .def("__getitem__",
           [](const py::object& self, const std::string& name) {
             return view_of(column_of(py::cast<const Series&>(self), name).values, self);
           })
      .def("__len__", [](const Series& series) { return series.time_s.size(); })
      .def(
          "write",
          [](const Series& series, const std::filesystem::path& path) {
            const py::gil_scoped_release free;
            write_through(path, [&](const std::filesystem::path& temporary) {
              write_series_parts(series, series_header(series), temporary);
            });
          },
          py::arg("path"));
  module.def("read_series", &read_any_series, py::arg("path"),
             "The columns of a series .csv, or of a logger's file as import_log takes it. Throws BallbarError.");
}

void bind_recording(py::module_& module) {
  py::class_<Recording, std::shared_ptr<Recording>>(module, "Recording",
                                                    "One ballbar recording: (n,) lengths in mm along a circle, "
                                                    "with (n,) angles in deg from +A towards +B, or along a line, "
                                                    "without.\n\nplane: XY, YZ, ZX; direction: CCW, CW; "
                                                    "motion: linear_axes, rotary_axis, spindle.")
      .def(py::init([](const Numbers& length_mm, const std::optional<Numbers>& angle_deg,
                       const std::optional<Numbers>& time_s, std::string plane, std::string direction,
                       std::string motion, double nominal_length_mm, double height_offset_mm,
                       std::optional<double> feed_mm_per_min) {
             return recording_of(length_mm, angle_deg, time_s,
                                 {std::move(plane), std::move(direction), std::move(motion), nominal_length_mm,
                                  height_offset_mm, feed_mm_per_min});
           }),
           py::arg("length_mm"), py::arg("angle_deg") = py::none(), py::kw_only(), py::arg("time_s") = py::none(),
           py::arg("plane") = "XY", py::arg("direction") = "CCW", py::arg("motion") = "linear_axes",
           py::arg("nominal_length_mm") = 100.0, py::arg("height_offset_mm") = 0.0,
           py::arg("feed_mm_per_min") = py::none())
      .def_property_readonly(
          "length_mm", [](const py::object& self) { return view_of(py::cast<const Recording&>(self).length_mm, self); })
      .def_property_readonly(
          "angle_rad", [](const py::object& self) { return view_of(py::cast<const Recording&>(self).angle_rad, self); })
      .def_property_readonly(
          "time_s", [](const py::object& self) { return view_of(py::cast<const Recording&>(self).time_s, self); })
      .def_property_readonly("plane", [](const Recording& one) { return name_of(one.plane); })
      .def_property_readonly("direction", [](const Recording& one) { return name_of(one.direction); })
      .def_property_readonly("motion", [](const Recording& one) { return name_of(one.motion); })
      .def_readonly("nominal_length_mm", &Recording::nominal_length_mm)
      .def_readonly("height_offset_mm", &Recording::height_offset_mm)
      .def_readonly("feed_mm_per_min", &Recording::feed_mm_per_min)
      .def("__len__", [](const Recording& one) { return one.length_mm.size(); });
  module.def(
      "read_recordings",
      [](const std::filesystem::path& path) {
        std::vector<std::shared_ptr<Recording>> recordings;
        const py::gil_scoped_release free;
        for (Recording& one : open_recording(path).recordings) {
          recordings.push_back(std::make_shared<Recording>(std::move(one)));
        }
        return recordings;
      },
      py::arg("path"), "The recordings of a .b5r or of a ballbar log. Throws BallbarError.");
}

}  // namespace

std::vector<double> vector_of(const Numbers& array, const char* name) {
  if (array.ndim() == 1) return {array.data(), array.data() + array.size()};
  throw Error(fmt::format("{}: expected an array of one dimension, found {}.", name, array.ndim()));
}

py::array view_of(const std::vector<double>& values, py::handle owner) {
  py::array_t<double> view(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  py::setattr(view.attr("flags"), "writeable", py::bool_(false));
  return std::move(view);
}

void bind_arrays(py::module_& module) {
  bind_series(module);
  bind_recording(module);
}

}  // namespace ballbar::python
