#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {
namespace {

double rounded(double value) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, 6.0 - std::floor(std::log10(std::abs(value))));
  // Beyond these the scale leaves the range of a double, or rounding shows in the last digits.
  return std::isfinite(scale) && scale > 0.0 ? std::round(value * scale) / scale : value;
}

}  // namespace

Json ValueOf<Bulk>::json(const Bulk& bulk) {
  Json json = Json::array();
  json.get_ref<Json::array_t&>().reserve(bulk.values.size());
  for (const double value : bulk.values) json.push_back(json_value(rounded(value)));
  return json;
}

Json ValueOf<Eigen::MatrixXd>::json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(json_value(matrix(i, j)));
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace ballbar
