#include <fmt/format.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "ballbar/circle/recording.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/units.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

constexpr const char* kRecording =
    R"(One ballbar recording: lengths along a circle, with angles, or along a line, without.

Parameters
----------
length_mm : (n,) array
    The bar's length, mm, above 0.
angle_deg : (n,) array
    From +A towards +B of the plane (A, B), deg.
time_s : (n,) array
    From the start of the sweep, s, not falling; without it uniform.
plane : str
    XY, YZ or ZX.
direction : str
    CCW or CW.
motion : str
    What drives the circle: linear_axes, rotary_axis or spindle.
nominal_length_mm : float
    mm, above 0.
height_offset_mm : float
    Of the balls, mm.
feed_mm_per_min : float
    mm/min, above 0.

Raises
------
BallbarError
    A reading that cannot be, arrays of unequal length, a name that there is not.
)";

template <class Value>
Value named(const char* what, const std::string& name, std::initializer_list<Value> values) {
  std::string known;
  for (const Value value : values) {
    if (name_of(value) == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name_of(value));
  }
  throw Error(fmt::format("{}: expected one of {}, found {}.", what, known, in_quotes(name)));
}

void expect_count(const char* name, const std::vector<double>& values, std::size_t count) {
  if (values.size() == count) return;
  throw Error(fmt::format("{}: expected {} values, as length_mm has, found {}.", name, count, values.size()));
}

void expect_readings(const Recording& recording) {
  for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
    const bool is_angle = recording.angle_rad.empty() || std::isfinite(recording.angle_rad[i]);
    if (!std::isfinite(recording.length_mm[i]) || recording.length_mm[i] <= 0.0 || !is_angle) {
      throw Error(fmt::format("reading {}: expected a finite angle and a length above 0, found {} mm.", i,
                              recording.length_mm[i]));
    }
    if (recording.time_s.empty()) continue;
    const double time_s = recording.time_s[i];
    if (std::isfinite(time_s) && (i == 0 || time_s >= recording.time_s[i - 1])) continue;
    throw Error(fmt::format("time_s, reading {}: expected a time that is finite and not before the last, found {}.", i,
                            time_s));
  }
}

void expect_positive(const char* name, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  throw Error(fmt::format("{}: expected a number above 0, found {}.", name, value));
}

std::shared_ptr<Recording> recording_of(const py::object& length_mm, const py::object& angle_deg,
                                        const py::object& time_s, const std::string& plane,
                                        const std::string& direction, const std::string& motion,
                                        double nominal_length_mm, double height_offset_mm,
                                        std::optional<double> feed_mm_per_min) {
  auto recording = std::make_shared<Recording>();
  recording->length_mm = vector_of(length_mm, "length_mm");
  const std::size_t n = recording->length_mm.size();
  if (n == 0) throw Error("length_mm: expected readings, found none.");
  recording->kind = angle_deg.is_none() ? Kind::axial : Kind::circle;
  if (!angle_deg.is_none()) {
    recording->angle_rad = vector_of(angle_deg, "angle_deg");
    expect_count("angle_deg", recording->angle_rad, n);
    for (double& angle : recording->angle_rad) angle = rad_from_deg(angle);
  }
  if (!time_s.is_none()) {
    recording->time_s = vector_of(time_s, "time_s");
    expect_count("time_s", recording->time_s, n);
  }
  expect_readings(*recording);
  expect_positive("nominal_length_mm", nominal_length_mm);
  if (feed_mm_per_min) expect_positive("feed_mm_per_min", *feed_mm_per_min);
  if (!std::isfinite(height_offset_mm)) {
    throw Error(fmt::format("height_offset_mm: expected a finite number, found {}.", height_offset_mm));
  }
  recording->plane = named("plane", plane, {Plane::XY, Plane::YZ, Plane::ZX, Plane::YX, Plane::ZY, Plane::XZ});
  recording->direction = named("direction", direction, {Direction::CCW, Direction::CW});
  recording->motion = named("motion", motion, {Motion::linear_axes, Motion::rotary_axis, Motion::spindle});
  recording->nominal_length_mm = nominal_length_mm;
  recording->height_offset_mm = height_offset_mm;
  recording->feed_mm_per_min = feed_mm_per_min;
  return recording;
}

py::tuple state_of(const Recording& one) {
  const int kinds[] = {static_cast<int>(one.kind), static_cast<int>(one.motion), static_cast<int>(one.plane),
                       static_cast<int>(one.moving_ball), static_cast<int>(one.direction)};
  return py::make_tuple(std::vector<int>(std::begin(kinds), std::end(kinds)), one.nominal_length_mm,
                        one.height_offset_mm, one.feed_mm_per_min, one.bar_temperature_degC, one.pitch_a_mm,
                        one.pitch_b_mm, one.elapsed_s, one.started_s, array_of(one.time_s), array_of(one.angle_rad),
                        array_of(one.length_mm));
}

std::shared_ptr<Recording> recording_from(const py::tuple& state) {
  auto one = std::make_shared<Recording>();
  const auto kinds = py::cast<std::array<int, 5>>(state[0]);
  const auto known = [&](std::size_t k) { return py::cast<std::optional<double>>(state[k]); };
  one->kind = static_cast<Kind>(kinds[0]);
  one->motion = static_cast<Motion>(kinds[1]);
  one->plane = static_cast<Plane>(kinds[2]);
  one->moving_ball = static_cast<MovingBall>(kinds[3]);
  one->direction = static_cast<Direction>(kinds[4]);
  one->nominal_length_mm = py::cast<double>(state[1]);
  one->height_offset_mm = py::cast<double>(state[2]);
  one->feed_mm_per_min = known(3);
  one->bar_temperature_degC = known(4);
  one->pitch_a_mm = known(5);
  one->pitch_b_mm = known(6);
  one->elapsed_s = known(7);
  one->started_s = py::cast<std::optional<std::int64_t>>(state[8]);
  one->time_s = vector_of(state[9], "time_s");
  one->angle_rad = vector_of(state[10], "angle_rad");
  one->length_mm = vector_of(state[11], "length_mm");
  return one;
}

}  // namespace

void bind_recording(py::module_& module) {
  const auto view = [](std::vector<double> Recording::*values) {
    return [values](const py::object& self) { return view_of(py::cast<const Recording&>(self).*values, self); };
  };
  py::class_<Recording, std::shared_ptr<Recording>>(module, "Recording", kRecording)
      .def(py::init(&recording_of), py::arg("length_mm"), py::arg("angle_deg") = py::none(), py::kw_only(),
           py::arg("time_s") = py::none(), py::arg("plane") = "XY", py::arg("direction") = "CCW",
           py::arg("motion") = "linear_axes", py::arg("nominal_length_mm") = 100.0, py::arg("height_offset_mm") = 0.0,
           py::arg("feed_mm_per_min") = py::none())
      .def_property_readonly("length_mm", view(&Recording::length_mm), "(n,) mm; read-only.")
      .def_property_readonly("angle_rad", view(&Recording::angle_rad),
                             "(n,) rad from +A towards +B, none of a line; read-only.")
      .def_property_readonly("time_s", view(&Recording::time_s), "(n,) s, none where it is uniform; read-only.")
      .def_property_readonly(
          "plane", [](const Recording& one) { return name_of(one.plane); }, "XY, YZ or ZX.")
      .def_property_readonly(
          "direction", [](const Recording& one) { return name_of(one.direction); }, "CCW or CW.")
      .def_property_readonly(
          "motion", [](const Recording& one) { return name_of(one.motion); }, "linear_axes, rotary_axis or spindle.")
      .def_readonly("nominal_length_mm", &Recording::nominal_length_mm, "mm.")
      .def_readonly("height_offset_mm", &Recording::height_offset_mm, "Of the balls, mm.")
      .def_readonly("feed_mm_per_min", &Recording::feed_mm_per_min, "mm/min, or None.")
      .def(
          "__len__", [](const Recording& one) { return one.length_mm.size(); }, "Readings.")
      .def("__eq__", [](const Recording& one, const py::object& other) { return equal(one, other, &state_of); })
      .def("__repr__",
           [](const Recording& one) {
             return fmt::format("<ballbar.Recording {} {}, {} readings>", name_of(one.plane), name_of(one.direction),
                                one.length_mm.size());
           })
      .def(py::pickle(&state_of, &recording_from));
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
      py::arg("path"),
      "The recordings of a .b5r or of a ballbar log.\n\n"
      "Parameters\n----------\npath : path\n\nReturns\n-------\nlist of Recording\n\n"
      "Raises\n------\nBallbarError\n    A file that is neither, with line and column.");
}

}  // namespace ballbar::python
