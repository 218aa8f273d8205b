// How often 2 sigma of a partial arc hold the truth where the path has an oval, and how far the fit is off.
//
//   study_arc [SEEDS]        16 unless given: of each arc, spacing, noise and size of the oval
//
// The readings come from the kinematics of two axes with a scale error each and a squareness, not from the model of
// the fit; radius 100 mm, 0.01 um resolution. Sizes are fixed or uniform, the signs random: mismatch of the scales and
// squareness of 0 to 80 um/m, which is up to 4 um of amplitude. Noise: white; white with a memory of 3 deg; a memory
// of 8 deg alone. Before: the circle alone (CircleOptions::oval = false). Fails (exit 1) where a coverage leaves its
// range.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "ballbar/circle/circle.hpp"
#include "ballbar/units.hpp"

namespace {

using namespace ballbar;

constexpr double kRadius_mm = 100.0;
constexpr std::array kArcs_deg = {60.0, 80.0, 100.0, 120.0, 150.0, 180.0, 220.0, 260.0, 300.0};
constexpr double kLeastJudged_deg = 100.0, kMostJudged_deg = 220.0;  // the others are shown
constexpr std::array kSpacings_deg = {0.3, 0.75, 2.0};

struct NoiseOf {
  const char* name;
  double white_um, correlated_um, memory_deg;
};
constexpr NoiseOf kNoises[] = {
    {"white", 0.2, 0.0, 1.0},
    {"white, memory 3 deg", 0.15, 0.2, 3.0},
    {"memory 8 deg", 0.02, 0.25, 8.0},
};

struct OvalOf {
  const char* name;
  double least_um_per_m, most_um_per_m;  // mismatch of the scales, and squareness
};
constexpr OvalOf kOvals[] = {{"20", 20.0, 20.0}, {"50", 50.0, 50.0}, {"0 to 80", 0.0, 80.0}};

struct Truth {
  double a_um = 0.0, b_um = 0.0, radius_um = 0.0;
  double mismatch = 0.0, squareness = 0.0;
};

template <class Random>
Truth truth_of(const OvalOf& oval, Random& random) {
  std::uniform_real_distribution<double> place(-20.0, 20.0), size(oval.least_um_per_m, oval.most_um_per_m);
  std::bernoulli_distribution sign;
  Truth truth{place(random), place(random), place(random)};
  truth.mismatch = (sign(random) ? 1e-6 : -1e-6) * size(random);
  truth.squareness = (sign(random) ? 1e-6 : -1e-6) * size(random);
  return truth;
}

template <class Random>
Recording recording_of(const Truth& truth, const NoiseOf& of, double arc_deg, double spacing_deg, double start_deg,
                       Direction direction, Random& random) {
  std::normal_distribution<double> normal;
  Recording recording;
  recording.direction = direction;
  const int n = static_cast<int>(std::lround(arc_deg / spacing_deg)) + 1;
  const double keeps = std::exp(-spacing_deg / of.memory_deg);
  double memory_um = of.correlated_um * normal(random);
  for (int i = 0; i < n; ++i) {
    const double along_deg = direction == Direction::CCW ? i * spacing_deg : arc_deg - i * spacing_deg;
    const double angle_rad = rad_from_deg(start_deg + along_deg);
    const double radius_mm = kRadius_mm + mm_from_um(truth.radius_um);
    const double a = radius_mm * std::cos(angle_rad), b = radius_mm * std::sin(angle_rad);
    const double x = a * (1.0 + 0.5 * truth.mismatch) + truth.squareness * b + mm_from_um(truth.a_um);
    const double y = b * (1.0 - 0.5 * truth.mismatch) + mm_from_um(truth.b_um);
    memory_um = keeps * memory_um + std::sqrt(1.0 - keeps * keeps) * of.correlated_um * normal(random);
    const double length_um = um_from_mm(std::hypot(x, y)) + of.white_um * normal(random) + memory_um;
    recording.angle_rad.push_back(angle_rad);
    recording.length_mm.push_back(mm_from_um(0.01 * std::round(100.0 * length_um)));
  }
  return recording;
}

struct Tally {
  double fits = 0.0;
  std::array<double, 3> held{}, squares{}, sigma{};

  void add(const Circle& circle, const Truth& truth) {
    const std::array error{circle.centre_a_um - truth.a_um, circle.centre_b_um - truth.b_um,
                           um_from_mm(circle.radius_mm - kRadius_mm) - truth.radius_um};
    const std::array sigma_um{circle.sigma_centre_a_um(), circle.sigma_centre_b_um(), circle.sigma_radius_um()};
    fits += 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
      held[k] += std::abs(error[k]) <= 2.0 * sigma_um[k] ? 1.0 : 0.0;
      squares[k] += error[k] * error[k];
      sigma[k] += sigma_um[k] * sigma_um[k];
    }
  }
  void add(const Tally& other) {
    fits += other.fits;
    for (std::size_t k = 0; k < 3; ++k) {
      held[k] += other.held[k];
      squares[k] += other.squares[k];
      sigma[k] += other.sigma[k];
    }
  }
  double coverage() const { return (held[0] + held[1] + held[2]) / (3.0 * fits); }
  double coverage(std::size_t k) const { return held[k] / fits; }
  double off_um(std::size_t k) const { return std::sqrt(squares[k] / fits); }
  double sigma_um(std::size_t k) const { return std::sqrt(sigma[k] / fits); }
};

struct Row {
  Tally before, now;
  void add(const Row& other) {
    before.add(other.before);
    now.add(other.now);
  }
};

bool is_judged(double arc_deg) { return arc_deg >= kLeastJudged_deg && arc_deg <= kMostJudged_deg; }

std::string half_of(const Tally& tally) {
  std::string text;
  for (std::size_t k = 0; k < 3; ++k) text += fmt::format(" {:6.1f}", 100.0 * tally.coverage(k));
  const double centre_um = std::hypot(tally.off_um(0), tally.off_um(1));
  return text + fmt::format(" {:7.2f} {:7.2f}", centre_um, std::hypot(tally.sigma_um(0), tally.sigma_um(1)));
}

// 92 to 98 % of all fits; up to 99 % of an arc, a noise or a size. A row is judged beyond three standard deviations of
// its count.
bool print_row(const std::string& name, const Row& row, double least, double most) {
  const double scatter = 3.0 * std::sqrt(0.95 * 0.05 / row.now.fits);
  bool good = true;
  for (std::size_t k = 0; k < 3; ++k) {
    good = good && row.now.coverage(k) >= least - scatter && row.now.coverage(k) <= most + scatter;
  }
  fmt::print("{:<40} {:>6.0f} |{} |{}  {}\n", name, row.now.fits, half_of(row.before), half_of(row.now),
             good ? "ok" : "OUT OF RANGE");
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  const int seeds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 16;
  fmt::print(
      "Coverage in % of 2 sigma of centre A, centre B, radius; root mean square of the error and of the sigma of "
      "the centre, um\n");
  fmt::print("{:<40} {:>6} | {:<36} | {:<36}\n", "", "", "the circle alone (before)", "with the oval");
  fmt::print("{:<40} {:>6} | {:>6} {:>6} {:>6} {:>7} {:>7} | {:>6} {:>6} {:>6} {:>7} {:>7}\n", "case", "fits", "A", "B",
             "R", "error", "sigma", "A", "B", "R", "error", "sigma");
  std::array<Row, std::size(kNoises)> of_noise;
  std::array<Row, std::size(kOvals)> of_oval;
  std::array<Row, kArcs_deg.size()> of_arc;
  std::array<Row, kSpacings_deg.size()> of_spacing;
  Row all;
  for (std::size_t a = 0; a < kArcs_deg.size(); ++a) {
    for (std::size_t s = 0; s < kSpacings_deg.size(); ++s) {
      for (std::size_t n = 0; n < std::size(kNoises); ++n) {
        for (std::size_t o = 0; o < std::size(kOvals); ++o) {
          for (int seed = 0; seed < seeds; ++seed) {
            std::seed_seq sequence{seed, static_cast<int>(a), static_cast<int>(s), static_cast<int>(n),
                                   static_cast<int>(o)};
            std::mt19937_64 random(sequence);
            const Truth truth = truth_of(kOvals[o], random);
            const double start_deg = std::uniform_real_distribution<double>(0.0, 360.0)(random);
            Row row;
            for (const Direction direction : {Direction::CCW, Direction::CW}) {
              const Recording recording =
                  recording_of(truth, kNoises[n], kArcs_deg[a], kSpacings_deg[s], start_deg, direction, random);
              row.before.add(fit_circle(recording, {.oval = false}), truth);
              row.now.add(fit_circle(recording), truth);
              if (seed % 2 == 0) break;  // one direction
            }
            of_arc[a].add(row);
            if (!is_judged(kArcs_deg[a])) continue;
            for (Row* sum : {&of_spacing[s], &of_noise[n], &of_oval[o], &all}) sum->add(row);
          }
        }
      }
    }
  }
  bool good = true;
  for (std::size_t a = 0; a < kArcs_deg.size(); ++a)
    good = print_row(fmt::format("arc of {:g} deg", kArcs_deg[a]), of_arc[a], is_judged(kArcs_deg[a]) ? 0.92 : 0.0,
                     is_judged(kArcs_deg[a]) ? 0.99 : 1.0) &&
           good;
  for (std::size_t s = 0; s < kSpacings_deg.size(); ++s)
    good = print_row(fmt::format("spacing of {:g} deg", kSpacings_deg[s]), of_spacing[s], 0.92, 0.99) && good;
  for (std::size_t n = 0; n < std::size(kNoises); ++n)
    good = print_row(fmt::format("noise {}", kNoises[n].name), of_noise[n], 0.92, 0.99) && good;
  for (std::size_t o = 0; o < std::size(kOvals); ++o)
    good = print_row(fmt::format("mismatch, squareness {} um/m", kOvals[o].name), of_oval[o], 0.92, 0.99) && good;
  good = print_row("all", all, 0.92, 0.98) && good;
  const bool better =
      std::hypot(all.now.off_um(0), all.now.off_um(1)) < std::hypot(all.before.off_um(0), all.before.off_um(1));
  return good && better ? 0 : 1;
}
