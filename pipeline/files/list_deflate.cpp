#include "pipeline/files/list_deflate.h"

#include <libdeflate.h>

#include <bit>
#include <cassert>
#include <new>

namespace dresslife::pipeline {

static_assert(std::endian::native == std::endian::little, "numbers are packed as they lie in memory");

ListDeflater::ListDeflater() {
  constexpr int fastest = 1;
  compressor_.reset(libdeflate_alloc_compressor(fastest));
  if (!compressor_) throw std::bad_alloc();
}

void ListDeflater::Free::operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }

void ListDeflater::pack(std::span<const std::uint32_t> numbers, std::vector<char>& chunk) {
  assert(!numbers.empty() && numbers.size() <= most_numbers);
  chunk.resize(libdeflate_zlib_compress_bound(compressor_.get(), numbers.size_bytes()));
  chunk.resize(
      libdeflate_zlib_compress(compressor_.get(), numbers.data(), numbers.size_bytes(), chunk.data(), chunk.size()));
}

Inflater::Inflater() {
  decompressor_.reset(libdeflate_alloc_decompressor());
  if (!decompressor_) throw std::bad_alloc();
}

void Inflater::Free::operator()(libdeflate_decompressor* decompressor) const {
  libdeflate_free_decompressor(decompressor);
}

bool Inflater::unpack(std::span<const char> chunk, std::span<char> bytes) {
  std::size_t* const exactly_as_many = nullptr;
  return libdeflate_zlib_decompress(decompressor_.get(), chunk.data(), chunk.size(), bytes.data(), bytes.size(),
                                    exactly_as_many) == LIBDEFLATE_SUCCESS;
}

}  // namespace dresslife::pipeline
