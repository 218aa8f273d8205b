#include "judged.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace ballbar::verdicts {
namespace {

constexpr double kLeastP = 0.05;

std::vector<std::string> sorted(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  return names;
}

bool has(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool has(const std::vector<Member>& members, const Truth& truth) {
  return std::any_of(members.begin(), members.end(), [&](const Member& member) { return is_same(truth, member); });
}

bool is_true(const Made& made, const Member& member) {
  return std::any_of(made.truths.begin(), made.truths.end(), [&](const Truth& t) { return is_same(t, member); });
}

bool all_true(const Made& made, const std::vector<Member>& members) {
  return std::all_of(members.begin(), members.end(), [&](const Member& m) { return is_true(made, m); });
}

bool are_truths(const Made& made, const std::vector<Member>& members) {
  return !made.truths.empty() && all_true(made, members) &&
         std::all_of(made.truths.begin(), made.truths.end(), [&](const Truth& t) { return has(members, t); });
}

// A step is told by its moment, to two rows.
bool are_steps_placed(const Made& made, const Said& said) {
  const std::vector<double>& time_s = made.data.time_s;
  for (const Truth& truth : made.truths) {
    if (truth.effect != "step") continue;
    const double two_rows_s = 2.0 * (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
    const auto placed = [&](const SaidOnset& one) {
      return std::abs(one.onset_s - truth.parameters.back().value) <= two_rows_s;
    };
    if (std::none_of(said.onsets.begin(), said.onsets.end(), placed)) return false;
  }
  return true;
}

bool is_own(const Made& made, const SaidOwn& own) {
  return made.own && made.own->effect == own.effect && made.own->parameter == own.parameter;
}

// A term of the model on a column that drives what is hidden outside the catalogue: its form is not right, but near.
bool reads_a_driver(const Made& made, const SaidOwn& own) {
  return std::any_of(made.drivers.begin(), made.drivers.end(),
                     [&](const std::string& column) { return own.effect.find(column) != std::string::npos; });
}

// Columns that the diagnosis says are at work.
std::vector<std::string> said_drivers(const Said& said) {
  std::vector<std::string> columns;
  for (const std::vector<Member>* members : {&said.named, &said.probable}) {
    for (const Member& member : *members) columns.insert(columns.end(), member.columns.begin(), member.columns.end());
  }
  for (const SaidDriver& driver : said.drivers) {
    if (driver.p >= kSure) columns.push_back(driver.column);
  }
  return columns;
}

void judge_intervals(const Made& made, const Said& said, Judged& judged) {
  for (const SaidInterval& interval : said.intervals) {
    const auto same = [&](const Member& m) {
      return m.effect == interval.member.effect && m.columns == interval.member.columns;
    };
    if (std::none_of(said.named.begin(), said.named.end(), same)) continue;
    for (const Truth& truth : made.truths) {
      if (!is_same(truth, interval.member)) continue;
      const bool is_turned = truth.columns != interval.member.columns;
      for (const ParameterTruth& parameter : truth.parameters) {
        if (parameter.name != interval.parameter || parameter.value == 0.0) continue;
        const double value = parameter.is_gain && is_turned ? -parameter.value : parameter.value;
        judged.covered.push_back({parameter.is_gain, value >= interval.low && value <= interval.high});
      }
    }
  }
}

void judge_drivers(const Made& made, const Said& said, Judged& judged) {
  const std::vector<std::string> columns = said_drivers(said);
  judged.driver_wrong =
      std::any_of(columns.begin(), columns.end(), [&](const std::string& c) { return !has(made.drivers, c); });
  const auto is_said = [&](const std::string& c) { return has(columns, c); };
  judged.driver_right = !made.drivers.empty() && std::all_of(made.drivers.begin(), made.drivers.end(), is_said);
  if (!made.is_outside) return;
  judged.driver_right = std::any_of(made.drivers.begin(), made.drivers.end(), is_said) ||
                        std::any_of(said.own.begin(), said.own.end(),
                                    [&](const SaidOwn& own) { return own.p >= kSure && reads_a_driver(made, own); });
}

std::string labels(const std::vector<Member>& members) {
  std::vector<std::string> texts;
  texts.reserve(members.size());
  for (const Member& m : members) texts.push_back(fmt::format("{}({})", m.effect, fmt::join(m.columns, ", ")));
  return fmt::format("{}", fmt::join(texts, " + "));
}

}  // namespace

bool is_same(const Truth& truth, const Member& member) {
  if (truth.effect != member.effect) return false;
  return member.effect == "gradient_bending" ? sorted(truth.columns) == sorted(member.columns)
                                             : truth.columns == member.columns;
}

Judged judged(const Made& made, const Said& said) {
  Judged result;
  result.took_s = said.took_s;
  result.nothing_said = said.word == Word::nothing || said.word == Word::untestable;
  const bool own_wrong = std::any_of(said.own.begin(), said.own.end(), [&](const SaidOwn& own) {
    return own.p >= kSure && !is_own(made, own) && !(made.is_outside && reads_a_driver(made, own));
  });
  result.wrong = !all_true(made, said.named) || own_wrong;
  judge_drivers(made, said, result);
  if (made.is_outside) {
    result.wrong = result.wrong || result.driver_wrong;
    result.right = !result.wrong && (said.word == Word::unexplained || result.driver_right);
    result.undecided = !result.wrong && !result.right && !result.nothing_said;
    return result;
  }
  if (made.own) {
    result.right = !result.wrong && said.named.empty() &&
                   std::any_of(said.own.begin(), said.own.end(),
                               [&](const SaidOwn& own) { return own.p >= kSure && is_own(made, own); });
    return result;
  }
  for (const Member& member : said.effects) {
    if (member.p > kLeastP) result.stated.push_back({member.p, is_true(made, member)});
  }
  if (made.truths.empty()) {
    result.wrong = result.wrong || result.driver_wrong;
    result.right = result.nothing_said;
    return result;
  }
  result.right = !own_wrong && said.word == Word::named && are_truths(made, said.named) && are_steps_placed(made, said);
  result.is_clear = made.ideal_p >= kSure;
  result.any = !result.wrong && !said.named.empty();
  result.probably_right = said.word == Word::probable && are_truths(made, said.probable);
  result.probably_wrong = !all_true(made, said.probable);
  result.in_set = std::all_of(made.truths.begin(), made.truths.end(), [&](const Truth& truth) {
    return has(said.named, truth) || has(said.probable, truth) ||
           std::any_of(said.equivalent.begin(), said.equivalent.end(),
                       [&](const std::vector<Member>& group) { return has(group, truth); });
  });
  judge_intervals(made, said, result);
  return result;
}

std::string line_of(const Made& made, const Said& said, const Judged& judged) {
  const char* word = judged.wrong ? "WRONG" : judged.right ? "right" : judged.probably_right ? "prob." : "     ";
  std::string line =
      fmt::format("{:5} {} [{}{}] {} rows, sigma {:.2f}, model {} | {} [{}]", made.seed, word, made.what,
                  made.rival.empty() ? "" : fmt::format(", ideal {:.2f}, else {}", made.ideal_p, made.rival),
                  made.data.time_s.size(), made.sigma_um,
                  made.model.terms.empty() ? "constant" : label_of(made.model.terms.front()), name_of(said.word),
                  labels(said.named));
  if (!said.probable.empty()) line += fmt::format(" probable [{}]", labels(said.probable));
  for (const std::vector<Member>& group : said.equivalent) line += fmt::format(" {{{}}}", labels(group));
  for (const SaidDriver& driver : said.drivers) line += fmt::format(" driver {} {:.2f}", driver.column, driver.p);
  for (const SaidOwn& own : said.own) {
    line += fmt::format(" own {} {} {:.3g} -> {:.3g} P {:.2f}", own.effect, own.parameter, own.held, own.fitted, own.p);
  }
  for (const Member& member : said.effects) {
    if (member.p > kLeastP) line += fmt::format(" P {:.2f} {}", member.p, labels({member}));
  }
  line += fmt::format(" | nothing {:.2f} discrepancy {:.2f} {:.2f} s | {}\n", said.p_nothing, said.p_discrepancy,
                      said.took_s, said.sentence);
  return line;
}

}  // namespace ballbar::verdicts
