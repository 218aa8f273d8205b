// Files of recordings, as results.
#pragma once

#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

template <>
struct ResultType<SkippedFile> {
  static constexpr std::string_view name = "SkippedFile";
  static constexpr std::string_view meaning = "A file that could not be read.";
  static constexpr std::tuple fields{Field{"file", &SkippedFile::file, ""},
                                     Field{"why", &SkippedFile::why, "a sentence with the file's name"}};
};

}  // namespace ballbar
