// A diagnosis in plain words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"

namespace ballbar {

// The verdict. Its first sentence has no statistical terms.
std::string sentence_of(const Diagnosis& diagnosis);

// "it has gaps"
std::string_view why_not_searched(const ColumnNotSearched& column);

// Whole sentences: why the verdict is not `named`, or not of all members of the best set.
std::vector<std::string> reasons_of(const Diagnosis& diagnosis);

}  // namespace ballbar
