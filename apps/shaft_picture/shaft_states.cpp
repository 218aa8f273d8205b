#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>

#include "ballbar/error.hpp"
#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/formats/series/profile_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "model/model_options.hpp"
#include "shaft_picture/shaft_picture.hpp"

namespace ballbar {
namespace {

// By its ending, or by its first bytes.
bool is_picture(const std::string& path, const std::string& bytes) {
  const std::string ending = std::filesystem::path(path).extension().string();
  for (const char* known : {".png", ".PNG", ".jpg", ".JPG", ".jpeg", ".JPEG"}) {
    if (ending == known) return true;
  }
  return bytes.starts_with("\x89PNG") || bytes.starts_with("\xFF\xD8\xFF");
}

std::optional<PixelBox> box_of(const char* option, const std::string& stated) {
  if (stated.empty()) return std::nullopt;
  std::array<std::size_t, 4> numbers{};
  const char* next = stated.data();
  const char* const end = next + stated.size();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto [rest, error] = std::from_chars(next, end, numbers[i]);
    const bool last = i + 1 == numbers.size();
    if (error != std::errc{} || (last ? rest != end : rest == end || *rest != ',')) {
      throw CLI::ValidationError(fmt::format("{}: expected x,y,w,h, whole pixels from the top left corner, found {}",
                                             option, in_quotes(stated)));
    }
    next = rest + 1;
  }
  return PixelBox{numbers[0], numbers[1], numbers[2], numbers[3]};
}

// Empty where no map is named.
std::vector<Colour> colours_of(const std::string& name) {
  if (name.empty()) return {};
  try {
    return colour_map(name);
  } catch (const Error& error) {
    throw CLI::ValidationError(fmt::format("--colours: {}", error.what()));
  }
}

void expect_one_each(const char* option, const std::vector<double>& stated, std::size_t pictures) {
  if (stated.size() <= 1 || stated.size() == pictures) return;
  throw CLI::ValidationError(fmt::format(
      "{}: expected one temperature{}, found {}", option,
      pictures == 1 ? "" : fmt::format(" for all pictures or one for each of {}", pictures), stated.size()));
}

double of_picture(const char* option, const std::vector<double>& stated, std::size_t index) {
  if (stated.empty()) throw Error(fmt::format("{}: expected one temperature, found none.", option));
  return stated.size() == 1 ? stated.front() : stated[index];
}

// Mean, places and elongation of the profile. step_degC is of the scale: it is in the sigma of T at each place, but
// does not make crossings one.
void measure(ShaftState& state, const ShaftPictureOptions& options, double step_degC, double pixel_mm) {
  state.mean_degC = mean_degC(state.profile);
  const std::vector<MeanPoint> points =
      flattest_first(mean_points(state.profile, same_degC(state.profile, state.mean_degC)));
  state.profile = with_step(std::move(state.profile), step_degC);
  for (const MeanPoint& point : points) {
    state.places.push_back({point, sigma_of_place_mm(state.profile, point, pixel_mm),  // the region's edges to a pixel
                            sigma_of_slope_degC_per_mm(state.profile, point),
                            misplacement_um_per_mm(state.profile, point, options.expansion_ppm_per_K)});
  }
  if (state.from && (state.from->image.saturated_cold || state.from->image.saturated_hot)) {
    // What lies beyond the scale is not known: no sigma holds.
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    state.sigma_mean_degC = kUnknown;
    for (SensorPlace& place : state.places) place.sigma_mm = place.sigma_slope_degC_per_mm = kUnknown;
    state.profile.sigma_degC.clear();
  }
  if (!options.start_degC) return;
  const auto elongation_um = [&](double rise_K) {
    return mean_point_elongation_um(options.expansion_ppm_per_K, length_mm(state.profile), rise_K);
  };
  state.elongation_um = elongation_um(state.mean_degC - *options.start_degC);
  state.sigma_elongation_um = elongation_um(state.sigma_mean_degC);
}

std::size_t edge_of(const ShaftPictureOptions& options) {
  if (!options.edge_px) return ImageOptions{}.edge_px;
  if (*options.edge_px >= 0 && *options.edge_px <= kWidestEdge_px) return static_cast<std::size_t>(*options.edge_px);
  throw CLI::ValidationError(
      fmt::format("--edge-px: expected 0 to {} pixels, found {}.", kWidestEdge_px, *options.edge_px));
}

void expect_bounded(const char* option, double value, double largest, const char* unit) {
  if (std::abs(value) <= largest) return;
  throw CLI::ValidationError(
      fmt::format("{}: expected -{:g} to {:g} {}, found {:g}.", option, largest, largest, unit, value));
}

void expect_usable(const ShaftPictureOptions& options) {
  edge_of(options);
  box_of("--legend", options.legend);
  box_of("--region", options.region);
  colours_of(options.colours);
  expect_one_each("--min-degC", options.min_degC, options.files.size());
  expect_one_each("--max-degC", options.max_degC, options.files.size());
  constexpr double kLargest_ppm_per_K = 1000.0;
  if (options.start_degC) expect_bounded("--start-degC", *options.start_degC, kLargest_degC, "degC");
  for (const double min : options.min_degC) expect_bounded("--min-degC", min, kLargest_degC, "degC");
  for (const double max : options.max_degC) expect_bounded("--max-degC", max, kLargest_degC, "degC");
  if (options.from_mm) expect_bounded("--from-mm", *options.from_mm, kLargestPlace_mm, "mm");
  if (options.to_mm) expect_bounded("--to-mm", *options.to_mm, kLargestPlace_mm, "mm");
  if (!(options.expansion_ppm_per_K > 0.0 && options.expansion_ppm_per_K <= kLargest_ppm_per_K)) {
    throw CLI::ValidationError(
        fmt::format("--expansion-ppm-per-K: expected more than 0, at most {:g} ppm/K, found {:g}.", kLargest_ppm_per_K,
                    options.expansion_ppm_per_K));
  }
}

ShaftState state_of(const ShaftPictureOptions& options, const std::string& path, const std::string& bytes,
                    std::size_t index) {
  const double min = of_picture("--min-degC", options.min_degC, index);
  const double max = of_picture("--max-degC", options.max_degC, index);
  const std::optional<PixelBox> legend = box_of("--legend", options.legend);
  ShaftState state;
  state.name = path;
  state.from.emplace();
  PictureState& from = *state.from;
  from.vertical = options.vertical;
  from.picture = read_picture(bytes, path);
  const std::vector<Colour> colours = colours_of(options.colours);
  with_source(path, [&] {
    from.scale = colours.empty() ? legend_scale(from.picture, *legend, min, max) : scale_of(colours, min, max);
    ImageOptions how{box_of("--region", options.region), legend, edge_of(options)};
    from.image = temperature_image(from.picture, from.scale, how);
    from.columns =
        image_profile(from.image, from.scale, options.from_mm.value_or(0.0), *options.to_mm, options.vertical);
    from.areas = three_areas(from.picture, from.image, min, max, options.vertical);
  });
  state.profile = from.columns.profile;
  state.sigma_mean_degC = from.columns.sigma_mean_degC;
  measure(state, options, from.scale.step_degC, length_mm(state.profile) / static_cast<double>(from.columns.columns));
  return state;
}

std::vector<ShaftState> states_of_table(const ShaftPictureOptions& options, const std::string& bytes) {
  const std::string& path = options.files.front();
  const std::pair<const char*, bool> given[] = {
      {"--from-mm", options.from_mm.has_value()}, {"--to-mm", options.to_mm.has_value()},
      {"--min-degC", !options.min_degC.empty()},  {"--max-degC", !options.max_degC.empty()},
      {"--legend", !options.legend.empty()},      {"--colours", !options.colours.empty()},
      {"--region", !options.region.empty()},      {"--vertical", options.vertical},
      {"--edge-px", options.edge_px.has_value()}};
  for (const auto& [option, there] : given) {
    if (there) throw Error(fmt::format("{}: expected a picture to use it with, found the table {}.", option, path));
  }
  std::vector<ShaftState> states;
  for (NamedProfile& named : read_profiles(bytes, path)) {
    ShaftState state;
    state.name = std::move(named.name);
    state.profile = std::move(named.profile);
    with_source(path + ": " + state.name, [&] {
      state.sigma_mean_degC = sigma_of_mean_degC(state.profile);
      measure(state, options, 0.0, 0.0);
    });
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace

std::vector<ShaftState> shaft_states(const ShaftPictureOptions& options) {
  expect_usable(options);
  std::vector<std::string> bytes;
  std::size_t pictures = 0;
  for (const std::string& path : options.files) {
    bytes.push_back(read_bytes(path, kLargestPicture));
    pictures += is_picture(path, bytes.back()) ? 1 : 0;
  }
  if (pictures == 0 && options.files.size() == 1) return states_of_table(options, bytes.front());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (is_picture(options.files[i], bytes[i])) continue;
    throw Error(
        fmt::format("{}: expected pictures alone, PNG or JPEG, or one table alone, found one that is no picture.",
                    options.files[i]));
  }
  if (!options.to_mm) {
    throw Error("--to-mm: expected the place of the region's right edge (bottom with --vertical), found none.");
  }
  if (options.legend.empty() && options.colours.empty()) {
    throw Error(
        "--legend: expected the box of the colour scale in the picture, or --colours with a map, found neither.");
  }
  std::vector<ShaftState> states;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    states.push_back(state_of(options, options.files[i], bytes[i], i));
  }
  return states;
}

}  // namespace ballbar
