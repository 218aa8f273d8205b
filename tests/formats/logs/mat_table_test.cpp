#include <fmt/format.h>
#include <gtest/gtest.h>
#include <matio.h>

#include <memory>

#include "ballbar/error.hpp"
#include "ballbar/formats/logs/log.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "scratch_folder.hpp"

namespace ballbar {
namespace {

void write(mat_t* file, const char* name, std::size_t rows, std::size_t columns, std::vector<double> values) {
  std::size_t size[] = {rows, columns};
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size, values.data(), 0), &Mat_VarFree);
  ASSERT_EQ(Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE), 0);
}

// Vectors, a row vector, a matrix and a number beside them.
std::string file_of(const ScratchFolder& folder, mat_ft version) {
  const auto path = folder.path() / "log.mat";
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(Mat_CreateVer(path.c_str(), nullptr, version), &Mat_Close);
  write(file.get(), "time_s", 3, 1, {0.0, 0.5, 1.0});
  write(file.get(), "n_rpm", 1, 3, {0.0, 6000.0, 6000.0});
  write(file.get(), "T", 3, 2, {20.0, 20.5, std::numeric_limits<double>::quiet_NaN(), 30.0, 31.0, 32.0});
  write(file.get(), "version", 1, 1, {2.0});
  return path.string();
}

TEST(mat_table, of_both_kinds) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const ScratchFolder folder;
    const Log log = open_log(file_of(folder, version));
    EXPECT_EQ(log.series.time_s, (std::vector<double>{0.0, 0.5, 1.0}));
    ASSERT_EQ(log.series.columns.size(), 3u);
    const auto values = [&](std::string_view name) {
      return find_column(log.series, name)->values;
    };  // v7.3 sorts them
    EXPECT_EQ(values("n_rpm"), (std::vector<double>{0.0, 6000.0, 6000.0}));
    EXPECT_TRUE(std::isnan(values("T_1")[2]));
    EXPECT_EQ(values("T_2"), (std::vector<double>{30.0, 31.0, 32.0}));
  }
}

TEST(mat_table, half_a_file_is_refused) {
  for (const mat_ft version : {MAT_FT_MAT5, MAT_FT_MAT73}) {
    const ScratchFolder folder;
    const std::string bytes = read_bytes(file_of(folder, version), 1 << 20);
    const std::string half = bytes.substr(0, bytes.size() / 2);
    EXPECT_EQ(complaint(folder, [&] { read_log(half, "half.mat"); }),
              "half.mat:1: expected a whole .mat file, found a damaged one.");
  }
}

}  // namespace
}  // namespace ballbar
