// What `add`, `undo` and `ledger` print with --json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/internal/predict/growth.hpp"
#include "ballbar/revision/revision.hpp"
#include "diagnose/doubt_text.hpp"
#include "diagnose/effect_test_text.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<LedgerRow> =
    ResultType("Figures", "How well a model does.", Field{"parameters", &LedgerRow::parameters, "free ones"},
               Field{"rmse_um", &LedgerRow::rmse_um, "of the fit to all rows"},
               Field{"times_floor", &LedgerRow::times_floor, "RMSE over the noise; null: not known"},
               Field{"held_out_um", &LedgerRow::held_out_um, "RMSE of cycles (recordings) left out; null: not known"});

// A row with its sentence.
struct LedgerEntry {
  LedgerRow row;
  Paragraph sentence;
};

struct Ledger {
  std::vector<LedgerEntry> rows;
};
// `before`: the row before the first; nullptr: none.
Ledger ledger_of(const std::vector<LedgerRow>& rows, const LedgerRow* before = nullptr);

inline constexpr FieldList kLedgerEntryEvidence{
    Field{"likelihood_ratio", &LedgerRow::likelihood_ratio, "2 ln B of the change, of errors of axes chi^2"},
    Field{"threshold", &LedgerRow::threshold, "from which that counts"}};

template <>
inline constexpr auto kResult<LedgerEntry> = ResultType(
    "LedgerRow", "A revision of a model: what it changed, and what that bought.",
    fields_of(&LedgerEntry::row, Field{"revision", &LedgerRow::revision, "0: the model as it started"},
              Field{"change", &LedgerRow::change, "+ what was added, - what was taken out, = what was set; start"},
              kResult<LedgerRow>.fields,
              Field{"verdict", &LedgerRow::verdict,
                    "start, named, supported, time only, not supported, driver known, empirical, by hand"},
              Field{"target", &LedgerRow::target, "which the figures are of"},
              Field{"data", &LedgerRow::data, "files, as they were named"}, kLedgerEntryEvidence,
              Field{"forecast_um", &LedgerRow::forecast_um, "RMSE of rows forecast from earlier ones alone"},
              Field{"discrepancy_um", &LedgerRow::discrepancy_um, "standard deviation of the slow curve that is left"},
              Field{"still_needed", &LedgerRow::still_needed, "earlier effects, tested anew"},
              Field{"no_longer_needed", &LedgerRow::no_longer_needed}),
    Field{"sentence", &LedgerEntry::sentence, "what it says in plain words"});

template <>
inline constexpr auto kResult<Ledger> = ResultType("Ledger", "The story of a model.",
                                                   Field{"rows", &Ledger::rows, "one row per revision"});

// An effect that was added for a test.
struct AddedEffect {
  BoundEffect bound;
  Candidate tried;
  std::vector<CandidateParameter> parameters;
};
std::vector<AddedEffect> added_effects(const EffectTest& effect_test);

template <>
inline constexpr auto kResult<AddedEffect> = ResultType(
    "AddedEffect", "An effect that was added for a test.", fields_of(&AddedEffect::bound),
    fields_of(&AddedEffect::tried,
              Field{"amplitude_um", &Candidate::amplitude_um, "largest less smallest of what it adds"},
              Field{"amplitude_sigma_um", &Candidate::amplitude_sigma_um, "null: not determined"},
              Field{"likelihood_ratio", &Candidate::likelihood_ratio,
                    "2 ln of how much likelier the readings are with it than without"},
              Field{"threshold", &Candidate::threshold, "from which that counts"},
              Field{"p_same_gain", &Candidate::p_same_gain, "of gains as different from cycle to cycle, by chance"}),
    Field{"time_only", [](const AddedEffect& of) { return of.bound.effect->time_only; },
          "whether it needs nothing but time"},
    Field{"doubts", [](const AddedEffect& of) { return doubts_of(of.tried); }, "why it is not supported"},
    Field{"parameters", &AddedEffect::parameters});

template <>
inline constexpr auto kResult<DropTest> = ResultType("EarlierEffect",
                                                     "An effect of the model, tested by leaving it out.",
                                                     Field{"effect", &DropTest::label, "with its columns"},
                                                     Field{"likelihood_ratio", &DropTest::likelihood_ratio, "2 ln B"},
                                                     Field{"parameters", &DropTest::parameters, "free ones"},
                                                     Field{"p_drop", &DropTest::p, "that it is not needed"},
                                                     Field{"needed", &DropTest::needed});

template <>
inline constexpr auto kResult<EffectTest> =
    ResultType("Tried", "A model before and after effects are added.",
               Field{"target", in(&EffectTest::after, &LedgerRow::target), "column that is explained"},
               Field{"data", in(&EffectTest::after, &LedgerRow::data), "files, as they were named"},
               Field{"before", &EffectTest::before, "how well the model does without them"},
               Field{"after", &EffectTest::after, "how well it does with them"},
               fields_of(&EffectTest::after, kLedgerEntryEvidence),
               Field{"verdict", in(&EffectTest::after, &LedgerRow::verdict), "supported, time only, not supported"},
               Field{"effects", &added_effects, "that were added"},
               Field{"beside", &EffectTest::beside, "other effects that the test assumes to be missing"},
               Field{"freed", &freed_text, "parameter that the model holds and the test frees; empty: none"},
               Field{"earlier", &EffectTest::earlier, "effects of the model, tested anew"},
               Field{"sentence", [](const EffectTest& of) { return conclusion(of); }, "what it says in plain words"});

// A model grown to predict, with so many effects.
struct GrowthStep {
  std::vector<std::string> added;
  bool kept = false;
  GrowthErrors errors;
};

template <>
inline constexpr auto kResult<GrowthStep> =
    ResultType("GrowthStep", "A model that grows by effects that predict, with so many of them.",
               Field{"added", &GrowthStep::added, "effects that join; empty: none, or not kept"},
               Field{"kept", &GrowthStep::kept, "whether it is in the model"},
               fields_of(&GrowthStep::errors, Field{"effects", &GrowthErrors::effects, "how many in all"},
                         Field{"rmse_um", &GrowthErrors::rmse_um, "of the rows it is fitted to"},
                         Field{"forecast_um", &GrowthErrors::forecast_um, "RMSE of forecasts; null: too few rows"},
                         Field{"forecast_mean_um", &GrowthErrors::forecast_mean_um, "their mean absolute error"},
                         Field{"apart_um", &GrowthErrors::apart_um,
                               "RMS of the forecasts less those of a regression on all effects"}));

// Why `add --auto` ended.
struct Stopped {
  Verdict verdict = Verdict::named;
  std::string text;
};

template <>
inline constexpr auto kResult<Stopped> = ResultType("Stopped", "Why nothing more was added.",
                                                    Field{"verdict", &Stopped::verdict, "of the last diagnosis"},
                                                    Field{"text", &Stopped::text});

struct Added {
  std::vector<LedgerEntry> rows;
  std::vector<EffectTest> revisions;
  std::optional<std::vector<GrowthStep>> growth;
  std::optional<std::string> sentence;
  std::optional<Stopped> stopped;
  std::optional<std::string> written;
  std::optional<std::string> text;
};

template <>
inline constexpr auto kResult<Added> =
    ResultType("Added", "New revisions of a model.", Field{"rows", &Added::rows, "of the ledger"},
               Field{"revisions", &Added::revisions, "before and after each"},
               Field{"growth", may_lack(&Added::growth), "of a model that grew by effects that predict"},
               Field{"sentence", may_lack(&Added::sentence), "what that growth says"},
               Field{"stopped", may_lack(&Added::stopped), "with --auto: why nothing more was added"},
               Field{"written", &Added::written, "file; null: nothing was added, or no file is named"},
               Field{"text", may_lack(&Added::text), "of the new model, where it has no file"});

struct Undone {
  std::string model;
  std::size_t revision = 0;
  std::string change;
  std::optional<std::string> text;
};

template <>
inline constexpr auto kResult<Undone> =
    ResultType("Undone", "A revision that was taken back.", Field{"model", &Undone::model, "file"},
               Field{"revision", &Undone::revision, "that it is now; 0: as it started"},
               Field{"undone", &Undone::change, "what was taken back"},
               Field{"text", may_lack(&Undone::text), "of the model, where it has no file"});

}  // namespace ballbar
