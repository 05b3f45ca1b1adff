// Preloaded before the program: memory that runs out at a call of one's choice. UNDEX_FAIL_AT=n: the n-th alone,
// UNDEX_FAIL_FROM=n: every one from it on. UNDEX_COUNT=file: how many there were. Counted are operator new and aligned_alloc.
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> calls{0};

long number(const char* name) {
  const char* text = std::getenv(name);
  return text ? std::atol(text) : 0;
}

/// Set when this library is, which is after those that the program is linked with: what they need for that is not the program's.
const long at = number("UNDEX_FAIL_AT"), from = number("UNDEX_FAIL_FROM");

bool fails() {
  const long mine = ++calls;
  return mine == at || (from > 0 && mine >= from);
}

struct Count {
  Count() { calls = 0; }
  ~Count() {
    const char* name = std::getenv("UNDEX_COUNT");
    if (std::FILE* file = name ? std::fopen(name, "w") : nullptr) {
      std::fprintf(file, "%ld\n", calls.load());
      std::fclose(file);
    }
  }
} count;

}  // namespace

extern "C" void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  void* memory = nullptr;
  return fails() || posix_memalign(&memory, alignment, size) != 0 ? nullptr : memory;
}

void* operator new(std::size_t size) {
  if (!fails())
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
  throw std::bad_alloc();
}
void* operator new[](std::size_t size) { return operator new(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
