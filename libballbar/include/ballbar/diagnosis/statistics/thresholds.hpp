// Every threshold of a diagnosis, in the order in which it is met.
//
// d: root of the fall of chi^2. 2 ln L: twice the logarithm of the likelihood. Shares and chances: 0 to 1.
#pragma once

#include <array>
#include <cstddef>

namespace ballbar {

// Shapes of an effect that are tried.
inline constexpr std::size_t kMostOnsets = 400;
inline constexpr std::size_t kMostPeriods = 200;
inline constexpr std::size_t kMostWaves = 400;  // of one shape on recordings

// Detectability: what a signature could show, before any residual is looked at.
inline constexpr double kDetectable = 5.0;          // d
inline constexpr double kIdentifiable = 7.5;        // d
inline constexpr double kAbsorbed = 0.05;           // share of a signature's square: with less left it is the model's
inline constexpr double kInseparable = 0.95;        // coherence of two effects that cannot be told apart
inline constexpr std::size_t kComparedShapes = 12;  // of one family, compared with those of the others
inline constexpr double kNothingLeft = 1e-8;        // share of a column's square that is rounding
inline constexpr double kNothingLeftOfASurrogate = 1e-6;  // the same of a surrogate, read off a grid
inline constexpr double kNotInTheseRows = 1e-12;          // share of a column's square in some of the rows that is none

// The posterior over sets of effects.
inline constexpr std::size_t kFewestForMemory = 30;      // rows; with fewer the scatter is white
inline constexpr std::size_t kMemories = 12;              // of the scatter
inline constexpr std::size_t kMemoriesBesideSlow = 4;    // of the scatter beside a discrepancy
inline constexpr std::array<double, 6> kGainSizes{4.0, 8.0, 16.0, 32.0, 64.0, 128.0};  // d, prior of a gain
inline constexpr std::array<double, 4> kPriorOfSize{0.5, 0.3, 0.15, 0.05};             // of sets of 0, 1, 2, 3 effects
inline constexpr double kRichestNoise = 0.5;             // power of what the richest model says of the noise
inline constexpr double kPriorOfDiscrepancy = 0.25;
inline constexpr double kPriorOfOwn = 0.1;               // a value that the model holds is another
inline constexpr double kSurvivingShare = 1e-3;          // of a signature's square beside the model
inline constexpr double kLikelyPoints = 9.0;             // ln: covariances this far from the likeliest count
inline constexpr std::size_t kMostPoints = 24;
inline constexpr std::size_t kThinShapes = 6;            // of a family, where all covariances are looked at
inline constexpr std::size_t kThinnedFurther = 3;        // where two are looked for together: every third of those
inline constexpr std::size_t kStrongest = 3;             // effects beside which a second is looked for everywhere
inline constexpr std::size_t kFamiliesInPairs = 48;
inline constexpr std::size_t kShapesInPairs = 320;       // of all families together
inline constexpr std::size_t kPairPoints = 4;            // covariances at which pairs are weighed
inline constexpr std::size_t kPairsRefined = 10;
inline constexpr std::size_t kThinColumns = 700;         // there, of all families together
inline constexpr std::size_t kColumnsRefined = 360;      // of the pairs refined
inline constexpr std::size_t kShapesRefined = 48;        // of a family
inline constexpr std::size_t kPairsExtended = 4;
inline constexpr double kFarFromBest = 12.0;             // ln
inline constexpr int kRelinearised = 2;                  // rounds
inline constexpr std::size_t kSetsRelinearised = 8;      // in a round
inline constexpr int kStepsBeside = 4;
inline constexpr std::array<double, 6> kFormLags_s{0.0, 180.0, 600.0, 1800.0, 5400.0, 16000.0};  // of an input
inline constexpr std::array<double, 3> kFormLagsOfSquare_s{0.0, 1200.0, 7200.0};

// Verdict.
inline constexpr double kNamed = 0.9;              // P
inline constexpr double kProbable = 0.8;           // P
inline constexpr double kSureDriver = 0.9;         // P
inline constexpr double kNothing = 0.05;           // P of nothing from which nothing is said
inline constexpr double kDiscrepancy = 0.5;        // P of a discrepancy from which nothing is named
inline constexpr double kCredible = 0.95;          // share of the posterior in a credible set
inline constexpr double kRivalBetter = 0.0;        // ln, by which an input of any form is better than a member
inline constexpr double kAnyFormBetter = -1.0;     // ln, by which it alone is more probable than the whole set
inline constexpr double kHeldOutEvidence = 3.0;    // ln, of cycles left out, without the best one
inline constexpr double kLeftOutRidge = 1e-4;      // prior precision of a white column of length 1
inline constexpr double kFound = 7.0;              // d from which an effect is found
inline constexpr double kUnknownRow = 1e6;         // variance of a reading that tells nothing, of the others'
inline constexpr double kOutlier = 2.0;            // times the usual variance: (r^2 + 4) / 5 of a white reading r
inline constexpr double kOutlierVariance = 3.0;    // of such a reading's white part, more
inline constexpr double kLateClock = 12.0;         // fall of chi^2 by what rows at jumps show of a clock that is late

// Inputs as they were logged.
inline constexpr std::size_t kFewestChanges = 8;   // of a column, for its sample to be told
inline constexpr double kBends = 0.9;              // share of the square of a column's bends, at the samples it joins
inline constexpr std::size_t kLongestHeld = 12;    // rows
inline constexpr double kJump = 0.03;              // of a column's range, from row to row
inline constexpr double kLongestRamp_s = 90.0;     // a change that takes longer is none at once
inline constexpr double kLongestSample_s = 120.0;  // of a logger
inline constexpr double kJumpTime = 0.35;          // sd of when in its sample an input changed
inline constexpr double kLargeChange = 3.0;        // times the usual change of a temperature from sample to sample
inline constexpr std::size_t kMostChanges = 20;
inline constexpr double kChangeTime = 0.25;        // sd of where between straight and at once it went
inline constexpr double kClockTime = 0.6;          // sd of how late its clock is, in samples
inline constexpr std::size_t kMostTimes = 40;      // columns

// Noise.
inline constexpr std::ptrdiff_t kFewestForNoise = 30;  // rows; with fewer it is white and not estimated for every set
inline constexpr int kFitsByNoise = 8;                 // fits by the noise of the fit before
inline constexpr double kWorthAnotherRound = 0.01;     // ln L
inline constexpr std::size_t kPlausibleNoises = 64;    // of which data sets without any effect are drawn

// Errors of a search: share of data sets without any effect that show as much.
inline constexpr double kErrorOfASearch = 0.01;
inline constexpr double kErrorOfTimeOnly = 0.001;  // of what needs nothing but time, and so imitates anything slow
inline constexpr std::size_t kDraws = 2000;        // of data sets without any effect
inline constexpr double kTail = 0.1;               // share of the draws from which a tail is told
inline constexpr std::size_t kFewestDraws = 100;   // fewer have no tail

// Subsets of signatures on the grid.
inline constexpr std::size_t kLargestSet = 3;         // effects
inline constexpr std::size_t kValuesForAnEffect = 4;  // rows beyond the parameters of the model
inline constexpr double kSameDirection = 0.98;        // coherence of signatures that are not fitted together
inline constexpr double kPriceInSearch = 10.0;        // of an effect, chi^2, before there are thresholds
inline constexpr double kPrice = 14.0;                // of an effect, 2 ln L, the same
inline constexpr double kClearlyMore = 0.5;           // 2 ln L
inline constexpr std::size_t kPairsOfFamilies = 25;   // of which all shapes are tried
inline constexpr std::size_t kTriplesOfAPair = 4;
inline constexpr std::size_t kFamiliesOfAnEffect = 6;
inline constexpr std::size_t kShapesOfAFamily = 6;
inline constexpr std::size_t kSubsetsKept = 40;
inline constexpr std::size_t kBestOfEverySize = 5;  // subsets by which the noise is told
inline constexpr std::size_t kSearchRounds = 3;     // of noise and subsets in turn

// Subsets that are fitted.
inline constexpr std::size_t kWorthALook = 20;    // subsets
inline constexpr double kWorthRefitting = 12.0;   // 2 ln L from the best
inline constexpr double kGridError = 0.1;         // share of the likelihood ratio that a point of a grid may lack
inline constexpr std::size_t kMostRefitted = 14;  // sets of one effect; half as many more for every other one
inline constexpr double kFarFromGood = 40.0;      // 2 ln L less thresholds: not worth another fit
inline constexpr std::size_t kInPlaceRounds = 2;
inline constexpr std::size_t kMostInPlace = 8;  // of one effect of a fitted set
inline constexpr std::size_t kMostSwaps = 20;   // of one effect of a set on the grid
inline constexpr double kNearlyAsMuch = 0.8;    // share of the fall of chi^2 of the effect that is replaced
inline constexpr double kSurvives = 0.04;       // share of a signature beside the others of its set

// What the data leave open.
inline constexpr double kNearlyAsGood = 6.0;        // 2 ln L, less thresholds or of sets of one size
inline constexpr double kThreeNearlyAsGood = 12.0;  // 2 ln L less thresholds of sets of three
inline constexpr double kSameCurve = 2.0;           // chi^2 of the difference of two curves
inline constexpr double kSameShare = 0.01;          // of a curve's chi^2

// Tests that an effect has to pass to be named.
inline constexpr double kLeastLikelihoodRatio = 10.0;  // 2 ln of a ratio of likelihoods: 150 to 1
inline constexpr double kSameGain = 0.003;             // p_same_gain below which gains differ
inline constexpr double kOwnDirection = 1e-3;          // pivot of a gain of one cycle, of the largest, that is one
inline constexpr double kInOneFold = 0.9;              // share of what it shows
inline constexpr double kHeldOutWorse = 1.05;          // of the RMSE, which a slow noise makes up by itself
inline constexpr double kLeastReach_um = 1e-3;         // of a shape that is 0
inline constexpr double kTold = 1e-6;                  // pivot of a column, of the largest, that rows left in tell
inline constexpr double kMinor = 0.05;                 // of the RMSE
inline constexpr double kDropTest = 0.05;              // P that an effect of the model is not needed, below which it is
inline constexpr double kDropTestOfErrors = 0.001;     // p of chi^2, the same for errors of the axes

// Surrogates.
inline constexpr std::size_t kSurrogates = 200;
inline constexpr std::size_t kSurrogateShapes = 8;   // of an effect
inline constexpr std::size_t kSurrogateGrid = 1024;  // values over the time
inline constexpr std::size_t kTraceGrid = 512;       // values over the angle
inline constexpr std::size_t kFewestOfASweep = 16;   // readings
inline constexpr double kSameOnRecordings = 0.01;    // share of the square by which curves on two recordings may differ
inline constexpr double kSurrogateIsItself = 0.95;   // coherence
inline constexpr double kMostAreItself = 0.01;       // share of the surrogates

// Verdict.
inline constexpr double kSmoothLikelihoodRatio = 18.0;  // 2 ln L of a smooth curve that is more than noise
inline constexpr double kWhite = 0.001;                 // p of the spectrum of what is left
inline constexpr double kClustered = 0.001;             // chance of readings far from the others where they are
inline constexpr double kAfterChange_s = 600.0;         // where such readings lie
inline constexpr double kCancels = 1.5;                 // times the range of all effects of a set together
inline constexpr std::size_t kShown = 8;                // candidates
inline constexpr std::size_t kShownInQuestion = 12;
inline constexpr double kAssociation = 0.7;            // of the held-out RMSE
inline constexpr std::size_t kAssociationsFitted = 8;  // effects
inline constexpr std::size_t kAssociationColumns = 2;  // choices of columns
inline constexpr std::size_t kAssociationRounds = 4;   // fits by the noise of the fit before
inline constexpr std::size_t kAssociationsShown = 4;

// The next test.
inline constexpr double kUseless = 1.0;                // d
inline constexpr double kImitated = 1.0;               // d of an effect that another makes whatever is done
inline constexpr double kNearlyImitated = 0.2;         // the same: d over that of the other order
inline constexpr std::size_t kComparedPoints = 60;     // of the shapes of all candidates
inline constexpr double kUntilTest_s = 12.0 * 3600.0;  // from the end of the data
inline constexpr double kBelieved = 0.5;               // R2 of the prediction of a column

}  // namespace ballbar
