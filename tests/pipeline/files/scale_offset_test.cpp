#include "pipeline/files/scale_offset.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "tests/catch.h"

namespace dresslife::pipeline {
namespace {

template <class T>
std::vector<T> through(const std::vector<T>& numbers, int decimals, std::size_t* bytes = nullptr) {
  std::vector<char> chunk;
  pack_chunk(numbers, decimals, chunk);
  if (bytes) *bytes = chunk.size();
  std::vector<T> back(numbers.size());
  REQUIRE(unpack_chunk(chunk, decimals, std::span(back)));
  return back;
}

}  // namespace

TEST_CASE("scale-offset: the bytes are those of the filter's layout") {
  std::vector<char> chunk;
  pack_chunk(std::vector<float>{7, 12, 5, 9}, 0, chunk);  // relative to 5: 2 7 0 4, three bits each
  std::vector<char> expected(21, 0);
  expected[0] = 3;
  expected[4] = 8;
  expected[7] = static_cast<char>(0xA0);  // 5 as a float: 40 A0 00 00
  expected[8] = 0x40;
  expected.push_back(static_cast<char>(0b01011100));
  expected.push_back(static_cast<char>(0b01000000));
  CHECK(chunk == expected);
}

TEST_CASE("scale-offset: whole numbers of any span come back, in as many bits as it takes") {
  std::mt19937 random(1);
  for (int bits = 0; bits < 23; ++bits)  // all digits of a float
    for (const std::size_t count : {1, 31, 32, 1000}) {
      std::vector<float> numbers(count);
      for (float& number : numbers) number = 12345 + static_cast<float>(random() % (1u << bits));
      std::size_t bytes = 0;
      CHECK(through(numbers, 0, &bytes) == numbers);
      CHECK(bytes <= 21 + count * bits / 8 + 1);
    }
}

TEST_CASE("scale-offset: floats are kept to half a unit of the last decimal") {
  std::mt19937 random(2);
  for (const int decimals : {0, 3, 7})
    for (const float span : {0.0f, 1e-3f, 0.1f, 0.7f}) {
      std::uniform_real_distribution<float> anywhere(-0.3f * span, 0.7f * span);
      std::vector<float> numbers(777);
      for (float& number : numbers) number = anywhere(random);
      const std::vector<float> back = through(numbers, decimals);
      // half a step, and rounding of the difference, the product and the sum
      const double kept = 0.5 * std::pow(10.0, -decimals) + 4 * std::numeric_limits<float>::epsilon() * span;
      for (std::size_t k = 0; k < numbers.size(); ++k) REQUIRE(std::abs(back[k] - numbers[k]) <= kept);
    }
}

TEST_CASE("scale-offset: floats too far apart for their decimals are kept as they are") {
  const std::vector<float> numbers{-1e30f, 3.25f, 1e-12f, 2e30f, 0};
  CHECK(through(numbers, 7) == numbers);
}

TEST_CASE("scale-offset: doubles come back, in as many bits as their span takes") {
  std::mt19937_64 random(3);
  for (int bits = 0; bits <= 52; ++bits)  // all digits of a double
    for (const std::size_t count : {1, 2, 8, 9, 1000}) {
      std::vector<double> numbers(count);
      for (double& number : numbers) number = static_cast<double>(random() % (std::uint64_t{1} << bits));
      std::size_t bytes = 0;
      CHECK(through(numbers, 0, &bytes) == numbers);
      CHECK(bytes <= 21 + count * static_cast<std::size_t>(bits) / 8 + 1);
    }
  for (const double span : {0.0, 1e-6, 2.5, 1e4}) {
    std::uniform_real_distribution<double> anywhere(-0.3 * span, 0.7 * span);
    std::vector<double> numbers(777);
    for (double& number : numbers) number = anywhere(random);
    const std::vector<double> back = through(numbers, 11);
    // half a step, and rounding of the difference, the product and the sum
    const double kept = 0.5e-11 + 4 * std::numeric_limits<double>::epsilon() * span;
    for (std::size_t k = 0; k < numbers.size(); ++k) REQUIRE(std::abs(back[k] - numbers[k]) <= kept);
  }
  const std::vector<double> apart{-1e300, 3.25, 1e-12, 2e300, 0};
  CHECK(through(apart, 11) == apart);
}

TEST_CASE("scale-offset: a chunk that is cut off or claims impossible bits is refused") {
  const auto refused = [](const auto number, std::initializer_list<int> too_short,
                          std::initializer_list<int> impossible) {
    std::vector<char> chunk;
    std::vector back(64, number);
    pack_chunk(back, 0, chunk);
    CHECK_FALSE(unpack_chunk(std::span(chunk).first(20), 0, std::span(back)));
    const auto claim = [&](int bits) {
      std::memcpy(chunk.data(), &bits, sizeof(bits));
      CHECK_FALSE(unpack_chunk(chunk, 0, std::span(back)));
    };
    for (const int bits : too_short) claim(bits);
    chunk.resize(1000);  // long enough for every number of bits
    for (const int bits : impossible) claim(bits);
  };
  refused(5.0f, {1, 32}, {33, -1});
  refused(5.0, {1, 64}, {53, 63, 65, -1});
}

}  // namespace dresslife::pipeline
