#include "diagnose/ledger_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "ballbar/internal/number_text.hpp"

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

std::string sentence_of(const LedgerRow& row, const LedgerRow* before) {
  const bool same = before != nullptr && before->target == row.target && before->data == row.data;
  LedgerRow none;
  none.rmse_um = LedgerRow::kUnknown;
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
