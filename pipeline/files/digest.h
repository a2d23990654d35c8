// Fingerprints of bytes: SHA-256, by which files name their inputs, and XXH3 of 128 bits, by which damage and
// change are noticed. XXH3 takes a tenth of a second for a gigabyte; it guards against accidents, not against
// forgers.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

std::string sha256(std::string_view bytes);                     ///< 64 hexadecimal digits
std::string sha256_of_file(const std::filesystem::path& file);  ///< Errors: InputError when it cannot be read

/// XXH3, 128 bits, as 32 hexadecimal digits.
class Xxh3 {
 public:
  Xxh3();
  ~Xxh3();
  void add(const void* bytes, std::size_t count);
  std::string hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::string xxh3(std::string_view bytes);
std::string xxh3_of_file(const std::filesystem::path& file);  ///< Errors: InputError when it cannot be read
/// Of the bytes [begin, end) of an open file; empty when they cannot be read.
std::string xxh3_of_range(int descriptor, std::uint64_t begin, std::uint64_t end);

}  // namespace dresslife::pipeline
