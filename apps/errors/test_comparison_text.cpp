#include "errors/test_comparison_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "errors/quantity_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

std::string number_text(double value, const std::string& unit) { return fixed(value, decimals_in(unit)); }

// "squareness fell from 8.10 to 1.20 um"
Message change_of(const MessageValue& quantity, double before, double after, const std::string& unit) {
  const std::string from = number_text(before, unit), to = number_text(after, unit);
  if (before * after < 0.0) return messages::quantity_changed(quantity, from, to, unit);
  return std::abs(after) < std::abs(before) ? messages::quantity_fell(quantity, from, to, unit)
                                            : messages::quantity_grew(quantity, from, to, unit);
}

const QuantityDifference* circularity_of(const TestComparison& comparison) {
  if (comparison.quantities.empty()) return nullptr;
  const QuantityDifference& first = comparison.quantities.front();
  return first.name == "circularity" && std::isfinite(first.difference) ? &first : nullptr;
}

bool is_to_be_shown(const QuantityDifference& one) {
  if (one.of_set_up) return false;
  const bool is_error = one.name != "global_scale" && one.shown;
  return one.name == "circularity" || one.clear.value_or(false) || is_error;
}

std::string directions_text(const MachineTest& test) {
  std::vector<std::string_view> names;
  for (const Direction direction : test.directions) names.push_back(name_of(direction));
  return fmt::format("{}", fmt::join(names, " and "));
}

std::string arc_text(const MachineTest& test) {
  return fmt::format("{:.0f} deg from {:.0f}", test.arc_deg, test.start_deg);
}

std::string head_text(const MachineTest& test) {
  std::string text = test.started_s ? date_text(static_cast<double>(*test.started_s)) : "-";
  text += fmt::format(", {}, {:g} mm", name_of(test.plane), test.nominal_length_mm);
  if (test.feed_mm_per_min) text += fmt::format(", {:.0f} mm/min", *test.feed_mm_per_min);
  text += fmt::format(", {:.0f} deg", test.arc_deg);
  if (!test.directions.empty()) text += ", " + directions_text(test);
  return text;
}

}  // namespace

Paragraph conclusion(const TestComparison& comparison) {
  const QuantityDifference* const round = circularity_of(comparison);
  if (comparison.judged == 0) {
    Paragraph text = messages::stored_without_sigma();
    if (round != nullptr)
      text += messages::circularity_from_to(number_text(round->before, "um"), number_text(round->after, "um"));
    return text;
  }
  std::vector<MessageValue> changes;
  for (const ClearChange& one : clear_changes(comparison))
    changes.emplace_back(change_of(EffectLabel{one.name}, one.before, one.after, one.unit));
  if (round != nullptr && round->clear.value_or(false))
    changes.emplace_back(change_of(messages::circularity(), round->before, round->after, "um"));
  if (!changes.empty()) return messages::changed_alone(listed(changes));
  if (round == nullptr) return messages::no_significant_difference();
  return messages::no_significant_difference_of(with_sigma(round->before, round->before_sigma, 2),
                                                with_sigma(round->after, round->after_sigma, 2));
}

std::vector<std::string> condition_texts(const TestComparison& comparison) {
  const MachineTest &before = comparison.before, &after = comparison.after;
  std::vector<std::string> texts;
  for (const TestCondition condition : comparison.differs) {
    switch (condition) {
      case TestCondition::nominal_length:
        texts.push_back(fmt::format("The bars differ in length: {:g} and {:g} mm.", before.nominal_length_mm,
                                    after.nominal_length_mm));
        break;
      case TestCondition::arc:
        texts.push_back(fmt::format("The arcs differ: {} and {}.", arc_text(before), arc_text(after)));
        break;
      case TestCondition::feed:
        texts.push_back(fmt::format("The feeds differ: {:.0f} and {:.0f} mm/min.", before.feed_mm_per_min.value_or(0.0),
                                    after.feed_mm_per_min.value_or(0.0)));
        break;
      case TestCondition::directions:
        texts.push_back(
            fmt::format("The directions differ: {}, then {}.", directions_text(before), directions_text(after)));
        break;
      case TestCondition::bar:
        texts.push_back(fmt::format("The bars differ: {} and {}.", one_line(before.bar), one_line(after.bar)));
        break;
      case TestCondition::machine:
        texts.push_back(
            fmt::format("The machines differ: {} and {}.", one_line(before.machine), one_line(after.machine)));
        break;
      case TestCondition::stored:
        texts.emplace_back(
            "One test has readings, the other only results of the instrument's software, which evaluates by other "
            "rules.");
        break;
    }
  }
  if (!texts.empty()) texts.emplace_back("This may cause the difference, not the machine.");
  return texts;
}

std::string comparison_text(const TestComparison& comparison, bool all) {
  std::string text = fmt::format("before  {}  {}\nafter   {}  {}\n\n{}\n", one_line(comparison.before.file),
                                 head_text(comparison.before), one_line(comparison.after.file),
                                 head_text(comparison.after), wrapped(conclusion(comparison)));
  std::string conditions;
  for (const std::string& one : condition_texts(comparison)) conditions += (conditions.empty() ? "" : " ") + one;
  if (!conditions.empty()) text += wrapped(conditions) + '\n';
  Table table({"quantity", "before", "after", "difference", "unit", "sigmas", "significant"});
  std::size_t left_out = 0;
  for (const QuantityDifference& one : comparison.quantities) {
    if (!all && !is_to_be_shown(one)) {
      left_out += one.of_set_up ? 0 : 1;
      continue;
    }
    const int decimals = decimals_in(one.unit);
    const auto cell = [&](double value, double sigma) {
      return std::isfinite(value) ? with_sigma(value, sigma, decimals) : std::string("-");
    };
    const double sigmas = std::abs(one.difference) / one.sigma;
    table.add({one.name, cell(one.before, one.before_sigma), cell(one.after, one.after_sigma),
               cell(one.difference, one.sigma), one.unit, std::isfinite(sigmas) ? fixed(sigmas, 1) : "-",
               !one.clear   ? "-"
               : *one.clear ? "yes"
                            : "no"});
  }
  text += table.text();
  if (left_out > 0)
    text +=
        fmt::format("... {} more row{}, none significant; --details prints all\n", left_out, left_out == 1 ? "" : "s");
  return text + '\n' +
         wrapped(fmt::format("± is one sigma of the fits. Significant: noise alone causes such a difference in at most "
                             "5 % of pairs of tests, corrected for {} quantities. A new set-up or a warmer machine "
                             "adds more than noise; `ballbar history` of several tests shows how much.",
                             comparison.judged));
}

}  // namespace ballbar
