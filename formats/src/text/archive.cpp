#include "ballbar/formats/text/archive.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string_view>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/file_bytes.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "text/zip_part.hpp"

namespace ballbar {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".b5r";
constexpr zip_int64_t kMostEntries = 10000;
constexpr zip_uint64_t kMostUnpacked = zip_uint64_t{1} << 30;

using Archive = std::unique_ptr<zip_t, decltype(&zip_discard)>;

bool is_regular(const fs::path& path) {
  std::error_code absent;
  return fs::is_regular_file(path, absent);
}

bool begins_as_zip(const fs::path& path) {
  try {
    return is_regular(path) && read_head(path, 4) == "PK\x03\x04";
  } catch (const Error&) {  // not to be read: told where it is opened
    return false;
  }
}

// Null where it is damaged.
Archive zip_of(const fs::path& path) {
  int error = 0;
  return {zip_open(path.c_str(), ZIP_RDONLY, &error), &zip_discard};
}

std::string_view entry_name(zip_t* archive, zip_int64_t index) {
  const char* const name = zip_get_name(archive, static_cast<zip_uint64_t>(index), 0);
  return name == nullptr ? std::string_view() : std::string_view(name);
}

zip_uint64_t claimed_bytes(zip_t* archive, zip_int64_t index) {
  zip_stat_t stat;
  zip_stat_init(&stat);
  const bool known = zip_stat_index(archive, static_cast<zip_uint64_t>(index), 0, &stat) == 0;
  return known && (stat.valid & ZIP_STAT_SIZE) != 0 ? stat.size : 0;
}

// A name that stays inside.
bool stays(const fs::path& name) {
  return !name.is_absolute() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
}

// As a folder is walked: without what a system hides, such as "__MACOSX/._00.b5r" of macOS, which holds no test.
bool is_test(const fs::path& name) {
  const auto hidden = [](const fs::path& part) {
    return part.string().starts_with('.') && part != "." && part != "..";
  };
  return ends_in(name, kEnding) && std::none_of(name.begin(), name.end(), hidden);
}

[[noreturn]] void fail(const fs::path& path, std::string_view expected_and_found) {
  throw Error(fmt::format("{}: {}.", path.string(), expected_and_found));
}

// The archive that a path goes through; empty where it goes through none.
fs::path archive_on(const fs::path& path) {
  for (fs::path part = path.parent_path(); !part.empty() && part != part.parent_path(); part = part.parent_path()) {
    if (is_regular(part)) return begins_as_zip(part) ? part : fs::path();
  }
  return {};
}

}  // namespace

ZipPart unpacked(zip_t* archive, zip_uint64_t index, std::size_t limit) {
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> file(zip_fopen_index(archive, index, 0), &zip_fclose);
  if (!file) return {{}, Unpacking::locked};
  ZipPart part;
  char block[1 << 16];
  for (;;) {
    const zip_int64_t count = zip_fread(file.get(), block, sizeof block);
    if (count < 0) return {{}, Unpacking::damaged};
    if (count == 0) return part;
    part.bytes.append(block, static_cast<std::size_t>(count));
    if (part.bytes.size() > limit) return {{}, Unpacking::too_large};
  }
}

bool is_archive(const fs::path& path) {
  if (!begins_as_zip(path)) return false;
  const Archive archive = zip_of(path);
  if (!archive) return ends_in(path, ".zip");  // a damaged one, told where it is opened; other files are zips too
  const zip_int64_t count = std::min(zip_get_num_entries(archive.get(), 0), kMostEntries);
  for (zip_int64_t i = 0; i < count; ++i) {
    if (is_test(entry_name(archive.get(), i))) return true;
  }
  return false;
}

std::vector<fs::path> files_in_archive(const fs::path& path) {
  const Archive archive = zip_of(path);
  if (!archive) fail(path, "expected a whole archive (.zip), found a damaged one");
  const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
  if (count > kMostEntries) fail(path, fmt::format("expected at most {} entries, found {}", kMostEntries, count));
  std::vector<fs::path> files;
  zip_uint64_t bytes = 0;
  for (zip_int64_t i = 0; i < count; ++i) {
    const fs::path name(entry_name(archive.get(), i));
    if (!is_test(name)) continue;
    if (!stays(name)) {
      fail(path, fmt::format("expected names that stay inside the archive, found {}", in_quotes(name.string())));
    }
    const zip_uint64_t claimed = claimed_bytes(archive.get(), i);
    if (claimed > kMostUnpacked - bytes) {
      fail(path, fmt::format("expected at most {} MiB when unpacked, found more", kMostUnpacked >> 20));
    }
    bytes += claimed;
    files.push_back(path / name);
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

std::optional<std::string> bytes_in_archive(const fs::path& path, std::size_t limit) {
  const fs::path on = archive_on(path);
  if (on.empty()) return std::nullopt;
  const Archive archive = zip_of(on);
  if (!archive) fail(on, "expected a whole archive (.zip), found a damaged one");
  const std::string inside = path.string().substr(on.string().size() + 1);
  const zip_int64_t index = zip_name_locate(archive.get(), inside.c_str(), 0);
  if (index < 0) fail(path, fmt::format("expected a file in the archive {}, found none of that name", on.string()));
  // No more than it claims: what files_in_archive() adds up.
  const auto claimed = static_cast<std::size_t>(std::min<zip_uint64_t>(claimed_bytes(archive.get(), index), limit + 1));
  ZipPart part = unpacked(archive.get(), static_cast<zip_uint64_t>(index), std::min(limit, claimed));
  switch (part.outcome) {
    case Unpacking::whole:
      return std::move(part.bytes);
    case Unpacking::locked:
      fail(path, "expected a file without a password, found one that cannot be unpacked");
    case Unpacking::damaged:
      fail(path, "expected a whole file in the archive, found a damaged one");
    case Unpacking::too_large:
      break;
  }
  fail(path, claimed > limit ? fmt::format("expected at most {} MiB when unpacked, found a larger file", limit >> 20)
                             : std::string("expected a file of the size that the archive states, found a larger one"));
}

fs::path file_on_disk(const fs::path& path) {
  fs::path on = archive_on(path);
  return on.empty() ? path : on;
}

}  // namespace ballbar
