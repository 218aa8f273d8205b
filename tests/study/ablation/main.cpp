// What each device of the diagnosis buys: the same data sets with it and without it.
//
//   study_ablation [N] [--first SEED] [--cells NAME,...] [--devices NAME,...] [--together NAME,...] [--numbers
//   NAME,...]
//
// N seeds a cell (2), from SEED (1) on. Prints a line a set and device, as soon as it is done: cell; seed; the device
// that is switched off, `all` for none; right; wrong; nothing said; wrong driver; processor time in s. --together
// switches these devices off at once (`together`); --numbers halves and doubles numbers (`all` for all) instead.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnose.hpp"
#include "cases.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"

namespace {

using namespace ballbar;

struct Device {
  const char* name;
  void (*change)(Tuning&);
  bool is_test;  // of members alone: the posterior is the same
};

constexpr double kInfinite = std::numeric_limits<double>::infinity();

// Switched off.
const Device kDevices[] = {
    {"steps within samples", [](Tuning& t) { t.steps_within_samples = false; }, false},
    {"smoothing", [](Tuning& t) { t.smoothing = false; }, false},
    {"outliers_of_inputs", [](Tuning& t) { t.outliers_of_inputs = false; }, false},
    {"coarse_columns", [](Tuning& t) { t.coarse_columns = false; }, false},
    {"equal_columns", [](Tuning& t) { t.equal_columns = false; }, false},
    {"stuck sensors", [](Tuning& t) { t.stuck_sensors = false; }, false},
    {"rows at jumps", [](Tuning& t) { t.rows_at_jumps = false; }, false},
    {"saturated rows", [](Tuning& t) { t.least_at_end = 1.0; }, false},
    {"jumps of temperature", [](Tuning& t) { t.temperature_jump = 1.0; }, false},
    {"whole about jumps", [](Tuning& t) { t.whole_about_jumps = false; }, false},
    {"discrepancy", [](Tuning& t) { t.discrepancy = 0.0; }, false},
    {"cost of hyperparameters", [](Tuning& t) { t.hyperparameter = 0.0; }, false},
    {"delays", [](Tuning& t) { t.most_delays = 0; }, false},
    {"more than 12 delays", [](Tuning& t) { t.most_delays = 12; }, false},
    {"held values", [](Tuning& t) { t.held_values = 0.0; }, false},
    {"any forms", [](Tuning& t) { t.forms = 0.0; }, false},
    {"any forms first", [](Tuning& t) { t.any_forms_first = false; }, false},
    {"prior of lags", [](Tuning& t) { t.at_once = 0.0; }, false},
    {"lags above sampling", [](Tuning& t) { t.shortest_lag = 0.0; }, false},
    {"prior of pairs", [](Tuning& t) { t.pairs = 0.5; }, false},
    {"student t", [](Tuning& t) { t.outlier = kInfinite; }, false},
    {"level jumps", [](Tuning& t) { t.jump_off = kInfinite; }, false},
    {"finer shapes", [](Tuning& t) { t.finer_shapes = false; }, false},
    {"finer rivals", [](Tuning& t) { t.sharpened = 1; }, false},
    {"refine", [](Tuning& t) { t.refine = false; }, false},
    {"modes", [](Tuning& t) { t.modes = false; }, false},
    {"second start", [](Tuning& t) { t.usual_time_s = kInfinite; }, false},
    {"same gain", [](Tuning& t) { t.same_gain = 0.0; }, true},
    {"held out", [](Tuning& t) { t.held_out_evidence = -kInfinite; }, true},
    {"beside discrepancy", [](Tuning& t) { t.beside_discrepancy = false; }, true},
    {"jump that stays", [](Tuning& t) { t.jump_that_stays = false; }, true},
    {"columns not searched", [](Tuning& t) { t.columns_not_searched = false; }, true},
};

// A number that is halved or doubled, for its sensitivity.
struct Number {
  const char* name;
  double Tuning::*value;
};
constexpr Number kNumbers[] = {
    {"jump", &Tuning::jump},
    {"far_mode", &Tuning::far_mode},
    {"clock_delay", &Tuning::clock_delay},
    {"jump_delay", &Tuning::jump_delay},
    {"held_values", &Tuning::held_values},
    {"pairs", &Tuning::pairs},
    {"forms", &Tuning::forms},
    {"discrepancy", &Tuning::discrepancy},
    {"hyperparameter", &Tuning::hyperparameter},
    {"shortest_discrepancy", &Tuning::shortest_discrepancy},
    {"most_new", &Tuning::most_new},
    {"most_white", &Tuning::most_white},
    {"outlier", &Tuning::outlier},
    {"freedom", &Tuning::freedom},
    {"jump_off", &Tuning::jump_off},
    {"hardly_there", &Tuning::hardly_there},
    {"far_rival", &Tuning::far_rival},
    {"usual_time_s", &Tuning::usual_time_s},
    {"same_gain", &Tuning::same_gain},
    {"held_out_evidence", &Tuning::held_out_evidence},
    {"temperature_jump", &Tuning::temperature_jump},
};

struct Outcome {
  verdicts::Judged judged;
  double cpu_s = 0.0;
};

bool says = false;  // what is found, to stderr

DiagnosisOptions options_of(const ablation::Case& one) {
  DiagnosisOptions options;
  options.search.without = one.without;
  options.search.motion = one.motion;
  options.fit_candidates = options.leave_out = false;
  return options;
}

Outcome outcome(const ablation::Case& one, const DiagnosisOptions& options) {
  const std::clock_t start = std::clock();
  const Diagnosis found = diagnose(one.model, one.data, 0, options);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  if (says) {
    fmt::print(stderr, "  {}: {}:", one.what, name_of(found.verdict));
    for (const BoundEffect& effect : found.named) fmt::print(stderr, " {}", label_of(effect));
    for (const Driver& driver : found.drivers) fmt::print(stderr, " {}={:.2f}", driver.column, driver.p);
    for (const Candidate& candidate : found.candidates)
      fmt::print(stderr, " | {} {:.2f} 2lnB {:.1f} {}", candidate.label, candidate.p, candidate.likelihood_ratio,
                 candidate.doubts.size());
    fmt::print(stderr, " | P(drift) {:.2f} {:.2f} um\n", found.p_discrepancy, found.discrepancy_um);
  }
  return {one.judged(verdicts::said_of(found)), cpu_s};
}

void print(const std::string& cell, std::uint64_t seed, const char* device, const Outcome& one) {
  fmt::print("{};{};{};{:d};{:d};{:d};{:d};{:.3f}\n", cell, seed, device, one.judged.right, one.judged.wrong,
             one.judged.nothing_said, one.judged.driver_wrong, one.cpu_s);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::uint64_t count = 2, first = 1;
  std::string wanted_cells, wanted_devices, wanted_numbers, together;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--say") {
      says = true;
    } else if (word == "--first" && i + 1 < argc) {
      first = static_cast<std::uint64_t>(std::atoll(argv[++i]));
    } else if (word == "--cells" && i + 1 < argc) {
      wanted_cells = std::string(",") + argv[++i] + ",";
    } else if (word == "--together" && i + 1 < argc) {
      together = std::string(",") + argv[++i] + ",";
    } else if (word == "--numbers" && i + 1 < argc) {
      wanted_numbers = std::string(",") + argv[++i] + ",";
    } else if (word == "--devices" && i + 1 < argc) {
      wanted_devices = std::string(",") + argv[++i] + ",";
    } else {
      count = static_cast<std::uint64_t>(std::atoll(word.c_str()));
    }
  }
  const auto is_in = [](const std::string& wanted, const std::string& name) {
    return wanted.empty() || wanted.find("," + name + ",") != std::string::npos;
  };
  std::istringstream asked(wanted_devices.empty() ? together : wanted_devices);
  for (std::string name; std::getline(asked, name, ',');) {
    const auto is_it = [&](const Device& one) { return name == one.name; };
    if (name.empty() || name == "none" || std::any_of(std::begin(kDevices), std::end(kDevices), is_it)) continue;
    fmt::print(stderr, "expected the name of a device, found \"{}\".\n", name);
    return 2;
  }
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    for (const ablation::Cell& cell : ablation::cells()) {
      if (!is_in(wanted_cells, cell.name)) continue;
      try {
        const ablation::Case one = cell.make(seed);
        const DiagnosisOptions all = options_of(one);
        Inference found = inference_of(one.model, one.data, 0, all);
        print(cell.name, seed, "all", outcome(one, all));
        if (!together.empty()) {
          DiagnosisOptions without = all;
          for (const Device& device : kDevices) {
            if (is_in(together, device.name)) device.change(without.search.tuning);
          }
          print(cell.name, seed, "together", outcome(one, without));
        }
        for (const Device& device : kDevices) {
          if (!together.empty() || !wanted_numbers.empty() || !is_in(wanted_devices, device.name)) continue;
          DiagnosisOptions without = all;
          device.change(without.search.tuning);
          if (!device.is_test) {
            print(cell.name, seed, device.name, outcome(one, without));
            continue;
          }
          const std::clock_t start = std::clock();
          found.problem->tuning = without.search.tuning;
          const verdicts::Said said = verdicts::said_of(diagnosis_of(found, one.model, one.data, 0, without));
          print(cell.name, seed, device.name,
                {one.judged(said), static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC});
        }
        for (const Number& number : kNumbers) {
          if (wanted_numbers.empty() || !(wanted_numbers == ",all," || is_in(wanted_numbers, number.name))) continue;
          for (const double factor : {0.5, 2.0}) {
            DiagnosisOptions changed = all;
            changed.search.tuning.*number.value *= factor;
            print(cell.name, seed, fmt::format("{} x {}", number.name, factor).c_str(), outcome(one, changed));
          }
        }
      } catch (const std::exception& error) {
        fmt::print("{};{};error;{}\n", cell.name, seed, error.what());
      }
    }
  }
}
