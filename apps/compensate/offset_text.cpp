#include "compensate/offset_text.hpp"

#include <fmt/compile.h>

#include <cmath>
#include <cstdint>
#include <iterator>
#include <nlohmann/json.hpp>

#include "terminal/terminal_table.hpp"

namespace ballbar {
namespace {

void append(fmt::memory_buffer& out, std::string_view text) { out.append(text.data(), text.data() + text.size()); }

void append(fmt::memory_buffer& out, double value, std::string_view otherwise) {
  if (std::isfinite(value)) {
    fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), value);
  } else {
    append(out, otherwise);
  }
}

constexpr int kLimitedBit = 16;

// Without the dust of a product of doubles: to a femtometre.
double tidy(double value) { return std::round(value * 1e9) / 1e9; }

}  // namespace

std::string held_text(const std::array<std::size_t, kHoldKinds>& rows) {
  std::string text;
  for (std::size_t kind = 1; kind < kHoldKinds; ++kind) {
    if (rows[kind] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", rows[kind], name_of(Hold(kind)));
  }
  return text;
}

std::string percent_text(const Reduction& reduction) {
  if (!std::isfinite(reduction.share)) return "?";
  return with_sigma(100.0 * reduction.share, 100.0 * reduction.sigma, 1);
}

void append_csv_names(fmt::memory_buffer& out, const CompensatedAxes& axes) {
  append(out, "time_s");
  for (std::size_t a = 0; a < axes.size(); ++a) {
    fmt::format_to(std::back_inserter(out), ",{0}_um,{0}_counts,{0}_predicted_um,{0}_limited,{0}_hold", axes.name(a));
  }
  append(out, "\n");
}

void append_csv(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets) {
  append(out, time_s, "");
  for (const Offset& offset : offsets) {
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(",{},{},"), tidy(offset.offset_um), offset.counts);
    append(out, tidy(offset.predicted_um), "");
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(",{},{}"), offset.limited ? 1 : 0, name_of(offset.hold));
  }
  append(out, "\n");
}

void append_jsonl(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets,
                  const CompensatedAxes& axes) {
  append(out, "{\"time_s\":");
  append(out, time_s, "null");
  for (std::size_t a = 0; a < offsets.size(); ++a) {
    const Offset& offset = offsets[a];
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(",\"{}\":{{\"offset_um\":{},\"counts\":{},\"predicted_um\":"),
                   axes.name(a), tidy(offset.offset_um), offset.counts);
    append(out, tidy(offset.predicted_um), "null");
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(",\"limited\":{},\"hold\":\"{}\""), offset.limited,
                   name_of(offset.hold));
    if (is_about_a_column(offset.hold)) {
      const nlohmann::json column = axes.axis(a).columns()[offset.column];
      append(out, ",\"column\":");
      append(out, column.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace));
    }
    append(out, "}");
  }
  append(out, "}\n");
}

void append_word_names(fmt::memory_buffer& out, const CompensatedAxes& axes) {
  append(out, "time_s");
  for (std::size_t a = 0; a < axes.size(); ++a) {
    fmt::format_to(std::back_inserter(out), ",{0}_word,{0}_hex,{0}_status", axes.name(a));
  }
  append(out, "\n");
}

void append_words(fmt::memory_buffer& out, double time_s, std::span<const Offset> offsets) {
  append(out, time_s, "");
  for (const Offset& offset : offsets) {
    const auto word = static_cast<std::uint16_t>(static_cast<std::int16_t>(offset.counts));
    const int status = static_cast<int>(offset.hold) + (offset.limited ? kLimitedBit : 0);
    fmt::format_to(std::back_inserter(out), FMT_COMPILE(",{},0x{:04X},{}"), word, word, status);
  }
  append(out, "\n");
}

}  // namespace ballbar
