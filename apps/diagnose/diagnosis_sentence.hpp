// A diagnosis in plain words.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// The verdict. Its first sentence has no statistical terms.
Paragraph sentence_of(const Diagnosis& diagnosis);

// "it has gaps"
Paragraph why_not_searched(const ColumnNotSearched& column);

// Whole sentences: why the verdict is not `named`, or not of all members of the best set.
std::vector<Paragraph> reasons_of(const Diagnosis& diagnosis);

}  // namespace ballbar
