// JSON as objects of Python: numbers keep every bit.
#pragma once

#include <pybind11/pybind11.h>

#include <nlohmann/json_fwd.hpp>

namespace ballbar::python {

// dict, list, str, float, int, bool, None. Bytes that are no UTF-8 become U+FFFD. With the GIL.
pybind11::object to_python(const nlohmann::ordered_json& json);

}  // namespace ballbar::python
