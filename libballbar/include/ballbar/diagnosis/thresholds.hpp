// Every threshold of a diagnosis, in the order in which it is met (src/diagnosis/README.md).
//
// d: root of the fall of chi^2. ln: of a likelihood. P, shares: 0 to 1.
#pragma once

#include <array>
#include <cstddef>

namespace ballbar {

// Inputs as they were logged.
inline constexpr std::size_t kFewestChanges = 8;   // of a column, for its sample to be told
inline constexpr double kBends = 0.9;              // share of the square of a column's bends, at the samples it joins
inline constexpr std::size_t kLongestHeld = 12;    // rows
inline constexpr double kJump = 0.03;              // of a column's range, from row to row
inline constexpr double kLongestRamp_s = 90.0;     // a change that takes longer is none at once
inline constexpr double kLongestSample_s = 120.0;  // of a logger
inline constexpr double kJumpTime = 0.35;          // sd of when in its sample an input changed, in samples
inline constexpr double kLargeChange = 3.0;        // times the usual change of a temperature from sample to sample
inline constexpr std::size_t kMostChanges = 20;    // of a temperature
inline constexpr double kChangeTime = 0.25;        // sd of where between straight and at once it went
inline constexpr double kClockTime = 0.6;          // sd of how late a clock is, in samples
inline constexpr std::size_t kMostTimes = 40;      // columns
inline constexpr double kUnknownRow = 1e6;         // variance of a reading that tells nothing, of the others'

// Shapes of an effect that are tried.
inline constexpr std::size_t kMostOnsets = 400;
inline constexpr std::size_t kMostPeriods = 200;
inline constexpr std::size_t kMostWaves = 400;  // of one shape on recordings
inline constexpr std::array<double, 8> kFormLags_s{0.0,    120.0,  300.0,   800.0,
                                                   2000.0, 5000.0, 12000.0, 30000.0};  // of any form
inline constexpr std::array<double, 5> kFormLagsOfSquare_s{0.0, 200.0, 700.0, 2500.0, 8000.0};
inline constexpr std::array<double, 3> kFormLagsSquared_s{300.0, 2000.0, 10000.0};

// Detectability: what a signature could show, before any residual is looked at.
inline constexpr double kDetectable = 5.0;          // d
inline constexpr double kIdentifiable = 7.5;        // d
inline constexpr double kFound = 7.0;               // d from which a diagnosis finds an effect
inline constexpr double kAbsorbed = 0.05;           // share of a signature's square: with less left it is the model's
inline constexpr double kInseparable = 0.95;        // coherence of two effects that cannot be told apart
inline constexpr std::size_t kComparedShapes = 12;  // of one family, compared with those of the others
inline constexpr double kNothingLeft = 1e-8;        // share of a column's square that is rounding

// Priors.
inline constexpr std::size_t kLargestSet = 3;                                          // effects
inline constexpr std::size_t kValuesForAnEffect = 4;                                   // rows beyond the model's
inline constexpr std::array<double, 4> kPriorOfSize{0.5, 0.3, 0.15, 0.05};             // sets of 0, 1, 2, 3 effects
inline constexpr std::array<double, 6> kGainSizes{4.0, 8.0, 16.0, 32.0, 64.0, 128.0};  // d of a gain, alike
inline constexpr double kPriorOfOwn = 0.2;  // that a value which the model holds is another
inline constexpr double kPriorOfDiscrepancy = 0.25;
inline constexpr std::size_t kFewestForMemory = 30;    // rows; with fewer the scatter is white
inline constexpr std::size_t kMemories = 12;           // of the scatter
inline constexpr std::size_t kMemoriesBesideSlow = 4;  // of the scatter beside a discrepancy
inline constexpr double kRichestNoise = 0.5;           // power of what the richest model says of the scatter

// Effort.
inline constexpr double kSurvivingShare = 1e-3;    // of a signature's square beside the model, to be weighed
inline constexpr double kLikelyPoints = 9.0;       // ln: covariances this far from the likeliest count
inline constexpr std::size_t kMostPoints = 24;     // covariances
inline constexpr std::size_t kThinShapes = 6;      // of a family, where all covariances are looked at
inline constexpr std::size_t kThinColumns = 700;   // there, of all families together
inline constexpr std::size_t kThinnedFurther = 3;  // where two are looked for together: every third of those
inline constexpr std::size_t kStrongest = 3;       // effects beside which a second is looked for everywhere
inline constexpr std::size_t kFamiliesInPairs = 48;
inline constexpr std::size_t kShapesInPairs = 320;   // of all families together
inline constexpr std::size_t kPairPoints = 4;        // covariances at which pairs are weighed
inline constexpr std::size_t kPairsRefined = 10;     // on finer grids
inline constexpr std::size_t kColumnsRefined = 360;  // of those together
inline constexpr std::size_t kShapesRefined = 48;    // of a family
inline constexpr std::size_t kPairsExtended = 4;     // to triples
inline constexpr double kFarFromBest = 12.0;         // ln: sets this far are not refined
inline constexpr int kRelinearised = 2;              // rounds
inline constexpr std::size_t kSetsRelinearised = 8;  // in a round
inline constexpr double kMovesTheModel = 15.0;  // ln, gained by an effect beside which the model is looked for anew
inline constexpr std::array<double, 3> kTimesOfModels_s{300.0, 1500.0, 7000.0};  // from which one is looked for
inline constexpr double kFarModel = 0.3;                                         // of a shape's reach, that it moves it
inline constexpr std::size_t kPointsOfNothing = 4;  // covariances kept where nothing more is likely
inline constexpr double kSameModel = 0.02;          // the same, that it is there already
inline constexpr double kStrong = 60.0;             // ln, gained by a set whose shapes become points of the grid
inline constexpr double kSameShape = 0.01;          // relative
inline constexpr int kStepsBeside = 4;              // of Gauss and Newton

// Readings that are weighed again.
inline constexpr double kLateClock = 12.0;       // fall of chi^2 by what rows at jumps show of a clock that is late
inline constexpr double kOutlier = 2.0;          // (r^2 + 4) / 5 of a white reading r in heavy tails
inline constexpr double kOutlierVariance = 3.0;  // factor, beside that, of the variance of its white part

// Tests of a member of a set.
inline constexpr double kLeastLikelihoodRatio = 10.0;  // 2 ln of a ratio of likelihoods: 150 to 1
inline constexpr double kSameGain = 0.003;             // p_same_gain below which gains differ
inline constexpr double kOwnDirection = 1e-3;          // pivot of a gain of one cycle, of the largest, that is one
inline constexpr double kHeldOutEvidence = 3.0;        // ln, of cycles left out, without the best one
inline constexpr double kLeftOutRidge = 1e-4;          // prior precision of a white column of length 1
inline constexpr double kInOneFold = 0.9;              // share of what it shows
inline constexpr double kRivalBetter = -1.0;           // ln, by which an input of any form is better than a member
inline constexpr double kAnyFormBetter = -2.0;         // ln, by which it alone is more probable than the whole set
inline constexpr double kCancelled = 1.5;              // amplitude of a member, of that of all together
inline constexpr std::size_t kSurrogates = 200;
inline constexpr std::size_t kSurrogateShapes = 8;   // of an effect
inline constexpr std::size_t kSurrogateGrid = 1024;  // values over the time
inline constexpr std::size_t kTraceGrid = 512;       // values over the angle
inline constexpr std::size_t kFewestOfASweep = 16;   // readings
inline constexpr double kSameOnRecordings = 0.01;    // share of the square by which curves on recordings may differ
inline constexpr double kSurrogateIsItself = 0.95;   // coherence
inline constexpr double kMostAreItself = 0.01;       // share of the surrogates
inline constexpr double kNothingLeftOfASurrogate = 1e-6;  // share of its square, read off a grid, that is rounding

// Verdict.
inline constexpr double kNothing = 0.05;       // P of nothing from which nothing is said
inline constexpr double kNamed = 0.9;          // P
inline constexpr double kProbable = 0.8;       // P
inline constexpr double kSureDriver = 0.9;     // P
inline constexpr double kDiscrepancy = 0.5;    // P of a discrepancy from which nothing is named
inline constexpr double kCredible = 0.95;      // share of the posterior in a credible set
inline constexpr double kMinor = 0.05;         // of the RMSE
inline constexpr std::size_t kMostShown = 12;  // candidates

// A run that is followed.
inline constexpr std::size_t kFirstLook = 64;       // values of the target
inline constexpr double kLookGrowth = 13.0 / 12.0;  // values of a look, of those of the look before
inline constexpr std::size_t kMostLooks = 100;      // the last at 177 000 values
inline constexpr double kFalselyDecided = 0.02;     // of runs in which nothing is hidden, at most; of what is decided
inline constexpr std::size_t kLooksToDecide = 3;    // in a row that say the same
inline constexpr double kTwinNow = 0.1;             // P of a rival that no reading tells from the first
inline constexpr double kTwinMoves = 0.2;           // ln of the odds of both, over the last half of the values
inline constexpr double kForecastSigmas = 2.0;      // of ln of odds, forecast to the planned end

// Effects of a model.
inline constexpr double kDropTest = 0.05;           // P that one is not needed, below which it is
inline constexpr double kDropTestOfErrors = 0.001;  // p of chi^2, the same of errors of the axes

// The next test.
inline constexpr double kSureEnough = 0.95;            // P(right) of a test from which no longer one is looked for
inline constexpr double kSureOfNothing = 0.8;          // P of nothing from which no test is looked for
inline constexpr double kLeastPromise = 0.1;           // P(right) below which none is proposed
inline constexpr std::size_t kCurvesShown = 6;         // hypotheses
inline constexpr double kUseless = 1.0;                // d
inline constexpr double kImitated = 1.0;               // d of an effect that another makes whatever is done
inline constexpr double kNearlyImitated = 0.2;         // the same: d over that of the other order
inline constexpr std::size_t kComparedPoints = 60;     // of the shapes of all candidates
inline constexpr double kUntilTest_s = 12.0 * 3600.0;  // from the end of the data
inline constexpr double kBelieved = 0.5;               // R2 of the prediction of a column

}  // namespace ballbar
