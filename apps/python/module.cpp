// The module `ballbar._core`: the commands of the program on files and on data that Python holds.
#include <glog/logging.h>
#include <malloc.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <exception>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/given_data.hpp"
#include "measure/fit_result.hpp"
#include "page/report_page.hpp"
#include "program.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"
#include "python/fleets.hpp"
#include "python/python_effect.hpp"
#include "python/to_python.hpp"
#include "terminal/caller.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

using Recordings = std::vector<std::shared_ptr<Recording>>;
using Data = std::variant<std::shared_ptr<Series>, Recordings>;

// Recordings are copied; nothing that Python is given changes a series.
GivenData given_of(const Data& data) {
  if (const auto* const series = std::get_if<std::shared_ptr<Series>>(&data)) return *series;
  std::vector<Recording> recordings;
  for (const auto& one : std::get<Recordings>(data)) recordings.push_back(*one);
  return recordings;
}

// What a command said besides its result.
struct Said {
  std::optional<Json> result;
  std::vector<std::string> remarks;
};

// Without the GIL but for what Python is told; there, Ctrl-C ends the command.
Said ran(const std::vector<std::string>& words, const std::map<std::string, Data>& given, const py::object& progress) {
  Said said;
  Caller caller;
  caller.result = [&](const Json& json) { said.result = json; };
  caller.remark = [&](const std::string& line) { said.remarks.push_back(line); };
  caller.progress = [&](std::string_view line) {
    if (line.empty()) return;  // said as a command ends, by an error too
    const py::gil_scoped_acquire hold;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(py::str(line.data(), line.size()));
  };
  const py::gil_scoped_release free;
  std::vector<std::unique_ptr<Given>> held;
  held.reserve(given.size());
  for (const auto& [name, data] : given) held.push_back(std::make_unique<Given>(name, given_of(data)));
  const CalledBy called(caller);
  run_command(words);
  return said;
}

py::tuple run(const std::vector<std::string>& words, const std::map<std::string, Data>& given,
              const py::object& progress) {
  const Said said = ran(words, given, progress);
  return py::make_tuple(said.result ? to_python(*said.result) : py::none(), py::cast(said.remarks));
}

// `fit` of recordings that Python holds: without a command line, for those who fit thousands.
py::object fit(const Recordings& recordings, bool polar, bool robust) {
  CircleOptions how;
  how.model = polar ? CircleModel::polar : CircleModel::length_equation;
  how.robust = robust;
  const Json json = [&] {
    const py::gil_scoped_release free;
    const std::string name = "<data>";
    const Given given(name, given_of(recordings));
    return json_of(fit_files({name}, how));
  }();
  return to_python(json);
}

// The pictures of a page with these parts, one below the other.
std::string picture(const std::string& parts, const std::string& conclusion) {
  const py::gil_scoped_release free;
  expect_page();
  return plot_of(Json::parse(parts), conclusion);
}

// Both are classes of the package, so that they carry the place that a sentence begins with.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const char* what) {
    const py::object type = py::module_::import("ballbar._errors").attr(name);
    const py::object error = type(py::str(what));
    if (const py::object cause = raised_by_effect(what); !cause.is_none()) error.attr("__cause__") = cause;
    PyErr_SetObject(type.ptr(), error.ptr());
  };
  try {
    if (thrown) std::rethrow_exception(std::move(thrown));
  } catch (const UsageError& error) {
    raise("UsageError", error.what());
  } catch (const Error& error) {
    raise("BallbarError", error.what());
  }
}

}  // namespace
}  // namespace ballbar::python

PYBIND11_MODULE(_core, module) {
  namespace py = pybind11;
  // Matrices of some 100 kB come and go: asked for anew each time, they would cost a quarter of a fit.
  mallopt(M_MMAP_THRESHOLD, 4 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
  FLAGS_minloglevel = google::GLOG_FATAL;  // of the solver: what it says stands in the results
  py::register_exception_translator(&ballbar::python::translate);
  ballbar::python::bind_series(module);
  ballbar::python::bind_recording(module);
  ballbar::python::bind_effects(module);
  ballbar::python::bind_fleets(module);
  module.attr("version") = BALLBAR_VERSION;
  module.def("run", &ballbar::python::run, py::arg("words"), py::arg("given"), py::arg("progress") = py::none());
  module.def("fit", &ballbar::python::fit, py::arg("recordings"), py::arg("polar"), py::arg("robust"));
  module.def("numbers", &ballbar::python::numbers_of, py::arg("data"), py::arg("name"));
  module.def("picture", &ballbar::python::picture, py::arg("parts"), py::arg("conclusion"));
}
