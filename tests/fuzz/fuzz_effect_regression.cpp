// Any bytes: read_effect_regression returns or throws Error; what it read can be written and read again, and is then
// the same; it predicts rows without a fault.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "ballbar/error.hpp"
#include "ballbar/formats/models/effect_regression_json.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ballbar::EffectRegression regression;
  try {
    regression = ballbar::read_effect_regression(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz");
  } catch (const ballbar::Error&) {
    return 0;
  }
  const std::string written = ballbar::write_effect_regression(regression);
  const ballbar::EffectRegression again = ballbar::read_effect_regression(written, "again");
  if (ballbar::write_effect_regression(again) != written) std::abort();
  // As predict() does of a series: a column for each that the terms read, rows after the end of training.
  ballbar::Series series;
  for (int i = 0; i < 20; ++i) series.time_s.push_back(regression.end_s + regression.end_step_s + i);
  for (std::size_t i = 1; i < series.time_s.size(); ++i) {
    if (!(series.time_s[i] > series.time_s[i - 1])) return 0;  // so late that a second more is none
  }
  for (std::size_t c = 0; c < regression.model.trained.size(); ++c) {
    const ballbar::ColumnRange& range = regression.model.trained[c];
    std::vector<double> values(series.time_s.size(), range.low);
    values.back() = range.high;
    series.columns.push_back({range.column, regression.roles[c], values});
  }
  const ballbar::RegressionPrediction prediction = ballbar::predict(regression, series);
  if (prediction.predicted_um.size() != series.time_s.size()) std::abort();
  return 0;
}
