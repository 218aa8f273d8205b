#include "ballbar/formats/recordings/stored_errors.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <charconv>
#include <limits>
#include <string>
#include <utility>

#include "ballbar/units.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kAnalysis = "RENISHAW_DIAGNOSTICS";
constexpr int kFirstWithLarger = 20;  // major version of the software

// "AF_BACKLASH_A_POS"; the file's words where they are not ours in capitals.
std::string stored_name(std::string_view name) {
  std::string stored = "AF_";
  for (const char c : name) stored += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOthers = {
      {{"AF_REVERSAL_SPIKE_", "AF_REVERSAL_SPIKES_"}, {"AF_CENTRE_", "AF_CENTRE_OFFSET_"}}};
  for (const auto& [ours, theirs] : kOthers) {
    if (stored.starts_with(ours)) stored.replace(0, ours.size(), theirs);
  }
  return stored;
}

std::optional<double> in_analysis(const B5r& test, std::string_view name, std::string_view data_type = {}) {
  for (const StoredFeature& feature : test.stored) {
    if (!feature.valid || feature.name != name || !feature.parent.starts_with(kAnalysis)) continue;
    if (data_type.empty() || feature.data_type == data_type) return feature.value;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> stored_error(const B5r& test, std::string_view row) {
  return in_analysis(test, stored_name(row));
}

std::optional<int> stored_rank(const B5r& test, std::string_view effect) {
  const std::optional<double> rank = in_analysis(test, stored_name(effect) + "_RANK");
  if (!rank || !(*rank >= 1.0 && *rank < 1000.0)) return std::nullopt;
  return static_cast<int>(*rank);
}

std::optional<double> stored_individual_circularity_um(const B5r& test, std::string_view effect) {
  return in_analysis(test, stored_name(effect) + "_IC", "UT_LENGTH_UM");
}

std::optional<double> stored_pitch_mm(const B5r& test, char axis) {
  const std::optional<double> pitch_mm = in_analysis(test, fmt::format("AF_CYCLIC_PITCH_{}", axis), "UT_LENGTH_MM");
  return pitch_mm && *pitch_mm > 0.0 ? pitch_mm : std::nullopt;
}

MachineErrorOptions error_options(const B5r& test) {
  MachineErrorOptions options;
  if (stores_cyclic_means(test)) options.cyclic_of_runs = CyclicOfRuns::mean;
  return options;
}

bool stores_cyclic_means(const B5r& test) {
  int major = kFirstWithLarger;
  std::from_chars(test.software_version.data(), test.software_version.data() + test.software_version.size(), major);
  return major < kFirstWithLarger;
}

std::vector<StoredCircle> stored_circles(const B5r& test) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<StoredCircle> circles;
  for (const StoredRun& run : test.run_results) {
    const auto stored = [&](const char* name) { return stored_value(test, run.parent, name, "UT_LENGTH_MM"); };
    const auto a_mm = stored("AF_CENTRE_OFFSET_A"), b_mm = stored("AF_CENTRE_OFFSET_B");
    const auto radius_mm = stored("AF_BEST_RADIUS");
    if (!a_mm || !b_mm || !radius_mm) continue;
    StoredCircle one;
    one.recording.plane = test.plane;
    one.recording.direction = run.direction.value_or(Direction::CCW);
    one.recording.nominal_length_mm = test.nominal_length_mm;
    one.recording.started_s = test.started_s;
    one.circle.model = CircleModel::polar;
    one.circle.centre_a_um = um_from_mm(*a_mm);
    one.circle.centre_b_um = um_from_mm(*b_mm);
    one.circle.radius_mm = *radius_mm;
    one.circle.covariance_um2.setConstant(kUnknown);
    one.circle.sigma_reading_um = kUnknown;
    one.circle.rms_um = kUnknown;
    one.circle.converged = true;
    circles.push_back(std::move(one));
  }
  return circles;
}

}  // namespace ballbar
