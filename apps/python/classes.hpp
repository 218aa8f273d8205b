// What the module is made of: classes and functions of Python, and what they share.
#pragma once

#include <pybind11/pybind11.h>

#include <functional>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "ballbar/circle/recording.hpp"
#include "ballbar/effects/effect.hpp"
#include "ballbar/formats/text/source.hpp"
#include "ballbar/internal/numerics/interruption.hpp"
#include "ballbar/series/series.hpp"
#include "terminal/caller.hpp"

namespace ballbar::python {

void bind_series(pybind11::module_& module);
void bind_recording(pybind11::module_& module);
void bind_effects(pybind11::module_& module);  // an effect that is a function of Python
void bind_bench(pybind11::module_& module);    // a model held against data
void bind_models(pybind11::module_& module);   // what a model file says, and back
void bind_fleets(pybind11::module_& module);   // a table of tests of many machines, held against each other

// Data that Python holds; a text: what a file would hold. Nothing that Python is given changes a series, so that it is
// not copied.
using Recordings = std::vector<std::shared_ptr<Recording>>;
using Data = std::variant<std::shared_ptr<Series>, Recordings, std::string>;
Source source_of(const std::string& name, const Data& data);

// Effects that are functions of Python, of one call. Throws Error where the catalogue has an effect of that name.
using Effects = std::vector<std::shared_ptr<Effect>>;
Catalogue catalogue_with(const Effects& effects);

// The exception of its function that this sentence of an Error tells of, once; None: of another cause. With the GIL.
pybind11::object raised_by_effect(std::string_view sentence);

// Takes what a command says, and lets Ctrl-C end it.
class Listener {
 public:
  // Tells `progress`, which outlives it, how far the work is, a line of text; None: nobody is told.
  explicit Listener(pybind11::handle progress);

  // What `work` answers, without the GIL.
  template <class Work>
  auto hear(Work work) {
    const pybind11::gil_scoped_release free;
    const CalledBy called(caller);
    const Interruption interruption(signals_asked());
    return work();
  }

  Caller caller;
  std::vector<std::string> remarks;

 private:
  static std::function<void()> signals_asked();
};

// What becomes of lists of numbers.
enum class Columns { lists, arrays };

// JSON as dict, list, str, float, int, bool, None: numbers keep every bit. Bytes that are no UTF-8 become U+FFFD. With
// the GIL.
pybind11::object to_python(const nlohmann::ordered_json& json, Columns columns = Columns::lists);

}  // namespace ballbar::python
