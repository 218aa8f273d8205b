#include "ballbar/workbench/workbench.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "ballbar/error.hpp"
#include "diagnosis/made_drift.hpp"

namespace ballbar {
namespace {

std::shared_ptr<const Series> data_of(const made::Drift& how) {
  return std::make_shared<const Series>(made::drift(how));
}

Term slow_room() { return term_of("lagged_expansion", {"T_room_degC"}); }

void expect_same(const EffectTest& a, const EffectTest& b) {
  EXPECT_EQ(a.after.likelihood_ratio, b.after.likelihood_ratio);
  EXPECT_EQ(a.after.rmse_um, b.after.rmse_um);
  EXPECT_EQ(a.after.held_out_um, b.after.held_out_um);
  EXPECT_EQ(a.before.rmse_um, b.before.rmse_um);
  EXPECT_EQ(a.before.held_out_um, b.before.held_out_um);
  ASSERT_EQ(a.added.size(), b.added.size());
  for (std::size_t k = 0; k < a.added.size(); ++k) {
    EXPECT_EQ(a.added[k].amplitude_um, b.added[k].amplitude_um);
    EXPECT_EQ(a.added[k].p, b.added[k].p);
  }
  ASSERT_EQ(a.earlier.size(), b.earlier.size());
  for (std::size_t k = 0; k < a.earlier.size(); ++k) EXPECT_EQ(a.earlier[k].p, b.earlier[k].p);
}

TEST(Workbench, holds_the_data_that_it_was_given) {
  const auto data = data_of({3.0, 1, 200});
  Workbench bench(data, made::by_speed());
  EXPECT_EQ(&bench.data(), data.get());
  bench.check();
  EXPECT_EQ(&bench.data(), data.get());
}

TEST(Workbench, has_the_results_of_the_functions_that_it_calls) {
  const auto data = data_of({3.0, 1, 200});
  Workbench bench(data, made::by_speed());
  EXPECT_EQ(bench.check().fit.rmse_um, fit(made::by_speed(), *data).rmse_um);
  const Diagnosis apart = diagnose(made::by_speed(), *data);
  EXPECT_EQ(bench.diagnosis().p_nothing, apart.p_nothing);
  EXPECT_EQ(bench.diagnosis().named, apart.named);
}

TEST(Workbench, keeps_what_it_has_computed_until_the_model_changes) {
  Workbench bench(data_of({3.0, 1, 200}), made::by_speed());
  const ResidualReport* const check = &bench.check();
  const Diagnosis* const diagnosis = &bench.diagnosis();
  EXPECT_EQ(&bench.check(), check);
  EXPECT_EQ(&bench.diagnosis(), diagnosis);
  bench.add({slow_room()});
  EXPECT_EQ(bench.model().terms.size(), made::by_speed().terms.size() + 1);
  EXPECT_LT(bench.check().fit.rmse_um, check->fit.rmse_um);
  ASSERT_TRUE(bench.undo());
  EXPECT_EQ(&bench.check(), check);
  EXPECT_EQ(&bench.diagnosis(), diagnosis);
  EXPECT_FALSE(bench.undo());
}

TEST(Workbench, an_effect_has_the_same_test_before_and_after_a_diagnosis) {
  const auto data = data_of({3.0, 1, 200});
  const EffectTest first = Workbench(data, made::by_speed()).effect_test({slow_room()});
  Workbench bench(data, made::by_speed());
  bench.diagnosis();
  expect_same(first, bench.effect_test({slow_room()}));
  EXPECT_EQ(bench.model().terms.size(), made::by_speed().terms.size());
  bench.add({slow_room()});
  expect_same(first, bench.added());
}

TEST(Workbench, a_fit_of_the_model_is_the_fit_that_its_addition_tells) {
  Workbench bench(data_of({3.0, 2, 200}), made::by_speed());
  bench.add({slow_room()});
  EXPECT_EQ(bench.check().fit.rmse_um, bench.added().after.rmse_um);
  EXPECT_EQ(fit(bench.model(), bench.data()).rmse_um, bench.added().fit_after.rmse_um);
}

TEST(Workbench, what_is_promised_is_what_comes) {
  const auto data = data_of({2.0, 3, 200});
  Workbench bench(data, made::by_speed());
  const Diagnosis found = bench.diagnosis();
  ASSERT_FALSE(found.candidates.empty());
  for (const Candidate& one : found.candidates) {
    const Term term = term_of(*one.bound.effect, one.bound.columns);
    EXPECT_EQ(bench.rmse_um_with({term}), one.rmse_after_um) << one.label;
    Workbench anew(data, made::by_speed());
    anew.add({term});
    bench.add({term});
    EXPECT_EQ(bench.check().fit.rmse_um, one.rmse_after_um) << one.label;
    EXPECT_EQ(anew.check().fit.rmse_um, one.rmse_after_um) << one.label;
    ASSERT_TRUE(bench.undo());
    EXPECT_LE(one.rmse_after_um, bench.check().fit.rmse_um) << one.label;
  }
}

TEST(Workbench, a_range_of_its_own_holds_after_a_diagnosis) {
  const auto data = data_of({3.0, 1, 200});
  Term fast = slow_room();
  for (std::size_t k = 0; k < fast.settings.size(); ++k) {
    if (fast.effect->parameters[k].kind == ParameterKind::gain) continue;
    fast.settings[k] = {.start = 300.0, .lower = 60.0, .upper = 600.0};
  }
  const double before_um = Workbench(data, made::by_speed()).rmse_um_with({fast});
  Workbench bench(data, made::by_speed());
  bench.diagnosis();
  EXPECT_NEAR(bench.rmse_um_with({fast}), before_um, 1e-6 * before_um);
  bench.add({fast});
  EXPECT_NEAR(bench.check().fit.rmse_um, before_um, 1e-6 * before_um);
}

TEST(Workbench, a_test_that_cannot_be_made_leaves_the_model) {
  Workbench bench(data_of({3.0, 1, 200}), made::by_speed());
  EXPECT_THROW(bench.effect_test({term_of("expansion", {"T_absent_degC"})}), Error);
  EXPECT_EQ(bench.model().terms.size(), made::by_speed().terms.size());
}

TEST(Workbench, two_in_two_threads_do_not_meet) {
  const auto data = data_of({3.0, 1, 200});
  std::vector<double> p(2);
  const auto diagnose_one = [&](std::size_t which) {
    Workbench bench(data, made::by_speed());
    p[which] = bench.diagnosis().p_nothing;
  };
  std::thread other(diagnose_one, 0);
  diagnose_one(1);
  other.join();
  EXPECT_EQ(p[0], p[1]);
}

}  // namespace
}  // namespace ballbar
