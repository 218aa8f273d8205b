#include "ballbar/internal/numerics/interruption.hpp"

#include <utility>

namespace ballbar {
namespace {

thread_local Interruption* of_thread = nullptr;

}  // namespace

Interruption::Interruption(std::function<void()> ask) : ask_(std::move(ask)), before_(std::exchange(of_thread, this)) {}

Interruption::~Interruption() { of_thread = before_; }

std::function<void()> Interruption::newest() { return of_thread == nullptr ? nullptr : of_thread->ask_; }

void expect_no_interruption() {
  if (of_thread != nullptr) of_thread->ask_();
}

}  // namespace ballbar
