// sample-runs/temperature-images: made by its machine.toml, and what its README says of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <sstream>

#include "ballbar/formats/pictures/picture_file.hpp"
#include "ballbar/formats/series/series_csv.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/temperature/temperature.hpp"
#include "simulate/machine_toml.hpp"
#include "simulate/shaft_images.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(BALLBAR_SAMPLE_RUNS) / "temperature-images";

struct Made {
  VirtualMachine machine;
  SimulatedSession simulated;
  std::vector<ShaftImage> images;
};

Made made() {
  const std::string bytes = read_bytes(kFolder / "machine.toml", kLargestText);
  Made result{.machine = read_machine(bytes, "machine.toml"), .images = read_shaft_images(bytes, "machine.toml")};
  result.simulated = simulate(result.machine);
  return result;
}

// Levels, of the 255 of a channel.
struct Difference {
  double mean = 0.0;
  int most = 0;
};

Difference difference(const Picture& a, const Picture& b) {
  Difference result;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int levels = std::abs(int{a.rgb[i]} - int{b.rgb[i]});
    result.mean += levels / static_cast<double>(a.rgb.size());
    result.most = std::max(result.most, levels);
  }
  return result;
}

// CSV to the byte and PNG to the pixel. Another JPEG library, or another version of it, rounds otherwise: a level or
// two in most pixels. A change of what is painted is more than half a level of the mean.
TEST(temperature_images, are_what_their_machine_makes) {
  const Made run = made();
  std::set<std::string> expected = {"README.md", "machine.toml", "truth"};
  for (const SimulatedFile& file : simulated_files(run.simulated, false)) {
    EXPECT_TRUE(read_bytes(kFolder / file.name, kLargestTable) == file.bytes) << file.name;
    expected.insert(file.name);
  }
  EXPECT_TRUE(expected.contains("shaft.csv"));
  for (const SimulatedFile& file : shaft_image_files(run.images, *run.machine.spindle, run.simulated.profiles)) {
    SCOPED_TRACE(file.name);
    const Picture shipped = read_picture(read_bytes(kFolder / file.name, kLargestPicture), file.name);
    const Picture now = read_picture(file.bytes, file.name);
    ASSERT_EQ(shipped.rgb.size(), now.rgb.size());
    const Difference levels = difference(shipped, now);
    EXPECT_LE(levels.mean, file.name.ends_with(".png") ? 0.0 : 0.5);
    EXPECT_LE(levels.most, file.name.ends_with(".png") ? 0 : 16);
    expected.insert(file.name);
  }
  for (const fs::directory_entry& entry : fs::directory_iterator(kFolder)) {
    EXPECT_TRUE(expected.contains(entry.path().filename().string())) << entry.path();
  }
  const Series truth = read_series(read_bytes(kFolder / "truth" / "truth.csv", kLargestTable), "truth.csv");
  EXPECT_EQ(find_column(truth, "z_um")->values, find_column(run.simulated.truth, "z_um")->values);
}

// Columns of shaft.csv.
std::vector<std::vector<double>> shaft_table() {
  std::istringstream lines(read_bytes(kFolder / "shaft.csv", kLargestTable));
  std::vector<std::vector<double>> columns(5);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#') || line.starts_with('x')) continue;
    std::istringstream cells(line);
    for (std::vector<double>& column : columns) {
      std::string cell;
      std::getline(cells, cell, ',');
      column.push_back(std::stod(cell));
    }
  }
  return columns;
}

struct Field {
  double mean_degC = 0.0;
  std::vector<double> xi_mm, slope_K_per_mm;
};

// Midpoints of slices of 0.01 mm: T is straight between the rows of the table and held beyond its last, so the mean is
// good to 1e-5 K and xi to 0.01 mm.
Field field_of(const std::vector<double>& x_mm, const std::vector<double>& degC, double from_mm, double to_mm) {
  constexpr double kSlice_mm = 0.01;
  const auto slices = static_cast<std::size_t>(std::lround((to_mm - from_mm) / kSlice_mm));
  std::vector<double> at_mm, at_degC;
  for (std::size_t i = 0; i < slices; ++i) {
    const double x = from_mm + (static_cast<double>(i) + 0.5) * kSlice_mm;
    const auto after = static_cast<std::size_t>(std::upper_bound(x_mm.begin(), x_mm.end(), x) - x_mm.begin());
    const std::size_t k = std::clamp<std::size_t>(after, 1, x_mm.size() - 1);
    const double share = std::clamp((x - x_mm[k - 1]) / (x_mm[k] - x_mm[k - 1]), 0.0, 1.0);
    at_mm.push_back(x);
    at_degC.push_back(std::lerp(degC[k - 1], degC[k], share));
  }
  Field field;
  for (const double T : at_degC) field.mean_degC += T / static_cast<double>(slices);
  for (std::size_t i = 1; i < slices; ++i) {
    if ((at_degC[i - 1] > field.mean_degC) == (at_degC[i] > field.mean_degC)) continue;
    field.xi_mm.push_back(at_mm[i]);
    field.slope_K_per_mm.push_back((at_degC[i] - at_degC[i - 1]) / kSlice_mm);
  }
  return field;
}

// The README's table; the elongation is alpha L (mean - mean at the start) with 11.7e-3 um/mm/K and L = 330 mm.
TEST(temperature_images, truth_as_the_readme_says) {
  const std::vector<std::vector<double>> table = shaft_table();
  const double start_degC = field_of(table[0], table[1], 190.0, 520.0).mean_degC;
  EXPECT_NEAR(start_degC, 20.042, 6e-4);
  struct Row {
    double mean_degC, xi_mm, elongation_um, slope_K_per_mm;
  };
  const Row rows[] = {{36.137, 374.9, 62.1, -0.086}, {37.038, 372.4, 65.6, -0.085}, {49.170, 372.3, 112.5, -0.184}};
  for (std::size_t i = 0; i < 3; ++i) {
    const Field field = field_of(table[0], table[i + 2], 190.0, 520.0);
    EXPECT_NEAR(field.mean_degC, rows[i].mean_degC, 6e-4);
    ASSERT_EQ(field.xi_mm.size(), 1u);
    EXPECT_NEAR(field.xi_mm[0], rows[i].xi_mm, 0.06);
    EXPECT_NEAR(11.7e-3 * 330.0 * (field.mean_degC - start_degC), rows[i].elongation_um, 0.06);
    EXPECT_NEAR(field.slope_K_per_mm[0], rows[i].slope_K_per_mm, 6e-4);
  }
  // The table as it stands, from the middle of the first cell to that of the last: two points.
  const Field whole = field_of(table[0], table[3], 5.0, 515.0);
  EXPECT_NEAR(whole.mean_degC, 37.914, 6e-4);
  ASSERT_EQ(whole.xi_mm.size(), 2u);
  EXPECT_NEAR(whole.xi_mm[0], 83.5, 0.06);
  EXPECT_NEAR(whole.xi_mm[1], 362.0, 0.06);
  // The library's way to the same.
  const TemperatureProfile profile{table[0], table[3], {}};
  EXPECT_NEAR(mean_degC(profile), whole.mean_degC, 1e-4);
  const std::vector<MeanPoint> points = mean_points(profile);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[0].x_mm, whole.xi_mm[0], 0.02);
  EXPECT_NEAR(points[1].x_mm, whole.xi_mm[1], 0.02);
}

// Read back by hand: in each column of the silhouette's middle row the place of its colour in the colour map, of 256
// steps over 16 K. Half a step is 0.03 K, and a column is 0.62 mm.
TEST(temperature_images, colours_are_the_temperature) {
  const Picture picture = read_picture(read_bytes(kFolder / "jet.png", kLargestPicture), "jet.png");
  const std::vector<Colour> map = colour_map("jet");
  std::vector<double> x_mm, degC;
  for (std::size_t column = 0; column < 532; ++column) {
    const auto place = std::find(map.begin(), map.end(), colour_at(picture, 12 + column, 102));
    ASSERT_NE(place, map.end()) << column;
    x_mm.push_back(190.0 + 330.0 * (static_cast<double>(column) + 0.5) / 532.0);
    degC.push_back(28.0 + 16.0 * static_cast<double>(place - map.begin()) / 255.0);
  }
  const Field field = field_of(x_mm, degC, 190.0, 520.0);
  EXPECT_NEAR(field.mean_degC, 37.038, 0.005);  // of 532 columns
  ASSERT_FALSE(field.xi_mm.empty());
  EXPECT_NEAR(field.xi_mm.front(), 372.4, 0.62);
  EXPECT_NEAR(field.xi_mm.back(), 372.4, 0.62);
}

// Where the README says that silhouette and legend are.
TEST(temperature_images, places_as_the_readme_says) {
  const Made run = made();
  const ShaftPicture painted =
      shaft_picture(run.machine.spindle->body, run.simulated.profiles.at(2).shaft, run.images.at(0).style);
  const auto text = [](const PixelBox& box) { return std::vector{box.x, box.y, box.width, box.height}; };
  EXPECT_EQ(text(painted.shaft), (std::vector<std::size_t>{12, 50, 532, 104}));
  EXPECT_EQ(text(*painted.bar), (std::vector<std::size_t>{556, 36, 16, 132}));
  const ShaftPicture plain =
      shaft_picture(run.machine.spindle->body, run.simulated.profiles.at(1).shaft, run.images.at(4).style);
  EXPECT_EQ(text(plain.shaft), (std::vector<std::size_t>{12, 42, 616, 120}));
}

}  // namespace
}  // namespace ballbar
