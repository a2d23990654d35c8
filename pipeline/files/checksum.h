// The checksum of our files. HDF5 leaves the first 512 bytes of a file to its user ("user block"); in ours
// they say, as text, how many bytes follow and what their XXH3 digest is:
//
//   dresslife file
//   xxh3-128 0123456789abcdef0123456789abcdef of 1234567 bytes after these 512
//
// and are filled up with line feeds. Every bit of the file counts: of these lines because they are compared
// as a whole, of the rest through the digest. Other HDF5 programs pass over the block.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {

inline constexpr std::uint64_t checksum_block_bytes = 512;

/// The block in front of so many bytes with this XXH3 digest.
std::string checksum_block(const std::string& digest, std::uint64_t bytes);

/// Digests what has been written so far after the block and writes the block. Returns the digest.
/// Errors: InputError when the file cannot be read back or written.
std::string write_checksum(WholeFile& file);

/// A file that is being read. Errors: InputError when it cannot be opened.
class InputBytes {
 public:
  InputBytes() = default;
  explicit InputBytes(const std::filesystem::path& file);
  ~InputBytes();
  InputBytes(InputBytes&& other) noexcept;
  InputBytes& operator=(InputBytes&& other) noexcept;

  int descriptor() const { return descriptor_; }
  /// What the block says; empty for a file that begins without one. Errors: InputError when the block is
  /// damaged or tells of another length.
  std::string read_checksum(const std::string& remedy) const;
  /// Errors: InputError when the bytes are not those of the checksum.
  void check(const std::string& checksum, const std::string& remedy) const;

 private:
  std::filesystem::path name_;
  int descriptor_ = -1;
};

/// The digest that a file's block tells, its bytes unread; of a file without a block, the digest of all its
/// bytes. Nothing when there is no file or its block is damaged.
std::optional<std::string> told_checksum(const std::filesystem::path& file);

/// The digest that a file's block tells, if the file is just that; of a file without a block, the digest of
/// all its bytes. Nothing when there is no file or it is damaged.
std::optional<std::string> checksum_of(const std::filesystem::path& file);

bool begins_with_checksum(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
