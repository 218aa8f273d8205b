#include "history/events.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "ballbar/history/history.hpp"
#include "history/quantity_series.hpp"

namespace ballbar {
namespace {

using Calls = std::vector<const Call*>;

bool clearer(const Call* left, const Call* right) {
  return std::tie(left->p_value, left->series) < std::tie(right->p_value, right->series);
}

QuantityKind kind_of(const AllSeries& all, const Call& call) {
  return kind_of(series_of(all, call).name, series_of(all, call).plane);
}

// The most significant first, derived ones last.
void sort_by_cause(const AllSeries& all, Calls& calls) {
  std::stable_sort(calls.begin(), calls.end(), [&](const Call* left, const Call* right) {
    const auto follows = [&](const Call* call) {
      const QuantityKind kind = kind_of(all, *call);
      return kind.of_sum || kind.of_both_scales;
    };
    const bool one = follows(left), other = follows(right);
    return one != other ? other : clearer(left, right);
  });
}

// The dates between which a step may lie.
struct Dates {
  double from_s = 0.0, to_s = 0.0;
};

Dates possible_dates(const AllSeries& all, const Call& call) {
  const std::vector<double>& time_s = series_of(all, call).time_s;
  return {time_s[call.place.earliest - 1], time_s[call.place.latest]};
}

Dates likely_dates(const AllSeries& all, const Call& call) {
  const std::vector<double>& time_s = series_of(all, call).time_s;
  return {time_s[call.place.at - 1], time_s[call.place.at]};
}

bool overlap(const Dates& left, const Dates& right) {
  return left.from_s <= right.to_s + kDay_s && right.from_s <= left.to_s + kDay_s;
}

bool step_in_common(const AllSeries& all, const Calls& calls) {
  double sign = 0.0;
  for (const Call* call : calls) {
    const QuantityKind kind = kind_of(all, *call);
    if (kind.of_sum) continue;
    if (!kind.of_scale || call->size * sign < 0.0) return false;
    sign = call->size;
  }
  if (sign == 0.0) return false;
  // A step of a single axis is not the instrument.
  std::set<int> axes;
  for (const Call* call : calls) {
    const QuantityKind kind = kind_of(all, *call);
    if (kind.of_scale && !kind.axis) return true;
    if (kind.axis) axes.insert(*kind.axis);
  }
  return axes.size() > 1;
}

// Serial numbers on both sides, where they change within the dates.
void note_bars(const AllSeries& all, Event& event) {
  const QuantitySeries& series = series_of(all, *event.calls.front());
  const StepPlace& place = event.calls.front()->place;
  for (std::size_t k = place.earliest; k <= place.latest; ++k) {
    event.bar_before = series.bar[k - 1];
    event.bar_after = series.bar[k];
    if (event.bar_before != event.bar_after) return;
  }
}

bool nearer_to_0(const Call& call) { return std::abs(call.after) < std::abs(call.before); }

bool is_clearly_worse(const Call& call) {
  return std::abs(call.after) - std::abs(call.before) > kSignificantSigmas * call.sigma;
}

// The axis with at least two kinds of errors nearer to 0, while nothing else became worse. For the same kind of error
// on another axis a third of that is tolerated, because a ballbar test mixes the axes slightly.
std::optional<int> bettered_axis(const AllSeries& all, const Calls& calls) {
  constexpr double kTakenForAnother = 1.0 / 3.0;
  std::map<int, std::set<std::string>> better;
  std::map<std::string, double> bettered_by;  // by kind of error
  for (const Call* call : calls) {
    const QuantityKind kind = kind_of(all, *call);
    // A new screw has another scale, which need not be a better one.
    if (!kind.axis || !(nearer_to_0(*call) || kind.of_scale)) continue;
    better[*kind.axis].insert(kind.stem);
    double& most = bettered_by[kind.stem];
    most = std::max(most, std::abs(call->size));
  }
  const bool worse = std::any_of(calls.begin(), calls.end(), [&](const Call* call) {
    const QuantityKind kind = kind_of(all, *call);
    return !kind.of_sum && !kind.of_both_scales && !kind.of_scale && is_clearly_worse(*call) &&
           std::abs(call->size) > kTakenForAnother * bettered_by[kind.stem];
  });
  std::optional<int> most;
  for (const auto& [axis, stems] : better) {
    if (stems.size() > 1 && (!most || stems.size() > better[*most].size())) most = axis;
  }
  return worse ? std::nullopt : most;
}

bool is_to_the_worse(const AllSeries& all, const Calls& calls) {
  std::set<std::string> stems;
  int worse = 0, better = 0;
  for (const Call* call : calls) {
    const QuantityKind kind = kind_of(all, *call);
    if (kind.of_sum) continue;
    stems.insert(kind.stem);
    (nearer_to_0(*call) ? better : worse) += 1;
  }
  return stems.size() > 1 && worse > better;
}

Event step_event(const AllSeries& all, Calls calls) {
  Event event;
  std::sort(calls.begin(), calls.end(), clearer);
  event.calls = std::move(calls);
  const Dates dates = likely_dates(all, *event.calls.front());
  event.from_s = dates.from_s;
  event.to_s = dates.to_s;
  event.is_common_scale = step_in_common(all, event.calls);
  note_bars(all, event);
  if (event.is_common_scale && event.bar_before != event.bar_after) {
    event.kind = FindingKind::instrument;
    return event;
  }
  event.axis = event.is_common_scale ? std::nullopt : bettered_axis(all, event.calls);
  if (event.axis) event.kind = FindingKind::replaced_part;
  event.to_the_worse = is_to_the_worse(all, event.calls);
  sort_by_cause(all, event.calls);
  return event;
}

// The steps of one date: where the bar changed and all scales step in common they are an event of their own.
void add_date(const AllSeries& all, const Calls& together, std::vector<Event>& events) {
  Calls scales, others;
  bool bar_changed = false;
  for (const Call* call : together) {
    bar_changed = bar_changed || call->kind == FindingKind::instrument;
    (kind_of(all, *call).of_scale ? scales : others).push_back(call);
  }
  const bool sums_alone =
      std::all_of(others.begin(), others.end(), [&](const Call* call) { return kind_of(all, *call).of_sum; });
  if (!bar_changed || sums_alone || !step_in_common(all, scales)) {
    events.push_back(step_event(all, together));
    return;
  }
  events.push_back(step_event(all, scales));
  events.push_back(step_event(all, others));
}

// The clearest step and all whose dates agree with its own, then the clearest of the rest.
void add_steps(const AllSeries& all, Calls steps, std::vector<Event>& events) {
  std::sort(steps.begin(), steps.end(), clearer);
  while (!steps.empty()) {
    const Dates dates = likely_dates(all, *steps.front());
    Calls together, others;
    for (const Call* call : steps) {
      (overlap(possible_dates(all, *call), dates) ? together : others).push_back(call);
    }
    steps = std::move(others);
    add_date(all, together, events);
  }
}

Event lasting_event(const AllSeries& all, FindingKind kind, Calls calls) {
  Event event;
  event.kind = kind;
  std::sort(calls.begin(), calls.end(), clearer);
  event.calls = std::move(calls);
  const std::vector<double>& time_s = series_of(all, *event.calls.front()).time_s;
  event.from_s = time_s.front();
  event.to_s = time_s.back();
  sort_by_cause(all, event.calls);
  return event;
}

// One for each axis and kind of error; sums join the clearest.
void add_trends(const AllSeries& all, const Calls& trends, std::vector<Event>& events) {
  std::map<std::pair<std::optional<int>, std::string>, Calls> causes;
  Calls sums;
  for (const Call* call : trends) {
    const QuantityKind kind = kind_of(all, *call);
    if (kind.of_sum) {
      sums.push_back(call);
      continue;
    }
    std::string stem = kind.stem;
    // Planes have an angle each, axes a scale each.
    if (!kind.axis) stem += name_of(series_of(all, *call).plane);
    causes[{kind.axis, stem}].push_back(call);
  }
  std::vector<Event> own;
  for (auto& [cause, calls] : causes) {
    own.push_back(lasting_event(all, FindingKind::trend, std::move(calls)));
    own.back().axis = cause.first;
  }
  const auto first = std::min_element(own.begin(), own.end(), [](const Event& left, const Event& right) {
    return clearer(left.calls.front(), right.calls.front());
  });
  if (first != own.end()) {
    first->calls.insert(first->calls.end(), sums.begin(), sums.end());
  } else if (!sums.empty()) {
    own.push_back(lasting_event(all, FindingKind::trend, std::move(sums)));
  }
  std::move(own.begin(), own.end(), std::back_inserter(events));
}

}  // namespace

std::vector<Event> events_of(const AllSeries& all, const std::vector<const Call*>& calls) {
  Calls steps, trends, seasons;
  for (const Call* call : calls) {
    (call->kind == FindingKind::trend ? trends : call->kind == FindingKind::season ? seasons : steps).push_back(call);
  }
  std::vector<Event> events;
  add_steps(all, std::move(steps), events);
  add_trends(all, trends, events);
  if (!seasons.empty()) events.push_back(lasting_event(all, FindingKind::season, std::move(seasons)));
  std::stable_sort(events.begin(), events.end(), [](const Event& left, const Event& right) {
    return clearer(left.calls.front(), right.calls.front());
  });
  return events;
}

}  // namespace ballbar
