#include "ballbar/diagnosis/next_test/next_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ballbar/diagnosis/thresholds.hpp"
#include "ballbar/number_text.hpp"
#include "ballbar/numerics/order_statistic.hpp"
#include "diagnosis/next_test/discrimination_matrix.hpp"
#include "diagnosis/next_test/planned_test.hpp"
#include "diagnosis/next_test/undecided_pairs.hpp"
#include "noise/whitening.hpp"
#include "series/subsampled.hpp"

namespace ballbar {
namespace {

constexpr double kNearlyImitated = 0.2;  // likewise: d relative to that of the other order
constexpr double kImitated = 1.0;        // d of an effect that another one can always imitate
constexpr double kUseless = 1.0;         // d

bool suits(const Model& model, const Series& data, const Diagnosis& diagnosis) {
  const Fit& base = diagnosis.base;
  std::size_t parameters = 1;
  for (const Term& term : model.terms) {
    parameters += term.settings.size();
    for (const std::string& name : term.columns) {
      if (find_column(data, name) == nullptr) return false;
    }
  }
  const auto n = static_cast<Eigen::Index>(base.row.size());
  return n > 2 && base.row.back() < data.time_s.size() && base.parameters.size() == parameters &&
         base.jacobian.rows() == n && base.jacobian.cols() == static_cast<Eigen::Index>(parameters) &&
         base.time_s.size() == base.row.size() && base.residual_um.size() == base.row.size() &&
         base.jacobian.allFinite();
}

// d of both orders: a true and b fitted, b true and a fitted.
struct Orders {
  double a_true = 0.0, b_true = 0.0;
};

Orders orders_of(const Eigen::MatrixXd& factor, const Places& places, const Pair& pair) {
  const auto one_way = [&](std::size_t truth, std::size_t competitor) {
    double least = std::numeric_limits<double>::infinity();
    for (const std::vector<Eigen::Index>& free : places.free[competitor]) {
      std::vector<Eigen::Index> columns = places.shared;
      columns.insert(columns.end(), free.begin(), free.end());
      for (const std::size_t other : pair.others) {
        columns.insert(columns.end(), places.free[other][0].begin(), places.free[other][0].end());
      }
      least = std::min(least, distance(factor, places.signal[truth], columns));
    }
    return least;
  };
  return {one_way(pair.a, pair.b), one_way(pair.b, pair.a)};
}

enum class Holds { neither, a_holds_b, b_holds_a };

// A competitor with more parameters that makes all that the other does, whatever is done: a lag of nothing is no lag.
Holds holds(const Orders& orders, const UndecidedPairs& question, const Pair& pair) {
  const auto count = [&](std::size_t competitor) { return question.candidates.competitors[competitor].free.size(); };
  const auto imitated = [](double d, double other) { return d < std::max(kImitated, kNearlyImitated * other); };
  if (count(pair.a) > count(pair.b) && imitated(orders.b_true, orders.a_true)) return Holds::a_holds_b;
  if (count(pair.b) > count(pair.a) && imitated(orders.a_true, orders.b_true)) return Holds::b_holds_a;
  return Holds::neither;
}

// The smaller of both orders; where one competitor holds the other, of that which can be seen.
double separation(const Orders& orders, Holds holds) {
  if (holds == Holds::a_holds_b) return orders.a_true;
  if (holds == Holds::b_holds_a) return orders.b_true;
  return std::min(orders.a_true, orders.b_true);
}

std::string d_text(double d) {
  if (d > 1000.0) return "d above 1000";
  return d >= 99.95 ? fmt::format("d = {:.0f}", d) : fmt::format("d = {:.1f}", d);
}

struct RatedTest {
  PlannedTest test;
  double smallest = std::numeric_limits<double>::infinity();
  double so_far = 0.0;      // of the same pair in the data
  std::size_t hardest = 0;  // pair
  Holds holds = Holds::neither;
  std::size_t settled = 0;  // pairs with d of kIdentifiable or more
};

bool better(const RatedTest& a, const RatedTest& b) {
  const bool a_is_detected = a.smallest >= kDetectable, b_is_detected = b.smallest >= kDetectable;
  if (a_is_detected != b_is_detected) return a_is_detected;
  if (!a_is_detected && a.settled != b.settled) return a.settled > b.settled;
  return a.smallest > b.smallest;
}

std::string pair_text(const UndecidedPairs& question, const Pair& pair, Holds holds) {
  const std::string a = label_of(question.candidates.competitors[pair.a].bound),
                    b = label_of(question.candidates.competitors[pair.b].bound);
  if (question.candidates.competitors[pair.b].only_once) return fmt::format("show whether {} comes again", a);
  if (holds == Holds::a_holds_b) return fmt::format("show whether {} is more than {}", a, b);
  if (holds == Holds::b_holds_a) return fmt::format("show whether {} is more than {}", b, a);
  return fmt::format("distinguish {} from {}", a, b);
}

std::string text_of(const UndecidedPairs& question, const RatedTest& rated) {
  std::string text = rated.test.name + ": " + rated.test.doing + ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  const Pair& hardest = question.pairs[rated.hardest];
  const double d = rated.smallest;
  const std::string outcome =
      fmt::format("{} ({}); the data so far have {}.", d_text(d),
                  d < kDetectable ? "5 is needed, 7.5 to name one" : "named from 7.5", d_text(rated.so_far));
  const std::string pair = pair_text(question, hardest, rated.holds);
  if (question.pairs.size() == 1) {
    text += fmt::format(" It would {} with {}", pair, outcome);
  } else {
    text += fmt::format(" Of {} pairs of candidates it would settle {} (d of 7.5 or more); the hardest is to {}: {}",
                        question.pairs.size(), rated.settled, pair, outcome);
  }
  return text;
}

}  // namespace

std::vector<NextTest> next_tests(const Model& model, const Series& all, const Diagnosis& diagnosis) {
  std::vector<NextTest> result;
  if (model.level == Level::series || diagnosis.verdict == Verdict::nothing ||
      find_column(all, diagnosis.target) == nullptr)
    return result;
  const Series data = subsampled(all, diagnosis.target, kMostTested);
  if (!suits(model, data, diagnosis)) return result;
  const UndecidedPairs question = undecided_pairs_of(model, data, diagnosis);
  if (question.pairs.empty()) return result;

  const DiscriminationMatrix& candidates = question.candidates;
  const Fit& base = diagnosis.base;
  const Places without_own = places_of(candidates, 0);
  const std::optional<Eigen::MatrixXd> in_data = columns_in_data(candidates, 0);
  if (!in_data) return result;
  const Noise& noise = diagnosis.noise;
  const Eigen::MatrixXd factor = whitened_factor(*in_data, Whitening(noise, base.time_s, base.sigma_um));
  std::vector<Orders> so_far;
  for (const Pair& pair : question.pairs) so_far.push_back(orders_of(factor, without_own, pair));
  const auto model_width = static_cast<Eigen::Index>(without_own.shared.size());

  const double usual_sigma_um = base.sigma_um.empty() ? 0.0 : median(base.sigma_um);
  std::vector<RatedTest> tests;
  for (PlannedTest& test : recording_tests(data, diagnosis.target, base.row)) {
    if (test.rows.size() < 2) continue;
    const Eigen::MatrixXd own = own_columns(candidates, test);
    const std::optional<Eigen::MatrixXd> in_test = columns_in_test(candidates, test, own);
    if (!in_test) continue;
    std::vector<double> time_s;
    for (const std::size_t row : test.rows) time_s.push_back(test.inputs.time_s[row]);
    const std::vector<double> sigma_um(base.sigma_um.empty() ? 0 : time_s.size(), usual_sigma_um);
    // The data have nothing of the test's own columns.
    Eigen::MatrixXd before(factor.rows(), in_test->cols());
    before << factor.leftCols(model_width), Eigen::MatrixXd::Zero(factor.rows(), own.cols()),
        factor.rightCols(factor.cols() - model_width);
    const Eigen::MatrixXd together = both(before, *in_test, Whitening(noise, time_s, sigma_um));
    const Places places = places_of(candidates, own.cols());
    RatedTest rated;
    rated.test = std::move(test);
    for (std::size_t k = 0; k < question.pairs.size(); ++k) {
      const Pair& pair = question.pairs[k];
      const Orders orders = orders_of(together, places, pair);
      const Holds held = holds(orders, question, pair);
      const double d = separation(orders, held);
      if (d >= kIdentifiable) ++rated.settled;
      if (!(d < rated.smallest)) continue;
      rated.smallest = d;
      rated.so_far = separation(so_far[k], held);
      rated.hardest = k;
      rated.holds = held;
    }
    if (std::isfinite(rated.smallest)) tests.push_back(std::move(rated));
  }
  std::stable_sort(tests.begin(), tests.end(), better);
  for (const RatedTest& rated : tests) {
    std::string text = text_of(question, rated);
    if (result.empty() && rated.smallest < kUseless) {
      text = fmt::format("No known test would distinguish all of them: the best ({}) reaches {}, and 5 is needed.",
                         rated.test.name, d_text(rated.smallest));
    } else if (result.empty() && rated.smallest < kDetectable) {
      text = "No known test distinguishes all of them (d of 5 or more). This is the best one. " + text;
    }
    result.push_back({rated.test.name, std::move(text), rated.smallest, rated.test.duration_s, rated.so_far});
  }
  return result;
}

}  // namespace ballbar
