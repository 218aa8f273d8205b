// A model as a straight line about some parameters, with what is not known of the times of its inputs.
//
//   y = X a + E e      a free: a constant, gains; e ~ N(0, 1) um: shapes of the model, and when its inputs changed
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "diagnosis/evidence/logged_inputs.hpp"
#include "model/model_rows.hpp"

namespace ballbar {

// What a column of the line is.
struct BaseColumn {
  enum class Kind { constant, gain, shape, time };
  Kind kind = Kind::constant;
  std::size_t parameter = 0;  // by its place, of constant, gain and shape
  double scale = 1.0;         // coefficient 1 changes the parameter by so much
  bool is_free() const { return kind == Kind::constant || kind == Kind::gain; }
};

struct BaseColumns {
  Eigen::VectorXd y;                // what is held taken off
  std::vector<BaseColumn> columns;  // of `values`
  Eigen::MatrixXd values;           // n by p
};

// A shape that a fit is free in moves about by a factor of e (of an exponent by half): its reach, one sigma.
double reach_of(const Parameter& parameter, double value);

class BaseModel {
 public:
  // Refers to all.
  BaseModel(const Model& model, const LoggedInputs& logged, const Eigen::VectorXd& y,
            const std::vector<std::size_t>& rows);

  const Model& model() const { return model_; }
  std::size_t parameters() const { return static_cast<std::size_t>(rows_.parameters()); }

  // About these parameters. free: shapes, by their place, that are free though the model holds them; fixed: one that is
  // held though the model does not, 0: none.
  BaseColumns at(const std::vector<double>& parameters, const std::vector<std::size_t>& free = {},
                 std::size_t fixed = 0) const;

  // Columns of Kind::time about these parameters: what moving the changes of its inputs by what a log leaves open adds.
  Eigen::MatrixXd times_at(const std::vector<double>& parameters) const;

  // The curve of the term of this parameter, um.
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
