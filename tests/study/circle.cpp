// How often the 95 % intervals of a circle fit hold the truth, and how far the fit is off on average.
//
//   study_circle [SEEDS]        2000 unless given; every seed is another noise
//
// The recordings are simulated by the virtual machine (forward kinematics), 0.2 um noise, 1500 readings,
// resolution off. The path of an arc has no oval, and the circle is fitted alone; arcs with one: arc.cpp. Fails (exit
// 1) where a figure leaves the range stated in its row. At 2000 seeds the standard deviation of a coverage of 95 % is
// 0.5 %, of the mean of a centre 0.0002 um.
#include "ballbar/circle/circle.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "ballbar/lab/simulation/simulate.hpp"
#include "ballbar/units.hpp"

namespace {

using namespace ballbar;

struct Case {
  const char* name;
  double arc_deg;
  double autocorrelation;
  double offset_um;  // set-up offset along +A
  CircleModel model;
  bool robust;
  double outlier_share;
  double lowest_coverage, highest_coverage;  // of each of a, b, R
  double largest_bias_um;                    // of a, b, R
};

// a polar fit under 0.5 mm offset is biased by design of the method: shown, not judged (bias 1e9).
constexpr double kNotJudged = 1e9;
constexpr Case kCases[] = {
    {"full circle", 360.0, 0.0, 0.0, CircleModel::length_equation, false, 0.0, 0.93, 0.97, 0.005},
    {"full circle, 0.5 mm offset", 360.0, 0.0, 500.0, CircleModel::length_equation, false, 0.0, 0.93, 0.97, 0.005},
    {"  the same, --polar", 360.0, 0.0, 500.0, CircleModel::polar, false, 0.0, 0.0, 1.0, kNotJudged},
    {"100 deg arc", 100.0, 0.0, 0.0, CircleModel::length_equation, false, 0.0, 0.93, 0.97, 0.005},
    {"100 deg arc, 0.5 mm offset", 100.0, 0.0, 500.0, CircleModel::length_equation, false, 0.0, 0.93, 0.97, 0.005},
    {"  the same, --polar", 100.0, 0.0, 500.0, CircleModel::polar, false, 0.0, 0.0, 1.0, kNotJudged},
    {"full circle, AR 0.9", 360.0, 0.9, 0.0, CircleModel::length_equation, false, 0.0, 0.90, 0.97, 0.005},
    {"100 deg arc, AR 0.9", 100.0, 0.9, 0.0, CircleModel::length_equation, false, 0.0, 0.90, 0.97, 0.02},
    {"full circle, --robust", 360.0, 0.0, 0.0, CircleModel::length_equation, true, 0.0, 0.93, 0.97, 0.005},
    {"full circle, 5 % outliers of 20 um, --robust", 360.0, 0.0, 0.0, CircleModel::length_equation, true, 0.05, 0.93,
     0.97, 0.005},
};

Recording simulated(const Case& one, std::uint64_t seed) {
  VirtualMachine machine;
  machine.method = Method::circles;
  machine.truth = {TruePosition{}};
  machine.test_s = {0.0};
  machine.bar.noise_um = 0.2;
  machine.bar.resolution_um = 0.0;
  machine.bar.autocorrelation = one.autocorrelation;
  machine.bar.outlier_share = one.outlier_share;
  machine.bar.outlier_um = 20.0;
  machine.circle = {0.0, one.arc_deg, 1500};
  machine.setup_x_um = one.offset_um;
  machine.seed = seed;
  return simulate(machine).session.tests.front().circles.front();
}

struct Tally {
  std::array<double, 3> covered{}, sum{}, sigma{}, squares{};
};

bool report(const Case& one, const Tally& tally, double seeds) {
  bool good = true;
  std::string line = fmt::format("{:<46}", one.name);
  for (std::size_t k = 0; k < 3; ++k) {
    const double bias_um = tally.sum[k] / seeds;
    const double scatter_um = std::sqrt(std::max(0.0, tally.squares[k] / seeds - bias_um * bias_um));
    const double coverage = tally.covered[k] / seeds;
    line +=
        fmt::format("  {:8.4f} {:7.4f} {:7.4f} {:5.1f}", bias_um, scatter_um, tally.sigma[k] / seeds, 100.0 * coverage);
    good = good && coverage >= one.lowest_coverage && coverage <= one.highest_coverage &&
           std::abs(bias_um) < one.largest_bias_um;
  }
  fmt::print("{}  {}\n", line, one.largest_bias_um == kNotJudged ? "shown" : good ? "ok" : "OUT OF RANGE");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 2000;
  fmt::print("{} seeds; um; coverage in % of the intervals of 1.96 sigma\n", seeds);
  fmt::print("{:<46}", "");
  for (const char* name : {"centre A", "centre B", "radius"}) fmt::print("  {:<30}", name);
  fmt::print("\n{:<46}", "case");
  for (int k = 0; k < 3; ++k) fmt::print("  {:>8} {:>7} {:>7} {:>5}", "bias", "scatter", "sigma", "cover");
  fmt::print("\n");
  bool good = true;
  for (const Case& one : kCases) {
    Tally tally;
    for (int seed = 1; seed <= seeds; ++seed) {
      CircleOptions options;
      options.model = one.model;
      options.robust = one.robust;
      options.oval = false;
      const Circle circle = fit_circle(simulated(one, static_cast<std::uint64_t>(seed)), options);
      const std::array error{circle.centre_a_um - one.offset_um, circle.centre_b_um,
                             um_from_mm(circle.radius_mm - 100.0)};
      const std::array sigma{circle.sigma_centre_a_um(), circle.sigma_centre_b_um(), circle.sigma_radius_um()};
      for (std::size_t k = 0; k < 3; ++k) {
        tally.covered[k] += std::abs(error[k]) < 1.96 * sigma[k] ? 1.0 : 0.0;
        tally.sum[k] += error[k];
        tally.squares[k] += error[k] * error[k];
        tally.sigma[k] += sigma[k];
      }
    }
    good = report(one, tally, seeds) && good;
  }
  return good ? 0 : 1;
}
