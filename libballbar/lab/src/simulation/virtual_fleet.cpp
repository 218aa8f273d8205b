#include "ballbar/lab/simulation/virtual_fleet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "ballbar/history/history.hpp"
#include "ballbar/units.hpp"
#include "numerics/random_streams.hpp"
#include "simulation/fleet_machines.hpp"

namespace ballbar {
namespace {

constexpr double kMonth_s = kYear_s / 12.0;
constexpr double kHour_s = 3600.0;

// Student's t of whole degrees of freedom, as wide in its middle as a standard normal number.
double student(double degrees, std::mt19937_64& random) {
  const double z = simulation::normal(random);
  if (!(degrees > 0.0) || std::isinf(degrees)) return z;
  double chi2 = 0.0;
  for (int i = 0; i < static_cast<int>(degrees); ++i) chi2 += std::pow(simulation::normal(random), 2);
  constexpr double kWidth = 0.91;
  return kWidth * z / std::sqrt(chi2 / std::floor(degrees));
}

// Begin of the test in that month: within so many days about its middle, on a working hour.
std::int64_t start_of(const VirtualFleet& fleet, std::size_t month, std::mt19937_64& random) {
  const double middle_s = (static_cast<double>(month) + 0.5) * kMonth_s;
  const double days = std::floor(fleet.days_of_month * (simulation::uniform(random) - 0.5));
  const double day_s = 86400.0 * std::floor(middle_s / 86400.0 + days);
  return fleet.started_s + std::llround(day_s + kHour_s * (7.0 + 8.0 * simulation::uniform(random)));
}

class FleetMaker {
 public:
  FleetMaker(const VirtualFleet& fleet, const FleetCurves& curves)
      : fleet_(fleet), curves_(curves), spreads_(spreads_of(fleet, curves)) {}

  std::vector<FleetTest> of_machine(std::size_t machine) {
    std::mt19937_64 random = simulation::stream_of(fleet_.seed, simulation::Stream::fleet_machine, machine);
    const FleetMachineTruth truth = machine_truth(fleet_, machine, random);
    const bool other_planes = simulation::uniform(random) < fleet_.other_planes_share;
    const std::size_t every = 12 / std::clamp<std::size_t>(fleet_.other_planes_a_year, 1, 12);
    std::vector<FleetTest> tests;
    for (std::size_t month = 0; month < fleet_.months; ++month) {
      std::mt19937_64 of_month =
          simulation::stream_of(fleet_.seed, simulation::Stream::fleet_test, 100000 * machine + month);
      const bool missing = simulation::uniform(of_month) < fleet_.missing_share;
      const std::int64_t start_s = start_of(fleet_, month, of_month);
      if (missing) continue;
      const double day_K = fleet_.day_K * simulation::normal(of_month);
      tests.push_back(test(truth, Plane::XY, start_s, day_K, of_month));
      if (!other_planes || month % every != 0) continue;
      for (const Plane plane : {Plane::YZ, Plane::ZX}) {
        const double later_s = (plane == Plane::YZ ? 0.6 : 1.2) * kHour_s;
        tests.push_back(test(truth, plane, start_s + std::llround(later_s), day_K, of_month));
      }
    }
    return tests;
  }

 private:
  FleetTest test(const FleetMachineTruth& truth, Plane plane, std::int64_t start_s, double day_K,
                 std::mt19937_64& random) const {
    FleetTest test;
    test.machine = truth.machine;
    test.machine_name = truth.name;
    test.started_s = start_s;
    test.plane = plane;
    test.key = static_cast<std::uint64_t>(start_s) * 1000 + truth.machine;
    const double since_s = static_cast<double>(start_s - fleet_.started_s);
    const double bad = simulation::uniform(random) < fleet_.bad_share ? fleet_.bad_factor : 1.0;
    const auto scattered = [&](double scatter) { return bad * scatter * student(fleet_.tail_freedom, random); };
    const auto pair = axes_of(plane);
    const double K = day_K + fleet_.hall_K * warmth_of_year(start_s);
    const BarInUse bar = bar_of(fleet_, truth.machine, since_s / kMonth_s);
    test.bar = bar.serial;

    std::array<double, 2> scale_ppm{};
    for (const std::size_t side : {0U, 1U}) {
      scale_ppm[side] = truth.value(fleet_, "scale", pair[side], plane, since_s, start_s) +
                        scattered(spreads_.scale.scatter) + fleet_.scale_um_per_m_per_K * K + bar.um_per_m;
    }
    const double radius_m = 1e-3 * fleet_.nominal_length_mm;
    test.scale_um = 0.5 * radius_m * (scale_ppm[0] + scale_ppm[1]);
    test.centre_a_um = fleet_.setup_um * simulation::normal(random);
    test.centre_b_um = fleet_.setup_um * simulation::normal(random);
    for (std::size_t k = 0; k < curves_.columns.size(); ++k) {
      const FleetCurves::Column& column = curves_.columns[k];
      const std::optional<int> axis =
          column.side ? std::optional(pair[static_cast<std::size_t>(*column.side)]) : std::nullopt;
      double value = truth.value(fleet_, column.name, axis, plane, since_s, start_s);
      if (spreads_.of_column[k] != nullptr) value += scattered(spreads_.of_column[k]->scatter);
      if (column.of_mismatch) value += 2.0 * radius_m * (scale_ppm[0] - scale_ppm[1]);
      test.errors.push_back(value);
    }
    return test;
  }

  const VirtualFleet& fleet_;
  const FleetCurves& curves_;
  SpreadsOfColumns spreads_;
};

}  // namespace

std::string_view name_of(StoryKind kind) {
  constexpr std::string_view kNames[] = {"wear", "crash", "season", "replaced_part", "instrument"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::vector<FleetTest> fleet_tests(const VirtualFleet& fleet, const FleetCurves& curves) {
  check_fleet(fleet, curves);
  FleetMaker maker(fleet, curves);
  std::vector<FleetTest> tests;
  for (std::size_t machine = 0; machine < fleet.machines; ++machine) {
    std::vector<FleetTest> own = maker.of_machine(machine);
    std::move(own.begin(), own.end(), std::back_inserter(tests));
  }
  return tests;
}

std::vector<Recording> recordings_of(const VirtualFleet& fleet, const FleetCurves& curves, const FleetTest& test) {
  std::vector<Recording> recordings = curves.recordings;
  const std::size_t n = fleet.readings;
  for (std::size_t run = 0; run < recordings.size(); ++run) {
    Recording& recording = recordings[run];
    recording.plane = test.plane;
    recording.started_s = test.started_s;
    std::mt19937_64 random =
        simulation::stream_of(fleet.seed, run == 0 ? simulation::Stream::ccw : simulation::Stream::cw, test.key);
    simulation::Ar1 noise_um(fleet.noise_um, fleet.autocorrelation);
    const double path_mm = fleet.nominal_length_mm + mm_from_um(test.scale_um);
    recording.length_mm.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle_rad = recording.angle_rad[i];
      double um = 0.0;
      for (std::size_t k = 0; k < test.errors.size(); ++k) um += test.errors[k] * curves.columns[k].um[run * n + i];
      const double circle_mm = std::hypot(mm_from_um(test.centre_a_um) + path_mm * std::cos(angle_rad),
                                          mm_from_um(test.centre_b_um) + path_mm * std::sin(angle_rad));
      recording.length_mm[i] =
          simulation::rounded(circle_mm + mm_from_um(um + noise_um.next(random)), mm_from_um(fleet.resolution_um));
    }
  }
  return recordings;
}

}  // namespace ballbar
