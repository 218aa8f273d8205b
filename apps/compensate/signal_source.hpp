// Bytes of signals as they come: from the standard input, a file, or a file that a logger still writes.
#pragma once

#include <array>
#include <csignal>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "ballbar/formats/models/compensation_state.hpp"

namespace ballbar {

class SignalSource {
 public:
  // "-": the standard input. follow: waits at the end of a file for more. silence_s: how long nothing may come before
  // that is said. `stop` ends the waiting. Throws Error where it cannot be opened.
  SignalSource(const std::string& name, bool follow, double silence_s, const volatile std::sig_atomic_t& stop);
  ~SignalSource();
  SignalSource(const SignalSource&) = delete;
  SignalSource& operator=(const SignalSource&) = delete;

  // What has come, until the next call; empty: no more will, or another file has taken the name. Throws Error where
  // reading fails, or the file became shorter than what was read of it.
  std::string_view read();

  // With follow: another file has taken the name, as where logs are rotated. Then read() goes on with that.
  bool reopened();

  // Which file this is, at 0 bytes; nothing for what is no regular file.
  std::optional<SignalsPlace> place() const;

 private:
  void open_file();
  bool replaced() const;
  void expect_grows() const;
  void wait(double& waited_s) const;

  std::string name_;
  bool follow_ = false;
  double silence_s_ = 0.0;
  const volatile std::sig_atomic_t& stop_;
  int descriptor_ = 0;
  bool reopened_ = false;
  std::array<char, std::size_t{64} << 10> piece_{};
};

}  // namespace ballbar
