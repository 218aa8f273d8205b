#include "measure/fit_result.hpp"

namespace ballbar {

MayLack<TableOf<double>> stored_results(const std::vector<Compared>& results) {
  TableOf<double> stored;
  for (const Compared& result : results) {
    if (result.stored) stored.emplace_back(result.key, *result.stored);
  }
  return {stored.empty() ? std::nullopt : std::optional(stored)};
}

}  // namespace ballbar
