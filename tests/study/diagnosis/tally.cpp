#include "tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ballbar::study {
namespace {

std::string percent(std::size_t count, std::size_t of) {
  if (of == 0) return "-";
  const Share share = share_of(count, of);
  const double p = 100.0 * static_cast<double>(count) / static_cast<double>(of);
  return fmt::format("{:.1f} ({:.1f}-{:.1f})", p, 100.0 * share.low, 100.0 * share.high);
}

std::string percent(const std::vector<bool>& yes) {
  return percent(static_cast<std::size_t>(std::count(yes.begin(), yes.end(), true)), yes.size());
}

std::string within(const std::vector<double>& ratios, double most) {
  std::vector<bool> yes;
  for (const double ratio : ratios) yes.push_back(ratio <= most);
  std::vector<double> sorted = ratios;
  std::sort(sorted.begin(), sorted.end());
  return fmt::format("{} %, median {:.3f}", percent(yes), sorted[sorted.size() / 2]);
}

bool clearly_above(std::size_t count, std::size_t of, double share) {
  const auto n = static_cast<double>(of);
  return static_cast<double>(count) > share * n + 3.0 * std::sqrt(share * (1.0 - share) * n) + 1.0;
}

}  // namespace

void Tally::add(const Outcome& outcome) {
  ++sets;
  right += outcome.right;
  wrong += outcome.wrong;
  hiding += outcome.in_set.has_value();
  in_set += outcome.in_set.value_or(false);
  called += outcome.called;
  with_fakes += outcome.fake.has_value();
  fake += outcome.fake.value_or(false);
  if (outcome.separable) {
    ++asked_oracle;
    separable += *outcome.separable;
    right_of_separable += *outcome.separable && outcome.right;
  }
  if (outcome.baselines) {
    ++asked_baselines;
    for (std::size_t k = 0; k < kBaselines.size(); ++k) {
      baseline_right[k] += (*outcome.baselines)[k].right;
      baseline_wrong[k] += (*outcome.baselines)[k].wrong;
    }
  }
  amplitude.insert(amplitude.end(), outcome.amplitude.begin(), outcome.amplitude.end());
  time_constant.insert(time_constant.end(), outcome.time_constant.begin(), outcome.time_constant.end());
  covered.insert(covered.end(), outcome.covered.begin(), outcome.covered.end());
  if (outcome.training) training.push_back(*outcome.training);
  if (outcome.other_duty) other_duty.push_back(*outcome.other_duty);
}

std::string heading() {
  return fmt::format("{:>2} {:<35} {:>5} {:>18} {:>18} {:>18} {:>18} {:>18} {:>18}  {}\n", "", "cell", "sets", "right",
                     "wrong", "in set", "called", "separable", "right of these", "to reach");
}

std::string lines_of(std::size_t number, const Cell& cell, const Tally& tally) {
  std::string text = fmt::format("{:>2} {:<35} {:>5} {:>18} {:>18} {:>18} {:>18} {:>18} {:>18}  {}\n", number,
                                 cell.name, tally.sets, percent(tally.right, tally.sets),
                                 percent(tally.wrong, tally.sets), percent(tally.in_set, tally.hiding),
                                 percent(tally.called, tally.sets), percent(tally.separable, tally.asked_oracle),
                                 percent(tally.right_of_separable, tally.separable), cell.aim);
  for (std::size_t k = 0; tally.asked_baselines > 0 && k < kBaselines.size(); ++k) {
    text += fmt::format("     {:<32} {:>5} {:>18} {:>18}\n", kBaselines[k], tally.asked_baselines,
                        percent(tally.baseline_right[k], tally.asked_baselines),
                        percent(tally.baseline_wrong[k], tally.asked_baselines));
  }
  if (tally.with_fakes > 0) text += fmt::format("     a fake named: {} %\n", percent(tally.fake, tally.with_fakes));
  if (!tally.amplitude.empty()) {
    text += fmt::format(
        "     of the rightly named: amplitude within 25 %: {} %; time constant within 35 %: {} %; 95 % intervals cover "
        "{} % of {} parameters\n",
        percent(tally.amplitude), percent(tally.time_constant), percent(tally.covered), tally.covered.size());
  }
  if (!tally.training.empty()) {
    text += fmt::format(
        "     with what is named or first in a set: RMSE at most 1.05 times the noise: {}; on another duty cycle at "
        "most 1.15 times the "
        "true model's: {}\n",
        within(tally.training, 1.05), within(tally.other_duty, 1.15));
  }
  return text;
}

bool clearly_missed(const Gate& gate, const Tally& tally) {
  if (gate.most_wrong && clearly_above(tally.wrong, tally.sets, *gate.most_wrong)) return true;
  if (gate.most_called && clearly_above(tally.called, tally.sets, *gate.most_called)) return true;
  return gate.least_in_set && clearly_above(tally.hiding - tally.in_set, tally.hiding, 1.0 - *gate.least_in_set);
}

}  // namespace ballbar::study
