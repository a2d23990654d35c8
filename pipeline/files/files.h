// The HDF5 files that pass between the stages. Each format is one table, from which the writer creates, the
// reader checks and the manual is printed. The HDF5 library stays behind this header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

enum class Type { f64, f32, i32, u32, u64, text };

/// One dataset of a format. Its shape names axes ("sample", "segment", "site") or gives a number ("3"); the
/// first axis grows by append(). Datasets that name an axis agree on its length; "+1" after a name adds one.
struct Dataset {
  std::string path;
  Type type = Type::f64;
  std::vector<std::string> shape;
  std::string unit;
  std::string meaning;
  bool may_be_infinite = false;
  bool may_be_absent = false;
  bool deflate = false;  ///< repetitive tables; histories are left plain for speed
  /// Of f32 and f64: kept to this many decimals in as few bits as each chunk needs (HDF5's scale-offset filter,
  /// scale_offset.h); nothing: as they are.
  std::optional<int> decimals{};
  bool lists = false;  ///< of u32, one axis: rising lists, each much like that before (list_deflate.h)
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
  std::string made_by;  ///< program, for remedies
  std::string purpose;
  std::vector<Dataset> datasets;
  std::vector<AttributeInfo> attributes;  ///< beyond those of every file
  const Dataset& find(std::string_view path) const;
};

const Format& motion_format();
const Format& strain_format();
const Format& life_format();
const Format& preview_format();
const Format& screening_format();
const Format& ways_format();

/// All formats as Markdown.
std::string file_manual();

class FileReader;

/// Writes a file that is whole or absent (pipeline/base/whole_file.h): on commit() it gets its name, without
/// commit() nothing stays behind. Its first 512 bytes hold a checksum of all others (checksum.h). Errors:
/// InputError when the file cannot be created or the disk is full, at the next call or in commit().
class FileWriter {
 public:
  FileWriter(std::filesystem::path file, const Format& format);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  /// Length of an axis; needed before the first append() of a dataset whose trailing axes name it.
  void set_axis(const std::string& axis, std::size_t length);
  /// Longest text of a dataset that is appended to in several calls; otherwise the first call's longest.
  void set_text_width(const std::string& dataset, std::size_t bytes);
  /// Appends whole rows (all axes but the first). Values convert to the dataset's type.
  void append(const std::string& dataset, std::span<const double> rows);
  void append(const std::string& dataset, std::span<const float> rows);
  void append(const std::string& dataset, std::span<const std::int32_t> rows);
  void append(const std::string& dataset, std::span<const std::uint32_t> rows);
  void append(const std::string& dataset, std::span<const std::uint64_t> rows);
  void append(const std::string& dataset, std::span<const std::string> rows);

  /// The whole dataset of another file, as it lies there: packed rows are not unpacked. Precondition: of the
  /// same path, unit and kind of values in both formats, and not appended to.
  void copy(const FileReader& from, const std::string& dataset);

  void attribute(const std::string& name, const std::string& value);
  void attribute(const std::string& name, double value);
  /// An attribute of a dataset that has been appended to (for example `links` of /robot/link_pose).
  void dataset_attribute(const std::string& dataset, const std::string& name, const std::string& value);

  void commit();
  const std::filesystem::path& final_name() const;
  const std::string& checksum() const;  ///< of the committed file (checksum.h)

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Opens a file and checks it: every byte against its checksum, then against its format: name, version,
/// datasets, ranks, lengths and units, and that every value lies in the file. Reads check for non-finite
/// values. Files without a checksum, of other programs or older versions, are read, too. Errors: InputError,
/// one line.
class FileReader {
 public:
  enum class Scope { everything, attributes };
  /// attributes: leaves the datasets and the checksum over all bytes alone, for who gathers a few numbers
  /// from many files; the library has a checksum of its own for attributes.
  FileReader(const std::filesystem::path& file, const Format& format, Scope scope = Scope::everything);
  ~FileReader();
  FileReader(const FileReader&) = delete;
  FileReader& operator=(const FileReader&) = delete;

  bool has(const std::string& dataset) const;
  bool has_attribute(const std::string& name) const;  ///< of the root
  std::size_t length(const std::string& axis) const;  ///< of a named axis; 0 when no dataset has it
  std::size_t rows(const std::string& dataset) const;
  std::size_t row_size(const std::string& dataset) const;  ///< values per row

  template <class T>
  std::vector<T> read(const std::string& dataset) const {
    std::vector<T> values;
    read_rows(dataset, 0, rows(dataset), values);
    return values;
  }
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<double>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<float>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::int32_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::uint32_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::uint64_t>& out) const;
  void read_rows(const std::string& dataset, std::size_t first, std::size_t count,
                 std::vector<std::string>& out) const;

  std::string text_attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  std::string dataset_attribute(const std::string& dataset, const std::string& name) const;

  Where where() const;                  ///< the file, for messages
  const std::string& checksum() const;  ///< of the file (checksum.h); empty: it has none

 private:
  friend class FileWriter;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Whether a file was made by one of our stages, whole or not. Errors: those of PlainFile, where there is a file.
bool is_dresslife_file(const std::filesystem::path& file);

/// The format that its attribute names; null: none of them, or no file. Errors: as is_dresslife_file().
const Format* format_of(const std::filesystem::path& file);

}  // namespace dresslife::pipeline
