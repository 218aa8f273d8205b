// A model linearised about some parameters, with the uncertain delays of its inputs.
//
//   y = X a + E e      a free: constant and gains; e ~ N(0, 1) um: shapes of the model, and delays of its inputs
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"
#include "model/model_rows.hpp"

namespace ballbar {

// The meaning of a column of the linearised model.
struct BaseColumn {
  enum class Kind { constant, gain, shape };
  Kind kind = Kind::constant;
  std::size_t parameter = 0;  // index of the parameter, for constant, gain and shape
  double scale = 1.0;         // change of the parameter per unit of the coefficient
  bool is_flat() const { return kind == Kind::constant || kind == Kind::gain; }
};

struct BaseColumns {
  Eigen::VectorXd y;                // without the contribution of held parameters
  std::vector<BaseColumn> columns;  // one per column of `values`
  Eigen::MatrixXd values;           // n by p
};

// The prior sigma ("reach") of a free shape: a factor of e, for an exponent one half.
double reach_of(const Parameter& parameter, double value);

class BaseModel {
 public:
  // Keeps references to its arguments.
  BaseModel(const Model& model, const LoggedInputs& logged, const Eigen::VectorXd& y,
            const std::vector<std::size_t>& rows);

  const Eigen::VectorXd& y() const { return y_; }
  const ModelRows& rows() const { return rows_; }
  bool is_constant_free() const { return model_.level == Level::series && !model_.constant_um; }
  std::size_t parameters() const { return static_cast<std::size_t>(rows_.parameters()); }

  // The model linearised about these parameters. free: indices of held shapes to set free. fixed: index of a free
  // parameter to hold; 0: none.
  BaseColumns at(const std::vector<double>& parameters, const std::vector<std::size_t>& free = {},
                 std::size_t fixed = 0) const;

  // What delays of the inputs change at these parameters, each by its prior sigma: a column for the clock of each input
  // of the first `clocks` terms, and of all terms one for each of the largest jumps.
  Eigen::MatrixXd delays_at(const std::vector<double>& parameters, const Tuning& tuning, std::size_t clocks) const;

  // The curve in um of the term that has this parameter.
  Eigen::VectorXd term_at(std::size_t parameter, const std::vector<double>& parameters) const;

  const Setting& setting(std::size_t parameter) const { return *settings_[parameter]; }
  const Parameter& parameter(std::size_t parameter) const { return *parameters_[parameter]; }
  std::size_t term_of(std::size_t parameter) const { return term_[parameter]; }

 private:
  const Model& model_;
  const LoggedInputs& logged_;
  const Eigen::VectorXd& y_;
  ModelRows rows_;
  std::vector<const Setting*> settings_;      // null: the constant
  std::vector<const Parameter*> parameters_;  // null: the constant
  std::vector<std::size_t> term_;
};

}  // namespace ballbar
