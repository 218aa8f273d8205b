// Any bytes in a file called .zip: what is listed inside is read or refused by Error, nothing else.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include "ballbar/error.hpp"
#include "ballbar/formats/text/archive.hpp"
#include "ballbar/formats/text/file_bytes.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::filesystem::path kFile =
      std::filesystem::temp_directory_path() / ("ballbar-fuzz-" + std::to_string(::getpid()) + ".zip");
  std::ofstream(kFile, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    if (!ballbar::is_archive(kFile)) return 0;
    for (const std::filesystem::path& file : ballbar::files_in_archive(kFile)) {
      try {
        ballbar::bytes_in_archive(file, ballbar::kLargestText);
      } catch (const ballbar::Error&) {
      }
    }
  } catch (const ballbar::Error&) {
  }
  return 0;
}
