#include "ballbar/revision/ledger.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/number_text.hpp"
#include "diagnosis/verdict/member_tests.hpp"
#include "fit/machine_error_fit.hpp"
#include "revision/effect_test_parts.hpp"

namespace ballbar {
namespace {

// "12.3", "0.31", "120": three digits.
std::string um_text(double value) {
  if (!(std::abs(value) > 0.0)) return "0";
  return fmt::format("{:.{}f}", value, decimals_showing(3, value));
}

std::string times_text(double value) { return fmt::format("{:.{}f}", value, value < 10.0 ? 2 : 1); }

// "12.3 -> 3.1", or what is known of it.
template <class Text>
std::string change_text(double before, double after, Text text) {
  return std::isfinite(before) ? fmt::format("{} -> {}", text(before), text(after)) : text(after);
}

std::string needed_text(const std::vector<std::string>& labels, std::string_view what) {
  if (labels.empty()) return "";
  return fmt::format(" {} {} {}.", fmt::join(labels, ", "), labels.size() == 1 ? "is" : "are", what);
}

// "added A, B and took out C", "set D to 3.2, held"
std::string done_text(const std::string& change) {
  std::vector<std::string> added, removed, set;
  std::size_t begin = 0;
  while (begin < change.size()) {
    std::size_t end = change.size();
    for (const std::string_view next : {", + ", ", - ", ", = "}) end = std::min(end, change.find(next, begin));
    const std::string part = change.substr(begin, end - begin);
    if (part.starts_with("+ ")) added.push_back(part.substr(2));
    if (part.starts_with("- ")) removed.push_back(part.substr(2));
    if (part.starts_with("= ")) set.push_back(part.substr(2));
    begin = end + 2;
  }
  std::vector<std::string> done;
  if (!added.empty()) done.push_back(fmt::format("added {}", fmt::join(added, ", ")));
  if (!removed.empty()) done.push_back(fmt::format("took out {}", fmt::join(removed, ", ")));
  if (!set.empty()) done.push_back(fmt::format("set {}", fmt::join(set, ", ")));
  return done.empty() ? change : fmt::format("{}", fmt::join(done, " and "));
}

}  // namespace

LedgerRow row_of(const Fit& fit, const Model& model, const Series& data, std::size_t target) {
  LedgerRow row;
  row.level = model.level;
  row.target = fit.target;
  row.parameters = static_cast<std::size_t>(
      std::count_if(fit.parameters.begin(), fit.parameters.end(),
                    [](const FittedParameter& parameter) { return parameter.state != ParameterState::held; }));
  row.rmse_um = fit.rmse_um;
  if (!fit.floor.source.empty() && fit.floor.rms_um > 0.0) row.times_floor = fit.rmse_um / fit.floor.rms_um;
  row.held_out_um = held_out_um(model, data, target);
  return row;
}

LedgerRow row_of(const Model& model, const Series& data, std::size_t target) {
  if (is_of_machine_errors(model, data)) return machine_error_row(model, data, target);
  return row_of(fit(model, data, target), model, data, target);
}

// Thresholds of 2 ln B are whole multiples of the least one, those of chi^2 are quantiles or not known.
bool is_of_axes(const LedgerRow& row) {
  const bool is_of_2_ln_B = std::remainder(row.threshold, kLeastLikelihoodRatio) == 0.0;
  return row.level == Level::recording && std::isfinite(row.likelihood_ratio) && !is_of_2_ln_B;
}

std::string sentence(const LedgerRow& row, const LedgerRow* before) {
  const bool same = before != nullptr && before->target == row.target && before->data == row.data;
  const LedgerRow none{.rmse_um = LedgerRow::kUnknown};
  const LedgerRow& from = same ? *before : none;
  std::string text = row.revision == 0 ? "The model started with"
                                       : fmt::format("Revision {} {}.", row.revision, done_text(row.change));
  text += fmt::format(" RMSE {} um", change_text(from.rmse_um, row.rmse_um, um_text));
  if (std::isfinite(row.times_floor)) {
    text += fmt::format(" ({} times the noise)", change_text(from.times_floor, row.times_floor, times_text));
  }
  if (std::isfinite(row.held_out_um)) {
    text += fmt::format(", left-out {} {} um", row.level == Level::recording ? "recordings" : "cycles",
                        change_text(from.held_out_um, row.held_out_um, um_text));
  }
  text += '.';
  if (std::isfinite(row.likelihood_ratio)) {
    text += fmt::format(" {} is {:.1f}", is_of_axes(row) ? "chi^2" : "2 ln B", row.likelihood_ratio);
    if (std::isfinite(row.threshold)) text += fmt::format(" (threshold {:.1f})", row.threshold);
    text += '.';
  }
  if (std::isfinite(row.forecast_um) && row.revision > 0) {
    text += fmt::format(" Forecast error {} um.", change_text(from.forecast_um, row.forecast_um, um_text));
  }
  return text + needed_text(row.still_needed, "still needed") + needed_text(row.no_longer_needed, "no longer needed");
}

}  // namespace ballbar
