// The posterior of a sum of single effects: its prior, one of them against all shapes and gains summed by the whole
// matrix, and what it must not depend on.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <random>

#include "diagnosis/evidence/dense.hpp"
#include "diagnosis/made_drift.hpp"
#include "diagnosis/posterior/ibss.hpp"
#include "diagnosis/posterior/inference.hpp"

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

Inference weighed_by(const Model& model, const Series& data, const Catalogue& catalogue = built_in_catalogue()) {
  ProblemOptions options;
  options.search.catalogue = catalogue;
  return inference(model, data, 0, options);
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

// A sum of one single effect, at one covariance and about one scatter, is what Bayes says of all shapes and gains: each
// of them by the whole matrix.
struct OfOne {
  std::unique_ptr<Problem> problem;
  Identities identities;
  SumOfEffects sum;
  Covariance covariance{0.1, 0.9, 120.0};
  double log_weight = 0.0;     // by the matrix: of any identity over none
  std::vector<double> log_of;  // of each identity

  explicit OfOne(const Catalogue& catalogue) {
    ProblemOptions options;
    options.search.catalogue = catalogue;
    for (const auto& effect : catalogue) options.terms.push_back(term_of(*effect, {}));  // by hand
    problem = problem_of(constant(), settling(), 0, options);
    const Linearisation linearisation = linearisation_at(*problem, std::nullopt, {0.0});
    identities = identities_of(*problem, linearisation, {});
    const NoiseFilter filter = noise_filter_at(*problem, covariance);
    ProjectedColumns at(*problem, identities, linearisation.linear, filter);
    IbssOptions how;
    how.priors = {{std::log(0.6), identities.log_prior}};
    for (double& one : how.priors.front().log_identity) one += std::log(0.4);
    how.largest = 1;
    how.known = problem->known;
    sum = ibss(at, identities, how);
    by_matrix();
  }

  Eigen::VectorXd column_of(const Shape& shape) const {
    if (shape.first < identities.columns.cols()) return identities.columns.col(shape.first);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(problem->y.size());
    step.tail(problem->y.size() - (shape.first - identities.columns.cols())).setOnes();
    return step;
  }

  void by_matrix() {
    const Eigen::MatrixXd x = Eigen::MatrixXd::Ones(problem->y.size(), 1);
    const Eigen::MatrixXd c = dense::matrix_of(covariance, problem->time_s);
    const auto evidence = [&](const Eigen::MatrixXd& with) {
      const dense::Flat flat = dense::flat(problem->y, x, with);
      return -0.5 * flat.square / sum.variance - flat.half_log;
    };
    const double none = evidence(c);
    std::vector<std::vector<double>> of(identities.log_prior.size());
    for (const Shape& shape : identities.shapes) {
      const Eigen::VectorXd column = column_of(shape);
      const double left = dense::left_of(column, x, c)(0, 0);
      std::vector<double> sizes;
      for (const double d : kGainSizes)
        sizes.push_back(evidence(c + d * d / left * column * column.transpose()) - none);
      of[shape.identity].push_back(dense::log_mean(sizes) + shape.log_prior + identities.log_prior[shape.identity]);
    }
    std::vector<double> all;
    for (const std::vector<double>& one : of) {
      log_of.push_back(log_sum(one));
      all.push_back(log_of.back());
    }
    log_weight = log_sum(all) + std::log(0.4 / 0.6);
  }
};

TEST(Posterior, of_one_single_effect_is_all_shapes_and_gains_summed) {
  const OfOne one(only({"settling", "linear_drift"}));
  ASSERT_EQ(one.problem->effects, 2U);
  ASSERT_EQ(one.sum.effects.size(), 1U);
  const SingleEffect& found = one.sum.effects.front();
  EXPECT_NEAR(found.log_odds, one.log_weight, 1e-6);
  EXPECT_NEAR(std::log(found.alpha[0] / found.alpha[1]), one.log_of[0] - one.log_of[1], 1e-6);
}

// Two inputs that nearly run alike: their gains are found together, where one after the other they would creep.
TEST(Ibss, the_sizes_of_effects_alike_are_those_of_least_squares) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  Series data;
  Column a{"a_degC", Role::structure, {}}, b{"b_degC", Role::structure, {}}, z{"z_um", Role::measured, {}};
  double walk = 20.0, apart = 0.0;
  for (int i = 0; i < 200; ++i) {
    data.time_s.push_back(60.0 * i);
    walk += 0.3 * normal(random);
    apart += 0.01 * normal(random);
    a.values.push_back(walk);
    b.values.push_back(walk + apart);
    z.values.push_back(3.0 * walk - 2.5 * (walk + apart) + 0.01 * normal(random));
  }
  data.columns = {a, b, z};
  ProblemOptions options;
  options.search.catalogue = only({"expansion"});
  options.search.tuning.smoothing = options.search.tuning.equal_columns = false;
  const auto problem = problem_of(constant(), data, 0, options);
  ASSERT_EQ(problem->effects, 2U);
  const Linearisation linearisation = linearisation_at(*problem, std::nullopt, {0.0});
  const Identities identities = identities_of(*problem, linearisation, {});
  const SumOfEffects sum = sum_at(*problem, identities, linearisation.linear, Covariance{1.0},
                                  with_exactly(ibss_options(*problem, identities, 2, Forms::no), {0, 1}));
  Eigen::MatrixXd columns(problem->y.size(), 3);
  columns << Eigen::VectorXd::Ones(problem->y.size()), identities.columns.leftCols(2);
  const Eigen::VectorXd left = problem->y - columns * columns.colPivHouseholderQr().solve(problem->y);
  const double variance = left.squaredNorm() / static_cast<double>(left.size() - 3);
  EXPECT_NEAR(sum.variance, variance, 0.1 * variance);
}

// Of a jump every row is a shape.
TEST(Posterior, of_a_jump_is_all_rows_summed) {
  const OfOne one(only({"step"}));
  ASSERT_TRUE(one.identities.jump);
  EXPECT_EQ(one.identities.shapes.size(), 56U);
  EXPECT_NEAR(one.sum.effects.front().log_odds, one.log_weight, 1e-6);
}

// A jump beside an effect of the room: one hides the other until both are there.
TEST(Posterior, ascends_to_effects_that_show_together_alone) {
  Series data = made::drift({3.0, 1, 300});
  std::vector<double>& values = made::values_of(data, "z_um");
  for (std::size_t i = 170; i < values.size(); ++i) values[i] -= 2.5;
  const Diagnosis found = diagnose(made::by_speed(), data);
  ASSERT_EQ(found.verdict, Verdict::named);
  const auto step = std::find_if(found.candidates.begin(), found.candidates.end(),
                                 [](const Candidate& one) { return one.bound.effect->name == "step"; });
  ASSERT_NE(step, found.candidates.end());
  EXPECT_NEAR(step->parameters[1].value, data.time_s[170], 2.0 * (data.time_s[1] - data.time_s[0]));
  EXPECT_NEAR(step->parameters[0].value, -2.5, 0.5);
}

TEST(Posterior, is_of_probabilities) {
  for (const double room_um_per_K : {0.0, 0.3, 3.0}) {
    const Inference found = weighed_by(made::by_speed(), made::drift({room_um_per_K, 1, 200}));
    const Posterior& posterior = found.posterior;
    EXPECT_LE(posterior.nothing, posterior.none + 1e-12);
    double of_modes = 0.0;
    for (const PosteriorMode& mode : posterior.modes) {
      of_modes += mode.p;
      for (const SinglePosterior& one : mode.effects) {
        EXPECT_LE(one.p_any(), 1.0 + 1e-9);
        for (const double p : one.alpha) EXPECT_GE(p, 0.0);
      }
    }
    EXPECT_NEAR(of_modes, 1.0, 1e-12);
    // Of an effect: that one of the single effects is it.
    for (std::size_t f = 0; f < found.problem->effects; ++f) {
      double most = 0.0, all = 0.0;
      for (const PosteriorMode& mode : posterior.modes) {
        double in_mode = 0.0;
        for (const SinglePosterior& one : mode.effects) {
          in_mode = std::max(in_mode, one.alpha[f]);
          all += mode.p * one.alpha[f];
        }
        most += mode.p * in_mode;
      }
      EXPECT_GE(posterior.family[f], most - 1e-9);
      EXPECT_LE(posterior.family[f], all + 1e-9);
    }
    for (const EffectSet& set : posterior.sets) {
      EXPECT_TRUE(std::is_sorted(set.families.begin(), set.families.end()));
      EXPECT_EQ(set.signatures.size(), set.families.size());
      for (std::size_t m = 0; m < set.families.size(); ++m)
        EXPECT_EQ(found.problem->library.signatures[set.signatures[m]].family, set.families[m]);
    }
    EXPECT_LT(posterior.best, posterior.sets.size());
  }
}

TEST(Posterior, is_told_on_the_way) {
  std::vector<std::vector<ProbableSoFar>> told;
  ProblemOptions options;
  options.search.catalogue = built_in_catalogue();
  options.search.so_far = [&](const std::vector<ProbableSoFar>& effects) { told.push_back(effects); };
  const Inference found = inference(made::by_speed(), made::drift({3.0, 1, 200}), 0, options);
  ASSERT_GT(found.problem->effects, 10U);
  ASSERT_GE(told.size(), 1U);
  for (const std::vector<ProbableSoFar>& effects : told) {
    EXPECT_EQ(effects.size(), found.problem->effects);
    for (std::size_t k = 0; k < effects.size(); ++k) {
      EXPECT_GE(effects[k].p, 0.0);
      EXPECT_LE(effects[k].p, k == 0 ? 1.0 + 1e-12 : effects[k - 1].p);
    }
  }
  // At last, what the posterior has.
  const std::vector<double>& p = found.posterior.family;
  const auto effects = static_cast<std::ptrdiff_t>(found.problem->effects);
  EXPECT_EQ(told.back().front().p, *std::max_element(p.begin(), p.begin() + effects));
}

// Effects with inputs of any form among them, the columns of an effect, its shapes; values that the model holds.
TEST(Prior, sums_to_one) {
  const Inference found = weighed_by(made::by_speed(), made::drift({0.0, 1, 200}));
  const Problem& problem = *found.problem;
  ASSERT_FALSE(problem.held.empty());
  const Identities identities =
      identities_of(problem, found.posterior.linearisations.front(), std::vector<double>(problem.held.size(), 2.0));
  double sum = 0.0;
  for (const double one : identities.log_prior) sum += std::exp(one);
  EXPECT_NEAR(sum, 1.0, 1e-9);
  for (const Family& family : problem.library.families) {
    double shapes = 0.0;
    for (std::size_t i = family.first; i < family.first + family.count; ++i)
      shapes += std::exp(problem.log_prior_of_shape[i]);
    EXPECT_NEAR(shapes, 1.0, 1e-9) << label_of(family.bound);
  }
}

// Without what the data do not have, such as pairs, the shares of the others are larger.
TEST(Prior, has_columns_alike_and_the_effects_of_one_alike) {
  const Inference found = weighed_by(made::by_speed(), made::drift({0.0, 1, 200}));
  const Problem& problem = *found.problem;
  std::map<std::string, double> of_column;
  std::map<std::string, std::vector<double>> of_effects;
  double pairs = 0.0, forms = 0.0;
  for (std::size_t f = 0; f < problem.library.families.size(); ++f) {
    const BoundEffect& bound = problem.library.families[f].bound;
    const double p = std::exp(problem.log_prior[f]);
    if (f >= problem.effects) {
      forms += p;
    } else if (bound.columns.size() > 1) {
      pairs += p;
    } else {
      const std::string column = bound.columns.empty() ? "" : bound.columns.front();
      of_column[column] += p;
      of_effects[column].push_back(p);
    }
  }
  EXPECT_NEAR(forms, 0.05, 1e-9);
  EXPECT_NEAR(pairs, 0.95 * 0.1, 1e-9);
  ASSERT_GT(of_column.size(), 2U);
  for (const auto& [column, p] : of_column) {
    EXPECT_NEAR(p, 0.95 * 0.9 / static_cast<double>(of_column.size()), 1e-9) << column;
    for (const double one : of_effects[column]) EXPECT_NEAR(one, of_effects[column].front(), 1e-12) << column;
  }
}

// P of every effect from 1 %.
std::map<std::string, double> probabilities(const Model& model, const Series& data) {
  const Diagnosis found = diagnose(model, data);
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
  const Diagnosis here = diagnose(made::by_speed(), data());
  for (const double more_um : {1e4, 1e6}) {
    Series further = data();
    for (double& value : further.columns.back().values) value += more_um;
    expect_same(probabilities(made::by_speed(), data()), probabilities(made::by_speed(), further), 0.01);
    const Diagnosis there = diagnose(made::by_speed(), further);
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
