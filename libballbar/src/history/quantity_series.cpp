#include "history/quantity_series.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "ballbar/history/test_groups.hpp"
#include "ballbar/history/trend.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "numerics/not_finite.hpp"

namespace ballbar {
namespace {

std::string machine_of(const MachineTest& test) {
  if (!test.machine.empty()) return test.machine;
  const std::size_t slash = test.file.find_last_of('/');
  return slash == std::string::npos ? "" : test.file.substr(0, slash);
}

// The numbers of the names of all quantities.
using Numbers = std::unordered_map<std::string_view, std::size_t>;

Numbers numbers_of(std::span<const MachineTest> tests) {
  Numbers numbers;
  for (const MachineTest& test : tests) {
    for (const TestQuantity& quantity : test.quantities) numbers.emplace(quantity.name, numbers.size());
  }
  return numbers;
}

// What groups are made by, without the bar and the quantities.
MachineTest outline_of(const MachineTest& test) {
  MachineTest outline;
  outline.file = test.file;
  outline.started_s = test.started_s;
  outline.plane = test.plane;
  outline.nominal_length_mm = test.nominal_length_mm;
  outline.feed_mm_per_min = test.feed_mm_per_min;
  outline.start_deg = test.start_deg;
  outline.arc_deg = test.arc_deg;
  return outline;
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
                                      const std::vector<std::size_t>& places, const Numbers& numbers) {
  std::vector<MachineTest> outlines;
  outlines.reserve(places.size());
  for (const std::size_t place : places) outlines.push_back(outline_of(tests[place]));
  std::vector<QuantitySeries> all;
  for (const TestGroup& group : groups_of(outlines)) {
    std::vector<QuantitySeries> by_name(numbers.size());
    std::vector<Days> days(by_name.begin(), by_name.end());
    for (const std::size_t i : group.tests) {
      const MachineTest& test = tests[places[i]];
      if (!test.started_s) continue;
      for (const TestQuantity& quantity : test.quantities) {
        if (quantity.of_set_up || std::isinf(quantity.sigma) || !std::isfinite(quantity.value)) continue;
        const std::size_t number = numbers.at(quantity.name);
        QuantitySeries& one = by_name[number];
        one.name = quantity.name;
        one.unit = quantity.unit;
        one.family = kPlanes.size() * number + static_cast<std::size_t>(test.plane);
        days[number].add(places[i], test, quantity);
      }
    }
    for (QuantitySeries& one : by_name) {
      if (one.value.empty()) continue;
      one.machine = machine;
      one.plane = group.plane;
      one.radius_mm = group.nominal_length_mm;
      all.push_back(std::move(one));
    }
  }
  return all;
}

}  // namespace

AllSeries all_series(std::span<const MachineTest> tests) {
  AllSeries all;
  std::map<std::string, std::vector<std::size_t>> of_machine;
  for (std::size_t i = 0; i < tests.size(); ++i) {
    of_machine[machine_of(tests[i])].push_back(i);
    if (!tests[i].started_s) ++all.without_date;
  }
  for (auto& [name, places] : of_machine) {
    all.machines.push_back(name);
    all.tests.push_back(std::move(places));
  }
  const Numbers numbers = numbers_of(tests);
  all.families = kPlanes.size() * numbers.size();
  std::vector<std::vector<QuantitySeries>> parts(all.machines.size());
  in_parallel(parts.size(), [&](std::size_t i) { parts[i] = series_of(tests, i, all.tests[i], numbers); });
  for (std::vector<QuantitySeries>& part : parts) {
    std::move(part.begin(), part.end(), std::back_inserter(all.series));
  }
  return all;
}

}  // namespace ballbar
