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

class PlainFile;

std::string sha256(std::string_view bytes);                     ///< 64 hexadecimal digits
std::string sha256_of_file(const std::filesystem::path& file);  ///< Errors: those of PlainFile

/// What one reading of a file finds.
struct DigestedFile {
  std::string sha256;        ///< of all its bytes
  std::string head;          ///< its first bytes
  std::string xxh3_of_rest;  ///< of the bytes behind those
  std::uint64_t size = 0;
};
/// Errors: those of PlainFile.
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
/// XXH3 of 64 bits, in one call: of pieces of a file whose whole has a digest of 128.
std::uint64_t xxh3_64(const void* bytes, std::size_t count);

}  // namespace dresslife::pipeline
