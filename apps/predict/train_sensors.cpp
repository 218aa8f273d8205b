// `ballbar train DATA --sensors N`: the temperature sensors that a regression on effects needs (train.hpp).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "ballbar/series/series.hpp"
#include "predict/train.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kShownSizes = 6;

bool is_of(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string names_text(const std::vector<std::string>& names) {
  std::vector<std::string> shown;
  for (const std::string& name : names) shown.push_back(one_line(name));
  return names.empty() ? "none" : fmt::format("{}", fmt::join(shown, ", "));
}

std::string sensors_text(std::size_t count) { return fmt::format("{} sensor{}", count, count == 1 ? "" : "s"); }

}  // namespace

SensorChoice keep_chosen_sensors(std::vector<Series>& runs, const std::string& target, std::size_t most) {
  const ProgressLine progress;
  SensorChoice choice = sensor_choice(runs, target, most, [](const std::string& what) { show_progress(what); });
  for (Series& run : runs) {
    std::erase_if(run.columns, [&](const Column& column) {
      return column.name != target && is_sensor(column) && !is_of(choice.sets.back().sensors, column.name);
    });
  }
  return choice;
}

void take_tests_of(const SensorChoice& choice, TrainedRegression& trained) {
  trained.regression.forecasts = choice.sets.back().forecasts;
  trained.regression.interval_scale = choice.sets.back().interval_scale;
  trained.left_out = choice.left_out;
  DriverReport& drivers = trained.drivers;
  drivers.interchangeable.clear();
  std::erase_if(drivers.not_needed, [&](const std::string& name) { return !is_of(choice.kept, name); });
  for (const ChosenSensor& one : choice.chosen) {
    if (!one.needed) drivers.not_needed.push_back(one.sensor);
    if (one.substitutes.empty()) continue;
    drivers.interchangeable.push_back({one.sensor});
    drivers.interchangeable.back().insert(drivers.interchangeable.back().end(), one.substitutes.begin(),
                                          one.substitutes.end());
  }
}

std::vector<ScreenPart> sensor_choice_parts(const SensorChoice& choice, const std::string& target,
                                            const std::string& unit, bool predicted, bool details) {
  const SensorSet& taken = choice.sets.back();
  const std::size_t most = taken.sensors.size();
  std::vector<std::string> names;
  for (const ChosenSensor& one : choice.chosen) names.push_back(one.sensor);
  std::string text = wrapped(fmt::format(
      "{} {} {} to {:.2f} {} (all {}: {:.2f} {}): {}.", sensors_text(most),
      predicted ? (most == 1 ? "predicts" : "predict") : (most == 1 ? "hardly predicts" : "hardly predict"), target,
      taken.forecasts.error_um, unit, choice.rated, choice.all.forecasts.error_um, unit, names_text(names)));
  if (choice.enough < most) {
    const SensorSet& enough = choice.sets[choice.enough];
    text += wrapped(choice.enough == 0 ? fmt::format("No sensor is needed: the error is {:.2f} {} without.",
                                                     enough.forecasts.error_um, unit)
                                       : fmt::format("{} enough, {:.2f} {}: {}.",
                                                     choice.enough == 1 ? "1 is" : fmt::format("{} are", choice.enough),
                                                     enough.forecasts.error_um, unit, names_text(enough.sensors)));
  }
  if (!choice.kept.empty()) {
    text +=
        wrapped(fmt::format("Kept but not counted, because they are no temperatures: {}.", names_text(choice.kept)));
  }
  std::vector<ScreenPart> parts{{text}};
  Table sizes({"sensors", "error " + unit, "RMSE " + unit, "gain " + unit, "set"});
  const auto add = [&](const std::string& name, const SensorSet& set, bool buys, const std::string& shown) {
    sizes.add({name, fixed(set.forecasts.error_um, 2), fixed(set.forecasts.rmse_um, 2),
               buys ? with_sigma(set.buys_um, set.sigma_buys_um, 2) : "-", shown});
  };
  for (const SensorSet& set : choice.sets) {
    add(fmt::format("{}", set.sensors.size()), set, !set.sensors.empty(), names_text(set.sensors));
  }
  if (choice.rated > most) add(fmt::format("all {}", choice.rated), choice.all, true, "all");
  const bool ahead = choice.forecasts_ahead;
  if (!details) sizes.shorten(kShownSizes);
  parts.push_back(
      {sizes.left_aligned(table_width()) +
       wrapped(fmt::format("error: mean absolute error in {}; the sensors are chosen again from {} alone. set: chosen "
                           "from all rows. gain: "
                           "fall of the error from the line above, ± its standard error over the {}.",
                           ahead ? fmt::format("forecasts from {} origins", choice.folds)
                                 : fmt::format("runs left out (each of {})", choice.folds),
                           ahead ? "the rows before each" : "the other runs", ahead ? "forecasts" : "runs"))});
  Table worth({"sensor", "chosen in", "loss without it " + unit, "substitutes"});
  for (const ChosenSensor& one : choice.chosen) {
    worth.add({one_line(one.sensor), fmt::format("{} of {}", one.folds, choice.folds),
               with_sigma(one.without_um, one.sigma_um, 2), one.needed ? names_text(one.substitutes) : "not needed"});
  }
  parts.push_back(
      {worth.left_aligned(table_width()) +
           wrapped(fmt::format(
               "chosen in: {} in which it is chosen too. loss without it: rise of the error of this set. "
               "substitutes: with one of these the error is larger by at most 2 %, or by at most 10 % and its standard "
               "error.",
               ahead ? "forecasts" : "runs left out")),
       "what each sensor is worth"});
  return parts;
}

}  // namespace ballbar
