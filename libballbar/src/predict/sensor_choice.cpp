#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/predict/train.hpp"
#include "predict/forecasts.hpp"

namespace ballbar {
namespace {

constexpr double kSame = 0.02, kSimilar = 0.10;  // of an error

using Set = std::vector<std::size_t>;       // places of sensors, in the order of choice
using Asked = std::pair<std::size_t, Set>;  // what a set is worth at a place
using FoldErrors = std::vector<std::vector<ForecastError>>;

Set sorted(Set set) {
  std::sort(set.begin(), set.end());
  return set;
}

struct Difference {
  double um = 0.0, sigma_um = 0.0;
};

// Mean absolute error of a less that of b, of the same rows.
Difference difference(const FoldErrors& a, const FoldErrors& b) {
  std::vector<double> weights, differences;
  double all = 0.0, mean = 0.0;
  for (std::size_t f = 0; f < a.size(); ++f) {
    double weight = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a[f].size(); ++i) {
      weight += a[f][i].weight;
      sum += a[f][i].weight * (std::abs(a[f][i].error_um) - std::abs(b[f][i].error_um));
    }
    if (!(weight > 0.0)) continue;
    weights.push_back(weight);
    differences.push_back(sum / weight);
    all += weight;
    mean += sum;
  }
  mean /= all;
  const auto folds = static_cast<double>(weights.size());
  double square = 0.0;
  for (std::size_t f = 0; f < weights.size(); ++f) square += std::pow(weights[f] / all * (differences[f] - mean), 2);
  return {mean, folds > 1.0 ? std::sqrt(folds / (folds - 1.0) * square) : std::numeric_limits<double>::quiet_NaN()};
}

bool as_good(const Difference& larger_by, double error_um) {
  return larger_by.um <= kSame * error_um ||
         (larger_by.um <= larger_by.sigma_um && larger_by.um <= kSimilar * error_um);
}

// The rows of a series of runs, and what may be known of each set of sensors from them.
class Sensors {
 public:
  Sensors(const Design& design, const Series& first_run)
      : design_(design),
        folds_(forecast_folds(design, first_run)),
        leaves_runs_out_(design.runs >= kFewestRunsToLeaveOut),
        rows_(rows_between(0, design.row.size())) {
    for (const Column& column : first_run.columns) {
      const auto reads = [&](const Predictor& one) {
        return std::find(one.columns.begin(), one.columns.end(), column.name) != one.columns.end();
      };
      if (!std::any_of(design.predictors.each.begin(), design.predictors.each.end(), reads)) continue;
      (is_sensor(column) ? names_ : kept_).push_back(column.name);
    }
  }

  const std::vector<std::string>& names() const { return names_; }
  const std::vector<std::string>& kept() const { return kept_; }
  std::size_t folds() const { return folds_.size(); }

  std::vector<std::string> names_of(const Set& set) const {
    std::vector<std::string> names;
    for (const std::size_t sensor : set) names.push_back(names_[sensor]);
    return names;
  }

  Set all() const { return rows_between(0, names_.size()); }

  // For all rows, and for each fold's rows to predict from: how good every set is that was asked for.
  void prepare() {
    if (leaves_runs_out_) {
      settings_ = {setting_of(design_, rows_)};
      return;
    }
    settings_.resize(folds_.size() + 1);
    in_parallel(settings_.size(), [&](std::size_t p) { settings_[p] = setting_of(design_, rows_of_place(p)); });
  }

  // Of each place (all rows, then each fold) the best of its candidates: the larger the score, the better.
  std::vector<Set> best_of(const std::vector<std::vector<Set>>& candidates) {
    std::vector<Asked> unknown;
    for (std::size_t p = 0; p < candidates.size(); ++p) {
      for (const Set& set : candidates[p]) {
        if (scores_.try_emplace(asked(p, set)).second) unknown.push_back(asked(p, set));
      }
    }
    in_parallel(unknown.size(), [&](std::size_t i) { scores_.at(unknown[i]) = scored(unknown[i]); });
    std::vector<Set> best;
    for (std::size_t p = 0; p < candidates.size(); ++p) {
      best.push_back(*std::max_element(candidates[p].begin(), candidates[p].end(),
                                       [&](const Set& a, const Set& b) { return score(p, a) < score(p, b); }));
    }
    return best;
  }

  double score(std::size_t place, const Set& set) const {
    const std::vector<double>& of_set = scores_.at(asked(place, set));
    return leaves_runs_out_ ? of_set[place] : of_set.front();
  }

  // One set a place: each fold predicted by its own, dictionary, v and l chosen for it.
  FoldErrors errors_of(const std::vector<Set>& sets) const {
    FoldErrors errors(folds_.size());
    if (!leaves_runs_out_) {
      in_parallel(folds_.size(),
                  [&](std::size_t f) { errors[f] = forecast(of_set(sets[f + 1]), {}, folds_[f], 0.0, {}); });
      return errors;
    }
    const RidgeSetting setting = setting_of(of_set(sets.front()), rows_);
    std::map<Set, std::vector<std::size_t>> folds_of;
    for (std::size_t f = 0; f < folds_.size(); ++f) folds_of[sorted(sets[f + 1])].push_back(f);
    const std::vector<std::pair<Set, std::vector<std::size_t>>> each(folds_of.begin(), folds_of.end());
    in_parallel(each.size(), [&](std::size_t i) {
      const FoldErrors of_runs = runs_left_out(each[i].first, setting);
      for (const std::size_t f : each[i].second) errors[f] = of_runs[run_of(f)];
    });
    return errors;
  }

  // Of each set, all folds, at the dictionaries, v and l of the first.
  std::vector<FoldErrors> errors_at_first(const std::vector<Set>& sets) const {
    std::vector<RidgeSetting> settings(leaves_runs_out_ ? 1 : folds_.size());
    const Design first = of_set(sets.front());
    in_parallel(settings.size(),
                [&](std::size_t f) { settings[f] = setting_of(first, leaves_runs_out_ ? rows_ : folds_[f].from); });
    std::vector<FoldErrors> errors(sets.size());
    in_parallel(sets.size(), [&](std::size_t i) {
      if (leaves_runs_out_) {
        errors[i] = runs_left_out(sets[i], settings.front());
        return;
      }
      const Design design = of_set(sets[i]);
      for (std::size_t f = 0; f < folds_.size(); ++f) {
        const RidgeProblem problem = ridge_problem(design, folds_[f].from, kChoiceRows);
        errors[i].push_back(forecast(design, folds_[f], problem, ridge_fit(problem, settings[f])));
      }
    });
    return errors;
  }

 private:
  static RidgeSetting setting_of(const Design& design, const std::vector<std::size_t>& rows) {
    return chosen_setting(ridge_problem(design, rows, kChoiceRows), 0.0);
  }

  const std::vector<std::size_t>& rows_of_place(std::size_t place) const {
    return place == 0 ? rows_ : folds_[place - 1].from;
  }

  std::size_t run_of(std::size_t fold) const { return design_.run[folds_[fold].rows.front()]; }

  FoldErrors runs_left_out(const Set& set, const RidgeSetting& setting) const {
    const Design design = of_set(set);
    return left_out_errors(design, ridge_problem(design, rows_), setting);
  }

  // The design without what reads another sensor.
  Design of_set(const Set& set) const {
    const std::vector<std::string> names = names_of(set);
    const auto is_there = [&](const std::string& column) {
      return std::find(names.begin(), names.end(), column) != names.end() ||
             std::find(kept_.begin(), kept_.end(), column) != kept_.end();
    };
    Design design;
    std::vector<std::size_t> used;
    std::map<std::size_t, std::size_t> place;
    for (std::size_t k = 0; k < design_.predictors.each.size(); ++k) {
      const Predictor& predictor = design_.predictors.each[k];
      if (!std::all_of(predictor.columns.begin(), predictor.columns.end(), is_there)) continue;
      place[k] = used.size();
      used.push_back(k);
      design.predictors.each.push_back(predictor);
    }
    for (const PredictorFamily& family : design_.predictors.families) {
      PredictorFamily part{family.kind, {}};
      for (const PredictorSum& member : family.members) {
        const auto plus = place.find(member.plus);
        const auto minus = member.minus ? place.find(*member.minus) : plus;
        if (plus == place.end() || minus == place.end()) continue;
        part.members.push_back({plus->second, member.minus ? std::optional(minus->second) : std::nullopt});
      }
      if (!part.members.empty()) design.predictors.families.push_back(std::move(part));
    }
    design.values = design_.values(Eigen::all, used);
    design.target_um = design_.target_um;
    design.time_s = design_.time_s;
    design.run = design_.run;
    design.row = design_.row;
    design.runs = design_.runs;
    return design;
  }

  // Of runs left out one answer holds for every place.
  Asked asked(std::size_t place, const Set& set) const { return {leaves_runs_out_ ? 0 : place, sorted(set)}; }

  std::vector<double> scored(const Asked& of) const {
    const auto& [place, set] = of;
    const Design design = of_set(set);
    std::vector<double> scores;
    if (leaves_runs_out_) {
      const Eigen::MatrixXd squares =
          left_out_pairs_um2(ridge_problem(design, rows_, kChoiceRows), settings_.front(), design.runs);
      scores.push_back(-squares.diagonal().sum());
      for (std::size_t f = 0; f < folds_.size(); ++f) {
        const auto run = static_cast<Eigen::Index>(run_of(f));
        scores.push_back(squares(run, run) - squares.row(run).sum());
      }
    } else {
      const RidgeProblem problem = ridge_problem(design, rows_of_place(place), kChoiceRows);
      scores.push_back(log_likelihood_without(problem, settings_[place], {}));
    }
    for (double& one : scores) one = std::isfinite(one) ? one : -std::numeric_limits<double>::infinity();
    return scores;
  }

  const Design& design_;
  std::vector<ForecastFold> folds_;
  bool leaves_runs_out_;
  std::vector<std::size_t> rows_;
  std::vector<std::string> names_, kept_;
  std::vector<RidgeSetting> settings_;           // of all sensors: a place each, or one of all runs
  std::map<Asked, std::vector<double>> scores_;  // of runs left out a number for each place
};

std::vector<Set> with_one_more(const Set& set, std::size_t sensors) {
  std::vector<Set> larger;
  for (std::size_t sensor = 0; sensor < sensors; ++sensor) {
    if (std::find(set.begin(), set.end(), sensor) != set.end()) continue;
    larger.push_back(set);
    larger.back().push_back(sensor);
  }
  return larger;
}

Set without(Set set, std::size_t place) {
  set.erase(set.begin() + static_cast<std::ptrdiff_t>(place));
  return set;
}

// One sensor more for each place, and one exchange.
std::vector<Set> grown(const std::vector<Set>& sets, Sensors& sensors) {
  const auto best_with_one_more = [&](const std::vector<Set>& of) {
    std::vector<std::vector<Set>> candidates;
    for (const Set& set : of) candidates.push_back(with_one_more(set, sensors.names().size()));
    return sensors.best_of(candidates);
  };
  std::vector<Set> added = best_with_one_more(sets);
  if (added.front().size() < 2) return added;
  std::vector<std::vector<Set>> fewer(added.size());
  for (std::size_t p = 0; p < added.size(); ++p) {
    for (std::size_t i = 0; i + 1 < added[p].size(); ++i) fewer[p].push_back(without(added[p], i));
  }
  const std::vector<Set> exchanged = best_with_one_more(sensors.best_of(fewer));
  for (std::size_t p = 0; p < added.size(); ++p) {
    if (sensors.score(p, exchanged[p]) > sensors.score(p, added[p])) added[p] = exchanged[p];
  }
  return added;
}

// The sensors of the set with what each is worth in it.
std::vector<ChosenSensor> chosen_sensors(const std::vector<Set>& sets, const Sensors& sensors) {
  const Set& set = sets.front();
  const std::vector<Set> larger = with_one_more(set, sensors.names().size());
  std::vector<Set> tried{set};
  for (std::size_t i = 0; i < set.size(); ++i) tried.push_back(without(set, i));
  for (std::size_t i = 0; i < set.size(); ++i) {
    for (const Set& other : larger) {
      tried.push_back(without(set, i));
      tried.back().push_back(other.back());
    }
  }
  const std::vector<FoldErrors> errors = sensors.errors_at_first(tried);
  const double error_um = tested(errors.front()).forecasts.error_um;
  std::vector<ChosenSensor> chosen;
  std::size_t at = 1 + set.size();
  for (std::size_t i = 0; i < set.size(); ++i) {
    const Difference larger_by = difference(errors[1 + i], errors.front());
    ChosenSensor one{sensors.names()[set[i]], 0, larger_by.um, larger_by.sigma_um, !as_good(larger_by, error_um), {}};
    for (std::size_t p = 1; p < sets.size(); ++p) {
      if (std::find(sets[p].begin(), sets[p].end(), set[i]) != sets[p].end()) ++one.folds;
    }
    for (const Set& other : larger) {
      if (!as_good(difference(errors[at++], errors.front()), error_um) || !one.needed) continue;
      one.substitutes.push_back(sensors.names()[other.back()]);
    }
    chosen.push_back(std::move(one));
  }
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const auto& a, const auto& b) { return a.without_um > b.without_um; });
  return chosen;
}

}  // namespace

SensorChoice sensor_choice(std::span<const Series> runs, const std::string& target, std::size_t most,
                           const std::function<void(const std::string&)>& progress, const Catalogue& catalogue) {
  if (runs.empty()) throw Error("expected a record to train on, found none.");
  const auto say = [&](const std::string& what) {
    if (progress) progress(what);
  };
  say("evaluating the effects");
  const Design design = design_of(runs, target, catalogue);
  Sensors sensors(design, runs.front());
  const std::size_t there = sensors.names().size();
  if (there == 0) {
    throw Error("expected temperatures (_degC or _K) that move and have no gaps to choose sensors from, found none.");
  }
  if (most < 1 || most > there) {
    throw Error(
        fmt::format("expected a number of sensors from 1 to {}, the temperatures that move and have no gaps, "
                    "found {}.",
                    there, most));
  }
  if (sensors.folds() == 0) {
    throw Error(fmt::format("expected enough rows of {} to test forecasts by which sensors are chosen, found {}.",
                            target, design.row.size()));
  }
  say("choosing the dictionary of all sensors");
  sensors.prepare();
  SensorChoice choice{sensors.folds(), runs.size() == 1, there, {}, {}, 0, {}, sensors.kept(), std::nullopt};
  std::vector<FoldErrors> errors;
  const auto add = [&](const std::vector<Set>& sets) {
    errors.push_back(sensors.errors_of(sets));
    const TestedForecasts of = tested(errors.back());
    SensorSet one{sensors.names_of(sets.front()), of.forecasts, of.interval_scale, 0.0, 0.0};
    if (errors.size() > 1) {
      const Difference less = difference(errors[errors.size() - 2], errors.back());
      one.buys_um = less.um;
      one.sigma_buys_um = less.sigma_um;
    }
    return one;
  };
  std::vector<Set> sets(sensors.folds() + 1);
  choice.sets.push_back(add(sets));
  for (std::size_t size = 1; size <= most; ++size) {
    say(fmt::format("choosing sensor {} of {}", size, most));
    sets = grown(sets, sensors);
    say(fmt::format("testing {} of {} sensors", size, most));
    choice.sets.push_back(add(sets));
  }
  say(fmt::format("testing all {} sensors", there));
  choice.all = add(std::vector<Set>(sets.size(), sensors.all()));
  if (runs.size() >= kFewestRunsToLeaveOut) choice.left_out = left_out_of(errors[most]);
  const auto error_of = [&](std::size_t k) {
    return k > most ? choice.all.forecasts.error_um : choice.sets[k].forecasts.error_um;
  };
  std::size_t best = 0;
  for (std::size_t k = 1; k < errors.size(); ++k) best = error_of(k) < error_of(best) ? k : best;
  while (choice.enough < std::min(best, most) &&
         !as_good(difference(errors[choice.enough], errors[best]), error_of(best)))
    ++choice.enough;
  say("leaving sensors out, and others in their place");
  choice.chosen = chosen_sensors(sets, sensors);
  return choice;
}

}  // namespace ballbar
