// What `errors --json` prints of recordings that linear axes drive.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/formats/recordings/recording_results.hpp"
#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/units.hpp"
#include "errors/machine_errors_report.hpp"
#include "errors/quantity_text.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<Recording> =
    ResultType{"DrivenRecording", "A recording that the errors are from.",
               std::tuple{Field{"direction", &Recording::direction, "CCW, CW"},
                          Field{"arc_deg", [](const Recording& of) { return deg_from_rad(arc_rad(of)); }, ""},
                          Field{"feed_mm_per_min", &Recording::feed_mm_per_min, "null: not known"},
                          Field{"readings", [](const Recording& of) { return of.length_mm.size(); }, ""}}};

// Where the file states it.
template <class Type>
constexpr auto stated(Type B5r::*member) {
  return [member](const B5r& of) {
    if constexpr (std::same_as<Type, std::string>) {
      const std::string& text = of.*member;
      return MayLack<std::string>{text.empty() ? std::nullopt : std::optional(text)};
    } else {
      return MayLack<typename Type::value_type>{of.*member};
    }
  };
}

template <>
inline constexpr auto kResult<B5r> = ResultType{
    "TestFile", "What a file of an instrument states of its test.",
    std::tuple{Field{"test", stated(&B5r::test_name), "its name"}, Field{"machine", stated(&B5r::machine), ""},
               Field{"operator", stated(&B5r::operator_name), ""}, Field{"comment", stated(&B5r::comment), ""},
               Field{"ballbar", stated(&B5r::ballbar_model), "model of the instrument"},
               Field{"serial_number", stated(&B5r::serial_number), "of the ballbar"},
               Field{"last_calibrated", stated(&B5r::last_calibrated), ""},
               Field{"calibrator_serial_number",
                     [](const B5r& of) {
                       const std::string& number = of.calibrator.serial_number;
                       return MayLack<std::string>{number.empty() ? std::nullopt : std::optional(number)};
                     },
                     ""},
               Field{"software", stated(&B5r::software_title), ""},
               Field{"software_version", stated(&B5r::software_version), ""},
               Field{"started_s", stated(&B5r::started_s), "on the machine's clock, since 1970"},
               Field{"programmed_feed_mm_per_min", stated(&B5r::programmed_feed_mm_per_min), ""}}};

// An error as the instrument's software has it.
struct InstrumentValue {
  double value = 0.0;
  std::optional<InstrumentRank> rank;
};

// Null where it is not ranked.
constexpr auto of_rank(auto InstrumentRank::*member) {
  return [member](const InstrumentValue& of) { return of.rank ? std::optional((*of.rank).*member) : std::nullopt; };
}

template <>
inline constexpr auto kResult<InstrumentValue> =
    ResultType{"InstrumentValue", "An error as the software of the instrument has it.",
               std::tuple{Field{"value", &InstrumentValue::value, ""},
                          Field{"individual_circularity_um", of_rank(&InstrumentRank::individual_circularity_um),
                                "peak to peak of its own curve"},
                          Field{"share_percent", of_rank(&InstrumentRank::share_percent), "of the sum of all it ranks"},
                          Field{"rank", of_rank(&InstrumentRank::rank), "1: the largest circularity"}}};

struct ErrorRow {
  MachineError error;
  std::optional<RankedError> ranked;  // nothing: of the circle
  std::optional<double> stored;
  std::optional<bool> stored_is_same;
  std::optional<int> stored_rank;
  std::optional<double> stored_individual_circularity_um;
  MayLack<bool> in_the_model;
};
std::vector<ErrorRow> error_rows(const ErrorsReport& report);

// Null of the circle.
template <class Type>
constexpr auto of_rank(Type RankedError::*member) {
  return [member](const ErrorRow& of) {
    if constexpr (requires(Type value) { value.has_value(); }) {
      return of.ranked ? (*of.ranked).*member : Type{};
    } else {
      return of.ranked ? std::optional((*of.ranked).*member) : std::nullopt;
    }
  };
}
// Not there of the circle.
constexpr auto if_ranked(auto get) {
  return [get](const ErrorRow& of) {
    using Type = std::remove_cvref_t<decltype(get(of))>;
    return MayLack<Type>{of.ranked ? std::optional<Type>(get(of)) : std::nullopt};
  };
}

template <>
inline constexpr auto kResult<ErrorRow> = ResultType{
    "MachineError", "An error of the machine, ranked; or of the circle, which is not.",
    std::tuple{
        Field{"name", [](const ErrorRow& of) { return of.error.name; }, "squareness, backlash_a_pos, centre_a, ..."},
        Field{"value", [](const ErrorRow& of) { return of.error.value; }, ""},
        Field{"sigma", [](const ErrorRow& of) { return of.error.sigma; }, ""},
        Field{"unit", [](const ErrorRow& of) { return of.error.unit; }, "um, um/m, ms"},
        Field{"determined", [](const ErrorRow& of) { return of.error.determined; },
              "whether one sigma moves the readings by less than the circularity"},
        Field{"as_instrument",
              [](const ErrorRow& of) {
                return of.error.as_instrument
                           ? std::optional(InstrumentValue{*of.error.as_instrument,
                                                           of.ranked ? of.ranked->as_instrument : std::nullopt})
                           : std::nullopt;
              },
              "by the estimator of the instrument's software; null: it has no such error"},
        Field{"significant", of_rank(&RankedError::significant), "null, as all ranks: of the circle, which has none"},
        Field{"predicts_other_run", of_rank(&RankedError::predicts_other_run),
              "whether its value from one run lowers the residual of the other"},
        Field{"individual_circularity_um", of_rank(&RankedError::individual_circularity_um),
              "peak to peak of its own curve over all recordings"},
        Field{"share_percent", of_rank(&RankedError::share_percent), "of the sum of these of all errors"},
        Field{"rank", of_rank(&RankedError::rank),
              "by what mending it gains, 1 the most; null: not significant, or the circularity stays"},
        Field{"stored", &ErrorRow::stored, "that the file has of it"},
        Field{"stored_is_same", &ErrorRow::stored_is_same, "whether that is what the instrument's estimator says"},
        Field{"stored_rank", &ErrorRow::stored_rank, ""},
        Field{"circularity_without_um", of_rank(&RankedError::circularity_without_um), "that remains if it is mended"},
        Field{"circularity_gain_um", of_rank(&RankedError::gain_um), "circularity now less that"},
        Field{"circularity_gain_sigma_um", of_rank(&RankedError::gain_sigma_um), "null: not asked for"},
        Field{"effect", if_ranked([](const ErrorRow& of) { return of.ranked->effect->name; }),
              "as `ballbar effects` lists it"},
        Field{"stored_individual_circularity_um",
              if_ranked([](const ErrorRow& of) { return of.stored_individual_circularity_um; }), ""},
        Field{"p_value", if_ranked([](const ErrorRow& of) { return of.ranked->p_value; }),
              "of noise that shows as much"},
        Field{"shape", if_ranked([](const ErrorRow& of) { return of.ranked->shape; }),
              "width of a spike or of a step of play, deg; pitch of a cyclic error, mm; null: none"},
        Field{"remedy", if_ranked([](const ErrorRow& of) { return of.ranked->effect->explanation.remedy; }), ""},
        Field{"group", of_rank(&RankedError::group), "place in error_groups; null: in none"},
        Field{"in_the_model", &ErrorRow::in_the_model, "with a model: whether it has this error"}}};

// The value of a member of a group without the others.
template <>
inline constexpr auto kResult<MachineError> =
    ResultType{"ErrorAlone", "The value of an error if no other member of its group is there.",
               std::tuple{Field{"name", &MachineError::name, "squareness, servo_mismatch, ..."},
                          Field{"value", &MachineError::value, ""}, Field{"sigma", &MachineError::sigma, ""},
                          Field{"unit", &MachineError::unit, "um, um/m, ms"}}};

template <>
inline constexpr auto kResult<ErrorGroup> = ResultType{
    "ErrorGroup", "Errors that the readings show together and cannot separate.",
    std::tuple{Field{"name", [](const ErrorGroup& of) { return name_of(of); }, "squareness_or_servo_mismatch, ..."},
               Field{"effects",
                     [](const ErrorGroup& of) {
                       std::vector<std::string> names;
                       for (const Effect* effect : of.effects) names.push_back(effect->name);
                       return names;
                     },
                     "its members, as `ballbar effects` lists them"},
               Field{"alone", &ErrorGroup::alone, "each member, if no other is there"},
               Field{"individual_circularity_um", &ErrorGroup::individual_circularity_um,
                     "peak to peak of the curve of all members"},
               Field{"sigma_um", &ErrorGroup::sigma_um, "of it"},
               Field{"p_value", &ErrorGroup::p_value, "of noise that shows as much"},
               Field{"rank", &ErrorGroup::rank, "among the errors; null: the circularity stays"},
               Field{"circularity_without_um", &ErrorGroup::circularity_without_um, "that remains if they are mended"},
               Field{"circularity_gain_um", &ErrorGroup::gain_um, "circularity now less that"},
               Field{"circularity_gain_sigma_um", &ErrorGroup::gain_sigma_um, "null: not asked for"}}};

template <>
inline constexpr auto kResult<AddedError> = ResultType{
    "AddedError", "The residual with this error and those before it.",
    std::tuple{Field{"effect", [](const AddedError& of) { return of.effect->name; }, "of a group its first member"},
               Field{"group", &AddedError::group, "place in error_groups; null: a single error"},
               Field{"rms_um", &AddedError::rms_um, ""}}};

template <>
inline constexpr auto kResult<LeftHarmonic> = ResultType{
    "LeftHarmonic", "A wave that no error explains.",
    std::tuple{Field{"harmonic", &LeftHarmonic::harmonic, "waves a turn"},
               Field{"recording", &LeftHarmonic::recording, "in which it is largest"},
               Field{"peak_to_peak_um", &LeftHarmonic::peak_to_peak_um, ""},
               Field{"p_value", &LeftHarmonic::p_value, "after the number of harmonics and recordings looked at"},
               Field{"in_both_directions", &LeftHarmonic::in_both, ""}}};

template <>
inline constexpr auto kResult<NextMeasurement> = ResultType{
    "NextMeasurement", "The measurement that would tell errors apart.",
    std::tuple{Field{"measurement", &NextMeasurement::measurement, "other_direction, full_circle, another_feed"},
               Field{"error", &NextMeasurement::error, "that it separates best"},
               Field{"other", &NextMeasurement::other, "from which"},
               Field{"text", [](const NextMeasurement& of) { return message_of(of); }, "what to do"}}};

template <>
inline constexpr auto kResult<PriorOfError> = ResultType{
    "PriorOfError", "What an error is held to be before the readings speak.",
    std::tuple{Field{"name", &PriorOfError::name, ""}, Field{"value", [](const PriorOfError&) { return 0.0; }, ""},
               Field{"sigma", &PriorOfError::sigma, ""}, Field{"unit", &PriorOfError::unit, ""},
               Field{"readings_alone", &PriorOfError::alone, "its value by the readings alone"},
               Field{"readings_alone_sigma", &PriorOfError::alone_sigma, ""}}};

template <>
inline constexpr auto kResult<FeedForecast> = ResultType{
    "FeedForecast", "The feed at which the fitted model holds the tolerance.",
    std::tuple{Field{"tolerance_um", &FeedForecast::tolerance_um, "of the circularity"},
               Field{"feed_mm_per_min", &FeedForecast::feed_mm_per_min, "the highest that holds it; null: none does"},
               Field{"sigma_mm_per_min",
                     [](const FeedForecast& of) {
                       return of.feed_mm_per_min ? std::optional(of.sigma_mm_per_min) : std::nullopt;
                     },
                     ""},
               Field{"circularity_without_um", &FeedForecast::circularity_without_um, "without servo mismatch"},
               Field{"text", &forecast_text, "a sentence"}}};

// That the test shows, without columns: they are the axes'.
std::vector<BoundEffect> significant_effects(const ErrorsReport& report);

inline constexpr auto kErrorsReportVerdictFields = std::tuple{
    Field{"conclusion", [](const ErrorsReport& of) { return conclusion(of); }, "what it says in plain words"},
    Field{"verdict", [](const ErrorsReport& of) { return verdict_of(of); }, "named, equivalent, unexplained, nothing"},
    Field{"named", &significant_effects, "errors that the test shows"},
    Field{"errors", &error_rows, "by what mending them gains, then those of the circle"},
    Field{"error_groups", [](const ErrorsReport& of) { return of.found.groups; }, "that the readings cannot separate"}};
inline constexpr auto kErrorsReportFound = std::tuple{
    Field{"one_by_one", &MachineErrors::one_by_one, "the significant ones, each time that which leaves least"},
    Field{"circle_rms_um", &MachineErrors::circle_rms_um, "that the circles alone leave"},
    Field{"circularity_um", &MachineErrors::circularity_um, "largest less smallest reading about the fitted centre"},
    Field{"circularity_without_all_um", &MachineErrors::circularity_without_all_um,
          "that remains once all significant errors are mended"}};
inline constexpr auto kErrorsReportLeft =
    std::tuple{Field{"residual_rms_um", &MachineErrors::residual_rms_um, "that all errors leave"},
               Field{"repeatability_um", &MachineErrors::repeatability_um,
                     "what of it is not the same in both directions; null: one direction"},
               Field{"noise", &MachineErrors::noise, "of the readings"},
               Field{"left", &MachineErrors::left, "a wave that no error explains; null: none"}};
inline constexpr auto kErrorsReportDriven = std::tuple{
    Field{"plane", [](const ErrorsReport& of) { return of.recordings.front().plane; }, "XY, YZ, ZX"},
    Field{"nominal_length_mm", [](const ErrorsReport& of) { return of.recordings.front().nominal_length_mm; }, ""}};
inline constexpr std::string_view kTolerancesMean = "pass or fail, a line each",
                                  kPassesMean = "with a tolerance: whether it and the limits in the file hold";
inline constexpr auto kErrorsReportRest = std::tuple_cat(
    std::tuple{Field{"file", [](const ErrorsReport& of) { return MayLack<B5r>{of.b5r}; }, "what the only file states"}},
    kErrorsReportVerdictFields, fields_through(&ErrorsReport::found, kErrorsReportFound),
    std::tuple{Field{"differences", &difference_texts, "where ours and the instrument's values differ, and why"}},
    fields_through(&ErrorsReport::found, kErrorsReportLeft),
    std::tuple{
        Field{"left_text", &left_sentences, "what the errors do not explain"},
        Field{"undetermined", [](const ErrorsReport& of) { return of.found.undetermined; },
              "what the readings do not tell apart"},
        Field{"next_measurement", [](const ErrorsReport& of) { return MayLack<NextMeasurement>{of.found.next}; },
              "that would tell some of these apart"},
        Field{"prior", [](const ErrorsReport& of) { return of.found.prior; }, ""},
        Field{"tolerances", [](const ErrorsReport& of) { return tolerance_lines(check_of(of)); }, kTolerancesMean},
        Field{"passes", [](const ErrorsReport& of) { return MayLack<bool>{passes(check_of(of))}; }, kPassesMean},
        Field{"feed_forecast", [](const ErrorsReport& of) { return MayLack<FeedForecast>{forecast_of(of)}; },
              "of a test that fails its tolerance by a servo mismatch"}});

template <>
inline constexpr auto kResult<ErrorsReport> =
    ResultType{"MachineErrors", "The errors of a machine from recordings of one plane and one bar.",
               std::tuple_cat(std::tuple{Field{"files", &ErrorsReport::files, "of recordings"}}, kErrorsReportDriven,
                              std::tuple{Field{"recordings", &ErrorsReport::recordings, ""}}, kErrorsReportRest)};

// A value that a file stores.
template <>
inline constexpr auto kResult<StoredFeature> = ResultType{
    "StoredValue", "A value that a file stores.",
    std::tuple{Field{"parent", &StoredFeature::parent, "run or analysis that it is of"},
               Field{"name", &StoredFeature::name, "as the file has it"}, Field{"value", &StoredFeature::value, ""},
               Field{"unit", [](const StoredFeature& of) { return unit_of_data_type(of.data_type); }, ""}}};

template <>
inline constexpr auto kResult<StoredAlone> = ResultType{
    "StoredAlone", "A file that stores results without readings.",
    std::tuple{Field{"file", &StoredAlone::file, ""}, Field{"stored", &StoredAlone::stored, ""},
               Field{"tolerances", [](const StoredAlone& of) { return tolerance_lines(of.check); }, kTolerancesMean},
               Field{"passes", [](const StoredAlone& of) { return MayLack<bool>{passes(of.check)}; }, kPassesMean}}};

// Of one group of recordings.
struct ErrorsOfOne {
  ErrorsReports reports;
};
std::variant<ErrorsOfOne, ErrorsReports> result_of(const ErrorsReports& reports);

inline constexpr auto kErrorsReportsFiles =
    std::tuple{Field{"skipped", &ErrorsReports::skipped, "files that could not be read"},
               Field{"remarks", &ErrorsReports::remarks, "of the readers"}};

template <>
inline constexpr auto kResult<ErrorsReports> = ResultType{
    "RankedErrorsOfGroups", "The errors of a machine from several planes or bars.",
    std::tuple_cat(
        std::tuple{Field{"groups", &ErrorsReports::groups, "of several planes or bars, each as the errors of one"},
                   Field{"results_alone", &ErrorsReports::results_alone, "files that store results without readings"}},
        kErrorsReportsFiles)};

template <>
inline constexpr auto kResult<ErrorsOfOne> = ResultType{
    "RankedErrors", "The errors of a machine.",
    std::tuple_cat(
        fields_through([](const ErrorsOfOne& of) -> const ErrorsReport& { return of.reports.groups.front(); },
                       kResult<ErrorsReport>.fields),
        fields_through(&ErrorsOfOne::reports, kErrorsReportsFiles))};

}  // namespace ballbar
