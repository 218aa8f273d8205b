// What `drift --json` prints of tests.
#pragma once

#include <vector>

#include "ballbar/formats/results/drift_results.hpp"
#include "measure/fit_result.hpp"

namespace ballbar {

struct DriftOfSession {
  DriftSeries drift;
  DriftSheet sheet;
  std::optional<std::vector<SkippedFile>> skipped;
};

template <>
inline constexpr auto kResult<DriftOfSession> = ResultType(
    "Drift", "The drift of the spindle.", fields_of(&DriftOfSession::drift), fields_of(&DriftOfSession::sheet),
    Field{"skipped", may_lack(&DriftOfSession::skipped), "files that could not be read"});

}  // namespace ballbar
