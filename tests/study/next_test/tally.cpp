#include "next_test/tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "verdicts/tally.hpp"

namespace ballbar::next_test {
namespace {

std::string percent(std::size_t count, std::size_t of) {
  if (of == 0) return "-";
  const verdicts::Share share = verdicts::wilson(count, of);
  return fmt::format("{:.1f} ({:.1f}-{:.1f})", 100.0 * static_cast<double>(count) / static_cast<double>(of),
                     100.0 * share.low, 100.0 * share.high);
}

struct Counts {
  std::size_t right = 0, wrong = 0, probable = 0, in_set = 0, driver = 0, tested = 0, right_of_tested = 0;
  double hours = 0.0, design_s = 0.0, longest_design_s = 0.0, diagnosis_s = 0.0, longest_diagnosis_s = 0.0;
  std::vector<double> hours_of_tested;
};

Counts counts_of(const std::vector<Looped>& sets, std::size_t number) {
  Counts counts;
  for (const Looped& set : sets) {
    const Stage& stage = set.stages[number];
    counts.right += stage.judged.right;
    counts.wrong += stage.judged.wrong;
    counts.probable += stage.judged.probably_right;
    counts.in_set += stage.judged.in_set;
    counts.driver += stage.judged.driver_right;
    counts.hours += stage.hours;
    if (!stage.is_tested && number > 0) continue;
    ++counts.tested;
    counts.right_of_tested += stage.judged.right;
    counts.hours_of_tested.push_back(stage.hours);
    counts.design_s += stage.design_s;
    counts.longest_design_s = std::max(counts.longest_design_s, stage.design_s);
    counts.diagnosis_s += stage.diagnosis_s;
    counts.longest_diagnosis_s = std::max(counts.longest_diagnosis_s, stage.diagnosis_s);
  }
  return counts;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::string heading() {
  return fmt::format(
      "{:<12} {:<20} {:>5} {:>5} {:>18} {:>18} {:>6} {:>6} {:>6} {:>7} {:>18} {:>7} {:>7} {:>13} {:>13}\n", "cell",
      "plan", "tests", "sets", "right", "wrong", "prob.", "in set", "driver", "tested", "right of these", "h, med.",
      "h, mean", "design s, max", "diagn. s, max");
}

std::string rows_of(const std::string& cell, const std::string& plan, const std::vector<Looped>& sets) {
  std::string text;
  if (sets.empty()) return text;
  const auto n = static_cast<double>(sets.size());
  for (std::size_t number = 0; number < sets.front().stages.size(); ++number) {
    const Counts counts = counts_of(sets, number);
    const double tested = std::max<double>(1.0, static_cast<double>(counts.tested));
    const auto share = [&](std::size_t count) { return 100.0 * static_cast<double>(count) / n; };
    text += fmt::format(
        "{:<12} {:<20} {:>5} {:>5} {:>18} {:>18} {:>6.1f} {:>6.1f} {:>6.1f} {:>7} {:>18} {:>7.1f} {:>7.1f} {:>13} "
        "{:>13}\n",
        cell, plan, number, sets.size(), percent(counts.right, sets.size()), percent(counts.wrong, sets.size()),
        share(counts.probable), share(counts.in_set), share(counts.driver), counts.tested,
        percent(counts.right_of_tested, counts.tested), median(counts.hours_of_tested), counts.hours / n,
        fmt::format("{:.2f}, {:.2f}", counts.design_s / tested, counts.longest_design_s),
        fmt::format("{:.2f}, {:.2f}", counts.diagnosis_s / tested, counts.longest_diagnosis_s));
  }
  return text;
}

std::string reliability(const std::vector<Looped>& sets) {
  std::string text = "P promised of a test      count  right after it\n";
  for (int bin = 0; bin < 10; ++bin) {
    std::size_t count = 0, right = 0;
    double sum = 0.0;
    for (const Looped& set : sets) {
      for (const Stage& stage : set.stages) {
        if (!stage.is_tested || std::isnan(stage.promised)) continue;
        if (std::clamp(static_cast<int>(10.0 * stage.promised), 0, 9) != bin) continue;
        ++count;
        right += stage.judged.right;
        sum += stage.promised;
      }
    }
    if (count == 0) continue;
    const double mean = sum / static_cast<double>(count);
    const double came = static_cast<double>(right) / static_cast<double>(count);
    text += fmt::format("{:.1f} to {:.1f}, mean {:.3f} {:>6}  {:>20}{}\n", 0.1 * bin, 0.1 * (bin + 1), mean, count,
                        percent(right, count), std::abs(came - mean) > 0.1 ? "  more than 10 points off" : "");
  }
  return text;
}

std::string lines_of(const Looped& set) {
  std::string text;
  for (std::size_t number = 0; number < set.stages.size(); ++number) {
    const Stage& stage = set.stages[number];
    if (number > 0 && !stage.is_tested) continue;
    if (number > 0) {
      text += fmt::format("      test {}, {:.1f} h in all, promised {:.2f}\n", number, stage.hours, stage.promised);
    }
    text += verdicts::line_of(set.made, stage.said, stage.judged);
  }
  return text;
}

}  // namespace ballbar::next_test
