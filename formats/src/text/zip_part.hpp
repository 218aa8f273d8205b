// A part of a zip archive, unpacked in memory.
#pragma once

#include <zip.h>

#include <cstddef>
#include <string>

namespace ballbar {

enum class Unpacking { whole, locked, damaged, too_large };

struct ZipPart {
  std::string bytes;
  Unpacking outcome = Unpacking::whole;
};

// At most `limit` bytes, whatever size the archive claims.
ZipPart unpacked(zip_t* archive, zip_uint64_t index, std::size_t limit);

}  // namespace ballbar
