#include "errors/tolerance_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "ballbar/message_catalogue.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// As few decimals as show on which side of the tolerance it is: "6.04", not "6.0", where 6 is the tolerance.
std::string beside(double value_um, double tolerance_um) {
  constexpr int kMostDecimals = 4;
  for (int decimals = 1; decimals < kMostDecimals; ++decimals) {
    const std::string text = fixed(value_um, decimals);
    if ((std::stod(text) <= tolerance_um) == (value_um <= tolerance_um)) return text;
  }
  return fixed(value_um, kMostDecimals);
}

Message circularity_of(const ToleranceCheck& check) {
  const std::string tolerance = fmt::format("{:g}", *check.tolerance_um);
  if (!check.circularity_um) return messages::circularity_not_stored(tolerance);
  const std::string value = beside(*check.circularity_um, *check.tolerance_um);
  const bool passes = *check.circularity_um <= *check.tolerance_um;
  if (check.stored_in.empty())
    return passes ? messages::circularity_passes(value, tolerance) : messages::circularity_fails(value, tolerance);
  return passes ? messages::circularity_stored_passes(value, tolerance, check.stored_in)
                : messages::circularity_stored_fails(value, tolerance, check.stored_in);
}

}  // namespace

std::vector<LimitCheck> limit_checks(const B5r& b5r) {
  std::vector<LimitCheck> checks;
  for (const StoredFeature& feature : b5r.stored) {
    if (!feature.valid) continue;
    const auto judgement = judged(b5r.limits, feature.name, feature.value, feature.data_type);
    if (judgement) checks.push_back({feature, *judgement});
  }
  return checks;
}

std::optional<bool> passes(const ToleranceCheck& check) {
  if (!check.tolerance_um) return std::nullopt;
  const bool fails = std::any_of(check.limits.begin(), check.limits.end(),
                                 [](const LimitCheck& one) { return one.judgement == Judgement::fail; });
  if (fails) return false;
  if (!check.circularity_um) return std::nullopt;
  return *check.circularity_um <= *check.tolerance_um;
}

std::vector<Paragraph> tolerance_lines(const ToleranceCheck& check) {
  std::vector<Paragraph> lines;
  if (check.tolerance_um) lines.emplace_back(circularity_of(check));
  std::size_t within = 0;
  for (const LimitCheck& one : check.limits) {
    if (one.judgement == Judgement::pass) {
      ++within;
      continue;
    }
    const StoredFeature& result = one.result;
    const std::string value = fmt::format("{:g} {}", result.value, unit_of_data_type(result.data_type));
    lines.emplace_back(one.judgement == Judgement::fail ? messages::limit_fails(result.name, value, result.parent)
                                                        : messages::limit_warns(result.name, value, result.parent));
  }
  if (within > 0) lines.emplace_back(messages::limits_pass(within));
  return lines;
}

std::optional<bool> passes(const MachineTest& test, double tolerance_um) {
  if (!test.beyond_limits.empty()) return false;
  const auto found = std::find_if(test.quantities.begin(), test.quantities.end(),
                                  [](const TestQuantity& one) { return one.name == "circularity"; });
  return found == test.quantities.end() ? std::nullopt : std::optional(found->value <= tolerance_um);
}

}  // namespace ballbar
