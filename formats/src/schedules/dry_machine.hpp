// The machine of a dry run: its commands, independent of the language of a control.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/schedules/dry_run.hpp"
#include "text/located_text.hpp"

namespace ballbar {

class DryMachine {
 public:
  explicit DryMachine(const SourceText& text) : text_(text) {}

  std::size_t offset = 0;  // of the block that is read, for messages

  void set_speed(double rpm);
  void turn();
  void rest() { turns_ = false; }
  void orient();
  void wait(double duration_s, double longest_s);
  void stop(std::string_view message);
  void set_zero() { has_zero_ = true; }
  void set_feed(double feed_mm_per_min);
  void move(double x_mm, double y_mm);
  void circle(double x_mm, double y_mm, double centre_x_mm, double centre_y_mm, bool is_ccw);

  [[noreturn]] void fail(std::string_view sentence) const { fail_at(text_, offset, sentence); }
  double x_mm() const { return x_mm_.value_or(0.0); }
  double y_mm() const { return y_mm_; }
  const DryRun& run() const { return run_; }

 private:
  void expect_to_move(std::string_view what) const;

  SourceText text_;
  DryRun run_;
  bool turns_ = false, has_zero_ = false;
  double speed_rpm_ = 0.0, feed_mm_per_min_ = 0.0, y_mm_ = 0.0;
  std::optional<double> x_mm_;  // empty: where the operator left it
};

// Plain language, block by block.
DryRun dry_run_of_plain_language(const SourceText& text);

}  // namespace ballbar
