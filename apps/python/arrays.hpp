// Columns and recordings as arrays of numpy: copied once on the way in, seen without a copy on the way out.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <vector>

namespace ballbar::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// Of one dimension. Throws Error otherwise, with the name of what it is.
std::vector<double> vector_of(const Numbers& array, const char* name);

// Read-only, of memory that `owner` keeps.
pybind11::array view_of(const std::vector<double>& values, pybind11::handle owner);

// Series and Recording as classes, and what reads and writes them.
void bind_arrays(pybind11::module_& module);

}  // namespace ballbar::python
