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
#include "measure/fit_result.hpp"
#include "program.hpp"
#include "python/arrays.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

std::vector<Recording> recordings_of(const Recordings& held) {
  std::vector<Recording> recordings;
  recordings.reserve(held.size());
  for (const auto& one : held) recordings.push_back(*one);
  return recordings;
}

// The result of a command, the files that it wrote, and remarks.
py::tuple call(const std::string& command, const std::vector<std::string>& places,
               const std::vector<std::pair<std::string, CommandCall::Value>>& options,
               const std::map<std::string, Data>& data, const Effects& effects, const py::object& progress) {
  CommandCall call{command, places, options, {}, catalogue_with(effects)};
  for (const auto& [name, value] : data) call.values.emplace(name, source_of(name, value));
  std::optional<Json> result;
  std::vector<std::string> wrote;
  Listener listener(progress);
  listener.caller.result = [&](const Json& json) { result = json; };
  listener.caller.wrote = [&](const std::string& file) { wrote.push_back(file); };
  listener.hear([&] { run_command(call); });
  // A prediction is as long as its data.
  const Columns columns = command == "predict" ? Columns::arrays : Columns::lists;
  return py::make_tuple(result ? to_python(*result, columns) : py::none(), wrote, listener.remarks);
}

// `fit` of recordings that Python holds, for those who fit thousands: setting up a command takes longer.
py::object fit(const Recordings& recordings, bool polar, bool robust) {
  CircleOptions how;
  how.model = polar ? CircleModel::polar : CircleModel::length_equation;
  how.robust = robust;
  return to_python(Listener(py::none()).hear([&] {
    return json_of(fit_files({Source("<data>", recordings_of(recordings))}, how));
  }));
}

// Both are classes of the package, so that they carry the place that a sentence begins with.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const char* what) {
    const py::module_ errors = py::module_::import("ballbar._errors");
    const py::object error = errors.attr(name)(errors.attr("in_python")(py::str(what)));
    if (const py::object cause = raised_by_effect(what); !cause.is_none()) error.attr("__cause__") = cause;
    PyErr_SetObject(error.get_type().ptr(), error.ptr());
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

Source source_of(const std::string& name, const Data& data) {
  if (const auto* const series = std::get_if<std::shared_ptr<Series>>(&data)) return {name, *series};
  if (const auto* const text = std::get_if<std::string>(&data)) return Source::of_text(name, *text);
  return {name, recordings_of(std::get<Recordings>(data))};
}

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
  ballbar::python::bind_bench(module);
  ballbar::python::bind_models(module);
  ballbar::python::bind_fleets(module);
  module.attr("version") = BALLBAR_VERSION;
  module.def("call", &ballbar::python::call, py::arg("command"), py::arg("places"), py::arg("options"), py::arg("data"),
             py::arg("effects"), py::arg("progress") = py::none());
  module.def("fit", &ballbar::python::fit, py::arg("recordings"), py::arg("polar"), py::arg("robust"));
  module.def("numbers", &ballbar::python::numbers_of, py::arg("data"), py::arg("name"));
}
