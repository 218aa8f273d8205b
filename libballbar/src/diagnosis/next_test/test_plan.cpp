#include "ballbar/diagnosis/next_test/test_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/error.hpp"
#include "ballbar/model/run_terms.hpp"
#include "ballbar/number_text.hpp"
#include "ballbar/numerics/parallel.hpp"
#include "ballbar/series/runs.hpp"
#include "diagnosis/next_test/columns_alike.hpp"
#include "diagnosis/next_test/menu.hpp"
#include "diagnosis/next_test/planned_inputs.hpp"
#include "diagnosis/next_test/truths.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/random_streams.hpp"
#include "series/resolution.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kScreened = 8;  // truths for a first look at a test
constexpr std::size_t kTruths = 24;   // for what is promised
constexpr std::size_t kKindsKept = 2;
constexpr std::size_t kSurrogatesSimulated = 50;
constexpr const char* kAddedSensor = "T_added_degC";
constexpr double kInQuestion = 0.05;         // P of an effect
constexpr double kTheSame = 0.9999;          // |cosine| of what two effects add beside the model
constexpr double kWorthASensor = 0.1;        // P(right) that it adds
constexpr std::size_t kSlowStride = 6;       // of the covariances with a slow curve one in so many
constexpr std::size_t kRowsSimulated = 500;  // of the target that each diagnosis weighs

Model without_unknown(const Model& model, const Series& data) {
  if (model.level == Level::series) return without_run_terms(model);
  throw Error(
      fmt::format("expected a drift series to plan a run for, found recordings of {} readings.", data.time_s.size()));
}

// The rows of a run behind those of the data, columns by their names.
Series with_run(const Series& data, const Series& run) {
  Series all = data;
  const double begin_s = data.time_s.empty() ? 0.0 : data.time_s.front();
  if (runs_of(data.time_s).size() < 2) {
    for (double& time_s : all.time_s) time_s -= begin_s;
    all.runs = {{"data", RunStart::rest}};
  }
  all.time_s.insert(all.time_s.end(), run.time_s.begin(), run.time_s.end());
  for (Column& column : all.columns) {
    const std::vector<double>& values = find_column(run, column.name)->values;
    column.values.insert(column.values.end(), values.begin(), values.end());
  }
  all.runs.push_back({"test", RunStart::rest});
  return all;
}

struct Told {
  bool right = false, part = false, wrong = false;
};

// What needs nothing but time is never named: a truth is told where all the rest of it is.
// Of nothing that nothing is said, of a value that the model holds that it is told.
Told told_of(const Truths& truths, const Truth& truth, const Diagnosis& found, const std::vector<BoundEffect>& known) {
  const auto is_in = [](const std::vector<BoundEffect>& all, const BoundEffect& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
  };
  const std::vector<BoundEffect> effects = truths.effects_of(truth);
  Told told;
  bool more = false;
  for (const BoundEffect& named : found.named) {
    told.wrong = told.wrong || !is_in(effects, named);
    more = more || !is_in(known, named);
  }
  const bool own = std::any_of(found.own.begin(), found.own.end(), [](const OwnValue& one) { return one.p >= kNamed; });
  const bool all = std::all_of(effects.begin(), effects.end(), [&](const BoundEffect& one) {
    return one.effect->time_only || is_in(found.named, one);
  });
  const bool is_said =
      truths.is_nothing(truth) ? found.verdict == Verdict::nothing : own == truths.has_other_value(truth);
  told.right = !told.wrong && all && is_said;
  told.part = !told.wrong && !truths.is_nothing(truth) && (told.right || more);
  return told;
}

class Design {
 public:
  Design(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options)
      : model_(without_unknown(model, data)), options_(options), data_(data), target_(model.targets.at(target)) {
    target_index_ = target;
    ProblemOptions how;
    how.catalogue = options.search.catalogue;
    how.signatures.without = options.search.without;
    tell("weighing the data at hand");
    weighed_ = weighed(with_run_terms(model_, data_), data_, target, how);
    if (weighed_.largest == 0 || weighed_.is_still) return;
    truths_.emplace(weighed_);
    planned_ = std::make_unique<PlannedInputs>(data_, target_);
    resolution_um_ = resolution_of(find_column(data_, target_)->values);
    covariances_ = simulated_covariances();
  }

  // What the data at hand name already.
  void know(const std::vector<BoundEffect>& named) { named_now_ = named; }
  bool can_draw() const { return truths_.has_value(); }
  const Weighed& posterior() const { return weighed_; }
  const Truths& truths() const { return *truths_; }
  const PlannedInputs& planned() const { return *planned_; }

  std::vector<Truth> drawn(std::size_t count, std::uint64_t stage) const {
    std::mt19937_64 random = simulation::stream_of(options_.search.seed, simulation::Stream::signal, 100 + stage);
    return truths_->drawn(count, random);
  }

  // A whole diagnosis of each truth.
  ExpectedTest expected(const MenuItem& item, const std::vector<Truth>& truths) const {
    std::vector<Told> outcomes(truths.size());
    in_parallel(truths.size(), [&](std::size_t k) {
      std::mt19937_64 random = simulation::stream_of(options_.search.seed, simulation::Stream::signal, 1000 + k);
      outcomes[k] = told_by(item.schedule, truths[k], random);
    });
    ExpectedTest result{item.kind, item.doing, item.hours, item.schedule, truths.size()};
    const auto n = static_cast<double>(truths.size());
    for (const Told& one : outcomes) {
      result.p_right += one.right ? 1.0 / n : 0.0;
      result.p_part += one.part ? 1.0 / n : 0.0;
      result.p_wrong += one.wrong ? 1.0 / n : 0.0;
    }
    // Of Laplace's estimate, so that 24 of 24 is no certainty.
    const double p = (result.p_right * n + 1.0) / (n + 2.0);
    result.p_right_sigma = std::sqrt(p * (1.0 - p) / (n + 3.0));
    return result;
  }

  // P(right) of the run alone with a thermometer where an effect's heat goes: it shows that heat, whether it moves
  // anything or not. To name an effect of its column is then to name that effect.
  double p_right_with_sensor(const Schedule& schedule, std::size_t set, const std::vector<Truth>& truths) const {
    const std::vector<BoundEffect> place = truths_->effects_of({set, false});
    static_cast<void>(truths_->sigma_um({set, false}));  // fitted before the threads ask for it
    std::vector<char> right(truths.size(), 0);
    in_parallel(truths.size(), [&](std::size_t k) {
      std::mt19937_64 random = simulation::stream_of(options_.search.seed, simulation::Stream::signal, 1000 + k);
      Series run = simulated(schedule, truths[k], random);
      run.columns.push_back(
          {kAddedSensor, Role::structure, thermometer(truths_->member_um({set, false}, 0, run), random)});
      try {
        const Diagnosis found = diagnosis_at(model_, run, target_index_, simulated_options(), covariances_);
        std::vector<BoundEffect> named;
        for (const BoundEffect& one : found.named)
          named.push_back(one.columns.size() == 1 && one.columns.front() == kAddedSensor ? place.front() : one);
        Diagnosis as_named = found;
        as_named.named = std::move(named);
        right[k] = told_of(*truths_, truths[k], as_named, {}).right ? 1 : 0;
      } catch (const Error&) {
        right[k] = 0;
      }
    });
    return static_cast<double>(std::count(right.begin(), right.end(), 1)) / static_cast<double>(truths.size());
  }

  Series simulated(const Schedule& schedule, const Truth& truth, std::mt19937_64& random) const {
    Series run = planned_->under(schedule, random);
    run.columns.push_back({target_, Role::measured, truths_->readings_um(truth, run, resolution_um_, random)});
    return run;
  }

  void tell(const std::string& step) const {
    if (options_.search.progress) options_.search.progress(step);
  }

 private:
  // Those that the data make likely, and a few with a slow curve, so that a simulated run may find one.
  std::vector<Covariance> simulated_covariances() const {
    std::vector<Covariance> chosen;
    std::size_t slow = 0;
    for (const Covariance& one : weighed_.problem->covariances) {
      const bool is_likely =
          std::any_of(weighed_.posterior.points.begin(), weighed_.posterior.points.end(), [&](const Point& point) {
            const Covariance& there = point.covariance;
            return there.white == one.white && there.time_s == one.time_s && there.slow == one.slow &&
                   there.slow_time_s == one.slow_time_s;
          });
      if (is_likely || (one.slow > 0.0 && slow++ % kSlowStride == 0)) chosen.push_back(one);
    }
    // Those that are left share the whole, without and with a slow curve.
    double without = 0.0, with = 0.0;
    for (const Covariance& one : chosen) (one.slow > 0.0 ? with : without) += 1.0;
    for (Covariance& one : chosen) {
      one.log_prior = std::log(one.slow > 0.0 ? kPriorOfDiscrepancy / with : (1.0 - kPriorOfDiscrepancy) / without);
    }
    return chosen;
  }

  DiagnosisOptions simulated_options() const {
    DiagnosisOptions how;
    how.search = options_.search;
    how.search.progress = {};
    how.surrogates = kSurrogatesSimulated;
    how.most_rows = kRowsSimulated;
    return how;
  }

  // 5 K from its least to its largest, read to 0.1 K.
  static std::vector<double> thermometer(const Eigen::VectorXd& heat, std::mt19937_64& random) {
    const double low = heat.minCoeff(), range = std::max(1e-12, heat.maxCoeff() - low);
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(heat.size()));
    for (const double one : heat) {
      const double kelvin = 5.0 * (one - low) / range + 0.03 * simulation::normal(random);
      values.push_back(0.1 * std::round(10.0 * (20.0 + kelvin)));
    }
    return values;
  }

  Told told_by(const Schedule& schedule, const Truth& truth, std::mt19937_64& random) const {
    const Series all = with_run(data_, simulated(schedule, truth, random));
    const DiagnosisOptions how = simulated_options();
    try {
      const Diagnosis found = diagnosis_at(with_run_terms(model_, all), all, target_index_, how, covariances_);
      return told_of(*truths_, truth, found, named_now_);
    } catch (const Error&) {
      return {};  // a run that cannot be diagnosed decides nothing
    }
  }

  Model model_;
  const TestPlanOptions& options_;
  const Series& data_;
  std::string target_;
  std::size_t target_index_ = 0;
  Weighed weighed_;
  std::optional<Truths> truths_;
  std::unique_ptr<PlannedInputs> planned_;
  double resolution_um_ = 0.0;
  std::vector<Covariance> covariances_;
  std::vector<BoundEffect> named_now_;
};

bool is_better(const ExpectedTest& a, const ExpectedTest& b) {
  if (a.p_right != b.p_right) return a.p_right > b.p_right;
  if (a.p_part != b.p_part) return a.p_part > b.p_part;
  if (a.p_wrong != b.p_wrong) return a.p_wrong < b.p_wrong;
  return a.hours < b.hours;
}

// The shortest that is sure enough, else the surest.
std::size_t chosen(const std::vector<ExpectedTest>& tests) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < tests.size(); ++k) {
    const bool sure = tests[k].p_right >= kSureEnough, best_is_sure = tests[best].p_right >= kSureEnough;
    const bool shorter = tests[k].hours < tests[best].hours;
    if (sure && best_is_sure ? shorter : is_better(tests[k], tests[best])) best = k;
  }
  return best;
}

std::vector<ExpectedTest> tests_of(const Design& design, const std::vector<MenuItem>& menu) {
  std::map<std::string, std::vector<const MenuItem*>> kinds;  // each from short to long
  std::vector<std::string> order;
  for (const MenuItem& item : menu) {
    if (kinds[item.kind].empty()) order.push_back(item.kind);
    kinds[item.kind].push_back(&item);
  }
  const std::vector<Truth> few = design.drawn(kScreened, 0);
  std::vector<ExpectedTest> longest, all;
  for (const std::string& kind : order) {
    design.tell(fmt::format("simulating {:g} h of {}", kinds[kind].back()->hours, kind));
    longest.push_back(design.expected(*kinds[kind].back(), few));
  }
  std::stable_sort(longest.begin(), longest.end(), is_better);
  for (std::size_t k = 0; k < longest.size(); ++k) {
    // Where hours are enough, fewer may be: as long as they are.
    const std::vector<const MenuItem*>& items = kinds[longest[k].kind];
    bool enough = k < kKindsKept && longest[k].p_right >= kSureEnough;
    all.push_back(std::move(longest[k]));
    for (std::size_t i = items.size() - 1; i-- > 0 && enough;) {
      design.tell(fmt::format("simulating {:g} h of {}", items[i]->hours, items[i]->kind));
      all.push_back(design.expected(*items[i], few));
      enough = all.back().p_right >= kSureEnough;
    }
  }
  // What is promised comes from other truths than the choice; where it falls short the next is looked at as well.
  const std::vector<Truth> fresh = design.drawn(kTruths, 1);
  std::set<std::size_t> promised;
  for (int round = 0; round < 2; ++round) {
    const std::size_t best = chosen(all);
    if (!(all[best].p_part > 0.0) || !promised.insert(best).second) break;
    design.tell(fmt::format("simulating {:g} h of {} with {} truths", all[best].hours, all[best].kind, kTruths));
    const auto item = std::find_if(menu.begin(), menu.end(), [&](const MenuItem& one) {
      return one.kind == all[best].kind && one.hours == all[best].hours;
    });
    all[best] = design.expected(*item, fresh);
  }
  std::size_t best = chosen(all);
  if (!promised.empty() && promised.count(best) == 0)
    best = *std::max_element(promised.begin(), promised.end(),
                             [&](std::size_t a, std::size_t b) { return is_better(all[b], all[a]); });
  std::swap(all[0], all[best]);
  std::stable_sort(all.begin() + 1, all.end(), is_better);
  return all;
}

void add_curves(const Design& design, TestPlan& plan, std::uint64_t seed) {
  const Posterior& posterior = design.posterior().posterior;
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 7);
  const Series run = design.planned().under(plan.tests.front().schedule, random);
  plan.time_s = run.time_s;
  for (std::size_t s = 0; s < posterior.sets.size() && plan.curves.size() < kCurvesShown; ++s) {
    const EffectSet& set = posterior.sets[s];
    const double p = posterior.p(set);
    if (p < 0.01) continue;
    const Truth truth{s, false};
    const std::vector<BoundEffect> effects = design.truths().effects_of(truth);
    std::vector<std::string> labels;
    labels.reserve(effects.size());
    for (const BoundEffect& one : effects) labels.push_back(label_of(one));
    const Eigen::VectorXd drift = design.truths().drift_um(truth, run);
    plan.curves.push_back({labels.empty() ? "nothing of the catalogue" : fmt::format("{}", fmt::join(labels, " + ")),
                           p,
                           {drift.begin(), drift.end()}});
    for (double& um : plan.curves.back().um) um -= drift[0];
    plan.sigma_um = std::max(plan.sigma_um, design.truths().sigma_um(truth));
  }
}

// Effects in question that add the same in any test, as far as the model beside them is free: a difference of two
// temperatures and one of them, where the model has the other.
void add_alike_beside_model(const Design& design, const Diagnosis& now, const Schedule& schedule, std::uint64_t seed,
                            TestPlan& plan) {
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 8);
  const Series run = design.planned().under(schedule, random);
  struct Curve {
    BoundEffect effect;
    Eigen::VectorXd um;
    Eigen::MatrixXd basis;  // of the model
  };
  std::vector<Curve> curves;
  const Posterior& posterior = design.posterior().posterior;
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    const std::vector<BoundEffect> effects = design.truths().effects_of({s, false});
    if (effects.size() != 1 || posterior.sets[s].own != 0 || effects.front().effect->time_only) continue;
    const auto known = std::find_if(now.effects.begin(), now.effects.end(), [&](const EffectProbability& one) {
      return one.bound == effects.front() && one.p >= kInQuestion;
    });
    if (known == now.effects.end()) continue;
    const Eigen::MatrixXd slopes = design.truths().model_slopes({s, false}, run);
    curves.push_back({effects.front(), design.truths().member_um({s, false}, 0, run), orthonormal(slopes)});
  }
  for (std::size_t a = 0; a < curves.size(); ++a) {
    std::vector<BoundEffect> group{curves[a].effect};
    const Eigen::VectorXd own = freed(curves[a].um, curves[a].basis);
    for (std::size_t b = 0; b < curves.size(); ++b) {
      if (a == b) continue;
      const Eigen::VectorXd other = freed(curves[b].um, curves[a].basis);
      const double both = own.norm() * other.norm();
      if (both > 0.0 && std::abs(own.dot(other)) > kTheSame * both) group.push_back(curves[b].effect);
    }
    const bool is_new = std::none_of(plan.inseparable.begin(), plan.inseparable.end(), [&](const auto& one) {
      return std::find(one.begin(), one.end(), curves[a].effect) != one.end();
    });
    if (group.size() > 1 && is_new) plan.inseparable.push_back(std::move(group));
  }
}

// Reads what heats, and no temperature: the way of its heat is what a thermometer would show.
bool is_unseen_heat(const BoundEffect& bound) {
  if (bound.columns.empty() || bound.effect->time_only) return false;
  return std::all_of(bound.columns.begin(), bound.columns.end(), [](const std::string& column) {
    const std::string_view unit = unit_of(column);
    return unit == "rpm" || unit == "W" || unit == "A" || unit == "percent" || unit == "Nm";
  });
}

void add_sensor(const Design& design, TestPlan& plan) {
  const ExpectedTest& best = plan.tests.front();
  if (best.p_right >= kSureEnough) return;
  const Posterior& posterior = design.posterior().posterior;
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    if (posterior.p(posterior.sets[s]) < 0.05) return;
    const std::vector<BoundEffect> effects = design.truths().effects_of({s, false});
    if (effects.size() != 1 || !is_unseen_heat(effects.front())) continue;
    design.tell("simulating a thermometer more");
    const double p = design.p_right_with_sensor(best.schedule, s, design.drawn(kTruths, 1));
    if (p < best.p_right + kWorthASensor) return;
    plan.sensors.push_back({fmt::format("where {} heats", label_of(effects.front())), p});
    return;  // the most probable one
  }
}

std::string percent(double p) { return fmt::format("{:.0f} %", 100.0 * p); }

std::string inseparable_text(const std::vector<std::vector<BoundEffect>>& groups) {
  std::string text;
  for (const std::vector<BoundEffect>& group : groups) {
    std::vector<std::string> labels;
    labels.reserve(group.size());
    for (const BoundEffect& one : group) labels.push_back(label_of(one));
    const bool is_twin = group[0].effect == group[1].effect && group[0].columns.size() == 1;
    text += fmt::format("{}No test can tell {} apart: {}.", text.empty() ? "" : " ", fmt::join(labels, " and "),
                        is_twin ? "their columns read the same" : "beside this model they add the same");
  }
  return text;
}

std::string sentence_of(const TestPlan& plan, const TestPlanOptions& options) {
  const std::string apart = inseparable_text(plan.inseparable);
  const std::string behind = apart.empty() ? "" : " " + apart;
  if (plan.is_decided) return "The data at hand decide: no further test is needed." + behind;
  const bool is_nothing = plan.verdict == Verdict::nothing;
  if (is_nothing && plan.p_nothing >= kSureOfNothing)
    return "By the data at hand nothing is missing: there is nothing to decide." + behind;
  if (plan.tests.empty()) {
    if (is_nothing) {
      return fmt::format(
                 "Nothing is found, P of nothing {:.2f}; no test of up to {:g} h on the menu would find what may be "
                 "there.",
                 plan.p_nothing, options.most_hours) +
             behind;
    }
    if (!apart.empty()) return apart + " No test is proposed.";
    return fmt::format("No test of up to {:g} h on the menu would decide; none is proposed.", options.most_hours);
  }
  const ExpectedTest& best = plan.tests.front();
  std::string text = is_nothing ? fmt::format("Nothing is found yet, P of nothing {:.2f}. ", plan.p_nothing) : "";
  text += fmt::format(
      "Run {:g} h from cold: {}. It would name all that is missing in {} of cases (± {:.0f}, {} "
      "simulated)",
      best.hours, best.doing, percent(best.p_right), 100.0 * best.p_right_sigma, best.truths);
  if (best.p_part > best.p_right) text += fmt::format(", at least some of it in {}", percent(best.p_part));
  text += fmt::format(", and something wrong in {}.", percent(best.p_wrong));
  if (best.p_right < kSureEnough) {
    text += fmt::format(" No test of up to {:g} h reaches {}.", options.most_hours, percent(kSureEnough));
  }
  for (const SensorToAdd& sensor : plan.sensors) {
    text += fmt::format(" A temperature sensor {} would raise it to {} in the same run.", sensor.place,
                        percent(sensor.p_right));
  }
  return text + behind;
}

}  // namespace

TestPlan test_plan(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options) {
  TestPlan plan;
  // Columns that read the same are one: which of them it is, no test can tell.
  const Alike alike = alike_columns_of(data, model);
  Design design(model, alike.data, target, options);
  if (!design.can_draw()) {
    plan.sentence = "The data have too few values, or do not move: nothing can be planned from them.";
    return plan;
  }
  design.tell("diagnosing the data at hand");
  DiagnosisOptions how;
  how.search = options.search;
  how.search.progress = {};
  const Diagnosis now = diagnose(with_run_terms(without_run_terms(model), alike.data), alike.data, target, how);
  design.know(now.named);
  plan.inseparable = inseparable_effects(now, alike);
  plan.verdict = now.verdict;
  const bool is_all_named = now.verdict == Verdict::named && now.probable.empty() && now.equivalent.empty();
  plan.is_decided = is_all_named && plan.inseparable.empty();
  plan.p_nothing = now.p_nothing;
  const bool is_open = now.verdict == Verdict::nothing ? now.p_nothing < kSureOfNothing : !is_all_named;
  if (is_open && now.verdict != Verdict::untestable) {
    const MenuLimits limits{options.most_hours, options.max_rpm, options.can_load, options.can_room,
                            options.can_coolant};
    const std::vector<MenuItem> menu = menu_of(alike.data, model.targets.at(target), limits);
    add_alike_beside_model(design, now, menu.front().schedule, options.search.seed, plan);
    plan.tests = tests_of(design, menu);
    if (!plan.tests.empty() && !(plan.tests.front().p_part >= kLeastPromise)) plan.tests.clear();
  }
  if (!plan.tests.empty()) {
    add_curves(design, plan, options.search.seed);
    add_sensor(design, plan);
  }
  plan.sentence = sentence_of(plan, options);
  return plan;
}

ExpectedTest expected_of(const Model& model, const Series& data, std::size_t target, const Schedule& schedule,
                         std::size_t truths, const TestPlanOptions& options) {
  const Design design(model, data, target, options);
  if (!design.can_draw()) return {};
  return design.expected({"", "", duration_s(schedule) / 3600.0, schedule}, design.drawn(truths, 1));
}

}  // namespace ballbar
