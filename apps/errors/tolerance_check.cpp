#include "errors/tolerance_check.hpp"

#include <fmt/format.h>

#include <algorithm>

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

std::string circularity_text(const ToleranceCheck& check) {
  const double tolerance_um = *check.tolerance_um;
  if (!check.circularity_um) return fmt::format("circularity: not in the file; the tolerance is {:g} um", tolerance_um);
  return fmt::format("circularity {} um{}: {} the tolerance of {:g} um ({})",
                     beside(*check.circularity_um, tolerance_um), check.stored_in.empty() ? "" : ", stored",
                     *check.circularity_um <= tolerance_um ? "passes" : "fails", tolerance_um,
                     check.stored_in.empty() ? "largest less smallest reading about the fitted centre"
                                             : "AF_CIRCULARITY of " + check.stored_in);
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

std::vector<std::string> tolerance_texts(const ToleranceCheck& check) {
  std::vector<std::string> texts;
  if (check.tolerance_um) texts.push_back(circularity_text(check));
  std::size_t within = 0;
  for (const LimitCheck& one : check.limits) {
    if (one.judgement == Judgement::pass) {
      ++within;
      continue;
    }
    const StoredFeature& result = one.result;
    texts.push_back(fmt::format("{} {:g} {}, stored ({}): {} in the file", result.name, result.value,
                                unit_of_data_type(result.data_type), result.parent,
                                one.judgement == Judgement::fail ? "fails the limit" : "is beyond the warning limit"));
  }
  if (within > 0) {
    texts.push_back(
        fmt::format("{} stored result{} the limits in the file", within, within == 1 ? " passes" : "s pass"));
  }
  return texts;
}

std::optional<bool> passes(const MachineTest& test, double tolerance_um) {
  if (!test.beyond_limits.empty()) return false;
  const auto found = std::find_if(test.quantities.begin(), test.quantities.end(),
                                  [](const TestQuantity& one) { return one.name == "circularity"; });
  return found == test.quantities.end() ? std::nullopt : std::optional(found->value <= tolerance_um);
}

}  // namespace ballbar
