#include "errors/machine_errors_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/formats/recordings/stored_errors.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/units.hpp"
#include "errors/machine_errors_result.hpp"
#include "errors/quantity_text.hpp"
#include "errors/stored_test.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kNothing_um = 0.02;      // readings are written to 0.01 um
constexpr double kMoreThanRepeats = 1.5;  // times the repeatability: a form is left
constexpr double kDiffers = 2.0;          // sigma
constexpr double kDiffers_um = 0.3;
constexpr double kMore_um = 0.05;  // half of the last digit

MachineErrorOptions fit_options(const ErrorsReport& report, const ErrorsOptions& options) {
  MachineErrorOptions how = report.b5r ? error_options(*report.b5r) : MachineErrorOptions{};
  how.prior = options.prior;
  return how;
}

// The group of recordings that these belong to, a new one where there is none yet.
ErrorsReport& group_of(ErrorsReports& reports, const Recording& recording) {
  for (ErrorsReport& group : reports.groups) {
    const Recording& first = group.recordings.front();
    if (first.plane == recording.plane && first.nominal_length_mm == recording.nominal_length_mm) return group;
  }
  return reports.groups.emplace_back();
}

void read_into(ErrorsReports& reports, const Source& source, const ErrorsOptions& options) {
  const std::string& file = source.name();
  RecordingFile read = open_recording(source, known_readers(), options.circle);
  std::move(read.remarks.begin(), read.remarks.end(), std::back_inserter(reports.remarks));
  if (read.recordings.empty() && read.b5r) {
    StoredAlone alone{results_alone_of(file, std::move(*read.b5r)), {options.tolerance_um, std::nullopt, {}, {}}};
    alone.check.limits = limit_checks(alone.of.b5r);
    if (const std::optional<StoredFeature> round = stored_circularity(alone.of.b5r)) {
      alone.check.circularity_um = round->value;
      alone.check.stored_in = round->parent;
    }
    reports.results_alone.push_back(std::move(alone));
    return;
  }
  for (Recording& recording : read.recordings) {
    if (recording.kind != Kind::circle || recording.motion != Motion::linear_axes) {
      throw Error(fmt::format("{}: expected circles that two linear axes drive, found {}.", file,
                              recording.kind == Kind::axial ? name_of(recording.kind) : name_of(recording.motion)));
    }
    ErrorsReport& group = group_of(reports, recording);
    group.recordings.push_back(std::move(recording));
    if (!group.files.empty() && group.files.back() == file) continue;
    group.files.push_back(file);
    group.b5r = group.files.size() == 1 ? read.b5r : std::nullopt;
  }
}

std::vector<const RankedError*> significant_of(const MachineErrors& found) {
  std::vector<const RankedError*> significant;
  for (const RankedError& one : found.ranked) {
    if (one.significant) significant.push_back(&one);
  }
  return significant;
}

ErrorRow row_of(const ErrorsReport& report, const MachineError& error, const RankedError* ranked) {
  ErrorRow row{error, std::nullopt, stored_value_of(report, error), same_as_stored(report, error), {}, {}, {}, {}};
  if (error.as_instrument)
    row.as_instrument = {*error.as_instrument, ranked == nullptr ? std::nullopt : ranked->as_instrument};
  if (ranked == nullptr) return row;
  row.ranked = *ranked;
  row.stored_rank = stored_rank_of(report, *ranked);
  const std::string& effect = ranked->effect->name;
  if (report.b5r) row.stored_individual_circularity_um = stored_individual_circularity_um(*report.b5r, effect);
  const std::set<std::string>& in_the_model = report.options.in_the_model;
  if (!in_the_model.empty()) row.in_the_model = in_the_model.contains(effect);
  return row;
}

}  // namespace

ErrorsReports errors_reports_of(const std::vector<Source>& files, const ErrorsOptions& options) {
  expect_once(files);
  ErrorsReports reports;
  for (const Source& file : files) {
    try {
      read_into(reports, file, options);
    } catch (const Error& error) {
      if (options.strict || files.size() == 1) throw;
      reports.skipped.push_back({file.name(), error.what()});
    }
  }
  for (ErrorsReport& group : reports.groups) {
    group.options = options;
    try {
      group.found = machine_errors(group.recordings, fit_options(group, options));
    } catch (const Error& error) {
      const std::string why = fmt::format("{}: {}", fmt::join(group.files, ", "), error.what());
      if (options.strict || reports.groups.size() == 1) throw Error(why);
      reports.skipped.push_back({group.files.front(), why});
      group.recordings.clear();
    }
  }
  std::erase_if(reports.groups, [](const ErrorsReport& group) { return group.recordings.empty(); });
  if (reports.groups.empty() && reports.results_alone.empty() && !reports.skipped.empty()) {
    throw Error(reports.skipped.front().why);
  }
  return reports;
}

std::optional<double> stored_value_of(const ErrorsReport& report, const MachineError& error) {
  // Without a feed a delay is in um, and the stored one in ms.
  const auto has_unit = [&](const Parameter& gain) { return gain.unit == error.unit; };
  if (error.effect != nullptr &&
      std::none_of(error.effect->parameters.begin(), error.effect->parameters.end(), has_unit))
    return std::nullopt;
  return report.b5r ? stored_error(*report.b5r, error.name) : std::nullopt;
}

std::optional<int> stored_rank_of(const ErrorsReport& report, const RankedError& ranked) {
  return report.b5r ? stored_rank(*report.b5r, ranked.effect->name) : std::nullopt;
}

std::optional<bool> same_as_stored(const ErrorsReport& report, const MachineError& error) {
  const std::optional<double> stored = stored_value_of(report, error);
  if (!stored || !error.as_instrument) return std::nullopt;
  const double digit = error.unit == "um/m" ? 1.0 : error.unit == "ms" ? 0.01 : 0.1;
  return std::abs(*error.as_instrument - *stored) <= 1.5 * digit + 1e-6;
}

namespace {

bool is_of(const ErrorGroup& group, const std::optional<NextMeasurement>& next) {
  return next && std::any_of(group.effects.begin(), group.effects.end(),
                             [&](const Effect* effect) { return effect->name == next->error; });
}

// By the measurement that would tell: what these recordings lack.
Message what_cannot_tell(const ErrorsReport& report, const ErrorGroup& group) {
  if (!is_of(group, report.found.next)) return messages::these_readings();
  double longest_rad = 0.0;
  for (const Recording& one : report.recordings) longest_rad = std::max(longest_rad, arc_rad(one));
  switch (report.found.next->measurement) {
    case Measurement::other_direction:
      return messages::one_direction();
    case Measurement::full_circle:
      return messages::an_arc(fmt::format("{:.0f}", deg_from_rad(longest_rad)));
    default:
      return messages::one_feed();
  }
}

// "A or B or C"
Message either_of(std::vector<Message> all) {
  Message text = std::move(all.front());
  for (std::size_t k = 1; k < all.size(); ++k) text = messages::error_or(std::move(text), std::move(all[k]));
  return text;
}

Message either_of(const ErrorGroup& group, Plane plane) {
  std::vector<Message> all;
  all.reserve(group.effects.size());
  for (const Effect* effect : group.effects) all.push_back(error_of(effect->name, plane));
  return either_of(std::move(all));
}

}  // namespace

Message group_sentence(const ErrorsReport& report, const ErrorGroup& group) {
  const Plane plane = report.recordings.front().plane;
  std::vector<Message> members;
  for (std::size_t k = 0; k < group.alone.size();) {
    const Effect* const effect = group.alone[k].effect;
    std::vector<MessageValue> values;
    for (; k < group.alone.size() && group.alone[k].effect == effect; ++k) {
      const MachineError& alone = group.alone[k];
      values.emplace_back(messages::amount_of_unit(
          with_sigma(alone.value, alone.sigma, decimals_showing(2, alone.sigma, 4)), alone.unit));
    }
    const auto name = error_of(effect->name, plane, members.empty() ? FirstLetter::capital : FirstLetter::small);
    members.push_back(messages::error_of_size(name, enumerated(values)));
  }
  return messages::errors_cannot_tell(either_of(std::move(members)), what_cannot_tell(report, group));
}

const RankedError* first_of(const MachineErrors& found) {
  const std::vector<const RankedError*> significant = significant_of(found);
  return significant.empty() ? nullptr : significant.front();
}

std::vector<std::string> difference_texts(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  // What ours has and the instrument's has not, or the other way round.
  std::string why = "the instrument holds it near 0, and this arc hardly determines it";
  if (deg_from_rad(arc_rad(report.recordings.front())) > 358.0) {
    why = "the instrument does not remove the second-order part of the centre offset";
  }
  double most_um = 0.0;
  for (const RankedError& one : found.ranked) {
    const bool is_extra = one.effect->rules.error_fit == ErrorFit::where_it_shows && one.significant;
    if (!is_extra || one.individual_circularity_um <= most_um) continue;
    most_um = one.individual_circularity_um;
    why = fmt::format("{} explains a part of it here, and the instrument does not have that error", one.effect->name);
  }
  std::vector<std::string> texts, not_reproduced;
  for (const RankedError& one : found.ranked) {
    for (const std::size_t row : one.rows) {
      const MachineError& error = found.errors[row];
      if (!error.as_instrument) continue;
      if (same_as_stored(report, error) == false) {
        not_reproduced.push_back(fmt::format("{} ({:.{}f}, stored {:g})", error.name, *error.as_instrument,
                                             error.unit == "ms" ? 2 : 1, *stored_value_of(report, error)));
      }
      if (one.effect->rules.error_fit == ErrorFit::at_reversals) continue;  // of another rule by what it is
      const double difference = std::abs(error.value - *error.as_instrument);
      const double um = error.unit == "um" || error.value == 0.0
                            ? difference
                            : difference * one.individual_circularity_um / std::abs(error.value);
      if (difference <= kDiffers * error.sigma || um <= kDiffers_um) continue;
      const int decimals = error.unit == "ms" ? 2 : 1;
      texts.push_back(fmt::format("{}: {:.{}f} here, {:.{}f} by the instrument; {}.", error.name, error.value, decimals,
                                  *error.as_instrument, decimals, why));
    }
  }
  if (!not_reproduced.empty()) {
    texts.insert(texts.begin(),
                 fmt::format("The instrument's column does not reproduce the stored {}: its maker documents no "
                             "estimator, and this one is derived from other files.",
                             fmt::join(not_reproduced, ", ")));
  }
  return texts;
}

std::string verdict_of(const ErrorsReport& report) {
  if (!significant_of(report.found).empty()) return "named";
  if (!report.found.groups.empty()) return "equivalent";
  return report.found.left ? "unexplained" : "nothing";
}

namespace {

std::string um_text(double value_um) { return fmt::format("{:.1f}", value_um); }

// What the significant errors say.
Paragraph significant_sentences(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  const std::vector<const RankedError*> significant = significant_of(found);
  const RankedError& most = *significant.front();
  const Plane plane = report.recordings.front().plane;
  const Message first = error_of(most.effect->name, plane), what = summary_of(*most.effect, plane);
  Paragraph text;
  if (most.rank) {
    text =
        messages::correcting_lowers(first, what, um_text(found.circularity_um), um_text(most.circularity_without_um));
  } else {
    text = messages::circularity_is(um_text(found.circularity_um));
    text += messages::correcting_alone(first, what);
  }
  std::vector<MessageValue> others;
  for (std::size_t k = 1; k < significant.size(); ++k)
    others.emplace_back(error_of(significant[k]->effect->name, plane));
  for (const ErrorGroup& group : found.groups) others.emplace_back(either_of(group, plane));
  if (others.empty()) {
    text += messages::no_other_error();
    return text;
  }
  const Message all = others.size() == 1 ? messages::both() : messages::all_of(others.size() + 1);
  const std::string left = um_text(found.circularity_without_all_um);
  text += found.circularity_without_all_um > most.circularity_without_um + kMore_um
              ? messages::correcting_all_leaves(all, left)
              : messages::correcting_all_lowers(all, left);
  text += messages::other_errors(others.size(), listed(others));
  return text;
}

}  // namespace

Paragraph conclusion(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  const bool any = !significant_of(found).empty();
  Paragraph leading, following;
  for (const ErrorGroup& group : found.groups) {
    Paragraph text = group_sentence(report, group);
    if (is_of(group, found.next)) text += message_of(*found.next);
    if (!leading.empty() || (any && group.rank != std::size_t{1})) {
      following += text;
      continue;
    }
    leading = text;
    leading += group.rank ? messages::correcting_them_lowers(um_text(found.circularity_um),
                                                             um_text(group.circularity_without_um))
                          : messages::circularity_is(um_text(found.circularity_um));
  }
  if (any) {
    leading += significant_sentences(report);
  } else if (!leading.empty()) {
    leading += messages::no_single_error();
  } else {
    leading = messages::circularity_is(um_text(found.circularity_um));
    leading += messages::no_error_significant();
  }
  leading += following;
  return leading;
}

Paragraph left_sentences(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  const Plane plane = report.recordings.front().plane;
  const auto two_digits = [](double value) { return fmt::format("{:.2f}", value); };
  Paragraph text;
  if (!found.one_by_one.empty()) {
    MessageValue added = Paragraph();
    for (const AddedError& one : found.one_by_one) {
      const MessageValue error =
          one.group ? MessageValue(either_of(found.groups[*one.group], plane)) : error_of(one.effect->name, plane);
      added = messages::errors_added(added, messages::error_added(error, two_digits(one.rms_um)));
    }
    text += messages::errors_one_by_one(two_digits(found.circle_rms_um), added);
  }
  const std::string rms = two_digits(found.residual_rms_um);
  text += std::isfinite(found.repeatability_um) ? messages::errors_left_repeat(rms, two_digits(found.repeatability_um))
                                                : messages::errors_left(rms);
  if (found.residual_rms_um < kNothing_um) {
    text += messages::negligible();
  } else if (found.left) {
    const LeftHarmonic& left = *found.left;
    const std::string size = two_digits(left.peak_to_peak_um);
    text += left.in_both ? messages::wave_in_both(left.harmonic, size)
                         : messages::wave_in_one(left.harmonic, size, left.recording + 1,
                                                 name_of(report.recordings[left.recording].direction));
    text += messages::no_known_error();
  } else if (found.residual_rms_um > kMoreThanRepeats * found.repeatability_um) {
    text += messages::same_in_both();
  } else {
    text += messages::no_pattern();
  }
  return text;
}

ToleranceCheck check_of(const ErrorsReport& report) {
  ToleranceCheck check{report.options.tolerance_um, report.found.circularity_um, {}, {}};
  if (report.b5r) check.limits = limit_checks(*report.b5r);
  return check;
}

std::optional<FeedForecast> forecast_of(const ErrorsReport& report) {
  if (!report.options.tolerance_um) return std::nullopt;
  return feed_forecast(report.found, report.recordings, *report.options.tolerance_um);
}

bool any_fails(const ErrorsReports& reports) {
  const auto fails = [](const ToleranceCheck& check) { return passes(check) == false; };
  return std::any_of(reports.groups.begin(), reports.groups.end(),
                     [&](const ErrorsReport& one) { return fails(check_of(one)); }) ||
         std::any_of(reports.results_alone.begin(), reports.results_alone.end(),
                     [&](const StoredAlone& one) { return fails(one.check); });
}

std::vector<ErrorRow> error_rows(const ErrorsReport& report) {
  const MachineErrors& found = report.found;
  std::vector<ErrorRow> rows;
  std::vector<bool> listed(found.errors.size(), false);
  for (const RankedError& ranked : found.ranked) {
    for (const std::size_t row : ranked.rows) {
      rows.push_back(row_of(report, found.errors[row], &ranked));
      listed[row] = true;
    }
  }
  for (std::size_t row = 0; row < found.errors.size(); ++row) {
    if (!listed[row]) rows.push_back(row_of(report, found.errors[row], nullptr));
  }
  return rows;
}

std::vector<BoundEffect> significant_effects(const ErrorsReport& report) {
  std::vector<BoundEffect> effects;
  for (const RankedError& one : report.found.ranked) {
    if (one.significant) effects.push_back({one.effect, {}});
  }
  return effects;
}

std::variant<ErrorsOfOne, ErrorsReports> result_of(const ErrorsReports& reports) {
  if (reports.groups.size() == 1 && reports.results_alone.empty()) return ErrorsOfOne{reports};
  return reports;
}

}  // namespace ballbar
