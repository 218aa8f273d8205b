// A diagnosis in plain words.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"

namespace ballbar {

// The verdict. Its first sentence has no statistical terms.
std::string sentence_of(const Diagnosis& diagnosis);

// Whole sentences: why the verdict is not `named`, or not of all members of the best set.
std::vector<std::string> reasons_of(const Diagnosis& diagnosis);

}  // namespace ballbar
