// Parts of a report that are columns over time.
#include "report/report_parts.hpp"

namespace ballbar {

ProbesPart probes_part(const MeasuredDrift& drift) {
  ProbesPart part{drift.what, drift.reference_s, {drift.time_s}, {}, drift.remarks};
  for (const DriftAxis& axis : drift.axes) {
    std::vector<double> sigma(axis.value.size());
    for (std::size_t row = 0; row < sigma.size(); ++row) sigma[row] = sigma_of(axis, row);
    part.axes.push_back({axis.name, axis.unit, {axis.value}, {sigma}});
  }
  return part;
}

SignalsPart signals_part(const std::string& source, const Series& series) {
  SignalsPart part{source, {series.time_s}, {}};
  for (const Column& column : series.columns)
    part.columns.push_back({column.name, column.role, std::string(unit_of(column.name)), {column.values}});
  return part;
}

BatchPart batch_part(const BatchJob& batch_job) {
  const auto& [model, job] = batch_job;
  BatchPart part{job.target,
                 label_of(model.settings),
                 model.batches,
                 {job.data.time_s},
                 {job.prediction.predicted_um},
                 {job.prediction.half_width_um},
                 {},
                 {job.prediction.T2_of_largest},
                 {job.prediction.Q_of_largest},
                 job.prediction.broken,
                 job.warnings};
  if (const Column* measured = find_column(job.data, job.target)) part.measured_um.value = Bulk{measured->values};
  return part;
}

}  // namespace ballbar
