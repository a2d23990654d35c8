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
#include <vector>

#include "pipeline/base/whole_file.h"

namespace dresslife::pipeline {

inline constexpr std::uint64_t checksum_block_bytes = 512;

/// The block in front of so many bytes with this XXH3 digest.
std::string checksum_block(const std::string& digest, std::uint64_t bytes);

/// Digests what has been written so far after the block, writes the block, and reads all of it as its readers will.
/// Returns the digest. Errors: InputError when the file cannot be written or read back as it was.
std::string write_checksum(WholeFile& file);

/// A file that is being read, each byte of it as it was checked: check() notes a digest of each block of it, to which
/// every later read is held. A block is a quarter of what a reader takes at once; the digests take 0.05 % of the file.
class InputBytes {
 public:
  InputBytes() = default;
  /// Errors: those of PlainFile.
  explicit InputBytes(const std::filesystem::path& file);

  std::uint64_t size() const { return file_.size(); }
  /// What the block says; empty for a file that begins without one. Errors: InputError when the block is
  /// damaged or names another length; DiskError.
  std::string read_checksum(const std::string& remedy) const;
  /// Errors: InputError when the bytes are not those of the checksum; DiskError.
  void check(const std::string& checksum, const std::string& remedy);
  /// Digest of all bytes. Errors: DiskError.
  std::string digest() const;

  /// For a library that cannot be thrown through: false when not all can be read as it was checked. The first failure
  /// is kept.
  bool read(void* bytes, std::size_t count, std::uint64_t address) noexcept;
  /// Errors: DiskError or InputError when a read has failed.
  void check_reads() const;

 private:
  static constexpr std::size_t block_bytes = 1 << 14;
  Where where() const;
  std::size_t bytes_of(std::uint64_t block) const;
  /// Of bytes of a whole block.
  bool is_as_checked(const char* bytes, std::uint64_t block) noexcept;
  bool read_plainly(void* bytes, std::size_t count, std::uint64_t address) noexcept;
  /// Of one block.
  bool read_part(char* bytes, std::size_t count, std::uint64_t address) noexcept;

  enum class Failure { none, unread, changed };
  PlainFile file_;
  std::vector<std::uint64_t> digests_;  ///< (block) empty: nothing is checked
  std::vector<char> block_;             ///< the last one that was read for a part of it
  std::uint64_t block_at_ = ~std::uint64_t{0};
  Failure failure_ = Failure::none;
  int error_ = 0;
};

/// The digest that a file's block names, its bytes unread; of a file without a block, the digest of all its
/// bytes. Nothing when there is no file or its block is damaged. Errors: DiskError.
std::optional<std::string> stored_checksum(const std::filesystem::path& file);

/// SHA-256 of a file, by a reading that is held to the file's own checksum. A file without one is digested as it is.
/// Errors: InputError when the bytes read are not those of the checksum; DiskError.
std::string sha256_as_checked(const std::filesystem::path& file);
/// The digest that a file's block names, if the file is just that; of a file without a block, the digest of
/// all its bytes. Nothing when there is no file or it is damaged. Errors: DiskError.
std::optional<std::string> checksum_of(const std::filesystem::path& file);

/// Of a plain file. Errors: DiskError.
bool begins_with_checksum(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
