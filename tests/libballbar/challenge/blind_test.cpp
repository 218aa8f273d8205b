#include "ballbar/lab/challenge/blind.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <map>

#include "ballbar/fit/fit.hpp"
#include "noise/whitening.hpp"

namespace ballbar {
namespace {

constexpr BlindKind kAll[] = {BlindKind::nothing, BlindKind::one,         BlindKind::two,
                              BlindKind::outside, BlindKind::inseparable, BlindKind::spindle};

const Column& target_of(const BlindSet& set) { return *find_column(set.data, set.model.targets.front()); }

// Sets short enough for dense algebra.
const BlindSet& short_set(BlindKind kind) {
  static std::map<BlindKind, BlindSet> sets;
  for (std::uint64_t seed = 1; sets.count(kind) == 0; ++seed) {
    BlindSet set = blind_set(kind, seed);
    if (set.data.time_s.size() <= 700) sets.emplace(kind, std::move(set));
  }
  return sets.at(kind);
}

TEST(Blind, TheSameSeedIsTheSameSet) {
  for (const BlindKind kind : kAll) {
    const BlindSet once = blind_set(kind, 5), again = blind_set(kind, 5), other = blind_set(kind, 6);
    EXPECT_EQ(target_of(once).values, target_of(again).values) << name_of(kind);
    EXPECT_EQ(once.answer.what, again.answer.what) << name_of(kind);
    EXPECT_EQ(once.answer.kind, kind);
    EXPECT_NE(target_of(once).values, target_of(other).values) << name_of(kind);
  }
}

// 2000 draws: the standard deviation of a share of 0.3 is 0.01.
TEST(Blind, KindsAreDrawnAsOftenAsStated) {
  std::map<BlindKind, double> share;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) share[blind_kind(seed)] += 1.0 / 2000.0;
  EXPECT_NEAR(share[BlindKind::nothing], 0.20, 0.03);
  EXPECT_NEAR(share[BlindKind::one], 0.30, 0.03);
  EXPECT_NEAR(share[BlindKind::two], 0.15, 0.03);
  EXPECT_NEAR(share[BlindKind::outside], 0.15, 0.03);
  EXPECT_NEAR(share[BlindKind::inseparable], 0.10, 0.03);
  EXPECT_NEAR(share[BlindKind::spindle], 0.10, 0.03);
}

TEST(Blind, NamesOfKindsReadBack) {
  for (const BlindKind kind : kAll) EXPECT_EQ(blind_kind_from_name(name_of(kind)), kind);
  EXPECT_EQ(blind_kind_from_name("three"), std::nullopt);
}

// Without noise and what is hidden the model leaves nothing: 1e-3 um is the solver's tolerance on some 30 um.
TEST(Blind, TheBaseModelIsRight) {
  for (const BlindKind kind : kAll) {
    const BlindSet& set = short_set(kind);
    Series clean = set.data;
    clean.columns.back().values = set.clean_um;
    EXPECT_LT(fit(set.model, clean, 0, {.white = true}).rmse_um, 1e-3) << name_of(kind);
  }
}

// What is neither the base model's nor hidden is noise of the stated kind: whitened, its mean square is 1. 0.35: a
// short set has some 200 rows, and the square of a Student's t with 4 degrees of freedom scatters without bounds.
TEST(Blind, TheRestIsNoise) {
  for (const BlindKind kind : kAll) {
    const BlindSet& set = short_set(kind);
    std::vector<double> rest = target_of(set).values;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      rest[i] -= set.clean_um[i];
      for (const std::vector<double>& hidden : set.hidden_um) rest[i] -= hidden[i];
    }
    const Whitening whitening(set.noise, set.data.time_s, {});
    whitening.apply(rest.data(), 1, rest.data(), 1);
    double square = 0.0;
    for (const double value : rest) square += value * value / static_cast<double>(rest.size());
    EXPECT_NEAR(square, 1.0, 0.35) << name_of(kind) << " " << rest.size();
  }
  EXPECT_TRUE(short_set(BlindKind::nothing).hidden_um.empty());
  EXPECT_TRUE(short_set(BlindKind::nothing).answer.hidden.empty());
}

// d^2 = g' C^-1 g - g' C^-1 J (J' C^-1 J)^-1 J' C^-1 g, the covariance C written out: w^2 I + q^2 exp(-|t_i - t_j| /
// theta).
TEST(Blind, HiddenSignalsHaveTheirD) {
  for (const BlindKind kind : {BlindKind::one, BlindKind::two, BlindKind::outside, BlindKind::spindle}) {
    const BlindSet& set = short_set(kind);
    const auto n = static_cast<Eigen::Index>(set.data.time_s.size());
    Eigen::MatrixXd covariance(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const double apart_s =
            std::abs(set.data.time_s[static_cast<std::size_t>(i)] - set.data.time_s[static_cast<std::size_t>(j)]);
        covariance(i, j) =
            set.noise.correlated_um * set.noise.correlated_um * std::exp(-apart_s / set.noise.correlation_time_s);
      }
      covariance(i, i) += set.noise.white_um * set.noise.white_um;
    }
    Series clean = set.data;
    clean.columns.back().values = set.clean_um;
    const Fit base = fit(set.model, clean, 0, {.white = true});
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < base.jacobian.cols(); ++k) {
      if (base.parameters[static_cast<std::size_t>(k)].state == ParameterState::free) free.push_back(k);
    }
    const Eigen::MatrixXd j = base.jacobian(Eigen::all, free);
    const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
    const Eigen::MatrixXd cj = factor.solve(j);
    ASSERT_EQ(set.hidden_um.size(), set.answer.d.size());
    ASSERT_FALSE(set.hidden_um.empty());
    for (std::size_t k = 0; k < set.hidden_um.size(); ++k) {
      const Eigen::VectorXd g = Eigen::Map<const Eigen::VectorXd>(set.hidden_um[k].data(), n);
      const Eigen::VectorXd jcg = cj.transpose() * g;
      const double square = g.dot(factor.solve(g)) - jcg.dot((j.transpose() * cj).ldlt().solve(jcg));
      EXPECT_NEAR(std::sqrt(square), set.answer.d[k], 0.02 * set.answer.d[k]) << name_of(kind);
      EXPECT_GE(set.answer.d[k], 6.0);
      EXPECT_LE(set.answer.d[k], 20.0);
    }
  }
}

TEST(Blind, WhatIsHiddenIsLogged) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    for (const BlindKind kind : {BlindKind::one, BlindKind::two, BlindKind::inseparable}) {
      const BlindSet set = blind_set(kind, seed);
      EXPECT_EQ(set.answer.hidden.size(), kind == BlindKind::two ? 2U : 1U);
      for (const BoundEffect& bound : set.answer.hidden) {
        EXPECT_FALSE(bound.effect->time_only);
        for (const std::string& column : bound.columns) EXPECT_NE(find_column(set.data, column), nullptr) << column;
      }
      expect_suits(set.model, set.data);
    }
  }
}

BoundEffect effect(std::string_view name, std::vector<std::string> columns) {
  return {find_effect(name, Level::series), std::move(columns)};
}

struct Said {
  Verdict verdict;
  std::vector<BoundEffect> named, reported;
  BlindOutcome outcome;
};

void expect_outcomes(const BlindAnswer& answer, const std::vector<Said>& table) {
  for (std::size_t i = 0; i < table.size(); ++i) {
    EXPECT_EQ(name_of(outcome_of(answer, {table[i].verdict, table[i].named, table[i].reported})),
              name_of(table[i].outcome))
        << name_of(answer.kind) << ", row " << i;
  }
}

TEST(Blind, OutcomesAreAsTheTableSays) {
  const BoundEffect room = effect("lagged_expansion", {"T_room_degC"}), head = effect("expansion", {"T_head_degC"});
  const BoundEffect shift = effect("centrifugal_shift", {"speed_rpm"});
  const BoundEffect room_anywhere = effect("lagged_expansion", {});
  using enum Verdict;
  const Verdict none = Verdict::nothing;
  expect_outcomes({.kind = BlindKind::nothing}, {{none, {}, {}, BlindOutcome::right},
                                                 {untestable, {}, {}, BlindOutcome::right},
                                                 {unexplained, {}, {}, BlindOutcome::wrong},
                                                 {equivalent, {}, {room, head}, BlindOutcome::wrong},
                                                 {named, {room}, {}, BlindOutcome::wrong}});
  expect_outcomes({.kind = BlindKind::one, .hidden = {room}}, {{named, {room}, {}, BlindOutcome::right},
                                                               {named, {room_anywhere}, {}, BlindOutcome::right},
                                                               {named, {room}, {head}, BlindOutcome::in_set},
                                                               {named, {room, shift}, {}, BlindOutcome::wrong},
                                                               {named, {head}, {room}, BlindOutcome::wrong},
                                                               {equivalent, {}, {room, head}, BlindOutcome::in_set},
                                                               {equivalent, {}, {head, shift}, BlindOutcome::missed},
                                                               {unexplained, {}, {}, BlindOutcome::missed},
                                                               {none, {}, {}, BlindOutcome::missed}});
  expect_outcomes({.kind = BlindKind::two, .hidden = {room, shift}}, {{named, {shift, room}, {}, BlindOutcome::right},
                                                                      {named, {room}, {}, BlindOutcome::missed},
                                                                      {named, {room}, {shift}, BlindOutcome::in_set}});
  expect_outcomes({.kind = BlindKind::outside}, {{unexplained, {}, {}, BlindOutcome::right},
                                                 {equivalent, {}, {room}, BlindOutcome::missed},
                                                 {none, {}, {}, BlindOutcome::missed},
                                                 {named, {room}, {}, BlindOutcome::wrong}});
  expect_outcomes({.kind = BlindKind::inseparable, .hidden = {room}},
                  {{equivalent, {}, {room, head}, BlindOutcome::right},
                   {untestable, {}, {}, BlindOutcome::right},
                   {equivalent, {}, {head}, BlindOutcome::missed},
                   {none, {}, {}, BlindOutcome::missed},
                   {named, {room}, {}, BlindOutcome::wrong}});
  expect_outcomes({.kind = BlindKind::spindle, .match = {room, head}},
                  {{named, {head}, {}, BlindOutcome::right},
                   {named, {room, head}, {}, BlindOutcome::right},
                   {equivalent, {}, {shift, head}, BlindOutcome::in_set},
                   {unexplained, {}, {}, BlindOutcome::missed},
                   {named, {head, shift}, {}, BlindOutcome::wrong}});
}

// 1 of 5: centre (0.2 + 3.8415 / 10) / 1.76829 = 0.33034, half 1.95996 sqrt(0.032 + 0.0384146) / 1.76829 = 0.29412.
TEST(Blind, SharesHaveWilsonsInterval) {
  const Share share = share_of(1, 5);
  EXPECT_NEAR(share.low, 0.03622, 1e-4);
  EXPECT_NEAR(share.high, 0.62446, 1e-4);
  EXPECT_EQ(share_of(0, 10).low, 0.0);
  EXPECT_NEAR(share_of(0, 10).high, 0.27754, 1e-4);  // z^2 / (n + z^2) = 3.84146 / 13.84146
  EXPECT_NEAR(share_of(10, 10).low, 0.72246, 1e-4);
  EXPECT_EQ(share_of(10, 10).high, 1.0);
  EXPECT_EQ(share_of(0, 0).low, 0.0);
  EXPECT_EQ(share_of(0, 0).high, 1.0);
}

TEST(Blind, ScoresCountEachKindWhereItBelongs) {
  const std::vector<BlindAnswer> answers{{.kind = BlindKind::nothing}, {.kind = BlindKind::nothing},
                                         {.kind = BlindKind::one},     {.kind = BlindKind::one},
                                         {.kind = BlindKind::outside}, {.kind = BlindKind::spindle}};
  const std::vector<BlindOutcome> outcomes{BlindOutcome::right,  BlindOutcome::wrong, BlindOutcome::right,
                                           BlindOutcome::missed, BlindOutcome::wrong, BlindOutcome::in_set};
  const Scores scores = scores_of(answers, outcomes);
  const auto text = [](const Share& share) { return std::to_string(share.count) + "/" + std::to_string(share.of); };
  EXPECT_EQ(text(scores.false_calls), "1/2");
  EXPECT_EQ(text(scores.right), "2/6");
  EXPECT_EQ(text(scores.wrong), "2/6");
  EXPECT_EQ(text(scores.in_set), "2/3");
  EXPECT_EQ(text(scores.false_names), "1/1");
}

}  // namespace
}  // namespace ballbar
