// What `drift --json` prints of tests.
#pragma once

#include <vector>

#include "ballbar/formats/recordings/recording_results.hpp"
#include "ballbar/formats/results/drift_results.hpp"

namespace ballbar {

struct DriftOfSession {
  DriftSeries drift;
  DriftSheet sheet;
  MayLack<std::vector<SkippedFile>> skipped;
};

template <>
inline constexpr auto kResult<DriftOfSession> =
    ResultType{"Drift", "The drift of the spindle.",
               std::tuple_cat(fields_through(&DriftOfSession::drift, kResult<DriftSeries>.fields),
                              fields_through(&DriftOfSession::sheet, kSheetFields),
                              std::tuple{Field{"skipped", &DriftOfSession::skipped, "files that could not be read"}})};

}  // namespace ballbar
