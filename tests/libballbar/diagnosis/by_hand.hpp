// Rows and signature libraries made by hand.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/signatures/signature_library.hpp"

namespace ballbar::by_hand {

inline Series rows_of(std::size_t n, double step_s) {
  Series data;
  for (std::size_t i = 0; i < n; ++i) data.time_s.push_back(static_cast<double>(i) * step_s);
  return data;
}

// A library of single columns, each a family of the effect `expansion`.
inline SignatureLibrary library_with(const Eigen::MatrixXd& columns) {
  SignatureLibrary library;
  library.columns = columns;
  for (Eigen::Index k = 0; k < columns.cols(); ++k) {
    library.families.push_back({{find_effect("expansion", Level::series), {"T" + std::to_string(k) + "_degC"}},
                                static_cast<std::size_t>(k),
                                1});
    library.signatures.push_back({static_cast<std::size_t>(k), {0.0}, k, 1, 1.0});
  }
  return library;
}

}  // namespace ballbar::by_hand
