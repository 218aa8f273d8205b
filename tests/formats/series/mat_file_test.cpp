#include <gtest/gtest.h>
#include <matio.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "ballbar/formats/series/drift_files.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

using Mat = std::unique_ptr<mat_t, decltype(&Mat_Close)>;
using Variable = std::unique_ptr<matvar_t, decltype(&Mat_VarFree)>;

Mat opened(const std::filesystem::path& path) { return {Mat_Open(path.c_str(), MAT_ACC_RDONLY), &Mat_Close}; }

Variable variable(const Mat& file, const char* name) { return {Mat_VarRead(file.get(), name), &Mat_VarFree}; }

// A column of double; empty for anything else.
std::vector<double> column(const Mat& file, const char* name) {
  const Variable found = variable(file, name);
  if (!found || found->class_type != MAT_C_DOUBLE || found->rank != 2 || found->dims[1] != 1) return {};
  const auto* data = static_cast<const double*>(found->data);
  return {data, data + found->dims[0]};
}

std::string text(const Mat& file, const char* name) {
  const Variable found = variable(file, name);
  if (!found || found->class_type != MAT_C_CHAR) return {};
  return {static_cast<const char*>(found->data), found->dims[1]};
}

TEST(mat_file, one_variable_a_column) {
  DriftSeries drift;
  drift.method = Method::two_arcs;
  drift.reference_s = 0.5;
  drift.points.resize(2);
  drift.points[0].time_s = 0.5;
  drift.points[0].x = {0.0, 0.0};
  drift.points[1].time_s = 600.0;
  drift.points[1].x = {4.4, 0.1};
  drift.points[1].y = {30.1, kInfinity};
  const ScratchFolder folder;
  write_drift(drift, folder.path() / "drift.mat");
  const Mat file = opened(folder.path() / "drift.mat");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(Mat_GetVersion(file.get()), MAT_FT_MAT5);
  EXPECT_EQ(text(file, "method"), "two_arcs");
  EXPECT_EQ(column(file, "reference_s"), std::vector<double>{0.5});
  EXPECT_EQ(column(file, "time_s"), (std::vector<double>{0.5, 600.0}));
  EXPECT_EQ(column(file, "x_um"), (std::vector<double>{0.0, 4.4}));
  EXPECT_EQ(column(file, "x_sigma_um"), (std::vector<double>{0.0, 0.1}));
  ASSERT_EQ(column(file, "y_um").size(), 2u);
  EXPECT_TRUE(std::isnan(column(file, "y_um")[0]));
  EXPECT_TRUE(std::isnan(column(file, "y_sigma_um").at(1)));
  EXPECT_EQ(column(file, "radial_um"), std::vector<double>{});
}

TEST(mat_file, of_five_probes) {
  MeasuredDrift drift;
  drift.method = "five_probe";
  drift.reference_s = 0.0;
  drift.time_s = {0.0, 600.0};
  drift.axes.push_back({.name = "tilt_b", .unit = "urad", .value = {0.0, 1.5}});
  const ScratchFolder folder;
  write_drift(drift, {}, {}, folder.path() / "drift.mat");
  const Mat file = opened(folder.path() / "drift.mat");
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(text(file, "method"), "five_probe");
  EXPECT_EQ(column(file, "time_s"), drift.time_s);
  EXPECT_EQ(column(file, "tilt_b_urad"), drift.axes[0].value);
  EXPECT_EQ(column(file, "tilt_b_sigma_urad"), std::vector<double>{});
}

}  // namespace
}  // namespace ballbar
