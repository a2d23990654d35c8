#include "pipeline/files/checksum.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "pipeline/base/digest.h"
#include "pipeline/base/errors.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view first_line = "dresslife file\n";
constexpr std::string_view before_digest = "xxh3-128 ", before_bytes = " of ";
constexpr std::size_t digest_digits = 32;
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

}  // namespace

std::string checksum_block(const std::string& digest, std::uint64_t bytes) {
  std::string block(first_line);
  block +=
      fmt::format("{}{}{}{} bytes after these {}", before_digest, digest, before_bytes, bytes, checksum_block_bytes);
  block.resize(checksum_block_bytes, '\n');
  return block;
}

namespace {

struct Promise {
  std::string digest;
  std::uint64_t bytes = 0;
};

/// Returns the content of a block, if every byte of it is correct.
std::optional<Promise> promise_of(const std::string& block) {
  constexpr std::size_t digest_at = first_line.size() + before_digest.size();
  constexpr std::size_t bytes_at = digest_at + digest_digits + before_bytes.size();
  Promise promise{block.substr(digest_at, digest_digits), 0};
  std::from_chars(block.data() + bytes_at, block.data() + block.size(), promise.bytes);
  if (checksum_block(promise.digest, promise.bytes) != block) return std::nullopt;
  return promise;
}

}  // namespace

std::string write_checksum(WholeFile& file) {
  const std::int64_t size = state_of(file.descriptor(), file.final_name()).size;
  const auto refuse = [&](const std::string& what) {
    throw MachineFault({file.final_name().string()}, fmt::format("cannot be read back ({})", what), "check the disk");
  };
  const auto digest_read_back = [&](std::int64_t begin) {
    Xxh3 digest;
    std::vector<char> bytes(1 << 16);
    for (std::int64_t at = begin; at < size;) {
      const auto count = std::min(static_cast<std::int64_t>(bytes.size()), size - at);
      if (!read_at(file.descriptor(), bytes.data(), static_cast<std::size_t>(count), static_cast<std::uint64_t>(at)))
        refuse(std::strerror(errno));
      digest.add(bytes.data(), static_cast<std::size_t>(count));
      at += count;
    }
    return digest.hex();
  };
  constexpr auto behind_the_block = static_cast<std::int64_t>(checksum_block_bytes);
  const std::string digest = digest_read_back(behind_the_block);
  const std::string block = checksum_block(digest, static_cast<std::uint64_t>(size) - checksum_block_bytes);
  file.write_at(block.data(), block.size(), 0);
  if (digest_read_back(behind_the_block) != digest) refuse("twice the same bytes were not the same");
  return digest;
}

InputBytes::InputBytes(const std::filesystem::path& file) : file_(file) {}

std::string InputBytes::read_checksum(const std::string& remedy) const {
  std::string block = file_.beginning(checksum_block_bytes + hdf5_signature.size());
  const bool block_before = block.ends_with(hdf5_signature) && block.size() > checksum_block_bytes;
  block.resize(std::min<std::size_t>(block.size(), checksum_block_bytes));
  if (!block.starts_with(first_line) && !block_before) return "";
  const std::optional<Promise> promise = block.size() == checksum_block_bytes ? promise_of(block) : std::nullopt;
  if (!promise) throw MachineFault(where(), "is damaged (its first 512 bytes are no checksum)", remedy);
  if (promise->bytes + checksum_block_bytes != size())
    throw MachineFault(where(),
                       fmt::format("is cut off or has grown (it has {} bytes and promises {})", size(),
                                   promise->bytes + checksum_block_bytes),
                       remedy);
  return promise->digest;
}

void InputBytes::check(const std::string& checksum, const std::string& remedy) {
  if (checksum.empty()) return;
  Xxh3 all;
  std::vector<std::uint64_t> digests;
  std::vector<char> bytes(4 * block_bytes);
  for (std::uint64_t at = 0; at < size(); at += bytes.size()) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(bytes.size(), size() - at));
    file_.read(bytes.data(), count, at);
    const std::size_t skipped = at == 0 ? checksum_block_bytes : 0;
    all.add(bytes.data() + skipped, count - skipped);
    for (std::size_t k = 0; k < count; k += block_bytes)
      digests.push_back(xxh3_64(bytes.data() + k, std::min(block_bytes, count - k)));
  }
  if (all.hex() != checksum)
    throw MachineFault(where(), "is damaged or was edited (its bytes are not those of its checksum)", remedy);
  digests_ = std::move(digests);
  block_.resize(block_bytes);
}

std::string InputBytes::digest() const { return xxh3_of(file_); }

Where InputBytes::where() const { return {file_.name().string()}; }

std::size_t InputBytes::bytes_of(std::uint64_t block) const {
  return static_cast<std::size_t>(std::min<std::uint64_t>(block_bytes, size() - block * block_bytes));
}

bool InputBytes::is_as_checked(const char* bytes, std::uint64_t block) noexcept {
  if (xxh3_64(bytes, bytes_of(block)) == digests_[block]) return true;
  if (failure_ == Failure::none) failure_ = Failure::changed;
  return false;
}

bool InputBytes::read_plainly(void* bytes, std::size_t count, std::uint64_t address) noexcept {
  if (read_at(file_.descriptor(), bytes, count, address)) return true;
  if (failure_ == Failure::none) failure_ = Failure::unread, error_ = errno;
  return false;
}

bool InputBytes::read_part(char* bytes, std::size_t count, std::uint64_t address) noexcept {
  const std::uint64_t block = address / block_bytes;
  if (block_at_ != block) {
    block_at_ = ~std::uint64_t{0};
    if (!read_plainly(block_.data(), bytes_of(block), block * block_bytes) || !is_as_checked(block_.data(), block))
      return false;
    block_at_ = block;
  }
  std::memcpy(bytes, block_.data() + (address - block * block_bytes), count);
  return true;
}

bool InputBytes::read(void* bytes, std::size_t count, std::uint64_t address) noexcept {
  if (digests_.empty()) return read_plainly(bytes, count, address);
  char* to = static_cast<char*>(bytes);
  for (const std::uint64_t end = address + count; address < end;) {
    const std::uint64_t block = address / block_bytes;
    const auto here = static_cast<std::size_t>(std::min(end, block * block_bytes + bytes_of(block)) - address);
    const bool read = here < bytes_of(block) ? read_part(to, here, address)
                                             : read_plainly(to, here, address) && is_as_checked(to, block);
    if (!read) return false;
    to += here;
    address += here;
  }
  return true;
}

namespace {

[[noreturn]] void refuse_other_bytes(const Where& where) {
  throw MachineFault(where,
                     "holds other bytes now than when it was checked (another program writes it, or the disk fails)",
                     "let nothing write it meanwhile, check the disk");
}

}  // namespace

void InputBytes::check_reads() const {
  if (failure_ == Failure::unread) throw DiskError(file_.name().string(), error_);
  if (failure_ == Failure::changed) refuse_other_bytes(where());
}

std::string sha256_as_checked(const std::filesystem::path& file) {
  const DigestedFile read = digested_file(file, checksum_block_bytes);
  if (begins_with_checksum(file) &&
      read.head != checksum_block(read.xxh3_of_rest, read.size - std::min(read.size, checksum_block_bytes)))
    refuse_other_bytes({file.string()});
  return read.sha256;
}

namespace {

std::optional<std::string> checksum(const std::filesystem::path& file, bool compare) {
  try {
    InputBytes bytes(file);
    const std::string stored = bytes.read_checksum("");
    if (stored.empty()) return bytes.digest();
    if (compare) bytes.check(stored, "");
    return stored;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<std::string> stored_checksum(const std::filesystem::path& file) { return checksum(file, false); }
std::optional<std::string> checksum_of(const std::filesystem::path& file) { return checksum(file, true); }

bool begins_with_checksum(const std::filesystem::path& file) {
  return beginning_of(file, first_line.size()) == first_line;
}

}  // namespace dresslife::pipeline
