// What is written of the results' lists of fields for who reads their JSON: types for the page, classes for Python, and
// the tables of keys in the READMEs of apps, which stand between two lines:
//
//   <!-- keys of NAME -->
//   <!-- end of keys -->
//
//   result_types typescript FILE
//   result_types python FILE
//   result_types readmes FOLDER [--update]     FOLDER: of the sources; fails where a table differs, --update writes it
//   anew
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/results/result_type.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "compensate/compensation_results.hpp"
#include "diagnose/diagnosis_result.hpp"
#include "diagnose/inject_result.hpp"
#include "diagnose/revision_results.hpp"
#include "errors/machine_errors_result.hpp"
#include "errors/test_results.hpp"
#include "history/history_page.hpp"
#include "history/history_result.hpp"
#include "logs/log_results.hpp"
#include "measure/comparison_result.hpp"
#include "measure/drift_result.hpp"
#include "measure/fit_result.hpp"
#include "model/effects_result.hpp"
#include "model/preflight_result.hpp"
#include "plan/plan_result.hpp"
#include "predict/predict_results.hpp"
#include "report/report_inside.hpp"
#include "report/report_results.hpp"
#include "shaft_picture/shaft_result.hpp"
#include "simulate/simulate_result.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kLargest = 1 << 22;

std::string typescript_file(const std::vector<ResultSchema>& schemas) {
  return "// Results of the program: the keys of its `--json`, made of their lists of fields by apps/results.\n\n"
         "export type Num = number | null; // null: not known\n\n" +
         typescript_of(schemas);
}

// What functions of Python answer.
std::vector<PythonClass> python_classes() {
  return {{"Fitted", "circles", {"Fitted"}},
          {"RankedErrors", "machine_errors", {"RankedErrors", "RankedErrorsOfGroups"}},
          {"Drift", "drift", {"Drift", "DriftOfProbes"}},
          {"Comparison", "compare", {"Comparison"}},
          {"History", "history", {"History"}},
          {"Imported", "import_log", {"Imported", "Merged"}},
          {"Simulated", "simulate", {"Simulated", "SimulatedFleet", "BlindMade", "BlindScore"}},
          {"Effects", "effects", {"Effects", "Effect"}},
          {"Preflight", "could", {"Preflight", "PreflightTargets", "Injected"}},
          {"Checked", "Model.fit", {"Checked"}},
          {"Diagnosis", "Fit.diagnose", {"Diagnosed"}, "Checked"},
          {"Tried", "Fit.compare", {"Tried"}},
          {"Plan", "plan", {"Plan"}},
          {"Trained", "train", {"Trained", "TrainedOnEffects", "Selected"}},
          {"Predicted", "predict", {"Predicted", "PredictedTarget"}},
          {"Replay", "compensate", {"Replayed", "Written"}},
          {"Report", "report", {"Report"}}};
}

std::string python_file(const std::vector<ResultSchema>& schemas) {
  return "\"\"\"The results, with their keys, made of their lists of fields by apps/results.\n\n"
         "A key that does not apply is not there. A number that is not known is None, in an array NaN.\n\"\"\"\n"
         "from __future__ import annotations\n\nfrom typing import Any\n\nimport numpy as np\n"
         "from numpy.typing import NDArray\n\nfrom ._results import Result, Rows\n\nArray = NDArray[np.float64]\n" +
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
    const std::string result = page.substr(name, page.find(" -->", name) - name);
    const auto schema =
        std::find_if(schemas.begin(), schemas.end(), [&](const ResultSchema& one) { return one.name == result; });
    if (schema == schemas.end() || end == std::string::npos)
      throw Error(fmt::format("expected the name of a result and an end of its keys, found {}.", result));
    page.replace(line + 1, end - line - 1, "\n" + markdown_of(*schema) + "\n");
    at = line;
  }
  return page;
}

std::vector<ResultSchema> all_schemas() {
  return schemas_of<
      DiagnosisReport, Targets<std::variant<DiagnosisReport, NotDiagnosed>>, ErrorsOfOne, ErrorsReports, ProbableSoFar,
      Targets<ResidualReport>, Targets<Preflight>, EffectPages, PlanReport, EffectTest, Added, Ledger, Undone, Injected,
      Fitted, DriftOfSession, FiveProbeDrift, Comparison, TestFiles, TestComparison, TestHead, FoundHistory, History,
      ImportedLog, MergedSeries, SimulatedRun, SimulatedFleet, TrainedOnTemperatures, TrainedOnEffects, TrainedForJob,
      Series, PredictedTarget, ReplayResult, WrittenResult, MadeSets, ScoredSets, MeanPointsResult, ShaftPart,
      PageReport, ModelPart, RevisedPart, EffectChoice, Hypotheses, HistoryReport, TestsReport, SignalGap, PageFiles>();
}

int run_readmes(const std::filesystem::path& folder, bool update) {
  const std::vector<ResultSchema> schemas = all_schemas();
  int status = 0;
  for (const std::filesystem::directory_entry& room : std::filesystem::directory_iterator(folder / "apps")) {
    const std::filesystem::path page = room.path() / "README.md";
    if (!std::filesystem::exists(page)) continue;
    const std::string old = read_bytes(page, kLargest), text = with_tables(old, schemas);
    if (old == text) continue;
    if (update) {
      write_bytes(page, text);
    } else {
      fmt::print("{} differs from the fields of the results: result_types readmes FOLDER --update\n", page.string());
      status = 1;
    }
  }
  return status;
}

int run(const std::vector<std::string_view>& words) {
  const std::string_view what = words.size() > 1 ? words[0] : "";
  if (what == "readmes") return run_readmes(words[1], words.size() > 2 && words[2] == "--update");
  if (what != "typescript" && what != "python")
    throw Error("usage: result_types typescript FILE | python FILE | readmes FOLDER [--update]");
  write_bytes(std::filesystem::path(words[1]),
              what == "python" ? python_file(all_schemas()) : typescript_file(all_schemas()));
  return 0;
}

}  // namespace
}  // namespace ballbar

int main(int argc, char** argv) {
  try {
    return ballbar::run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    fmt::print("{}\n", error.what());
    return 2;
  }
}
