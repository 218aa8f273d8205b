// Parts of a report that are columns over time.
#include <algorithm>
#include <cmath>

#include "ballbar/formats/series/drift_files.hpp"
#include "report/report_parts.hpp"
#include "terminal/json_number.hpp"

namespace ballbar {

using Json = nlohmann::ordered_json;

Json bulk(const std::vector<double>& values) { return json_value(Bulk{values}); }

Json probes_part(const MeasuredDrift& drift) {
  Json json{{"what", drift.what}, {"reference_s", drift.reference_s}, {"time_s", bulk(drift.time_s)}};
  json["axes"] = Json::array();
  for (const DriftAxis& axis : drift.axes) {
    std::vector<double> sigma(axis.value.size());
    for (std::size_t row = 0; row < sigma.size(); ++row) sigma[row] = sigma_of(axis, row);
    json["axes"].push_back(
        {{"name", axis.name}, {"unit", axis.unit}, {"values", bulk(axis.value)}, {"sigma", bulk(sigma)}});
  }
  json["remarks"] = drift.remarks;
  return json;
}

Json signals_part(const std::string& source, const Series& series) {
  Json json{{"source", source}, {"time_s", bulk(series.time_s)}};
  json["columns"] = Json::array();
  for (const Column& column : series.columns) {
    json["columns"].push_back({{"name", column.name},
                               {"role", name_of(column.role)},
                               {"unit", unit_of(column.name)},
                               {"values", bulk(column.values)}});
  }
  return json;
}

Json batch_part(const BatchJob& job) {
  Json json{{"target", job.model.columns.target}, {"method", label_of(job.model.settings)}};
  json["batches"] = Json::array();
  for (const TrainedBatch& batch : job.model.batches) {
    json["batches"].push_back({{"name", batch.name}, {"weight", number(batch.weight)}});
  }
  json["time_s"] = bulk(job.data.time_s);
  json["predicted_um"] = bulk(job.prediction.predicted_um);
  json["half_width_um"] = bulk(job.prediction.half_width_um);
  if (const Column* measured = find_column(job.data, job.model.columns.target)) {
    json["measured_um"] = bulk(measured->values);
  }
  json["T2_of_largest"] = bulk(job.prediction.T2_of_largest);
  json["Q_of_largest"] = bulk(job.prediction.Q_of_largest);
  json["broken"] = job.prediction.broken;
  json["warnings"] = job.warnings;
  return json;
}

}  // namespace ballbar
