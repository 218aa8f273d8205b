#include "history/series_judgement.hpp"

#include <algorithm>
#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "ballbar/history/history.hpp"
#include "history/robust_fit.hpp"
#include "numerics/tails.hpp"

namespace ballbar {
namespace {

constexpr double kSpanOfSeason_s = 1.5 * kYear_s;
constexpr std::size_t kFewestOfSeason = 8;
// For quantities on few machines. With fewer values hardly anything is found, and each additional test enlarges the
// correction of the others. Chosen on sample-runs/machine-history and the fleets of tests/study/fleet.
constexpr std::size_t kFewestOfTrendAlone = 5, kFewestOfStepAlone = 8;
constexpr std::size_t kFewestOfStep = 5;  // values; two on either side
constexpr double kLongRun = 8.0;          // tests: as long as scatter may stay the same
constexpr double kMayBe = 0.1;
constexpr std::size_t kReach = 20;  // places to either side that are fitted
constexpr double kClear = 0.01;     // p of the best curve, from which on the others are judged together with it

struct StepSearch {
  StepPlace place;
  double p_value = 1.0;
};

// Of the difference of both sides' mean scores at one place, each clipped at kShortRunClip, on either side: where one
// side is short by what such means were, else by Student's t.
class StepScores {
 public:
  StepScores(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family)
      : sums_{0.0}, degrees_(degrees), family_(family) {
    for (const double z : scores) sums_.push_back(sums_.back() + clipped(z, kShortRunClip));
  }

  double p_value(std::size_t k) const {
    const std::size_t n = sums_.size() - 1;
    const std::size_t fewer = std::min(k, n - k);
    const auto before = static_cast<double>(k), after = static_cast<double>(n - k);
    const auto variance_of_mean = [&](double j) { return family_.memory(j) / j; };
    const double difference = (sums_[n] - sums_[k]) / after - sums_[k] / before;
    const double variance = variance_of_mean(before) + variance_of_mean(after);
    const double by_student = student_tails(difference / std::sqrt(family_.variance_of_score * variance), degrees_);
    if (fewer > kLongestShortRun) return by_student;
    const double of_fewer = variance_of_mean(static_cast<double>(fewer));
    const double as_if_rest_known = difference * std::sqrt(of_fewer / variance);
    return std::max(family_.chance_of_mean(fewer, as_if_rest_known), by_student);
  }

 private:
  std::vector<double> sums_;
  double degrees_;
  const FamilyScatter& family_;
};

// The position of a step, and its p-value over all positions.
StepSearch step_search(const Eigen::VectorXd& scores, double degrees, const FamilyScatter& family) {
  constexpr double kAboutAsLikely = 20.0;  // e^3
  const auto n = static_cast<std::size_t>(scores.size());
  StepSearch search;
  if (n < kFewestOfStep) return search;
  const StepScores at(scores, degrees, family);
  std::vector<double> p(n, 1.0);
  for (std::size_t k = 2; k + 2 <= n; ++k) p[k] = at.p_value(k);
  const auto least = static_cast<std::size_t>(std::min_element(p.begin(), p.end()) - p.begin());
  search.place = {least, least, least};
  while (search.place.earliest > 2 && p[search.place.earliest - 1] < kAboutAsLikely * p[least]) --search.place.earliest;
  while (search.place.latest + 2 < n && p[search.place.latest + 1] < kAboutAsLikely * p[least]) ++search.place.latest;
  search.p_value = std::min(1.0, static_cast<double>(n - 3) * p[least]);
  return search;
}

class SeriesJudge {
 public:
  SeriesJudge(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family)
      : series_(series),
        degrees_(scatter.degrees),
        of_machines_(scatter.of_machines),
        family_(family),
        scatter_(scatters_of(series, scatter.s)),
        line_(trend_columns(series.time_s)),
        level_(fit(line_.leftCols(1))) {}

  SeriesJudgement judgement() {
    const std::size_t n = series_.value.size();
    const double log_n = std::log(static_cast<double>(n));
    const double span_s = series_.time_s.back() - series_.time_s.front();
    if (span_s < kSpanOfTrend_s) return found_;
    const FitColumns level = line_.leftCols(1);
    loss_ = level_.loss;
    found_.p_trend = drop(FindingKind::trend, level, line_.rightCols(1), level_.loss, log_n);
    if (!of_machines_) found_.p_trend = p_by_sigmas(n);
    if (span_s >= kSpanOfSeason_s && n >= kFewestOfSeason) {
      found_.p_season = drop(FindingKind::season, level, season_columns(series_.time_s), level_.loss, 2.0 * log_n);
    }
    if (n >= (of_machines_ ? kFewestOfStep : kFewestOfStepAlone)) judge_step(level, level_, log_n);
    judge_bar(level, log_n);
    if (found_.best) judge_with_best();
    return found_;
  }

 private:
  RobustFit fit(const FitColumns& columns) const { return robust_fit(columns, series_.value, scatter_); }

  // Of as long a stretch as tells the curve.
  double memory(FindingKind kind) const {
    const auto n = static_cast<double>(series_.value.size());
    if (kind != FindingKind::season) return family_.memory_beyond(std::max(kLongRun, n / 4.0));
    const double span_years = (series_.time_s.back() - series_.time_s.front()) / kYear_s;
    return family_.memory(n / (3.0 * span_years));
  }

  double p_of(double drop, Eigen::Index columns, FindingKind kind) const {
    return fisher_upper_tail(drop / (static_cast<double>(columns) * memory(kind)), static_cast<std::size_t>(columns),
                             degrees_);
  }

  // By the line of trend_of, its rate with the memory of the scatter.
  std::optional<double> p_by_sigmas(std::size_t n) const {
    const std::optional<Trend> trend = n < kFewestOfTrendAlone ? std::nullopt : trend_since(series_, 0);
    if (!trend) return std::nullopt;
    const double sigmas2 = std::pow(boost::math::erfc_inv(std::max(trend->p_value, 1e-300)), 2);
    return std::erfc(std::sqrt(sigmas2 / family_.memory_beyond(static_cast<double>(n) / 4.0)));
  }

  double drop(FindingKind kind, const FitColumns& base, const FitColumns& extra, double base_loss, double penalty) {
    const double loss = fit(joined(base, extra)).loss;
    note(kind, loss, penalty);
    return p_of(base_loss - loss, extra.cols(), kind);
  }

  void note(FindingKind kind, double loss, double penalty) {
    if (loss + penalty >= loss_) return;
    loss_ = loss + penalty;
    found_.best = kind;
  }

  // The place of the search, or, where there may be a step, one about as likely that leaves less.
  void judge_step(const FitColumns& base, const RobustFit& base_fit, double log_n) {
    const StepSearch search = step_search(base_fit.scores, degrees_, family_);
    found_.p_step = search.p_value;
    found_.step = search.place;
    const std::size_t reach = search.p_value < kMayBe ? kReach : 0;
    const std::size_t first = std::max(search.place.earliest, search.place.at - std::min(search.place.at, reach));
    const std::size_t last = std::min(search.place.latest, search.place.at + reach);
    double least = base_fit.loss;
    for (std::size_t k = first; k <= last; ++k) {
      const double loss = fit(joined(base, step_column(series_.value.size(), k))).loss;
      if (loss >= least) continue;
      least = loss;
      found_.step.at = k;
    }
    note(FindingKind::step, least, 2.0 * log_n);
  }

  FitColumns columns_of(FindingKind kind) const {
    if (kind == FindingKind::trend) return line_.rightCols(1);
    if (kind == FindingKind::season) return season_columns(series_.time_s);
    return step_column(series_.value.size(), kind == FindingKind::step ? found_.step.at : found_.bar_at);
  }

  std::optional<double>& p_value(FindingKind kind) {
    return kind == FindingKind::trend    ? found_.p_trend
           : kind == FindingKind::season ? found_.p_season
           : kind == FindingKind::step   ? found_.p_step
                                         : found_.p_bar;
  }

  void judge_with_best() {
    const FindingKind best = *found_.best;
    if (!(p_value(best).value_or(1.0) < kClear)) return;
    const FitColumns base = joined(line_.leftCols(1), columns_of(best));
    const RobustFit base_fit = fit(base);
    for (const FindingKind kind :
         {FindingKind::trend, FindingKind::season, FindingKind::instrument, FindingKind::step}) {
      std::optional<double>& p = p_value(kind);
      if (kind == best || !p) continue;
      if (kind == FindingKind::step) {
        const StepSearch search = step_search(base_fit.scores, degrees_, family_);
        p = std::max(*p, search.p_value);
        found_.step = search.place;
        continue;
      }
      const FitColumns extra = columns_of(kind);
      p = std::max(*p, p_of(base_fit.loss - fit(joined(base, extra)).loss, extra.cols(), kind));
    }
  }

  // At the exchange with the longest stretches on either side.
  void judge_bar(const FitColumns& base, double log_n) {
    const std::vector<std::string_view>& bar = series_.bar;
    const std::size_t n = bar.size();
    if (!is_scale(series_.name) || n < kFewestOfStep) return;
    std::size_t longest = 1;
    for (std::size_t k = 1; k < n; ++k) {
      if (bar[k] == bar[k - 1]) continue;
      std::size_t before = k, after = k;
      while (before > 0 && bar[before - 1] == bar[k - 1]) --before;
      while (after < n && bar[after] == bar[k]) ++after;
      const std::size_t shorter = std::min(k - before, after - k);
      if (shorter <= longest || k < 2 || k + 2 > n) continue;
      longest = shorter;
      found_.bar_at = k;
    }
    if (longest < 2) return;
    found_.p_bar = StepScores(level_.scores, degrees_, family_).p_value(found_.bar_at);
    note(FindingKind::instrument, fit(joined(base, columns_of(FindingKind::instrument))).loss, log_n);
  }

  const QuantitySeries& series_;
  double degrees_;
  bool of_machines_;
  const FamilyScatter& family_;
  std::vector<double> scatter_;
  FitColumns line_;
  RobustFit level_;
  double loss_ = 0.0;
  SeriesJudgement found_;
};

}  // namespace

std::optional<Trend> trend_since(const QuantitySeries& series, std::size_t first) {
  std::vector<DatedValue> values;
  values.reserve(series.value.size() - first);
  for (std::size_t i = first; i < series.value.size(); ++i) {
    values.push_back({series.time_s[i], series.value[i], series.sigma[i]});
  }
  return trend_of(values);
}

bool is_global_scale(std::string_view name) { return name == "global_scale"; }

bool is_scale(std::string_view name) {
  return is_global_scale(name) || name == scale_name(0) || name == scale_name(1) || name == scale_name(2);
}

SeriesJudgement judgement_of(const QuantitySeries& series, const SeriesScatter& scatter, const FamilyScatter& family) {
  if (series.value.size() < kTestsOfTrend || scatter.s <= 0.0) return {};
  return SeriesJudge(series, scatter, family).judgement();
}

}  // namespace ballbar
