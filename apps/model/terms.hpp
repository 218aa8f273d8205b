// Words of statistics that are printed, each with the sentence that explains it.
#pragma once

#include <span>
#include <string_view>

namespace ballbar {

struct ExplainedTerm {
  std::string_view name, meaning;
};

// In the order of their names.
std::span<const ExplainedTerm> explained_terms();

// A table of them.
void print_terms();

}  // namespace ballbar
