#include "diagnosis/evidence/base_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/series/series.hpp"
#include "effects/effect_at.hpp"
#include "numerics/standard_deviation.hpp"

namespace ballbar {
namespace {

// The column shifted in time, linear between the rows and constant beyond them.
std::vector<double> shifted(const std::vector<double>& time_s, const std::vector<double>& values, double by_s) {
  std::vector<double> result = values;
  for (const RowRange& run : runs_of(time_s)) {
    std::size_t k = run.begin;
    for (std::size_t i = run.begin; i < run.end && run.end - run.begin > 1; ++i) {
      const double at_s = std::clamp(time_s[i] + by_s, time_s[run.begin], time_s[run.end - 1]);
      while (k + 2 < run.end && time_s[k + 1] < at_s) ++k;
      const double share = (at_s - time_s[k]) / (time_s[k + 1] - time_s[k]);
      result[i] = values[k] + share * (values[k + 1] - values[k]);
    }
  }
  return result;
}

}  // namespace

double reach_of(const Parameter& parameter, double value) {
  if (parameter.unit == "1") return 0.5 * std::max(0.5, std::min(1.0, std::abs(value)));
  const double usual = std::abs(parameter.start);
  return std::max(std::abs(value), 0.1 * usual);
}

BaseModel::BaseModel(const Model& model, const LoggedInputs& logged, const Eigen::VectorXd& y,
                     const std::vector<std::size_t>& rows)
    : model_(model), logged_(logged), y_(y), rows_(model, logged.series, rows) {
  settings_.push_back(nullptr);
  parameters_.push_back(nullptr);
  term_.push_back(model.terms.size());
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    for (std::size_t k = 0; k < model.terms[t].settings.size(); ++k) {
      settings_.push_back(&model.terms[t].settings[k]);
      parameters_.push_back(&model.terms[t].effect->parameters[k]);
      term_.push_back(t);
    }
  }
}

BaseColumns BaseModel::at(const std::vector<double>& parameters, const std::vector<std::size_t>& free,
                          std::size_t fixed) const {
  BaseColumns result;
  result.y = y_;
  std::vector<Eigen::VectorXd> columns;
  const auto n = static_cast<Eigen::Index>(rows_.rows());
  if (is_constant_free()) {
    columns.emplace_back(Eigen::VectorXd::Ones(n));
    result.columns.push_back({BaseColumn::Kind::constant, 0, 1.0});
  } else if (model_.constant_um) {
    result.y.array() -= *model_.constant_um;
  }
  for (std::size_t t = 0; t < model_.terms.size(); ++t) {
    const auto place = static_cast<std::size_t>(rows_.offset(t));
    Eigen::MatrixXd slopes;
    Eigen::VectorXd values = rows_.term(t, parameters.data() + place, &slopes);
    const std::size_t count = model_.terms[t].settings.size();
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t index = place + k;
      const Setting& setting = *settings_[index];
      const Eigen::VectorXd slope = slopes.col(static_cast<Eigen::Index>(k));
      const bool forced = std::find(free.begin(), free.end(), index) != free.end();
      const bool is_gain = parameters_[index]->kind == ParameterKind::gain;
      if ((setting.held && !forced) || index == fixed) continue;
      const double deviation = standard_deviation(slope);
      if (!slope.allFinite() || !(deviation > 1e-12)) continue;
      if (is_gain) {
        // What remains is linear in it.
        values -= parameters[index] * slope;
        columns.push_back(slope / deviation);
        result.columns.push_back({BaseColumn::Kind::gain, index, 1.0 / deviation});
      } else {
        const double reach = reach_of(*parameters_[index], parameters[index]);
        columns.push_back(slope * reach);
        result.columns.push_back({BaseColumn::Kind::shape, index, reach});
      }
    }
    result.y -= values;
  }
  result.values.resize(n, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) result.values.col(static_cast<Eigen::Index>(k)) = columns[k];
  return result;
}

Eigen::VectorXd BaseModel::term_at(std::size_t parameter, const std::vector<double>& parameters) const {
  const std::size_t t = term_[parameter];
  return rows_.term(t, parameters.data() + rows_.offset(t), nullptr);
}

Eigen::MatrixXd BaseModel::delays_at(const std::vector<double>& parameters, const Tuning& tuning,
                                     std::size_t clocks) const {
  std::vector<std::pair<double, Eigen::VectorXd>> found;
  for (std::size_t t = 0; t < model_.terms.size(); ++t) {
    for (std::size_t k = 0; k < model_.terms[t].columns.size(); ++k) {
      const auto input = std::find_if(logged_.inputs.begin(), logged_.inputs.end(),
                                      [&](const LoggedInput& one) { return one.column == model_.terms[t].columns[k]; });
      if (input == logged_.inputs.end()) continue;
      const std::vector<double>& values = find_column(logged_.series, input->column)->values;
      const auto term_of = [&](const std::vector<double>& moved) {
        EffectRows rows = rows_.inputs(t);
        rows.inputs[k] = moved;
        std::vector<double> all(rows.time_s.size());
        rows_.effect(t).evaluate(rows, parameters.data() + rows_.offset(t), all.data(), nullptr);
        return Eigen::VectorXd(
            Eigen::VectorXd::Map(all.data(), static_cast<Eigen::Index>(all.size()))(rows_.data_rows()));
      };
      Eigen::VectorXd together = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(rows_.rows()));
      if (t < clocks && !input->is_stepped && input->late_s > 0.0) {
        together = 0.5 * (term_of(shifted(logged_.series.time_s, values, input->late_s)) -
                          term_of(shifted(logged_.series.time_s, values, -input->late_s)));
      }
      for (const Jump& jump : input->jumps) {
        const double width = static_cast<double>(jump.last - jump.first);
        const Eigen::VectorXd one =
            (term_of(with_jump_moved(values, jump, true)) - term_of(with_jump_moved(values, jump, false))) *
            (width / (width + 1.0));  // all of its window
        together += one;
        found.emplace_back(tuning.jump_delay * one.norm(), tuning.jump_delay * one);
      }
      if (t < clocks) found.emplace_back(std::numeric_limits<double>::infinity(), tuning.clock_delay * together);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  const std::size_t count = std::min({found.size(), tuning.most_delays, rows_.rows() / tuning.rows_for_a_delay});
  Eigen::MatrixXd result(static_cast<Eigen::Index>(rows_.rows()), static_cast<Eigen::Index>(count));
  for (std::size_t k = 0; k < count; ++k) result.col(static_cast<Eigen::Index>(k)) = found[k].second;
  return result;
}

}  // namespace ballbar
