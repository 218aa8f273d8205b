// A model bound to the columns of its data: values and derivatives at the rows of interest.
//
// Parameters in one vector: the constant first, then term by term as their effects list them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "ballbar/model/model.hpp"
#include "ballbar/series/series.hpp"

namespace ballbar {

class ModelRows {
 public:
  // `rows`: rising indices of the rows of interest. The effects run over all rows of the data, which must outlive this.
  // Measured inputs are interpolated (measured_input.hpp). Throws Error for a gap in another input.
  ModelRows(const Model& model, const Series& data, std::vector<std::size_t> rows);
  ModelRows(const ModelRows&) = delete;  // its inputs point into it
  ModelRows& operator=(const ModelRows&) = delete;

  std::size_t terms() const { return effects_.size(); }
  std::size_t rows() const { return rows_.size(); }
  Eigen::Index parameters() const { return parameters_; }
  Eigen::Index offset(std::size_t term) const { return offset_[term]; }  // of its first parameter
  const Effect& effect(std::size_t term) const { return *effects_[term]; }
  const EffectRows& inputs(std::size_t term) const { return inputs_[term]; }

  const std::vector<std::size_t>& data_rows() const { return rows_; }

  // All terms over all rows of the data, in memory that is reused between evaluations.
  struct Evaluated {
    std::vector<std::vector<double>> values, slopes;  // one a term; slopes: rows by its parameters
    Eigen::VectorXd sum;                              // at the rows of interest, with the constant
  };
  void evaluate(const Eigen::VectorXd& parameters, bool with_slopes, Evaluated& out) const;

  // Values of one term; its derivatives as columns where `derivatives` is not null, rows by the term's parameters.
  Eigen::VectorXd term(std::size_t term, const double* parameters, Eigen::MatrixXd* derivatives) const;

  // Sum of all terms and the constant; derivatives by all parameters, those of a null constant too.
  Eigen::VectorXd sum(const Eigen::VectorXd& parameters, Eigen::MatrixXd* derivatives) const;

 private:
  std::vector<const Effect*> effects_;
  std::map<std::string, std::vector<double>> lines_;  // of measured inputs with gaps
  std::vector<EffectRows> inputs_;
  std::vector<Eigen::Index> offset_;
  std::vector<std::size_t> rows_;
  std::size_t all_rows_ = 0;
  Eigen::Index parameters_ = 1;
};

}  // namespace ballbar
