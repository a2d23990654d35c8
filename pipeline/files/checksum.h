// Checksum of our files. HDF5 reserves the first 512 bytes of a file for its user ("user block"). In our files this block
// contains text with the number of the following bytes and their XXH3 digest,
//
//   dresslife file
//   xxh3-128 0123456789abcdef0123456789abcdef of 1234567 bytes after these 512
//
// filled up with line feeds. Every bit of the file is checked: these lines by a comparison of the whole block, the rest by the
// digest. Other HDF5 programs skip the block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {

inline constexpr std::uint64_t checksum_block_bytes = 512;

/// Returns the block for `bytes` bytes with this XXH3 digest.
std::string checksum_block(const std::string& digest, std::uint64_t bytes);

/// Computes the digest of all bytes behind the block, writes the block, and reads the bytes back in the way of its readers.
/// Returns the digest. Errors: InputError if the file cannot be written, or if other bytes are read back.
std::string write_checksum(WholeFile& file);

/// A file that is read with a check of every byte. check() stores a digest of each block, and every later read is compared with
/// these digests. A block is a quarter of the bytes that check() reads at once. The digests take 0.05 % of the file's size.
class InputBytes {
 public:
  InputBytes() = default;
  /// Errors: those of PlainFile.
  explicit InputBytes(const std::filesystem::path& file);

  std::uint64_t size() const { return file_.size(); }
  /// Returns the digest in the block; empty for a file without a block. Errors: InputError if the block is damaged or states
  /// another length; DiskError.
  std::string read_checksum(const std::string& remedy) const;
  /// Errors: InputError if the bytes do not match the checksum; DiskError.
  void check(const std::string& checksum, const std::string& remedy);
  /// Returns the digest of all bytes. Errors: DiskError.
  std::string digest() const;

  /// Reads bytes for a library that cannot handle exceptions. Returns false if they cannot be read or have changed since check().
  /// The first failure is stored.
  bool read(void* bytes, std::size_t count, std::uint64_t address) noexcept;
  /// Errors: DiskError or InputError if a read has failed.
  void check_reads() const;

 private:
  static constexpr std::size_t block_bytes = 1 << 14;
  Where where() const;
  std::size_t bytes_of(std::uint64_t block) const;
  /// Returns whether the bytes of a whole block match its digest.
  bool is_as_checked(const char* bytes, std::uint64_t block) noexcept;
  bool read_plainly(void* bytes, std::size_t count, std::uint64_t address) noexcept;
  /// Reads bytes of one block.
  bool read_part(char* bytes, std::size_t count, std::uint64_t address) noexcept;

  enum class Failure { none, unread, changed };
  PlainFile file_;
  std::vector<std::uint64_t> digests_;  ///< (block); empty: reads are not checked
  std::vector<char> block_;             ///< the last block of which a part was read
  std::uint64_t block_at_ = ~std::uint64_t{0};
  Failure failure_ = Failure::none;
  int error_ = 0;
};

/// Returns the digest that the file's block states, without reading the other bytes. For a file without a block, returns the
/// digest of all bytes. std::nullopt if there is no file, or its block is damaged. Errors: DiskError.
std::optional<std::string> stored_checksum(const std::filesystem::path& file);

/// Returns SHA-256 of a file and compares the bytes with the file's own checksum, if it has one. Errors: InputError if the bytes
/// do not match the checksum; DiskError.
std::string sha256_as_checked(const std::filesystem::path& file);
/// Returns the digest that the file's block states, if the bytes match it. For a file without a block, returns the digest of all
/// bytes. std::nullopt if there is no file, or it is damaged. Errors: DiskError.
std::optional<std::string> checksum_of(const std::filesystem::path& file);

/// Returns whether a plain file begins with a checksum. Errors: DiskError.
bool begins_with_checksum(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
