// Members of a FileReader. FileWriter::copy() also uses them, because it copies datasets without unpacking.
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
    /// Rows of a chunk that scale_offset.h or list_deflate.h unpacks; 0: the library unpacks.
    std::size_t packed_rows = 0;
    mutable std::vector<char> unpacked;         ///< the last unpacked chunk, for reads of single rows
    mutable hsize_t unpacked_at = 0;            ///< first row of that chunk
    std::vector<hsize_t> chunk;                 ///< length along each axis; empty: not in chunks
    mutable bool chunks_to_be_checked = false;  ///< check before the library reads them
  };
  std::filesystem::path name;
  const Format* format = nullptr;
  InputBytes input;         // closed after the library has closed the file
  std::uint64_t bytes = 0;  // size of the file, the upper limit of every content
  Handle file;
  std::map<std::string, Open> open;
  std::map<std::string, std::size_t> axes;
  std::string checksum;

  [[noreturn]] void fail(const std::string& what) const;
  const Open& dataset(const std::string& path) const;
  /// Opens an attribute that has exactly one value, because the result is read into the place of one value.
  Handle one_value(hid_t object, const std::string& attribute) const;
  std::string text_of(hid_t object, const std::string& attribute) const;
  /// number: a variable of the memory type `type`.
  void read_number(const std::string& attribute, hid_t type, void* number) const;
  void check_format();
  void open_dataset(const Dataset& description);
  void check_type(const Open& made) const;
  void check_shape(Open& made);
  // file_storage.cpp
  /// Checks that all values are in the file, packed as by a program of this project or an ordinary one. For values that a file's
  /// tables promise but the file does not contain, the library would return zeros and allocate as much memory as the tables
  /// state. For a chunk that is too short, it would read beyond the end.
  void check_storage(Open& made) const;
  void check_chunks_are_there(Open& made, hid_t creation) const;
  /// Selects the reading of this project or of the library, by the filters of a dataset in chunks.
  void choose_reading(Open& made, hid_t creation) const;
  /// Checks that `chunks` chunks of `chunk_size` unpacked bytes fit into the file. Each chunk needs space in the file, an
  /// unfiltered one its full size.
  void check_fits(const Open& made, hsize_t chunks, hsize_t chunk_size, bool filtered) const;
  /// Reopens a dataset without a cache of chunks. Then the library reads the number of bytes that the dataset states. With a
  /// cache, it takes the length of a chunk from the file's index, and reads beyond a short one.
  void read_without_cache(Open& made) const;
  /// Checks that every chunk inflates to the size of a chunk: the library would read beyond a smaller one.
  void check_chunks(const Open& made) const;
  /// Reads a chunk as it is stored. Precondition: it went through all filters of the dataset.
  void read_chunk(const Open& from, const hsize_t* at, std::vector<char>& packed) const;
  /// Calls use(packed) for each chunk as it is stored.
  template <class Use>
  void for_each_chunk(const Open& from, const Use& use) const;
  std::string stored(const Open& from) const;  ///< as FileReader::stored()
  [[noreturn]] void fail_at_chunk(const Open& from) const;
  /// Unpacks rows [first, first + count) of packed numbers. unpack(chunk, numbers) returns false for a damaged chunk.
  template <class T, class Unpack>
  void unpack_rows(const Open& from, std::size_t first, std::size_t count, T* out, const Unpack& unpack) const;
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
