#include "text/zip_part.hpp"

#include <memory>

namespace ballbar {

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

}  // namespace ballbar
