#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include "ballbar/error.hpp"
#include "ballbar/internal/numerics/parallel.hpp"
#include "ballbar/model/model.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsKept = 3;
constexpr std::size_t kTermsTogether = 8;  // of a part of the work
constexpr double kSafe = 1e290;            // contributions below add up to a finite value

void expect_runs_live(const Model& model) {
  if (model.level != Level::series) {
    throw Error("expected a model of a drift series, which runs with its signals, found one of recordings.");
  }
  for (const Term& term : model.terms) {
    if (term.effect->evaluate.rows) continue;
    throw Error(
        fmt::format("{}: expected effects that need no later rows, found one that cannot run live.", label_of(term)));
  }
}

}  // namespace

LiveModel::LiveModel(const Model& model) : constant_um_(model.constant_um.value_or(0.0)) {
  expect_runs_live(model);
  for (const Term& term : model.terms) {
    LiveTerm live{term.effect->evaluate, {}, {}, state_.kept.size(), {}};
    for (const Setting& setting : term.settings) live.parameters.push_back(setting.start);
    for (const std::string& name : term.columns) {
      const auto known = std::find(columns_.begin(), columns_.end(), name);
      live.column.push_back(static_cast<std::size_t>(known - columns_.begin()));
      if (known == columns_.end()) columns_.push_back(name);
    }
    live.rows.inputs.resize(live.column.size());
    state_.kept.resize(state_.kept.size() + live.evaluate.kept);
    terms_.push_back(std::move(live));
  }
  state_.inputs.resize(kRowsKept * columns_.size());
  before_ = state_;
  contributions_um_.resize(terms_.size());
}

double LiveModel::next(double time_s, std::span<const double> values) {
  assert(values.size() == columns_.size());
  before_ = state_;  // sizes are alike: no memory
  const std::size_t row = std::min(state_.rows, kRowsKept - 1);
  if (state_.rows == kRowsKept) {
    state_.time_s[1] = state_.time_s[2];
    for (std::size_t c = 0; c < columns_.size(); ++c)
      state_.inputs[c * kRowsKept + 1] = state_.inputs[c * kRowsKept + 2];
  }
  state_.rows = row + 1;
  state_.time_s[row] = time_s;
  for (std::size_t c = 0; c < columns_.size(); ++c) state_.inputs[c * kRowsKept + row] = values[c];
  const double value_um = value_at(row);
  if (!std::isfinite(value_um)) state_ = before_;
  return value_um;
}

bool LiveModel::next(std::span<const double> time_s, std::span<const std::span<const double>> values,
                     std::span<double> contributions_um) {
  const std::size_t n = time_s.size(), known = state_.rows, rows = known + n;
  assert(n > 0 && values.size() == columns_.size() && contributions_um.size() == n * terms_.size());
  // The rows that are known and then these.
  std::vector<double> times(state_.time_s.begin(), state_.time_s.begin() + static_cast<std::ptrdiff_t>(known));
  times.insert(times.end(), time_s.begin(), time_s.end());
  std::vector<double> inputs(rows * columns_.size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    double* const column = inputs.data() + c * rows;
    std::copy_n(state_.inputs.data() + c * kRowsKept, known, column);
    std::copy_n(values[c].data(), n, column + known);
  }
  before_.kept = state_.kept;
  std::atomic<bool> all_finite = true;
  in_parallel((terms_.size() + kTermsTogether - 1) / kTermsTogether, [&](std::size_t part) {
    const std::size_t end = std::min((part + 1) * kTermsTogether, terms_.size());
    for (std::size_t t = part * kTermsTogether; t < end && all_finite; ++t) {
      const LiveTerm& term = terms_[t];
      EffectRows of{times, {}};
      for (const std::size_t c : term.column) of.inputs.emplace_back(inputs.data() + c * rows, rows);
      double* const added_um = contributions_um.data() + t * n;
      term.evaluate.rows(of, known, rows, term.parameters.data(), state_.kept.data() + term.kept, added_um);
      if (!std::all_of(added_um, added_um + n, [](double um) { return std::abs(um) < kSafe; })) all_finite = false;
    }
  });
  if (!all_finite) {
    state_.kept = before_.kept;
    return false;
  }
  // Rows 0, i - 1 and i.
  state_.rows = std::min(rows, kRowsKept);
  for (std::size_t kept = 0; kept < state_.rows; ++kept) {
    const std::size_t row = kept == 0 ? 0 : rows - state_.rows + kept;
    state_.time_s[kept] = times[row];
    for (std::size_t c = 0; c < columns_.size(); ++c) state_.inputs[c * kRowsKept + kept] = inputs[c * rows + row];
  }
  return true;
}

double LiveModel::value_at(std::size_t row) {
  if (shown_rows_ != state_.rows) show_rows();
  double sum_um = constant_um_;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    const LiveTerm& term = terms_[t];
    term.evaluate.rows(term.rows, row, row + 1, term.parameters.data(), state_.kept.data() + term.kept,
                       &contributions_um_[t]);
    sum_um += contributions_um_[t];
  }
  return sum_um;
}

void LiveModel::show_rows() {
  for (LiveTerm& term : terms_) {
    term.rows.time_s = {state_.time_s.data(), state_.rows};
    for (std::size_t k = 0; k < term.column.size(); ++k)
      term.rows.inputs[k] = {state_.inputs.data() + term.column[k] * kRowsKept, state_.rows};
  }
  shown_rows_ = state_.rows;
}

void LiveModel::resume(const State& state) {
  if (state.inputs.size() != state_.inputs.size() || state.kept.size() != state_.kept.size()) {
    throw Error(
        fmt::format("expected the state of this model, {} inputs and {} numbers that its effects keep, found "
                    "{} and {}.",
                    state_.inputs.size(), state_.kept.size(), state.inputs.size(), state.kept.size()));
  }
  bool rises = state.rows <= kRowsKept;
  for (std::size_t i = 1; rises && i < state.rows; ++i) rises = state.time_s[i] > state.time_s[i - 1];
  if (!rises) throw Error("expected a state of at most 3 rows whose times rise, found another.");
  state_ = state;
}

}  // namespace ballbar
