#include "series/mat_file.hpp"

#include <fmt/format.h>
#include <matio.h>

#include <memory>
#include <string>
#include <vector>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

void write_variable(mat_t* file, const std::string& name, matio_classes class_type, matio_types type, std::size_t rows,
                    std::size_t columns, const void* data) {
  std::size_t size[] = {rows, columns};
  // matio copies the data.
  const std::unique_ptr<matvar_t, decltype(&Mat_VarFree)> variable(
      Mat_VarCreate(name.c_str(), class_type, type, 2, size, const_cast<void*>(data), 0), &Mat_VarFree);
  if (!variable || Mat_VarWrite(file, variable.get(), MAT_COMPRESSION_NONE) != 0) {
    throw Error(fmt::format("{}: expected space to write this variable of the .mat file, found none.", name));
  }
}

}  // namespace

void expect_mat(const std::filesystem::path&) {}

void write_mat(std::string_view method, double reference_s, const Series& series, const std::filesystem::path& path) {
  const std::unique_ptr<mat_t, decltype(&Mat_Close)> file(
      Mat_CreateVer(path.c_str(), "MATLAB 5.0 MAT-file, drift series of ballbar", MAT_FT_MAT5), &Mat_Close);
  if (!file) throw Error(fmt::format("{}: expected a folder to write a .mat file to, found none.", path.string()));
  const auto vector = [&](const std::string& name, const std::vector<double>& values) {
    write_variable(file.get(), name, MAT_C_DOUBLE, MAT_T_DOUBLE, values.size(), 1, values.data());
  };
  write_variable(file.get(), "method", MAT_C_CHAR, MAT_T_UTF8, 1, method.size(), method.data());
  vector("reference_s", {reference_s});
  vector("time_s", series.time_s);
  for (const Column& column : series.columns) vector(column.name, column.values);
}

}  // namespace ballbar
