// Series and Recording as classes of Python, and what reads them.
#pragma once

#include <pybind11/pybind11.h>

namespace ballbar::python {

void bind_series(pybind11::module_& module);
void bind_recording(pybind11::module_& module);

}  // namespace ballbar::python
