#include "diagnose/grown.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "ballbar/predict/train.hpp"
#include "diagnose/effect_test_text.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr double kKnownDriver = 0.9;  // P

std::string known(double value) { return std::isfinite(value) ? fixed(value, 2) : "-"; }

bool is_driven(const Term& term, const std::vector<Driver>& drivers) {
  return std::all_of(term.columns.begin(), term.columns.end(), [&](const std::string& column) {
    return std::any_of(drivers.begin(), drivers.end(),
                       [&](const Driver& driver) { return driver.column == column && driver.p >= kKnownDriver; });
  });
}

// "+ A and 3 more"
std::string joined_text(const GrownRevision& revision) {
  const std::size_t more = revision.joined.size() - 1;
  return fmt::format("+ {}{}", revision.joined.front(), more > 0 ? fmt::format(" and {} more", more) : "");
}

LedgerRow row_of(const GrownRevision& revision, const GrowthErrors& errors, const LedgerRow& before,
                 const std::vector<Driver>& drivers) {
  LedgerRow row = before;
  row.change = joined_text(revision);
  row.parameters = before.parameters + errors.effects;
  row.rmse_um = errors.rmse_um;
  row.times_floor = before.times_floor * errors.rmse_um / before.rmse_um;
  row.held_out_um = LedgerRow::kUnknown;
  row.forecast_um = errors.forecast_um;
  const auto first = revision.terms.end() - static_cast<std::ptrdiff_t>(revision.joined.size());
  const bool is_known =
      std::all_of(first, revision.terms.end(), [&](const Term& term) { return is_driven(term, drivers); });
  row.verdict = is_known ? "driver known" : "empirical";
  return row;
}

std::string_view stop_text(GrowthStop stop) {
  switch (stop) {
    case GrowthStop::as_good_as_all:
      return "Further effects would lower the error of the forecasts by less than 5 %.";
    case GrowthStop::best_forecast:
      return "Further effects do not predict better.";
    default:
      return "All numbers of effects up to 40 were tried.";
  }
}

}  // namespace

GrownModel grown_model(const std::string& bytes, const std::string& file, const Model& model, const ModelData& data,
                       const std::vector<std::string>& data_names, const std::vector<Driver>& drivers,
                       const Catalogue& catalogue) {
  GrownModel grown;
  grown.bytes = bytes;
  const auto progress = [](const std::string& what) { show_progress(what); };
  with_source(data_names.front(), [&] {
    grown.growth = growth(model, *data.series, 0, progress);
    if (const auto all = predictability(model, *data.series, progress)) grown.train = all->forecasts;
    return 0;
  });
  show_progress("the model's row of the ledger");
  grown.before = row_of(model, *data.series);
  grown.before.data = data_names;
  grown.before.forecast_um = grown.growth.errors.front().forecast_um;
  std::size_t before = 0;  // effects
  for (std::size_t r = 0; r < grown.growth.revisions.size(); ++r) {
    const GrownRevision& revision = grown.growth.revisions[r];
    LedgerRow row = row_of(revision, grown.growth.errors[r + 1], grown.before, drivers);
    const std::size_t in_file = read_model(grown.bytes, file, catalogue).terms.size();
    std::vector<std::size_t> removed;  // the same with the gains that they had
    for (std::size_t j = 0; j < before; ++j) removed.push_back(in_file - before + j);
    grown.bytes = with_revision(grown.bytes, file, revision.terms, removed, grown.before, row, catalogue);
    row.revision = read_ledger(grown.bytes, file, catalogue).size() - 1;
    grown.rows.push_back(std::move(row));
    before = revision.terms.size();
  }
  return grown;
}

std::string conclusion(const GrownModel& grown, const std::vector<std::string>& causes,
                       const std::vector<Driver>& drivers) {
  if (grown.growth.stop == GrowthStop::untested) {
    return "No effect is added: too few rows to test whether any would predict new ones.";
  }
  if (grown.rows.empty()) return "No effect is added: none predicts new rows better than the model.";
  const GrowthErrors &first = grown.growth.errors.front(), &last = grown.growth.errors[grown.rows.size()];
  std::string text = fmt::format(
      "The model with {} more effect{} predicts new rows with an RMSE of {:.2f} um, the model before with "
      "{:.2f} um. ",
      last.effects, last.effects == 1 ? "" : "s", last.forecast_um, first.forecast_um);
  if (grown.train)
    text += fmt::format("`ballbar train`, with all effects and the slow drift that remains, reaches {:.2f} um. ",
                        grown.train->rmse_um);
  std::vector<std::string> known_drivers;
  for (const Driver& driver : drivers) {
    if (driver.p >= kKnownDriver) known_drivers.push_back(driver.column);
  }
  if (!causes.empty()) {
    text += fmt::format("Named causes in the model: {}. ", fmt::join(causes, ", "));
  } else if (!known_drivers.empty()) {
    text += fmt::format("{} {} the drift in an unknown form, so no effect is proven as its cause. ",
                        text_of(enumerated({known_drivers.begin(), known_drivers.end()})),
                        known_drivers.size() == 1 ? "drives" : "drive");
  } else {
    text += "None of them is a proven cause: they predict, they do not explain. ";
  }
  return text + std::string(stop_text(grown.growth.stop));
}

std::string tables(const GrownModel& grown, bool details) {
  if (grown.rows.empty()) return "";
  Table table({"revision", "effects", "RMSE um", "forecast um", "from train um", "cause"});
  const auto add = [&](const std::string& name, const GrowthErrors& errors, const std::string& what) {
    table.add({one_line(name), fmt::format("{}", errors.effects), known(errors.rmse_um), known(errors.forecast_um),
               known(errors.apart_um), what});
  };
  add("before", grown.growth.errors.front(), "the model");
  for (std::size_t k = 0; k < grown.rows.size(); ++k) {
    add(fmt::format("{} {}", grown.rows[k].revision, grown.rows[k].change), grown.growth.errors[k + 1],
        grown.rows[k].verdict);
  }
  if (!details) return table.text(table_width());
  return fmt::format(
      "{}{}", table.text(table_width()),
      wrapped(fmt::format(
          "forecast: RMSE of rows predicted from earlier rows alone, from {} origins; the growth is repeated "
          "each time. from train: RMS difference to the forecasts of a regression on all effects, which the "
          "few effects are to imitate; the RMSE of that regression is {:.2f} um. A falling RMSE is no evidence of a "
          "cause.",
          grown.growth.origins, grown.growth.all_um)));
}

std::vector<GrowthStep> steps_of(const GrownModel& grown) {
  std::vector<GrowthStep> steps;
  for (std::size_t k = 0; k < grown.growth.errors.size(); ++k) {
    GrowthStep step{{}, k <= grown.rows.size(), grown.growth.errors[k]};
    if (k > 0 && step.kept) step.added = grown.growth.revisions[k - 1].joined;
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace ballbar
