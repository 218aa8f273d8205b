#include "ballbar/numerics/interruption.hpp"

#include <utility>

namespace ballbar {
namespace {

thread_local Interruption* newest = nullptr;

}  // namespace

Interruption::Interruption(std::function<void()> ask) : ask_(std::move(ask)), before_(std::exchange(newest, this)) {}

Interruption::~Interruption() { newest = before_; }

void expect_no_interruption() {
  if (newest != nullptr) newest->ask_();
}

}  // namespace ballbar
