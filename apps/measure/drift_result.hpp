// What `drift --json` prints of tests.
#pragma once

#include <vector>

#include "ballbar/formats/recordings/recording_results.hpp"
#include "ballbar/formats/results/drift_results.hpp"

namespace ballbar {

struct DriftOfSession {
  DriftSeries drift;
  MayLack<std::vector<SkippedFile>> skipped;
};

template <>
struct ResultType<DriftOfSession> {
  static constexpr std::string_view name = "Drift";
  static constexpr std::string_view meaning = "The drift of the spindle.";
  static constexpr std::tuple fields =
      std::tuple_cat(fields_through(&DriftOfSession::drift, ResultType<DriftSeries>::fields),
                     std::tuple{Field{"skipped", &DriftOfSession::skipped, "files that could not be read"}});
};

}  // namespace ballbar
