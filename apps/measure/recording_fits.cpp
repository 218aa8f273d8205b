#include "measure/recording_fits.hpp"

#include <fmt/format.h>

#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/formats/recordings/recording_file.hpp"
#include "ballbar/units.hpp"
#include "measure/fit_result.hpp"

namespace ballbar {
namespace {

std::optional<double> stored_um_from_mm(const std::optional<B5r>& b5r, const std::string& parent, const char* name) {
  if (!b5r) return std::nullopt;
  const auto value_mm = stored_value(*b5r, parent, name, "UT_LENGTH_MM");
  if (!value_mm) return std::nullopt;
  return std::round(um_from_mm(*value_mm) * 1e4) / 1e4;  // 48.8 as the file prints it, not 48.800000000000004
}

FittedRecording fit_recording(const std::string& file, std::size_t index, Recording recording,
                              const std::optional<B5r>& b5r, const CircleOptions& options) {
  FittedRecording fitted;
  fitted.file = file;
  fitted.index = index;
  if (b5r) fitted.test_name = b5r->test_name;
  fitted.recording = std::move(recording);
  if (fitted.recording.kind == Kind::axial) {
    fitted.axial = axial_length(fitted.recording);
    return fitted;
  }
  const Circle circle = fit_circle(fitted.recording, options);
  CircleOptions alone = options;
  alone.oval = false;
  fitted.least_squares = circle.oval_um > 0.0 ? fit_circle(fitted.recording, alone) : circle;
  const Circularity round = circularity(fitted.recording, *fitted.least_squares);
  const std::string run = b5r ? parent_of(*b5r, index) : std::string();
  const auto radius_mm = b5r ? stored_value(*b5r, run, "AF_BEST_RADIUS", "UT_LENGTH_MM") : std::nullopt;
  fitted.results = {
      {"centre_a_um", "centre A um", 2, circle.centre_a_um, stored_um_from_mm(b5r, run, "AF_CENTRE_OFFSET_A")},
      {"centre_b_um", "centre B um", 2, circle.centre_b_um, stored_um_from_mm(b5r, run, "AF_CENTRE_OFFSET_B")},
      {"radius_mm", "radius mm", 5, circle.radius_mm, radius_mm},
      {"circularity_um", "circularity um", 2, round.circular_deviation_um,
       stored_um_from_mm(b5r, run, "AF_CIRCULARITY")},
  };
  if (fitted.recording.feed_mm_per_min) {
    const auto feed = b5r ? stored_value(*b5r, run, "AF_CALCULATED_FEEDRATE", "UT_FEEDRATE") : std::nullopt;
    fitted.results.push_back({"feed_mm_per_min", "feed mm/min", 2, *fitted.recording.feed_mm_per_min, feed});
  }
  fitted.circle = circle;
  fitted.circularity = round;
  return fitted;
}

// What the file stores for a result of ours, and its limits.
void compare(Compared& result, const std::optional<B5r>& b5r, const char* edition, const char* name,
             const char* data_type = "UT_LENGTH_UM") {
  if (!b5r) return;
  result.stored = stored_value(*b5r, edition, name, data_type);
  result.judgement = judged(b5r->limits, name, result.ours, data_type);
  result.limits = range_of(b5r->limits, name, data_type);
}

// A number of ISO 230-4, and where a `.b5r` stores it.
struct IsoNumber {
  const char* key;
  const char* label;
  const char* edition;
  const char* name;
  const char* data_type = "UT_LENGTH_UM";
};
constexpr const char* kOldEdition = "ISO230_4 1996";
constexpr const char* kNewEdition = "ISO230_4 2005";
constexpr IsoNumber kIsoNumbers[] = {
    {"g_ccw_um", "circular deviation G, CCW um", kOldEdition, "AF_CIRCULAR_DEVIATION_CCW"},
    {"g_cw_um", "circular deviation G, CW um", kOldEdition, "AF_CIRCULAR_DEVIATION_CW"},
    {"bidirectional_2005_um", "bidirectional, 2005 um", kNewEdition, "AF_BIDIRECTIONAL_CIRCULAR_DEVIATION"},
    {"bidirectional_1996_um", "bidirectional, 1996 um", kOldEdition, "AF_CIRCULAR_DEVIATION_BIDIRECTIONAL"},
    {"d_um", "mean radial deviation D um", kNewEdition, "AF_MEAN_BIDIRECTIONAL_RADIAL_DEVIATION"},
    {"h_um", "hysteresis H um", kOldEdition, "AF_CIRCULAR_HYSTERESIS"},
    {"h_at_deg", "  at deg", kOldEdition, "AF_CIRCULAR_HYSTERESIS_LOCATION", "UT_ANGLE"},
    {"f_max_ccw_um", "radial deviation F max, CCW um", kOldEdition, "AF_MAX_RADIAL_DEVIATION_CCW"},
    {"f_min_ccw_um", "radial deviation F min, CCW um", kOldEdition, "AF_MIN_RADIAL_DEVIATION_CCW"},
    {"f_max_cw_um", "radial deviation F max, CW um", kOldEdition, "AF_MAX_RADIAL_DEVIATION_CW"},
    {"f_min_cw_um", "radial deviation F min, CW um", kOldEdition, "AF_MIN_RADIAL_DEVIATION_CW"},
};

FittedPair fit_pair(const FittedRecording& first, const FittedRecording& second, const std::optional<B5r>& b5r) {
  const bool first_is_ccw = first.recording.direction == Direction::CCW;
  const FittedRecording& ccw = first_is_ccw ? first : second;
  const FittedRecording& cw = first_is_ccw ? second : first;
  const Bidirectional both = bidirectional(ccw.recording, *ccw.least_squares, cw.recording, *cw.least_squares);
  const double ours[] = {ccw.circularity->circular_deviation_um,
                         cw.circularity->circular_deviation_um,
                         both.bidirectional_2005_um,
                         both.bidirectional_1996_um,
                         both.mean_radial_um,
                         both.hysteresis_um,
                         both.hysteresis_at_deg,
                         ccw.circularity->max_radial_um,
                         ccw.circularity->min_radial_um,
                         cw.circularity->max_radial_um,
                         cw.circularity->min_radial_um};
  static_assert(std::size(ours) == std::size(kIsoNumbers));
  FittedPair pair;
  pair.file = first.file;
  for (std::size_t k = 0; k < std::size(kIsoNumbers); ++k) {
    const IsoNumber& one = kIsoNumbers[k];
    pair.results.push_back({one.key, one.label, 2, ours[k]});
    compare(pair.results.back(), b5r, one.edition, one.name, one.data_type);
  }
  const auto stored_h = b5r ? stored_value(*b5r, kOldEdition, "AF_CIRCULAR_HYSTERESIS", "UT_LENGTH_UM") : std::nullopt;
  if (stored_h && *stored_h == 0.0 && both.hysteresis_um >= 0.05) {
    pair.remarks.push_back(
        fmt::format("The file stores a hysteresis of 0.0 um, a known defect of the instrument's software{}; the "
                    "readings give {:.1f} um.",
                    b5r->software_version.empty() ? "" : fmt::format(" (this file: version {})", b5r->software_version),
                    both.hysteresis_um));
  }
  return pair;
}

bool are_pair(const FittedRecording& first, const FittedRecording& second) {
  return first.circle && second.circle && are_both_directions(first.recording, second.recording);
}

void add_file(Fitted& fitted, const Source& source, const CircleOptions& options, const StatedCircle& stated,
              std::size_t& next_of_pair) {
  RecordingFile opened = open_recording(source, known_readers(), stated);
  const std::string& file = source.name();
  std::move(opened.remarks.begin(), opened.remarks.end(), std::back_inserter(fitted.remarks));
  if (opened.recordings.empty() && opened.b5r) {
    fitted.results_alone.push_back(results_alone_of(file, std::move(*opened.b5r)));
    next_of_pair = fitted.recordings.size();
    return;
  }
  const std::size_t first_of_file = fitted.recordings.size();
  for (std::size_t i = 0; i < opened.recordings.size(); ++i) {
    try {
      fitted.recordings.push_back(fit_recording(file, i, std::move(opened.recordings[i]), opened.b5r, options));
    } catch (const Error& error) {
      throw Error(fmt::format("{}: {}.", file, error.what()));
    }
  }
  if (opened.b5r) next_of_pair = std::max(next_of_pair, first_of_file);
  const std::size_t n = fitted.recordings.size();
  if (n >= next_of_pair + 2 && are_pair(fitted.recordings[n - 2], fitted.recordings[n - 1])) {
    FittedPair pair = fit_pair(fitted.recordings[n - 2], fitted.recordings[n - 1], opened.b5r);
    const bool ccw_first = fitted.recordings[n - 2].recording.direction == Direction::CCW;
    pair.ccw = ccw_first ? n - 2 : n - 1;
    pair.cw = ccw_first ? n - 1 : n - 2;
    fitted.pairs.push_back(std::move(pair));
    next_of_pair = n;
  }
  if (opened.b5r) next_of_pair = n;
}

// "run 0, CCW", or the analysis.
std::string place_of(const B5r& test, const std::string& parent) {
  for (const StoredRun& run : test.run_results) {
    if (run.parent == parent && run.direction) return fmt::format("{}, {}", parent, name_of(*run.direction));
  }
  return parent;
}

}  // namespace

ResultsAlone results_alone_of(std::string file, B5r b5r) {
  ResultsAlone alone{std::move(file), std::move(b5r), {}};
  for (const StoredFeature& feature : alone.b5r.stored) {
    if (!feature.valid) continue;
    alone.stored.push_back({place_of(alone.b5r, feature.parent), feature.name, feature.value,
                            std::string(unit_of_data_type(feature.data_type))});
  }
  return alone;
}

std::vector<Compared> stored_iso(const B5r& b5r) {
  std::vector<Compared> results;
  for (const IsoNumber& one : kIsoNumbers) {
    const auto value = stored_value(b5r, one.edition, one.name, one.data_type);
    if (!value) continue;
    results.push_back({one.key, one.label, 2, *value});
    compare(results.back(), b5r, one.edition, one.name, one.data_type);
  }
  return results;
}

Fitted fit_files(const std::vector<Source>& files, const CircleOptions& options, Faults faults,
                 const StatedCircle& stated) {
  Fitted fitted;
  std::size_t next_of_pair = 0;  // recordings before it are in a pair already, or cannot be
  for (const Source& file : files) {
    const std::size_t before = fitted.recordings.size();
    try {
      add_file(fitted, file, options, stated, next_of_pair);
    } catch (const Error& error) {
      if (faults == Faults::end_all || files.size() == 1) throw;
      fitted.recordings.resize(before);
      fitted.skipped.push_back({file.name(), error.what()});
      next_of_pair = before;
    }
  }
  if (fitted.recordings.empty() && fitted.results_alone.empty() && !fitted.skipped.empty()) {
    throw Error(fitted.skipped.front().why);
  }
  return fitted;
}

TableOf<double> stored_results(const std::vector<Compared>& results) {
  TableOf<double> stored;
  for (const Compared& result : results) {
    if (result.stored) stored.emplace_back(result.key, *result.stored);
  }
  return stored;
}

KeysOf<double> keys_of(const std::vector<Compared>& results) {
  KeysOf<double> keys;
  for (const Compared& result : results) keys.values.emplace_back(result.key, result.ours);
  return keys;
}

std::optional<FittedPair> only_pair(const std::vector<FittedPair>& pairs) {
  if (pairs.size() != 1) return std::nullopt;
  FittedPair pair = pairs.front();
  pair.file.clear();
  return pair;
}

std::vector<FittedPair> several_pairs(const std::vector<FittedPair>& pairs) {
  return pairs.size() > 1 ? pairs : std::vector<FittedPair>{};
}

}  // namespace ballbar
