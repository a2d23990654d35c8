// HDF5 files between the stages. Each format is one table, which is used to create files, to check files and to print the manual.
// Only the sources of this folder use the HDF5 library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

enum class Type { f64, f32, i32, u32, u64, text };

/// One dataset of a format. Its shape contains names of axes ("sample", "segment", "site") or numbers ("3"). The first axis grows
/// with append(). All datasets with an axis have the same length along it; "+1" after a name means one more.
struct Dataset {
  std::string path;
  Type type = Type::f64;
  std::vector<std::string> shape;
  std::string unit;
  std::string meaning;
  bool may_be_infinite = false;
  bool may_be_absent = false;
  bool deflate = false;  ///< for repetitive tables; not for histories, which must be fast
  /// For f32 and f64: numbers are rounded to this many decimals and stored with as few bits as each chunk needs (HDF5's
  /// scale-offset filter, scale_offset.h); std::nullopt: not rounded.
  std::optional<int> decimals{};
  bool lists = false;  ///< for u32 with one axis: increasing lists, each similar to the preceding one (list_deflate.h)
  bool packed() const { return decimals || lists; }
};

struct AttributeInfo {
  std::string name, meaning;
  bool is_text = false;
  bool may_be_absent = false;
};

struct Format {
  std::string name;  ///< value of the root attribute `format`
  int version = 1;
  std::string made_by;  ///< program that makes the file, for remedies
  std::string purpose;
  std::vector<Dataset> datasets;
  std::vector<AttributeInfo> attributes;  ///< in addition to those of every file
  const Dataset& find(std::string_view path) const;
};

const Format& motion_format();
const Format& strain_format();
const Format& life_format();
const Format& preview_format();
const Format& screening_format();
const Format& ways_format();

/// Returns the formats of motion.h5, strain.h5 and life.h5 as Markdown.
std::string file_manual();

class FileReader;

/// Writes a file that is complete or absent (pipeline/base/whole_file.h): commit() gives it its name; without commit() no file
/// remains. Its first 512 bytes contain a checksum of all others (checksum.h). Errors: InputError if the file cannot be created
/// or the disk is full, from the next call or from commit().
class FileWriter {
 public:
  FileWriter(std::filesystem::path file, const Format& format);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Sets the length of an axis. Required before the first append() of a dataset that has this axis behind its first one.
  void set_axis(const std::string& axis, std::size_t length);
  /// Sets the longest text of a dataset that is appended in several calls; default: the longest text of the first call.
  void set_text_width(const std::string& dataset, std::size_t bytes);
  /// Appends whole rows (all axes except the first). Values are converted to the dataset's type.
  void append(const std::string& dataset, std::span<const double> rows);
  void append(const std::string& dataset, std::span<const float> rows);
  void append(const std::string& dataset, std::span<const std::int32_t> rows);
  void append(const std::string& dataset, std::span<const std::uint32_t> rows);
  void append(const std::string& dataset, std::span<const std::uint64_t> rows);
  void append(const std::string& dataset, std::span<const std::string> rows);

  /// Copies a whole dataset of another file without unpacking it. Precondition: it has the same path, unit and type in both
  /// formats, and was not appended to.
  void copy(const FileReader& from, const std::string& dataset);

  void attribute(const std::string& name, const std::string& value);
  void attribute(const std::string& name, double value);
  /// Writes an attribute of a dataset that has data (for example `links` of /robot/link_pose).
  void dataset_attribute(const std::string& dataset, const std::string& name, const std::string& value);

  void commit();
  const std::filesystem::path& final_name() const;
  const std::string& checksum() const;  ///< of the committed file (checksum.h)

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens a file and checks it: every byte against its checksum, then its format: name, version, datasets, ranks, lengths and
/// units, and that every value is in the file. Reads check for non-finite values. Files without a checksum, from other programs
/// or older versions, are accepted. Errors: InputError, one line.
class FileReader {
 public:
  enum class Scope { everything, attributes };
  /// attributes: does not open the datasets and does not check the checksum over all bytes, to read a few numbers from many
  /// files. The library has its own checksums of attributes.
  FileReader(const std::filesystem::path& file, const Format& format, Scope scope = Scope::everything);
  /// Opens only these datasets, to read a few from many files. Every byte is checked; attributes are not required. has() is false
  /// for the other datasets.
  FileReader(const std::filesystem::path& file, const Format& format, std::initializer_list<std::string_view> datasets);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  bool has(const std::string& dataset) const;
  bool has_attribute(const std::string& name) const;  ///< of the root
  std::size_t length(const std::string& axis) const;  ///< of a named axis; 0 if no dataset has it
  std::size_t rows(const std::string& dataset) const;
  std::size_t row_size(const std::string& dataset) const;  ///< values per row

  template <class T>
  std::vector<T> read(const std::string& dataset) const {
    std::vector<T> values;
    read_rows(dataset, 0, rows(dataset), values);
    return values;
  }
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count, std::vector<double>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count, std::vector<float>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::int32_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::uint32_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::uint64_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count, std::vector<std::string>& out) const;

  /// Returns the bytes of a dataset as they are stored, with its type, lengths and filters. Equal results mean equal values.
  /// Unequal ones may be the same values, packed by another program. Empty: not known (no chunks, texts of any length).
  std::string stored(const std::string& dataset) const;

  std::string text_attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  std::string dataset_attribute(const std::string& dataset, const std::string& name) const;

  Where where() const;                  ///< the file, for messages
  const std::string& checksum() const;  ///< of the file (checksum.h); empty: it has none

 private:
  friend class FileWriter;
  struct Impl;
  void open(const std::filesystem::path& file, const Format& format, bool checks_bytes);
  std::unique_ptr<Impl> impl_;
};

/// Returns whether a file was made by a stage of this project, complete or not. Errors: those of PlainFile, if the file exists.
bool is_dresslife_file(const std::filesystem::path& file);

/// Returns the format that the file's attribute names; null if it is none of ours, or the file is absent. Errors: those of
/// is_dresslife_file().
const Format* format_of(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
