#include "model/workbench_of.hpp"

#include <utility>

namespace ballbar {

Workbench workbench_of(const ModelOptions& options, const std::shared_ptr<const ModelData>& data, const Model& model,
                       DiagnosisOptions diagnosis) {
  expect_to_fit(options, model, *data);
  diagnosis.search.motion = data->motion;
  return {data->series, model, {fit_options(options), std::move(diagnosis)}};
}

}  // namespace ballbar
