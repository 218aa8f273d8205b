// The posterior over sets of effects: its prior, its weights against all of them summed one by one, and what it must
// not depend on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "ballbar/diagnosis/thresholds.hpp"
#include "diagnosis/evidence/dense.hpp"
#include "diagnosis/made_drift.hpp"
#include "diagnosis/posterior/set_prior.hpp"
#include "diagnosis/posterior/weighed.hpp"

namespace ballbar {
namespace {

Catalogue only(const std::vector<std::string>& names) {
  Catalogue catalogue;
  for (const auto& effect : built_in_catalogue()) {
    const bool is_wanted = std::find(names.begin(), names.end(), effect->name) != names.end();
    if (effect->level == Level::series && is_wanted) catalogue.push_back(effect);
  }
  return catalogue;
}

Weighed weighed_by(const Model& model, const Series& data, const Catalogue& catalogue = built_in_catalogue()) {
  ProblemOptions options;
  options.catalogue = catalogue;
  return weighed(model, data, 0, options);
}

// A model of a constant, 60 rows that settle and drift: no input, so that no time of one is open.
Series settling() {
  std::mt19937_64 random(2);
  std::normal_distribution<double> normal;
  Series data;
  Column target{"z_um", Role::measured, {}};
  double memory = 0.0;
  for (int i = 0; i < 60; ++i) {
    data.time_s.push_back(60.0 * i + (i > 40 ? 25.0 : 0.0));
    memory = 0.6 * memory + 0.3 * normal(random);
    target.values.push_back(2.0 * std::exp(-data.time_s.back() / 800.0) + memory + 0.1 * normal(random));
  }
  data.columns = {target};
  return data;
}

Model constant() {
  Model model;
  model.targets = {"z_um"};
  return model;
}

// ln of prior times evidence of one family, or of none, over the covariances that are kept: every shape by the whole
// matrix.
double by_matrix(const Weighed& found, std::optional<std::size_t> family) {
  const Problem& problem = *found.problem;
  const SignatureLibrary& library = problem.library;
  const Eigen::MatrixXd x = Eigen::MatrixXd::Ones(problem.y.size(), 1);
  const double nu = static_cast<double>(problem.y.size() - 1);
  std::vector<double> all;
  for (const Point& point : found.posterior.points) {
    const Eigen::MatrixXd c = dense::matrix_of(point.covariance, problem.time_s, problem.relative_variance);
    const auto evidence = [&](const Eigen::MatrixXd& with) {
      const dense::Flat flat = dense::flat(problem.y, x, with);
      return -0.5 * nu * std::log(flat.square) - flat.half_log;
    };
    if (!family) {
      all.push_back(evidence(c) + point.covariance.log_prior);
      continue;
    }
    const Family& one = library.families[*family];
    for (std::size_t i = one.first; i < one.first + one.count; ++i) {
      const Eigen::VectorXd column = problem.signatures.col(library.signatures[i].first);
      const double left = dense::left_of(column, x, c)(0, 0);
      if (left <= kSurvivingShare * column.dot(c.llt().solve(column))) continue;
      std::vector<double> sizes;
      for (const double d : kGainSizes) sizes.push_back(evidence(c + d * d / left * column * column.transpose()));
      all.push_back(dense::log_mean(sizes) + problem.log_prior_of_shape[i] + point.covariance.log_prior);
    }
  }
  std::vector<std::size_t> families;
  if (family) families.push_back(*family);
  return log_sum(all) + log_prior_of_set(problem, families, 0);
}

const EffectSet& set_of(const Posterior& posterior, const std::vector<std::size_t>& families) {
  return *std::find_if(posterior.sets.begin(), posterior.sets.end(),
                       [&](const EffectSet& one) { return one.own == 0 && one.families == families; });
}

TEST(Posterior, single_effects_are_all_their_shapes_summed) {
  const Weighed found = weighed_by(constant(), settling(), only({"settling", "linear_drift"}));
  ASSERT_EQ(found.problem->effects, 2U);
  const double none = set_of(found.posterior, {}).log_weight, none_by_matrix = by_matrix(found, std::nullopt);
  for (std::size_t family = 0; family < 2; ++family) {
    EXPECT_NEAR(set_of(found.posterior, {family}).log_weight - none, by_matrix(found, family) - none_by_matrix, 1e-6)
        << family;
  }
}

TEST(Posterior, is_a_distribution) {
  for (const double room_um_per_K : {0.0, 0.3, 3.0}) {
    const Weighed found = weighed_by(made::by_speed(), made::drift({room_um_per_K, 1, 200}));
    double sum = 0.0;
    const EffectSet* before = nullptr;
    for (const EffectSet& set : found.posterior.sets) {
      const double p = found.posterior.p(set);
      EXPECT_GE(p, 0.0);
      EXPECT_TRUE(std::is_sorted(set.families.begin(), set.families.end()));
      EXPECT_LE(set.log_weight_slow, set.log_weight + 1e-12);
      EXPECT_LE(set.most, set.log_weight + 1e-9);
      EXPECT_EQ(set.signatures.size(), set.families.size());
      for (std::size_t m = 0; m < set.families.size(); ++m) {
        const std::size_t family = found.problem->library.signatures[set.signatures[m]].family;
        EXPECT_NE(std::find(set.families.begin(), set.families.end(), family), set.families.end());
      }
      EXPECT_TRUE(before == nullptr || before->log_weight >= set.log_weight);
      before = &set;
      sum += p;
    }
    EXPECT_NEAR(sum, 1.0, 1e-9);
  }
}

TEST(Posterior, is_told_on_the_way) {
  std::vector<std::vector<ProbableSoFar>> told;
  ProblemOptions options;
  options.catalogue = built_in_catalogue();
  const Told listener{{}, [&](const std::vector<ProbableSoFar>& effects) { told.push_back(effects); }};
  const Weighed found = weighed(made::by_speed(), made::drift({3.0, 1, 200}), 0, options, {}, listener);
  ASSERT_GT(found.problem->effects, 10U);
  ASSERT_GE(told.size(), 3U);
  for (const std::vector<ProbableSoFar>& effects : told) {
    EXPECT_EQ(effects.size(), found.problem->effects);
    for (std::size_t k = 0; k < effects.size(); ++k) {
      EXPECT_GE(effects[k].p, 0.0);
      EXPECT_LE(effects[k].p, k == 0 ? 1.0 + 1e-12 : effects[k - 1].p);
    }
  }
  // At last, the effect that the posterior has in most of its sets.
  std::map<std::size_t, double> p_of;
  for (const EffectSet& set : found.posterior.sets) {
    for (const std::size_t family : set.families) p_of[family] += found.posterior.p(set);
  }
  ASSERT_FALSE(p_of.empty());
  const auto most =
      std::max_element(p_of.begin(), p_of.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  EXPECT_GT(most->second, 0.5);
  ASSERT_LT(most->first, found.problem->effects);
  EXPECT_EQ(label_of(told.back().front().bound), label_of(found.problem->library.families[most->first].bound));
  EXPECT_NEAR(told.back().front().p, most->second, 0.1);
}

// Effects with inputs of any form among them, the columns of an effect, its shapes; values that the model holds.
TEST(Prior, sums_to_one_over_what_is_weighed) {
  Model model = made::by_speed();
  const Weighed found = weighed_by(model, made::drift({0.0, 1, 200}));
  const Problem& problem = *found.problem;
  double of_one = 0.0;
  for (std::size_t own = 0; own <= problem.own.size(); ++own) {
    for (std::size_t f = 0; f < problem.library.families.size(); ++f)
      of_one += std::exp(log_prior_of_set(problem, {f}, own));
  }
  ASSERT_FALSE(problem.own.empty());
  EXPECT_NEAR(of_one, kPriorOfSize[1], 1e-9);
  double of_none = 0.0;
  for (std::size_t own = 0; own <= problem.own.size(); ++own) of_none += std::exp(log_prior_of_set(problem, {}, own));
  EXPECT_NEAR(of_none, kPriorOfSize[0], 1e-9);
  // Two in either order, an effect once: what two times the same family would have is left out.
  double of_two = 0.0, twice = 0.0;
  for (std::size_t f = 0; f < problem.library.families.size(); ++f) {
    twice += std::exp(2.0 * problem.log_prior[f]);
    for (std::size_t g = f + 1; g < problem.library.families.size(); ++g) {
      for (std::size_t own = 0; own <= problem.own.size(); ++own)
        of_two += std::exp(log_prior_of_set(problem, {f, g}, own));
    }
  }
  EXPECT_NEAR(of_two, kPriorOfSize[2] * (1.0 - twice), 1e-9);
  for (const Family& family : problem.library.families) {
    double shapes = 0.0;
    for (std::size_t i = family.first; i < family.first + family.count; ++i)
      shapes += std::exp(problem.log_prior_of_shape[i]);
    EXPECT_NEAR(shapes, 1.0, 1e-9) << label_of(family.bound);
  }
}

TEST(Prior, has_effects_alike_and_their_columns_alike) {
  const Weighed found = weighed_by(made::by_speed(), made::drift({0.0, 1, 200}));
  const Problem& problem = *found.problem;
  std::map<std::string, double> of_effect;
  std::map<std::string, std::vector<double>> of_columns;
  for (std::size_t f = 0; f < problem.library.families.size(); ++f) {
    const std::string& name = problem.library.families[f].bound.effect->name;
    of_effect[name] += std::exp(problem.log_prior[f]);
    of_columns[name].push_back(problem.log_prior[f]);
  }
  for (const auto& [name, p] : of_effect) {
    EXPECT_NEAR(p, 1.0 / static_cast<double>(of_effect.size()), 1e-9) << name;
    for (const double one : of_columns[name]) EXPECT_EQ(one, of_columns[name].front()) << name;
  }
  EXPECT_GT(of_columns["expansion"].size(), 1U);
}

// A covariance's prior is moved by what the richest model says of the noise; that of a discrepancy is not.
TEST(Posterior, keeps_covariances_by_their_likelihood) {
  const Weighed found = weighed_by(made::by_speed(), made::drift({3.0, 1, 200}));
  ASSERT_FALSE(found.posterior.points.empty());
  EXPECT_LE(found.posterior.points.size(), kMostPoints);
  for (const Point& point : found.posterior.points) EXPECT_TRUE(std::isfinite(point.covariance.log_prior));
}

// P of every effect from 1 %.
std::map<std::string, double> probabilities(const Model& model, const Series& data) {
  const Diagnosis found = diagnose(model, data, 0, made::quick());
  std::map<std::string, double> p;
  for (const EffectProbability& one : found.effects) p[label_of(one.bound)] = one.p;
  p["nothing"] = found.p_nothing;
  p["discrepancy"] = found.p_discrepancy;
  for (const OwnValue& own : found.own) p[own.parameter] = own.p;
  return p;
}

void expect_same(const std::map<std::string, double>& a, const std::map<std::string, double>& b, double tolerance) {
  for (const auto& [label, p] : a) {
    const auto other = b.find(label);
    EXPECT_NEAR(p, other == b.end() ? 0.0 : other->second, other == b.end() ? 0.012 : tolerance) << label;
  }
  for (const auto& [label, p] : b) {
    EXPECT_LT(a.count(label) == 0 ? p : 0.0, 0.012 + tolerance) << label;
  }
}

class Invariance : public testing::TestWithParam<double> {
 protected:
  Series data() const { return made::drift({GetParam(), 1, 200}); }
};
// Nothing, something faint of which much is open, and something clear.
INSTANTIATE_TEST_SUITE_P(Posterior, Invariance, testing::Values(0.0, 0.6, 3.0));

TEST_P(Invariance, of_names) {
  Series renamed = data();
  Model model = made::by_speed();
  renamed.columns[0].name = "n_rpm";
  renamed.columns[1].name = "A_degC";
  renamed.columns[2].name = "Z9_degC";
  model.terms = {term_of("speed_heating", {"n_rpm"})};
  std::map<std::string, double> there;
  for (const auto& [label, p] : probabilities(model, renamed)) {
    std::string name = label;
    for (const auto& [from, to] :
         {std::pair{"n_rpm", "speed_rpm"}, {"A_degC", "T_room_degC"}, {"Z9_degC", "T_bearing_degC"}}) {
      if (const auto at = name.find(from); at != std::string::npos) name.replace(at, std::string(from).size(), to);
    }
    there[name] = p;
  }
  expect_same(probabilities(made::by_speed(), data()), there, 1e-6);
}

TEST_P(Invariance, of_the_order_of_columns) {
  Series turned = data();
  std::reverse(turned.columns.begin(), turned.columns.end());
  expect_same(probabilities(made::by_speed(), data()), probabilities(made::by_speed(), turned), 0.01);
}

// A clock that begins elsewhere: seconds since 1970.
TEST_P(Invariance, of_the_clock) {
  Series later = data();
  for (double& t : later.time_s) t += 1.7e9;
  expect_same(probabilities(made::by_speed(), data()), probabilities(made::by_speed(), later), 0.01);
}

TEST_P(Invariance, of_degC_and_K) {
  Series kelvin = data();
  for (Column& column : kelvin.columns) {
    if (unit_of(column.name) != "degC") continue;
    column.name.replace(column.name.size() - 4, 4, "K");
    for (double& value : column.values) value += 273.15;
  }
  std::map<std::string, double> there;
  for (const auto& [label, p] : probabilities(made::by_speed(), kelvin)) {
    std::string name = label;
    for (std::size_t at = 0; (at = name.find("_K", at)) != std::string::npos; at += 5) name.replace(at, 2, "_degC");
    there[name] = p;
  }
  expect_same(probabilities(made::by_speed(), data()), there, 0.01);
}

// Readings a thousand times as large or as small: nm, mm.
TEST_P(Invariance, of_the_size_of_the_readings) {
  for (const double factor : {1000.0, 1e-3}) {
    Series scaled = data();
    for (double& value : scaled.columns.back().values) value *= factor;
    Model model = made::by_speed();
    for (Setting& setting : model.terms[0].settings) {
      if (setting.upper == 1000.0) {
        setting.lower = -1e9;
        setting.upper = 1e9;
      }
    }
    expect_same(probabilities(made::by_speed(), data()), probabilities(model, scaled), 0.01);
  }
}

// A probe that reads from elsewhere, 10 mm or a metre more; what is told of cycles left out, too.
TEST_P(Invariance, of_a_constant) {
  const Diagnosis here = diagnose(made::by_speed(), data(), 0, made::quick());
  for (const double more_um : {1e4, 1e6}) {
    Series further = data();
    for (double& value : further.columns.back().values) value += more_um;
    expect_same(probabilities(made::by_speed(), data()), probabilities(made::by_speed(), further), 0.01);
    const Diagnosis there = diagnose(made::by_speed(), further, 0, made::quick());
    EXPECT_EQ(there.verdict, here.verdict);
    ASSERT_EQ(there.candidates.empty(), here.candidates.empty());
    if (here.candidates.empty()) continue;
    const Candidate &a = here.candidates.front(), &b = there.candidates.front();
    EXPECT_NEAR(b.held_out_after_um, a.held_out_after_um, 1e-3 * a.held_out_after_um);
    EXPECT_NEAR(b.held_out_before_um, a.held_out_before_um, 1e-3 * a.held_out_before_um);
  }
}

}  // namespace
}  // namespace ballbar
