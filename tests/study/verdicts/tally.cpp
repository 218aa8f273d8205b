#include "tally.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ballbar::verdicts {
namespace {

std::string percent(std::size_t count, std::size_t of) {
  if (of == 0) return "-";
  const Share share = wilson(count, of);
  return fmt::format("{:.1f} ({:.1f}-{:.1f})", 100.0 * static_cast<double>(count) / static_cast<double>(of),
                     100.0 * share.low, 100.0 * share.high);
}

template <class Is>
std::string percent_of(const std::vector<Judged>& sets, Is is) {
  return percent(static_cast<std::size_t>(std::count_if(sets.begin(), sets.end(), is)), sets.size());
}

}  // namespace

Share wilson(std::size_t count, std::size_t of) {
  if (of == 0) return {};
  constexpr double kZ = 1.959964;
  const auto n = static_cast<double>(of);
  const double p = static_cast<double>(count) / n, z2 = kZ * kZ / n;
  const double middle = p + z2 / 2.0, half = kZ * std::sqrt(p * (1.0 - p) / n + z2 / (4.0 * n));
  return {std::max(0.0, (middle - half) / (1.0 + z2)), std::min(1.0, (middle + half) / (1.0 + z2))};
}

std::string heading() {
  return fmt::format("{:<22} {:>4} {:>18} {:>18} {:>18} {:>18} {:>18} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6}  {}\n",
                     "cell", "sets", "right", "wrong", "driver right", "driver wrong", "nothing said", "prob.",
                     "in set", "any", "open", "clear", "of", "s", "to reach");
}

std::string row_of(const Cell& cell, const std::vector<Judged>& sets) {
  const auto share = [&](auto member) {
    const auto count = std::count_if(sets.begin(), sets.end(), [&](const Judged& set) { return set.*member; });
    return sets.empty() ? 0.0 : 100.0 * static_cast<double>(count) / static_cast<double>(sets.size());
  };
  const auto counted = [&](auto member) { return percent_of(sets, [&](const Judged& set) { return set.*member; }); };
  const auto clear = std::count_if(sets.begin(), sets.end(), [](const Judged& set) { return set.is_clear; });
  const auto both =
      std::count_if(sets.begin(), sets.end(), [](const Judged& set) { return set.is_clear && set.right; });
  const double right_of_clear = clear > 0 ? static_cast<double>(both) / static_cast<double>(clear) : 0.0;
  double took_s = 0.0;
  for (const Judged& set : sets) took_s += set.took_s;
  return fmt::format(
      "{:<22} {:>4} {:>18} {:>18} {:>18} {:>18} {:>18} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.1f} {:>6.2f}  "
      "{}\n",
      cell.name, sets.size(), counted(&Judged::right), counted(&Judged::wrong), counted(&Judged::driver_right),
      counted(&Judged::driver_wrong), counted(&Judged::nothing_said), share(&Judged::probably_right),
      share(&Judged::in_set), share(&Judged::any), share(&Judged::undecided), share(&Judged::is_clear),
      100.0 * right_of_clear, took_s / std::max<double>(1.0, static_cast<double>(sets.size())), cell.aim);
}

std::string reliability(const std::vector<Judged>& sets) {
  std::string text = "P stated of an effect    count  of them true\n";
  for (int bin = 0; bin < 10; ++bin) {
    std::size_t count = 0, right = 0;
    double sum = 0.0;
    for (const Judged& set : sets) {
      for (const Stated& stated : set.stated) {
        if (std::min(9, static_cast<int>(10.0 * stated.p)) != bin) continue;
        ++count;
        right += stated.is_true;
        sum += stated.p;
      }
    }
    if (count == 0) continue;
    const double mean = sum / static_cast<double>(count);
    const Share share = wilson(right, count);
    text += fmt::format("{:.1f} to {:.1f}, mean {:.3f} {:>6}  {:>20}{}\n", 0.1 * bin, 0.1 * (bin + 1), mean, count,
                        percent(right, count), mean < share.low || mean > share.high ? "  outside" : "");
  }
  return text;
}

std::string coverage(const std::vector<Judged>& sets) {
  std::size_t count[2] = {0, 0}, covered[2] = {0, 0};
  for (const Judged& set : sets) {
    for (const Covered& one : set.covered) {
      ++count[one.is_gain];
      covered[one.is_gain] += one.covers;
    }
  }
  return fmt::format("95 % intervals of rightly named effects hold {} % of {} gains, {} % of {} shapes; 92 to 97\n",
                     percent(covered[1], count[1]), count[1], percent(covered[0], count[0]), count[0]);
}

}  // namespace ballbar::verdicts
