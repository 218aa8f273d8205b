// An effect of the catalogue that is a function of Python.
#pragma once

#include <pybind11/pybind11.h>

#include <string_view>

namespace ballbar::python {

// The exception of its function that this sentence of an Error tells of, once; None: of another cause. With the GIL.
pybind11::object raised_by_effect(std::string_view sentence);

void bind_effects(pybind11::module_& module);

}  // namespace ballbar::python
