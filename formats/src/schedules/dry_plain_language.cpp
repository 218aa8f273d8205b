#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "schedules/dry_machine.hpp"

namespace ballbar {
namespace {

constexpr double kLongestCycle9_s = 3600.0;

// The blocks of such a program, one after the other.
class PlainLanguage {
 public:
  explicit PlainLanguage(DryMachine& machine) : machine_(machine) {}

  // `block` without its number. True where it ends the program.
  bool is_end(std::string_view block) {
    if (waits_ && !block.starts_with("CYCL DEF 9.1 DWELL "))
      machine_.fail("expected CYCL DEF 9.1, found another block.");
    rest_ = block;
    if (taken("; ")) {
      comment_ = rest_;
      rest_ = {};
    } else if (block == "CYCL DEF 9.0 DWELL TIME") {
      waits_ = true;
      rest_ = {};
    } else if (waits_ && taken("CYCL DEF 9.1 DWELL ")) {
      waits_ = false;
      machine_.wait(number(), kLongestCycle9_s);
    } else if (taken("TOOL CALL Z S")) {
      machine_.set_speed(number());
    } else if (block == "CYCL DEF 13.0 ORIENTATION" || block == "CYCL DEF 13.1 ANGLE 0") {
      rest_ = {};  // M19 does it
    } else if (taken("L X")) {
      const double x_mm = number(), y_mm = after(" Y");
      machine_.set_feed(after(" R0 F"));
      machine_.move(x_mm, y_mm);
    } else if (taken("CC X")) {
      centre_x_mm_ = number();
      centre_y_mm_ = after(" Y");
    } else if (taken("C X")) {
      const double x_mm = number(), y_mm = after(" Y");
      if (rest_ != " DR+" && rest_ != " DR-")
        machine_.fail(fmt::format("expected DR+ or DR-, found {}.", in_quotes(rest_)));
      machine_.circle(x_mm, y_mm, centre_x_mm_, centre_y_mm_, rest_ == " DR+");
      rest_ = {};
    } else if (taken("M")) {
      return function();
    } else {
      machine_.fail(fmt::format("expected a block of such a program, found {}.", in_quotes(block)));
    }
    expect_end();
    return false;
  }

 private:
  bool taken(std::string_view beginning) {
    if (!rest_.starts_with(beginning)) return false;
    rest_.remove_prefix(beginning.size());
    return true;
  }

  void expect_end() const {
    if (!rest_.empty()) machine_.fail(fmt::format("expected the end of the block, found {}.", in_quotes(rest_)));
  }

  double number() {
    std::string_view digits = rest_;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::fixed);
    if (error != std::errc{} || !(value == value)) {
      machine_.fail(fmt::format("expected a number, found {}.", in_quotes(rest_)));
    }
    rest_ = digits.substr(static_cast<std::size_t>(end - digits.data()));
    return value;
  }

  double after(std::string_view word) {
    if (!taken(word)) machine_.fail(fmt::format("expected {}, found {}.", word.substr(1), in_quotes(rest_)));
    return number();
  }

  bool function() {
    const double m = number();
    expect_end();
    if (m == 3.0) {
      machine_.turn();
    } else if (m == 5.0) {
      machine_.rest();
    } else if (m == 19.0) {
      machine_.orient();
    } else if (m == 0.0) {
      machine_.stop(comment_);
    } else if (m != 30.0 && (m < 40.0 || m > 49.0)) {
      machine_.fail(fmt::format("expected an M function of such a program, found M{}.", m));
    }
    return m == 30.0;
  }

  DryMachine& machine_;
  std::string_view rest_, comment_;
  bool waits_ = false;
  double centre_x_mm_ = 0.0, centre_y_mm_ = 0.0;
};

}  // namespace

DryRun dry_run_of_plain_language(const SourceText& text) {
  DryMachine machine(text);
  machine.set_zero();  // the preset, which is always one
  PlainLanguage blocks(machine);
  bool ended = false;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.bytes.size() && !ended; ++number) {
    const std::string_view line = text.bytes.substr(at, text.bytes.find('\n', at) - at);
    machine.offset = at;
    const std::string expected = fmt::format("{} ", number);
    if (!line.starts_with(expected)) {
      machine.fail(fmt::format("expected block {}, found {}.", number, in_quotes(line)));
    }
    const std::string_view block = line.substr(expected.size());
    if (number > 0) {
      ended = blocks.is_end(block);
    } else if (!block.starts_with("BEGIN PGM ") || !block.ends_with(" MM")) {
      machine.fail(fmt::format("expected BEGIN PGM NAME MM, found {}.", in_quotes(block)));
    }
    at += line.size() + 1;
  }
  if (!ended) {
    machine.offset = text.bytes.size();
    machine.fail("expected M30, found the end of the text.");
  }
  return machine.run();
}

}  // namespace ballbar
