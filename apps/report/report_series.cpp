// Parts of a report that are columns over time.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "report/report_results.hpp"

namespace ballbar {
namespace {

// A picture is 2000 pixels wide at most. More rows make a page that no browser opens: a million of five columns are
// 45 MB of JSON.
constexpr std::size_t kMostRows = 200'000;

// Of a series of more rows, of each stretch its first row and, for each column, those of the smallest and the largest
// value: what is drawn of it has the same outline.
std::vector<std::size_t> outline_rows(const Series& series) {
  const std::size_t rows = series.time_s.size();
  const std::size_t stretches = std::max<std::size_t>(1, kMostRows / (2 * series.columns.size() + 1));
  const auto begin_of = [&](std::uint64_t stretch) {  // a page's std::size_t has 32 bits
    return static_cast<std::size_t>(stretch * rows / stretches);
  };
  std::vector<std::size_t> chosen;
  chosen.reserve(kMostRows + 1);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t from = begin_of(k), to = begin_of(k + 1);
    const std::size_t before = chosen.size();
    chosen.push_back(from);
    for (const Column& column : series.columns) {
      std::size_t least = rows, largest = rows;
      for (std::size_t row = from; row < to; ++row) {
        const double value = column.values[row];
        if (!std::isfinite(value)) continue;
        if (least == rows || value < column.values[least]) least = row;
        if (largest == rows || value > column.values[largest]) largest = row;
      }
      if (least < rows) chosen.insert(chosen.end(), {least, largest});
    }
    const auto begin = chosen.begin() + static_cast<std::ptrdiff_t>(before);
    std::sort(begin, chosen.end());
    chosen.erase(std::unique(begin, chosen.end()), chosen.end());
  }
  if (chosen.back() + 1 < rows) chosen.push_back(rows - 1);
  return chosen;
}

}  // namespace

std::vector<double> at_rows(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  std::vector<double> chosen;
  chosen.reserve(rows.size());
  for (const std::size_t row : rows) chosen.push_back(values[row]);
  return chosen;
}

Bulk sigmas_of(const DriftAxis& axis) {
  Bulk sigmas{std::vector<double>(axis.value.size())};
  for (std::size_t row = 0; row < sigmas.values.size(); ++row) sigmas.values[row] = sigma_of(axis, row);
  return sigmas;
}

std::optional<Bulk> measured_of(const PredictedJob& job) {
  const Column* const measured = find_column(job.data, job.target);
  return measured == nullptr ? std::nullopt : std::optional(Bulk{measured->values});
}

SignalsPart signals_part(const std::string& source, const Series& series) {
  const bool thinned = series.time_s.size() > kMostRows;
  const std::vector<std::size_t> rows = thinned ? outline_rows(series) : std::vector<std::size_t>();
  const auto drawn = [&](const std::vector<double>& values) { return Bulk{thinned ? at_rows(values, rows) : values}; };
  SignalsPart part{source, drawn(series.time_s), {}, {}, {}};
  for (const Column& column : series.columns)
    part.columns.push_back({column.name, column.role, std::string(unit_of(column.name)), drawn(column.values)});
  if (thinned) part.rows = series.time_s.size();
  part.started = series.started;
  return part;
}

}  // namespace ballbar
