#include "model/model_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ballbar/error.hpp"
#include "effects/effect_at.hpp"
#include "model/measured_input.hpp"

namespace ballbar {
namespace {

const Column& input_of(const Series& data, const std::string& name) {
  const Column* column = find_column(data, name);
  if (column == nullptr) throw Error(fmt::format("expected the column {} in the data, found none.", name));
  if (std::all_of(column->values.begin(), column->values.end(), [](double v) { return std::isnan(v); })) {
    throw Error(
        fmt::format("expected values of {}, which the model needs, found none: the data do not state them.", name));
  }
  return *column;
}

void expect_no_gap(const Series& data, const std::string& name, std::span<const double> values) {
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isfinite(values[row])) continue;
    throw Error(fmt::format("expected a value of {} at every time, found a gap at {:g} s.", name, data.time_s[row]));
  }
}

}  // namespace

ModelRows::ModelRows(const Model& model, const Series& data, std::vector<std::size_t> rows)
    : rows_(std::move(rows)), all_rows_(data.time_s.size()) {
  for (const std::string& name : measured_inputs_with_gaps(model, data)) {
    lines_.emplace(name, input_values(data, *find_column(data, name)));
  }
  for (const Term& term : model.terms) {
    effects_.push_back(term.effect.get());
    EffectRows inputs;
    inputs.time_s = data.time_s;
    for (const std::string& name : term.columns) {
      const auto line = lines_.find(name);
      const std::vector<double>& values = line != lines_.end() ? line->second : input_of(data, name).values;
      expect_no_gap(data, name, values);
      inputs.inputs.emplace_back(values);
    }
    inputs_.push_back(std::move(inputs));
    offset_.push_back(parameters_);
    parameters_ += static_cast<Eigen::Index>(term.effect->parameters.size());
  }
}

void ModelRows::evaluate(const Eigen::VectorXd& parameters, bool with_slopes, Evaluated& out) const {
  out.values.resize(effects_.size());
  out.slopes.resize(effects_.size());
  out.sum.setConstant(static_cast<Eigen::Index>(rows_.size()), parameters[0]);
  for (std::size_t t = 0; t < effects_.size(); ++t) {
    out.values[t].resize(all_rows_);
    if (with_slopes) out.slopes[t].resize(all_rows_ * effects_[t]->parameters.size());
    effects_[t]->evaluate(inputs_[t], parameters.data() + offset_[t], out.values[t].data(),
                          with_slopes ? out.slopes[t].data() : nullptr);
    for (std::size_t i = 0; i < rows_.size(); ++i) out.sum[static_cast<Eigen::Index>(i)] += out.values[t][rows_[i]];
  }
}

Eigen::VectorXd ModelRows::term(std::size_t term, const double* parameters, Eigen::MatrixXd* derivatives) const {
  const Effect& effect = *effects_[term];
  if (derivatives != nullptr) {
    EffectAt at = effect_at(effect, inputs_[term], {parameters, parameters + effect.parameters.size()}, rows_);
    *derivatives = std::move(at.slopes);
    return std::move(at.values);
  }
  std::vector<double> values(all_rows_);
  effect.evaluate(inputs_[term], parameters, values.data(), nullptr);
  Eigen::VectorXd result(static_cast<Eigen::Index>(rows_.size()));
  for (std::size_t i = 0; i < rows_.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[rows_[i]];
  return result;
}

Eigen::VectorXd ModelRows::sum(const Eigen::VectorXd& parameters, Eigen::MatrixXd* derivatives) const {
  const auto n = static_cast<Eigen::Index>(rows_.size());
  Eigen::VectorXd total = Eigen::VectorXd::Constant(n, parameters[0]);
  if (derivatives != nullptr) {
    derivatives->resize(n, parameters_);
    derivatives->col(0).setOnes();
  }
  Eigen::MatrixXd block;
  for (std::size_t t = 0; t < effects_.size(); ++t) {
    total += term(t, parameters.data() + offset_[t], derivatives != nullptr ? &block : nullptr);
    if (derivatives != nullptr) derivatives->middleCols(offset_[t], block.cols()) = block;
  }
  return total;
}

}  // namespace ballbar
