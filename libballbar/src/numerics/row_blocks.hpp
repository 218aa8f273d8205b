// Readings of a least-squares problem, block by block: residuals and derivatives in constant memory.
//
// `Rows` is the model:
//   Eigen::Index size() const;
//   void fill(Eigen::Index first, const Eigen::Vector<double, P>& p, Part& rows) const;
// fill writes readings first, first + 1, ...: columns 0..P-1 the derivatives of the residual, column P the
// residual.
#pragma once

#include <Eigen/Core>
#include <algorithm>

namespace ballbar::least_squares {

inline constexpr Eigen::Index kBlockRows = 256;

// One more than P, which may be Eigen::Dynamic.
template <int P>
inline constexpr int kAndOne = P == Eigen::Dynamic ? Eigen::Dynamic : P + 1;

template <int P>
using RowBlock = Eigen::Matrix<double, Eigen::Dynamic, kAndOne<P>>;

// Calls use(first, block) over all readings, block after block.
template <int P, class Rows, class Use>
void for_each_block(const Rows& rows, const Eigen::Vector<double, P>& p, Use use) {
  RowBlock<P> block(std::min<Eigen::Index>(kBlockRows, rows.size()), p.size() + 1);
  for (Eigen::Index first = 0; first < rows.size(); first += kBlockRows) {
    const Eigen::Index count = std::min(kBlockRows, rows.size() - first);
    auto part = block.topRows(count);
    rows.fill(first, p, part);
    use(first, part);
  }
}

// Every step-th reading of a model.
template <class Rows>
struct EveryNth {
  const Rows& rows;
  Eigen::Index step = 1;

  Eigen::Index size() const { return (rows.size() + step - 1) / step; }

  template <class Vector, class Part>
  void fill(Eigen::Index first, const Vector& p, Part& part) const {
    for (Eigen::Index i = 0; i < part.rows(); ++i) {
      auto row = part.middleRows(i, 1);
      rows.fill((first + i) * step, p, row);
    }
  }
};

}  // namespace ballbar::least_squares
