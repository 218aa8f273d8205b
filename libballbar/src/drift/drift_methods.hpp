// The three methods of drift.hpp, one file each. Method, reference_s are filled in by drift_of.
#pragma once

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "ballbar/drift/drift.hpp"
#include "ballbar/error.hpp"

namespace ballbar {

DriftSeries drift_by_two_arcs(const Session& session, const DriftOptions& options, std::size_t reference);
DriftSeries drift_by_spindle_rotation(const Session& session, const DriftOptions& options, std::size_t reference);
DriftSeries drift_by_circles(const Session& session, const DriftOptions& options);

// The test nearest to the wanted time, or the first.
std::size_t reference_index(const std::vector<double>& times_s, const std::optional<double>& wanted_s);

// Runs `work`; adds the name of the test to an Error from it.
template <class Work>
auto in_test(const SessionTest& test, Work work) {
  try {
    return work();
  } catch (const Error& error) {
    throw Error(fmt::format("test at {} s ({}): {}", test.elapsed_s, test.name, error.what()));
  }
}

}  // namespace ballbar
