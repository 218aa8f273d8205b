#include "python/arrays.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

constexpr double kGap = std::numeric_limits<double>::quiet_NaN();

bool are_numbers(char kind) { return kind == 'f' || kind == 'i' || kind == 'u'; }

// Python would take a truth value for 1, and a complex number for its real part.
double number_of(py::handle object, const std::string& name, std::size_t row) {
  if (object.is_none() || py::str(py::type::handle_of(object).attr("__name__")).equal(py::str("NAType"))) return kGap;
  PyObject* const one = object.ptr();
  if (!PyBool_Check(one) && !PyUnicode_Check(one) && !PyBytes_Check(one) && !PyComplex_Check(one)) {
    const double value = PyFloat_AsDouble(one);
    if (PyErr_Occurred() == nullptr) return value;
    PyErr_Clear();
  }
  throw Error(fmt::format("{}, row {}: expected a number, found {}.", name, row,
                          in_quotes(py::cast<std::string>(py::str(object)))));
}

Numbers of_objects(const py::array& objects, const std::string& name) {
  Numbers numbers(std::vector<py::ssize_t>(objects.shape(), objects.shape() + objects.ndim()));
  double* value = numbers.mutable_data();
  std::size_t row = 0;
  for (const py::handle object : objects.attr("ravel")()) *value++ = number_of(object, name, row++);
  return numbers;
}

}  // namespace

Numbers numbers_of(const py::object& data, const std::string& name) {
  py::array array = py::array::ensure(data);
  if (!array) throw Error(fmt::format("{}: expected an array of numbers, found none of equal rows.", name));
  const char kind = array.dtype().kind();
  if (!are_numbers(kind) && kind != 'O') {
    throw Error(fmt::format("{}: expected an array of numbers, found one of {}.", name,
                            py::cast<std::string>(py::str(array.dtype()))));
  }
  if (py::isinstance<py::array>(data) && py::hasattr(data, "mask")) {
    array = kind == 'O' ? data.attr("filled")(kGap) : data.attr("astype")("float64").attr("filled")(kGap);
  }
  return kind == 'O' ? of_objects(array, name) : Numbers(array);
}

std::vector<double> vector_of(const py::object& data, const std::string& name) {
  const Numbers array = numbers_of(data, name);
  if (array.ndim() == 1) return {array.data(), array.data() + array.size()};
  throw Error(fmt::format("{}: expected an array of one dimension, found {}.", name, array.ndim()));
}

py::array array_of(const std::vector<double>& values) {
  return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
}

py::array array_of(std::vector<double>&& values) {
  auto* const kept = new std::vector<double>(std::move(values));
  const py::capsule owner(kept, [](void* all) { delete static_cast<std::vector<double>*>(all); });
  return py::array_t<double>(static_cast<py::ssize_t>(kept->size()), kept->data(), owner);
}

py::array view_of(const std::vector<double>& values, py::handle owner) {
  py::array_t<double> view(static_cast<py::ssize_t>(values.size()), values.data(), owner);
  py::setattr(view.attr("flags"), "writeable", py::bool_(false));
  return std::move(view);
}

}  // namespace ballbar::python
