#include "diagnose/ledger_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"

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

// "added A, B and took out C", "set D to 3.2, held"
MessageValue done_of(const std::string& change) {
  std::vector<std::string> added, removed;
  std::vector<MessageValue> set;
  std::size_t begin = 0;
  while (begin < change.size()) {
    std::size_t end = change.size();
    for (const std::string_view next : {", + ", ", - ", ", = "}) end = std::min(end, change.find(next, begin));
    const std::string part = change.substr(begin, end - begin);
    if (part.starts_with("+ ")) added.push_back(part.substr(2));
    if (part.starts_with("- ")) removed.push_back(part.substr(2));
    if (part.starts_with("= ")) set.emplace_back(part.substr(2));
    begin = end + 2;
  }
  std::vector<Message> done;
  if (!added.empty()) done.push_back(messages::ledger_added(listed(effects_of(added))));
  if (!removed.empty()) done.push_back(messages::ledger_took_out(listed(effects_of(removed))));
  if (!set.empty()) done.push_back(messages::ledger_set(listed(set)));
  if (done.empty()) return change;
  Message all = done.front();
  for (std::size_t k = 1; k < done.size(); ++k) all = messages::ledger_changes(std::move(all), done[k]);
  return all;
}

}  // namespace

Paragraph sentence_of(const LedgerRow& row, const LedgerRow* before) {
  const bool same = before != nullptr && before->target == row.target && before->data == row.data;
  LedgerRow none;
  none.rmse_um = LedgerRow::kUnknown;
  const LedgerRow& from = same ? *before : none;
  const std::string rmse = change_text(from.rmse_um, row.rmse_um, um_text);
  Paragraph times, left_out, text;
  if (std::isfinite(row.times_floor))
    times = messages::ledger_times(change_text(from.times_floor, row.times_floor, times_text));
  if (std::isfinite(row.held_out_um)) {
    const std::string error = change_text(from.held_out_um, row.held_out_um, um_text);
    left_out = row.level == Level::recording ? messages::ledger_left_out_recordings(error)
                                             : messages::ledger_left_out_cycles(error);
  }
  if (row.revision == 0) {
    text += messages::ledger_start(rmse, times, left_out);
  } else {
    text += messages::ledger_revision(row.revision, done_of(row.change));
    text += messages::ledger_error(rmse, times, left_out);
  }
  if (std::isfinite(row.likelihood_ratio)) {
    const char* const statistic = is_of_axes(row) ? "chi^2" : "2 ln B";
    const std::string value = fmt::format("{:.1f}", row.likelihood_ratio);
    text += std::isfinite(row.threshold)
                ? messages::ledger_evidence_threshold(statistic, value, fmt::format("{:.1f}", row.threshold))
                : messages::ledger_evidence(statistic, value);
  }
  if (std::isfinite(row.forecast_um) && row.revision > 0)
    text += messages::ledger_forecast(change_text(from.forecast_um, row.forecast_um, um_text));
  const auto add_labels = [&](const std::vector<std::string>& labels, auto message) {
    if (!labels.empty()) text += message(listed(effects_of(labels)), labels.size());
  };
  add_labels(row.still_needed, &messages::ledger_needed);
  add_labels(row.no_longer_needed, &messages::ledger_not_needed);
  return text;
}

}  // namespace ballbar
