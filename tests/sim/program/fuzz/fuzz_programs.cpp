// Entry point of libFuzzer: any bytes as a program of the language FUZZ_READER, or as a URDF. It writes the sample of
// the tests to the corpus as the first input. Not part of the tests; built by scripts/fuzz.
#include <fstream>

#include "tests/sim/program/fuzz_target.h"
#include "tests/sim/program/samples.h"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
#ifdef FUZZ_URDF
  std::ofstream("corpus/sample") << dresslife::tests::palletizer;
#else
  for (const auto& [language, text] : dresslife::tests::samples())
    if (language == dresslife::sim::Language::FUZZ_READER) std::ofstream("corpus/sample") << text;
#endif
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
#ifdef FUZZ_URDF
  const std::string fault = dresslife::tests::fault_of_urdf(text);
#else
  const std::string fault = dresslife::tests::fault_of_reading(dresslife::sim::Language::FUZZ_READER, text);
#endif
  if (!fault.empty()) std::abort();
  return 0;
}
