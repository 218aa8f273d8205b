#include "report/report_inside.hpp"

#include <cstdint>
#include <set>
#include <string_view>
#include <system_error>

#include "ballbar/formats/text/file_bytes.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string base64(std::string_view bytes) {
  constexpr std::string_view kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (at + k < bytes.size() ? static_cast<unsigned char>(bytes[at + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) text += at + k <= bytes.size() ? kSigns[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

fs::path whole(const fs::path& path) {
  fs::path normal = fs::absolute(path).lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

// Of two folders the one that both are in.
fs::path common(const fs::path& a, const fs::path& b) {
  fs::path both;
  for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) both /= *i;
  return both;
}

}  // namespace

Json files_inside(const std::vector<fs::path>& files, const std::vector<std::string>& data, const std::string& model) {
  std::set<fs::path> all;
  for (const fs::path& file : files) all.insert(whole(file));
  std::erase_if(all, [](const fs::path& file) {
    std::error_code absent;
    return !fs::is_regular_file(file, absent);
  });
  if (all.empty()) return nullptr;
  fs::path folder = all.begin()->parent_path();
  std::size_t bytes = 0;
  for (const fs::path& file : all) {
    folder = common(folder, file.parent_path());
    std::error_code absent;
    bytes += static_cast<std::size_t>(fs::file_size(file, absent));
  }
  if (bytes > kMostInside) return nullptr;
  const auto inside = [&](const fs::path& path) { return whole(path).lexically_relative(folder).generic_string(); };
  PageFiles inside_page;
  for (const fs::path& file : all) inside_page.files.push_back({inside(file), base64(read_bytes(file, kMostInside))});
  for (const std::string& word : data) inside_page.data.push_back(inside(word));
  if (!model.empty()) inside_page.model = inside(model);
  return json_of(inside_page);
}

}  // namespace ballbar
