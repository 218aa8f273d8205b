#include <fmt/format.h>
#include <spng.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <vector>

#include "ballbar/error.hpp"
#include "pictures/picture_parts.hpp"

namespace ballbar {
namespace {

using Context = std::unique_ptr<spng_ctx, decltype(&spng_ctx_free)>;

Context context(int flags) {
  Context png(spng_ctx_new(flags), &spng_ctx_free);
  if (!png) throw Error("a PNG: expected memory for it, found none.");
  return png;
}

// Signature and chunks (PNG specification, 5.2 to 5.4), without those that say nothing of the pixels: their faults need
// not stop a picture, and a small one may unpack to something vast. Their names start in lower case; tRNS, opacity, is
// the exception.
std::string pixel_chunks(std::string_view bytes) {
  constexpr std::size_t kSignature = 8, kFrame = 12;  // of a chunk: length, name, checksum
  std::string kept(bytes.substr(0, kSignature));
  for (std::size_t at = kSignature; at < bytes.size();) {
    const std::string_view rest = bytes.substr(at);
    const std::size_t length = rest.size() < kFrame ? rest.size() : kFrame + number_at(rest, 0, 4);
    const std::string_view chunk = rest.substr(0, length);
    const std::string_view type = chunk.size() < kFrame ? "" : chunk.substr(4, 4);
    const bool ancillary = !type.empty() && (type[0] & 0x20) != 0 && type != "tRNS";
    if (!ancillary) kept += chunk;
    at += chunk.size();
  }
  return kept;
}

std::uint8_t over_white(int value, int opacity) {
  return static_cast<std::uint8_t>((value * opacity + 255 * (255 - opacity) + 127) / 255);
}

[[noreturn]] void fail(std::string_view name, int failed) {
  fail_damaged(name, failed == SPNG_IO_EOF ? "it ends early" : spng_strerror(failed));
}

// 65535 is 257 times 255.
int eight_bits(std::uint16_t sixteen) { return (sixteen + 128) / 257; }

// By way of red, green, blue, opacity of Value each.
template <class Value, class To8Bits>
std::vector<std::uint8_t> decoded_rgb(spng_ctx* png, int format, std::size_t pixels, std::string_view name,
                                      To8Bits to_8_bits) {
  const auto rgba = std::make_unique_for_overwrite<Value[]>(4 * pixels);
  int failed = spng_decode_image(png, rgba.get(), 4 * pixels * sizeof(Value), format, SPNG_DECODE_TRNS);
  if (!failed) failed = spng_decode_chunks(png);  // up to the end of the file
  if (failed) fail(name, failed);
  std::vector<std::uint8_t> rgb(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      rgb[3 * i + c] = over_white(to_8_bits(rgba[4 * i + c]), to_8_bits(rgba[4 * i + 3]));
    }
  }
  return rgb;
}

}  // namespace

Picture decoded_png(std::string_view bytes, std::string_view name) {
  const std::string kept = pixel_chunks(bytes);
  const Context png = context(0);
  spng_ihdr header{};
  int failed = spng_set_png_buffer(png.get(), kept.data(), kept.size());
  if (!failed) failed = spng_get_ihdr(png.get(), &header);
  if (failed) fail(name, failed);
  Picture picture{header.width, header.height, {}};
  const std::size_t pixels = picture.width * picture.height;
  if (header.bit_depth == 16) {
    picture.rgb = decoded_rgb<std::uint16_t>(png.get(), SPNG_FMT_RGBA16, pixels, name, eight_bits);
  } else {
    const auto as_it_is = [](std::uint8_t value) { return int{value}; };
    picture.rgb = decoded_rgb<std::uint8_t>(png.get(), SPNG_FMT_RGBA8, pixels, name, as_it_is);
  }
  return picture;
}

std::string encoded_png(const Picture& picture) {
  const Context png = context(SPNG_CTX_ENCODER);
  spng_ihdr header{};
  header.width = static_cast<std::uint32_t>(picture.width);
  header.height = static_cast<std::uint32_t>(picture.height);
  header.bit_depth = 8;
  header.color_type = SPNG_COLOR_TYPE_TRUECOLOR;
  int failed = spng_set_option(png.get(), SPNG_ENCODE_TO_BUFFER, 1);
  if (!failed) failed = spng_set_ihdr(png.get(), &header);
  if (!failed) {
    failed = spng_encode_image(png.get(), picture.rgb.data(), picture.rgb.size(), SPNG_FMT_PNG, SPNG_ENCODE_FINALIZE);
  }
  std::size_t size = 0;
  const std::unique_ptr<void, decltype(&std::free)> bytes(
      failed ? nullptr : spng_get_png_buffer(png.get(), &size, &failed), &std::free);
  if (!bytes) {
    throw Error(fmt::format("a PNG of {} by {} pixels: {}.", picture.width, picture.height, spng_strerror(failed)));
  }
  return {static_cast<const char*>(bytes.get()), size};
}

}  // namespace ballbar
