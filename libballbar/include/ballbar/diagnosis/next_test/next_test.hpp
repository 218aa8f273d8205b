// The circles that would tell the remaining candidates of a diagnosis of recordings apart, and how well; of a drift:
// test_plan.hpp.
//
// A menu of tests (the same again with the set-up untouched or new, the other direction, other feeds, another radius)
// is predicted: every candidate adds what it was fitted to. What depends on time alone goes on where the set-up is
// untouched - a test begins 12 h after the data - and starts again where it is new. Old and new data are whitened by
// the noise (that of the fit with the best set) and freed of the model, of a new circle and of the other candidate with
// its gains and shapes; what is left of one candidate,
//
//   d = |(I - P) W g|,
//
// is the root of the fall of chi^2 that would show it is not the other, with the shape of its grid that imitates best.
// The separation of a pair is the smaller d of both orders; where one with more parameters can imitate the other
// whatever is done (an expansion is a lag of nothing), that of the order which can be seen. The separation of a test is
// the smallest of all pairs; the test with the largest is proposed, or, where none reaches 5, the one that settles most
// pairs.
//
// Against chi^2 of simulated tests d is right within a factor of 1.5. 1334 rows and 4 competitors: 0.06 s.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

struct NextTest {
  std::string name;         // "stop and go"
  std::string text;         // whole sentences: what to do, how long, what it would show
  double separation = 0.0;  // d of data and test together
  double duration_s = 0.0;
  double separation_so_far = 0.0;  // d of the data alone, of the pair that is hardest to tell in this test
};

// All tests that the data allow to predict, the one that separates best first. Candidates: those of
// `diagnosis.equivalent` (of a group with one member: whether it comes again, once the data alone may no longer speak
// for it), else the strongest two that are not named; none: empty, as for the verdict `nothing` and a diagnosis of
// other data. Does not throw.
std::vector<NextTest> next_tests(const Model& model, const Series& all, const Diagnosis& diagnosis);

}  // namespace ballbar
