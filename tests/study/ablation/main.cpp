// What each device of the diagnosis buys: the same data sets with it and without it.
//
//   study_ablation [N] [--first SEED] [--cells NAME,...] [--devices NAME,...] [--together NAME,...]
//
// N seeds a cell (2), from SEED (1) on. Prints a line a set and device, as soon as it is done: cell; seed; the device
// that is switched off, `all` for none; right; wrong; nothing said; wrong driver; processor time in s. --together
// switches these devices off at once (`together`).

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "ballbar/diagnosis/verdict/diagnosis.hpp"
#include "cases.hpp"
#include "diagnosis/verdict/diagnosis_at.hpp"

namespace {

using namespace ballbar;

struct Device {
  const char* name;
  bool Tuning::*is_on;
  bool is_test;  // of members alone: the posterior is the same
};

constexpr Device kDevices[] = {
    {"steps within samples", &Tuning::steps_within_samples, false},
    {"smoothing", &Tuning::smoothing, false},
    {"rows at jumps", &Tuning::rows_at_jumps, false},
    {"saturated rows", &Tuning::saturated_rows, false},
    {"jumps of temperature", &Tuning::jumps_of_temperature, false},
    {"whole about jumps", &Tuning::whole_about_jumps, false},
    {"discrepancy", &Tuning::discrepancy, false},
    {"bounded memory", &Tuning::bounded_memory, false},
    {"cost of hyperparameters", &Tuning::cost_of_hyperparameters, false},
    {"input times", &Tuning::input_times, false},
    {"held values", &Tuning::held_values, false},
    {"any forms", &Tuning::any_forms, false},
    {"any forms first", &Tuning::any_forms_first, false},
    {"prior of lags", &Tuning::prior_of_lags, false},
    {"lags above sampling", &Tuning::lags_above_sampling, false},
    {"prior of pairs", &Tuning::prior_of_pairs, false},
    {"student t", &Tuning::student_t, false},
    {"level jumps", &Tuning::level_jumps, false},
    {"finer shapes", &Tuning::finer_shapes, false},
    {"finer rivals", &Tuning::finer_rivals, false},
    {"refine", &Tuning::refine, false},
    {"same gain", &Tuning::same_gain, true},
    {"held out", &Tuning::held_out, true},
    {"beside discrepancy", &Tuning::beside_discrepancy, true},
    {"columns not searched", &Tuning::columns_not_searched, true},
};

struct Outcome {
  verdicts::Judged judged;
  double cpu_s = 0.0;
};

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
  std::string wanted_cells, wanted_devices, together;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--first" && i + 1 < argc) {
      first = static_cast<std::uint64_t>(std::atoll(argv[++i]));
    } else if (word == "--cells" && i + 1 < argc) {
      wanted_cells = std::string(",") + argv[++i] + ",";
    } else if (word == "--together" && i + 1 < argc) {
      together = std::string(",") + argv[++i] + ",";
    } else if (word == "--devices" && i + 1 < argc) {
      wanted_devices = std::string(",") + argv[++i] + ",";
    } else {
      count = static_cast<std::uint64_t>(std::atoll(word.c_str()));
    }
  }
  const auto is_in = [](const std::string& wanted, const std::string& name) {
    return wanted.empty() || wanted.find("," + name + ",") != std::string::npos;
  };
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
            if (is_in(together, device.name)) without.search.tuning.*device.is_on = false;
          }
          print(cell.name, seed, "together", outcome(one, without));
        }
        for (const Device& device : kDevices) {
          if (!together.empty() || !is_in(wanted_devices, device.name)) continue;
          DiagnosisOptions without = all;
          without.search.tuning.*device.is_on = false;
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
      } catch (const std::exception& error) {
        fmt::print("{};{};error;{}\n", cell.name, seed, error.what());
      }
    }
  }
}
