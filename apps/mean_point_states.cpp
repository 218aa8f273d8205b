#include "mean_point_states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "ballbar/error.hpp"
#include "ballbar/formats/bytes.hpp"
#include "ballbar/formats/picture_file.hpp"
#include "ballbar/formats/profile_csv.hpp"
#include "ballbar/nearest_name.hpp"

namespace ballbar {
namespace {

constexpr double kSame = 2.0;  // sigma: crossings not farther apart than that in T are one

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
      throw Error(fmt::format("{}: expected x,y,w,h, whole pixels from the top left corner, found {}.", option,
                              in_quotes(stated)));
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
    throw Error(fmt::format("--colours: {}", error.what()));
  }
}

double of_picture(const char* option, const std::vector<double>& stated, std::size_t index, std::size_t pictures) {
  if (stated.size() == 1) return stated.front();
  if (stated.size() == pictures) return stated[index];
  throw Error(fmt::format("{}: expected one temperature{}, found {}.", option,
                          pictures == 1 ? "" : fmt::format(" for all pictures or one for each of {}", pictures),
                          stated.empty() ? "none" : fmt::format("{}", stated.size())));
}

void set_points(MeanPointState& state, double common_sigma_degC, double pixel_mm) {
  state.mean_degC = mean_degC(state.profile);
  const std::vector<MeanPoint> crossings = mean_points(state.profile);
  const double sigma = sigma_at(state.profile, crossings.front().x_mm);
  state.points = mean_points(state.profile, std::isnan(sigma) ? 0.0 : kSame * sigma);
  std::stable_sort(state.points.begin(), state.points.end(), [](const MeanPoint& a, const MeanPoint& b) {
    return std::abs(a.slope_degC_per_mm) < std::abs(b.slope_degC_per_mm);
  });
  // sigma of xi = sigma of T over its slope, with the step of the scale, the region's edges to a pixel and the stretch
  // over which T cannot be told from the mean.
  for (const MeanPoint& point : state.points) {
    const double T = std::hypot(sigma_at(state.profile, point.x_mm), common_sigma_degC);
    const double along = T / std::abs(point.slope_degC_per_mm);
    state.sigma_mm.push_back(std::hypot(along, pixel_mm, 0.5 * (point.to_mm - point.from_mm)));
  }
}

MeanPointState state_of(const MeanPointOptions& options, const std::string& path, const std::string& bytes,
                        std::size_t index) {
  const double min = of_picture("--min-degC", options.min_degC, index, options.files.size());
  const double max = of_picture("--max-degC", options.max_degC, index, options.files.size());
  const std::optional<PixelBox> legend = box_of("--legend", options.legend);
  MeanPointState state{path, {}, 0.0, 0.0, {}, {}, PictureState{}};
  PictureState& from = *state.from;
  from.vertical = options.vertical;
  from.picture = read_picture(bytes, path);
  const std::vector<Colour> colours = colours_of(options.colours);
  try {
    from.scale = colours.empty() ? legend_scale(from.picture, *legend, min, max) : scale_of(colours, min, max);
    ImageOptions how{box_of("--region", options.region), legend, options.edge_px.value_or(ImageOptions{}.edge_px)};
    from.image = temperature_image(from.picture, from.scale, how);
    from.columns =
        image_profile(from.image, from.scale, options.from_mm.value_or(0.0), *options.to_mm, options.vertical);
    from.areas = three_areas(from.picture, from.image, min, max);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path, error.what()));
  }
  state.profile = from.columns.profile;
  set_points(state, from.scale.step_degC / std::sqrt(12.0),
             length_mm(state.profile) / static_cast<double>(from.columns.columns));
  state.sigma_mean_degC = from.columns.sigma_mean_degC;
  return state;
}

std::vector<MeanPointState> states_of_table(const MeanPointOptions& options, const std::string& bytes) {
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
  std::vector<MeanPointState> states;
  for (NamedProfile& named : read_profiles(bytes, path)) {
    MeanPointState state{std::move(named.name), std::move(named.profile), 0.0, 0.0, {}, {}, std::nullopt};
    state.sigma_mean_degC = sigma_of_mean_degC(state.profile);
    set_points(state, 0.0, 0.0);
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace

std::vector<MeanPointState> mean_point_states(const MeanPointOptions& options) {
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
  std::vector<MeanPointState> states;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    states.push_back(state_of(options, options.files[i], bytes[i], i));
  }
  return states;
}

}  // namespace ballbar
