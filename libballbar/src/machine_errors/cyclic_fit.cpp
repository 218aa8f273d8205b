#include "machine_errors/cyclic_fit.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <utility>

namespace ballbar {
namespace {

constexpr double kFromOwnReversal_deg[2] = {12.0, 63.0};  // where cyclic errors are read
constexpr double kDetermined = 0.05;  // singular value, of curves that nothing else takes all are near 1

}  // namespace

Part part_of(const std::vector<std::pair<FittedEffect, ErrorColumns>>& own, const ErrorRows& rows) {
  Part part;
  std::vector<const ErrorColumns*> pointers;
  pointers.reserve(own.size());
  part.effects.reserve(own.size());
  std::size_t at = 0;
  for (const auto& [effect, columns] : own) {
    pointers.push_back(&columns);
    part.effects.push_back(effect);
    for (Eigen::Index k = 0; k < columns.size(); ++k) part.effects.back().columns.push_back(at++);
  }
  part.columns = joined(pointers, rows);
  std::erase_if(part.effects, [](const FittedEffect& effect) { return effect.columns.empty() && effect.effect; });
  return part;
}

void with_first(CyclicPart& cyclic, const Block& first) {
  cyclic.shared = first.weighted.transpose() * cyclic.part.columns.values;
  CyclicInverse solved = cyclic_inverse(cyclic, first.inverse);
  cyclic.block.inverse = std::move(solved.inverse);
  cyclic.undetermined = std::move(solved.undetermined);
}

CyclicInverse cyclic_inverse(const CyclicPart& cyclic, const Eigen::MatrixXd& of_first) {
  Eigen::MatrixXd equations = cyclic.own - cyclic.of_together * (of_first * cyclic.shared);
  equations.diagonal() *= 1.0 + kRidge;
  const Eigen::VectorXd scale = cyclic.own.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::JacobiSVD<Eigen::MatrixXd> solved(scale.asDiagonal() * equations * scale.asDiagonal(),
                                                 Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& values = solved.singularValues();
  const Eigen::Index determined = (values.array() >= kDetermined).count();
  if (determined == values.size()) return {equations.partialPivLu().inverse(), {}};
  return {scale.asDiagonal() * solved.matrixV().leftCols(determined) *
              values.head(determined).cwiseInverse().asDiagonal() * solved.matrixU().leftCols(determined).transpose() *
              scale.asDiagonal(),
          solved.matrixV().rightCols(values.size() - determined)};
}

CyclicPart cyclic_part(const std::vector<const Effect*>& effects, const ErrorRows& rows, const ErrorSetUp& set_up,
                       const Eigen::MatrixXd& together, const Block& first, const Eigen::VectorXd& left) {
  CyclicPart cyclic;
  std::vector<std::pair<FittedEffect, ErrorColumns>> own;
  std::vector<Eigen::MatrixXd> weighted;
  own.reserve(effects.size());
  weighted.reserve(effects.size());
  for (const Effect* effect : effects) {
    Eigen::VectorXd weight = Eigen::VectorXd::Zero(rows.size());
    Indices read;
    read.reserve(rows.recording.size());
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
      const double from_deg = from_reversal_deg(rows.angle_rad[i], effect->rules.reversal_deg);
      if (from_deg < kFromOwnReversal_deg[0] || from_deg > kFromOwnReversal_deg[1]) continue;
      weight[i] = rows.count[i];
      read.push_back(i);
    }
    const std::optional<double> known = effect->rules.reversal_deg == 0.0 ? set_up.pitch_a_mm : set_up.pitch_b_mm;
    const std::vector<double> tried = known ? std::vector<double>{*known} : effect->parameters[shape_of(*effect)].grid;
    const double pitch_mm = tried.size() == 1
                                ? tried.front()
                                : best_shape(*effect, tried, rows_at(rows, read), {}, left(read), weight(read));
    ErrorColumns columns = present(effect_columns(*effect, pitch_mm, rows, true), weight);
    weighted.emplace_back(weight.asDiagonal() * columns.values);
    own.emplace_back(FittedEffect{effect, pitch_mm, {}, static_cast<double>(tried.size())}, std::move(columns));
  }
  cyclic.part = part_of(own, rows);
  const Eigen::MatrixXd& columns = cyclic.part.columns.values;
  cyclic.block.weighted.resize(rows.size(), columns.cols());
  Eigen::Index at = 0;
  for (const Eigen::MatrixXd& of_one : weighted) {
    cyclic.block.weighted.middleCols(at, of_one.cols()) = of_one;
    at += of_one.cols();
  }
  cyclic.own = cyclic.block.weighted.transpose() * columns;
  cyclic.of_together = cyclic.block.weighted.transpose() * together;
  with_first(cyclic, first);
  return cyclic;
}

}  // namespace ballbar
