// The experiment that would tell the remaining candidates apart, and how well.
//
// A menu of tests a shop can do (standstill, stop and go, another speed, two dwell lengths, a step of the room or of
// the coolant, the same again after a new set-up; on recordings the other direction, another feed, another radius) is
// predicted: temperatures follow speed and room as they did in the data, every candidate adds what it was fitted to.
// Old and new data are whitened by the noise and freed of the model, of a new constant and of the other candidate with
// its shapes; what is left of one candidate,
//
//   d = |(I - P) W g|,
//
// is the root of the fall of chi^2 that would show it is not the other. The separation of a test is the smallest d of
// all pairs; the test with the largest is proposed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/diagnosis.hpp"
#include "ballbar/model.hpp"
#include "ballbar/series.hpp"

namespace ballbar {

struct NextTest {
  std::string name;         // "stop and go"
  std::string text;         // whole sentences: what to do, how long, what it would show; empty: no test helps
  double separation = 0.0;  // d
  double duration_s = 0.0;
};

// All tests that the data allow to predict, the one that separates best first. Candidates: those of
// `diagnosis.equivalent`, else the strongest two that are not named; none: empty.
std::vector<NextTest> next_tests(const Model& model, const Series& data, const Diagnosis& diagnosis);

}  // namespace ballbar
