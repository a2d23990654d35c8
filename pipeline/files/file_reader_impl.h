// What a FileReader holds, for FileWriter::copy(), which takes datasets as they lie in the file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/files/checksum.h"
#include "pipeline/files/hdf5_objects.h"

namespace dresslife::pipeline {

struct FileReader::Impl {
  struct Open {
    const Dataset* description = nullptr;
    Handle id;
    std::vector<hsize_t> lengths;
    std::size_t row_values = 1;
    std::size_t packed_rows = 0;  ///< of a chunk that scale_offset.h reads; 0: left to the library
  };
  std::filesystem::path name;
  const Format* format = nullptr;
  InputBytes input;         // closed after the library has let go of it
  std::uint64_t bytes = 0;  // of the file: nothing that it holds is larger
  Handle file;
  std::map<std::string, Open> open;
  std::map<std::string, std::size_t> axes;
  std::string checksum;

  [[noreturn]] void fail(const std::string& what) const;
  const Open& dataset(const std::string& path) const;
  /// One value of an attribute: no other number of them is read into the place of one.
  Handle one_value(hid_t object, const std::string& attribute) const;
  std::string text_of(hid_t object, const std::string& attribute) const;
  /// number: of the memory type that is named.
  void read_number(const std::string& attribute, hid_t type, void* number) const;
  void check_format();
  void open_dataset(const Dataset& description);
  void check_type(const Open& made) const;
  void check_shape(Open& made);
  /// All values are in the file. What its tables promise beyond that the library would make up, as zeros, in
  /// as much memory as they say.
  void check_storage(const Open& made) const;
  /// Each chunk takes its place in the file, and what lies there unpacked is no smaller than it was: no
  /// dataset has more chunks than the file has room for, nor are those that exist larger than the file.
  void check_fits(const Open& made, hid_t creation, hsize_t chunks, hsize_t chunk_size) const;
  /// Every chunk went through the dataset's filters.
  void check_filtered(const Open& made, const std::vector<hsize_t>& chunk) const;
  /// Rows of a chunk if it is packed as this program does it; other layouts of the same numbers go through
  /// the library.
  static std::size_t packed_rows_of(const Open& made);
  void read_packed(const Open& from, std::size_t first, std::size_t count, float* out) const;
  /// Selects rows [first, first + count) and reads them.
  void read(const Open& from, std::size_t first, std::size_t count, hid_t type, void* out) const;
  template <class T>
  void read_values(const std::string& path, std::size_t first, std::size_t count, std::vector<T>& out) const;
  template <class T>
  void check_finite(const Open& from, std::size_t first, const std::vector<T>& out) const;
};

}  // namespace dresslife::pipeline
