#include "logs/log_text.hpp"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "ballbar/error.hpp"
#include "ballbar/internal/nearest_name.hpp"
#include "ballbar/internal/numerics/interruption.hpp"
#include "text/located_text.hpp"

namespace ballbar {
namespace {

constexpr std::size_t kBlock = std::size_t{256} << 10;
constexpr const char* kWestern = "WINDOWS-1252";
constexpr std::size_t kLongestLine = std::size_t{4} << 20;
constexpr std::size_t kLinesBetweenQuestions = 4096;  // whether the work is to end
constexpr std::size_t kMostLinesOfCell = 20;          // beyond, the quote was an inch, or a cell that lacks its end

unsigned byte(char c) { return static_cast<unsigned char>(c); }

// Where bytes above 0x7F stand.
bool is_utf8(std::string_view head) {
  while (!head.empty()) {
    if (byte(head.front()) < 0x80) {
      head.remove_prefix(1);
      continue;
    }
    const std::size_t length = utf8_length(head);
    if (length == 0) return head.size() < 4;  // cut off at the end of the head
    head.remove_prefix(length);
  }
  return true;
}

// Of the bytes above 0x7F the share that stands in pairs as `is_pair` knows them.
template <class IsPair, class IsSingle>
bool in_pairs(std::string_view head, IsPair is_pair, IsSingle is_single) {
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (byte(head[i]) < 0x80) continue;
    const auto digit = [&](std::size_t at) {
      return at < head.size() && byte(head[at]) >= 0x30 && byte(head[at]) <= 0x39;
    };
    if (digit(i + 1) && i + 2 < head.size() && byte(head[i + 2]) >= 0x81 && digit(i + 3)) {
      i += 3;  // four bytes of GB18030
    } else if (i + 1 < head.size() && is_pair(byte(head[i]), byte(head[i + 1]))) {
      ++pairs;
      ++i;
    } else if (i + 1 < head.size() && !is_single(byte(head[i]))) {
      return false;
    }
  }
  return pairs > 0;
}

// Of text in pairs above 0xA0: all syllables of Korean begin by 0xB0 to 0xC8, a third of the usual Chinese characters
// by more.
bool is_korean(std::string_view head) {
  constexpr std::size_t kFewest = 4;
  std::size_t syllables = 0;
  for (std::size_t i = 0; i + 1 < head.size(); ++i) {
    if (byte(head[i]) < 0xA1) continue;
    if (byte(head[i]) > 0xC8) return false;
    syllables += byte(head[i]) >= 0xB0 ? 1 : 0;
    ++i;
  }
  return syllables >= kFewest;
}

// Words of four and more letters above 0xBF are Cyrillic: a western word has one or two in a row, a Turkish one three.
bool is_cyrillic(std::string_view head) {
  constexpr std::size_t kFewest = 4;
  std::size_t in_words = 0, all = 0, letters = 0;
  for (const char c : head) {
    letters = byte(c) >= 0xC0 ? letters + 1 : 0;
    all += byte(c) >= 0x80 ? 1 : 0;
    in_words += letters == kFewest ? kFewest : letters > kFewest ? 1 : 0;
  }
  return 2 * in_words > all;
}

// UTF-16 without its mark: text of numbers has a NUL in every pair.
std::string utf16_by_nuls(std::string_view head) {
  std::size_t nuls[2] = {0, 0};
  for (std::size_t i = 0; i < head.size(); ++i) nuls[i % 2] += head[i] == '\0';
  const std::size_t pairs = head.size() / 2;
  if (nuls[1] > pairs / 2 && nuls[0] < pairs / 20) return "UTF-16LE";
  if (nuls[0] > pairs / 2 && nuls[1] < pairs / 20) return "UTF-16BE";
  return {};
}

}  // namespace

TextEncoding encoding_of(std::string_view head) {
  if (head.starts_with("\xEF\xBB\xBF")) return {"UTF-8", 3};
  if (head.starts_with("\xFF\xFE")) return {"UTF-16LE", 2};
  if (head.starts_with("\xFE\xFF")) return {"UTF-16BE", 2};
  const std::size_t nul = head.find('\0');
  // Room that a logger took beforehand and did not fill.
  const bool padded =
      nul != std::string_view::npos && nul > 0 && head.find_first_not_of('\0', nul) == std::string_view::npos;
  if (nul != std::string_view::npos && !padded) return {utf16_by_nuls(head), 0};
  if (padded) head = head.substr(0, nul);
  if (is_utf8(head)) return {"UTF-8", 0};
  // Both bytes of the usual Chinese characters are above 0xA0: "°C" and "µm" of Latin-1 are not such pairs.
  const auto none = [](unsigned) { return false; };
  if (in_pairs(
          head, [](unsigned a, unsigned b) { return a >= 0xA1 && a <= 0xF7 && b >= 0xA1 && b <= 0xFE; }, none)) {
    return {is_korean(head) ? "CP949" : "GB18030", 0};
  }
  if (is_cyrillic(head)) return {"WINDOWS-1251", 0};
  // Latin-1 has nothing from 0x80 to 0x9F, and Windows little: there most pairs of Japanese begin.
  const auto is_pair = [](unsigned a, unsigned b) {
    return ((a >= 0x81 && a <= 0x9F) || (a >= 0xE0 && a <= 0xEA)) &&
           ((b >= 0x40 && b <= 0x7E) || (b >= 0x80 && b <= 0xFC));
  };
  const auto count = [&](unsigned low, unsigned high) {
    return std::count_if(head.begin(), head.end(), [&](char c) { return byte(c) >= low && byte(c) <= high; });
  };
  const bool japanese = 4 * count(0x81, 0x9F) > count(0xA0, 0xFF);
  if (japanese && in_pairs(head, is_pair, [](unsigned a) { return a >= 0xA1 && a <= 0xDF; })) return {"SHIFT_JIS", 0};
  return {kWestern, 0};
}

struct LogLines::Decoder {
  explicit Decoder(const std::string& from) : handle(iconv_open("UTF-8", from.c_str())) {
    if (handle == reinterpret_cast<iconv_t>(-1)) {
      throw Error(fmt::format("expected text in a known encoding, found {}, which this system does not know.", from));
    }
  }
  ~Decoder() { iconv_close(handle); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  // Appends what `bytes` says; keeps half a character for the next call; U+FFFD for what is none.
  void append(std::string_view bytes, bool last, std::string& to) {
    kept.append(bytes);
    char* from = kept.data();
    std::size_t left = kept.size();
    while (left > 0) {
      char block[4096];
      char* out = block;
      std::size_t room = sizeof block;
      const std::size_t result = iconv(handle, &from, &left, &out, &room);
      to.append(block, sizeof block - room);
      if (result != static_cast<std::size_t>(-1) || errno == E2BIG) continue;
      if (errno == EINVAL && !last) break;
      to += "\xEF\xBF\xBD";
      ++from;
      --left;
    }
    kept.erase(0, kept.size() - left);
  }

  iconv_t handle;
  std::string kept;
};

LogLines::LogLines(Source source, const TextEncoding& encoding) : source_(std::move(source)), read_(encoding.mark) {
  if (encoding.name != "UTF-8") decoder_ = std::make_unique<Decoder>(encoding.name);
}

LogLines::~LogLines() = default;

bool LogLines::refill() {
  if (ended_) return false;
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t before = buffer_.size();
  if (decoder_) {
    std::string bytes(kBlock, '\0');
    bytes.resize(source_.read(read_, bytes.data(), bytes.size()));
    read_ += bytes.size();
    ended_ = bytes.empty();
    decoder_->append(bytes, ended_, buffer_);
  } else {
    buffer_.resize(before + kBlock);
    buffer_.resize(before + source_.read(read_, buffer_.data() + before, kBlock));
    read_ += buffer_.size() - before;
    ended_ = buffer_.size() == before;
  }
  const auto fresh = buffer_.begin() + static_cast<std::ptrdiff_t>(before);
  if (std::memchr(buffer_.data() + before, '\0', buffer_.size() - before) != nullptr) {
    buffer_.erase(std::remove(fresh, buffer_.end(), '\0'), buffer_.end());
  }
  if (lines_ == 0 && before == 0) {  // one that ends its lines with a carriage return alone
    returns_ = buffer_.find('\n') == std::string::npos && buffer_.find('\r') != std::string::npos;
  }
  if (returns_) std::replace(buffer_.begin() + static_cast<std::ptrdiff_t>(before), buffer_.end(), '\r', '\n');
  return true;
}

namespace {

// Whether a cell in quotes goes on behind the line. It begins where a cell does: elsewhere a quote is an inch.
bool is_open_behind(std::string_view line, bool open) {
  for (std::size_t at = line.find('"'); at != std::string_view::npos; at = line.find('"', at + 1)) {
    if (open) {
      if (line.substr(at + 1).starts_with('"'))
        ++at;
      else
        open = false;
      continue;
    }
    const std::size_t before = line.substr(0, at).find_last_not_of(' ');
    open = before == std::string_view::npos || std::string_view(",;\t|").find(line[before]) != std::string_view::npos;
  }
  return open;
}

}  // namespace

bool LogLines::next(bool quotes) {
  std::size_t searched = at_, ends = 0;
  std::size_t first_end = 0;  // of the first line, from at_
  bool open = false;
  for (;;) {
    const char* const begin = buffer_.data() + searched;
    const auto* end = static_cast<const char*>(std::memchr(begin, '\n', buffer_.size() - searched));
    if (end == nullptr) {
      if (buffer_.size() - at_ > kLongestLine) {
        throw Error(
            fmt::format("{}:{}: expected lines of at most 4 MiB, found a longer one.", source_.name(), lines_ + 1));
      }
      const std::size_t done = searched - at_;
      if (refill()) {
        searched = at_ + done;
        continue;
      }
      if (at_ == buffer_.size()) return false;
      end = buffer_.data() + buffer_.size();
    }
    auto until = static_cast<std::size_t>(end - buffer_.data());
    if (quotes) open = is_open_behind(std::string_view(buffer_).substr(searched, until - searched), open);
    if (open) {
      if (ends == 0) first_end = until - at_;
      if (until < buffer_.size() && ends < kMostLinesOfCell) {
        ++ends;
        searched = until + 1;
        continue;
      }
      until = at_ + first_end;
      ends = 0;
    }
    if (lines_ % kLinesBetweenQuestions == 0) expect_no_interruption();
    const bool last = until == buffer_.size();
    line_ = std::string_view(buffer_).substr(at_, until - at_);
    while (line_.ends_with('\r')) line_.remove_suffix(1);
    if (!decoder_ && first_not_utf8(line_) != std::string_view::npos) {
      other_line_.clear();
      Decoder(kWestern).append(line_, true, other_line_);
      line_ = other_line_;
    }
    number_ = lines_ + 1;
    lines_ += ends + 1;
    at_ = last ? until : until + 1;
    return true;
  }
}

}  // namespace ballbar
