// What the module is made of: classes and functions of Python, and what they share.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace ballbar::python {

void bind_series(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_effects(pybind11::module_& module);  // an effect of the catalogue that is a function of Python
void bind_fleets(pybind11::module_& module);   // a table of tests of many machines, held against each other

// The exception of its function that this sentence of an Error tells of, once; None: of another cause. With the GIL.
pybind11::object raised_by_effect(std::string_view sentence);

// What a command says on its way: for Caller::progress, without the GIL. Tells `progress`, which outlives it, and lets
// Ctrl-C end the work. None: nobody is told.
std::function<void(std::string_view line)> progress_for(pybind11::handle progress);

// JSON as dict, list, str, float, int, bool, None: numbers keep every bit. Bytes that are no UTF-8 become U+FFFD. With
// the GIL.
pybind11::object to_python(const nlohmann::ordered_json& json);

}  // namespace ballbar::python
