#include "mean_point/meanpoint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/formats/series/profile_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/temperature/mean_point.hpp"
#include "mean_point/meanpoint_plot.hpp"
#include "mean_point/meanpoint_result.hpp"
#include "terminal/caller.hpp"
#include "terminal/output_guard.hpp"
#include "terminal/stderr_line.hpp"
#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

// dL of the state since the start, for a mean and its sigma.
double elongation_um(const MeanpointArguments& options, const MeanPointState& state, double rise_K) {
  return mean_point_elongation_um(options.of.expansion_ppm_per_K, length_mm(state.profile), rise_K);
}

// A sigma of zero or none is not shown: a table does not state one.
std::string value_text(double value, double sigma, int decimals) {
  return std::isfinite(sigma) ? with_sigma(value, sigma, decimals) : fixed(value, decimals);
}

// Of the first state whose scale ends too early; empty where there is none.
std::string saturation(const std::vector<MeanPointState>& states) {
  for (const MeanPointState& state : states) {
    if (!state.from || !(state.from->image.saturated_cold || state.from->image.saturated_hot)) continue;
    const TemperatureImage& image = state.from->image;
    const auto share = [&](std::size_t pixels) {
      return fixed(100.0 * static_cast<double>(pixels) / static_cast<double>(image.used), 1);
    };
    const std::string in = states.size() > 1 ? fmt::format(" in {}", shortened(state.name, 40)) : "";
    if (image.saturated_cold && image.saturated_hot) {
      return fmt::format(
          " {} % of the pixels{} crowd at the cold end of the scale and {} % at its hot end, and may be colder and "
          "hotter than it reaches: the mean has no bound and the place may be another, so there is no sigma.",
          share(image.at_cold_end), in, share(image.at_hot_end));
    }
    const bool hot = image.saturated_hot;
    return fmt::format(
        " {} % of the pixels{} crowd at the {} end of the scale and may be {} than it reaches: the mean is only {} "
        "bound and the place may be another, so there is no sigma.",
        share(hot ? image.at_hot_end : image.at_cold_end), in, hot ? "hot" : "cold", hot ? "hotter" : "colder",
        hot ? "a lower" : "an upper");
  }
  return "";
}

std::string conclusion(const MeanpointArguments& options, const std::vector<MeanPointState>& states,
                       const std::optional<BestPoint>& best) {
  if (best) {
    double largest = 0.0;
    for (const double error : best->error_um) largest = std::max(largest, std::abs(error));
    return fmt::format(
        "One sensor for all {} states belongs at x = {} mm: what it reads tells the axial elongation to {} um (root "
        "mean square over the states, at most {} um); each mm that it is off adds up to {} um.{}",
        states.size(), fixed(best->x_mm, 2), fixed(best->rms_um, 2), fixed(largest, 2),
        fixed(best->misplaced_um_per_mm, 3), saturation(states));
  }
  const MeanPointState& state = states.front();
  std::string text =
      fmt::format("The sensor belongs at x = {} mm: there the temperature is the mean of the whole length, {} degC.",
                  value_text(state.points.front().x_mm, state.sigma_mm.front(), 2),
                  value_text(state.mean_degC, state.sigma_mean_degC, 2));
  if (options.of.start_degC) {
    text += fmt::format(" Since {:g} degC the axial elongation is {} um.", *options.of.start_degC,
                        value_text(elongation_um(options, state, state.mean_degC - *options.of.start_degC),
                                   elongation_um(options, state, state.sigma_mean_degC), 2));
  }
  if (state.points.size() > 1) {
    text += fmt::format(" There are {} such places; this one forgives a misplaced sensor most.", state.points.size());
  }
  return text + saturation(states);
}

void print_points(const MeanpointArguments& options, const MeanPointState& state) {
  Table table({"mean-value point", "x mm", "dT/dx degC/mm", "sensor misplaced um/mm"});
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const MeanPoint& point = state.points[i];
    table.add({fmt::format("{}", i + 1), value_text(point.x_mm, state.sigma_mm[i], 2),
               value_text(point.slope_degC_per_mm, state.sigma_slope_degC_per_mm[i], 4),
               fixed(misplacement_um_per_mm(state.profile, point, options.of.expansion_ppm_per_K), 3)});
  }
  fmt::print("{}\n", table.text());
}

// Where T(x) is a mean that was found another way; "-" where it is nowhere.
std::string places_of(const MeanPointState& state, double level_degC) {
  std::vector<std::string> places;
  const TemperatureProfile& profile = state.from->columns.profile;  // its sigma is the scatter alone
  for (const MeanPoint& point : points_at(profile, level_degC, same_degC(profile, level_degC))) {
    places.push_back(fixed(point.x_mm, 2));
  }
  return places.empty() ? "-" : fmt::format("{}", fmt::join(places, ", "));
}

void print_ways(const MeanpointArguments& options, const MeanPointState& state) {
  const ThreeAreas& areas = state.from->areas;
  Table table({"mean temperature by", "degC", "elongation um", "x mm"});
  const auto add = [&](const char* way, double mean, double sigma) {
    const std::string elongation = options.of.start_degC
                                       ? value_text(elongation_um(options, state, mean - *options.of.start_degC),
                                                    elongation_um(options, state, sigma), 2)
                                       : "-";
    table.add({way, value_text(mean, sigma, 2), elongation, places_of(state, mean)});
  };
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  add("each pixel's colour", state.mean_degC, state.sigma_mean_degC);
  add("three areas (paper)", areas.mean_degC, kUnknown);
  add("three areas, Otsu alone", areas.otsu_mean_degC, kUnknown);
  fmt::print("{}\n", table.text());
}

void print_picture(const MeanPointState& state) {
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
                 from.scale.banded ? "whether T goes beyond its end bands is not told"
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

void print_states(const MeanpointArguments& options, const std::vector<MeanPointState>& states, const BestPoint& best) {
  Table table({"state", "mean degC", "elongation um", "its own points x mm", "error at the best um"});
  for (std::size_t k = 0; k < states.size(); ++k) {
    const MeanPointState& state = states[k];
    std::vector<std::string> places;
    for (std::size_t i = 0; i < state.points.size(); ++i) {
      places.push_back(value_text(state.points[i].x_mm, state.sigma_mm[i], 2));
    }
    table.add({one_line(state.name), value_text(state.mean_degC, state.sigma_mean_degC, 2),
               options.of.start_degC
                   ? value_text(elongation_um(options, state, state.mean_degC - *options.of.start_degC),
                                elongation_um(options, state, state.sigma_mean_degC), 2)
                   : "-",
               fmt::format("{}", fmt::join(places, ", ")), fixed(best.error_um[k], 2)});
  }
  fmt::print("{}\n", table.text(table_width(140)));
}

void print_text(const MeanpointArguments& options, const std::vector<MeanPointState>& states,
                const std::optional<BestPoint>& best) {
  fmt::print("{}\n", wrapped(conclusion(options, states, best)));
  if (best) {
    print_states(options, states, *best);
  } else {
    print_points(options, states.front());
    if (states.front().from) {
      print_ways(options, states.front());
      print_picture(states.front());
    }
  }
  if (!options.of.start_degC) fmt::print("{}", wrapped("Elongation: not known without --start-degC."));
  if (!states.front().from && states.front().profile.sigma_degC.empty()) {
    fmt::print(
        "{}", wrapped("No sigma: the table has no column NAME_sigma_degC, and one curve does not tell its own error."));
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

std::vector<MeanPointResult> points_of(const MeanpointArguments& options, const MeanPointState& state) {
  std::vector<MeanPointResult> points;
  for (std::size_t i = 0; i < state.points.size(); ++i) {
    const MeanPoint& point = state.points[i];
    points.push_back({point.x_mm, state.sigma_mm[i], point.slope_degC_per_mm, state.sigma_slope_degC_per_mm[i],
                      misplacement_um_per_mm(state.profile, point, options.of.expansion_ppm_per_K)});
  }
  return points;
}

MeanPointsResult result_of(const MeanpointArguments& options, const std::vector<MeanPointState>& states,
                           const std::optional<BestPoint>& best) {
  MeanPointsResult result{
      conclusion(options, states, best), options.of.expansion_ppm_per_K, options.of.start_degC, {best}, {}};
  for (std::size_t k = 0; k < states.size(); ++k) {
    const MeanPointState& state = states[k];
    MeanPointStateResult one{state.name,
                             length_mm(state.profile),
                             state.mean_degC,
                             state.sigma_mean_degC,
                             {},
                             {},
                             points_of(options, state),
                             {},
                             {state.from}};
    if (options.of.start_degC) {
      one.elongation_um.value = elongation_um(options, state, state.mean_degC - *options.of.start_degC);
      one.sigma_elongation_um.value = elongation_um(options, state, state.sigma_mean_degC);
    }
    if (best) one.error_at_best_um.value = best->error_um[k];
    result.states.push_back(std::move(one));
  }
  return result;
}

}  // namespace

void show_mean_points(const MeanpointArguments& options) {
  std::vector<std::string> outputs;
  if (!options.plot.empty()) {
    expect_meanpoint_plot(options.plot);
    outputs.push_back(options.plot);
  }
  if (!options.out.empty()) {
    outputs.push_back(options.out);
  }
  expect_no_input(outputs, {options.of.files.begin(), options.of.files.end()});
  const std::vector<MeanPointState> states = mean_point_states(options.of);
  std::vector<NamedProfile> profiles;
  std::vector<TemperatureProfile> plain;
  for (const MeanPointState& state : states) {
    profiles.push_back({!state.from          ? state.name
                        : states.size() == 1 ? "T_degC"
                                             : fmt::format("T{}_degC", profiles.size() + 1),
                        state.profile});
    plain.push_back(state.profile);
  }
  std::optional<BestPoint> best;
  if (states.size() > 1) best = best_point(plain, options.of.expansion_ppm_per_K);
  if (!options.out.empty()) write_bytes(options.out, write_profiles(profiles));
  if (!options.plot.empty()) plot_meanpoint(states, best, conclusion(options, states, best), options.plot);
  if (options.json) {
    print_json(json_of(result_of(options, states, best)));
  } else {
    print_text(options, states, best);
  }
  for (const std::string& path : outputs) wrote_line(path);
}

}  // namespace ballbar
