// What a command says on its way, for Python.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <string_view>

namespace ballbar::python {

// For Caller::progress, without the GIL: tells `progress`, which outlives it, and lets Ctrl-C end the work. None:
// nobody is told.
std::function<void(std::string_view line)> progress_for(pybind11::handle progress);

}  // namespace ballbar::python
