// Recordings and their fits as parts of a report.
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <utility>

#include "ballbar/units.hpp"
#include "report/report_data.hpp"
#include "report/report_results.hpp"

namespace ballbar {
namespace {

std::vector<double> deviation_um(const Recording& recording) {
  std::vector<double> deviation;
  deviation.reserve(recording.length_mm.size());
  for (const double length_mm : recording.length_mm) {
    deviation.push_back(um_from_mm(length_mm - recording.nominal_length_mm));
  }
  return deviation;
}

Trace trace_of_circle(const FittedRecording& fitted) {
  const std::vector<double> deviation = deviation_um(fitted.recording);
  const Eigen::ArrayXd left = residual_um(fitted.recording, *fitted.circle);
  std::vector<double> angle_deg, residual, circle;
  for (std::size_t i = 0; i < deviation.size(); ++i) {
    angle_deg.push_back(deg_from_rad(fitted.recording.angle_rad[i]));
    residual.push_back(left[static_cast<Eigen::Index>(i)]);
    circle.push_back(deviation[i] - residual.back());
  }
  return {{angle_deg}, {deviation}, {residual}, {circle}, {}, {}};
}

Trace trace_of_length(const FittedRecording& fitted) {
  const std::vector<double> deviation = deviation_um(fitted.recording);
  const double mean_um = um_from_mm(fitted.axial->length_mm - fitted.recording.nominal_length_mm);
  std::vector<double> residual = deviation;
  for (double& value : residual) value -= mean_um;
  Trace trace{{}, {deviation}, {residual}, {std::vector<double>(residual.size(), mean_um)}, {}, {}};
  if (!fitted.recording.time_s.empty()) trace.time_s = Bulk{fitted.recording.time_s};
  return trace;
}

std::string what_of(const Recording& recording) {
  if (recording.kind == Kind::axial) return "axial";
  return fmt::format("{} {}", name_of(recording.plane), name_of(recording.direction));
}

PageRecording recording_of(const FittedRecording& fitted, std::optional<double> time_s) {
  PageRecording recording{fitted, time_s, file_name(fitted.file), "", {}};
  recording.fitted.file = recording.test;
  if (time_s) recording.test = fmt::format("{:g} min", min_from_s(*time_s));
  recording.label = fmt::format("{}, {}", recording.test, what_of(fitted.recording));
  recording.trace = fitted.circle ? trace_of_circle(fitted) : trace_of_length(fitted);
  return recording;
}

// One test a file; nothing: the recordings belong to no session.
FitPart part(const Fitted& fitted, const SessionFiles* session) {
  FitPart part;
  std::size_t place = 0;  // in session->recordings
  for (const FittedRecording& one : fitted.recordings) {
    std::optional<double> time_s;
    if (session != nullptr) {
      while (session->recordings[place].file != one.file) ++place;
      time_s = session->session.tests[session->recordings[place].test].elapsed_s;
    }
    part.recordings.push_back(recording_of(one, time_s));
    const std::string& label = part.recordings.back().label;
    if (!one.results.empty()) part.results.push_back({label, one.results});
    if (one.circle && !one.circle->converged)
      part.remarks.push_back(fmt::format("{}: the fit did not converge: {}.", label, one.circle->outcome));
  }
  for (const FittedPair& pair : fitted.pairs) {
    part.pairs.push_back({pair.ccw, pair.cw});
    const std::string file = file_name(pair.file);
    part.results.push_back({"ISO 230-4, " + file, pair.results});
    for (const std::string& remark : pair.remarks) part.remarks.push_back(fmt::format("{}: {}", file, remark));
  }
  if (!fitted.results_alone.empty()) part.stored_alone = fitted.results_alone;
  if (part.stored_alone) {
    for (ResultsAlone& alone : *part.stored_alone) alone.file = file_name(alone.file);
  }
  part.iso230_4 = fitted.pairs;
  return part;
}

}  // namespace

FitPart recordings_part(const Fitted& fitted) { return part(fitted, nullptr); }

FitPart recordings_part(const Fitted& fitted, const SessionFiles& session) { return part(fitted, &session); }

void overlay(FitPart& part, const std::string& effect, const std::vector<double>& values_um, const Fit& fit,
             const Series& trace) {
  const Column* number_of = find_column(trace, "recording");
  std::vector<PageRecording*> circles;
  for (PageRecording& recording : part.recordings) {
    if (recording.fitted.circle) circles.push_back(&recording);
  }
  std::vector<std::vector<double>> values(circles.size());
  for (std::size_t i = 0; i < fit.row.size(); ++i) {
    values.at(static_cast<std::size_t>(number_of->values[fit.row[i]])).push_back(values_um[i]);
  }
  for (std::size_t k = 0; k < circles.size(); ++k)
    circles[k]->trace.effects.push_back({effect, {std::move(values[k])}});
}

}  // namespace ballbar
