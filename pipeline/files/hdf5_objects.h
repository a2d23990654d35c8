// Common parts of reading and writing HDF5 files: identifiers that close themselves, settings of the library, types and axes.
#pragma once

#include <hdf5.h>

#include <cstddef>
#include <string>
#include <utility>

#include "pipeline/files/files.h"

namespace dresslife::pipeline {

/// An HDF5 identifier that closes itself.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() { reset(); }
  herr_t reset() {
    const herr_t status = id_ >= 0 && close_ ? close_(id_) : 0;
    id_ = -1;
    return status;
  }
  operator hid_t() const { return id_; }
  bool valid() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

inline void silence_library() {
  H5dont_atexit();  // no identifier stays open, and the exit handler of the library fails after it ran out of memory
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

static_assert(std::endian::native == std::endian::little, "numbers are stored as they are in memory");
/// Returns the type of numbers, the same in files and in memory. Negative: text, whose type depends on its length.
inline hid_t number_type(Type type) {
  switch (type) {
    case Type::f64:
      return H5T_IEEE_F64LE;
    case Type::f32:
      return H5T_IEEE_F32LE;
    case Type::i32:
      return H5T_STD_I32LE;
    case Type::u32:
      return H5T_STD_U32LE;
    case Type::u64:
      return H5T_STD_U64LE;
    case Type::text:
      break;
  }
  return -1;
}

/// The length of an axis in a format's table: a number, "name", or "name+1" for one more.
struct AxisLength {
  std::string name;
  std::size_t plus = 0;
  std::size_t fixed = 0;
  explicit AxisLength(const std::string& text) {
    if (text.find_first_not_of("0123456789") == std::string::npos)
      fixed = std::stoul(text);
    else if (text.ends_with("+1")) {
      name = text.substr(0, text.size() - 2);
      plus = 1;
    } else
      name = text;
  }
};

}  // namespace dresslife::pipeline
