// libFuzzer's entry: the first byte chooses the language, the rest is the program. Not part of the tests;
// built by scripts/fuzz.
#include "tests/program/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size == 0) return 0;
  const auto language = static_cast<dresslife::sim::Language>(data[0] % 5);
  const std::string text(reinterpret_cast<const char*>(data + 1), size - 1);
  if (!dresslife::tests::fault_of_reading(language, text).empty()) std::abort();
  return 0;
}
