// The files that a page was made of, inside it: a page with the engine goes on with them.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace ballbar {

inline constexpr std::size_t kMostInside = std::size_t{8} << 20;  // bytes of all files: a page is mailed

// "files": path below their common folder, and base64; "data": the words for DATA; "model", where there is one. Null:
// they are more than kMostInside. Throws Error where one cannot be read.
nlohmann::ordered_json files_inside(const std::vector<std::filesystem::path>& files,
                                    const std::vector<std::string>& data, const std::string& model);

}  // namespace ballbar
