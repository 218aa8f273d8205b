// Columns that are one: no test can tell which of them drives something.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct Twin {
  std::string kept, other;
};

struct DistinctColumns {
  Series data;  // without the others
  std::vector<Twin> twins;
};

// Inputs in one unit of which one is the other, but for a factor and a constant, as far as they are resolved. Those of
// the model stay.
DistinctColumns distinct_columns_of(const Series& data, const Model& model);

// Effects of the diagnosis of `distinct.data` that are missing by P >= 0.2 and read a column that has a twin: each with
// the same on the twin.
std::vector<std::vector<BoundEffect>> inseparable_effects(const Diagnosis& diagnosis, const DistinctColumns& distinct);

}  // namespace ballbar
