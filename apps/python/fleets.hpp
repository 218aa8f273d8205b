// A table of tests of many machines, held against each other.
#pragma once

#include <pybind11/pybind11.h>

namespace ballbar::python {

void bind_fleets(pybind11::module_& module);

}  // namespace ballbar::python
