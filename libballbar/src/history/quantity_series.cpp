#include "history/quantity_series.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <unordered_map>

#include "ballbar/history/history.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "history/series_judgement.hpp"

namespace ballbar {
namespace {

// The numbers of the names of all quantities.
using Numbers = std::unordered_map<std::string_view, std::size_t>;

Numbers numbers_of(std::span<const MachineTest> tests) {
  Numbers numbers;
  for (const MachineTest& test : tests) {
    for (const TestQuantity& quantity : test.quantities) numbers.emplace(quantity.name, numbers.size());
  }
  return numbers;
}

bool of_one_day(double first_s, double second_s) {
  return std::floor(first_s / kDay_s) == std::floor(second_s / kDay_s);
}

// Values of a day with one bar as their mean.
class Days {
 public:
  explicit Days(QuantitySeries& series) : series_(series) {}

  void add(std::size_t place, const MachineTest& test, const TestQuantity& quantity) {
    const auto time_s = static_cast<double>(*test.started_s);
    const bool again =
        !series_.value.empty() && of_one_day(series_.time_s.back(), time_s) && series_.bar.back() == test.bar;
    if (!again) {
      series_.tests.push_back(place);
      series_.time_s.push_back(time_s);
      series_.value.push_back(quantity.value);
      series_.sigma.push_back(quantity.sigma);
      series_.bar.emplace_back(test.bar);
      count_ = 1.0;
      return;
    }
    series_.tests.back() = place;
    series_.time_s.back() = time_s;
    series_.value.back() += (quantity.value - series_.value.back()) / (count_ + 1.0);
    series_.sigma.back() = std::hypot(count_ * series_.sigma.back(), quantity.sigma) / (count_ + 1.0);
    count_ += 1.0;
  }

 private:
  QuantitySeries& series_;
  double count_ = 1.0;
};

std::vector<QuantitySeries> series_of(std::span<const MachineTest> tests, std::size_t machine,
                                      const std::vector<TestGroup>& groups, const Numbers& numbers) {
  std::vector<QuantitySeries> all;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::vector<QuantitySeries> by_name(numbers.size());
    std::vector<Days> days(by_name.begin(), by_name.end());
    for (const std::size_t i : groups[g].tests) {
      const MachineTest& test = tests[i];
      if (!test.started_s) continue;
      for (const TestQuantity& quantity : test.quantities) {
        if (quantity.of_set_up || std::isinf(quantity.sigma) || !std::isfinite(quantity.value)) continue;
        const std::size_t number = numbers.at(quantity.name);
        QuantitySeries& one = by_name[number];
        one.name = quantity.name;
        one.unit = quantity.unit;
        one.family = kPlanes.size() * number + static_cast<std::size_t>(test.plane);
        one.significant = quantity.significant;
        days[number].add(i, test, quantity);
      }
    }
    for (QuantitySeries& one : by_name) {
      if (one.value.empty()) continue;
      one.machine = machine;
      one.group = g;
      one.plane = groups[g].plane;
      one.radius_mm = groups[g].nominal_length_mm;
      all.push_back(std::move(one));
    }
  }
  return all;
}

// Places of the tests by machine; those without a name belong to the only one that is named.
std::map<std::string, std::vector<std::size_t>> by_machine(std::span<const MachineTest> tests) {
  std::map<std::string, std::vector<std::size_t>> places;
  for (std::size_t i = 0; i < tests.size(); ++i) places[tests[i].machine].push_back(i);
  if (places.size() != 2 || !places.contains("")) return places;
  std::vector<std::size_t>& named = places.rbegin()->second;
  named.insert(named.end(), places[""].begin(), places[""].end());
  std::sort(named.begin(), named.end());
  places.erase("");
  return places;
}

// Whose name a row's begins with: the longest; nullptr: a group of errors.
const Effect* effect_of_row(std::string_view row) {
  if (row.find("_or_") != std::string_view::npos) return nullptr;
  const Effect* longest = nullptr;
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level != Level::recording || effect->rules.error_fit == ErrorFit::none) continue;
    const bool own = row == effect->name || (row.starts_with(effect->name) && row[effect->name.size()] == '_');
    if (own && (longest == nullptr || effect->name.size() > longest->name.size())) longest = effect.get();
  }
  return longest;
}

const Effect* effect_of_scales() {
  for (const auto& effect : built_in_catalogue()) {
    if (effect->level == Level::recording && effect->rules.relation == AxisRelation::scale) return effect.get();
  }
  return nullptr;
}

}  // namespace

AllSeries all_series(std::span<const MachineTest> tests) {
  AllSeries all;
  for (const MachineTest& test : tests) {
    if (!test.started_s) all.without_date.push_back(test.file);
  }
  for (auto& [name, places] : by_machine(tests)) all.machines.push_back({name, std::move(places), {}});
  const Numbers numbers = numbers_of(tests);
  all.families = kPlanes.size() * numbers.size();
  std::vector<std::vector<QuantitySeries>> parts(all.machines.size());
  in_parallel(parts.size(), [&](std::size_t i) {
    MachineTests& machine = all.machines[i];
    machine.groups = groups_of(tests, machine.tests);
    parts[i] = series_of(tests, i, machine.groups, numbers);
  });
  for (std::vector<QuantitySeries>& part : parts) {
    std::move(part.begin(), part.end(), std::back_inserter(all.series));
  }
  return all;
}

QuantityKind kind_of(std::string_view name, Plane plane) {
  QuantityKind kind;
  for (int axis = 0; axis < 3; ++axis) {
    if (name != scale_name(axis)) continue;
    return {effect_of_scales(), axis, "scale", true};
  }
  if (is_global_scale(name)) return {nullptr, std::nullopt, std::string(name), true};
  kind.effect = effect_of_row(name);
  kind.of_sum = name == "circularity" || name == "residual_rms";
  if (kind.effect == nullptr) {
    kind.stem = name;
    return kind;
  }
  kind.of_both_scales = kind.effect->rules.relation == AxisRelation::scale;
  kind.stem = kind.effect->name;
  const auto pair = axes_of(plane);
  for (const std::size_t side : {0U, 1U}) {
    const std::string_view end = side == 0 ? "_a" : "_b";
    if (!kind.stem.ends_with(end)) continue;
    kind.stem.resize(kind.stem.size() - end.size());
    kind.axis = pair[side];
    break;
  }
  return kind;
}

}  // namespace ballbar
