// The columns of the data that an effect can read.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/effects/effect.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

inline constexpr std::size_t kMostBindings = 512;  // largest number of column choices searched for one effect

// All choices of different columns for the inputs of an effect, each as Effect::inputs; on recordings the trace's own
// columns. What an input takes is said there (Input). Targets, Model::not_inputs and sigmas are no inputs. At most
// kMostBindings.
std::vector<std::vector<std::string>> bindings_of(const Effect& effect, const Model& model, const Series& data);

// All of them.
std::size_t count_of_bindings(const Effect& effect, const Model& model, const Series& data);

bool has_term(const Model& model, const Effect& effect, const std::vector<std::string>& columns);

}  // namespace ballbar
