#include "model/untestable_reasons.hpp"

#include <algorithm>

namespace ballbar {

std::vector<std::pair<std::string, std::vector<std::string>>> by_reason(const std::vector<Detectability>& untestable) {
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;
  for (const Detectability& detectable : untestable) {
    const auto same = [&](const auto& reason) { return reason.first == detectable.why; };
    auto reason = std::find_if(reasons.begin(), reasons.end(), same);
    if (reason == reasons.end()) reason = reasons.insert(reasons.end(), {detectable.why, {}});
    reason->second.push_back(detectable.effect->name);
  }
  return reasons;
}

}  // namespace ballbar
