#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <utility>

#include "pictures/picture_parts.hpp"

// After <cstdio>, whose names it uses.
#include <jerror.h>
#include <jpeglib.h>

#include "ballbar/error.hpp"

namespace ballbar {
namespace {

// The library ends what it cannot do by calling error_exit, which must not return.
struct Complaint : jpeg_error_mgr {
  std::jmp_buf leave{};
  std::array<char, JMSG_LENGTH_MAX> text{};
};

[[noreturn]] void leave(j_common_ptr jpeg) {
  auto& complaint = *static_cast<Complaint*>(jpeg->err);
  complaint.format_message(jpeg, complaint.text.data());
  std::longjmp(complaint.leave, 1);
}

// Where the data are damaged the library warns and makes up what is missing. These do not say so of the pixels.
bool is_harmless(int warning) {
  return warning == JWRN_ADOBE_XFORM || warning == JWRN_JFIF_MAJOR || warning == JWRN_NOT_SEQUENTIAL;
}

void hear(j_common_ptr jpeg, int level) {
  if (level < 0 && !is_harmless(jpeg->err->msg_code)) leave(jpeg);
}

void say_nothing(j_common_ptr) {}

// A few bytes may ask for a pass over all pixels; who writes pictures has about ten.
void limit_scans(j_common_ptr jpeg) {
  constexpr int kMostScans = 100;
  if (!jpeg->is_decompressor || reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  auto& complaint = *static_cast<Complaint*>(jpeg->err);
  *fmt::format_to_n(complaint.text.data(), complaint.text.size() - 1, "more than {} scans", kMostScans).out = '\0';
  std::longjmp(complaint.leave, 1);
}

template <class Struct>
struct Codec {
  Complaint complaint{};
  jpeg_progress_mgr progress{};
  Struct jpeg{};

  Codec() {
    jpeg.err = jpeg_std_error(&complaint);
    complaint.error_exit = leave;
    complaint.emit_message = hear;
    complaint.output_message = say_nothing;
    progress.progress_monitor = limit_scans;
  }
  ~Codec() { jpeg_destroy(reinterpret_cast<j_common_ptr>(&jpeg)); }
  Codec(const Codec&) = delete;
  Codec& operator=(const Codec&) = delete;
};

// False where the library left `work`, which must make no object with a destructor: it would not be called.
template <class Work>
bool finishes(Complaint& complaint, const Work& work) {
  if (setjmp(complaint.leave) != 0) return false;
  work();
  return true;
}

std::string_view text_of(const Complaint& complaint) {
  std::string_view text(complaint.text.data());
  while (text.ends_with('.')) text.remove_suffix(1);
  return text;
}

int orientation_of(const jpeg_decompress_struct& jpeg) {
  for (const jpeg_marker_struct* marker = jpeg.marker_list; marker; marker = marker->next) {
    const int orientation =
        exif_orientation({reinterpret_cast<const char*>(marker->data), std::size_t{marker->data_length}});
    if (orientation != 1) return orientation;
  }
  return 1;
}

}  // namespace

Picture decoded_jpeg(std::string_view bytes, std::string_view name) {
  Codec<jpeg_decompress_struct> codec;
  jpeg_decompress_struct& jpeg = codec.jpeg;
  const bool header_read = finishes(codec.complaint, [&] {
    jpeg_create_decompress(&jpeg);
    jpeg.progress = &codec.progress;
    jpeg_mem_src(&jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    jpeg_save_markers(&jpeg, JPEG_APP0 + 1, 0xFFFF);
    jpeg_read_header(&jpeg, TRUE);
  });
  if (!header_read) fail_damaged(name, text_of(codec.complaint));
  if (jpeg.jpeg_color_space == JCS_CMYK || jpeg.jpeg_color_space == JCS_YCCK) {
    throw Error(fmt::format("{}: expected a JPEG in colours of a screen, found one in colours of print (CMYK).", name));
  }
  const int orientation = orientation_of(jpeg);
  jpeg.out_color_space = JCS_RGB;
  Picture picture{jpeg.image_width, jpeg.image_height, {}};
  picture.rgb.resize(3 * picture.width * picture.height);
  const bool decoded = finishes(codec.complaint, [&] {
    jpeg_start_decompress(&jpeg);
    while (jpeg.output_scanline < jpeg.output_height) {
      JSAMPROW row = picture.rgb.data() + 3 * picture.width * jpeg.output_scanline;
      jpeg_read_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_decompress(&jpeg);
  });
  if (!decoded) fail_damaged(name, text_of(codec.complaint));
  return turned(std::move(picture), orientation);
}

std::string encoded_jpeg(const Picture& picture, int quality) {
  if (picture.width > JPEG_MAX_DIMENSION || picture.height > JPEG_MAX_DIMENSION) {
    throw Error(fmt::format("a JPEG: expected at most {} pixels a side, found {} by {}.", JPEG_MAX_DIMENSION,
                            picture.width, picture.height));
  }
  Codec<jpeg_compress_struct> codec;
  jpeg_compress_struct& jpeg = codec.jpeg;
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  const bool encoded = finishes(codec.complaint, [&] {
    jpeg_create_compress(&jpeg);
    jpeg_mem_dest(&jpeg, &bytes, &size);
    jpeg.image_width = static_cast<JDIMENSION>(picture.width);
    jpeg.image_height = static_cast<JDIMENSION>(picture.height);
    jpeg.input_components = 3;
    jpeg.in_color_space = JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, quality, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    while (jpeg.next_scanline < jpeg.image_height) {
      JSAMPROW row = const_cast<JSAMPROW>(picture.rgb.data() + 3 * picture.width * jpeg.next_scanline);  // only read
      jpeg_write_scanlines(&jpeg, &row, 1);
    }
    jpeg_finish_compress(&jpeg);
  });
  // The only remaining error is want of memory; `bytes` may have been freed then.
  if (!encoded) {
    throw Error(fmt::format("a JPEG of {} by {} pixels: {}.", picture.width, picture.height, text_of(codec.complaint)));
  }
  const std::unique_ptr<unsigned char, decltype(&std::free)> owned(bytes, &std::free);
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace ballbar
