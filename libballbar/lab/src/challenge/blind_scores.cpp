#include <algorithm>
#include <cmath>

#include "ballbar/lab/challenge/blind.hpp"

namespace ballbar {
namespace {

constexpr double kZ = 1.959964;  // two-sided 95 % of the normal distribution

bool same(const BoundEffect& truth, const BoundEffect& stated) {
  return truth.effect == stated.effect &&
         (truth.columns.empty() || stated.columns.empty() || truth.columns == stated.columns);
}

bool holds(const std::vector<BoundEffect>& bounds, const BoundEffect& one) {
  return std::any_of(bounds.begin(), bounds.end(), [&](const BoundEffect& bound) { return same(one, bound); });
}

BlindOutcome outcome_of_effects(const BlindAnswer& answer, const BlindVerdict& verdict) {
  const bool any = answer.kind == BlindKind::spindle;  // which of those that match
  const std::vector<BoundEffect>& truth = any ? answer.match : answer.hidden;
  const auto is_true = [&](const BoundEffect& stated) { return holds(truth, stated); };
  if (!std::all_of(verdict.named.begin(), verdict.named.end(), is_true)) return BlindOutcome::wrong;
  const auto is_named = [&](const BoundEffect& one) { return holds(verdict.named, one); };
  const auto is_stated = [&](const BoundEffect& one) { return is_named(one) || holds(verdict.reported, one); };
  const auto enough = [&](const auto& question) {
    return any ? std::any_of(truth.begin(), truth.end(), question) : std::all_of(truth.begin(), truth.end(), question);
  };
  const bool alone = any || (verdict.reported.empty() && verdict.named.size() == truth.size());
  if (enough(is_named) && alone) return BlindOutcome::right;
  return enough(is_stated) ? BlindOutcome::in_set : BlindOutcome::missed;
}

}  // namespace

BlindVerdict verdict_of(const Diagnosis& diagnosis) {
  BlindVerdict verdict{diagnosis.verdict, diagnosis.named, diagnosis.probable};
  for (const std::vector<BoundEffect>& group : diagnosis.equivalent) {
    verdict.reported.insert(verdict.reported.end(), group.begin(), group.end());
  }
  return verdict;
}

std::string_view name_of(BlindOutcome outcome) {
  constexpr std::string_view kNames[] = {"right", "in the set", "missed", "wrong"};
  return kNames[static_cast<std::size_t>(outcome)];
}

BlindOutcome outcome_of(const BlindAnswer& answer, const BlindVerdict& verdict) {
  switch (answer.kind) {
    case BlindKind::nothing:
      return verdict.verdict == Verdict::nothing || verdict.verdict == Verdict::untestable ? BlindOutcome::right
                                                                                           : BlindOutcome::wrong;
    case BlindKind::outside:
      if (!verdict.named.empty()) return BlindOutcome::wrong;
      return verdict.verdict == Verdict::unexplained ? BlindOutcome::right : BlindOutcome::missed;
    case BlindKind::inseparable: {
      if (!verdict.named.empty()) return BlindOutcome::wrong;
      if (verdict.verdict == Verdict::untestable) return BlindOutcome::right;
      const bool reported = std::all_of(answer.hidden.begin(), answer.hidden.end(),
                                        [&](const BoundEffect& one) { return holds(verdict.reported, one); });
      return reported ? BlindOutcome::right : BlindOutcome::missed;
    }
    case BlindKind::one:
    case BlindKind::two:
    case BlindKind::spindle:
      break;
  }
  return outcome_of_effects(answer, verdict);
}

Share share_of(std::size_t count, std::size_t of) {
  if (of == 0) return {count, of, 0.0, 1.0};
  const double n = static_cast<double>(of), p = static_cast<double>(count) / n;
  const double scale = 1.0 + kZ * kZ / n;
  const double centre = (p + kZ * kZ / (2.0 * n)) / scale;
  const double half = kZ * std::sqrt(p * (1.0 - p) / n + kZ * kZ / (4.0 * n * n)) / scale;
  return {count, of, count == 0 ? 0.0 : centre - half, count == of ? 1.0 : centre + half};
}

Scores scores_of(std::span<const BlindAnswer> answers, std::span<const BlindOutcome> outcomes) {
  std::size_t right = 0, wrong = 0, nothing = 0, called = 0, outside = 0, named = 0, testable = 0, in_set = 0;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const bool is_right = outcomes[i] == BlindOutcome::right, is_wrong = outcomes[i] == BlindOutcome::wrong;
    right += is_right;
    wrong += is_wrong;
    const BlindKind kind = answers[i].kind;
    nothing += kind == BlindKind::nothing;
    called += kind == BlindKind::nothing && is_wrong;
    outside += kind == BlindKind::outside;
    named += kind == BlindKind::outside && is_wrong;
    if (kind == BlindKind::nothing || kind == BlindKind::outside) continue;
    ++testable;
    in_set += is_right || outcomes[i] == BlindOutcome::in_set;
  }
  return {share_of(called, nothing), share_of(right, answers.size()), share_of(wrong, answers.size()),
          share_of(in_set, testable), share_of(named, outside)};
}

}  // namespace ballbar
