#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "ballbar/drift/compare.hpp"
#include "drift/slope_of_rows.hpp"
#include "numerics/random_streams.hpp"

namespace ballbar {
namespace {

using Values = std::vector<double>;
constexpr std::size_t kOffset = 0, kGain = 1, kLag = 2, kDrift = 3;
constexpr double kStep_s = 300.0;

// A warm-up of 40 samples with a stop in it, um.
double warm_up(double time_s) {
  const double min = time_s / 60.0;
  return 20.0 * (1.0 - std::exp(-min / 30.0)) - (min > 100.0 ? 12.0 * (1.0 - std::exp(-(min - 100.0) / 20.0)) : 0.0);
}

struct Difference {
  double offset = 0.0, gain = 1.0, lag_s = 0.0, per_h = 0.0;
};

struct Noise {
  double a = 0.1, b = 0.15;
};

// Rows as two instruments see the warm-up: each reading with its own error, each change with that of its first reading.
DifferenceRows seen(const Difference& made, const Noise& noise, std::mt19937_64& random, std::size_t count = 41) {
  DifferenceRows rows;
  Values a, b;
  for (std::size_t i = 0; i < count; ++i) {
    const double time_s = kStep_s * static_cast<double>(i);
    rows.time_s.push_back(time_s);
    a.push_back(warm_up(time_s) + noise.a * simulation::normal(random));
    b.push_back((i > 0 ? made.offset : 0.0) + made.gain * (warm_up(time_s + made.lag_s) - warm_up(0.0)) +
                made.per_h * time_s / 3600.0 + noise.b * simulation::normal(random));
  }
  for (std::size_t i = 0; i < count; ++i) {
    rows.a.push_back(a[i] - a[0]);
    rows.b.push_back(b[i] - b[0]);
  }
  rows.variance_a.assign(count, noise.a * noise.a);
  rows.variance_b.assign(count, noise.b * noise.b);
  rows.reference_variance_a = noise.a * noise.a;
  rows.reference_variance_b = noise.b * noise.b;
  return rows;
}

std::mt19937_64 stream(std::string_view name) {
  return simulation::stream_of(1, simulation::Stream::probe, simulation::key_of(name));
}

struct Alarms {
  int parts = 0, together = 0;
};

// Of 1000 pairs that do not differ: how many name a part, and how many stand out by all four together or one alone.
template <class Rows>
Alarms alarms_of(std::string_view name, const Rows& rows_of) {
  std::mt19937_64 random = stream(name);
  Alarms alarms;
  for (int draw = 0; draw < 1000; ++draw) {
    const DifferenceStructure found = judged(difference_structure(rows_of(random)).value(), 1);
    bool any = false;
    for (const std::optional<DifferencePart>& part : found.parts) any = any || (part && part->named);
    alarms.parts += any ? 1 : 0;
    alarms.together += found.stands_out && !any ? 1 : 0;
  }
  testing::Test::RecordProperty("parts", alarms.parts);
  testing::Test::RecordProperty("together", alarms.together);
  return alarms;
}

// 10 of 1000 expected at most; three standard deviations of that, sqrt(10), more.
constexpr int kMostAlarms = 19;

// a 0 1 2 3 4 5 6 7 8, b 0 1 3 2 5 4 7 8 6, the first the zero, equal variances. Sums over the other eight: aa 204, bb
// 204, ab 1 6 6 20 20 42 56 48 = 199. Deming through the zero, equal variances: gain = (bb - aa + sqrt((bb - aa)^2 + 4
// ab^2)) / (2 ab) = 1. With b doubled: bb = 816, ab = 398: gain = (612 + sqrt(612^2 + 4 398^2)) / 796.
TEST(difference_structure, deming_with_equal_variances_by_hand) {
  DifferenceRows rows;
  rows.a = {0, 1, 2, 3, 4, 5, 6, 7, 8};
  rows.b = {0, 1, 3, 2, 5, 4, 7, 8, 6};
  for (std::size_t i = 0; i < rows.a.size(); ++i) rows.time_s.push_back(60.0 * static_cast<double>(i));
  rows.variance_a = rows.variance_b = Values(rows.a.size(), 0.01);
  const auto gain_alone = [&] { return difference_structure(rows).value().alone[kGain].value().value; };
  EXPECT_NEAR(gain_alone(), 1.0, 1e-8);
  for (double& b : rows.b) b *= 2.0;
  EXPECT_NEAR(gain_alone(), (612.0 + std::sqrt(612.0 * 612.0 + 4.0 * 398.0 * 398.0)) / 796.0, 1e-7);
}

// Parabola t^2 - 3 t in rows 1 s apart, then 2 s: slope 2 t - 3, exact. A zigzag's slope is nowhere that of its steps.
TEST(difference_structure, slopes_by_hand) {
  const Values time_s{0, 1, 2, 3, 5, 7}, zero(6, 0.0);
  Values value;
  for (const double t : time_s) value.push_back(t * t - 3.0 * t);
  const std::optional<Slopes> slopes = slopes_of_rows(time_s, value, zero);
  ASSERT_TRUE(slopes.has_value());
  for (std::size_t i = 0; i < time_s.size(); ++i) EXPECT_NEAR(slopes->per_s[i], 2.0 * time_s[i] - 3.0, 1e-12);
  EXPECT_FALSE(slopes_of_rows(time_s, Values{0, 5, 0, 5, 0, 5}, zero).has_value()) << "rows too sparse";
  EXPECT_FALSE(slopes_of_rows(Values{0, 1, 2, 3}, Values{0, 1, 2, 3}, Values(4, 0.0)).has_value()) << "4 rows";
}

TEST(difference_structure, false_alarms_are_at_most_those_stated) {
  const Alarms alarms = alarms_of("false_alarms", [](auto& random) { return seen({}, {}, random); });
  EXPECT_LE(alarms.parts, kMostAlarms);
  EXPECT_LE(alarms.together, kMostAlarms);
}

// The zero's error left out of V, each row's variance as large as stated: all four together, of which the offset is
// one, stand out far too often.
TEST(difference_structure, without_the_shared_error_alarms_are_many) {
  const Alarms alarms = alarms_of("false_alarms", [](auto& random) {
    DifferenceRows rows = seen({}, {}, random);
    for (double& variance : rows.variance_a) variance *= 2.0;
    for (double& variance : rows.variance_b) variance *= 2.0;
    rows.reference_variance_a = rows.reference_variance_b = 0.0;
    return rows;
  });
  EXPECT_GT(alarms.together, 100);
}

// A scale of 2 % on one side, stated as such, is no finding; left out it is one.
TEST(difference_structure, an_error_stated_for_all_rows_is_no_finding) {
  const auto rows_of = [](std::mt19937_64& random, bool stated) {
    DifferenceRows rows = seen({.gain = 1.0 + 0.02 * simulation::normal(random)}, {}, random);
    if (stated) rows.shared.push_back(rows.a);
    if (stated) {
      for (double& error : rows.shared[0]) error *= 0.02;
    }
    return rows;
  };
  const Alarms stated = alarms_of("stated_scale", [&](auto& random) { return rows_of(random, true); });
  EXPECT_LE(stated.parts, kMostAlarms);
  EXPECT_LE(stated.together, kMostAlarms);
  EXPECT_GT(alarms_of("stated_scale", [&](auto& random) { return rows_of(random, false); }).parts, 100);
}

TEST(difference_structure, false_alarms_where_no_sigma_is_stated) {
  for (const std::size_t count : {16U, 41U, 200U}) {
    const Alarms alarms = alarms_of("no_sigma_stated", [&](auto& random) {
      DifferenceRows rows = seen({}, {.a = 0.1, .b = 0.1}, random, count);
      rows.stated = false;
      return rows;
    });
    EXPECT_LE(alarms.parts, kMostAlarms) << count;
    EXPECT_LE(alarms.together, kMostAlarms) << count;
  }
}

// Sigma stated as half of what it is: widened from the rest.
TEST(difference_structure, false_alarms_where_sigma_is_stated_too_small) {
  const Alarms alarms = alarms_of("too_small", [](auto& random) {
    DifferenceRows rows = seen({}, {}, random);
    for (double& variance : rows.variance_a) variance /= 4.0;
    for (double& variance : rows.variance_b) variance /= 4.0;
    return rows;
  });
  EXPECT_LE(alarms.parts, kMostAlarms);
}

// Noise such that 4 % are 5 sigma with the other three free; 95 % named at least, at the limit for three axes, where
// 5 - 3.34 leaves 95.2 %. At the limit of one axis 97.6 %.
TEST(difference_structure, a_gain_of_5_sigma_is_named) {
  Noise noise;
  std::mt19937_64 random = stream("gain_of_5_sigma");
  for (int round = 0; round < 3; ++round) {
    double sigma = 0.0;
    for (int draw = 0; draw < 50; ++draw) {
      sigma += difference_structure(seen({.gain = 1.04}, noise, random)).value().parts[kGain].value().sigma / 50.0;
    }
    noise.a *= 0.04 / 5.0 / sigma;
    noise.b *= 0.04 / 5.0 / sigma;
  }
  int named = 0, within = 0;
  double sum = 0.0;
  for (int draw = 0; draw < 1000; ++draw) {
    const DifferenceStructure found = judged(difference_structure(seen({.gain = 1.04}, noise, random)).value(), 1);
    const DifferencePart& gain = found.parts[kGain].value();
    named += gain.named ? 1 : 0;
    within += std::abs(gain.value - 1.04) <= 2.0 * gain.sigma ? 1 : 0;
    sum += gain.value;
  }
  RecordProperty("named", named);
  EXPECT_GE(named, 950);
  EXPECT_GE(within, 930) << "95.4 % expected, 0.7 % its standard deviation";
  EXPECT_NEAR(sum / 1000.0, 1.04, 4.0 * 0.008 / std::sqrt(1000.0)) << "no bias";
}

TEST(difference_structure, a_lag_of_half_a_sample_is_named) {
  std::mt19937_64 random = stream("half_a_sample");
  int named = 0;
  double sum = 0.0;
  for (int draw = 0; draw < 200; ++draw) {
    const DifferenceStructure found =
        judged(difference_structure(seen({.lag_s = -kStep_s / 2.0}, {.a = 0.05, .b = 0.05}, random)).value(), 3);
    named += found.parts[kLag].value().named ? 1 : 0;
    sum += found.parts[kLag]->value / 200.0;
  }
  RecordProperty("named", named);
  EXPECT_GE(named, 190);
  EXPECT_NEAR(sum, -kStep_s / 2.0, 0.2 * kStep_s / 2.0) << "linearised";
}

TEST(difference_structure, each_of_the_four_with_its_sign) {
  const Noise little{.a = 0.01, .b = 0.01};
  std::mt19937_64 random = stream("each_of_the_four");
  const DifferenceStructure found =
      difference_structure(seen({.offset = 0.5, .gain = 0.95, .lag_s = 20.0, .per_h = -0.3}, little, random)).value();
  EXPECT_NEAR(found.parts[kOffset].value().value, 0.5, 0.1);
  EXPECT_NEAR(found.parts[kGain].value().value, 0.95, 0.005);
  EXPECT_NEAR(found.parts[kLag].value().value, 20.0, 4.0);
  EXPECT_NEAR(found.parts[kDrift].value().value, -0.3, 0.03);
}

// Through compare(): the kind that is named, and that a gain within the rule for single samples no longer agrees.
TEST(difference_structure, kind_of_each_difference) {
  struct {
    Difference made;
    std::optional<DifferenceKind> kind;
  } const cases[] = {
      {{}, std::nullopt},
      {{.gain = 1.04}, DifferenceKind::gain},
      {{.gain = 0.96}, DifferenceKind::gain},
      {{.lag_s = -100.0}, DifferenceKind::lag},
      {{.lag_s = 100.0}, DifferenceKind::lag},
      {{.offset = -1.0}, DifferenceKind::offset},
      {{.per_h = 0.4}, DifferenceKind::drift},
  };
  for (const auto& [made, kind] : cases) {
    std::mt19937_64 random = stream("conclusions");
    const DifferenceRows rows = seen(made, {.a = 0.05, .b = 0.05}, random);
    const auto side = [&](const char* what, const Values& value) {
      MeasuredDrift drift{what, "log", 0.0, rows.time_s, {}, {}};
      Values sigma(value.size(), 0.05 * std::numbers::sqrt2);
      sigma[0] = 0.0;
      drift.axes.push_back({"z", "um", value, {{"scatter", sigma}}});
      return drift;
    };
    const Comparison found = compare(side("a", rows.a), side("b", rows.b));
    const DifferenceStructure& structure = found.axes.front().structure.value();
    EXPECT_EQ(structure.stands_out, kind.has_value());
    EXPECT_EQ(found.axes.front().agreement, kind ? Agreement::disagrees : Agreement::agrees);
    if (!kind) continue;
    const std::vector<DifferenceKind> alone = sufficient_alone(structure), named = named_differences(structure);
    EXPECT_EQ(alone.size() == 1 ? alone.front() : named.at(0), *kind);
  }
}

// Two axes that are late by the same time: one clock.
TEST(difference_structure, one_clock_of_all_axes) {
  std::mt19937_64 random = stream("one_clock");
  const auto lag_of = [&](const Difference& x, const Difference& y) {
    MeasuredDrift a, b;
    for (const auto& [name, made] : {std::pair{"x", x}, std::pair{"y", y}}) {
      const DifferenceRows rows = seen(made, {.a = 0.05, .b = 0.05}, random);
      Values sigma(rows.a.size(), 0.05 * std::numbers::sqrt2);
      sigma[0] = 0.0;
      a.time_s = b.time_s = rows.time_s;
      a.axes.push_back({name, "um", rows.a, {{"scatter", sigma}}});
      b.axes.push_back({name, "um", rows.b, {{"scatter", sigma}}});
    }
    return common_lag(compare(a, b));
  };
  const CommonLag late = lag_of({.lag_s = -200.0}, {.lag_s = -200.0}).value();
  EXPECT_NEAR(late.lag_s, -200.0, 30.0);
  EXPECT_EQ(late.axes, (std::vector<std::string>{"x", "y"}));
  EXPECT_FALSE(lag_of({.gain = 1.04}, {.gain = 1.04}).has_value());
  EXPECT_FALSE(lag_of({.lag_s = -300.0}, {.lag_s = 300.0}).has_value());
}

// A straight line: scale and drift are the same thing, a lag is an offset.
TEST(difference_structure, what_cannot_be_told_apart_is_not_told) {
  std::mt19937_64 random = stream("cannot_be_told");
  DifferenceRows rows = seen({}, {.a = 0.02, .b = 0.02}, random);
  for (std::size_t i = 1; i < rows.time_s.size(); ++i) {
    const double line = rows.time_s[i] / 600.0;
    rows.a[i] = line + 0.02 * simulation::normal(random);
    rows.b[i] = 1.04 * line + 0.02 * simulation::normal(random);
  }
  const DifferenceStructure found = judged(difference_structure(rows).value(), 1);
  EXPECT_FALSE(found.parts[kGain].has_value() && found.parts[kGain]->named);
  EXPECT_TRUE(found.stands_out);
  EXPECT_EQ(sufficient_alone(found), (std::vector{DifferenceKind::gain, DifferenceKind::drift}));
}

TEST(difference_structure, too_few_rows) {
  std::mt19937_64 random = stream("too_few_rows");
  EXPECT_FALSE(difference_structure(seen({}, {}, random, 6)).has_value());
  EXPECT_TRUE(difference_structure(seen({}, {}, random, 7)).has_value());
  DifferenceRows rows = seen({}, {}, random, 12);
  rows.stated = false;
  EXPECT_FALSE(difference_structure(rows).has_value());
}

}  // namespace
}  // namespace ballbar
