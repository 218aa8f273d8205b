#include "fleet/other_plant.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>

namespace ballbar::study {
namespace {

struct Kind {
  const char* name;
  const char* unit;
  double spread, scatter, step;  // step: of rounding
};
constexpr std::array kKinds{
    Kind{"squareness", "um/m", 12.0, 1.5, 1.0},       Kind{"straightness_a", "um", 1.0, 0.3, 0.1},
    Kind{"straightness_b", "um", 1.0, 0.3, 0.1},      Kind{"backlash_a_pos", "um", 1.0, 0.25, 0.1},
    Kind{"backlash_a_neg", "um", 1.0, 0.25, 0.1},     Kind{"backlash_b_pos", "um", 1.0, 0.25, 0.1},
    Kind{"backlash_b_neg", "um", 1.0, 0.25, 0.1},     Kind{"lateral_play_a_pos", "um", 0.5, 0.2, 0.1},
    Kind{"lateral_play_a_neg", "um", 0.5, 0.2, 0.1},  Kind{"lateral_play_b_pos", "um", 0.5, 0.2, 0.1},
    Kind{"lateral_play_b_neg", "um", 0.5, 0.2, 0.1},  Kind{"cyclic_error_a_fwd", "um", 0.4, 0.12, 0.1},
    Kind{"cyclic_error_a_rev", "um", 0.4, 0.12, 0.1}, Kind{"cyclic_error_b_fwd", "um", 0.4, 0.12, 0.1},
    Kind{"cyclic_error_b_rev", "um", 0.4, 0.12, 0.1}, Kind{"servo_mismatch", "ms", 0.05, 0.01, 0.01},
    Kind{"scale_x", "um/m", 15.0, 1.5, 1.0},          Kind{"scale_y", "um/m", 15.0, 1.5, 1.0},
    Kind{"global_scale", "um", 0.0, 0.0, 0.1},        Kind{"scale_mismatch", "um", 0.0, 0.0, 0.1},
    Kind{"circularity", "um", 0.0, 0.4, 0.1}};
constexpr double kYear_days = 365.25;
constexpr int kYears = 3;
constexpr std::size_t kMachines = 40;
constexpr double kBlockShare = 0.5;  // of the scatter's variance that stays for months

double rounded_to(double value, double step) { return step * std::round(value / step); }

class Maker {
 public:
  explicit Maker(const OtherPlantOptions& options) : options_(options), random_(options.seed * 7919 + 13) {}

  Plant plant() {
    Plant plant;
    for (std::size_t machine = 0; machine < kMachines; ++machine) add_machine(machine, plant);
    return plant;
  }

 private:
  double normal() { return normal_(random_); }
  double share() { return uniform_(random_); }
  // One in twenty from a distribution four times as wide.
  double heavy() { return normal() * (share() < 0.05 ? 4.0 : 1.0); }

  void add_machine(std::size_t machine, Plant& plant) {
    const bool quarterly = machine % 2 == 1;
    const bool respelt = machine == 16;
    const std::string name = fmt::format("M{:03}", machine);
    const std::string story = story_of(machine);
    if (!story.empty()) note_story(name, story, plant);
    std::map<std::string, double> constant, block;
    for (const Kind& kind : kKinds) constant[kind.name] = kind.spread * normal();
    if (story == "replaced_part") constant["backlash_b_pos"] = constant["backlash_b_neg"] = 0.6;
    int left_of_block = 0;
    for (int month = 0; month < 12 * kYears; month += quarterly ? 3 : 1) {
      if (left_of_block <= 0) {
        left_of_block = 3 + static_cast<int>(share() * 6.0);
        for (const Kind& kind : kKinds) block[kind.name] = kind.scatter * normal() * std::sqrt(kBlockShare);
      }
      left_of_block -= quarterly ? 3 : 1;
      if (share() < 0.08) continue;
      const double day = month * kYear_days / 12.0 + std::floor(20.0 * share());
      const int tests = share() < 0.05 ? 2 : 1;
      for (int again = 0; again < tests; ++again) {
        plant.tests.push_back(test(machine, day + 0.3 + 0.1 * again, constant, block, story));
        plant.tests.back().machine = respelt && month >= 12 ? "m 16" : name;
      }
    }
  }

  // On machines that are tested each month but for the instrument, whose bar is used on both.
  std::string story_of(std::size_t machine) const {
    if (!options_.stories) return "";
    const std::map<std::size_t, std::string> stories{{2, "wear"}, {8, "crash"}, {20, "season"}, {30, "replaced_part"}};
    if (const auto found = stories.find(machine); found != stories.end()) return found->second;
    return uses_bar_a(machine) ? "instrument" : "";
  }
  static bool uses_bar_a(std::size_t machine) { return machine >= 34 && machine < 40; }

  static void note_story(const std::string& machine, const std::string& story, Plant& plant) {
    const std::map<std::string, FindingKind> kinds{{"wear", FindingKind::trend},
                                                   {"crash", FindingKind::step},
                                                   {"season", FindingKind::season},
                                                   {"replaced_part", FindingKind::replaced_part},
                                                   {"instrument", FindingKind::instrument}};
    plant.stories.push_back({machine, story, kinds.at(story)});
  }

  std::map<std::string, double> story_at(const std::string& story, double day) const {
    const double years = day / kYear_days;
    if (story == "wear") {
      const double worn = 0.5 * years * years;
      return {{"backlash_a_pos", worn}, {"backlash_a_neg", 0.8 * worn}, {"lateral_play_a_pos", 0.4 * worn}};
    }
    if (story == "crash") {
      const double share = std::min(1.0, std::max(0.0, (years - 1.9) * 6.0));
      return {{"squareness", 14.0 * share}, {"straightness_a", 2.0 * share}, {"backlash_a_pos", 2.0 * share}};
    }
    if (story == "season") {
      const double warm = std::tanh(3.0 * std::sin(2.0 * std::numbers::pi * (years - 0.3)));
      return {{"squareness", 5.0 * warm}, {"scale_x", 8.0 * warm}, {"scale_y", 6.0 * warm}};
    }
    if (story == "replaced_part" && years < 1.6) {
      return {{"backlash_b_pos", 3.0},
              {"backlash_b_neg", 2.5},
              {"cyclic_error_b_fwd", 1.2},
              {"cyclic_error_b_rev", 1.0},
              {"scale_y", 18.0}};
    }
    if (story == "instrument" && years >= 1.4) return {{"scale_x", 14.0}, {"scale_y", 14.0}};
    return {};
  }

  MachineTest test(std::size_t machine, double day, const std::map<std::string, double>& constant,
                   const std::map<std::string, double>& block, const std::string& story) {
    MachineTest test;
    test.started_s = 1640995200 + static_cast<std::int64_t>(day * 86400.0);
    test.bar = !uses_bar_a(machine) ? "C3" : options_.stories && day >= 1.4 * kYear_days ? "B2" : "A1";
    test.feed_mm_per_min = 1500.0;
    test.stored = machine % 4 == 3;
    const double common_scale = 1.5 * heavy();  // the warmth of the day, for both axes
    const std::map<std::string, double> added = story_at(story, day);
    std::map<std::string, double> values;
    for (const Kind& kind : kKinds) {
      double value =
          constant.at(kind.name) + block.at(kind.name) + kind.scatter * std::sqrt(1.0 - kBlockShare) * heavy();
      if (const auto found = added.find(kind.name); found != added.end()) value += found->second;
      if (std::string_view(kind.name).starts_with("scale_") && std::string_view(kind.unit) == "um/m") {
        value += common_scale;
      }
      values[kind.name] = value;
    }
    values["global_scale"] = 0.05 * (values["scale_x"] + values["scale_y"]);
    values["scale_mismatch"] = 0.2 * (values["scale_x"] - values["scale_y"]);
    values["circularity"] += 3.0 + 0.3 * std::abs(values["scale_mismatch"]) + 0.1 * std::abs(values["squareness"]);
    for (const Kind& kind : kKinds) {
      const double sigma = test.stored ? std::nan("") : 0.3 * (kind.scatter > 0.0 ? kind.scatter : 0.3);
      test.quantities.push_back({kind.name, kind.unit, rounded_to(values.at(kind.name), kind.step), sigma});
    }
    test.quantities.push_back({"centre_a", "um", 10.0 * normal(), 0.5, true});
    return test;
  }

  OtherPlantOptions options_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> uniform_;
};

}  // namespace

Plant other_plant_of(const OtherPlantOptions& options) { return Maker(options).plant(); }

}  // namespace ballbar::study
