// The one place that knows how the core joins runs and designs a test.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ballbar/diagnosis/next_test/plan.hpp"
#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar::next_test {

// Several runs as one series, and the model beside what differs from run to run.
struct Joined {
  Series data;
  Model model;
};
Joined joined(const Model& model, const std::vector<Series>& runs);

// A test of at most so many hours; NaN: no probability was promised.
struct Design {
  Schedule schedule;
  double promised = 0.0;  // probability of a right verdict after it
};

// Nothing: no test would tell.
std::optional<Design> plan_of(const Joined& joined, const Diagnosis& diagnosis, double hours, double max_rpm,
                              std::uint64_t seed);

}  // namespace ballbar::next_test
