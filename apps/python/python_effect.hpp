// An effect of the catalogue that is a function of Python.
#pragma once

#include <pybind11/pybind11.h>

namespace ballbar::python {

void bind_effects(pybind11::module_& module);

}  // namespace ballbar::python
