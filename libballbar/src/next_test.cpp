#include "ballbar/next_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "candidate_rows.hpp"
#include "condensed.hpp"
#include "evidence.hpp"
#include "planned_test.hpp"
#include "separation.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kMostRows = 1500;  // as the diagnosis
constexpr double kSeen = 5.0;
constexpr double kNamed = 7.5;

// Indices of CandidateRows::rivals; `others`: of the rest of the best set, fitted beside them.
struct Pair {
  std::size_t a = 0, b = 0;
  std::vector<std::size_t> others;
};

struct Question {
  CandidateRows candidates;
  std::vector<Pair> pairs;
};

bool in(const std::vector<BoundEffect>& group, const BoundEffect& bound) {
  return std::find(group.begin(), group.end(), bound) != group.end();
}

// Groups of which one is it: those of the diagnosis that a test could settle, else the strongest two.
std::vector<std::vector<BoundEffect>> open_groups(const Diagnosis& diagnosis) {
  std::vector<std::vector<BoundEffect>> groups;
  for (const std::vector<BoundEffect>& group : diagnosis.equivalent) {
    const bool again = group.size() == 1 && group.front().effect != nullptr && group.front().effect->time_only;
    if (group.size() > 1 || again) groups.push_back(group);
  }
  if (!groups.empty()) return groups;
  std::vector<const Candidate*> strongest;
  for (const Candidate& candidate : diagnosis.candidates) {
    if (!in(diagnosis.named, candidate.bound)) strongest.push_back(&candidate);
  }
  std::stable_sort(strongest.begin(), strongest.end(),
                   [](const Candidate* a, const Candidate* b) { return a->evidence > b->evidence; });
  if (strongest.size() > 1) groups.push_back({strongest[0]->bound, strongest[1]->bound});
  return groups;
}

Question question_of(const Model& model, const Series& data, const Diagnosis& diagnosis) {
  Question question{{&model, &data, &diagnosis.base, {}}, {}};
  std::vector<Rival>& rivals = question.candidates.rivals;
  std::vector<std::size_t> best_set;
  for (const Candidate& candidate : diagnosis.candidates) {
    std::optional<Rival> rival = rival_of(candidate, data);
    if (!rival) continue;
    if (candidate.in_best_set) best_set.push_back(rivals.size());
    rivals.push_back(std::move(*rival));
  }
  const std::size_t known = rivals.size();
  for (const std::vector<BoundEffect>& group : open_groups(diagnosis)) {
    std::vector<std::size_t> members, others;
    for (std::size_t k = 0; k < known; ++k) {
      if (in(group, rivals[k].bound)) members.push_back(k);
    }
    for (const std::size_t k : best_set) {
      if (!in(group, rivals[k].bound)) others.push_back(k);
    }
    if (group.size() == 1 && members.size() == 1) {
      Rival once = rivals[members[0]];
      once.only_once = true;
      members.push_back(rivals.size());
      rivals.push_back(std::move(once));
    }
    for (std::size_t i = 0; i < members.size(); ++i) {
      for (std::size_t j = i + 1; j < members.size(); ++j) question.pairs.push_back({members[i], members[j], others});
    }
  }
  return question;
}

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

// Of the fit with the best set: the noise of the base fit holds what is missing in it.
Noise noise_with_best_set(const CandidateRows& candidates, const Diagnosis& diagnosis, const Eigen::MatrixXd& columns,
                          const Places& places) {
  std::vector<Eigen::Index> added;
  for (const Candidate& candidate : diagnosis.candidates) {
    for (std::size_t k = 0; candidate.in_best_set && k < candidates.rivals.size(); ++k) {
      const Rival& rival = candidates.rivals[k];
      if (rival.only_once || !(rival.bound == candidate.bound)) continue;
      added.insert(added.end(), places.free[k].begin(), places.free[k].end());
    }
  }
  Eigen::MatrixXd best = columns(Eigen::all, added);
  for (Eigen::Index k = 0; k < best.cols(); ++k) {
    if (best.col(k).norm() > 0.0) best.col(k).normalize();
  }
  return explained(leftover_of(diagnosis.base), best, diagnosis.base.noise).noise;
}

// The smaller of both orders.
double separation(const Eigen::MatrixXd& factor, const Places& places, const Pair& pair) {
  const auto one_way = [&](std::size_t truth, std::size_t rival) {
    std::vector<Eigen::Index> columns = places.shared;
    columns.insert(columns.end(), places.free[rival].begin(), places.free[rival].end());
    for (const std::size_t other : pair.others) {
      columns.insert(columns.end(), places.free[other].begin(), places.free[other].end());
    }
    return distance(factor, places.signal[truth], columns);
  };
  return std::min(one_way(pair.a, pair.b), one_way(pair.b, pair.a));
}

// Columns of the pair that the list has.
std::vector<std::size_t> listed(const std::vector<std::string>& list, const Question& question, const Pair& pair) {
  std::vector<std::size_t> result;
  for (std::size_t k = 0; k < list.size(); ++k) {
    for (const std::size_t rival : {pair.a, pair.b}) {
      const std::vector<std::string>& columns = question.candidates.rivals[rival].bound.columns;
      if (std::find(columns.begin(), columns.end(), list[k]) == columns.end()) continue;
      if (result.empty() || result.back() != k) result.push_back(k);
    }
  }
  return result;
}

std::string d_text(double d) {
  if (d > 1000.0) return "d above 1000";
  return d >= 99.95 ? fmt::format("d = {:.0f}", d) : fmt::format("d = {:.1f}", d);
}

std::string interval_text(const Series& all, const std::string& target) {
  std::vector<double> gaps_s;
  double last_s = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double>& values = find_column(all, target)->values;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::isnan(values[row])) continue;
    if (!std::isnan(last_s)) gaps_s.push_back(all.time_s[row] - last_s);
    last_s = all.time_s[row];
  }
  if (gaps_s.empty()) return {};
  const auto middle = gaps_s.begin() + static_cast<std::ptrdiff_t>(gaps_s.size() / 2);
  std::nth_element(gaps_s.begin(), middle, gaps_s.end());
  const std::string every =
      *middle < 600.0 ? fmt::format("{:.3g} s", *middle) : fmt::format("{:.3g} min", *middle / 60.0);
  return fmt::format(", readings every {} as now", every);
}

struct Judged {
  PlannedTest test;
  std::vector<double> separations;  // one a pair
  double smallest = 0.0;
  std::size_t hardest = 0;  // pair
};

std::string pair_text(const Question& question, const Pair& pair) {
  const Rival &a = question.candidates.rivals[pair.a], &b = question.candidates.rivals[pair.b];
  if (b.only_once) return fmt::format("show whether {} comes again", label_of(a.bound));
  return fmt::format("tell {} from {}", label_of(a.bound), label_of(b.bound));
}

std::string text_of(const Question& question, const Judged& judged, double so_far, const std::string& interval) {
  std::string text = judged.test.name + ": " + judged.test.doing + interval + ".";
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  const Pair& hardest = question.pairs[judged.hardest];
  const std::string outcome =
      fmt::format("{} ({}); the data so far have {}.", d_text(judged.smallest),
                  judged.smallest < kSeen ? "5 is needed, 7.5 to name one" : "named from 7.5", d_text(so_far));
  if (question.pairs.size() == 1) {
    text += fmt::format(" It would {} with {}", pair_text(question, hardest), outcome);
  } else {
    text += fmt::format(" It would settle {} pairs of candidates; hardest to {}, with {}", question.pairs.size(),
                        pair_text(question, hardest), outcome);
  }
  std::vector<std::string> predicted, unknown;
  for (const std::size_t k : listed(judged.test.forecast_columns, question, hardest)) {
    predicted.push_back(judged.test.forecast[k]);
  }
  for (const std::size_t k : listed(judged.test.unknown, question, hardest)) unknown.push_back(judged.test.unknown[k]);
  if (!predicted.empty()) text += fmt::format(" Predicted as in the data: {}.", fmt::join(predicted, ", "));
  if (!unknown.empty()) {
    text += fmt::format(" What {} would do in it is not known, so that nothing is promised.", fmt::join(unknown, ", "));
  }
  return text;
}

}  // namespace

std::vector<NextTest> next_tests(const Model& model, const Series& all, const Diagnosis& diagnosis) {
  std::vector<NextTest> result;
  if (diagnosis.verdict == Verdict::nothing || find_column(all, diagnosis.target) == nullptr) return result;
  const Series data = condensed(all, diagnosis.target, kMostRows);
  if (!suits(model, data, diagnosis)) return result;
  const Question question = question_of(model, data, diagnosis);
  if (question.pairs.empty()) return result;

  const CandidateRows& candidates = question.candidates;
  const Fit& base = diagnosis.base;
  const Places without_own = places_of(candidates, 0);
  const std::optional<Eigen::MatrixXd> in_data = columns_in_data(candidates, 0);
  if (!in_data) return result;
  const Noise noise = noise_with_best_set(candidates, diagnosis, *in_data, without_own);
  const Eigen::MatrixXd factor = whitened_factor(*in_data, Whitening(noise, base.time_s, base.sigma_um));
  std::vector<double> so_far;
  for (const Pair& pair : question.pairs) so_far.push_back(separation(factor, without_own, pair));
  const auto model_width = static_cast<Eigen::Index>(without_own.shared.size());

  std::vector<double> sigma = base.sigma_um;
  std::sort(sigma.begin(), sigma.end());
  std::vector<Judged> tests;
  for (PlannedTest& test : model.level == Level::series ? drift_tests(data, diagnosis.target, base.row)
                                                        : recording_tests(data, diagnosis.target, base.row)) {
    if (test.rows.size() < 2) continue;
    const Eigen::MatrixXd own = own_columns(candidates, test);
    const std::optional<Eigen::MatrixXd> in_test = columns_in_test(candidates, test, own);
    if (!in_test) continue;
    std::vector<double> time_s;
    for (const std::size_t row : test.rows) time_s.push_back(test.inputs.time_s[row]);
    const std::vector<double> sigma_um(sigma.empty() ? 0 : time_s.size(),
                                       sigma.empty() ? 0.0 : sigma[sigma.size() / 2]);
    // The data have nothing of the test's own columns.
    Eigen::MatrixXd before(factor.rows(), in_test->cols());
    before << factor.leftCols(model_width), Eigen::MatrixXd::Zero(factor.rows(), own.cols()),
        factor.rightCols(factor.cols() - model_width);
    const Eigen::MatrixXd together = both(before, whitened_factor(*in_test, Whitening(noise, time_s, sigma_um)));
    const Places places = places_of(candidates, own.cols());
    Judged judged{std::move(test), {}, std::numeric_limits<double>::infinity(), 0};
    for (std::size_t k = 0; k < question.pairs.size(); ++k) {
      const Pair& pair = question.pairs[k];
      const bool known = listed(judged.test.unknown, question, pair).empty();
      const double d = known ? separation(together, places, pair) : so_far[k];
      if (!std::isfinite(d)) continue;
      judged.separations.push_back(d);
      if (d < judged.smallest) {
        judged.smallest = d;
        judged.hardest = k;
      }
    }
    if (!judged.separations.empty()) tests.push_back(std::move(judged));
  }
  std::stable_sort(tests.begin(), tests.end(),
                   [](const Judged& a, const Judged& b) { return a.smallest > b.smallest; });
  const std::string interval = model.level == Level::series ? interval_text(all, diagnosis.target) : std::string();
  for (const Judged& judged : tests) {
    const double now = so_far[judged.hardest];
    std::string text = text_of(question, judged, now, interval);
    if (result.empty() && judged.smallest < kSeen) {
      text = "No test on the list tells them apart (d of 5 or more); the best is this. " + text;
    }
    result.push_back({judged.test.name, std::move(text), judged.smallest, judged.test.duration_s, now});
  }
  return result;
}

}  // namespace ballbar
