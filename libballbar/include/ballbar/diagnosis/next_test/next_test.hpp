// The ballbar test that best separates the remaining candidates of a diagnosis of recordings. For a drift series see
// test_plan.hpp.
//
// The tests of a menu are predicted: the same test again with the set-up untouched or new, the other direction, other
// feeds, another radius. Each candidate contributes its fitted curve. A test begins 12 h after the data. A candidate
// that depends on time alone continues where the set-up is untouched, and starts again where it is new. Let g be the
// curve of one candidate on old and new data, W the whitening by the noise of the fit with the best set, and P the
// projection onto the model, a new circle and the other candidate with its gains and shapes. Then
//
//   d = |(I - P) W g|
//
// is the root of the fall of chi^2 that would show that it is not the other candidate. The other candidate takes the
// shape of its grid that imitates best. The separation of a pair is the smaller d of both orders. Where one candidate
// can always imitate the other (an expansion is a lagged expansion with no lag), only the other order counts. The
// separation of a test is the smallest of all pairs. The test with the largest separation is proposed or, where none
// reaches 5, the test that separates most pairs.
//
// d agrees with chi^2 of simulated tests within a factor of 1.5. 1334 rows and 4 candidates take 0.06 s.
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
  double separation_so_far = 0.0;  // d of the data alone, for the pair that this test separates worst
};

// All tests that can be predicted from the data, the best separation first. The candidates are those of
// `diagnosis.equivalent`, else the two strongest that are not named. For a group with one member a test is judged by
// whether the effect would show again without the evidence of the old data. Returns an empty list without candidates,
// as for the verdict `nothing`, and for a diagnosis of other data. Does not throw.
std::vector<NextTest> next_tests(const Model& model, const Series& all, const Diagnosis& diagnosis);

}  // namespace ballbar
