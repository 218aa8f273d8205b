#include "errors/stored_test.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/formats/recordings/stored_errors.hpp"

namespace ballbar {
namespace {

constexpr std::string_view kAnalysis = "RENISHAW_DIAGNOSTICS";

struct Unit {
  std::string_view data_type;
  std::string_view unit;
  double factor = 1.0;
};
constexpr std::array kUnits{Unit{"UT_LENGTH_UM", "um"}, Unit{"UT_LENGTH_MM", "um", 1e3}, Unit{"UT_SQUARENESS", "um/m"},
                            Unit{"UT_SCALE_ERROR", "um/m"}, Unit{"UT_SERVO_MISMATCH", "ms"}};

const Unit* unit_called(std::string_view data_type) {
  const auto* const found =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.data_type == data_type; });
  return found == kUnits.end() ? nullptr : found;
}

// What the names of both differ in, but for the case.
constexpr std::array<std::pair<std::string_view, std::string_view>, 2> kOtherNames{
    {{"centre_offset_", "centre_"}, {"reversal_spikes_", "reversal_spike_"}}};
// Shares, shapes, and pairs of numbers that stand there a second time as _POS and _NEG.
constexpr std::array<std::string_view, 8> kNoQuantity{"_rank",       "_perc",       "_ic",    "_global",
                                                      "_a_mismatch", "_b_mismatch", "radius", "positional_tolerance"};

// Of "AF_BACKLASH_A_POS" "backlash_a_pos"; of the scale of A, which is X, "scale_x"; empty: no quantity of the machine.
std::string quantity_of(std::string_view stored, Plane plane) {
  if (!stored.starts_with("AF_")) return {};
  std::string name;
  name.reserve(stored.size());
  for (const char c : stored.substr(3)) name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (name == "scale_error_a") return scale_name(axes_of(plane)[0]);
  if (name == "scale_error_b") return scale_name(axes_of(plane)[1]);
  for (const std::string_view end : kNoQuantity) {
    if (name.ends_with(end)) return {};
  }
  if (name.find("cyclic_p") != std::string::npos) return {};  // pitch and phase
  for (const auto& [theirs, ours] : kOtherNames) {
    if (name.starts_with(theirs)) return std::string(ours) + name.substr(theirs.size());
  }
  return name;
}

bool is_of_set_up(std::string_view quantity) { return quantity.starts_with("centre_"); }

// Of the quantity "backlash_a_pos" that of "backlash_a".
std::optional<std::size_t> rank_of(const B5r& b5r, std::string_view quantity) {
  for (const std::string_view end : {"_pos", "_neg", "_fwd", "_rev"}) {
    if (quantity.ends_with(end)) quantity.remove_suffix(end.size());
  }
  const std::optional<int> rank = stored_rank(b5r, quantity);
  return rank ? std::optional(static_cast<std::size_t>(*rank)) : std::nullopt;
}

}  // namespace

std::optional<StoredFeature> stored_circularity(const B5r& b5r) {
  std::optional<StoredFeature> largest;
  for (const StoredFeature& stored : b5r.stored) {
    const Unit* const unit = unit_called(stored.data_type);
    if (!stored.valid || stored.name != "AF_CIRCULARITY" || unit == nullptr || unit->unit != "um") continue;
    const bool of_analysis = stored.parent.starts_with(kAnalysis);
    if (!of_analysis && !stored.parent.starts_with("run ")) continue;
    StoredFeature one = stored;
    one.value *= unit->factor;
    one.data_type = "UT_LENGTH_UM";
    if (of_analysis) return one;
    if (!largest || one.value > largest->value) largest = std::move(one);
  }
  return largest;
}

MachineTest stored_test(const B5r& b5r) {
  MachineTest test;
  test.stored = true;
  test.started_s = b5r.started_s;
  test.plane = b5r.plane;
  test.nominal_length_mm = b5r.nominal_length_mm;
  test.start_deg = b5r.start_deg.value_or(0.0);
  test.arc_deg = std::fmod(b5r.end_deg.value_or(0.0) - test.start_deg, 360.0);
  if (test.arc_deg <= 0.0) test.arc_deg += 360.0;
  test.feed_mm_per_min = b5r.programmed_feed_mm_per_min;
  std::optional<double> scale_a, scale_b;
  for (const StoredFeature& stored : b5r.stored) {
    if (!stored.valid || !stored.parent.starts_with(kAnalysis)) continue;
    if (stored.data_type == "UT_FEEDRATE") test.feed_mm_per_min = stored.value;
    const Unit* const unit = unit_called(stored.data_type);
    const std::string name = quantity_of(stored.name, b5r.plane);
    if (unit == nullptr || name.empty()) continue;
    const double value = unit->factor * stored.value;
    constexpr double kNoSigma = std::numeric_limits<double>::quiet_NaN();
    test.quantities.push_back({name, std::string(unit->unit), value, kNoSigma, is_of_set_up(name)});
    test.quantities.back().rank = rank_of(b5r, name);
    if (stored.data_type == "UT_SQUARENESS") test.squareness = MachineError{name, "um/m", value, kNoSigma};
    if (name == scale_name(axes_of(b5r.plane)[0])) scale_a = value;
    if (name == scale_name(axes_of(b5r.plane)[1])) scale_b = value;
  }
  const bool has_circularity = std::any_of(test.quantities.begin(), test.quantities.end(),
                                           [](const TestQuantity& one) { return one.name == "circularity"; });
  if (const auto round = stored_circularity(b5r); round && !has_circularity) {
    test.quantities.push_back({"circularity", "um", round->value});
  }
  if (scale_a && scale_b) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    test.scales = AxisScales{*scale_a, *scale_b, Eigen::Matrix2d::Constant(unknown)};
  }
  return test;
}

std::vector<Tolerance> stated_tolerances(const B5r& b5r) {
  std::vector<Tolerance> tolerances;
  for (const bool warning : {false, true}) {
    for (const Limit& limit : b5r.limits) {
      const Unit* const unit = unit_called(limit.data_type);
      const std::string name = quantity_of(limit.name, b5r.plane);
      if (unit == nullptr || name.empty() || is_of_set_up(name) || (limit.level == "WARNING") != warning) continue;
      if (limit.parent == "RUN_SPEC") continue;  // how a run is to be made
      const bool known = std::any_of(tolerances.begin(), tolerances.end(),
                                     [&](const Tolerance& tolerance) { return tolerance.quantity == name; });
      if (known) continue;
      Tolerance tolerance{name, limit.lower, limit.upper};
      if (tolerance.lower) *tolerance.lower *= unit->factor;
      if (tolerance.upper) *tolerance.upper *= unit->factor;
      tolerances.push_back(std::move(tolerance));
    }
  }
  return tolerances;
}

}  // namespace ballbar
