#include "diagnosis/posterior/identities.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "diagnosis/evidence/linear_model.hpp"
#include "numerics/standard_deviation.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kRowsAtEnds = 2;  // at either end of the rows no jump is looked for

// The values of a held parameter to try. fitted: that of a fit.
std::vector<double> other_values(const HeldParameter& held, double fitted, const Parameter& parameter) {
  if (parameter.kind == ParameterKind::gain) return {std::isfinite(fitted) ? fitted : held.value + 1.0};  // all alike
  std::vector<double> values;
  if (std::isfinite(fitted)) values.push_back(fitted);
  if (parameter.unit != "s") {
    std::copy_if(parameter.grid.begin(), parameter.grid.end(), std::back_inserter(values),
                 [&](double value) { return std::abs(value - held.value) > 1e-9; });
    for (const double share : {0.6, 0.8, 0.9, 1.1, 1.25, 1.5}) values.push_back(held.value * share);
  } else if (held.value > 0.0) {
    for (const double factor : {0.3, 0.45, 0.67, 0.82, 1.22, 1.5, 2.2, 3.3}) values.push_back(held.value * factor);
  }
  std::erase_if(values, [&](double value) { return value < parameter.lower || value > parameter.upper; });
  return values;
}

// The curve of a term at another value of one parameter minus that at the held value.
Eigen::VectorXd difference(const Problem& problem, const Linearisation& linearisation, std::size_t parameter,
                           double value) {
  std::vector<double> there = linearisation.parameters;
  there[parameter] = value;
  return problem.base_model->term_at(parameter, there) -
         problem.base_model->term_at(parameter, linearisation.parameters);
}

struct HeldColumn {
  Shape shape;
  Eigen::VectorXd values;
};

std::vector<HeldColumn> held_columns(const Problem& problem, const Linearisation& linearisation, std::size_t k,
                                     double fitted) {
  const std::size_t place = problem.held[k].parameter;
  std::vector<HeldColumn> found;
  for (const double value : other_values(problem.held[k], fitted, problem.base_model->parameter(place))) {
    Eigen::VectorXd column = difference(problem, linearisation, place, value);
    const double deviation = standard_deviation(column);
    if (!column.allFinite() || !(deviation > 1e-9)) continue;
    found.push_back({{problem.library.families.size() + k, 0, 1, 0.0, kNoSignature, value}, column / deviation});
  }
  for (HeldColumn& one : found) one.shape.log_prior = -std::log(static_cast<double>(found.size()));
  return found;
}

// The point of the grid that is nearest to a shape: lengths and times by their ratio.
std::size_t nearest_of_grid(const SignatureLibrary& library, const Family& family, const std::vector<double>& point) {
  const auto distance = [&](std::size_t s) {
    double square = 0.0;
    for (std::size_t k = 0; k < point.size(); ++k) {
      const double a = library.signatures[s].point[k], b = point[k];
      if (a == b) continue;
      const double apart = a > 0.0 && b > 0.0 ? std::log(a / b) : 1.0;
      square += apart * apart;
    }
    return square;
  };
  std::size_t nearest = family.first;
  for (std::size_t s = family.first; s < family.first + family.count; ++s)
    nearest = distance(s) < distance(nearest) ? s : nearest;
  return nearest;
}

// The shape that stands for each point of the grid: the last finer one to which it is the nearest, else itself. So
// finer shapes add no prior.
std::vector<std::size_t> standing_shapes(const SignatureLibrary& library, const Family& family) {
  std::vector<std::size_t> standing(family.count);
  std::iota(standing.begin(), standing.end(), family.first);
  for (const std::size_t s : family.more)
    standing[nearest_of_grid(library, family, library.signatures[s].point) - family.first] = s;
  return standing;
}

// Whether this effect has only a gain and a moment, and the times of the rows rise.
bool jumps(const Problem& problem, std::size_t family) {
  const Effect& effect = *problem.library.families[family].bound.effect;
  if (!is_jump(effect)) return false;
  for (const Term& given : problem.terms) {
    if (given.effect->name == effect.name && given.settings[1].held) return false;  // its moment
  }
  return std::is_sorted(problem.time_s.begin(), problem.time_s.end());
}

}  // namespace

Eigen::VectorXd combination_of(const Identities& identities,
                               const std::vector<std::pair<Eigen::Index, double>>& coefficients) {
  const Eigen::Index n = identities.columns.rows(), c = identities.columns.cols();
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n), jumps = sum;
  for (const auto& [column, coefficient] : coefficients) {
    if (column < c) {
      sum += coefficient * identities.columns.col(column);
    } else {
      jumps[column - c] += coefficient;
    }
  }
  std::partial_sum(jumps.begin(), jumps.end(), jumps.begin());
  return sum + jumps;
}

Identities identities_of(const Problem& problem, const Linearisation& linearisation,
                         const std::vector<double>& fitted_values) {
  Identities result;
  const SignatureLibrary& library = problem.library;
  const Eigen::Index n = problem.library.columns.rows();
  result.families = library.families.size();
  result.log_prior = problem.log_prior;
  if (!problem.held.empty()) {
    for (double& prior : result.log_prior) prior += std::log1p(-problem.tuning.held_values);
    result.log_prior.resize(result.families + problem.held.size(),
                            std::log(problem.tuning.held_values / static_cast<double>(problem.held.size())));
  }
  for (std::size_t f = 0; f < result.families; ++f) {
    if (!jumps(problem, f)) continue;
    if (!problem.level_jumps.empty()) {
      result.log_prior[f] = kLogZero;  // they are the target's
    } else if (!result.jump) {
      result.jump = f;
    }
  }
  std::vector<HeldColumn> held;
  for (std::size_t k = 0; k < problem.held.size(); ++k) {
    std::vector<HeldColumn> columns = held_columns(problem, linearisation, k, fitted_values[k]);
    std::move(columns.begin(), columns.end(), std::back_inserter(held));
  }
  std::vector<std::vector<std::size_t>> standing;
  Eigen::Index behind = 0;
  for (std::size_t f = 0; f < result.families; ++f) {
    standing.push_back(result.jump == f ? std::vector<std::size_t>{} : standing_shapes(library, library.families[f]));
    for (const std::size_t s : standing.back()) behind += library.signatures[s].width;
  }
  result.columns.resize(n, behind + static_cast<Eigen::Index>(held.size()));
  for (std::size_t k = 0; k < held.size(); ++k) {
    held[k].shape.first = behind + static_cast<Eigen::Index>(k);
    result.columns.col(held[k].shape.first) = held[k].values;
  }
  Eigen::Index next = 0;
  for (std::size_t i = 0; i < result.log_prior.size(); ++i) {
    result.first.push_back(result.shapes.size());
    if (result.jump == i) {
      for (std::size_t row = kRowsAtEnds; row + kRowsAtEnds < problem.time_s.size(); ++row) {
        if (problem.at_jump_of_temperature[row] == 0)
          result.shapes.push_back(
              {i, result.columns.cols() + static_cast<Eigen::Index>(row), 1, 0.0, kNoSignature, 0.0});
      }
      // Uniform in time: proportional to the interval before the row.
      double all_s = 0.0;
      for (std::size_t s = result.first.back(); s < result.shapes.size(); ++s) {
        const auto row = static_cast<std::size_t>(result.shapes[s].first - result.columns.cols());
        const double since_s = problem.time_s[row] - problem.time_s[row - 1];
        all_s += since_s;
        result.shapes[s].log_prior = std::log(since_s);
      }
      for (std::size_t s = result.first.back(); s < result.shapes.size(); ++s)
        result.shapes[s].log_prior -= std::log(all_s);
    } else if (i < result.families) {
      for (std::size_t k = 0; k < standing[i].size(); ++k) {
        const Signature& one = library.signatures[standing[i][k]];
        const double log_prior = problem.log_prior_of_shape[library.families[i].first + k];
        result.shapes.push_back({i, next, one.width, log_prior, standing[i][k], 0.0});
        result.columns.middleCols(next, one.width) = problem.library.columns.middleCols(one.first, one.width);
        next += one.width;
      }
    } else {
      for (const HeldColumn& column : held) {
        if (column.shape.identity == i) result.shapes.push_back(column.shape);
      }
    }
    result.count.push_back(result.shapes.size() - result.first.back());
  }
  return result;
}

Identities restricted(const Identities& all, const std::vector<std::size_t>& identities) {
  Identities few;
  few.families = all.families;
  few.log_prior = all.log_prior;
  const auto is_kept = [&](std::size_t i) {
    return std::find(identities.begin(), identities.end(), i) != identities.end();
  };
  if (all.jump && is_kept(*all.jump)) few.jump = all.jump;
  std::vector<Eigen::Index> columns;
  for (std::size_t i = 0; i < all.log_prior.size(); ++i) {
    few.first.push_back(few.shapes.size());
    for (std::size_t s = all.first[i]; s < all.first[i] + all.count[i] && is_kept(i); ++s) {
      few.shapes.push_back(all.shapes[s]);
      if (few.jump == i) continue;
      Shape& shape = few.shapes.back();
      for (Eigen::Index k = 0; k < shape.width; ++k) columns.push_back(shape.first + k);
      shape.first = static_cast<Eigen::Index>(columns.size()) - shape.width;
    }
    few.count.push_back(few.shapes.size() - few.first.back());
  }
  for (Shape& shape : few.shapes) {
    if (few.jump == shape.identity) shape.first += static_cast<Eigen::Index>(columns.size()) - all.columns.cols();
  }
  few.columns = all.columns(Eigen::all, columns);
  return few;
}

std::optional<std::size_t> signature_of_jump(Problem& problem, const Identities& identities, std::size_t row) {
  const Family& family = problem.library.families[*identities.jump];
  std::vector<double> point = problem.library.signatures[family.first].point;
  point[1] = problem.time_s[row - 1];  // from there on the whole of row `row` lies behind it
  for (const std::size_t s : shapes_of(family)) {
    if (problem.library.signatures[s].point == point) return s;
  }
  return add_signature(problem, *identities.jump, point);
}

}  // namespace ballbar
