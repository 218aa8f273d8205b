#include "python/progress.hpp"

namespace ballbar::python {

namespace py = pybind11;

std::function<void(std::string_view line)> progress_for(py::handle progress) {
  return [progress](std::string_view line) {
    if (line.empty()) return;  // said as a command ends, by an error too
    const py::gil_scoped_acquire hold;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress.is_none()) progress(py::str(line.data(), line.size()));
  };
}

}  // namespace ballbar::python
