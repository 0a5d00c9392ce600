// Preloaded into a program, spoils the floating-point environment wherever a library can: before
// main, in every new thread, and when a library is loaded. FJORD_SPOIL says how: up, down, zero
// (SSE rounding), flush (denormals to zero), x87 (the C library rounds decimal numbers up).
#include <dlfcn.h>
#include <pthread.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace {

void Spoil() {
  const char* how = std::getenv("FJORD_SPOIL");
  if (how == nullptr) return;
#if defined(__x86_64__)
  const auto is = [how](const char* word) { return std::strcmp(how, word) == 0; };
  constexpr unsigned kMasked = 0x1f80;
  if (is("down")) _mm_setcsr(kMasked | 0x2000);
  if (is("up")) _mm_setcsr(kMasked | 0x4000);
  if (is("zero")) _mm_setcsr(kMasked | 0x6000);
  if (is("flush")) _mm_setcsr(kMasked | 0x8040);
  if (is("x87")) {
    const uint16_t word = 0x37f | 0x800;
    __asm__ volatile("fldcw %0" : : "m"(word));
  }
#endif
}

__attribute__((constructor)) void BeforeMain() { Spoil(); }

struct Start {
  void* (*run)(void*);
  void* argument;
};

void* RunSpoiled(void* start) {
  const Start own = *static_cast<Start*>(start);
  delete static_cast<Start*>(start);
  Spoil();
  return own.run(own.argument);
}

template <typename Function>
Function Next(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*run)(void*), void* argument) {
  static const auto kCreate = Next<decltype(&pthread_create)>("pthread_create");
  return kCreate(thread, attributes, RunSpoiled, new Start{run, argument});
}

extern "C" void* dlopen(const char* path, int flags) {
  static const auto kOpen = Next<decltype(&dlopen)>("dlopen");
  void* const library = kOpen(path, flags);
  Spoil();
  return library;
}
