// Runs of 24 h that are looked at while they grow, by data of the study's own: what is decided falsely, rightly, and
// when.
//
//   study_follow [N [HOURS [CELL...]]] [--first SEED] [--every-look] [--verbose] [--looks]
//
// N seeds a cell (24), runs of HOURS (24). Fails where more than 2 % of the runs in which nothing is hidden come to a
// decision, or more than 2 % of all to a wrong one, beyond what chance makes of so few. A decision needs three looks in
// a row, so that where nothing is hidden every third look is made, and those beside it where it could be one of three:
// the same decisions as by all looks, which --every-look makes. --verbose prints a line a run, --looks a line a look.
// Prints, of runs:
//   decided    anything;   right, wrong: what is hidden; anything else
//   at h       median time of what is decided
//   B          at some look the readings were so much more likely with something
//   named      at some look the verdict was `named`: what is said without the rule (of the looks made)
//   stop 24    said that it will not be decided, the planned end given; median time;   then: decided after all
//   no end     the same without a planned end
#include "ballbar/diagnosis/follow/follow.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "diagnosis/thresholds.hpp"
#include "follow_cells.hpp"

namespace verdicts = ballbar::verdicts;

namespace {

struct Options {
  std::uint64_t count = 24, first = 1;
  double hours = 24.0;
  std::vector<std::string> cells;
  bool makes_all_looks = false, is_verbose = false, shows_looks = false;
};

struct Counts {
  std::size_t runs = 0, decided = 0, right = 0, wrong = 0, likely = 0, named = 0;
  std::size_t stop_planned = 0, then_planned = 0, stop_twice = 0, then_twice = 0;
  std::vector<double> decided_h, stop_h;
};

// One run, and its looks as far as they were made.
class Watched {
 public:
  explicit Watched(const verdicts::Made& made) : made_(made) {
    rows_ = made.data.time_s.size();
    while (looks_ < ballbar::kMostLooks && ballbar::values_of_look(looks_) <= rows_) ++looks_;
  }

  std::size_t looks() const { return looks_; }
  std::map<std::string, std::string> logged_twice() const { return ballbar::columns_logged_twice(made_.data); }

  // The state of one look alone.
  const ballbar::Look& look(std::size_t k) {
    if (const auto at = made_looks_.find(k); at != made_looks_.end()) return at->second;
    return made_looks_[k] = with_look({}, k).looks.back();
  }

  ballbar::FollowState with_look(ballbar::FollowState state, std::size_t k) {
    const std::size_t values = ballbar::values_of_look(k);
    const double hours = made_.data.time_s[values - 1] / 3600.0;
    if (!faults_.contains(k) && !diagnoses_.contains(k)) {
      const ballbar::Series data = ballbar::first_rows(made_.data, made_.model.targets.front(), values);
      try {
        diagnoses_[k] = ballbar::diagnose(made_.model, data);
      } catch (const std::exception& error) {
        faults_[k] = error.what();
      }
    }
    if (const auto fault = faults_.find(k); fault != faults_.end()) {
      return ballbar::followed(std::move(state), fault->second, values, hours);
    }
    return ballbar::followed(std::move(state), diagnoses_[k], values, hours);
  }

  const std::map<std::size_t, ballbar::Look>& made_looks() const { return made_looks_; }

 private:
  const verdicts::Made& made_;
  std::size_t rows_ = 0, looks_ = 0;
  std::map<std::size_t, ballbar::Diagnosis> diagnoses_;
  std::map<std::size_t, std::string> faults_;
  std::map<std::size_t, ballbar::Look> made_looks_;
};

// Over the looks from `first` on, until something is decided; `stopped`: where that it will not was said first.
ballbar::FollowState watched(Watched& run, std::optional<double> planned_h, std::size_t first, std::size_t last,
                             std::optional<double>& stopped_h) {
  ballbar::FollowState state;
  state.planned_hours = planned_h;
  state.logged_twice = run.logged_twice();
  for (std::size_t k = first; k < std::min(last, run.looks()); ++k) {
    state = run.with_look(std::move(state), k);
    if (state.outcome == ballbar::Outcome::decided) break;
    if (state.outcome == ballbar::Outcome::undecidable && !stopped_h) stopped_h = state.looks.back().hours;
  }
  return state;
}

// Every third look, all about one that could be one of three.
ballbar::FollowState decided_by_thirds(Watched& run) {
  constexpr std::size_t kThird = ballbar::kLooksToDecide;
  std::optional<double> stopped_h;
  for (std::size_t k = kThird - 1; k < run.looks(); k += kThird) {
    if (run.look(k).sure.empty()) continue;
    ballbar::FollowState state = watched(run, std::nullopt, k + 1 - kThird, k + kThird, stopped_h);
    if (state.outcome == ballbar::Outcome::decided) return state;
  }
  return {};
}

bool is_truth(const verdicts::Made& made, const std::string& label) {
  return std::any_of(made.truths.begin(), made.truths.end(), [&](const verdicts::Truth& truth) {
    std::vector<std::string> columns = truth.columns;
    std::reverse(columns.begin(), columns.end());
    return label == fmt::format("{}({})", truth.effect, fmt::join(truth.columns, ", ")) ||
           (truth.effect == "gradient_bending" &&
            label == fmt::format("{}({})", truth.effect, fmt::join(columns, ", ")));
  });
}

void count(const verdicts::FollowCell& cell, std::uint64_t seed, const Options& options, Counts& counts) {
  const verdicts::Made made = cell.make(seed);
  Watched run(made);
  ballbar::FollowState state;
  std::optional<double> stopped_h, stopped_twice_h;
  if (cell.is_nothing && !options.makes_all_looks) {
    state = decided_by_thirds(run);
    for (const auto& [k, look] : run.made_looks()) state.looks.push_back(look);
  } else {
    state = watched(run, options.hours, 0, run.looks(), stopped_h);
    watched(run, std::nullopt, 0, state.looks.size(), stopped_twice_h);
  }
  const bool is_decided = state.outcome == ballbar::Outcome::decided;
  const bool is_right = is_decided && std::all_of(state.decided.begin(), state.decided.end(),
                                                  [&](const std::string& label) { return is_truth(made, label); });
  ++counts.runs;
  counts.decided += is_decided;
  counts.right += is_right;
  counts.wrong += is_decided && !is_right;
  counts.likely += std::any_of(state.looks.begin(), state.looks.end(), [](const ballbar::Look& look) {
    return look.log_bayes_factor >= std::log(static_cast<double>(ballbar::kMostLooks) / ballbar::kFalselyDecided);
  });
  counts.named += std::any_of(state.looks.begin(), state.looks.end(),
                              [](const ballbar::Look& look) { return look.verdict == ballbar::Verdict::named; });
  counts.stop_planned += stopped_h.has_value();
  counts.then_planned += stopped_h.has_value() && is_decided;
  counts.stop_twice += stopped_twice_h.has_value();
  counts.then_twice += stopped_twice_h.has_value() && is_decided;
  if (is_decided) counts.decided_h.push_back(state.looks[state.decided_at].hours);
  if (stopped_h) counts.stop_h.push_back(*stopped_h);
  if (!options.is_verbose) return;
  double most = 0.0;
  for (const ballbar::Look& look : state.looks) {
    if (!options.shows_looks) break;
    fmt::print("    {:>6} {:5.2f} h ln B {:6.1f}", look.values, look.hours, look.log_bayes_factor);
    for (std::size_t k = 0; k < std::min<std::size_t>(4, look.hypotheses.size()); ++k) {
      fmt::print("  {:.3f} {}", look.hypotheses[k].p, look.hypotheses[k].label);
    }
    fmt::print("  {} {} {}\n", ballbar::name_of(look.verdict), look.why_stop, look.fault);
  }
  for (const ballbar::Look& look : state.looks) most = std::max(most, look.log_bayes_factor);
  fmt::print("  {:>4} {} | {} | ln B at most {:.1f} | stop {:.1f} {:.1f} h | {}\n", seed, made.what,
             is_decided ? (is_right ? "right" : "WRONG") : "-", most, stopped_h.value_or(NAN),
             stopped_twice_h.value_or(NAN), ballbar::outcome_text(state));
}

std::string median(std::vector<double> values) {
  if (values.empty()) return "-";
  std::sort(values.begin(), values.end());
  return fmt::format("{:.1f}", values[values.size() / 2]);
}

std::string row_of(const std::string& name, const Counts& counts) {
  return fmt::format("{:<22} {:>5} {:>8} {:>6} {:>6} {:>6} {:>4} {:>6} {:>8} {:>5} {:>5} {:>8} {:>5}\n", name,
                     counts.runs, counts.decided, counts.right, counts.wrong, median(counts.decided_h), counts.likely,
                     counts.named, counts.stop_planned, median(counts.stop_h), counts.then_planned, counts.stop_twice,
                     counts.then_twice);
}

Options options_of(const std::vector<std::string>& words) {
  Options options;
  std::vector<std::string> plain;
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (words[k] == "--every-look") {
      options.makes_all_looks = true;
    } else if (words[k] == "--looks") {
      options.is_verbose = options.shows_looks = true;
    } else if (words[k] == "--verbose") {
      options.is_verbose = true;
    } else if (words[k] == "--first" && k + 1 < words.size()) {
      options.first = std::stoull(words[++k]);
    } else {
      plain.push_back(words[k]);
    }
  }
  if (!plain.empty()) options.count = std::stoull(plain[0]);
  if (plain.size() > 1) options.hours = std::stod(plain[1]);
  if (plain.size() > 2) options.cells.assign(plain.begin() + 2, plain.end());
  return options;
}

// Runs that come to a decision in 99 of 100 studies, where 2 % of runs do (Poisson).
std::size_t most_false(std::size_t runs) {
  const double mean = ballbar::kFalselyDecided * static_cast<double>(runs);
  double sum = 0.0, term = std::exp(-mean);
  for (std::size_t k = 0;; ++k) {
    sum += term;
    if (sum >= 0.99) return k;
    term *= mean / static_cast<double>(k + 1);
  }
}

bool study(const Options& options) {
  fmt::print("{:<22} {:>5} {:>8} {:>6} {:>6} {:>6} {:>4} {:>6} {:>8} {:>5} {:>5} {:>8} {:>5}\n", "cell", "runs",
             "decided", "right", "wrong", "at h", "B", "named", "stop 24", "at h", "then", "no end", "then");
  std::size_t runs = 0, falsely = 0, all_runs = 0, wrong = 0;
  for (const verdicts::FollowCell& cell : verdicts::follow_cells(options.hours)) {
    const bool wanted = options.cells.empty() ||
                        std::find(options.cells.begin(), options.cells.end(), cell.name) != options.cells.end();
    if (!wanted) continue;
    Counts counts;
    for (std::uint64_t seed = options.first; seed < options.first + options.count; ++seed) {
      count(cell, seed, options, counts);
      std::fflush(stdout);
    }
    fmt::print("{}", row_of(cell.name, counts));
    std::fflush(stdout);
    all_runs += counts.runs;
    wrong += counts.wrong;
    if (!cell.is_nothing) continue;
    runs += counts.runs;
    falsely += counts.decided;
  }
  fmt::print("nothing hidden: {} of {} runs decided\n", falsely, runs);
  return falsely <= most_false(runs) && wrong <= most_false(all_runs);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return study(options_of({argv + 1, argv + argc})) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "study_follow: {}\n", error.what());
    return 2;
  }
}
