// Equal columns: no test can decide which of them drives an effect.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct DistinctColumns {
  Series data;  // without the duplicates
  std::vector<EqualColumns> equal;
};

// Inputs in one unit that are equal (series/equal_columns.hpp). Inputs of the model stay.
DistinctColumns distinct_columns_of(const Series& data, const Model& model, std::size_t target);

// Effects of the diagnosis of `distinct.data` with P >= 0.2 that read a column with a duplicate: each with the same
// effect on the duplicate.
std::vector<std::vector<BoundEffect>> inseparable_effects(const Diagnosis& diagnosis, const DistinctColumns& distinct);

}  // namespace ballbar
