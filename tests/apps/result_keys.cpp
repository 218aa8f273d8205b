// Holds what is written of the results' lists of fields to these lists: apps/page/src/results.ts,
// apps/python/ballbar/_kinds.py, and the tables of keys in the READMEs of apps. These stand between two lines:
//
//   <!-- keys of NAME -->
//   <!-- end of keys -->
//
//   result_keys FOLDER [--update]     FOLDER: of the sources; --update writes what differs anew
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/results/schema.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "batches/select_result.hpp"
#include "batches/train_result.hpp"
#include "challenge/blind_results.hpp"
#include "compensate/replay_result.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/follow_results.hpp"
#include "diagnose/inject_result.hpp"
#include "diagnose/machine_errors_result.hpp"
#include "diagnose/revision_results.hpp"
#include "history/history_result.hpp"
#include "history/page_parts.hpp"
#include "history/test_result.hpp"
#include "logs/log_results.hpp"
#include "shaft_picture/shaft_result.hpp"
#include "measure/comparison_result.hpp"
#include "measure/drift_result.hpp"
#include "measure/fit_result.hpp"
#include "model/effects_result.hpp"
#include "model/preflight_result.hpp"
#include "plan/plan_result.hpp"
#include "predict/predict_result.hpp"
#include "report/report_inside.hpp"
#include "report/report_results.hpp"
#include "simulate/simulate_result.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLargest = 1 << 22;

std::string typescript_file(const std::vector<ResultSchema>& schemas) {
  return "// Results of the program: the keys of its `--json`. Written by tests/apps/result_keys from their lists of "
         "fields.\n\nexport type Num = number | null; // null: not known\n\n" +
         typescript_of(schemas);
}

// What functions of Python answer.
std::vector<PythonClass> python_classes() {
  return {{"Fitted", "fit", {"Fitted"}},
          {"Errors", "errors", {"Errors"}},
          {"RankedErrors", "errors", {"RankedErrors", "RankedErrorsOfGroups"}},
          {"Drift", "drift", {"Drift", "DriftOfProbes"}},
          {"Comparison", "compare", {"Comparison"}},
          {"History", "history", {"History"}},
          {"Imported", "import_log", {"Imported", "Merged"}},
          {"Simulated", "simulate", {"Simulated", "SimulatedFleet"}},
          {"Effects", "effects", {"Effects", "Effect"}},
          {"Preflight", "preflight", {"Preflight", "PreflightTargets"}},
          {"Checked", "check", {"Checked", "CheckedTargets"}},
          {"Diagnosis", "diagnose", {"Diagnosed", "DiagnosedTargets"}, "Checked"},
          {"Plan", "plan", {"Plan"}},
          {"Trained", "train", {"Trained", "TrainedOnEffects"}},
          {"Selected", "select", {"Selected"}},
          {"Predicted", "predict", {"Predicted", "PredictedJob", "PredictedByEffects"}},
          {"Report", "report", {"Report"}},
          {"Tried", "try_effect", {"Tried"}},
          {"Added", "add", {"Added"}},
          {"Injected", "inject", {"Injected"}}};
}

std::string python_file(const std::vector<ResultSchema>& schemas) {
  return "\"\"\"The results, with their keys. Written by tests/apps/result_keys from their lists of fields.\n\nA key "
         "that does "
         "not apply is not there. A number that is not known is None, in an array NaN.\n\"\"\"\nfrom __future__ import "
         "annotations\n\nfrom typing import Any\n\nimport numpy as np\nfrom numpy.typing import NDArray\n\nfrom "
         "._results "
         "import Result, Rows\n\nArray = NDArray[np.float64]\n" +
         python_of(python_classes(), schemas);
}

template <Described... Types>
std::vector<ResultSchema> schemas_of() {
  std::vector<ResultSchema> schemas;
  (add_schema<Types>(schemas), ...);
  return schemas;
}

// A page with the tables of its marks anew.
std::string with_tables(std::string page, const std::vector<ResultSchema>& schemas) {
  constexpr std::string_view kBegin = "<!-- keys of ", kEnd = "<!-- end of keys -->";
  std::size_t at = 0;
  while ((at = page.find(kBegin, at)) != std::string::npos) {
    const std::size_t name = at + kBegin.size(), line = page.find('\n', at), end = page.find(kEnd, at);
    const std::string wanted = page.substr(name, page.find(" -->", name) - name);
    const auto schema =
        std::find_if(schemas.begin(), schemas.end(), [&](const ResultSchema& one) { return one.name == wanted; });
    if (schema == schemas.end() || end == std::string::npos)
      throw Error(fmt::format("expected the name of a result and an end of its keys, found {}.", wanted));
    page.replace(line + 1, end - line - 1, "\n" + markdown_of(*schema) + "\n");
    at = line;
  }
  return page;
}

int run(const std::filesystem::path& folder, bool update) {
  const std::vector<ResultSchema> schemas =
      schemas_of<DiagnosisReport, DiagnosedTargets, ErrorsOfOne, ErrorsOfSeveral, PosteriorSoFar, Looked, Followed,
                 CheckedTargets, PreflightTargets, EffectPages, TestPlan, EffectTest, Added, Ledger, Undone,
                 InjectedResult, Fitted, DriftOfSession, FiveProbeDrift, Comparison, TestFiles, HistoryResult, History,
                 ImportedLog, MergedLogs, SimulatedRun, SimulatedFleet, TrainedOnBatches, TrainedOnEffects,
                 SelectedBatches, PredictedSeries, PredictedJob, PredictedByEffects, ReplayResult, MadeSets, NextRun,
                 ScoredSets, MeanPointsResult, ShaftPart, PageReport, ModelPart, HeldPart, RevisedPart,
                 HistoryReport, FleetReport, CarriedFiles>();
  std::vector<std::pair<std::filesystem::path, std::string>> files{
      {folder / "apps/page/src/results.ts", typescript_file(schemas)},
      {folder / "apps/python/ballbar/_kinds.py", python_file(schemas)}};
  for (const std::filesystem::directory_entry& room : std::filesystem::directory_iterator(folder / "apps")) {
    const std::filesystem::path page = room.path() / "README.md";
    if (std::filesystem::exists(page)) files.emplace_back(page, with_tables(read_bytes(page, kLargest), schemas));
  }
  int status = 0;
  for (const auto& [path, text] : files) {
    if (std::filesystem::exists(path) && read_bytes(path, kLargest) == text) continue;
    if (update) {
      write_bytes(path, text);
    } else {
      fmt::print("{} differs from the fields of the results: result_keys FOLDER --update\n", path.string());
      status = 1;
    }
  }
  return status;
}

}  // namespace
}  // namespace ballbar

int main(int argc, char** argv) {
  try {
    return ballbar::run(argc > 1 ? argv[1] : ".", argc > 2 && std::string_view(argv[2]) == "--update");
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 2;
  }
}
