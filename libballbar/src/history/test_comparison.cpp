#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "ballbar/error.hpp"
#include "ballbar/history/errors_change.hpp"
#include "ballbar/history/history.hpp"

namespace ballbar {
namespace {

constexpr double kByChance = 0.05;  // of pairs of tests in which nothing changed

const TestQuantity* quantity_of(const MachineTest& test, const TestQuantity& like) {
  const auto found = std::find_if(test.quantities.begin(), test.quantities.end(), [&](const TestQuantity& one) {
    return one.name == like.name && one.unit == like.unit;
  });
  return found == test.quantities.end() ? nullptr : &*found;
}

// By its fit; of a stored value, which has no sigma, it is not known and taken to.
bool shows(const TestQuantity& one) {
  return one.significant && !(std::abs(one.value) <= kSignificantSigmas * one.sigma);
}

QuantityDifference difference_of(const TestQuantity* before, const TestQuantity* after) {
  const TestQuantity& known = before != nullptr ? *before : *after;
  QuantityDifference result{known.name, known.unit};
  result.of_set_up = known.of_set_up;
  if (before != nullptr) {
    result.before = before->value;
    result.before_sigma = before->sigma;
    result.shown = shows(*before);
  }
  if (after != nullptr) {
    result.after = after->value;
    result.after_sigma = after->sigma;
    result.shown = result.shown || shows(*after);
  }
  result.difference = result.after - result.before;
  result.sigma = std::hypot(result.before_sigma, result.after_sigma);
  if (result.sigma > 0.0) {
    result.p_value = std::erfc(std::abs(result.difference) / result.sigma / std::numbers::sqrt2);
  }
  return result;
}

double sigmas_of(const QuantityDifference& one) { return std::abs(one.difference) / one.sigma; }

// Rising p-values, each compared with the rate over the number of remaining ones; stops at the first failure.
std::size_t judge(std::vector<QuantityDifference>& quantities) {
  std::vector<QuantityDifference*> judged;
  for (QuantityDifference& one : quantities) {
    if (!one.of_set_up && std::isfinite(one.p_value)) judged.push_back(&one);
  }
  std::sort(judged.begin(), judged.end(), [](const auto* left, const auto* right) {
    return std::tie(left->p_value, left->name) < std::tie(right->p_value, right->name);
  });
  bool clear = true;
  for (std::size_t k = 0; k < judged.size(); ++k) {
    clear = clear && judged[k]->p_value * static_cast<double>(judged.size() - k) <= kByChance;
    judged[k]->clear = clear;
  }
  return judged.size();
}

bool is_scale_of_axis(std::string_view name) { return name.starts_with("scale_") && name.size() == 7; }
// The others follow from these: the size of the circle, the residual, the scales of the axes.
bool is_error(std::string_view name) {
  return name != "circularity" && name != "residual_rms" && !is_scale_of_axis(name);
}

// Of "backlash_a_pos" "backlash_a".
std::string without_end(const std::string& name) {
  for (const std::string_view end : {"_pos", "_neg", "_fwd", "_rev"}) {
    if (name.ends_with(end)) return name.substr(0, name.size() - end.size());
  }
  return name;
}

int place_of(const QuantityDifference& one) {
  return one.name == "circularity" ? 0 : one.clear.value_or(false) ? 1 : 2;
}

}  // namespace

std::vector<ClearChange> clear_changes(const TestComparison& comparison) {
  const bool any_error =
      std::any_of(comparison.quantities.begin(), comparison.quantities.end(),
                  [](const QuantityDifference& one) { return one.clear.value_or(false) && is_error(one.name); });
  std::vector<ClearChange> changes;
  for (const QuantityDifference& one : comparison.quantities) {
    if (!one.clear.value_or(false)) continue;
    if (!is_error(one.name) && (any_error || !is_scale_of_axis(one.name))) continue;
    const ClearChange change{without_end(one.name), one.unit, one.before, one.after};
    const auto known = std::find_if(changes.begin(), changes.end(),
                                    [&](const ClearChange& other) { return other.name == change.name; });
    if (known == changes.end()) {
      changes.push_back(change);
    } else if (std::abs(one.difference) > std::abs(known->after - known->before)) {
      *known = change;
    }
  }
  return changes;
}

TestComparison compared_tests(const MachineTest& before, const MachineTest& after) {
  if (before.plane != after.plane) {
    throw Error(fmt::format(
        "expected two tests of one plane, found {} and {}. Use `ballbar history` for tests of different planes.",
        name_of(before.plane), name_of(after.plane)));
  }
  TestComparison result{before, after, differing_conditions(before, after), {}, 0};
  for (const TestQuantity& one : before.quantities) {
    result.quantities.push_back(difference_of(&one, quantity_of(after, one)));
  }
  for (const TestQuantity& one : after.quantities) {
    if (quantity_of(before, one) == nullptr) result.quantities.push_back(difference_of(nullptr, &one));
  }
  result.judged = judge(result.quantities);
  std::stable_sort(result.quantities.begin(), result.quantities.end(),
                   [](const QuantityDifference& left, const QuantityDifference& right) {
                     const int place = place_of(left);
                     if (place != place_of(right)) return place < place_of(right);
                     return place == 1 && sigmas_of(left) > sigmas_of(right);
                   });
  return result;
}

}  // namespace ballbar
