// Digests of bytes. SHA-256 identifies the inputs of a file. XXH3 of 128 bits detects damage and changes. XXH3 takes 0.1 s for a
// gigabyte. It detects accidents, but not forgeries.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace dresslife::pipeline {

class PlainFile;

std::string sha256(std::string_view bytes);  ///< 64 hexadecimal digits

/// Results of one reading of a file.
struct DigestedFile {
  std::string sha256;        ///< of all bytes
  std::string head;          ///< the first bytes
  std::string xxh3_of_rest;  ///< of the bytes behind `head`
  std::uint64_t size = 0;
};
/// Reads a file once; `head_bytes` is the length of `head`. Errors: those of PlainFile.
DigestedFile digested_file(const std::filesystem::path& file, std::size_t head_bytes);

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
std::string xxh3_of_file(const std::filesystem::path& file);  ///< Errors: those of PlainFile
std::string xxh3_of(const PlainFile& file);                   ///< Errors: DiskError
/// Returns XXH3 of 64 bits, computed in one call. It is used for pieces of a file that also has a digest of 128 bits.
std::uint64_t xxh3_64(const void* bytes, std::size_t count);

}  // namespace dresslife::pipeline
