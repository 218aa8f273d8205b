// A diagnosis in plain words.
#pragma once

#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// What a diagnosis says, part by part. The first sentence of the verdict has no statistical terms.
std::vector<Paragraph> not_used_sentences(const Diagnosis& diagnosis);  // columns, rows and readings
Paragraph verdict_sentences(const Diagnosis& diagnosis);                // with the slow drift that it leaves

// The slow drift that the verdict leaves; where it is the verdict, what to do. Empty: there is none.
Paragraph slow_drift_beside(const Diagnosis& diagnosis);

// All of it: what was not used, then the verdict.
Paragraph sentence_of(const Diagnosis& diagnosis);

// "it has gaps"
Paragraph why_not_searched(const ColumnNotSearched& column);

// Whole sentences: why the verdict is not `named`, or not of all members of the best set.
std::vector<Paragraph> reasons_of(const Diagnosis& diagnosis);

}  // namespace ballbar
