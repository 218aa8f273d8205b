#include "ballbar/diagnosis/next_test/test_plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "ballbar/model/run_terms.hpp"
#include "ballbar/number_text.hpp"
#include "diagnosis/next_test/distinct_columns.hpp"
#include "diagnosis/next_test/menu.hpp"
#include "diagnosis/next_test/simulated_tests.hpp"
#include "diagnosis/thresholds.hpp"
#include "numerics/orthonormal.hpp"
#include "numerics/random_streams.hpp"

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

std::vector<ExpectedTest> tests_of(const SimulatedTests& design, const std::vector<ExpectedTest>& menu) {
  std::map<std::string, std::vector<const ExpectedTest*>> kinds;  // each from short to long
  std::vector<std::string> order;
  for (const ExpectedTest& item : menu) {
    if (kinds[item.kind].empty()) order.push_back(item.kind);
    kinds[item.kind].push_back(&item);
  }
  // More where shorter tests are tried too.
  std::size_t simulated = 0, whole = order.size() * kScreened + kTruths;
  const auto expected = [&](const ExpectedTest& test, const std::vector<Truth>& truths) {
    whole = std::max(whole, simulated + truths.size());
    const auto tell = [&](std::size_t done) {
      design.tell(fmt::format("simulating {:g} h of {}, {} of {}", test.hours, test.kind, simulated + done, whole));
    };
    tell(0);
    ExpectedTest result = design.expected(test, truths, tell);
    simulated += truths.size();
    return result;
  };
  const std::vector<Truth> few = design.drawn(kScreened, 0);
  std::vector<ExpectedTest> longest, all;
  for (const std::string& kind : order) {
    longest.push_back(expected(*kinds[kind].back(), few));
  }
  std::stable_sort(longest.begin(), longest.end(), is_better);
  for (std::size_t k = 0; k < longest.size(); ++k) {
    // Where hours are enough, fewer may be: as long as they are.
    const std::vector<const ExpectedTest*>& items = kinds[longest[k].kind];
    bool enough = k < kKindsKept && longest[k].p_right >= kSureEnough;
    all.push_back(std::move(longest[k]));
    for (std::size_t i = items.size() - 1; i-- > 0 && enough;) {
      all.push_back(expected(*items[i], few));
      enough = all.back().p_right >= kSureEnough;
    }
  }
  // The reported P comes from other truths than the choice. If it is too small, the next test is examined as well.
  const std::vector<Truth> fresh = design.drawn(kTruths, 1);
  std::set<std::size_t> promised;
  for (int round = 0; round < 2; ++round) {
    const std::size_t best = chosen(all);
    if (!(all[best].p_part > 0.0) || !promised.insert(best).second) break;
    const auto item = std::find_if(menu.begin(), menu.end(), [&](const ExpectedTest& one) {
      return one.kind == all[best].kind && one.hours == all[best].hours;
    });
    all[best] = expected(*item, fresh);
  }
  std::size_t best = chosen(all);
  if (!promised.empty() && promised.count(best) == 0)
    best = *std::max_element(promised.begin(), promised.end(),
                             [&](std::size_t a, std::size_t b) { return is_better(all[b], all[a]); });
  std::swap(all[0], all[best]);
  std::stable_sort(all.begin() + 1, all.end(), is_better);
  return all;
}

void add_curves(const SimulatedTests& design, TestPlan& plan, std::uint64_t seed) {
  const Posterior& posterior = design.posterior();
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

// Possible effects that are equal in any test, up to the free part of the model: a difference of two temperatures and
// one of them, if the model has the other.
void add_inseparable_by_model(const SimulatedTests& design, const Diagnosis& now, const Schedule& schedule,
                              std::uint64_t seed, TestPlan& plan) {
  std::mt19937_64 random = simulation::stream_of(seed, simulation::Stream::signal, 8);
  const Series run = design.planned().under(schedule, random);
  struct Curve {
    BoundEffect effect;
    Eigen::VectorXd um;
    Eigen::MatrixXd basis;  // of the model
  };
  std::vector<Curve> curves;
  const Posterior& posterior = design.posterior();
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
  if (bound.columns.empty() || bound.effect->time_only) return false;
  return std::all_of(bound.columns.begin(), bound.columns.end(), [](const std::string& column) {
    const std::string_view unit = unit_of(column);
    return unit == "rpm" || unit == "W" || unit == "A" || unit == "percent" || unit == "Nm";
  });
}

void add_sensor(const SimulatedTests& design, TestPlan& plan) {
  const ExpectedTest& best = plan.tests.front();
  if (best.p_right >= kSureEnough) return;
  const Posterior& posterior = design.posterior();
  for (std::size_t s = 0; s < posterior.sets.size(); ++s) {
    if (posterior.p(posterior.sets[s]) < 0.05) return;
    const std::vector<BoundEffect> effects = design.truths().effects_of({s, false});
    if (effects.size() != 1 || !is_heat_input(effects.front())) continue;
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
    std::string labels = label_of(group.front());
    for (std::size_t k = 1; k < group.size(); ++k)
      labels += (k + 1 == group.size() ? " and " : ", ") + label_of(group[k]);
    const bool is_twin = group[0].effect == group[1].effect && group[0].columns.size() == 1;
    text += fmt::format("{}No test can distinguish {}: {}.", text.empty() ? "" : " ", labels,
                        is_twin ? "their columns hold the same values" : "beside this model they add the same curve");
  }
  return text;
}

std::string sentence_of(const TestPlan& plan, const TestPlanOptions& options) {
  const std::string inseparable = inseparable_text(plan.inseparable);
  const std::string behind = inseparable.empty() ? "" : " " + inseparable;
  if (plan.is_decided) return "These data already decide: no further test is needed." + behind;
  const bool is_nothing = plan.verdict == Verdict::nothing;
  if (is_nothing && plan.p_nothing >= kSureOfNothing)
    return "In these data nothing is missing: there is nothing to decide." + behind;
  if (plan.tests.empty()) {
    if (is_nothing) {
      return fmt::format(
                 "Nothing is found to be missing ({}). No test of up to {:g} h would find what may still be there.",
                 sure_text(plan.p_nothing), options.most_hours) +
             behind;
    }
    if (!inseparable.empty()) return inseparable + " No test is proposed.";
    return fmt::format("No test of up to {:g} h would decide. None is proposed.", options.most_hours);
  }
  const ExpectedTest& best = plan.tests.front();
  std::string text =
      is_nothing ? fmt::format("Nothing is found to be missing yet ({}). ", sure_text(plan.p_nothing)) : "";
  text += fmt::format(
      "Run {:g} h from cold: {}. This run would name everything that is missing in {} of cases (± {:.0f} %, {} "
      "simulated)",
      best.hours, best.doing, percent(best.p_right), 100.0 * best.p_right_sigma, best.truths);
  if (best.p_part > best.p_right) text += fmt::format(", a part of it in {}", percent(best.p_part));
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
  // Equal columns count as one, because no test can separate them.
  const DistinctColumns distinct = distinct_columns_of(data, model);
  SimulatedTests design(model, distinct.data, target, options);
  if (!design.can_draw()) {
    plan.sentence = "The data have too few values, or do not move: nothing can be planned from them.";
    return plan;
  }
  design.tell("diagnosing the data at hand");
  DiagnosisOptions how;
  how.search = options.search;
  how.search.progress = {};
  how.fit_candidates = how.leave_out = false;
  const Diagnosis now = diagnose(with_run_terms(without_run_terms(model), distinct.data), distinct.data, target, how);
  design.know(now.named);
  plan.inseparable = inseparable_effects(now, distinct);
  plan.verdict = now.verdict;
  const bool is_all_named = now.verdict == Verdict::named && now.probable.empty() && now.equivalent.empty();
  plan.is_decided = is_all_named && plan.inseparable.empty();
  plan.p_nothing = now.p_nothing;
  const bool is_open = now.verdict == Verdict::nothing ? now.p_nothing < kSureOfNothing : !is_all_named;
  if (is_open && now.verdict != Verdict::untestable) {
    const std::vector<ExpectedTest> menu = menu_of(distinct.data, model.targets.at(target), options);
    add_inseparable_by_model(design, now, menu.front().schedule, options.seed, plan);
    plan.tests = tests_of(design, menu);
    if (!plan.tests.empty() && !(plan.tests.front().p_part >= kLeastPromise)) plan.tests.clear();
  }
  if (!plan.tests.empty()) {
    add_curves(design, plan, options.seed);
    add_sensor(design, plan);
  }
  plan.sentence = sentence_of(plan, options);
  return plan;
}

}  // namespace ballbar
