// Files of recordings, as results.
#pragma once

#include "ballbar/formats/recordings/test_folder.hpp"
#include "ballbar/formats/results/result_type.hpp"

namespace ballbar {

template <>
inline constexpr auto kResult<SkippedFile> =
    ResultType{"SkippedFile", "A file that could not be read.",
               std::tuple{Field{"file", &SkippedFile::file, ""},
                          Field{"why", &SkippedFile::why, "a sentence with the file's name"}}};

}  // namespace ballbar
