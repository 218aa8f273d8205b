#include "heap_peak.hpp"

#include <malloc.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>

namespace {

std::atomic<std::size_t> in_use{0};
std::atomic<std::size_t> peak{0};

void* counted(void* block) {
  if (!block) return block;
  const std::size_t size = malloc_usable_size(block);
  const std::size_t now = in_use.fetch_add(size) + size;
  std::size_t before = peak.load();
  while (now > before && !peak.compare_exchange_weak(before, now)) {
  }
  return block;
}

void forget(void* block) {
  if (block) in_use.fetch_sub(malloc_usable_size(block));
}

}  // namespace

// The C library's own, under the names it keeps for programs that replace them.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) { return counted(__libc_malloc(size)); }

void free(void* block) {
  forget(block);
  __libc_free(block);
}

void* calloc(std::size_t count, std::size_t size) { return counted(__libc_calloc(count, size)); }

void* realloc(void* old, std::size_t size) {
  forget(old);
  return counted(__libc_realloc(old, size));
}

void* memalign(std::size_t alignment, std::size_t size) { return counted(__libc_memalign(alignment, size)); }

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = memalign(alignment, size);
  return *block ? 0 : ENOMEM;
}
}

namespace ballbar::bench {

std::size_t heap_in_use() { return in_use.load(); }
std::size_t heap_peak() { return peak.load(); }
void restart_heap_peak() { peak.store(in_use.load()); }

}  // namespace ballbar::bench
