#include "diagnose/grown.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/formats/models/model_history.hpp"
#include "ballbar/formats/models/model_toml.hpp"
#include "terminal/progress.hpp"
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

LedgerRow row_of(const GrownEffect& effect, const GrowthErrors& errors, const LedgerRow& before, std::size_t count,
                 const std::vector<Driver>& drivers) {
  LedgerRow row = before;
  row.change = "+ " + effect.label;
  row.parameters = before.parameters + count;
  row.rmse_um = errors.rmse_um;
  row.times_floor = before.times_floor * errors.rmse_um / before.rmse_um;
  row.held_out_um = LedgerRow::kUnknown;
  row.likelihood_ratio = 2.0 * effect.log_bayes;
  row.forecast_um = errors.forecast_um;
  row.surrogate_forecast_um = errors.surrogate_forecast_um;
  row.discrepancy_um = errors.sigma_um;
  row.verdict = is_driven(effect.terms.back(), drivers) ? "driver known" : "empirical";
  return row;
}

std::string_view stop_text(GrowthStop stop) {
  switch (stop) {
    case GrowthStop::none_needed:
      return "It ends where no further effect is probable (P of none above 0.5).";
    case GrowthStop::as_good_as_surrogates:
      return "It ends where further effects predict new cycles no better than surrogates do.";
    default:
      return "It ends at 12 effects.";
  }
}

}  // namespace

GrownModel grown_model(const std::string& bytes, const std::string& file, const Model& model, const ModelData& data,
                       const std::vector<std::string>& data_names, const std::vector<Driver>& drivers) {
  GrownModel grown;
  grown.bytes = bytes;
  grown.growth = with_source(data_names.front(), [&] {
    return growth(model, *data.series, 0, [](const std::string& what) { show_progress(what); });
  });
  show_progress("the model's row of the ledger");
  grown.before = row_of(model, *data.series);
  grown.before.data = data_names;
  grown.before.forecast_um = grown.growth.errors.front().forecast_um;
  for (std::size_t k = 0; k < grown.growth.effects.size(); ++k) {
    const GrownEffect& effect = grown.growth.effects[k];
    LedgerRow row = row_of(effect, grown.growth.errors[k + 1], grown.before, k + 1, drivers);
    const std::size_t in_file = read_model(grown.bytes, file).terms.size();
    std::vector<std::size_t> removed;  // the same with the gains that they had
    for (std::size_t j = 0; j < k; ++j) removed.push_back(in_file - k + j);
    grown.bytes = with_revision(grown.bytes, file, effect.terms, removed, grown.before, row);
    row.revision = read_ledger(grown.bytes, file).size() - 1;
    grown.rows.push_back(std::move(row));
  }
  return grown;
}

std::string conclusion(const GrownModel& grown, const std::vector<std::string>& causes,
                       const std::vector<Driver>& drivers) {
  if (grown.growth.stop == GrowthStop::untested) {
    return "No effect is added: too few rows to test whether any would predict new ones.";
  }
  if (grown.rows.empty()) {
    return "No effect is added: none predicts new cycles better than the model and than surrogates of the same "
           "smoothness do.";
  }
  const GrowthErrors &first = grown.growth.errors.front(), &last = grown.growth.errors[grown.rows.size()];
  std::string text = fmt::format("From {:.2f} to {:.2f} um with {} more effect{}", first.rmse_um, last.rmse_um,
                                 grown.rows.size(), grown.rows.size() == 1 ? "" : "s");
  if (std::isfinite(last.forecast_um)) {
    text +=
        fmt::format("; {:.2f} um expected on new cycles, {:.2f} um without them", last.forecast_um, first.forecast_um);
  }
  std::vector<std::string> known_drivers;
  for (const Driver& driver : drivers) {
    if (driver.p >= kKnownDriver) known_drivers.push_back(driver.column);
  }
  if (!causes.empty()) {
    text += fmt::format(". Of this you may call cause: {}", fmt::join(causes, ", "));
  } else if (!known_drivers.empty()) {
    text += fmt::format(". {} {} it, in a form that is not known; no effect may be called the cause",
                        fmt::join(known_drivers, " and "), known_drivers.size() == 1 ? "drives" : "drive");
  } else {
    text += ". None of it may be called a cause: the effects predict, they do not explain";
  }
  return text + fmt::format(". A slow curve of {:.2f} um (standard deviation) is left. {}", last.sigma_um,
                            stop_text(grown.growth.stop));
}

std::string tables(const GrownModel& grown) {
  if (grown.rows.empty()) return "";
  Table table({"revision", "RMSE um", "surrogates", "forecasts um", "surrogates", "2 ln B", "what it is"});
  const auto add = [&](const std::string& name, const GrowthErrors& errors, const LedgerRow* row) {
    table.add({one_line(name), known(errors.rmse_um), known(errors.surrogate_um), known(errors.forecast_um),
               known(errors.surrogate_forecast_um), row == nullptr ? "-" : fixed(row->likelihood_ratio, 1),
               row == nullptr ? "the model" : row->verdict});
  };
  add("before", grown.growth.errors.front(), nullptr);
  for (std::size_t k = 0; k < grown.rows.size(); ++k) {
    add(fmt::format("{} {}", grown.rows[k].revision, grown.rows[k].change), grown.growth.errors[k + 1], &grown.rows[k]);
  }
  return fmt::format(
      "{}{}", table.text(table_width()),
      wrapped(fmt::format(
          "forecasts: RMSE of rows predicted from earlier ones alone, from {} origins, all of the "
          "growth done again each time. surrogates: as many columns as smooth, with random phases and no cause, chosen "
          "and fitted alike. 2 ln B is large because nothing else was there to say it: it is no evidence of a cause.",
          grown.growth.forecasts)));
}

std::vector<GrowthStep> steps_of(const GrownModel& grown) {
  std::vector<GrowthStep> steps;
  for (std::size_t k = 0; k < grown.growth.errors.size(); ++k) {
    GrowthStep step{k, std::nullopt, k <= grown.rows.size(), grown.growth.errors[k], std::nullopt};
    if (k > 0 && step.kept) {
      step.added = grown.growth.effects[k - 1].label;
      step.p_none = grown.growth.effects[k - 1].p_none;
    }
    steps.push_back(std::move(step));
  }
  return steps;
}

}  // namespace ballbar
