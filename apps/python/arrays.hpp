// Columns and recordings as numpy arrays: copied once on input, exposed without a copy on output.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <type_traits>
#include <vector>

namespace ballbar::python {

using Numbers = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

// Accepts floats, integers, and objects that are numbers. Masked values, None and pandas' NA become NaN. Throws Error
// with the type for anything else: booleans, texts, dates and complex numbers.
Numbers numbers_of(const pybind11::object& data, const std::string& name);

// As numbers_of, of one dimension.
std::vector<double> vector_of(const pybind11::object& data, const std::string& name);

// A copy.
pybind11::array array_of(const std::vector<double>& values);

// The values themselves, without a copy.
pybind11::array array_of(std::vector<double>&& values);

// Read-only, of memory that `owner` keeps.
pybind11::array view_of(const std::vector<double>& values, pybind11::handle owner);

// Whether `other` is one of the same class with the same state, that of its pickle.
template <class Value, class State>
bool equal(Value& one, const pybind11::object& other, State state) {
  if (!pybind11::isinstance<std::decay_t<Value>>(other)) return false;
  const auto dumped = [&](Value& value) { return pybind11::module_::import("pickle").attr("dumps")(state(value)); };
  return dumped(one).equal(dumped(pybind11::cast<Value&>(other)));
}

}  // namespace ballbar::python
