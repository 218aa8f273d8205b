#include "outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ballbar/numerics/range.hpp"
#include "baselines.hpp"
#include "errors.hpp"
#include "oracle.hpp"

namespace ballbar::study {
namespace {

bool in(const std::vector<BoundEffect>& group, const DataSet& truth_of_one) {
  return std::any_of(group.begin(), group.end(), [&](const BoundEffect& b) { return is_true(truth_of_one, b); });
}

// Each hidden signal alone.
std::vector<DataSet> one_by_one(const DataSet& set) {
  std::vector<DataSet> ones;
  for (const Hidden& hidden : set.hidden) ones.emplace_back().hidden = {hidden};
  return ones;
}

bool is_reported(const Diagnosis& found, const DataSet& one) {
  return in(found.named, one) || std::any_of(found.equivalent.begin(), found.equivalent.end(),
                                             [&](const std::vector<BoundEffect>& group) { return in(group, one); });
}

Said said(const DataSet& set, const std::vector<BoundEffect>& selected) {
  Said result;
  result.wrong = std::any_of(selected.begin(), selected.end(), [&](const BoundEffect& b) { return !is_true(set, b); });
  const std::vector<DataSet> ones = one_by_one(set);
  result.right =
      !result.wrong && std::all_of(ones.begin(), ones.end(), [&](const DataSet& one) { return in(selected, one); });
  return result;
}

void judge_parameters(const DataSet& set, const Diagnosis& found, Outcome& outcome) {
  for (const Hidden& hidden : set.hidden) {
    const auto at = std::find_if(found.candidates.begin(), found.candidates.end(), [&](const Candidate& candidate) {
      return candidate.in_best_set && hidden.injection && candidate.bound == hidden.injection->bound;
    });
    if (at == found.candidates.end()) continue;
    std::vector<double> seen_um;
    for (const std::size_t row : set.base.row) seen_um.push_back(hidden.signal_um[row]);
    const double range_um = range_of(seen_um);
    outcome.amplitude.push_back(std::abs(at->amplitude_um - range_um) <= 0.25 * range_um);
    for (std::size_t k = 0; k < at->parameters.size(); ++k) {
      const FittedParameter& fitted = at->parameters[k];
      const double truth = hidden.injection->parameters[k];
      if (fitted.name.starts_with("time_constant")) {
        outcome.time_constant.push_back(std::abs(fitted.value - truth) <= 0.35 * truth);
      }
      if (fitted.state == ParameterState::free && std::isfinite(fitted.sigma)) {
        outcome.covered.push_back(std::abs(fitted.value - truth) <= 1.959964 * fitted.sigma);
      }
    }
  }
}

std::string labels(const std::vector<BoundEffect>& bounds) {
  std::string text;
  for (const BoundEffect& bound : bounds) text += (text.empty() ? "" : " ") + label_of(bound);
  return text;
}

}  // namespace

bool is_verbose() { return std::getenv("VERBOSE") != nullptr; }

Outcome judged(const DataSet& set, const Diagnosis& found, Expected expected) {
  Outcome outcome;
  outcome.verdict = found.verdict;
  outcome.called = found.verdict != Verdict::nothing && found.verdict != Verdict::untestable;
  const std::vector<DataSet> ones = one_by_one(set);
  if (!ones.empty() && expected != Expected::unexplained) {
    outcome.in_set = std::all_of(ones.begin(), ones.end(), [&](const DataSet& one) { return is_reported(found, one); });
  }
  const Said names = said(set, found.named);
  const auto reads_fake = [](const BoundEffect& bound) {
    return std::any_of(bound.columns.begin(), bound.columns.end(), is_fake);
  };
  if (std::any_of(set.data.columns.begin(), set.data.columns.end(), [](const Column& c) { return is_fake(c.name); })) {
    outcome.fake = std::any_of(found.named.begin(), found.named.end(), reads_fake);
  }
  switch (expected) {
    case Expected::nothing:
      outcome.right = !outcome.called;
      outcome.wrong = outcome.called;
      break;
    case Expected::effects:
      outcome.wrong = names.wrong;
      outcome.right = names.right && found.equivalent.empty();
      if (outcome.right) judge_parameters(set, found, outcome);
      break;
    case Expected::unexplained:
      outcome.wrong = names.wrong;
      outcome.right = found.verdict == Verdict::unexplained;
      break;
    case Expected::undecided:
      outcome.wrong = !found.named.empty();
      outcome.right = !outcome.wrong && outcome.in_set.value_or(false);
      break;
  }
  return outcome;
}

void print(const DataSet& set, const Diagnosis& found, const Outcome& outcome) {
  std::string truth, equivalent;
  for (const Hidden& hidden : set.hidden) truth += (truth.empty() ? "" : " ") + hidden.what;
  for (const auto& group : found.equivalent) equivalent += "{" + labels(group) + "}";
  const char* word = outcome.right                    ? "RIGHT"
                     : outcome.wrong                  ? "WRONG"
                     : outcome.in_set.value_or(false) ? "inset"
                                                      : "miss ";
  fmt::print("{:4} {} truth [{}] {} named [{}] equivalent [{}] p {:.4f} smooth {:.1f}\n", set.options.search.seed, word,
             truth, name_of(found.verdict), labels(found.named), equivalent, found.p_anything,
             found.smooth_likelihood_ratio);
  if (outcome.loss) fmt::print("       loss {:.1f} by {}\n", *outcome.loss, outcome.competitor);
  if (outcome.training)
    fmt::print("       training {:.3f} other duty {:.3f}\n", *outcome.training, *outcome.other_duty);
  for (const std::string& reason : found.reasons) fmt::print("       {}\n", reason);
  for (const Candidate& c : found.candidates) {
    fmt::print(
        "       {:60} {:8.2f} likelihood ratio {:7.1f} threshold {:5.1f} p {:.4f} same {:.3f} held {:.3f}->{:.3f} "
        "surrogate "
        "{:.1f}\n",
        label_of(c.bound), c.amplitude_um, c.likelihood_ratio, c.threshold, c.p_search, c.p_same_gain,
        c.held_out_before_um, c.held_out_after_um, c.best_surrogate_gain);
  }
}

Outcome judged_and_weighed(const DataSet& set, const Diagnosis& found, Expected expected) {
  Outcome outcome = judged(set, found, expected);
  if (!set.hidden.empty() && !set.base.row.empty()) {
    const Oracle allowed = oracle(set);
    outcome.separable = allowed.loss >= kSeparable;
    outcome.loss = allowed.loss;
    outcome.competitor = allowed.competitor;
  }
  if (is_verbose()) print(set, found, outcome);
  return outcome;
}

Outcome examined(const DataSet& set, Expected expected, const Besides& besides) {
  const Diagnosis found = diagnose(set.model, set.data, 0, set.options);
  Outcome outcome = judged_and_weighed(set, found, expected);
  if (besides.baselines) {
    const auto selected = baselines(set);
    outcome.baselines.emplace();
    for (std::size_t k = 0; k < selected.size(); ++k) (*outcome.baselines)[k] = said(set, selected[k]);
  }
  if (besides.errors && !(found.named.empty() && found.equivalent.empty())) {
    std::vector<BoundEffect> added = found.named;
    for (const std::vector<BoundEffect>& group : found.equivalent) added.push_back(group.front());
    const Errors errors = errors_of(set, added);
    outcome.training = errors.training;
    outcome.other_duty = errors.other_duty;
    if (is_verbose()) fmt::print("       training {:.3f} other duty {:.3f}\n", errors.training, errors.other_duty);
  }
  return outcome;
}

}  // namespace ballbar::study
