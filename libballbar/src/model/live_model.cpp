#include "ballbar/model/live_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsKept = 3;

void expect_runs_live(const Model& model) {
  if (model.level != Level::series) {
    throw Error("expected a model of a drift series, which runs with its signals, found one of recordings.");
  }
  for (const Term& term : model.terms) {
    if (term.effect->evaluate.row) continue;
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
  if (!std::isfinite(value_um)) std::swap(state_, before_);
  return value_um;
}

double LiveModel::value_at(std::size_t row) {
  double sum_um = constant_um_;
  for (std::size_t t = 0; t < terms_.size(); ++t) {
    LiveTerm& term = terms_[t];
    term.rows.time_s = {state_.time_s.data(), state_.rows};
    for (std::size_t k = 0; k < term.column.size(); ++k) {
      term.rows.inputs[k] = {state_.inputs.data() + term.column[k] * kRowsKept, state_.rows};
    }
    contributions_um_[t] = term.evaluate.row(term.rows, row, term.parameters.data(), state_.kept.data() + term.kept);
    sum_um += contributions_um_[t];
  }
  return sum_um;
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
