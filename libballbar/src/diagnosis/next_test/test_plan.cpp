#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/error.hpp"
#include "ballbar/internal/model/run_terms.hpp"
#include "diagnosis/next_test/distinct_columns.hpp"
#include "diagnosis/next_test/menu.hpp"
#include "diagnosis/next_test/simulated_tests.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"
#include "numerics/orthonormal.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kCurvesShown = 6;  // hypotheses
constexpr double kLeastPromise = 0.1;    // smallest P(right) of a proposed test
constexpr std::size_t kScreened = 8;     // number of truths for screening a test
constexpr std::size_t kTruths = 24;      // number of truths for the reported P
constexpr std::size_t kKindsKept = 2;
constexpr double kInQuestion = 0.05;   // P of an effect
constexpr double kTheSame = 0.9999;    // |cosine| of two effects orthogonal to the model
constexpr double kWorthASensor = 0.1;  // P(right) that it adds

// Others than the truths of the choice.
std::vector<Truth> fresh_truths(const TestDesign& design) {
  return design.sets.drawn(kTruths, random_of(design.options, 101));
}

void tell(const TestPlanOptions& options, std::string_view step) {
  if (options.search.progress) options.search.progress(step);
}

bool is_better(const ExpectedTest& a, const ExpectedTest& b) {
  if (a.p_right != b.p_right) return a.p_right > b.p_right;
  if (a.p_part != b.p_part) return a.p_part > b.p_part;
  if (a.p_wrong != b.p_wrong) return a.p_wrong < b.p_wrong;
  return a.hours < b.hours;
}

// The shortest sufficient test, else the best one.
std::size_t chosen(const std::vector<ExpectedTest>& tests) {
  std::size_t best = 0;
  for (std::size_t k = 1; k < tests.size(); ++k) {
    const bool sure = tests[k].p_right >= kSureEnough, best_is_sure = tests[best].p_right >= kSureEnough;
    const bool shorter = tests[k].hours < tests[best].hours;
    if (sure && best_is_sure ? shorter : is_better(tests[k], tests[best])) best = k;
  }
  return best;
}

std::vector<ExpectedTest> tests_of(const TestDesign& design, std::vector<std::vector<ExpectedTest>> menu) {
  // More where shorter tests are tried too.
  std::size_t simulated = 0, whole = menu.size() * kScreened + kTruths;
  const auto simulate = [&](ExpectedTest& test, const std::vector<Truth>& truths) {
    whole = std::max(whole, simulated + truths.size());
    const auto tell_done = [&](std::size_t done) {
      if (design.options.simulating) design.options.simulating(test, simulated + done, whole);
    };
    tell_done(0);
    test = expected_test(design, test, truths, tell_done);
    simulated += truths.size();
  };
  const std::vector<Truth> few = design.sets.drawn(kScreened, random_of(design.options, 100));
  for (std::vector<ExpectedTest>& kind : menu) simulate(kind.back(), few);
  std::stable_sort(menu.begin(), menu.end(),
                   [](const auto& a, const auto& b) { return is_better(a.back(), b.back()); });
  std::vector<ExpectedTest> all;
  for (std::size_t k = 0; k < menu.size(); ++k) {
    all.push_back(menu[k].back());
    // Where hours are enough, fewer may be: as long as they are.
    for (std::size_t i = menu[k].size() - 1; i-- > 0 && k < kKindsKept && all.back().p_right >= kSureEnough;) {
      simulate(menu[k][i], few);
      all.push_back(menu[k][i]);
    }
  }
  // The reported P comes from other truths than the choice. If it is too small, the next test is examined as well.
  const std::vector<Truth> fresh = fresh_truths(design);
  std::set<std::size_t> promised;
  for (int round = 0; round < 2; ++round) {
    const std::size_t best = chosen(all);
    if (!(all[best].p_part > 0.0) || !promised.insert(best).second) break;
    simulate(all[best], fresh);
  }
  std::size_t best = chosen(all);
  if (!promised.empty() && promised.count(best) == 0)
    best = *std::max_element(promised.begin(), promised.end(),
                             [&](std::size_t a, std::size_t b) { return is_better(all[b], all[a]); });
  std::swap(all[0], all[best]);
  std::stable_sort(all.begin() + 1, all.end(), is_better);
  return all;
}

void add_curves(const TestDesign& design, TestPlan& plan) {
  std::mt19937_64 random = random_of(design.options, 7);
  const Series run = inputs_under(plan.tests.front().schedule, design.inputs, random);
  const Posterior& posterior = design.found.posterior;
  plan.time_s = run.time_s;
  for (std::size_t s = 0; s < posterior.sets.size() && plan.curves.size() < kCurvesShown; ++s) {
    const double p = posterior.p(posterior.sets[s]);
    if (p < 0.01) continue;
    const PossibleSet& set = design.sets.at(s);
    const Eigen::VectorXd drift = drift_um(set, run);
    plan.curves.push_back({set.effects, p, {drift.begin(), drift.end()}});
    for (double& um : plan.curves.back().um) um -= drift[0];
    plan.sigma_um = std::max(plan.sigma_um, std::sqrt(set.variance * (set.noise.white + set.noise.correlated)));
  }
}

// The effect of a set of one; nullptr: it has none or several.
const BoundEffect* only_effect(const Inference& found, const EffectSet& set) {
  return set.families.size() == 1 ? &found.problem->library.families[set.families.front()].bound : nullptr;
}

// Possible effects that are equal in any test, up to the free part of the model: a difference of two temperatures and
// one of them, if the model has the other.
void add_inseparable_by_model(const TestDesign& design, const Diagnosis& now, const Schedule& schedule,
                              TestPlan& plan) {
  std::mt19937_64 random = random_of(design.options, 8);
  const Series run = inputs_under(schedule, design.inputs, random);
  struct Curve {
    BoundEffect effect;
    Eigen::VectorXd um;
    Eigen::MatrixXd basis;  // of the model
  };
  std::vector<Curve> curves;
  const std::vector<EffectSet>& sets = design.found.posterior.sets;
  for (std::size_t s = 0; s < sets.size(); ++s) {
    const BoundEffect* effect = only_effect(design.found, sets[s]);
    if (effect == nullptr || sets[s].freed || effect->effect->time_only) continue;
    const bool is_in_question = std::any_of(now.effects.begin(), now.effects.end(), [&](const EffectProbability& one) {
      return one.bound == *effect && one.p >= kInQuestion;
    });
    if (!is_in_question) continue;
    const PossibleSet& set = design.sets.at(s);
    Eigen::MatrixXd slopes;
    const Eigen::VectorXd um = terms_um(set, run, &slopes).rightCols(1);
    Eigen::MatrixXd of_model = slopes.leftCols(static_cast<Eigen::Index>(set.problem->base_model->parameters()));
    for (Eigen::Index k = 1; k < of_model.cols(); ++k) {
      if (set.fitted.parameters[static_cast<std::size_t>(k)].state == ParameterState::held) of_model.col(k).setZero();
    }
    curves.push_back({*effect, um, orthonormal(of_model)});
  }
  for (std::size_t a = 0; a < curves.size(); ++a) {
    std::vector<BoundEffect> group{curves[a].effect};
    const Eigen::VectorXd own = orthogonal_part(curves[a].um, curves[a].basis);
    for (std::size_t b = 0; b < curves.size(); ++b) {
      if (a == b) continue;
      const Eigen::VectorXd other = orthogonal_part(curves[b].um, curves[a].basis);
      const double both = own.norm() * other.norm();
      if (both > 0.0 && std::abs(own.dot(other)) > kTheSame * both) group.push_back(curves[b].effect);
    }
    const bool is_new = std::none_of(plan.inseparable.begin(), plan.inseparable.end(), [&](const auto& one) {
      return std::find(one.begin(), one.end(), curves[a].effect) != one.end();
    });
    if (group.size() > 1 && is_new) plan.inseparable.push_back(std::move(group));
  }
}

// Whether the effect reads a source of heat and no temperature, so that a thermometer would show its heat.
bool is_heat_input(const BoundEffect& bound) {
  return !bound.columns.empty() && !bound.effect->time_only &&
         std::all_of(bound.columns.begin(), bound.columns.end(), [](const std::string& column) {
           const Role role = role_from_unit(unit_of(column));
           return role == Role::speed || role == Role::load;
         });
}

// Where the most probable effect heats that is alone.
void add_sensor(const TestDesign& design, TestPlan& plan) {
  const ExpectedTest& best = plan.tests.front();
  if (best.p_right >= kSureEnough) return;
  const Posterior& posterior = design.found.posterior;
  for (std::size_t s = 0; s < posterior.sets.size() && posterior.p(posterior.sets[s]) >= 0.05; ++s) {
    const BoundEffect* effect = only_effect(design.found, posterior.sets[s]);
    if (effect == nullptr || !is_heat_input(*effect)) continue;
    tell(design.options, "simulating a thermometer more");
    const double p = p_right_with_sensor(design, best.schedule, design.sets.at(s), fresh_truths(design));
    if (p >= best.p_right + kWorthASensor) plan.sensor = {*effect, p};
    return;
  }
}

}  // namespace

TestPlan test_plan(const Model& model, const Series& data, std::size_t target, const TestPlanOptions& options) {
  if (model.level != Level::series) {
    throw Error(
        fmt::format("expected a drift series to plan a run for, found recordings of {} readings.", data.time_s.size()));
  }
  TestPlan plan;
  // Equal columns count as one, because no test can separate them.
  const DistinctColumns distinct = distinct_columns_of(data, model, target);
  const Model alone = without_run_terms(model), with_runs = with_run_terms(alone, distinct.data);
  const DiagnosisOptions how = diagnosis_options(options);
  tell(options, "weighing the data at hand");
  Inference found = inference_of(with_runs, distinct.data, target, how);
  if (found.largest == 0 || found.is_still) {
    plan.obstacle = found.is_still ? Obstacle::still_readings : Obstacle::too_few_values;
    return plan;
  }
  tell(options, "diagnosing the data at hand");
  const Diagnosis now = diagnosis_of(found, with_runs, distinct.data, target, how);
  plan.inseparable = inseparable_effects(now, distinct);
  plan.verdict = now.verdict;
  const bool is_all_named = now.verdict == Verdict::named && now.probable.empty() && now.equivalent.empty();
  plan.is_decided = is_all_named && plan.inseparable.empty();
  plan.p_nothing = now.p_nothing;
  const bool is_open = now.verdict == Verdict::nothing ? now.p_nothing < kSureOfNothing : !is_all_named;
  if (!is_open || now.verdict == Verdict::untestable) return plan;
  const std::string& name = model.targets[target];
  PossibleSets sets(found);
  const TestDesign design{options,
                          alone,
                          distinct.data,
                          target,
                          now.named,
                          found,
                          sets,
                          planned_inputs(distinct.data, name),
                          simulated_covariances(found)};
  const std::vector<std::vector<ExpectedTest>> menu = menu_of(distinct.data, name, options);
  add_inseparable_by_model(design, now, menu.front().front().schedule, plan);
  plan.tests = tests_of(design, menu);
  if (plan.tests.front().p_part < kLeastPromise) plan.tests.clear();
  if (plan.tests.empty()) return plan;
  add_curves(design, plan);
  add_sensor(design, plan);
  return plan;
}

}  // namespace ballbar
