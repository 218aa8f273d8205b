#include "model/preflight.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/preflight_result.hpp"
#include "model/testability_text.hpp"
#include "terminal/caller.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kTargetsShown = 6;
constexpr std::size_t kListWidth = 19;
constexpr std::string_view kDetails = "which effects are confused with which, and what these data cannot test";

// "0.13": two decimals, more where that would leave nothing; a metre is never seen.
std::string um_text(double value_um) {
  if (value_um > 1e6) return "> 1e6";
  return value_um < 0.095 ? fmt::format("{:.2g}", value_um) : fmt::format("{:.2f}", value_um);
}

std::string columns_text(const Detectability& detectable) {
  if (detectable.columns.empty()) return "time";
  const std::string more = detectable.bindings > 1 ? fmt::format(" (1 of {})", detectable.bindings) : "";
  return one_line(fmt::format("{}", fmt::join(detectable.columns, ", "))) + more;
}

// Numbers of the rows of the table; names of effects that are not in it.
std::string inseparable_text(const Detectability& detectable, const std::vector<const Detectability*>& rows) {
  std::vector<std::string> texts;
  for (const std::string& name : detectable.inseparable_from) {
    const auto same = [&](const Detectability* row) { return row->effect->name == name; };
    const auto row = std::find_if(rows.begin(), rows.end(), same);
    texts.push_back(row == rows.end() ? name : fmt::format("{}", row - rows.begin() + 1));
  }
  return texts.empty() ? "-" : fmt::format("{}", fmt::join(texts, ", "));
}

std::string inseparable_count(const Detectability& detectable) {
  const std::size_t count = detectable.inseparable_from.size();
  if (count == 0) return "-";
  return count == 1 ? detectable.inseparable_from.front() : fmt::format("{} effects", count);
}

void print_untestable(const Preflight& result) {
  const auto reasons =
      by_reason(result.detectability, [](Testability testability) { return testability != Testability::testable; });
  if (!reasons.empty()) fmt::print("Not testable:\n");
  for (const auto& [first, effects] : reasons) {
    fmt::print("{}", wrapped(fmt::format("- {}: {}", text_of(reason_of(*first)), fmt::join(effects, ", "))));
  }
}

void print_text(const Preflight& result, const std::string& title, bool details) {
  std::vector<const Detectability*> rows;
  std::size_t separable = 0;
  for (const Detectability& detectable : result.detectability) {
    if (detectable.testability != Testability::testable) continue;
    rows.push_back(&detectable);
    if (detectable.inseparable_from.empty()) ++separable;
  }
  fmt::print(
      "{}\n{}, {} values\n\nThese data can show {} of {} effects. {} of them can be distinguished from all others.\n\n",
      title, result.target, result.n, rows.size(), result.detectability.size(), separable);
  Table table({"effect", "columns", "visible um", "named um", "own %", "confused with"});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    table.add_wrapped(
        {fmt::format("{:2} {}", i + 1, rows[i]->effect->name), columns_text(*rows[i]), um_text(rows[i]->detectable_um),
         um_text(rows[i]->identifiable_um), fmt::format("{:.0f}", 100.0 * rows[i]->surviving_share),
         details ? inseparable_text(*rows[i], rows) : inseparable_count(*rows[i])},
        kListWidth);
  }
  if (!rows.empty()) fmt::print("{}\n", table.text(table_width()));
  if (details) {
    print_untestable(result);
    fmt::print("\n");
  }
  fmt::print("{}",
             wrapped(fmt::format(
                 "visible, named: from this range (max - min) on the effect shows, and can be named. own: share of it "
                 "that the model cannot produce already. Noise from: {}.",
                 text_of(result.noise_source))));
  if (!details) fmt::print("\n{}", details_text(kDetails));
}

// Effects by targets: the smallest that could be named.
void print_targets(const std::vector<Preflight>& results, const std::string& title, bool details) {
  std::vector<std::string> heading{"named um"};
  const std::size_t shown = std::min(results.size(), kTargetsShown);
  for (std::size_t i = 0; i < shown; ++i) heading.push_back(results[i].target);
  Table table(heading);
  for (std::size_t k = 0; k < results.front().detectability.size(); ++k) {
    std::vector<std::string> row{results.front().detectability[k].effect->name};
    for (std::size_t i = 0; i < shown; ++i) {
      const Detectability& detectable = results[i].detectability[k];
      row.push_back(detectable.testability == Testability::testable ? um_text(detectable.identifiable_um) : "-");
    }
    if (std::any_of(row.begin() + 1, row.end(), [](const std::string& text) { return text != "-"; })) table.add(row);
  }
  fmt::print("{}\n{} targets{}\n\n{}\n", title, results.size(),
             shown < results.size() ? fmt::format(", the first {} shown", shown) : "", table.text(table_width()));
  if (details) {
    print_untestable(results.front());
    fmt::print("\n");
  }
  fmt::print("{}", wrapped(fmt::format("named: from this range (max - min) on an effect can be named. Noise from: {}. "
                                       "--target {} shows one target in full.",
                                       text_of(results.front().noise_source), results.front().target)));
  if (!details) fmt::print("\n{}", details_text(kDetails));
}

}  // namespace

std::string_view text_of(NoiseSource source) {
  return source == NoiseSource::residual ? "residual of the model"
                                         : "target about its mean: every effect that is there counts as noise";
}

void show_preflight(const ModelOptions& options, const Model& model, const ModelData& data, bool json, bool details) {
  std::vector<Preflight> results;
  const ProgressLine progress;
  for (std::size_t target = 0; target < model.targets.size(); ++target) {
    const Model one = of_one_target(model, options, *data.series, target);
    expect_to_fit(options, one, data);
    show_progress(fmt::format("{}, target {} of {}", model.targets[target], target + 1, model.targets.size()));
    results.push_back(with_source(options.data.front().name(),
                                  [&] { return preflight(one, *data.series, 0, data.motion, options.catalogue); }));
  }
  show_progress({});
  if (json) {
    print_json(results.size() == 1 ? json_of(results.front()) : json_of(Targets<Preflight>{results}));
  } else if (results.size() == 1) {
    print_text(results.front(), data.title, details);
  } else {
    print_targets(results, data.title, details);
  }
}

}  // namespace ballbar
