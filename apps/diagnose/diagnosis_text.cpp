// A diagnosis for the terminal: what it says, what to type next, then what it rests on; all of that by --details.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnose/diagnosis_report.hpp"
#include "diagnose/diagnosis_sentence.hpp"
#include "diagnose/next_command.hpp"
#include "model/testability_text.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kDrivers = 4;
constexpr std::size_t kRows = 5, kRowsOfSeveral = 3;  // of candidates, unasked
constexpr std::size_t kTargetsWithRows = 3;           // of more targets a table each would not fit a screen
constexpr std::size_t kReasons = 3;
constexpr double kLeastShown = 0.01;  // P of a candidate, unasked

// "1. Certain: ...", "2. Probable: ...", "3. One of these as well: ...": where there is more than one thing to say.
std::vector<std::string> parts_of(const Diagnosis& found) {
  std::vector<std::string> parts;
  if (!found.named.empty()) parts.push_back("Certain: " + labels(found.named, "; "));
  if (!found.probable.empty()) parts.push_back("Probable: " + labels(found.probable, "; "));
  for (const std::vector<BoundEffect>& group : found.equivalent) {
    const bool first = parts.empty();
    parts.push_back(fmt::format("{}: {}",
                                group.size() == 1 ? (first ? "In question" : "In question as well")
                                                  : (first ? "One of these" : "One of these as well"),
                                labels(group, ", or ")));
  }
  return parts;
}

// "2, 4-7": rising numbers, three or more in a row as a range.
std::string ranges(std::vector<std::size_t> numbers) {
  std::sort(numbers.begin(), numbers.end());
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t last = i;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (last < i + 2) last = i;
    texts.push_back(last == i ? fmt::format("{}", numbers[i]) : fmt::format("{}-{}", numbers[i], numbers[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

// Numbers of the rows of the table, and how many more there are.
std::string inseparable_rows(const Candidate& candidate, const std::vector<Candidate>& all) {
  const std::set<std::string> others(candidate.inseparable_from.begin(), candidate.inseparable_from.end());
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (others.contains(label_of(all[i].bound))) rows.push_back(i + 1);
  }
  const std::size_t more = others.size() - rows.size();
  const bool are_all = rows.size() > 2 && rows.size() + 1 == all.size();
  std::string text = are_all ? "all others" : ranges(std::move(rows));
  if (more > 0) text += fmt::format("{}{} more", text.empty() ? "" : " and ", more);
  return text.empty() ? "-" : text;
}

// Of the most probable set, and more likely missing than not.
bool is_marked(const Candidate& candidate) { return candidate.in_best_set && is_proposed(candidate); }

Table candidate_table(const Diagnosis& found, const std::vector<Candidate>& candidates, std::size_t rows) {
  const bool of_recordings = candidates.front().bound.effect->level == Level::recording;
  Table table({"candidate", "amplitude um", "probability", "2 ln B", "RMSE um",
               of_recordings ? "left-out recordings um" : "left-out cycles um", "confused with"});
  const int decimals = decimals_of(found.base.rmse_um);
  for (std::size_t i = 0; i < std::min(rows, candidates.size()); ++i) {
    const Candidate& candidate = candidates[i];
    const bool held_out = candidate.in_best_set;  // of the others nothing is
    table.add({fmt::format("{}{} {}", i + 1, is_marked(candidate) ? "*" : ".", one_line(label_of(candidate.bound))),
               with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, decimals),
               fmt::format("{:.2f}", candidate.p), fixed(candidate.likelihood_ratio, 0),
               fmt::format("{:.{}f}", candidate.rmse_after_um, decimals + 1),
               held_out ? fmt::format("{:.{}f} -> {:.{}f}", candidate.held_out_before_um, decimals,
                                      candidate.held_out_after_um, decimals)
                        : "-",
               inseparable_rows(candidate, candidates)});
  }
  return table;
}

// "* is the most probable set, with a remaining error of 0.719 um. "
std::string set_text(const Diagnosis& found) {
  std::size_t in_set = 0, marked = 0;
  for (const Candidate& one : found.candidates) {
    in_set += one.in_best_set ? 1 : 0;
    marked += is_marked(one) ? 1 : 0;
  }
  if (in_set == 0 || marked == 0) return "";
  if (marked < in_set) return "* marks the effects of the most probable set with a probability of 0.5 or more. ";
  if (in_set == 1) return "* marks the most probable set. ";
  return fmt::format("* marks the most probable set, with a remaining error of {:.{}f} um together. ",
                     found.rmse_after_um, decimals_of(found.base.rmse_um) + 1);
}

void print_candidates(const Diagnosis& found, std::size_t rows, bool details) {
  std::vector<Candidate> candidates = found.candidates;
  if (!details) std::erase_if(candidates, [](const Candidate& one) { return one.p < kLeastShown; });
  if (candidates.empty()) return;
  fmt::print("\n{}", candidate_table(found, candidates, rows).text(table_width()));
  if (!details) return;
  const bool of_recordings = candidates.front().bound.effect->level == Level::recording;
  const std::string_view left_out = of_recordings ? "recordings, or quarters of their sweeps," : "cycles";
  fmt::print("{}", wrapped(fmt::format(
                       "{}amplitude: largest less smallest value of what the effect adds. probability: that the effect "
                       "is missing. 2 ln B: 10 means that the readings are 150 times as likely with the effect. RMSE: "
                       "remaining error with this effect alone. left-out {}: error in {} that the fit did not use, "
                       "without and with the effect. confused with: rows that these data do not distinguish from it.",
                       set_text(found), of_recordings ? "recordings" : "cycles", left_out)));
}

std::string posterior_text(const Diagnosis& found) {
  std::vector<std::string> texts;
  std::vector<std::string> drivers;
  for (const Driver& driver : found.drivers) {
    if (drivers.size() < kDrivers) drivers.push_back(fmt::format("{} {:.2f}", driver.column, driver.p));
  }
  if (!drivers.empty()) texts.push_back(fmt::format("a column drives the missing part: {}", fmt::join(drivers, ", ")));
  for (const OwnValue& own : found.own) {
    texts.push_back(fmt::format("the {} of {} is not {:.4g} but {:.4g} ({:.4g} to {:.4g}): {:.2f}", own.parameter,
                                own.effect, own.held, own.fitted, own.interval.low, own.interval.high, own.p));
  }
  texts.push_back(fmt::format("nothing is missing: {:.2f}", found.p_nothing));
  texts.push_back(fmt::format("a slow drift{} has no known cause: {:.2f}",
                              found.discrepancy_um > 0.0 ? fmt::format(" of ±{:.2g} um", found.discrepancy_um) : "",
                              found.p_discrepancy));
  return fmt::format("Probabilities: {}.", fmt::join(texts, "; "));
}

std::string untestable_text(const Diagnosis& found) {
  const auto reasons = by_reason(found.detectability, [](Testability testability) {
    return testability != Testability::testable && testability != Testability::in_the_model &&
           testability != Testability::other_motion;
  });
  std::vector<std::string> texts;
  texts.reserve(reasons.size());
  for (const auto& [first, names] : reasons) {
    texts.push_back(fmt::format("{} ({})", fmt::join(names, ", "), text_of(reason_of(*first))));
  }
  return fmt::format("{}", fmt::join(texts, "; "));
}

// What changed in the machine from run to run.
void print_gains_by_run(const Diagnosis& found) {
  for (const GainByRun& one : found.gains_by_run) {
    std::vector<std::string> texts;
    for (std::size_t run = 0; run < one.gain.size(); ++run) {
      texts.push_back(fmt::format("{:.3g} ± {:.1g} in run {}", one.gain[run], one.sigma[run], run + 1));
    }
    fmt::print("\n{}", wrapped(fmt::format("The {} of {} differs from run to run: {} ({}). The machine or its set-up "
                                           "changed between them.",
                                           one.parameter, one.effect, fmt::join(texts, ", "), one.unit)));
  }
}

void print_verdict(const DiagnosisReport& diagnosis_report) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  const std::vector<std::string> parts = parts_of(found);
  fmt::print("\nVerdict: {}.\n", name_of(found.verdict));
  if (parts.size() > 1) {
    for (std::size_t k = 0; k < parts.size(); ++k) fmt::print("{}", wrapped(fmt::format("{}. {}.", k + 1, parts[k])));
  }
  const Paragraph next = next_test(diagnosis_report);
  if (!next.empty()) fmt::print("{}", wrapped("To decide: " + text_of(next)));
  if (!diagnosis_report.plan_command.empty()) fmt::print("{}\n", diagnosis_report.plan_command);
  const std::string predicted = predicted_text(diagnosis_report);
  if (!predicted.empty()) fmt::print("{}", wrapped(predicted));
  if (!diagnosis_report.train_command.empty()) fmt::print("{}\n", diagnosis_report.train_command);
}

void print_reasons(const Diagnosis& found, bool details) {
  const std::vector<std::string> reasons = texts_of(reasons_of(found));
  if (reasons.empty() || found.verdict == Verdict::nothing) return;
  fmt::print("\nWhy{}:\n", found.verdict == Verdict::untestable ? "" : " it is not named, or not all of it");
  const std::size_t shown = details ? reasons.size() : std::min(reasons.size(), kReasons);
  for (std::size_t k = 0; k < shown; ++k) fmt::print("{}", wrapped("- " + reasons[k]));
  if (shown < reasons.size()) fmt::print("- {} more\n", reasons.size() - shown);
}

}  // namespace

std::string_view details_of_diagnosis() {
  return "all candidates and probabilities, what the columns mean and what cannot be tested";
}

// The sentence tells what is set aside: saturated and stuck sensors, readings of the target far off, its jumps.
std::string unsaid_faults_text(const DiagnosisReport& diagnosis_report) {
  ResidualReport report = diagnosis_report.residual_report;
  const Diagnosis& found = diagnosis_report.diagnosis;
  std::erase_if(report.faults, [&](const ColumnFault& fault) {
    const bool is_stuck = fault.kind == FaultKind::stuck;
    return (is_stuck || fault.kind == FaultKind::clipped) &&
           std::any_of(found.saturated.begin(), found.saturated.end(),
                       [&](const Saturated& one) { return one.column == fault.column && one.is_stuck == is_stuck; });
  });
  return faults_text(report, found.level_jumps > 0 ? std::vector{FaultKind::jumps} : std::vector<FaultKind>{});
}

void print_text(const DiagnosisReport& diagnosis_report, const std::string& title, const TextLength& length) {
  const Diagnosis& found = diagnosis_report.diagnosis;
  const bool details = length.details, is_whole = details || length.targets == 1;
  if (!title.empty()) fmt::print("{}\n", title);
  fmt::print("{}{}\n\n", heading(diagnosis_report.residual_report.fit),
             is_whole ? "" : fmt::format(". Verdict: {}.", name_of(found.verdict)));
  if (!diagnosis_report.unsupported.empty()) fmt::print("{}", wrapped(unsupported_text(diagnosis_report)));
  const std::string faults = is_whole ? unsaid_faults_text(diagnosis_report) : "";
  fmt::print("{}{}", faults, faults.empty() ? "" : "\n");
  fmt::print("{}", wrapped(sentence_of(found)));
  if (!diagnosis_report.command.empty()) fmt::print("\n{}\n", diagnosis_report.command);
  if (!diagnosis_report.hint.empty()) fmt::print("\n{}", wrapped(diagnosis_report.hint));
  for (const StandIn& one : diagnosis_report.stand_ins)
    fmt::print("\n{}{}\n", wrapped(fmt::format("{} only stood in for {}. This replaces it:", one.effect, one.by)),
               one.command);
  if (is_whole) print_verdict(diagnosis_report);
  const std::size_t rows = details ? found.candidates.size() : is_whole ? kRows : kRowsOfSeveral;
  if (is_whole || length.targets <= kTargetsWithRows) print_candidates(found, rows, details);
  if (!is_whole) return;
  print_reasons(found, details);
  print_gains_by_run(found);
  if (details && found.verdict != Verdict::untestable) fmt::print("\n{}", wrapped(posterior_text(found)));
  fmt::print("\n{}", found.candidates.empty() ? "" : "The model as it is:\n");
  print_sentences(diagnosis_report.residual_report);
  const std::string untestable = untestable_text(found);
  if (details && !untestable.empty()) fmt::print("\n{}", wrapped("Not testable here: " + untestable + "."));
  const std::string not_searched = not_searched_text(found);
  if (!not_searched.empty()) fmt::print("\n{}", wrapped("Not searched: " + not_searched + "."));
  if (!details) fmt::print("\n{}", details_text(details_of_diagnosis()));
}

}  // namespace ballbar
