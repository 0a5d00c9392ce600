// The libFuzzer program of one target: FJORD_FUZZ_RUN is its function.
#include <google/protobuf/stubs/logging.h>

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/harness.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  google::protobuf::SetLogHandler(nullptr);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fjord::fuzz::FJORD_FUZZ_RUN({reinterpret_cast<const char*>(data), size});
  return 0;
}
