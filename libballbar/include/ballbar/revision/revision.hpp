// The ledger of a model: one row per revision, with the change, its benefit and the evidence for it.
//
// A smaller error alone is no evidence. Every row therefore has 2 ln B and its threshold, as far as these are known.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/fit/fit.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

// NaN: not known.
inline constexpr std::string_view kNotSupported = "not supported";

struct LedgerRow {
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::size_t revision = 0;  // 0: the model as it started
  // "+ lagged_expansion(T_air_degC), - speed_heating(speed_rpm)"; "= expansion(T_air_degC).gain_um_per_K 3.2 held"
  std::string change = "start";
  Level level = Level::series;         // of the model
  std::string target;                  // to which the figures refer
  std::vector<std::string> data;       // file names as given
  std::size_t parameters = 0;          // free ones
  double rmse_um = 0.0;                // of the fit to all rows
  double times_floor = kUnknown;       // RMSE over the floor
  double held_out_um = kUnknown;       // RMSE of left-out cycles (recordings), each predicted from the others
  double likelihood_ratio = kUnknown;  // 2 ln B of the change (revision.hpp)
  double threshold = kUnknown;         // of the likelihood ratio
  double forecast_um = kUnknown;       // RMSE of rows forecast from earlier rows (growth.hpp)
  double discrepancy_um = kUnknown;    // grown models: standard deviation of the slow part of the residual
  // "start", "named", "supported", "time only", "not supported". Grown models: "driver known" (the driver is known, its
  // form is not), "empirical" (it predicts, without a claimed cause). "by hand": the user's choice, not tested.
  std::string verdict = "start";
  std::vector<std::string> still_needed, no_longer_needed;  // labels of earlier effects after this revision
};

// The row of a model fitted to all rows. held_out_um leaves out the stretches between changes of speed, or fifths of
// the time without a speed, with the noise of the model itself. Series with more than 1000 values of the target use
// every second, third ... value for it. The other members have their default values.
LedgerRow row_of(const Model& model, const Series& data, std::size_t target = 0);

// Whether the likelihood ratio is chi^2 of errors of linear axes (revision.hpp). Their thresholds are quantiles,
// those of 2 ln B multiples of kLeastLikelihoodRatio.
bool is_of_axes(const LedgerRow& row);

// ---- Tests effects added to a model (workbench.hpp): before, after, and whether the data support them.
//
//   2 ln B             2 ln of how much more likely the readings are with an effect than without, its gains and shapes
//                      and the noise integrated out, as diagnose() weighs it (diagnose.hpp)
//   P superfluous      of an effect of the model: 1 / (1 + B); it is needed below 0.05
//
// An added effect is supported if 2 ln B is at least 10, its gain is equal in all cycles (p >= 0.01), and it does not
// depend on time alone. The test assumes that the other effects of the most probable set of diagnose() with these
// effects are missing as well, so that both report the same figures; a large missing effect would otherwise hide a
// small one. If that set has another value of a held parameter, the test frees it. Earlier effects are tested without
// these assumptions. This is valid for an effect chosen before looking at these data. Use diagnose() to search the data
// for an effect. The shapes of the added effects start at their most likely values, so that a fit of the model equals
// the reported fit. For long series all figures but those of the ledger rows use every second, third ... value, as in
// diagnose().
//
// Errors of linear axes on recordings are tested together with all other errors of the axes: chi^2 replaces 2 ln B, and
// an error is needed if its p-value is below 0.001 (machine_errors.hpp).

// The test of an effect of the model by leaving it out.
struct DropTest {
  std::size_t term = 0;  // of the model
  std::string label;
  std::size_t parameters = 0;     // free ones
  double likelihood_ratio = 0.0;  // 2 ln B
  double p = 1.0;                 // probability that it is not needed
  bool needed = true;
};

// A parameter that the model holds and the test frees.
struct FreedParameter {
  std::string effect;     // label of the term
  std::string parameter;  // "gain_um_per_K"

  friend bool operator==(const FreedParameter&, const FreedParameter&) = default;
};

struct EffectTest {
  Model model;  // with the effects added
  Fit fit_before, fit_after;
  LedgerRow before, after;          // `after` has change, likelihood ratio, verdict, effects still needed
  std::vector<Candidate> added;     // each with the rest of the model, and with the effects `beside` it
  std::vector<std::string> beside;  // labels of effects that are not in the model and assumed missing in the test
  std::optional<FreedParameter> freed;
  // Parameters of the model with the effects, from the likelihood used for `added`. Empty if no effect could be tested,
  // if the test assumes further effects or frees a value, and after pruning.
  std::vector<FittedParameter> parameters;
  std::vector<DropTest> earlier;
};

// Tests every effect among the first `count` terms of the model, except base effects and effects whose parameters are
// all held.
std::vector<DropTest> drop_tests(const Model& model, std::size_t count, const Series& data, std::size_t target = 0);

// Removes effects that are not needed: the least needed one first, then tests the rest again. The effects just added
// stay. Change, figures and effects still needed are then those of the smaller model.
struct Pruned {
  EffectTest effect_test;
  std::vector<std::size_t> removed;  // rising indices into the terms of the earlier model
};
Pruned pruned(EffectTest effect_test, const Series& data, std::size_t target = 0);

// ---- Effects of a model that other effects explain better. Each effect becomes a hypothesis again when the model
// grows.

// An effect that other effects replace: a diagnosis of the model without it names the others and not this one.
struct Replacement {
  std::size_t term = 0;  // of the model
  std::string label;     // of that term
  double p = 0.0;        // probability that it is missing from the model without it
  Diagnosis without;     // of the model without it; `named` holds the others
};

// terms: indices of the terms to examine, one by one. Base effects and terms with all parameters held are skipped.
// Throws Error as diagnose() does.
std::vector<Replacement> replacements(const Model& model, std::span<const std::size_t> terms, const Series& data,
                                      std::size_t target, const DiagnosisOptions& options);

}  // namespace ballbar
