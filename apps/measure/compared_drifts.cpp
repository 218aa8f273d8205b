#include "measure/compared_drifts.hpp"

#include <fmt/format.h>

#include "ballbar/error.hpp"
#include "ballbar/formats/sessions/drift_data.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

MeasuredDrift drift_of_series(const Series& series, const std::string& path, const ComparedDriftOptions& options,
                              const BallPlace& ball) {
  const Series with = is_five_probe(series) || !options.probes.probes.empty() ? stated(series, options.probes) : series;
  if (!is_five_probe(with)) return measured(with, path);
  FivePointOptions how = place_of(with, options.probes, ball);
  how.reference_s = options.reference_s;
  return five_point_of(with, how, path);
}

MeasuredDrift drift_of_session(const SessionFiles& files, const ComparedDriftOptions& options) {
  DriftOptions how;
  how.reference_s = options.reference_s;
  return measured(drift_of(files.session, how), files.session);
}

}  // namespace

ComparedDrifts compared_drifts_of(const ComparedDriftOptions& options) {
  ComparedDrifts drifts;
  const DriftData first = open_drift_data(options.a);
  drifts.files = first.files;
  tell(first.remarks);
  if (options.b.empty()) {
    if (!first.session || !first.session->five_probe) {
      throw Error(fmt::format("{}: expected a second file to compare with, or a session with [five_probe], found {}.",
                              options.a.name(), first.session ? "a session without it" : "a series"));
    }
    const Session& session = first.session->session;
    drifts.title = session.title.empty() ? options.a.name() : session.title;
    drifts.a = drift_of_session(*first.session, options);
    drifts.b = drift_of_series(open_series(*first.session->five_probe), first.session->five_probe->name(), options,
                               first.session->ball);
    return drifts;
  }
  const DriftData second = open_drift_data(options.b);
  tell(second.remarks);
  drifts.files.insert(drifts.files.end(), second.files.begin(), second.files.end());
  const BallPlace ball = first.session ? first.session->ball : second.session ? second.session->ball : BallPlace{};
  const auto drift = [&](const DriftData& data, const std::string& path) {
    MeasuredDrift result =
        data.session ? drift_of_session(*data.session, options) : drift_of_series(*data.series, path, options, ball);
    if (result.what != path) result.what += fmt::format(" ({})", path);
    return result;
  };
  drifts.a = drift(first, options.a.name());
  drifts.b = drift(second, options.b.name());
  return drifts;
}

}  // namespace ballbar
