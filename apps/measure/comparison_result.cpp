#include "measure/comparison_result.hpp"

namespace ballbar {

std::string_view name_of(NoiseOfDifference noise) {
  switch (noise) {
    case NoiseOfDifference::stated:
      return "stated";
    case NoiseOfDifference::widened:
      return "widened";
    default:
      return "from rows";
  }
}

std::string_view name_of(Agreement agreement) {
  switch (agreement) {
    case Agreement::agrees:
      return "agrees";
    case Agreement::disagrees:
      return "disagrees";
    default:
      return "cannot tell";
  }
}

std::vector<InUnit<ComparedSample>> samples_of(const AxisComparison& axis) {
  std::vector<InUnit<ComparedSample>> samples;
  samples.reserve(axis.time_s.size());
  for (std::size_t i = 0; i < axis.time_s.size(); ++i)
    samples.push_back({{axis.time_s[i], axis.a[i], axis.b[i], axis.difference[i], axis.sigma[i]}, axis.unit});
  return samples;
}

std::vector<InUnit<UncertaintyShare>> budget_of(const AxisComparison& axis) {
  std::vector<InUnit<UncertaintyShare>> budget;
  budget.reserve(axis.budget.size());
  for (const UncertaintyShare& share : axis.budget) budget.push_back({share, axis.unit});
  return budget;
}

}  // namespace ballbar
