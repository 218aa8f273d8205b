#include "machine_errors/spike_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "machine_errors/error_blocks.hpp"

namespace ballbar {
namespace {

constexpr double kIndependentWidths = 2.0;  // the curves of all are alike
constexpr double kNotPassed = 1e-6;         // square of a spike whose reversal no recording passes, by the noise
constexpr double kSpikes = 4.0;             // at both ends of both axes
constexpr double kGap_deg = 45.0;           // from one reversal of an axis to the next there is more

// Neighbouring rows of one recording, after one reversal, and the root of their covariance.
struct Window {
  Indices rows;
  Eigen::LLT<Eigen::MatrixXd> root;
};

std::vector<Window> windows_of(const ErrorRows& rows, double reversal_deg, const Noise& noise) {
  std::vector<Window> windows;
  Eigen::Index last = -1;
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    if (since_reversal_deg(rows, i, reversal_deg) > kNearReversal_deg) continue;
    const bool goes_on =
        last >= 0 && rows.recording[static_cast<std::size_t>(i)] == rows.recording[static_cast<std::size_t>(last)] &&
        std::abs(std::remainder(deg_from_rad(rows.angle_rad[i] - rows.angle_rad[last]), 360.0)) < kGap_deg;
    if (!goes_on) windows.emplace_back();
    windows.back().rows.push_back(i);
    last = i;
  }
  for (Window& window : windows) window.root.compute(covariance_of(rows, window.rows, noise));
  return windows;
}

// Columns of the windows' rows, window by window.
Eigen::MatrixXd filters_of(const Eigen::MatrixXd& columns, const std::vector<Window>& windows) {
  Eigen::MatrixXd filters(columns.rows(), columns.cols());
  Eigen::Index first = 0;
  for (const Window& window : windows) {
    const auto size = static_cast<Eigen::Index>(window.rows.size());
    filters.middleRows(first, size) = window.root.solve(columns.middleRows(first, size));
    first += size;
  }
  return filters;
}

// The width whose spikes lower most what is left of the windows' rows.
double best_width_deg(const Effect& effect, const ErrorRows& near, const std::vector<Window>& windows,
                      const Eigen::VectorXd& left) {
  const std::vector<double>& grid = effect.parameters[shape_of(effect)].grid;
  double best = grid.front(), most = -1.0;
  for (const double width_deg : grid) {
    const Eigen::MatrixXd columns = effect_columns(effect, width_deg, near, false).values;
    const Eigen::MatrixXd filters = filters_of(columns, windows);
    double lowers = 0.0;
    for (Eigen::Index k = 0; k < columns.cols(); ++k) {
      const double square = filters.col(k).dot(columns.col(k)), seen = filters.col(k).dot(left);
      if (square > kNotPassed) lowers += seen * seen / square;
    }
    if (lowers > most) most = lowers, best = width_deg;
  }
  return best;
}

}  // namespace

Spikes spikes_in(const std::vector<const Effect*>& effects, const ErrorRows& rows, const Eigen::VectorXd& left,
                 const Noise& noise) {
  Spikes spikes;
  std::vector<ErrorColumns> own;
  std::vector<Eigen::MatrixXd> filters;
  std::size_t at = 0;
  for (const Effect* effect : effects) {
    const std::vector<Window> windows = windows_of(rows, effect->rules.reversal_deg, noise);
    Indices near;
    for (const Window& window : windows) near.insert(near.end(), window.rows.begin(), window.rows.end());
    if (near.empty()) continue;
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
    weight(near) = rows.count(near);
    const double width_deg = best_width_deg(*effect, rows_at(rows, near), windows, left(near));
    ErrorColumns columns = present(effect_columns(*effect, width_deg, rows, false), weight);
    if (columns.size() == 0) continue;
    Eigen::MatrixXd filter = Eigen::MatrixXd::Zero(rows.size(), columns.size());
    const Eigen::MatrixXd filtered = filters_of(columns.values(near, Eigen::all), windows);
    filter(near, Eigen::all) = filtered;
    spikes.effects.push_back({effect, width_deg, {}, kIndependentWidths, kSpikes, false});
    for (Eigen::Index k = 0; k < columns.size(); ++k) spikes.effects.back().columns.push_back(at++);
    own.push_back(std::move(columns));
    filters.push_back(std::move(filter));
  }
  std::vector<const ErrorColumns*> parts;
  parts.reserve(own.size());
  for (const ErrorColumns& one : own) parts.push_back(&one);
  spikes.columns = joined(parts, rows);
  spikes.filters.resize(rows.size(), static_cast<Eigen::Index>(at));
  Eigen::Index column = 0;
  for (const Eigen::MatrixXd& filter : filters) {
    spikes.filters.middleCols(column, filter.cols()) = filter;
    column += filter.cols();
  }
  return spikes;
}

}  // namespace ballbar
