#include "pipeline/files/list_deflate.h"

#include <numeric>
#include <random>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/pipeline/files/library.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

using Numbers = std::vector<std::uint32_t>;

/// Writes the numbers packed, and reads them with this program and with the library.
Numbers packed_and_read(const Numbers& numbers) {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/a", Type::u32, {"sample"}, "1", ""}};
  format.datasets[0].lists = true;
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/a", std::span<const std::uint32_t>(numbers));
    writer.commit();
  }
  const Numbers read = FileReader(scratch / "f.h5", format).read<std::uint32_t>("/a");
  CHECK(read == read_by_library<std::uint32_t>(scratch / "f.h5", "/a", H5T_NATIVE_UINT32));
  return read;
}

double bits_a_number(const Numbers& numbers) {
  ListDeflater deflater;
  std::vector<char> chunk;
  deflater.pack(numbers, chunk);
  return 8.0 * static_cast<double>(chunk.size()) / static_cast<double>(numbers.size());
}

/// Returns lists like those of adjacent wires: between successive lists one number in `every` changes, is added or removed.
Numbers similar_lists(std::size_t count, std::size_t every, std::uint32_t step) {
  std::mt19937 random(5);
  Numbers list{0}, all;
  while (list.size() < 350) list.push_back(list.back() + 1 + random() % (2 * step));
  while (all.size() < count) {
    all.insert(all.end(), list.begin(), list.end());
    for (std::size_t k = 1; k + 1 < list.size(); ++k) {
      if (random() % every) continue;
      const auto at = list.begin() + static_cast<std::ptrdiff_t>(k);
      const auto kind = random() % 3;
      if (kind == 0)
        list.erase(at);
      else if (kind == 1 && *at + 1 < at[1])
        ++*at;
      else if (*at > at[-1] + 1)
        list.insert(at, *at - 1);
    }
  }
  all.resize(count);
  return all;
}

}  // namespace

TEST_CASE("list deflate: any numbers come back through the HDF5 library") {
  std::mt19937 random(3);
  for (const std::size_t count : {1, 2, 5, 1000, 1 << 15, 70001}) {
    CAPTURE(count);
    Numbers same(count, 7), falling(count), wild(count), wide(count);
    std::iota(falling.rbegin(), falling.rend(), 0u);
    for (std::uint32_t& number : wild) number = static_cast<std::uint32_t>(random());
    for (std::uint32_t& number : wide) number = static_cast<std::uint32_t>(random() % 3 * 65536 + random() % 4);
    Numbers rising(falling.rbegin(), falling.rend());
    for (const Numbers& numbers : {same, falling, rising, wild, wide}) CHECK(packed_and_read(numbers) == numbers);
  }
}

TEST_CASE("list deflate: lists that differ a little come back, whatever lengths their copies have") {
  for (const std::size_t every : {2, 5, 20, 80, 100000})
    for (const std::uint32_t step : {1, 13, 700}) {
      const Numbers numbers = similar_lists(70001, every, step);
      CHECK(packed_and_read(numbers) == numbers);
    }
}

TEST_CASE("list deflate: what departs from the list before is what costs") {
  const std::size_t count = ListDeflater::most_numbers;
  // A change every 80 numbers: one number of 32 bits, or the two around it, then two copies (one holds at most 258 bytes) of
  // about 24 bits. The first list is stored completely.
  CHECK(bits_a_number(similar_lists(count, 80, 13)) < (1.5 * 32 + 2 * 24) / 80 + 32.0 * 350 / count);
  Numbers wild(count);
  std::mt19937 random(3);
  for (std::uint32_t& number : wild) number = static_cast<std::uint32_t>(random());
  CHECK(bits_a_number(wild) < 32 + 0.1);  // numbers that do not repeat are stored unpacked
}

}  // namespace dresslife::pipeline
