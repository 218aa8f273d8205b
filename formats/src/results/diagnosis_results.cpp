#include "ballbar/formats/results/diagnosis_results.hpp"

namespace ballbar {

TableOf<std::string> columns_of(const BoundEffect& bound) {
  TableOf<std::string> columns;
  columns.reserve(bound.columns.size());
  for (std::size_t k = 0; k < bound.columns.size(); ++k)
    columns.emplace_back(bound.effect->inputs[k].role, bound.columns[k]);
  return columns;
}

std::vector<CandidateParameter> parameters_of(const Candidate& candidate) {
  std::vector<CandidateParameter> parameters;
  parameters.reserve(candidate.parameters.size());
  for (std::size_t k = 0; k < candidate.parameters.size(); ++k) {
    parameters.push_back(
        {candidate.parameters[k], k < candidate.intervals.size() ? candidate.intervals[k] : Interval{}});
  }
  return parameters;
}

std::vector<NotSearched> not_searched_of(const Diagnosis& found) {
  std::vector<NotSearched> result;
  for (const Detectability& one : found.detectability) {
    if (one.bindings > one.searched) result.push_back({one.effect->name, one.bindings, one.searched});
  }
  return result;
}

std::vector<GainOfRun> runs_of(const GainByRun& gain) {
  std::vector<GainOfRun> runs;
  runs.reserve(gain.gain.size());
  for (std::size_t run = 0; run < gain.gain.size(); ++run) runs.push_back({gain.gain[run], gain.sigma[run]});
  return runs;
}

}  // namespace ballbar
