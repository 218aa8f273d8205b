#include "shaft_picture/shaft_picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/profile_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/message_catalogue.hpp"
#include "ballbar/temperature/temperature.hpp"
#include "shaft_picture/shaft_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/option_checks.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// A sigma of zero or none is not shown: a table does not state one.
std::string value_text(double value, double sigma, int decimals) {
  return std::isfinite(sigma) ? with_sigma(value, sigma, decimals) : fixed(value, decimals);
}

std::string elongation_text(const ShaftState& state) {
  return state.elongation_um ? value_text(*state.elongation_um, *state.sigma_elongation_um, 2) : "-";
}

// Of the first state whose scale ends too early; empty where there is none.
Paragraph saturation(const std::vector<ShaftState>& states) {
  for (const ShaftState& state : states) {
    if (!state.from || !(state.from->image.saturated_cold || state.from->image.saturated_hot)) continue;
    const TemperatureImage& image = state.from->image;
    const auto share = [&](std::size_t pixels) {
      return fixed(100.0 * static_cast<double>(pixels) / static_cast<double>(image.used), 1);
    };
    Paragraph in;
    if (states.size() > 1) in = messages::mean_point_in(shortened(state.name, 40));
    if (!image.saturated_hot) return messages::mean_point_cold_end(share(image.at_cold_end), in);
    if (!image.saturated_cold) return messages::mean_point_hot_end(share(image.at_hot_end), in);
    return messages::mean_point_both_ends(share(image.at_cold_end), in, share(image.at_hot_end));
  }
  return {};
}

Paragraph conclusion(const ShaftPictureArguments& options, const std::vector<ShaftState>& states,
                     const std::optional<BestPoint>& best) {
  Paragraph text;
  if (best) {
    double largest = 0.0;
    for (const double error : best->error_um) largest = std::max(largest, std::abs(error));
    text = messages::mean_point_of_all(states.size(), fixed(best->x_mm, 2), fixed(best->rms_um, 2), fixed(largest, 2),
                                       fixed(best->misplaced_um_per_mm, 3));
    text += saturation(states);
    return text;
  }
  const ShaftState& state = states.front();
  text = messages::mean_point_of_one(value_text(state.places.front().point.x_mm, state.places.front().sigma_mm, 2),
                                     value_text(state.mean_degC, state.sigma_mean_degC, 2));
  if (options.of.start_degC)
    text += messages::mean_point_elongation(fmt::format("{:g}", *options.of.start_degC), elongation_text(state));
  if (state.places.size() > 1) text += messages::mean_point_places(state.places.size());
  text += saturation(states);
  return text;
}

void print_points(const ShaftState& state) {
  Table table({"mean-value point", "x mm", "dT/dx degC/mm", "sensor misplaced um/mm"});
  for (std::size_t i = 0; i < state.places.size(); ++i) {
    const SensorPlace& place = state.places[i];
    table.add({fmt::format("{}", i + 1), value_text(place.point.x_mm, place.sigma_mm, 2),
               value_text(place.point.slope_degC_per_mm, place.sigma_slope_degC_per_mm, 4),
               fixed(place.misplaced_um_per_mm, 3)});
  }
  fmt::print("{}\n", table.text());
}

// Where T(x) is a mean that was found another way; "-" where it is nowhere.
std::string places_of(const ShaftState& state, double level_degC) {
  std::vector<std::string> places;
  const TemperatureProfile& profile = state.from->columns.profile;  // its sigma is the scatter alone
  for (const MeanPoint& point : points_at(profile, level_degC, same_degC(profile, level_degC))) {
    places.push_back(fixed(point.x_mm, 2));
  }
  return places.empty() ? "-" : fmt::format("{}", fmt::join(places, ", "));
}

void print_ways(const ShaftPictureArguments& options, const ShaftState& state) {
  const ThreeAreas& areas = state.from->areas;
  Table table({"mean temperature by", "degC", "elongation um", "x mm"});
  const auto add = [&](const char* way, double mean, double sigma) {
    const auto elongation_um = [&](double rise_K) {
      return mean_point_elongation_um(options.of.expansion_ppm_per_K, length_mm(state.profile), rise_K);
    };
    table.add({way, value_text(mean, sigma, 2),
               options.of.start_degC ? value_text(elongation_um(mean - *options.of.start_degC), elongation_um(sigma), 2)
                                     : "-",
               places_of(state, mean)});
  };
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  add("each pixel's colour", state.mean_degC, state.sigma_mean_degC);
  add("three areas (paper)", areas.mean_degC, kUnknown);
  add("three areas, Otsu alone", areas.otsu_mean_degC, kUnknown);
  fmt::print("{}\n", table.text());
}

void print_picture(const ShaftState& state) {
  const PictureState& from = *state.from;
  const PixelBox& box = from.image.region;
  const ThreeAreas& areas = from.areas;
  const auto share = [&](std::size_t pixels) {
    return fixed(100.0 * static_cast<double>(pixels) / static_cast<double>(box.width * box.height), 1);
  };
  const auto of_used = [&](std::size_t pixels) {
    return fixed(100.0 * static_cast<double>(pixels) / static_cast<double>(from.image.used), 1);
  };
  fmt::print(
      "{}", wrapped(fmt::format("Region {},{},{},{}: {} % of its pixels on the scale, {} % off it, {} % lines or "
                                "letters, {} % at edges; {} of {} {} without pixels.",
                                box.x, box.y, box.width, box.height, share(from.image.used),
                                share(from.image.off_scale), share(from.image.contrasting), share(from.image.at_edges),
                                from.columns.empty_columns, from.columns.columns, from.vertical ? "rows" : "columns")));
  fmt::print("{}",
             wrapped(fmt::format(
                 "Scale: {} {} of {:.3g} degC; {}. Sigma: scatter within columns and the scale's step.",
                 from.scale.colours.size(), from.scale.banded ? "bands" : "colours, steps", from.scale.step_degC,
                 from.scale.banded ? "temperatures beyond its end bands are not known"
                                   : fmt::format("{} % of the pixels used are at its cold end, {} % at its hot end",
                                                 of_used(from.image.at_cold_end), of_used(from.image.at_hot_end)))));
  fmt::print(
      "{}", wrapped(fmt::format(
                "Three areas: hot {:.1f} %, middle {:.1f} %, cold {:.1f} % of the length, each at the middle of its "
                "third of the scale, which the paper does not state; thresholds by Otsu and the triangle: red {} and "
                "{}, blue {} and {}. They need a scale from blue to red and have no sigma; on pictures in jet of known "
                "temperature they were off by up to 25 % of the scale, Otsu alone by up to 7 %.",
                100.0 * areas.hot_share, 100.0 * areas.middle_share, 100.0 * areas.cold_share, areas.red_otsu,
                areas.red_triangle, areas.blue_otsu, areas.blue_triangle)));
}

void print_states(const std::vector<ShaftState>& states) {
  Table table({"state", "mean degC", "elongation um", "its own points x mm", "error at the best um"});
  for (const ShaftState& state : states) {
    std::vector<std::string> places;
    for (const SensorPlace& place : state.places) places.push_back(value_text(place.point.x_mm, place.sigma_mm, 2));
    table.add({one_line(state.name), value_text(state.mean_degC, state.sigma_mean_degC, 2), elongation_text(state),
               fmt::format("{}", fmt::join(places, ", ")), fixed(*state.error_at_best_um, 2)});
  }
  fmt::print("{}\n", table.text(table_width(140)));
}

void print_text(const ShaftPictureArguments& options, const std::vector<ShaftState>& states,
                const std::optional<BestPoint>& best) {
  fmt::print("{}\n", wrapped(conclusion(options, states, best)));
  if (best) {
    print_states(states);
  } else {
    print_points(states.front());
    if (states.front().from) {
      print_ways(options, states.front());
      print_picture(states.front());
    }
  }
  if (!options.of.start_degC) fmt::print("{}", wrapped("Elongation: not known without --start-degC."));
  if (!states.front().from && states.front().profile.sigma_degC.empty()) {
    fmt::print(
        "{}",
        wrapped("No sigma: the table has no column NAME_sigma_degC, and one curve alone does not give an error."));
  }
  if (best) {
    fmt::print("{}",
               wrapped("No sigma of the one place: it hangs on which states there are, more than on the errors of "
                       "each."));
  }
  fmt::print("{}", wrapped(fmt::format(
                       "Taken as exact: length {:g} mm{}, expansion {:g} ppm/K{}{}.", length_mm(states.front().profile),
                       states.front().from ? " and its ends" : "", options.of.expansion_ppm_per_K,
                       options.of.start_degC ? fmt::format(", start {:g} degC", *options.of.start_degC) : "",
                       states.front().from ? ", --min-degC and --max-degC" : "")));
}

}  // namespace

void show_shaft_picture(const ShaftPictureArguments& options) {
  std::vector<std::string> outputs;
  if (!options.plot.empty()) {
    expect_shaft_plot(options.plot);
    outputs.push_back(options.plot);
  }
  if (!options.out.empty()) outputs.push_back(options.out);
  expect_no_input(outputs, {options.of.files.begin(), options.of.files.end()});
  std::vector<ShaftState> states = shaft_states(options.of);
  std::vector<NamedProfile> profiles;
  std::vector<TemperatureProfile> plain;
  for (const ShaftState& state : states) {
    profiles.push_back({!state.from          ? state.name
                        : states.size() == 1 ? "T_degC"
                                             : fmt::format("T{}_degC", profiles.size() + 1),
                        state.profile});
    plain.push_back(state.profile);
  }
  std::optional<BestPoint> best;
  if (states.size() > 1) {
    best = best_point(plain, options.of.expansion_ppm_per_K);
    for (std::size_t k = 0; k < states.size(); ++k) states[k].error_at_best_um = best->error_um[k];
  }
  if (!options.out.empty()) write_bytes(options.out, write_profiles(profiles));
  if (!options.plot.empty()) plot_shaft(states, best, conclusion(options, states, best), options.plot);
  if (options.json) {
    print_json(json_of(MeanPointsResult{conclusion(options, states, best), options.of.expansion_ppm_per_K,
                                        options.of.start_degC, best, states}));
  } else {
    print_text(options, states, best);
  }
  for (const std::string& path : outputs) wrote_line(path);
}

}  // namespace ballbar
