#include "fit/multi_start.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace ballbar {
namespace {

constexpr std::size_t kMostPoints = 1500;  // of one term's grid
constexpr std::size_t kCoarseOnsets = 200;
constexpr Eigen::Index kMostRows = 1500;  // of the target, only for the screening
constexpr int kRounds = 2;

using Points = std::vector<std::vector<double>>;

// Every point once for each value of the parameter k.
Points combined(const Points& points, std::size_t k, const std::vector<double>& values) {
  Points more;
  for (const std::vector<double>& point : points) {
    for (const double value : values) {
      more.push_back(point);
      more.back()[k] = value;
    }
  }
  return more;
}

// All combinations of a term's shapes, each a whole parameter vector of the term.
Points grid_of(const Term& term, const EffectRows& rows) {
  std::vector<double> first;
  for (const Setting& setting : term.settings) first.push_back(setting.start);
  Points points{first};
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const Parameter& parameter = term.effect->parameters[k];
    const Setting& setting = term.settings[k];
    if (parameter.kind == ParameterKind::gain || setting.held || setting.stated) continue;
    std::vector<double> grid = grid_of(parameter, rows, setting.lower, setting.upper, kMostPoints / points.size());
    if (grid.empty() && parameter.shape_of == ShapeOf::onset) {
      const std::size_t stride = 1 + rows.time_s.size() / kCoarseOnsets;
      for (std::size_t row = stride; row < rows.time_s.size(); row += stride) grid.push_back(rows.time_s[row]);
    }
    if (grid.empty() || points.size() * grid.size() > kMostPoints) continue;
    points = combined(points, k, grid);
  }
  return points;
}

// All rows near a coarse onset, because an onset is only found from the adjacent row.
Points finer(const Term& term, const EffectRows& rows, const std::vector<double>& point) {
  for (std::size_t k = 0; k < term.settings.size(); ++k) {
    const bool is_onset = term.effect->parameters[k].shape_of == ShapeOf::onset;
    if (!is_onset || term.settings[k].held || term.settings[k].stated) continue;
    const std::size_t stride = 1 + rows.time_s.size() / kCoarseOnsets;
    const auto at = std::lower_bound(rows.time_s.begin(), rows.time_s.end(), point[k]);
    const auto middle = static_cast<std::size_t>(at - rows.time_s.begin());
    std::vector<double> grid;
    for (std::size_t row = middle > stride ? middle - stride : 0; row < middle + stride && row < rows.time_s.size();
         ++row) {
      grid.push_back(rows.time_s[row]);
    }
    return combined({point}, k, grid);
  }
  return {};
}

// The columns of the free gains at one point, and the contribution of the held ones.
struct Basis {
  Eigen::MatrixXd columns;  // one per free gain
  Eigen::VectorXd offset;
};

class Screening {
 public:
  Screening(const Model& model, const ModelRows& rows, const Eigen::VectorXd& target_um, const Eigen::VectorXd& weight)
      : model_(model), rows_(rows) {
    stride_ = 1 + target_um.size() / kMostRows;
    weight_ = subsampled(weight);
    target_ = subsampled(target_um).cwiseProduct(weight_);
  }

  Basis basis(std::size_t term, const std::vector<double>& point) const {
    std::vector<double> p = point;
    const Term& bound = model_.terms[term];
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (is_free_gain(bound, k)) p[k] = 0.0;
    }
    Eigen::MatrixXd derivatives;
    const Eigen::VectorXd values = rows_.term(term, p.data(), &derivatives);
    Basis result;
    result.offset = subsampled(values).cwiseProduct(weight_);
    std::vector<Eigen::Index> gains;
    for (std::size_t k = 0; k < p.size(); ++k) {
      if (is_free_gain(bound, k)) gains.push_back(static_cast<Eigen::Index>(k));
    }
    result.columns.resize(weight_.size(), static_cast<Eigen::Index>(gains.size()));
    for (std::size_t k = 0; k < gains.size(); ++k) {
      result.columns.col(static_cast<Eigen::Index>(k)) = subsampled(derivatives.col(gains[k])).cwiseProduct(weight_);
    }
    return result;
  }

  struct Solution {
    double cost = std::numeric_limits<double>::infinity();
    Eigen::VectorXd gains;  // the constant first where it is free
  };

  Solution solve(const std::vector<const Basis*>& bases) const {
    const bool constant = !model_.constant_um && model_.level == Level::series;
    Eigen::Index count = constant ? 1 : 0;
    for (const Basis* basis : bases) count += basis->columns.cols();
    Eigen::MatrixXd a(weight_.size(), count);
    Eigen::VectorXd b = target_ - model_.constant_um.value_or(0.0) * weight_;
    Eigen::Index column = 0;
    if (constant) a.col(column++) = weight_;
    for (const Basis* basis : bases) {
      a.middleCols(column, basis->columns.cols()) = basis->columns;
      column += basis->columns.cols();
      b -= basis->offset;
    }
    Solution solution;
    if (count == 0) {
      solution.cost = b.squaredNorm();
      return solution;
    }
    // Columns scaled to unit length with a small ridge, so that equal effects share their contribution.
    const Eigen::VectorXd scale = a.colwise().norm().cwiseMax(1e-300);
    const Eigen::MatrixXd unit = a * scale.cwiseInverse().asDiagonal();
    Eigen::MatrixXd gram = unit.transpose() * unit;
    gram.diagonal().array() += 1e-9;
    solution.gains = gram.ldlt().solve(unit.transpose() * b);
    solution.cost = (b - unit * solution.gains).squaredNorm();
    solution.gains = solution.gains.cwiseQuotient(scale);
    return solution;
  }

  bool is_free_gain(const Term& term, std::size_t k) const {
    return term.effect->parameters[k].kind == ParameterKind::gain && !term.settings[k].held;
  }

 private:
  template <class Column>
  Eigen::VectorXd subsampled(const Column& column) const {
    Eigen::VectorXd result((column.size() + stride_ - 1) / stride_);
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = column[i * stride_];
    return result;
  }

  const Model& model_;
  const ModelRows& rows_;
  Eigen::Index stride_ = 1;
  Eigen::VectorXd target_, weight_;
};

}  // namespace

std::vector<Eigen::VectorXd> starts(const Model& model, const ModelRows& rows, const Eigen::VectorXd& target_um,
                                    const Eigen::VectorXd& weight, std::size_t count) {
  const Screening screening(model, rows, target_um, weight);
  const std::size_t terms = model.terms.size();
  std::vector<Points> points(terms);
  std::vector<std::vector<Basis>> bases(terms);
  for (std::size_t t = 0; t < terms; ++t) {
    points[t] = grid_of(model.terms[t], rows.inputs(t));
    for (const std::vector<double>& point : points[t]) bases[t].push_back(screening.basis(t, point));
  }
  std::vector<std::size_t> chosen(terms, 0);
  struct Candidate {
    double cost;
    std::vector<std::size_t> chosen;
    Eigen::VectorXd gains;
  };
  std::vector<Candidate> candidates;
  const auto tried = [&](const std::vector<std::size_t>& choice) {
    std::vector<const Basis*> selected;
    for (std::size_t t = 0; t < terms; ++t) selected.push_back(&bases[t][choice[t]]);
    const Screening::Solution solution = screening.solve(selected);
    candidates.push_back({solution.cost, choice, solution.gains});
    return solution.cost;
  };
  double least = tried(chosen);
  for (int round = 0; round < kRounds; ++round) {
    bool moved = false;
    for (std::size_t t = 0; t < terms; ++t) {
      if (points[t].size() < 2) continue;
      std::size_t best = chosen[t];
      for (std::size_t i = 0; i < points[t].size(); ++i) {
        std::vector<std::size_t> choice = chosen;
        choice[t] = i;
        const double cost = tried(choice);
        if (cost < least) {
          least = cost;
          best = i;
        }
      }
      moved = moved || best != chosen[t];
      chosen[t] = best;
      for (std::vector<double>& point : finer(model.terms[t], rows.inputs(t), points[t][best])) {
        bases[t].push_back(screening.basis(t, point));
        points[t].push_back(std::move(point));
        std::vector<std::size_t> choice = chosen;
        choice[t] = points[t].size() - 1;
        const double cost = tried(choice);
        if (cost < least) {
          least = cost;
          chosen = choice;
        }
      }
    }
    if (!moved) break;
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& left, const Candidate& right) { return left.cost < right.cost; });
  std::vector<Eigen::VectorXd> result;
  std::vector<std::vector<std::size_t>> taken;
  for (const Candidate& candidate : candidates) {
    if (result.size() == std::max<std::size_t>(1, count)) break;
    if (std::find(taken.begin(), taken.end(), candidate.chosen) != taken.end()) continue;
    taken.push_back(candidate.chosen);
    Eigen::VectorXd p(rows.parameters());
    Eigen::Index gain = 0;
    const bool constant = !model.constant_um && model.level == Level::series;
    p[0] = constant ? candidate.gains[gain++] : model.constant_um.value_or(0.0);
    for (std::size_t t = 0; t < terms; ++t) {
      const std::vector<double>& point = points[t][candidate.chosen[t]];
      for (std::size_t k = 0; k < point.size(); ++k) {
        const Setting& setting = model.terms[t].settings[k];
        double value = point[k];
        if (screening.is_free_gain(model.terms[t], k)) {
          value = setting.stated ? setting.start : candidate.gains[gain];
          ++gain;
        }
        p[rows.offset(t) + static_cast<Eigen::Index>(k)] = std::clamp(value, setting.lower, setting.upper);
      }
    }
    result.push_back(std::move(p));
  }
  return result;
}

}  // namespace ballbar
