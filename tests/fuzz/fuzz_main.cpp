// The libFuzzer program of one target, chosen by FJORD_FUZZ_TARGET.
#include <cstddef>
#include <cstdint>

#include "engine/base/check.h"
#include "tests/fuzz/harness.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  fjord::fuzz::Prepare();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fjord::fuzz::Target* const target = fjord::fuzz::FindTarget(FJORD_FUZZ_TARGET);
  FJORD_CHECK(target != nullptr, FJORD_FUZZ_TARGET);
  target->run({reinterpret_cast<const char*>(data), size});
  return 0;
}
