// What `errors --json` prints of recordings that linear axes drive.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "ballbar/formats/results/diagnosis_results.hpp"
#include "ballbar/formats/results/message.hpp"
#include "ballbar/units.hpp"
#include "errors/machine_errors_report.hpp"
#include "errors/quantity_text.hpp"
#include "measure/fit_result.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<Recording> = ResultType(
    "DrivenRecording", "A recording that the errors are from.", Field{"direction", &Recording::direction, "CCW, CW"},
    Field{"arc_deg", [](const Recording& of) { return deg_from_rad(arc_rad(of)); }},
    Field{"feed_mm_per_min", &Recording::feed_mm_per_min, "null: not known"},
    Field{"readings", count(&Recording::length_mm)});

template <>
inline constexpr auto kResult<B5r> = ResultType(
    "TestFile", "What a file of an instrument states of its test.",
    Field{"test", may_lack(&B5r::test_name), "its name"}, Field{"machine", may_lack(&B5r::machine)},
    Field{"operator", may_lack(&B5r::operator_name)}, Field{"comment", may_lack(&B5r::comment)},
    Field{"ballbar", may_lack(&B5r::ballbar_model), "model of the instrument"},
    Field{"serial_number", may_lack(&B5r::serial_number), "of the ballbar"},
    Field{"last_calibrated", may_lack(&B5r::last_calibrated)},
    Field{"calibrator_serial_number", may_lack(in(&B5r::calibrator, &Calibrator::serial_number))},
    Field{"software", may_lack(&B5r::software_title)}, Field{"software_version", may_lack(&B5r::software_version)},
    Field{"started_s", may_lack(&B5r::started_s), "on the machine's clock, since 1970"},
    Field{"programmed_feed_mm_per_min", may_lack(&B5r::programmed_feed_mm_per_min)});

// An error as the instrument's software has it.
struct InstrumentValue {
  double value = 0.0;
  std::optional<InstrumentRank> rank;
};

template <>
inline constexpr auto kResult<InstrumentValue> = ResultType(
    "InstrumentValue", "An error as the software of the instrument has it.", Field{"value", &InstrumentValue::value},
    Field{"individual_circularity_um", in(&InstrumentValue::rank, &InstrumentRank::individual_circularity_um),
          "peak to peak of its own curve"},
    Field{"share_percent", in(&InstrumentValue::rank, &InstrumentRank::share_percent), "of the sum of all it ranks"},
    Field{"rank", in(&InstrumentValue::rank, &InstrumentRank::rank), "1: the largest circularity"});

struct ErrorRow {
  MachineError error;
  std::optional<RankedError> ranked;  // nothing: of the circle
  std::optional<double> stored;
  std::optional<bool> stored_is_same;
  std::optional<int> stored_rank;
  std::optional<double> stored_individual_circularity_um;
  std::optional<bool> in_the_model;
  std::optional<InstrumentValue> as_instrument;
};
std::vector<ErrorRow> error_rows(const ErrorsReport& report);

constexpr auto of_error(auto get) { return in(&ErrorRow::error, get); }
// Null, and not there, of the circle.
constexpr auto ranked(auto get) { return in(&ErrorRow::ranked, get); }
constexpr auto if_ranked(auto... get) {
  return where([](const ErrorRow& of) { return of.ranked.has_value(); }, in(get...));
}
constexpr const RankedError& ranked_of(const ErrorRow& row) { return *row.ranked; }

template <>
inline constexpr auto kResult<ErrorRow> = ResultType(
    "MachineError", "An error of the machine, ranked; or of the circle, which is not.",
    Field{"name", of_error(&MachineError::name), "squareness, backlash_a_pos, centre_a, ..."},
    Field{"value", of_error(&MachineError::value)}, Field{"sigma", of_error(&MachineError::sigma)},
    Field{"unit", of_error(&MachineError::unit), "um, um/m, ms"},
    Field{"determined", of_error(&MachineError::determined),
          "whether one sigma moves the readings by less than the circularity"},
    Field{"as_instrument", &ErrorRow::as_instrument,
          "by the estimator of the instrument's software; null: it has no such error"},
    Field{"significant", ranked(&RankedError::significant), "null, as all ranks: of the circle, which has none"},
    Field{"predicts_other_run", ranked(&RankedError::predicts_other_run),
          "whether its value from one run lowers the residual of the other"},
    Field{"individual_circularity_um", ranked(&RankedError::individual_circularity_um),
          "peak to peak of its own curve over all recordings"},
    Field{"share_percent", ranked(&RankedError::share_percent), "of the sum of these of all errors"},
    Field{"rank", ranked(&RankedError::rank),
          "by what mending it gains, 1 the most; null: not significant, or the circularity stays"},
    Field{"stored", &ErrorRow::stored, "that the file has of it"},
    Field{"stored_is_same", &ErrorRow::stored_is_same, "whether that is what the instrument's estimator says"},
    Field{"stored_rank", &ErrorRow::stored_rank},
    Field{"circularity_without_um", ranked(&RankedError::circularity_without_um), "that remains if it is mended"},
    Field{"circularity_gain_um", ranked(&RankedError::gain_um), "circularity now less that"},
    Field{"circularity_gain_sigma_um", ranked(&RankedError::gain_sigma_um), "null: not asked for"},
    Field{"effect", if_ranked(&ranked_of, &RankedError::effect, &Effect::name), "as `ballbar effects` lists it"},
    Field{"stored_individual_circularity_um", if_ranked(&ErrorRow::stored_individual_circularity_um)},
    Field{"p_value", if_ranked(&ranked_of, &RankedError::p_value), "of noise that shows as much"},
    Field{"shape", if_ranked(&ranked_of, &RankedError::shape),
          "width of a spike or of a step of play, deg; pitch of a cyclic error, mm; null: none"},
    Field{"remedy", if_ranked(&ranked_of, &RankedError::effect, &Effect::explanation, &Explanation::remedy)},
    Field{"group", ranked(&RankedError::group), "place in error_groups; null: in none"},
    Field{"in_the_model", may_lack(&ErrorRow::in_the_model), "with a model: whether it has this error"});

// The value of a member of a group without the others.
template <>
inline constexpr auto kResult<MachineError> = ResultType(
    "ErrorAlone", "The value of an error if no other member of its group is there.",
    Field{"name", &MachineError::name, "squareness, servo_mismatch, ..."}, Field{"value", &MachineError::value},
    Field{"sigma", &MachineError::sigma}, Field{"unit", &MachineError::unit, "um, um/m, ms"});

template <>
inline constexpr auto kResult<ErrorGroup> =
    ResultType("ErrorGroup", "Errors that the readings show together and cannot separate.",
               Field{"name", [](const ErrorGroup& of) { return name_of(of); }, "squareness_or_servo_mismatch, ..."},
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
               Field{"circularity_gain_sigma_um", &ErrorGroup::gain_sigma_um, "null: not asked for"});

template <>
inline constexpr auto kResult<AddedError> =
    ResultType("AddedError", "The residual with this error and those before it.",
               Field{"effect", in(&AddedError::effect, &Effect::name), "of a group its first member"},
               Field{"group", &AddedError::group, "place in error_groups; null: a single error"},
               Field{"rms_um", &AddedError::rms_um});

template <>
inline constexpr auto kResult<LeftHarmonic> = ResultType(
    "LeftHarmonic", "A wave that no error explains.", Field{"harmonic", &LeftHarmonic::harmonic, "waves a turn"},
    Field{"recording", &LeftHarmonic::recording, "in which it is largest"},
    Field{"peak_to_peak_um", &LeftHarmonic::peak_to_peak_um},
    Field{"p_value", &LeftHarmonic::p_value, "after the number of harmonics and recordings looked at"},
    Field{"in_both_directions", &LeftHarmonic::in_both});

template <>
inline constexpr auto kResult<NextMeasurement> =
    ResultType("NextMeasurement", "The measurement that would tell errors apart.",
               Field{"measurement", &NextMeasurement::measurement, "other_direction, full_circle, another_feed"},
               Field{"error", &NextMeasurement::error, "that it separates best"},
               Field{"other", &NextMeasurement::other, "from which"},
               Field{"text", [](const NextMeasurement& of) { return message_of(of); }, "what to do"});

template <>
inline constexpr auto kResult<PriorOfError> =
    ResultType("PriorOfError", "What an error is held to be before the readings speak.",
               Field{"name", &PriorOfError::name}, Field{"value", [](const PriorOfError&) { return 0.0; }},
               Field{"sigma", &PriorOfError::sigma}, Field{"unit", &PriorOfError::unit},
               Field{"readings_alone", &PriorOfError::alone, "its value by the readings alone"},
               Field{"readings_alone_sigma", &PriorOfError::alone_sigma});

template <>
inline constexpr auto kResult<FeedForecast> =
    ResultType("FeedForecast", "The feed at which the fitted model holds the tolerance.",
               Field{"tolerance_um", &FeedForecast::tolerance_um, "of the circularity"},
               Field{"feed_mm_per_min", &FeedForecast::feed_mm_per_min, "the highest that holds it; null: none does"},
               Field{"sigma_mm_per_min",
                     [](const FeedForecast& of) {
                       return of.feed_mm_per_min ? std::optional(of.sigma_mm_per_min) : std::nullopt;
                     }},
               Field{"circularity_without_um", &FeedForecast::circularity_without_um, "without servo mismatch"},
               Field{"text", &forecast_text, "a sentence"});

// That the test shows, without columns: they are the axes'.
std::vector<BoundEffect> significant_effects(const ErrorsReport& report);

constexpr auto of_errors(auto get) { return in(&ErrorsReport::found, get); }
constexpr auto of_first(auto get) {
  return [get](const ErrorsReport& of) { return value_in(of.recordings.front(), get); };
}
inline constexpr FieldList kCheckFields{Field{"tolerances", &tolerance_lines, "pass or fail, a line each"},
                                        Field{"passes", may_lack([](const ToleranceCheck& of) { return passes(of); }),
                                              "with a tolerance: whether it and the limits in the file hold"}};

template <>
inline constexpr auto kResult<ErrorsReport> = ResultType(
    "MachineErrors", "The errors of a machine from recordings of one plane and one bar.",
    Field{"files", &ErrorsReport::files, "of recordings"}, Field{"plane", of_first(&Recording::plane), "XY, YZ, ZX"},
    Field{"nominal_length_mm", of_first(&Recording::nominal_length_mm)}, Field{"recordings", &ErrorsReport::recordings},
    Field{"file", may_lack(&ErrorsReport::b5r), "what the only file states"},
    Field{"conclusion", [](const ErrorsReport& of) { return conclusion(of); }, "what it says in plain words"},
    Field{"verdict", &verdict_of, "named, equivalent, unexplained, nothing"},
    Field{"named", &significant_effects, "errors that the test shows"},
    Field{"errors", &error_rows, "by what mending them gains, then those of the circle"},
    Field{"error_groups", of_errors(&MachineErrors::groups), "that the readings cannot separate"},
    Field{"one_by_one", of_errors(&MachineErrors::one_by_one),
          "the significant ones, each time that which leaves least"},
    Field{"circle_rms_um", of_errors(&MachineErrors::circle_rms_um), "that the circles alone leave"},
    Field{"circularity_um", of_errors(&MachineErrors::circularity_um),
          "largest less smallest reading about the fitted centre"},
    Field{"circularity_without_all_um", of_errors(&MachineErrors::circularity_without_all_um),
          "that remains once all significant errors are mended"},
    Field{"differences", &difference_texts, "where ours and the instrument's values differ, and why"},
    Field{"residual_rms_um", of_errors(&MachineErrors::residual_rms_um), "that all errors leave"},
    Field{"repeatability_um", of_errors(&MachineErrors::repeatability_um),
          "what of it is not the same in both directions; null: one direction"},
    Field{"noise", of_errors(&MachineErrors::noise), "of the readings"},
    Field{"left", of_errors(&MachineErrors::left), "a wave that no error explains; null: none"},
    Field{"left_text", &left_sentences, "what the errors do not explain"},
    Field{"undetermined", of_errors(&MachineErrors::undetermined), "what the readings do not tell apart"},
    Field{"next_measurement", may_lack(of_errors(&MachineErrors::next)), "that would tell some of these apart"},
    Field{"prior", of_errors(&MachineErrors::prior)}, fields_of(&check_of, kCheckFields),
    Field{"feed_forecast", may_lack(&forecast_of), "of a test that fails its tolerance by a servo mismatch"});

template <>
inline constexpr auto kResult<StoredAlone> = ResultType("StoredAlone",
                                                        "A file that stores results without readings, and its limits.",
                                                        fields_of(&StoredAlone::of),
                                                        fields_of(&StoredAlone::check, kCheckFields));

// Of one group of recordings.
struct ErrorsOfOne {
  ErrorsReports reports;
};
std::variant<ErrorsOfOne, ErrorsReports> result_of(const ErrorsReports& reports);

inline constexpr FieldList kErrorsReportsFiles{
    Field{"skipped", &ErrorsReports::skipped, "files that could not be read"},
    Field{"remarks", &ErrorsReports::remarks, "of the readers"}};

template <>
inline constexpr auto kResult<ErrorsReports> =
    ResultType("RankedErrorsOfGroups", "The errors of a machine from several planes or bars.",
               Field{"groups", &ErrorsReports::groups, "of several planes or bars, each as the errors of one"},
               Field{"results_alone", &ErrorsReports::results_alone, "files that store results without readings"},
               kErrorsReportsFiles);

template <>
inline constexpr auto kResult<ErrorsOfOne> =
    ResultType("RankedErrors", "The errors of a machine.",
               fields_of([](const ErrorsOfOne& of) -> const ErrorsReport& { return of.reports.groups.front(); },
                         kResult<ErrorsReport>.fields),
               fields_of(&ErrorsOfOne::reports, kErrorsReportsFiles));

}  // namespace ballbar
