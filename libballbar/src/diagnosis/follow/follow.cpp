#include "ballbar/diagnosis/follow/follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/follow/forecast.hpp"
#include "diagnosis/thresholds.hpp"

namespace ballbar {
namespace {

constexpr double kLookGrowth = 13.0 / 12.0;  // ratio of the numbers of values of successive looks

bool is_in(const std::vector<std::string>& labels, const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

using TwiceLogged = std::map<std::string, std::string>;

std::string once(BoundEffect bound, const TwiceLogged& logged_twice) {
  for (std::string& column : bound.columns) {
    if (const auto first = logged_twice.find(column); first != logged_twice.end()) column = first->second;
  }
  return label_of(bound);
}

bool reads_twice_logged(const BoundEffect& bound, const TwiceLogged& logged_twice) {
  return std::any_of(logged_twice.begin(), logged_twice.end(), [&](const auto& same) {
    return is_in(bound.columns, same.first) || is_in(bound.columns, same.second);
  });
}

std::vector<Hypothesis> hypotheses_of(const Diagnosis& diagnosis, const TwiceLogged& logged_twice) {
  std::vector<Hypothesis> result;
  result.reserve(diagnosis.effects.size() + diagnosis.own.size());
  for (const EffectProbability& one : diagnosis.effects) {
    result.push_back({label_of(one.bound), one.p, once(one.bound, logged_twice)});
  }
  for (const OwnValue& own : diagnosis.own) result.push_back({label_of(own), own.p, label_of(own)});
  std::stable_sort(result.begin(), result.end(), [](const Hypothesis& a, const Hypothesis& b) { return a.p > b.p; });
  return result;
}

constexpr double kSure = 1.0 - kFalselyDecided;

bool is_likely(const Diagnosis& diagnosis) { return diagnosis.log_bayes_factor >= least_log_bayes_factor(); }

// Labels that all tests name, with the probability that repeated looks require.
std::vector<std::string> sure_of(const Diagnosis& diagnosis, const std::vector<Hypothesis>& hypotheses,
                                 const TwiceLogged& logged_twice) {
  if (diagnosis.verdict != Verdict::named || !is_likely(diagnosis)) return {};
  std::vector<std::string> named;
  named.reserve(diagnosis.named.size() + diagnosis.own.size());
  for (const BoundEffect& bound : diagnosis.named) {
    if (!reads_twice_logged(bound, logged_twice)) named.push_back(label_of(bound));
  }
  for (const OwnValue& own : diagnosis.own) named.push_back(label_of(own));
  std::vector<std::string> sure;
  for (const Hypothesis& one : hypotheses) {
    if (one.p >= kSure && is_in(named, one.label)) sure.push_back(one.label);
  }
  return sure;
}

// At the last looks, all of them.
std::vector<std::string> lasting(const std::vector<Look>& looks) {
  if (looks.size() < kLooksToDecide) return {};
  std::vector<std::string> labels = looks.back().sure;
  for (std::size_t k = looks.size() - kLooksToDecide; k < looks.size(); ++k) {
    std::erase_if(labels, [&](const std::string& label) { return !is_in(looks[k].sure, label); });
  }
  return labels;
}

bool lasts_hopeless(const std::vector<Look>& looks) {
  return looks.size() >= kLooksToDecide && std::all_of(looks.end() - kLooksToDecide, looks.end(),
                                                       [](const Look& look) { return !look.why_stop.empty(); });
}

FollowState with_look(FollowState state, Look look) {
  state.looks.push_back(std::move(look));
  if (state.outcome == Outcome::decided) return state;
  state.looks.back().why_stop = why_it_stays_open(state);
  state.decided = lasting(state.looks);
  if (!state.decided.empty()) {
    state.outcome = Outcome::decided;
    state.decided_at = state.looks.size() - 1;
  } else {
    state.outcome = lasts_hopeless(state.looks) ? Outcome::undecidable : Outcome::open;
  }
  return state;
}

}  // namespace

std::map<std::string, std::string> columns_logged_twice(const Series& data) {
  const auto is_same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  std::map<std::string, std::string> result;
  for (std::size_t k = 0; k < data.columns.size(); ++k) {
    const std::vector<double>& values = data.columns[k].values;
    const auto first = std::find_if(
        data.columns.begin(), data.columns.begin() + static_cast<std::ptrdiff_t>(k), [&](const Column& other) {
          return std::equal(values.begin(), values.end(), other.values.begin(), other.values.end(), is_same);
        });
    if (first != data.columns.begin() + static_cast<std::ptrdiff_t>(k)) result[data.columns[k].name] = first->name;
  }
  return result;
}

std::string label_of(const OwnValue& own) { return fmt::format("{} of {}", own.parameter, own.effect); }

std::string_view name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::decided:
      return "decided";
    case Outcome::undecidable:
      return "undecidable";
    case Outcome::open:
      break;
  }
  return "open";
}

std::size_t values_of_look(std::size_t look) {
  return static_cast<std::size_t>(
      std::lround(static_cast<double>(kFirstLook) * std::pow(kLookGrowth, static_cast<double>(look))));
}

Series first_rows(const Series& data, const std::string& target, std::size_t values) {
  const std::vector<double>& read = find_column(data, target)->values;
  std::size_t rows = 0;
  for (std::size_t found = 0; rows < read.size() && found < values; ++rows) found += std::isnan(read[rows]) ? 0 : 1;
  Series result = data;
  result.time_s.resize(rows);
  for (Column& column : result.columns) column.values.resize(rows);
  return result;
}

FollowState followed(FollowState state, const Diagnosis& diagnosis, std::size_t values, double hours) {
  Look look;
  look.values = values;
  look.hours = hours;
  look.verdict = diagnosis.verdict;
  look.p_nothing = diagnosis.p_nothing;
  look.log_bayes_factor = diagnosis.log_bayes_factor;
  look.hypotheses = hypotheses_of(diagnosis, state.logged_twice);
  look.sure = sure_of(diagnosis, look.hypotheses, state.logged_twice);
  const bool would_be = is_likely(diagnosis) && !look.hypotheses.empty() && look.hypotheses.front().p >= kSure;
  if (would_be && look.sure.empty()) look.doubts = diagnosis.reasons;
  return with_look(std::move(state), std::move(look));
}

FollowState followed(FollowState state, const std::string& fault, std::size_t values, double hours) {
  Look look;
  look.values = values;
  look.hours = hours;
  look.fault = fault;
  return with_look(std::move(state), std::move(look));
}

}  // namespace ballbar
