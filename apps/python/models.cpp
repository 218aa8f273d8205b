#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/model/model.hpp"
#include "python/classes.hpp"

namespace ballbar::python {
namespace {

namespace py = pybind11;

// A model of this effect alone, such as "lagged_expansion(T_air_degC)".
std::string model_of_effect(const std::string& text, bool of_recordings, const Effects& effects) {
  Model model;
  model.level = of_recordings ? Level::recording : Level::series;
  model.targets = {"deviation_um"};
  const Catalogue catalogue = catalogue_with(effects);
  const EffectText said = effect_text(text, model.level, nullptr, catalogue);
  Term term = term_of(*said.effect, {});
  std::vector<std::string> lacking;
  for (const Input& input : said.effect->inputs) {
    const auto named = std::find_if(said.columns.begin(), said.columns.end(),
                                    [&](const auto& column) { return column.first == input.role; });
    if (named == said.columns.end()) lacking.push_back(input.role);
    term.columns.push_back(named == said.columns.end() ? "" : named->second);
  }
  if (!lacking.empty() && !of_recordings) {
    throw Error(fmt::format("{}: expected a column for {}, as in {}({} = \"...\"), found none.", text,
                            fmt::join(lacking, " and for "), said.effect->name, lacking.front()));
  }
  for (const auto& [parameter, setting] : said.settings) term.settings[parameter] = setting;
  model.terms = {term};
  return write_model(model);
}

}  // namespace

void bind_models(py::module_& module) {
  module.def(
      "model_text",
      [](const std::string& text, const std::string& name, const Effects& effects) {
        return write_model(read_model(text, name, catalogue_with(effects)));
      },
      py::arg("text"), py::arg("name"), py::arg("effects"));
  module.def("model_of_effect", &model_of_effect, py::arg("text"), py::arg("of_recordings"), py::arg("effects"));
}

}  // namespace ballbar::python
