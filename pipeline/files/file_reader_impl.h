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
    /// Of a chunk that scale_offset.h or list_deflate.h unpacks; 0: left to the library.
    std::size_t packed_rows = 0;
    mutable std::vector<char> unpacked;  ///< the last of these chunks, for reads of single rows
    mutable hsize_t unpacked_at = 0;     ///< its first row
    std::vector<hsize_t> chunk;                 ///< along each axis; empty: not in chunks
    mutable bool chunks_to_be_checked = false;  ///< before the library reads them
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
  // file_storage.cpp
  /// All values are in the file, packed as one of our programs or a plain one does it. What a file's tables
  /// promise beyond that the library would make up, as zeros, in as much memory as they say; and where a
  /// chunk holds less than a chunk, it would read on behind it.
  void check_storage(Open& made) const;
  void check_chunks_are_there(Open& made, hid_t creation) const;
  /// Ours or the library's, by the filters that a dataset in chunks went through.
  void choose_reading(Open& made, hid_t creation) const;
  /// Of `chunks` of chunk_size bytes each, unpacked: each takes its place in the file, and what lies there
  /// unfiltered is no smaller than it was. No dataset has more chunks than the file has room for, nor are
  /// those that exist larger than the file.
  void check_fits(const Open& made, hsize_t chunks, hsize_t chunk_size, bool filtered) const;
  /// Without a cache of chunks the library reads as many bytes as the dataset says; with one it takes a
  /// chunk's length from the file's index, and reads on behind a short one.
  void read_without_cache(Open& made) const;
  /// Every chunk is deflated from as many bytes as a chunk has: the library reads on behind one of fewer.
  void check_chunks(const Open& made) const;
  /// A chunk as it lies in the file, having gone through all filters of the dataset.
  void read_chunk(const Open& from, const hsize_t* at, std::vector<char>& packed) const;
  [[noreturn]] void fail_at_chunk(const Open& from) const;
  /// Rows [first, first + count) of packed numbers. unpack(chunk, numbers): false where it is damaged.
  template <class T, class Unpack>
  void unpack_rows(const Open& from, std::size_t first, std::size_t count, T* out,
                   const Unpack& unpack) const;
  void unpack_rows(const Open& from, std::size_t first, std::size_t count, float* out) const;
  void unpack_rows(const Open& from, std::size_t first, std::size_t count, double* out) const;
  void unpack_rows(const Open& from, std::size_t first, std::size_t count, std::uint32_t* out) const;
  // file_reader.cpp
  /// Selects rows [first, first + count) and reads them.
  void read(const Open& from, std::size_t first, std::size_t count, hid_t type, void* out) const;
  template <class T>
  void read_values(const std::string& path, std::size_t first, std::size_t count, std::vector<T>& out) const;
  template <class Stored, class T>
  void read_packed(const Open& from, std::size_t first, std::size_t count, std::vector<T>& out) const;
  template <class T>
  void check_finite(const Open& from, std::size_t first, const std::vector<T>& out) const;
};

}  // namespace dresslife::pipeline
