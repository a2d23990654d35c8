#include "pipeline/files/checksum.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <utility>

#include "pipeline/base/errors.h"
#include "pipeline/files/digest.h"

namespace dresslife::pipeline {
namespace {

constexpr std::string_view first_line = "dresslife file\n";
constexpr std::string_view before_digest = "xxh3-128 ", before_bytes = " of ";
constexpr std::size_t digest_digits = 32;
constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";

}  // namespace

std::string checksum_block(const std::string& digest, std::uint64_t bytes) {
  std::string block(first_line);
  block += fmt::format("{}{}{}{} bytes after these {}", before_digest, digest, before_bytes, bytes,
                       checksum_block_bytes);
  block.resize(checksum_block_bytes, '\n');
  return block;
}

namespace {

struct Promise {
  std::string digest;
  std::uint64_t bytes = 0;
};

/// What a block says, if it is one to the last bit.
std::optional<Promise> promise_of(const std::string& block) {
  constexpr std::size_t digest_at = first_line.size() + before_digest.size();
  constexpr std::size_t bytes_at = digest_at + digest_digits + before_bytes.size();
  Promise promise{block.substr(digest_at, digest_digits), 0};
  std::from_chars(block.data() + bytes_at, block.data() + block.size(), promise.bytes);
  if (checksum_block(promise.digest, promise.bytes) != block) return std::nullopt;
  return promise;
}

std::uint64_t size_of(int descriptor) {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(0, state_of(descriptor).size));
}

}  // namespace

std::string write_checksum(WholeFile& file) {
  const std::uint64_t size = size_of(file.descriptor());
  const std::string digest = xxh3_of_range(file.descriptor(), checksum_block_bytes, size);
  if (digest.empty())
    throw InputError({file.final_name().string()},
                     fmt::format("cannot be read back ({})", std::strerror(errno)), "check the disk");
  const std::string block = checksum_block(digest, size - checksum_block_bytes);
  file.write_at(block.data(), block.size(), 0);
  return digest;
}

InputBytes::InputBytes(const std::filesystem::path& file)
    : name_(file), descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
  if (descriptor_ < 0)
    throw InputError({file.string()}, fmt::format("cannot be read ({})", std::strerror(errno)),
                     "check the file's permissions");
}

InputBytes::~InputBytes() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

InputBytes::InputBytes(InputBytes&& other) noexcept
    : name_(std::move(other.name_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

InputBytes& InputBytes::operator=(InputBytes&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

std::string InputBytes::read_checksum(const std::string& remedy) const {
  const std::uint64_t size = size_of(descriptor_);
  std::string block(checksum_block_bytes, '\0'), next(hdf5_signature.size(), '\0');
  if (!read_at(descriptor_, block.data(), block.size(), 0) ||
      !read_at(descriptor_, next.data(), next.size(), checksum_block_bytes))
    throw InputError({name_.string()}, fmt::format("cannot be read ({})", std::strerror(errno)),
                     "check the disk");
  const bool begins_as_ours = block.starts_with(first_line), block_before = next == hdf5_signature;
  if (!begins_as_ours && !block_before) return "";
  const std::optional<Promise> promise = promise_of(block);
  if (!promise)
    throw InputError({name_.string()}, "is damaged (its first 512 bytes are no checksum)", remedy);
  if (promise->bytes + checksum_block_bytes != size)
    throw InputError({name_.string()},
                     fmt::format("is cut off or has grown (it has {} bytes and promises {})", size,
                                 promise->bytes + checksum_block_bytes),
                     remedy);
  return promise->digest;
}

void InputBytes::check(const std::string& checksum, const std::string& remedy) const {
  if (checksum.empty()) return;
  const std::string digest = xxh3_of_range(descriptor_, checksum_block_bytes, size_of(descriptor_));
  if (digest.empty())
    throw InputError({name_.string()}, fmt::format("cannot be read ({})", std::strerror(errno)),
                     "check the disk");
  if (digest != checksum)
    throw InputError({name_.string()}, "is damaged or was edited (its bytes are not those of its checksum)",
                     remedy);
}

namespace {

std::optional<std::string> checksum(const std::filesystem::path& file, bool compare) {
  try {
    const InputBytes bytes(file);
    if (!state_of(bytes.descriptor()).exists()) return std::nullopt;  // no plain file
    const std::string told = bytes.read_checksum("");
    if (told.empty()) return xxh3_of_range(bytes.descriptor(), 0, size_of(bytes.descriptor()));
    if (compare) bytes.check(told, "");
    return told;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<std::string> told_checksum(const std::filesystem::path& file) { return checksum(file, false); }
std::optional<std::string> checksum_of(const std::filesystem::path& file) { return checksum(file, true); }

bool begins_with_checksum(const std::filesystem::path& file) {
  try {
    const InputBytes bytes(file);
    std::string begin(first_line.size(), '\0');
    return read_at(bytes.descriptor(), begin.data(), begin.size(), 0) && begin == first_line;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace dresslife::pipeline
