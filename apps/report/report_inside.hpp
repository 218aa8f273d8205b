// The files that a page was made of, inside it: a page with the engine goes on with them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

struct PageFile {
  std::string path, base64;
};

template <>
inline constexpr auto kResult<PageFile> = ResultType("CarriedFile", "A file inside a page.",
                                                     Field{"path", &PageFile::path, "below the common folder of all"},
                                                     Field{"base64", &PageFile::base64, "its bytes"});

struct PageFiles {
  std::vector<PageFile> files;
  std::vector<std::string> data;
  std::optional<std::string> model;
};

template <>
inline constexpr auto kResult<PageFiles> = ResultType("CarriedFiles", "The files that a page was made of, inside it.",
                                                      Field{"files", &PageFiles::files},
                                                      Field{"data", &PageFiles::data, "the words for DATA"},
                                                      Field{"model", may_lack(&PageFiles::model),
                                                            "where there is one"});

inline constexpr std::size_t kMostInside = std::size_t{8} << 20;  // bytes of all files: a page is mailed

// PageFiles; null: they are more than kMostInside. Throws Error where one cannot be read.
nlohmann::ordered_json files_inside(const std::vector<std::filesystem::path>& files,
                                    const std::vector<std::string>& data, const std::string& model);

}  // namespace ballbar
