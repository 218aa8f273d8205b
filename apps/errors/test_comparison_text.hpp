// Two tests, before and after, for the terminal.
#pragma once

#include <string>
#include <vector>

#include "ballbar/history/errors_change.hpp"
#include "ballbar/message.hpp"

namespace ballbar {

// "backlash_a fell from 8.10 to 1.20 um, circularity fell from 9.32 to 5.20 um. No other significant difference."
Paragraph conclusion(const TestComparison& comparison);

// One sentence for each condition in which the tests differ.
std::vector<std::string> condition_texts(const TestComparison& comparison);

// Clear differences, quantities that are significant in one test, and the circularity; `all`: every quantity.
std::string comparison_text(const TestComparison& comparison, bool all);

}  // namespace ballbar
