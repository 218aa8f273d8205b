// The files that a page was made of, inside it: a page with the engine goes on with them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

struct CarriedFile {
  std::string path, base64;
};

template <>
struct ResultType<CarriedFile> {
  static constexpr std::string_view name = "CarriedFile";
  static constexpr std::string_view meaning = "A file inside a page.";
  static constexpr std::tuple fields{Field{"path", &CarriedFile::path, "below the common folder of all"},
                                     Field{"base64", &CarriedFile::base64, "its bytes"}};
};

struct CarriedFiles {
  std::vector<CarriedFile> files;
  std::vector<std::string> data;
  MayLack<std::string> model;
};

template <>
struct ResultType<CarriedFiles> {
  static constexpr std::string_view name = "CarriedFiles";
  static constexpr std::string_view meaning = "The files that a page was made of, inside it.";
  static constexpr std::tuple fields{Field{"files", &CarriedFiles::files, ""},
                                     Field{"data", &CarriedFiles::data, "the words for DATA"},
                                     Field{"model", &CarriedFiles::model, "where there is one"}};
};

inline constexpr std::size_t kMostInside = std::size_t{8} << 20;  // bytes of all files: a page is mailed

// CarriedFiles; null: they are more than kMostInside. Throws Error where one cannot be read.
nlohmann::ordered_json files_inside(const std::vector<std::filesystem::path>& files,
                                    const std::vector<std::string>& data, const std::string& model);

}  // namespace ballbar
