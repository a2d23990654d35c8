#include "pipeline/base/digest.h"

// The newer interface of OpenSSL (EVP) builds tables of every cipher first, which takes a third of a millisecond at each start of
// a stage.
#define OPENSSL_API_COMPAT 10101
#include <fmt/format.h>
#include <openssl/sha.h>
#include <xxhash.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "pipeline/base/errors.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

class Sha256 {
 public:
  Sha256() { SHA256_Init(&context_); }
  void add(const void* bytes, std::size_t count) { SHA256_Update(&context_, bytes, count); }
  std::string hex() {
    unsigned char digest[SHA256_DIGEST_LENGTH];
    SHA256_Final(digest, &context_);
    std::string text;
    for (const unsigned char byte : digest) text += fmt::format("{:02x}", byte);
    return text;
  }

 private:
  SHA256_CTX context_;
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hex();
}

namespace {

/// Adds the bytes of a file to `digest`, block by block.
template <class Digest>
std::string digest_of(const PlainFile& bytes, Digest&& digest) {
  std::vector<char> block(read_block_bytes);
  for (std::uint64_t at = 0; at < bytes.size(); at += block.size()) {
    const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(block.size(), bytes.size() - at));
    bytes.read(block.data(), count, at);
    digest.add(block.data(), count);
  }
  return digest.hex();
}

}  // namespace

DigestedFile digested_file(const std::filesystem::path& file, std::size_t head_bytes) {
  struct Both {
    std::size_t head_bytes;
    std::string head;
    Sha256 all;
    Xxh3 rest;
    void add(const char* bytes, std::size_t count) {
      all.add(bytes, count);
      const std::size_t of_head = std::min(count, head_bytes - head.size());
      head.append(bytes, of_head);
      rest.add(bytes + of_head, count - of_head);
    }
    std::string hex() { return all.hex(); }
  } both{head_bytes, {}, {}, {}};
  const PlainFile bytes(file);
  const std::string sha256 = digest_of(bytes, both);
  return {sha256, both.head, both.rest.hex(), bytes.size()};
}

struct Xxh3::State {
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> xxh{XXH3_createState(), XXH3_freeState};
};

Xxh3::Xxh3() : state_(std::make_unique<State>()) {
  if (!state_->xxh || XXH3_128bits_reset(state_->xxh.get()) != XXH_OK) throw std::bad_alloc();
}
Xxh3::~Xxh3() = default;
void Xxh3::add(const void* bytes, std::size_t count) {
  if (count > 0) XXH3_128bits_update(state_->xxh.get(), bytes, count);
}
std::string Xxh3::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh.get());
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::string xxh3(std::string_view bytes) {
  Xxh3 digest;
  digest.add(bytes.data(), bytes.size());
  return digest.hex();
}

std::string xxh3_of(const PlainFile& file) { return digest_of(file, Xxh3()); }
std::string xxh3_of_file(const std::filesystem::path& file) { return xxh3_of(PlainFile(file)); }

std::uint64_t xxh3_64(const void* bytes, std::size_t count) { return XXH3_64bits(bytes, count); }

}  // namespace dresslife::pipeline
