// What study_machine_errors holds its figures against: shares of tests.
#pragma once

// Of a 6th harmonic on one run: said to be left, at least; a wrong error named, at most.
struct OfSixth {
  double left = 0.95, named = 0.05;
};

struct Ranges {
  double coverage_low = 0.93, coverage_high = 0.97;  // of each parameter
  double cyclic_low = 0.93;                          // of the amplitudes, which each axis takes of the other's
  double any = 0.05;                                 // named or left where nothing is hidden, at most
  double one = 0.95;                                 // named, at least
  double wrong = 0.01;                               // beside it, at most
  double several = 0.85;                             // all of them, at least
  double wrong_of_several = 0.05;
  OfSixth sixth_1_um = {}, sixth_2_um = {};
  double spike = 0.98;     // of 1 um at one axis: named, at least
  double no_spike = 0.01;  // named where there is none, at most
};

constexpr Ranges kAim;

// What is reached today, of 200 to 500 seeds; to be narrowed to the aim where it gets there.
constexpr Ranges kFull{.coverage_low = 0.93,
                       .coverage_high = 0.985,
                       .cyclic_low = 0.90,
                       .one = 0.84,
                       .wrong = 0.01,
                       .several = 0.62,
                       .wrong_of_several = 0.03,
                       .sixth_1_um = {0.82, 0.05},
                       .sixth_2_um = {0.97, 0.10}};
constexpr Ranges kArc{.coverage_low = 0.90,
                      .coverage_high = 0.98,
                      .cyclic_low = 0.89,
                      .one = 0.72,
                      .wrong = 0.03,
                      .several = 0.46,
                      .wrong_of_several = 0.08,
                      .sixth_1_um = {0.06, 0.05},
                      .sixth_2_um = {0.95, 0.54}};
constexpr Ranges kArcAlone{.coverage_low = 0.92,
                           .coverage_high = 0.98,
                           .cyclic_low = 0.90,
                           .one = 0.90,
                           .wrong = 0.015,
                           .several = 0.83,
                           .wrong_of_several = 0.03,
                           .sixth_1_um = {0.02, 0.05},
                           .sixth_2_um = {0.55, 0.60}};
