#include "verdict_of.hpp"
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <cstdio>
#include <cstdlib>
#include "diagnosis/posterior/search.hpp"
namespace ballbar::verdicts {
std::string_view name_of(Word word) {
  constexpr std::array<std::string_view, 7> kWords{"named",       "probable",   "driver", "equivalent",
                                                   "unexplained", "untestable", "nothing"};
  return kWords[static_cast<std::size_t>(word)];
}
Said verdict_of(const Made& made) {
  ProblemOptions options; options.catalogue = built_in_catalogue(); options.signatures.without = made.without;
  const auto start = std::chrono::steady_clock::now();
  auto problem = problem_of(made.model, made.data, 0, options);
  const auto mid = std::chrono::steady_clock::now();
  const Posterior post = posterior_of(*problem, 3);
  Said said;
  said.took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::map<std::size_t,double> pf; std::map<std::string,double> pc; double pdisc=0, pnone=0; std::vector<double> pown(problem->own.size(),0.0);
  for (const EffectSet& s : post.sets) { const double p = post.p(s); if (p < 1e-6) continue;
    pdisc += std::exp(s.log_weight_slow - post.log_total);
    if (s.families.empty() && s.own == 0) pnone += p - std::exp(s.log_weight_slow - post.log_total);
    if (s.own) pown[s.own-1] += p;
    std::map<std::string,int> cols; for (auto f : s.families) { pf[f] += p; for (auto& c : problem->library.families[f].bound.columns) cols[c]++; }
    for (auto& [c, k] : cols) pc[c] += p; }
  said.p_nothing = pnone; said.p_discrepancy = pdisc;
  for (auto& [f, p] : pf) if (p > 0.01) { const auto& b = problem->library.families[f].bound; said.effects.push_back({b.effect->name, b.columns, p}); }
  for (auto& [c, p] : pc) if (p > 0.5) said.drivers.push_back({c, p});
  for (std::size_t k = 0; k < pown.size(); ++k) if (pown[k] > 0.05) { const auto& o = problem->own[k]; 
     double fitted = 0; for (auto& v : post.variants) if (v.own == k+1) fitted = v.parameters[o.parameter];
     said.own.push_back({label_of(made.model.terms[problem->base_model->term_of(o.parameter)]), problem->base_model->parameter(o.parameter).name, o.held, fitted, pown[k]}); }
  for (auto& m : said.effects) if (m.p >= 0.9 && pdisc < 0.5 && !find_effect(m.effect, Level::series)->time_only) said.named.push_back(m);
  for (auto& m : said.effects) if (m.p >= 0.8 && m.p < 0.9) said.probable.push_back(m);
  bool own = false; for (auto& o : said.own) own = own || o.p >= 0.9;
  if (pnone > 0.01) { said.named.clear(); said.drivers.clear(); said.probable.clear(); own = false; }
  if (!said.named.empty() || own) said.word = Word::named;
  else if (pnone > 0.01) said.word = Word::nothing;
  else if (!said.probable.empty()) said.word = Word::probable;
  else if (!said.drivers.empty() && said.drivers[0].p > 0.9) said.word = Word::driver;
  else if (pdisc > 0.5) said.word = Word::unexplained; else said.word = Word::equivalent;
  if (getenv("V")) { std::fprintf(stderr, "points %zu variants %zu pool %ld sig %ld n %ld fit %.3f", post.points.size(), post.variants.size(), (long)post.variants[0].pool.cols(), (long)problem->signatures.cols(), (long)problem->y.size(), std::chrono::duration<double>(mid-start).count());
    std::fprintf(stderr, " none %.3g disc %.3g\n", pnone, pdisc);
    for (std::size_t k = 0; k < std::min<std::size_t>(6, post.sets.size()); ++k) { auto& s = post.sets[k]; std::fprintf(stderr, "   %.3f lw %.1f own %zu var %zu", post.p(s), s.log_weight, s.own, s.variant);
      for (std::size_t i = 0; i < s.families.size(); ++i) { std::fprintf(stderr, " %s", label_of(problem->library.families[s.families[i]].bound).c_str()); for (double x : problem->library.signatures[s.signatures[i]].point) std::fprintf(stderr, " %.3g", x); } 
      auto& c = post.points[s.point].covariance; std::fprintf(stderr, " | w %.2g c %.2g t %.3g slow %.2g %.3g\n", c.white, c.correlated, c.time_s, c.slow, c.slow_time_s); } }
  return said;
}
}  // namespace ballbar::verdicts
