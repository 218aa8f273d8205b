// An effect that the library does not have: fitted, searched, named, injected and run live as those of the catalogue.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "ballbar/circle/recording.hpp"
#include "ballbar/compensation/compensation.hpp"
#include "ballbar/diagnosis/signatures/search.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/error.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/internal/diagnosis/injection/injection.hpp"
#include "ballbar/internal/model/effect_argument.hpp"
#include "ballbar/internal/model/recording_base_model.hpp"
#include "ballbar/model/model.hpp"
#include "diagnosis/outcome.hpp"

namespace ballbar {
namespace {

// gain x, x_i = x_(i-1) + share (u_i - x_(i-1)), x_0 = 0, u the load since the first row; p: gain, share.
void evaluate(const EffectRows& rows, const double* p, double* values, double* derivatives) {
  double x = 0.0, slope = 0.0;  // slope: dx / dshare
  for (std::size_t i = 0; i < rows.time_s.size(); ++i) {
    const double u = rows.inputs[0][i] - rows.inputs[0][0];
    if (i > 0) {
      slope += (u - x) - p[1] * slope;
      x += p[1] * (u - x);
    }
    values[i] = p[0] * x;
    if (derivatives == nullptr) continue;
    derivatives[2 * i] = x;
    derivatives[2 * i + 1] = p[0] * slope;
  }
}

void evaluate_rows(const EffectRows& rows, std::size_t begin, std::size_t end, const double* p, double* kept,
                   double* values) {
  for (std::size_t i = begin; i < end; ++i) {
    if (i == 0) kept[0] = 0.0;
    if (i > 0) kept[0] += p[1] * (rows.inputs[0][i] - rows.inputs[0][0] - kept[0]);
    values[i - begin] = p[0] * kept[0];
  }
}

// Halved from the whole way in one row to the whole way in all of them.
std::vector<double> shares(const EffectRows& rows, double, double, std::size_t most) {
  std::vector<double> grid;
  for (double share = 1.0; share * static_cast<double>(rows.time_s.size()) > 1.0 && grid.size() < most; share /= 2.0) {
    grid.push_back(share);
  }
  return grid;
}

// Only the pump's load; a load of the spindle is load_heating's.
Effect hose_creep() {
  Effect effect;
  effect.name = "hose_creep";
  effect.explanation.summary = "A hose under pressure pulls at the head.";
  effect.inputs = {
      {"pump", {"W"}, "power of the pump", [](const Column& column) { return column.name.starts_with("pump"); }}};
  effect.parameters = {
      {"gain_um_per_W", "um/W", ParameterKind::gain, 0.0, -10.0, 10.0, {}, "for one watt in the end"},
      {"share", "1", ParameterKind::shape, 0.5, 1e-4, 1.0, {}, "of the way, a row", false, ShapeOf::curve, shares}};
  effect.evaluate = {evaluate, evaluate_rows, 1};
  return effect;
}

const Catalogue& with_hose_creep() {
  static const Catalogue kCatalogue = [] {
    Catalogue catalogue = built_in_catalogue();
    catalogue.push_back(std::make_shared<const Effect>(hose_creep()));
    return catalogue;
  }();
  return kCatalogue;
}

// A pump of 0 to 300 W that is switched at moments of its own, and a cutting load; noise AR(1) 0.8 of 0.3 um.
Series made(double gain_um_per_W) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Series data;
  Column room{"T_room_degC", Role::ambient, {}}, pump{"pump_W", Role::load, {}}, load{"spindle_W", Role::load, {}},
      target{"z_um", Role::measured, {}};
  double noise = 0.0;
  for (int i = 0; i < 400; ++i) {
    data.time_s.push_back(100.0 * i);
    room.values.push_back(22.0 + 0.8 * std::sin(0.03 * i));
    pump.values.push_back(100.0 * ((i * i / 900) % 4));
    load.values.push_back(500.0 * ((i / 37) % 2));
    noise = 0.8 * noise + 0.6 * 0.3 * normal(random);
    target.values.push_back(2.0 * (room.values.back() - 22.0) + noise);
  }
  data.columns = {room, pump, load, target};
  const std::vector<double> parameters{gain_um_per_W, 0.2};
  std::vector<double> hidden(data.time_s.size());
  evaluate({data.time_s, {pump.values}}, parameters.data(), hidden.data(), nullptr);
  for (std::size_t i = 0; i < hidden.size(); ++i) data.columns.back().values[i] += hidden[i];
  return data;
}

Model by_room() {
  Model model;
  model.targets = {"z_um"};
  model.terms = {term_of("expansion", {"T_room_degC"})};
  return model;
}

DiagnosisOptions quick(const Catalogue& catalogue) {
  DiagnosisOptions options;
  options.search.catalogue = catalogue;
  return options;
}

// The shape is found from its own grid: its start is far off.
TEST(outside_effect, is_fitted) {
  const Series data = made(0.02);
  Model model = by_room();
  model.terms.push_back(term_from_text("hose_creep", model, data, with_hose_creep()));
  EXPECT_EQ(label_of(model.terms.back()), "hose_creep(pump_W)");
  const Fit found = fit(model, data);
  const FittedParameter &gain = found.parameters[2], &share = found.parameters[3];
  EXPECT_EQ(gain.name, "gain_um_per_W");
  EXPECT_NEAR(gain.value, 0.02, 4.0 * gain.sigma);
  EXPECT_LT(gain.sigma, 0.002);
  EXPECT_NEAR(share.value, 0.2, 4.0 * share.sigma);
  EXPECT_LT(share.sigma, 0.05);
}

TEST(outside_effect, is_known_by_no_other_catalogue) {
  EXPECT_EQ(find_effect("hose_creep", Level::series), nullptr);
  EXPECT_THROW(term_of("hose_creep", {"pump_W"}), Error);
  EXPECT_EQ(built_in_catalogue().size() + 1, with_hose_creep().size());
}

TEST(outside_effect, is_told_of_before_the_residual_is_looked_at) {
  const Preflight found = preflight(by_room(), made(0.0), 0, std::nullopt, with_hose_creep());
  ASSERT_FALSE(found.detectability.empty());
  const Detectability& own = found.detectability.back();
  EXPECT_EQ(own.effect->name, "hose_creep");
  EXPECT_EQ(own.testability, Testability::testable);
  EXPECT_EQ(own.bindings, 1U);  // not the spindle's load
  EXPECT_EQ(own.columns, std::vector<std::string>{"pump_W"});
  EXPECT_GT(own.detectable_um, 0.0);
}

TEST(outside_effect, is_found_where_its_catalogue_is_searched) {
  const Series data = made(0.02);
  const Diagnosis found = diagnose(by_room(), data, 0, quick(with_hose_creep()));
  ASSERT_FALSE(found.drivers.empty());
  EXPECT_EQ(found.drivers.front().column, "pump_W");
  ASSERT_FALSE(found.effects.empty());
  EXPECT_EQ(label_of(found.effects.front().bound), "hose_creep(pump_W)");
  EXPECT_GT(found.effects.front().p, 0.99);
  const Diagnosis without = diagnose(by_room(), data, 0, quick(built_in_catalogue()));
  for (const EffectProbability& one : without.effects) EXPECT_NE(one.bound.effect->name, "hose_creep");
}

// Its grid is halved from point to point, and the truth lies between two of them.
TEST(outside_effect, is_named_alone) {
  const Diagnosis found = diagnose(by_room(), made(0.02), 0, quick(with_hose_creep()));
  EXPECT_EQ(found.verdict, Verdict::named) << made::outcome_of(found);
  ASSERT_EQ(found.named.size(), 1U);
  EXPECT_EQ(label_of(found.named.front()), "hose_creep(pump_W)");
  EXPECT_TRUE(found.equivalent.empty());
}

TEST(outside_effect, is_injected_and_seen) {
  const Series data = made(0.0);
  const BoundEffect bound{find_effect("hose_creep", Level::series, with_hose_creep()), {"pump_W"}};
  const Injection injection = injection_of(bound, data);
  EXPECT_EQ(injection.parameters, (std::vector{1.0, 0.5}));
  const Series changed = injected(data, "z_um", injection, 6.0);
  const Diagnosis found = diagnose(by_room(), changed, 0, quick(with_hose_creep()));
  EXPECT_EQ(sight_of(found, bound), Sight::named);
}

TEST(outside_effect, runs_live) {
  const Series data = made(0.02);
  Model model;
  model.targets = {"z_um"};
  model.constant_um = 0.0;
  model.terms = {term_of("hose_creep", {"pump_W"}, Level::series, with_hose_creep())};
  model.terms[0].settings[0] = {true, 0.02, -10.0, 10.0, true};
  model.terms[0].settings[1] = {true, 0.2, 1e-4, 1.0, true};
  const std::vector<double>& pump_W = find_column(data, "pump_W")->values;
  std::vector<double> whole(data.time_s.size());
  const std::vector<double> parameters{0.02, 0.2};
  evaluate({data.time_s, {pump_W}}, parameters.data(), whole.data(), nullptr);
  LiveModel live(model);
  CompensationLimits limits;
  limits.rate_um_per_s = limits.step_um = 1e3;
  Compensator compensator(model, limits);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    EXPECT_EQ(live.next(data.time_s[i], {{pump_W[i]}}), whole[i]) << "row " << i;
    const Offset offset = compensator.next(data.time_s[i], {{pump_W[i]}});
    EXPECT_EQ(offset.hold, Hold::none);
    EXPECT_NEAR(offset.offset_um, -whole[i], 0.1) << "row " << i;  // to one increment of 0.1 um
  }
}

TEST(outside_effect, recordings_need_a_base) { EXPECT_THROW(recording_base_model(Series{}, Catalogue{}), Error); }

}  // namespace
}  // namespace ballbar
