#include "model/other_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "ballbar/formats/logs/log.hpp"
#include "ballbar/internal/number_text.hpp"
#include "ballbar/internal/numerics/order_statistic.hpp"
#include "ballbar/internal/series/continued_run.hpp"
#include "ballbar/series/series.hpp"
#include "model/targets_in_um.hpp"
#include "terminal/stderr_line.hpp"

namespace ballbar {
namespace {

std::vector<std::string> inputs_of(const Model& model) {
  std::set<std::string> names;
  for (const Term& term : model.terms) names.insert(term.columns.begin(), term.columns.end());
  return {names.begin(), names.end()};
}

// A run of the fit by its own clock: several are stacked, each from 0.
struct RunOfFit {
  Series series;
  RowRange range;  // of the data of the fit
};

std::vector<RunOfFit> runs_of_fit(const ModelOptions& options, const ModelData& fitted,
                                  const std::vector<Source>& of_fit) {
  const std::vector<RowRange> ranges = runs_of(fitted.series->time_s);
  if (ranges.size() == 1) return {{*fitted.series, ranges.front()}};
  std::vector<RunOfFit> runs;
  if (ranges.size() != of_fit.size()) return runs;  // a list of runs, a workbook: their clocks are not known here
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    const ModelData alone = open_model_data({of_fit[r]}, {}, options.max_gap_s);
    runs.push_back({rows_of(*fitted.series, ranges[r]), ranges[r]});
    runs.back().series.started = alone.series->started;
    for (double& time_s : runs.back().series.time_s) time_s += alone.series->time_s.front();
  }
  return runs;
}

// Time 0 of the other on the clock of the run, in s; of two clocks that are not known the same.
double clock_s(const Series& run, const Series& other) {
  const auto zero_of = [](const Series& one) { return one.started ? seconds_of_stamp(*one.started) : std::nullopt; };
  const std::optional<double> of_run = zero_of(run), of_other = zero_of(other);
  return of_run && of_other ? *of_other - *of_run : 0.0;
}

struct Continued {
  ContinuedRun run;
  std::size_t of = 0;  // the run of the fit
};

std::optional<Continued> continued(const std::vector<RunOfFit>& runs, const Series& other,
                                   const std::vector<std::string>& inputs) {
  std::optional<Continued> best;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    auto found = continued_run(runs[r].series, other, inputs, clock_s(runs[r].series, other));
    if (found && (!best || found->pause_s < best->run.pause_s)) best = Continued{std::move(*found), r};
  }
  return best;
}

// All runs of the fit, with `run` in the place of one of them.
Series with_run(const ModelData& fitted, const std::vector<RunOfFit>& runs, std::size_t of, const Series& run) {
  if (runs.size() == 1) return run;
  Series all;
  all.has_clock = run.has_clock;
  all.runs = fitted.series->runs;
  for (const Column& column : run.columns) all.columns.push_back({column.name, column.role, {}, column.header});
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Series& one = r == of ? run : runs[r].series;
    for (const double time_s : one.time_s) all.time_s.push_back(time_s - one.time_s.front());
    for (Column& column : all.columns) {
      const std::vector<double>& values = find_column(one, column.name)->values;
      column.values.insert(column.values.end(), values.begin(), values.end());
    }
  }
  return all;
}

Series with_rows(const Series& series, const std::vector<std::size_t>& rows) {
  const auto some = [&](const std::vector<double>& values) {
    std::vector<double> kept;
    kept.reserve(rows.size());
    for (const std::size_t row : rows) kept.push_back(values[row]);
    return kept;
  };
  Series result = series;
  result.time_s = some(series.time_s);
  for (Column& column : result.columns) column.values = some(column.values);
  return result;
}

// Whether the data have the inputs, with other times or values than those of the fit.
bool are_others(const Series& data, const Series& fitted, const std::vector<std::string>& inputs) {
  bool is_other = data.time_s != fitted.time_s;
  for (const std::string& name : inputs) {
    const Column* const column = find_column(data, name);
    if (column == nullptr) return false;  // which predict() says
    is_other = is_other || column->values != find_column(fitted, name)->values;
  }
  return is_other;
}

std::string rows_text(std::size_t rows) { return rows == 1 ? "1 row" : fmt::format("{} rows", rows); }

void say_place(const std::string& name, const ContinuedRun& run, const Series& of_fit, std::size_t before,
               std::size_t left_out) {
  std::vector<std::string> remarks;
  if (before > 0) {
    remarks.push_back(fmt::format("{}: {} not predicted: before the first row of the fit, where its effects start.",
                                  name, rows_text(before)));
  }
  if (left_out > 0) {
    remarks.push_back(
        fmt::format("{}: {} left out, because an input has no value there. State a longer --max-gap to "
                    "interpolate.",
                    name, rows_text(left_out)));
  }
  if (run.pause_s > std::max(600.0, 3.0 * median_step_s(of_fit.time_s))) {
    remarks.push_back(fmt::format("{}: begins {} after the fit. The inputs are taken as straight lines in between.",
                                  name, duration_text(run.pause_s)));
  }
  tell(remarks);
}

}  // namespace

OtherData of_its_own(ModelData data) {
  OtherData other{std::move(data), nullptr, {}};
  other.run = other.data.series;
  for (std::size_t row = 0; row < other.run->time_s.size(); ++row) other.row.push_back(row);
  return other;
}

OtherData open_other(const ModelOptions& options, const Model& model, const ModelData& fitted,
                     const std::vector<Source>& of_fit) {
  const Source& source = options.data.front();
  const bool is_one = options.data.size() == 1 && fitted.level == Level::series;
  const std::vector<std::string> inputs = inputs_of(model);
  // Values in memory as they are: what the fit interpolated at the edge of a part is known to the run alone.
  const bool as_it_is = is_one && source.series() != nullptr;
  ModelData data;
  if (as_it_is) {
    data.series = source.series();
    data.title = source.title();
    data = with_targets_in_um(std::move(data), options);
  } else {
    data = open_data(options);
  }
  const std::shared_ptr<const Series> rows = data.series;
  const bool may_go_on = is_one && !inputs.empty() && runs_of(rows->time_s).size() == 1;
  const std::vector<RunOfFit> runs = may_go_on ? runs_of_fit(options, fitted, of_fit) : std::vector<RunOfFit>();
  const std::optional<Continued> found = continued(runs, *rows, inputs);
  if (!found) {
    if (as_it_is) data = open_data(options);
    if (fitted.level == Level::series && !inputs.empty() && are_others(*data.series, *fitted.series, inputs)) {
      tell(
          {fmt::format("{}: another run than that of the fit: its effects start at rest at its own first row, which is "
                       "its zero.",
                       source.name())});
    }
    return of_its_own(std::move(data));
  }
  const auto closed = with_gaps_closed(std::make_shared<const Series>(found->run.series), options.max_gap_s);
  OtherData other{std::move(data), nullptr, {}};
  other.run = std::make_shared<const Series>(with_run(fitted, runs, found->of, *closed));
  std::vector<std::size_t> kept;
  std::size_t before = 0;
  for (std::size_t row = 0; row < rows->time_s.size(); ++row) {
    const double time_s = found->run.time_s[row];
    const auto at = std::lower_bound(closed->time_s.begin(), closed->time_s.end(), time_s);
    if (!std::isnan(time_s) && (at == closed->time_s.end() || *at != time_s)) continue;
    kept.push_back(row);
    before += std::isnan(time_s) ? 1 : 0;
    const std::size_t begin = runs[found->of].range.begin;
    other.row.push_back(std::isnan(time_s) ? OtherData::kBefore
                                           : begin + static_cast<std::size_t>(at - closed->time_s.begin()));
  }
  say_place(source.name(), found->run, runs[found->of].series, before, rows->time_s.size() - kept.size());
  other.data.series =
      kept.size() == rows->time_s.size() ? rows : std::make_shared<const Series>(with_rows(*rows, kept));
  return other;
}

Prediction predict(const Model& model, const std::vector<FittedParameter>& parameters, const OtherData& other,
                   const Eigen::MatrixXd* covariance) {
  const Prediction all = predict(model, parameters, *other.run, covariance);
  const auto at_rows = [&](const std::vector<double>& values) {
    std::vector<double> some;
    some.reserve(other.row.size());
    for (const std::size_t row : other.row) some.push_back(row == OtherData::kBefore ? std::nan("") : values[row]);
    return some;
  };
  Prediction prediction;
  prediction.predicted_um = at_rows(all.predicted_um);
  for (const std::vector<double>& one : all.contribution_um) prediction.contribution_um.push_back(at_rows(one));
  if (!all.sigma_um.empty()) prediction.sigma_um = at_rows(all.sigma_um);
  return prediction;
}

}  // namespace ballbar
