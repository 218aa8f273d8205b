#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "ballbar/circle/circle.hpp"
#include "ballbar/error.hpp"
#include "ballbar/units.hpp"
#include "numerics/autocorrelation.hpp"

namespace ballbar {
namespace {

// Exact lengths of a circle of centre (a, b), radius R, height h over `arc_deg` from `start_deg`, n readings at
// mid-sample.
Recording exact(double a_um, double b_um, double radius_mm, double h_mm = 0.0, double start_deg = 0.0,
                double arc_deg = 360.0, int n = 720) {
  Recording recording;
  recording.height_offset_mm = h_mm;
  for (int i = 0; i < n; ++i) {
    const double angle_rad = rad_from_deg(start_deg + (i + 0.5) * arc_deg / n);
    const double x = a_um / 1e3 + radius_mm * std::cos(angle_rad);
    const double y = b_um / 1e3 + radius_mm * std::sin(angle_rad);
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(std::sqrt(x * x + y * y + h_mm * h_mm));
  }
  return recording;
}

std::string message_of(const Recording& recording) {
  try {
    fit_circle(recording);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

// Four readings at 0, 90, 180, 270 deg of a circle of R = 5 mm about c = (3, 0) mm: 8, sqrt(9 + 25), 2, sqrt(34).
TEST(CircleFit, FourReadingsByHand) {
  Recording recording;
  recording.nominal_length_mm = 5.0;
  recording.angle_rad = {0.0, kPi / 2, kPi, 3 * kPi / 2};
  recording.length_mm = {8.0, std::sqrt(34.0), 2.0, std::sqrt(34.0)};
  const Circle circle = fit_circle(recording);
  EXPECT_NEAR(circle.centre_a_um, 3000.0, 1e-6) << "1e-9 mm: double precision of mm";
  EXPECT_NEAR(circle.centre_b_um, 0.0, 1e-6);
  EXPECT_NEAR(circle.radius_mm, 5.0, 1e-9);
  EXPECT_EQ(circle.arc_deg, 360.0);
  EXPECT_TRUE(circle.converged);
}

TEST(CircleFit, ExactLengthsGiveTheCircleBack) {
  for (const double arc_deg : {360.0, 220.0, 100.0, 20.0}) {
    for (const double h_mm : {0.0, 5.0}) {
      const Circle circle = fit_circle(exact(500.0, -200.0, 100.003, h_mm, 250.0, arc_deg));
      SCOPED_TRACE(arc_deg);
      // 100 mm in double precision is 1.4e-11 um; 20 deg of arc magnify it by about 1e4.
      EXPECT_NEAR(circle.centre_a_um, 500.0, 1e-6);
      EXPECT_NEAR(circle.centre_b_um, -200.0, 1e-6);
      EXPECT_NEAR(circle.radius_mm, 100.003, 1e-9);
      EXPECT_NEAR(circle.arc_deg, arc_deg, 1e-9);
      EXPECT_LT(circle.rms_um, 1e-9);
    }
  }
}

// |c|^2 / 4R on average over the circle: 500^2 um^2 / 4e5 um = 0.625 um of radius; the rest is in cos 2 theta.
TEST(CircleFit, PolarCircleDiffersByTheSquareOfTheOffset) {
  CircleOptions polar;
  polar.model = CircleModel::polar;
  const Circle far = fit_circle(exact(500.0, 0.0, 100.0), polar);
  EXPECT_GT(std::abs(um_from_mm(far.radius_mm - 100.0)), 0.5);
  const Circle near = fit_circle(exact(5.0, 0.0, 100.0), polar);
  EXPECT_NEAR(um_from_mm(near.radius_mm - 100.0), 0.0, 2e-4) << "5^2 / 2e5 = 1.25e-4 um";
  EXPECT_NEAR(near.centre_a_um, 5.0, 2e-4);
}

// dL = 20 um at h = 5 mm: readings made at h + dL, the fit told of dL, gives R back and says 1.0007 um.
TEST(CircleFit, ElongationIsTakenOutInsideTheFit) {
  Recording lifted = exact(3.0, 4.0, 100.0, 5.02);
  lifted.height_offset_mm = 5.0;
  CircleOptions options;
  options.elongation_um = 20.0;
  const Circle circle = fit_circle(lifted, options);
  EXPECT_NEAR(um_from_mm(circle.radius_mm - 100.0), 0.0, 1e-6);
  EXPECT_NEAR(circle.elongation_correction_um, 1.000745, 1e-5);
  const Circle ignored = fit_circle(lifted);
  EXPECT_NEAR(um_from_mm(ignored.radius_mm - 100.0), 1.002, 1e-3) << "0.2004 / 200 mm in the plane";
  options.elongation_form = ElongationForm::eq34;
  EXPECT_NEAR(fit_circle(lifted, options).elongation_correction_um, 0.002, 1e-9);
}

// White noise of standard deviation s on a full circle: sigma of a, b is s sqrt(2/n), of R s / sqrt n.
TEST(CircleFit, SigmaOfAFullCircleIsTheTextbookOne) {
  Recording recording = exact(10.0, 5.0, 100.0, 0.0, 0.0, 360.0, 2000);
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, 0.2e-3);
  for (double& length : recording.length_mm) length += noise(random);
  const Circle circle = fit_circle(recording);
  EXPECT_NEAR(circle.sigma_reading_um, 0.2, 0.2 * 4.0 / std::sqrt(2.0 * 2000)) << "4 sigma of a standard deviation";
  EXPECT_NEAR(circle.sigma_centre_a_um(), circle.sigma_reading_um * std::sqrt(2.0 / 2000), 1e-5);
  EXPECT_NEAR(circle.sigma_radius_um(), circle.sigma_reading_um / std::sqrt(2000.0), 1e-5);
  EXPECT_EQ(circle.autocorrelation, 0.0);
  EXPECT_NEAR(circle.effective_readings, 2000.0, 1e-6);
}

TEST(CircleFit, PartialArcSaysHowLittleItKnows) {
  Recording full = exact(0.0, 0.0, 100.0, 0.0, 0.0, 360.0, 1500);
  Recording part = exact(0.0, 0.0, 100.0, 0.0, 0.0, 30.0, 1500);
  std::mt19937_64 random(8);
  std::normal_distribution<double> noise(0.0, 0.2e-3);
  for (double& length : full.length_mm) length += noise(random);
  for (double& length : part.length_mm) length += noise(random);
  const Circle wide = fit_circle(full);
  const Circle narrow = fit_circle(part);
  EXPECT_GT(narrow.sigma_radius_um(), 50.0 * wide.sigma_radius_um());
  EXPECT_LT(narrow.correlation_a_radius(), -0.99) << "along the arc's middle the centre moves against the radius";
  EXPECT_LT(std::abs(wide.correlation_a_radius()), 0.01);
}

// Readings of tests/study/arc.cpp in few lines: an oval u cos 2t + w sin 2t and noise with a memory of 3 deg.
Recording arc_with_oval(double arc_deg, int n, unsigned seed, double noise_um = 0.2) {
  Recording recording = exact(-5.0, -3.0, 100.0, 0.0, 10.0, arc_deg, n);
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const double keeps = std::exp(-arc_deg / n / 3.0);
  double memory_um = noise_um * normal(random);
  for (std::size_t i = 0; i < recording.length_mm.size(); ++i) {
    memory_um = keeps * memory_um + std::sqrt(1.0 - keeps * keeps) * noise_um * normal(random);
    const double twice_rad = 2.0 * recording.angle_rad[i];
    const double oval_um = 1.26 * std::cos(twice_rad) - 1.0 * std::sin(twice_rad);
    recording.length_mm[i] += mm_from_um(oval_um + memory_um + 0.5 * noise_um * normal(random));
  }
  return recording;
}

// 2 sigma hold 19 of 20, and 3 sigma all but 1 in 370: of 40 fits three outside 2.5 sigma (1 in 80) are too many.
TEST(CircleFit, AnArcsSigmaHoldsItsOval) {
  for (const double arc_deg : {110.0, 150.0, 200.0}) {
    int out = 0, out_alone = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
      const Recording recording = arc_with_oval(arc_deg, 400, seed);
      const Circle circle = fit_circle(recording);
      out += std::abs(circle.centre_b_um + 3.0) > 2.5 * circle.sigma_centre_b_um();
      const Circle alone = fit_circle(recording, {.oval = false});
      out_alone += std::abs(alone.centre_b_um + 3.0) > 2.5 * alone.sigma_centre_b_um();
      EXPECT_NEAR(circle.oval_um, std::hypot(0.5, 2.0), 1e-3) << "20 um/m of 100 mm, and 0.5 um";
      EXPECT_EQ(alone.oval_um, 0.0);
    }
    EXPECT_LE(out, 2) << arc_deg;
    if (arc_deg > 150.0) continue;  // the least-squares residual shows the oval, as one of a long memory
    EXPECT_GT(out_alone, 20) << arc_deg << ": the least-squares centre is off by more than its sigma";
  }
}

// Without noise the readings tell the oval from the centre on any arc.
TEST(CircleFit, AnExactOvalDoesNotMoveTheCentreOfAnArc) {
  const Circle circle = fit_circle(arc_with_oval(150.0, 400, 1, 0.0));
  EXPECT_NEAR(circle.centre_a_um, -5.0, 1e-3) << "second order of the centre: 5^2 / 2e5 um in lengths of an oval";
  EXPECT_NEAR(circle.centre_b_um, -3.0, 1e-3);
  EXPECT_NEAR(um_from_mm(circle.radius_mm - 100.0), 0.0, 1e-3);
  // Least squares of cos and sin 2 (t - 85 deg) on the arc: 2.71 of the one, 1.13 of the other.
  EXPECT_GT(std::abs(fit_circle(arc_with_oval(150.0, 400, 1, 0.0), {.oval = false}).centre_b_um + 3.0), 2.0);
}

TEST(CircleFit, AFullCircleAndARotaryAxisHaveNoOvalInTheirCentre) {
  Recording full = arc_with_oval(360.0, 720, 2);
  Recording rotary = arc_with_oval(150.0, 400, 3);
  rotary.motion = Motion::rotary_axis;
  for (const Recording& recording : {full, rotary}) {
    const Circle circle = fit_circle(recording), alone = fit_circle(recording, {.oval = false});
    EXPECT_EQ(circle.centre_a_um, alone.centre_a_um);
    EXPECT_EQ(circle.radius_mm, alone.radius_mm);
    EXPECT_EQ(circle.covariance_um2, alone.covariance_um2);
    EXPECT_EQ(circle.oval_um, 0.0);
  }
  // At 355 deg, which is an arc, the oval hardly moves it either.
  const Recording nearly = arc_with_oval(355.0, 710, 2);
  EXPECT_NEAR(fit_circle(nearly).centre_a_um, fit_circle(nearly, {.oval = false}).centre_a_um, 0.1);
}

TEST(CircleFit, APolarArcKeepsTheValuesOfTheInstrument) {
  const Recording recording = arc_with_oval(150.0, 400, 4);
  const Circle circle = fit_circle(recording, {.model = CircleModel::polar});
  const Circle alone = fit_circle(recording, {.model = CircleModel::polar, .oval = false});
  EXPECT_EQ(circle.centre_b_um, alone.centre_b_um);
  EXPECT_EQ(circle.radius_mm, alone.radius_mm);
  EXPECT_LT(std::abs(circle.centre_b_um + 3.0), 2.0 * circle.sigma_centre_b_um());
  EXPECT_GT(std::abs(alone.centre_b_um + 3.0), 4.0 * alone.sigma_centre_b_um());
}

// More readings than rows of the estimate enter as means, and the answer is that of fewer readings of as much noise.
TEST(CircleFit, AnArcOfManyReadingsIsThatOfTheirMeans) {
  const Circle many = fit_circle(arc_with_oval(150.0, 9000, 5));
  const Circle few = fit_circle(arc_with_oval(150.0, 1500, 5));
  for (const Circle& circle : {many, few}) {
    EXPECT_NEAR(circle.centre_a_um, -5.0, 3.0 * circle.sigma_centre_a_um());
    EXPECT_NEAR(circle.centre_b_um, -3.0, 3.0 * circle.sigma_centre_b_um());
    EXPECT_NEAR(circle.sigma_reading_um, 0.2, 0.05) << "0.22 um; the oval takes some of the memory";
  }
  EXPECT_NEAR(many.sigma_centre_b_um() / few.sigma_centre_b_um(), 1.0, 0.5) << "the memory, not the readings, counts";
}

TEST(CircleFit, AShortArcOrOneOfFewReadingsHasAWideSigma) {
  const Circle shortest = fit_circle(arc_with_oval(40.0, 200, 6));
  EXPECT_GT(shortest.sigma_centre_a_um(), 3.0);
  EXPECT_LT(std::abs(shortest.centre_a_um + 5.0), 3.0 * shortest.sigma_centre_a_um());
  const Circle few = fit_circle(arc_with_oval(120.0, 6, 7));
  EXPECT_GT(few.sigma_centre_b_um(), 2.0) << "an oval of 2.1 um moves the centre of 120 deg by up to 6 um";
  EXPECT_TRUE(few.covariance_um2.allFinite());
}

TEST(CircleFit, ARobustArcForgetsOutliers) {
  Recording recording = arc_with_oval(150.0, 400, 8);
  for (const std::size_t i : {30U, 31U, 250U}) recording.length_mm[i] += 0.05;  // 50 um
  const Circle circle = fit_circle(recording, {.robust = true});
  for (const std::size_t i : {30U, 31U, 250U}) {
    EXPECT_NE(std::find(circle.discounted.begin(), circle.discounted.end(), i), circle.discounted.end()) << i;
  }
  EXPECT_NEAR(circle.centre_b_um, -3.0, 3.0 * circle.sigma_centre_b_um());
  EXPECT_LT(circle.sigma_centre_b_um(), 1.5);
  EXPECT_GT(circle.rms_um, 4.0) << "of all readings: 50 um sqrt(3 / 400)";
}

TEST(CircleFit, RobustFitForgetsAndListsOutliers) {
  Recording recording = exact(20.0, -30.0, 100.0, 0.0, 0.0, 360.0, 1000);
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.2e-3);
  for (double& length : recording.length_mm) length += noise(random);
  for (const std::size_t i : {100U, 101U, 500U}) recording.length_mm[i] += 0.05;  // 50 um
  CircleOptions robust;
  robust.robust = true;
  const Circle circle = fit_circle(recording, robust);
  for (const std::size_t i : {100U, 101U, 500U}) {
    EXPECT_NE(std::find(circle.discounted.begin(), circle.discounted.end(), i), circle.discounted.end()) << i;
  }
  EXPECT_LT(circle.discounted.size(), 10U) << "a tenth of weight is 3.9 sigma: 0.1 of 1000 readings by chance";
  EXPECT_NEAR(circle.centre_a_um, 20.0, 5.0 * circle.sigma_centre_a_um());
  EXPECT_LT(circle.sigma_centre_a_um(), 0.012) << "0.2 sqrt(2/1000) = 0.009 um, and the price of 95 % efficiency";
  EXPECT_TRUE(fit_circle(recording).discounted.empty());
}

// A fifth of the readings 5 to 20 um too long, 40 seeds: the radius stays within 4 of its sigmas.
TEST(CircleFit, RobustFitHoldsWithAFifthOffToOneSide) {
  CircleOptions robust;
  robust.robust = true;
  for (unsigned seed = 0; seed < 40; ++seed) {
    Recording recording = exact(20.0, -30.0, 100.0, 0.0, 0.0, 360.0, 360);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0.0, 0.2e-3);
    std::uniform_real_distribution<double> uniform;
    for (double& length : recording.length_mm) {
      length += noise(random);
      if (uniform(random) < 0.2) length += (5.0 + 15.0 * uniform(random)) * 1e-3;
    }
    const Circle circle = fit_circle(recording, robust);
    EXPECT_NEAR(um_from_mm(circle.radius_mm - 100.0), 0.0, 4.0 * circle.sigma_radius_um()) << "seed " << seed;
    EXPECT_LT(circle.sigma_radius_um(), 0.02) << "0.2 / sqrt(288) = 0.012 um";
  }
}

TEST(CircleFit, RoundingIsNotAutocorrelation) {
  const Circle circle = fit_circle(exact(5.0, 3.0, 100.0));
  EXPECT_EQ(circle.autocorrelation, 0.0);
}

TEST(CircleFit, ResidualIsReadingMinusFit) {
  Recording recording = exact(0.0, 0.0, 100.0);
  recording.length_mm[10] += 1e-3;
  const Eigen::ArrayXd residual = residual_um(recording, fit_circle(recording));
  EXPECT_NEAR(residual[10], 1.0, 0.01) << "3/720 of it goes into the circle";
  EXPECT_LT(residual[11], 0.0);
}

TEST(CircleFit, ChangeIsAsUncertainAsWhatDoesNotRepeat) {
  Recording first = exact(0.0, 0.0, 100.0);
  for (std::size_t i = 0; i < first.length_mm.size(); ++i)
    first.length_mm[i] += 2e-3 * std::cos(2.0 * first.angle_rad[i]);
  Recording second = first;
  for (std::size_t i = 0; i < first.length_mm.size(); ++i) second.length_mm[i] += 5e-3 * std::cos(first.angle_rad[i]);
  const Circle a = fit_circle(first);
  const Circle b = fit_circle(second);
  EXPECT_GT(a.sigma_centre_a_um(), 0.1) << "an oval of 2 um is in the residual";
  const Eigen::Matrix3d repeated = covariance_of_change_um2(second, b, first, a);
  EXPECT_LT(std::sqrt(repeated(0, 0)), 0.01) << "but the same in both";
  second.angle_rad.pop_back();
  second.length_mm.pop_back();
  const Eigen::Matrix3d apart = covariance_of_change_um2(second, b, first, a);
  EXPECT_NEAR(apart(0, 0), a.covariance_um2(0, 0) + b.covariance_um2(0, 0), 1e-12);
}

TEST(CircleFit, RefusesWhatGivesNoCircle) {
  Recording few = exact(0.0, 0.0, 100.0, 0.0, 0.0, 360.0, 3);
  EXPECT_EQ(message_of(few), "a circle fit needs at least 4 readings, found 3");
  EXPECT_EQ(message_of(exact(0.0, 0.0, 100.0, 0.0, 10.0, 4.0)),
            "the readings cover 4 deg of arc; below 5 deg centre and radius cannot be told apart");
  Recording one_angle = exact(0.0, 0.0, 100.0);
  for (double& angle : one_angle.angle_rad) angle = 1.0;
  EXPECT_NE(message_of(one_angle), "no error");
  Recording axial = few;
  axial.kind = Kind::axial;
  EXPECT_EQ(message_of(axial), "an axial recording has no circle to fit; expected a circle recording");
  Recording odd = exact(0.0, 0.0, 100.0);
  odd.angle_rad.pop_back();
  EXPECT_EQ(message_of(odd), "a circle recording needs an angle for each length, found 719 angles and 720 lengths");
  Recording high = exact(0.0, 0.0, 100.0);
  high.height_offset_mm = 120.0;
  EXPECT_EQ(message_of(high), "a reading of 100 mm is not longer than the height difference of the balls, 120 mm");
}

// Two angles only, many readings at each: two equations for three unknowns.
TEST(CircleFit, UndeterminedIsInfinite) {
  Recording recording;
  for (int i = 0; i < 20; ++i) {
    recording.angle_rad.push_back(i % 2 == 0 ? 0.0 : 0.5);
    recording.length_mm.push_back(100.0 + (i % 3) * 1e-4);
  }
  std::string said = message_of(recording);
  if (said == "no error") {
    EXPECT_TRUE(std::isinf(fit_circle(recording).sigma_radius_um()));
  } else {
    EXPECT_EQ(said, "the 20 points lie on one line, no circle goes through them");
  }
}

// Gander, Golub, Strebel 1994, six points; values as published to 7 digits.
TEST(AlgebraicCircle, PublishedSixPoints) {
  Eigen::ArrayXd x(6);
  Eigen::ArrayXd y(6);
  x << 1, 2, 5, 7, 9, 3;
  y << 7, 6, 8, 7, 5, 7;
  const PlaneCircle hyper = algebraic_circle(x, y);
  EXPECT_NEAR(hyper.centre_x, 4.615482, 1e-6);
  EXPECT_NEAR(hyper.centre_y, 2.807354, 1e-6);
  EXPECT_NEAR(hyper.radius, 4.827575, 1e-6);

  // The geometric circle is that of the polar points.
  Recording recording;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    recording.angle_rad.push_back(std::atan2(y[i], x[i]));
    recording.length_mm.push_back(std::hypot(x[i], y[i]));
  }
  const Circle geometric = fit_circle(recording, {.model = CircleModel::polar});
  EXPECT_NEAR(mm_from_um(geometric.centre_a_um), 4.739782, 1e-6);
  EXPECT_NEAR(mm_from_um(geometric.centre_b_um), 2.983533, 1e-6);
  EXPECT_NEAR(geometric.radius_mm, 4.714226, 1e-6);
  EXPECT_NEAR(mm_from_um(geometric.rms_um), 0.4523271, 1e-7);
}

TEST(AlgebraicCircle, RefusesALine) {
  EXPECT_THROW(algebraic_circle(Eigen::ArrayXd::LinSpaced(5, 0, 1), Eigen::ArrayXd::LinSpaced(5, 0, 2)), Error);
  EXPECT_THROW(algebraic_circle(Eigen::ArrayXd::Zero(2), Eigen::ArrayXd::Zero(2)), Error);
}

// AR(1) with phi = 0.9 from its own recursion; a white series is called white.
TEST(Autocorrelation, OfAnAr1AndOfWhiteNoise) {
  std::mt19937_64 random(10);
  std::normal_distribution<double> noise;
  Eigen::ArrayXd white(20000);
  Eigen::ArrayXd red(20000);
  double state = 0.0;
  for (Eigen::Index i = 0; i < white.size(); ++i) {
    white[i] = noise(random);
    state = 0.9 * state + std::sqrt(1.0 - 0.81) * noise(random);
    red[i] = state;
  }
  EXPECT_EQ(least_squares::autocorrelation_of(white).share, 0.0);
  const auto rho = least_squares::autocorrelation_of(red);
  EXPECT_NEAR(rho.phi, 0.9, 0.02) << "5 sigma of sqrt((1 - phi^2)/n) = 0.003, and of the lags used";
  EXPECT_NEAR(rho.share, 1.0, 0.03);
  const auto mixed = least_squares::autocorrelation_of(red + white);
  EXPECT_NEAR(mixed.share, 0.5, 0.06) << "half of the variance is white";
}

}  // namespace
}  // namespace ballbar
