#include "pipeline/files/files.h"

#include <fcntl.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <utility>

#include "pipeline/files/checksum.h"
#include "pipeline/files/file_driver.h"
#include "pipeline/files/list_deflate.h"
#include "pipeline/files/scale_offset.h"
#include "pipeline/limits.h"
#include "pipeline/whole_file.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t chunk_bytes = 1 << 16;  // one write call and one chunk: large enough to amortise both
constexpr std::size_t packed_chunk_rows =
    1 << 15;  // fewer calls; the range of values, hence their bits, hardly grows
static_assert(packed_chunk_rows <= ListDeflater::most_numbers);
constexpr std::size_t most_chunk_bytes = 64
                                         << 20;  // one is held unpacked; other programs write 1 MB and less

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

void silence_library() {
  H5dont_atexit();  // nothing is left open, and a library out of memory stumbles over itself
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// Before each call that lets the library take memory of its own: where that fails halfway, it frees what it never
/// had and takes the program along. It takes a node of a tree, a chunk on its way and a chunk's cache, 1 MB each.
void check_library_memory() {
  constexpr std::uint64_t megabytes = 8;
  check_memory(megabytes);
}

/// The library says of everything that it failed; too little memory is another matter than a damaged file.
void throw_if_out_of_memory() {
  const auto look = [](unsigned, const H5E_error2_t* error, void* found) -> herr_t {
    if (error->min_num == H5E_NOSPACE || error->min_num == H5E_CANTALLOC) *static_cast<bool*>(found) = true;
    return 0;
  };
  bool found = false;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look, &found);
  if (found) throw std::bad_alloc();
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::f64:
    case Type::u64:
      return 8;
    case Type::f32:
    case Type::i32:
    case Type::u32:
      return 4;
    case Type::text:
      break;
  }
  return 0;
}

hid_t file_type(Type type) {
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

hid_t memory_type(Type type) {
  switch (type) {
    case Type::f64:
      return H5T_NATIVE_DOUBLE;
    case Type::f32:
      return H5T_NATIVE_FLOAT;
    case Type::i32:
      return H5T_NATIVE_INT32;
    case Type::u32:
      return H5T_NATIVE_UINT32;
    case Type::u64:
      return H5T_NATIVE_UINT64;
    case Type::text:
      break;
  }
  return -1;
}

template <class T>
constexpr Type type_of = Type::f64;
template <>
constexpr Type type_of<float> = Type::f32;
template <>
constexpr Type type_of<std::int32_t> = Type::i32;
template <>
constexpr Type type_of<std::uint32_t> = Type::u32;
template <>
constexpr Type type_of<std::uint64_t> = Type::u64;

Handle text_type(std::size_t bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(bytes, 1));
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

bool write_text_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const std::string padded = value.empty() ? std::string(1, '\0') : value;
  return attribute.valid() && H5Awrite(attribute, type, padded.data()) >= 0;
}

/// The length that an axis name stands for: a number itself, or "name" and "name+1" through `lengths`.
struct Axis {
  std::string name;
  std::size_t plus = 0;
  std::size_t fixed = 0;
  explicit Axis(const std::string& text) {
    if (text.find_first_not_of("0123456789") == std::string::npos)
      fixed = std::stoul(text);
    else if (text.ends_with("+1")) {
      name = text.substr(0, text.size() - 2);
      plus = 1;
    } else
      name = text;
  }
};

}  // namespace

// ---- writing ----------------------------------------------------------------------------------------------

struct FileWriter::Impl {
  struct Open {
    const Dataset* description = nullptr;
    Handle id, file_type, memory_type;  // id: from the first write on
    std::size_t row_values = 1, value_bytes = 0, rows = 0, chunk_rows = 1;
    std::vector<char> buffer;
    std::map<std::string, std::string> attributes;
    std::size_t row_bytes() const { return row_values * value_bytes; }
  };
  WholeFile whole;
  const Format* format = nullptr;
  Handle file;
  std::map<std::string, Open> open;  // ordered: same calls, same bytes
  std::map<std::string, std::size_t> axes, text_widths;
  std::vector<char> packed;  // the chunk being written
  ListDeflater deflater;
  std::string checksum;  // once committed

  Impl(std::filesystem::path final_name, const Format& of) : whole(std::move(final_name)), format(&of) {}

  /// Closes what the library holds before the file goes; where it is not wanted, nothing more is written.
  ~Impl() {
    whole.give_up();
    open.clear();
    file.reset();
  }

  /// The disk never lets a call of the library fail (file_driver.h): memory may, else the fault is ours.
  [[noreturn]] void fail(const std::string& what) const {
    whole.check();
    throw_if_out_of_memory();
    throw std::logic_error(whole.final_name().string() + ": HDF5 refuses " + what);
  }

  std::size_t axis_length(const std::string& text) const {
    const Axis axis(text);
    if (axis.fixed) return axis.fixed;
    const auto found = axes.find(axis.name);
    if (found == axes.end()) throw std::logic_error("length of axis '" + axis.name + "' is not set");
    return found->second + axis.plus;
  }

  Open& dataset(const std::string& path, std::size_t text_bytes = 0) {
    if (const auto found = open.find(path); found != open.end()) return found->second;
    Open& made = open[path];
    made.description = &format->find(path);
    for (std::size_t i = 1; i < made.description->shape.size(); ++i)
      made.row_values *= axis_length(made.description->shape[i]);
    if (made.description->type == Type::text) {
      const auto width = text_widths.find(path);
      made.value_bytes = std::max<std::size_t>(1, width == text_widths.end() ? text_bytes : width->second);
      made.file_type = text_type(made.value_bytes);
      made.memory_type = text_type(made.value_bytes);
    } else {
      made.value_bytes = size_of(made.description->type);
      made.file_type = Handle(H5Tcopy(file_type(made.description->type)), H5Tclose);
      made.memory_type = Handle(H5Tcopy(memory_type(made.description->type)), H5Tclose);
    }
    made.chunk_rows =
        made.description->packed()
            ? packed_chunk_rows
            : std::max<std::size_t>(1, chunk_bytes / std::max<std::size_t>(1, made.row_bytes()));
    made.attributes["unit"] = made.description->unit;
    return made;
  }

  /// Not before there is something to write: what fits into less than a chunk takes no whole one on the disk.
  void create(Open& made) {
    const std::string& path = made.description->path;
    const auto& shape = made.description->shape;
    std::vector<hsize_t> lengths(shape.size()), most(shape.size()), chunk(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
      lengths[i] = i ? axis_length(shape[i]) : 0;
      most[i] = i ? lengths[i] : H5S_UNLIMITED;
      chunk[i] = i ? std::max<hsize_t>(1, lengths[i]) : made.chunk_rows;
    }
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), lengths.data(), most.data()),
                       H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(creation, static_cast<int>(shape.size()), chunk.data());
    H5Pset_obj_track_times(creation, false);
    if (made.description->deflate) H5Pset_shuffle(creation);
    if (made.description->deflate || made.description->lists) H5Pset_deflate(creation, 1);
    if (made.description->decimals) {
      H5Pset_fill_value(creation, made.file_type, nullptr);  // a defined one would need a number of its own
      H5Pset_scaleoffset(creation, H5Z_SO_FLOAT_DSCALE, *made.description->decimals);
    }
    make_groups(path);
    made.id = Handle(
        H5Dcreate2(file, path.c_str(), made.file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    if (!made.id.valid()) fail("dataset " + path);
    for (const auto& [name, value] : made.attributes)
      if (!write_text_attribute(made.id, name, value)) fail("attribute " + name + " of " + path);
  }

  /// Writes the rest of a dataset, which may be all of it.
  void finish(Open& target) {
    const std::size_t rows = target.row_bytes() ? target.buffer.size() / target.row_bytes() : 0;
    if (!target.id.valid()) {
      target.chunk_rows = std::max<std::size_t>(1, std::min(rows, target.chunk_rows));
      create(target);
    }
    flush(target);
  }

  /// The groups above a dataset. (Left to the library they would carry the time of day: other bytes in every
  /// run.)
  void make_groups(const std::string& path) {
    const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
      const std::string group = path.substr(0, end);
      if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
      const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
      if (!made.valid()) fail("group " + group);
    }
  }

  void put(Open& target, const void* bytes, std::size_t count) {
    whole.check();  // an hour of work for a full disk would be lost
    const char* begin = static_cast<const char*>(bytes);
    target.buffer.insert(target.buffer.end(), begin, begin + count);
    if (target.description->packed())
      flush_packed(target, false);
    else if (target.buffer.size() >= chunk_bytes)
      flush(target);
  }

  /// Whole chunks; at the end the last one too, filled up with its last number.
  void flush_packed(Open& target, bool at_end) {
    const std::size_t whole_chunk = target.chunk_rows * target.value_bytes;
    std::size_t done = 0;
    for (; target.buffer.size() - done >= whole_chunk; done += whole_chunk)
      write_chunk(target, target.buffer.data() + done, target.chunk_rows);
    target.buffer.erase(target.buffer.begin(), target.buffer.begin() + static_cast<std::ptrdiff_t>(done));
    if (!at_end || target.buffer.empty()) return;
    const std::size_t rest = target.buffer.size();
    target.buffer.resize(whole_chunk);
    for (std::size_t at = rest; at < whole_chunk; at += target.value_bytes)
      std::copy_n(target.buffer.data() + rest - target.value_bytes, target.value_bytes,
                  target.buffer.data() + at);
    write_chunk(target, target.buffer.data(), rest / target.value_bytes);
    target.buffer.clear();
  }

  /// rows: of the chunk that belong to the dataset.
  void write_chunk(Open& target, const char* numbers, std::size_t rows) {
    check_library_memory();
    if (!target.id.valid()) create(target);
    if (target.description->lists)
      deflater.pack(std::span(reinterpret_cast<const std::uint32_t*>(numbers), target.chunk_rows), packed);
    else
      pack_chunk(std::span(reinterpret_cast<const float*>(numbers), target.chunk_rows),
                 *target.description->decimals, packed);
    const hsize_t first = target.rows, length = target.rows + rows;
    if (H5Dset_extent(target.id, &length) < 0 ||
        H5Dwrite_chunk(target.id, H5P_DEFAULT, 0, &first, packed.size(), packed.data()) < 0)
      fail("dataset " + target.description->path);
    target.rows += rows;
  }

  void flush(Open& target) {
    if (target.description->packed()) return flush_packed(target, true);
    const std::size_t row_bytes = target.row_bytes();
    if (target.buffer.empty() || row_bytes == 0) return;
    check_library_memory();
    if (!target.id.valid()) create(target);
    const hsize_t rows = target.buffer.size() / row_bytes;
    const auto& shape = target.description->shape;
    std::vector<hsize_t> first(shape.size(), 0), count(shape.size()), length(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) count[i] = length[i] = i ? axis_length(shape[i]) : rows;
    first[0] = target.rows;
    length[0] = target.rows + rows;
    if (H5Dset_extent(target.id, length.data()) < 0) fail("dataset " + target.description->path);
    const Handle file_space(H5Dget_space(target.id), H5Sclose);
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr);
    const Handle memory_space(H5Screate_simple(static_cast<int>(shape.size()), count.data(), nullptr),
                              H5Sclose);
    if (H5Dwrite(target.id, target.memory_type, memory_space, file_space, H5P_DEFAULT, target.buffer.data()) <
        0)
      fail("dataset " + target.description->path);
    target.rows += rows;
    target.buffer.clear();
  }

  template <class T>
  void append(const std::string& path, std::span<const T> values) {
    Open& target = dataset(path);
    if (target.description->type == Type::text || (target.row_values && values.size() % target.row_values))
      throw std::logic_error("rows of " + path + " do not fit its shape");
    auto convert = [&]<class To>(To) {
      if constexpr (std::is_same_v<To, T>) {
        put(target, values.data(), values.size_bytes());
      } else {
        std::vector<To> converted(values.begin(), values.end());
        put(target, converted.data(), converted.size() * sizeof(To));
      }
    };
    switch (target.description->type) {
      case Type::f64:
        convert(double{});
        break;
      case Type::f32:
        convert(float{});
        break;
      case Type::i32:
        convert(std::int32_t{});
        break;
      case Type::u32:
        convert(std::uint32_t{});
        break;
      case Type::u64:
        convert(std::uint64_t{});
        break;
      case Type::text:
        break;
    }
  }

  void append_text(const std::string& path, std::span<const std::string> values) {
    std::size_t longest = 0;
    for (const std::string& value : values) longest = std::max(longest, value.size());
    Open& target = dataset(path, longest);
    if (longest > target.value_bytes) throw std::logic_error("text of " + path + " is longer than its width");
    std::vector<char> bytes(values.size() * target.value_bytes, '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
      std::memcpy(bytes.data() + i * target.value_bytes, values[i].data(), values[i].size());
    put(target, bytes.data(), bytes.size());
  }

  /// Every dataset is there, and datasets that share an axis agree on it.
  void check_whole() {
    std::map<std::string, std::size_t> seen = axes;
    for (const Dataset& description : format->datasets) {
      const auto found = open.find(description.path);
      if (found == open.end()) {
        if (!description.may_be_absent)
          throw std::logic_error("dataset " + description.path + " was never written");
        continue;
      }
      const Axis axis(description.shape[0]);
      const auto [entry, fresh] = seen.emplace(axis.name, found->second.rows - axis.plus);
      if (!axis.fixed && !fresh && entry->second + axis.plus != found->second.rows)
        throw std::logic_error(fmt::format("{} has {} rows, others of its axis {}", description.path,
                                           found->second.rows, entry->second));
    }
  }
};

FileWriter::FileWriter(std::filesystem::path file, const Format& format) {
  silence_library();
  check_library_memory();
  impl_ = std::make_unique<Impl>(std::move(file), format);
  const Handle access(access_for_writing(impl_->whole), H5Pclose);
  // The 1.8 layout lets attributes (the job's text) exceed 64 KiB.
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  H5Pset_userblock(creation, checksum_block_bytes);
  impl_->file =
      Handle(H5Fcreate(impl_->whole.final_name().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (!impl_->file.valid()) impl_->fail("a new file");
  attribute("format", format.name);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle version(
      H5Acreate2(impl_->file, "format_version", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!version.valid() || H5Awrite(version, H5T_NATIVE_INT, &format.version) < 0)
    impl_->fail("attribute format_version");
}

FileWriter::~FileWriter() = default;

void FileWriter::set_axis(const std::string& axis, std::size_t length) { impl_->axes[axis] = length; }
void FileWriter::set_text_width(const std::string& dataset, std::size_t bytes) {
  impl_->text_widths[dataset] = bytes;
}
void FileWriter::append(const std::string& d, std::span<const double> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const float> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::int32_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::uint32_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::uint64_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::string> rows) {
  impl_->append_text(d, rows);
}

void FileWriter::attribute(const std::string& name, const std::string& value) {
  if (!write_text_attribute(impl_->file, name, value)) impl_->fail("attribute " + name);
}

void FileWriter::attribute(const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle made(H5Acreate2(impl_->file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
  if (!made.valid() || H5Awrite(made, H5T_NATIVE_DOUBLE, &value) < 0) impl_->fail("attribute " + name);
}

void FileWriter::dataset_attribute(const std::string& dataset, const std::string& name,
                                   const std::string& value) {
  Impl::Open& target = impl_->dataset(dataset);
  target.attributes[name] = value;
  if (target.id.valid() && !write_text_attribute(target.id, name, value)) impl_->fail("attribute " + name);
}

void FileWriter::commit() {
  for (auto& [path, target] : impl_->open) impl_->finish(target);
  impl_->check_whole();
  check_library_memory();
  for (auto& [path, target] : impl_->open)
    if (target.id.reset() < 0) impl_->fail("dataset " + path);
  impl_->open.clear();
  if (H5Fflush(impl_->file, H5F_SCOPE_GLOBAL) < 0 || impl_->file.reset() < 0) impl_->fail("the last bytes");
  impl_->whole.check();
  impl_->checksum = write_checksum(impl_->whole);
  impl_->whole.commit();
}

const std::filesystem::path& FileWriter::final_name() const { return impl_->whole.final_name(); }

const std::string& FileWriter::checksum() const { return impl_->checksum; }

// ---- reading ----------------------------------------------------------------------------------------------

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
  InputBytes input;  // closed after the library has let go of it
  std::uint64_t bytes = 0;  // of the file: nothing that it holds is larger
  Handle file;
  std::map<std::string, Open> open;
  std::map<std::string, std::size_t> axes;
  std::string checksum;

  [[noreturn]] void fail(const std::string& what) const {
    throw_if_out_of_memory();
    throw InputError({name.string()}, what, fmt::format("make the file anew with {}", format->made_by));
  }

  const Open& dataset(const std::string& path) const {
    const auto found = open.find(path);
    if (found == open.end()) fail(fmt::format("dataset {} is missing", path));
    return found->second;
  }

  /// One value of an attribute: no other number of them is read into the place of one.
  Handle one_value(hid_t object, const std::string& attribute) const {
    Handle id(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose);
    if (!id.valid()) fail(fmt::format("attribute '{}' is missing", attribute));
    const Handle space(H5Aget_space(id), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1)
      fail(fmt::format("attribute '{}' holds {} values (must be one)", attribute,
                       H5Sget_simple_extent_npoints(space)));
    return id;
  }

  std::string text_of(hid_t object, const std::string& attribute) const {
    const Handle id = one_value(object, attribute);
    const Handle type(H5Aget_type(id), H5Tclose);
    if (H5Tget_class(type) != H5T_STRING) fail(fmt::format("attribute '{}' is not text", attribute));
    if (H5Tis_variable_str(type) > 0) {
      char* words = nullptr;
      if (H5Aread(id, type, &words) < 0 || !words)
        fail(fmt::format("attribute '{}' cannot be read", attribute));
      std::string text(words);
      H5free_memory(words);
      return text;
    }
    const std::size_t length = H5Tget_size(type);
    if (length > bytes)
      fail(fmt::format("attribute '{}' is a text of {} bytes in a file of {} (the file is damaged)", attribute,
                       length, bytes));
    std::string text(length, '\0');
    if (H5Aread(id, type, text.data()) < 0) fail(fmt::format("attribute '{}' cannot be read", attribute));
    text.resize(std::min(text.size(), text.find('\0')));
    return text;
  }

  /// number: of the memory type that is named.
  void read_number(const std::string& attribute, hid_t type, void* number) const {
    if (H5Aread(one_value(file, attribute), type, number) < 0)
      fail(fmt::format("attribute '{}' is missing or not a number", attribute));
  }

  void check_format() {
    if (H5Aexists(file, "format") <= 0) fail("is not a dresslife file (it has no attribute 'format')");
    const std::string written = text_of(file, "format");
    if (written != format->name) fail(fmt::format("holds '{}' ('{}' is expected)", written, format->name));
    int version = 0;
    read_number("format_version", H5T_NATIVE_INT, &version);
    if (version > format->version)
      throw InputError(
          {name.string()},
          fmt::format("has format version {} (this program reads up to {})", version, format->version),
          "update dresslife");
  }

  void open_dataset(const Dataset& description) {
    // H5Lexists wants every group on the way to exist.
    for (std::size_t slash = description.path.find('/', 1);; slash = description.path.find('/', slash + 1)) {
      const std::string way = description.path.substr(0, slash);
      if (H5Lexists(file, way.c_str(), H5P_DEFAULT) <= 0) {
        if (description.may_be_absent) return;
        fail(fmt::format("dataset {} is missing", description.path));
      }
      H5L_info_t link{};
      if (H5Lget_info(file, way.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
        fail(fmt::format("{} is a link (the data must lie in the file itself)", way));
      if (slash == std::string::npos) break;
    }
    check_library_memory();
    Open made;
    made.description = &description;
    made.id = Handle(H5Dopen2(file, description.path.c_str(), H5P_DEFAULT), H5Dclose);
    if (!made.id.valid()) fail(fmt::format("{} is not a dataset or is damaged", description.path));
    check_type(made);
    check_shape(made);
    check_storage(made);
    if (description.decimals) made.packed_rows = packed_rows_of(made);
    open.emplace(description.path, std::move(made));
  }

  void check_type(const Open& made) const {
    const Handle type(H5Dget_type(made.id), H5Tclose);
    const H5T_class_t found = H5Tget_class(type);
    const Type wanted = made.description->type;
    const bool fits = wanted == Type::text                         ? found == H5T_STRING
                      : wanted == Type::f64 || wanted == Type::f32 ? found == H5T_FLOAT
                                                                   : found == H5T_INTEGER;
    if (!fits) fail(fmt::format("dataset {} has the wrong type", made.description->path));
    const std::string unit = text_of(made.id, "unit");
    if (unit != made.description->unit)
      fail(fmt::format("dataset {} has unit '{}' (must be '{}')", made.description->path, unit,
                       made.description->unit));
  }

  void check_shape(Open& made) {
    const auto& shape = made.description->shape;
    const Handle space(H5Dget_space(made.id), H5Sclose);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank != static_cast<int>(shape.size()))
      fail(fmt::format("dataset {} has {} axes (must have {})", made.description->path, rank, shape.size()));
    made.lengths.resize(shape.size());
    H5Sget_simple_extent_dims(space, made.lengths.data(), nullptr);
    for (std::size_t i = 0; i < shape.size(); ++i) {
      if (i && __builtin_mul_overflow(made.row_values, made.lengths[i], &made.row_values))
        fail(fmt::format("dataset {} is too large", made.description->path));
      const Axis axis(shape[i]);
      if (axis.fixed ? made.lengths[i] != axis.fixed : made.lengths[i] < axis.plus)
        fail(fmt::format("dataset {} has length {} (must be {})", made.description->path, made.lengths[i],
                         shape[i]));
      if (axis.fixed) continue;
      const auto [entry, fresh] = axes.emplace(axis.name, made.lengths[i] - axis.plus);
      if (!fresh && entry->second + axis.plus != made.lengths[i])
        fail(fmt::format("dataset {} has {} values along '{}' (others have {})", made.description->path,
                         made.lengths[i], shape[i], entry->second + axis.plus));
    }
  }

  /// All values are in the file. What its tables promise beyond that the library would make up, as zeros, in
  /// as much memory as they say.
  void check_storage(const Open& made) const {
    const std::string& path = made.description->path;
    const Handle creation(H5Dget_create_plist(made.id), H5Pclose);
    const Handle type(H5Dget_type(made.id), H5Tclose);
    const Handle space(H5Dget_space(made.id), H5Sclose);
    hsize_t promised = H5Tget_size(type);
    for (const hsize_t length : made.lengths)
      if (__builtin_mul_overflow(promised, length, &promised))
        fail(fmt::format("dataset {} is too large", path));
    const H5D_layout_t layout = H5Pget_layout(creation);
    if (H5Pget_external_count(creation) != 0 || layout == H5D_VIRTUAL)
      fail(fmt::format("dataset {} lies in other files (the data must lie in the file itself)", path));
    if (promised == 0) return;
    if (layout != H5D_CHUNKED) {
      if (H5Dget_storage_size(made.id) != promised) fail(fmt::format("dataset {} was never filled", path));
      if (promised > bytes)
        fail(fmt::format("dataset {} is larger than its file of {} bytes (the file is damaged)", path, bytes));
      return;
    }
    std::vector<hsize_t> chunk(made.lengths.size());
    H5Pget_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
    hsize_t needed = 1, found = 0, chunk_size = H5Tget_size(type);
    for (std::size_t i = 0; i < chunk.size(); ++i) {
      const hsize_t along = made.lengths[i] / chunk[i] + (made.lengths[i] % chunk[i] != 0);
      if (__builtin_mul_overflow(needed, along, &needed) ||
          __builtin_mul_overflow(chunk_size, chunk[i], &chunk_size))
        fail(fmt::format("dataset {} is too large", path));
    }
    if (chunk_size > most_chunk_bytes)
      fail(fmt::format("dataset {} has chunks of {} bytes", path, chunk_size));
    check_fits(made, creation, needed, chunk_size);
    if (H5Dget_num_chunks(made.id, space, &found) < 0 || found != needed)
      fail(fmt::format("dataset {} has {} of its {} chunks (the file is damaged)", path, found, needed));
  }

  /// Each chunk takes its place in the file, and what lies there unpacked is no smaller than it was: no dataset
  /// has more chunks than the file has room for, nor are those that exist larger than the file.
  void check_fits(const Open& made, hid_t creation, hsize_t chunks, hsize_t chunk_size) const {
    constexpr hsize_t least_index_bytes = 4;  // of a chunk: at least its length stands somewhere
    const std::string& path = made.description->path;
    const hsize_t least = H5Pget_nfilters(creation) > 0 ? least_index_bytes : chunk_size;
    if (chunks > bytes / least)
      fail(fmt::format("dataset {} promises {} chunks of {} bytes in a file of {} (the file is damaged)", path,
                       chunks, chunk_size, bytes));
    if (H5Dget_storage_size(made.id) > bytes)
      fail(fmt::format("dataset {} is larger than its file of {} bytes (the file is damaged)", path, bytes));
  }

  /// Rows of a chunk if it is packed as this program does it; other layouts of the same numbers go through
  /// the library.
  static std::size_t packed_rows_of(const Open& made) {
    const Handle creation(H5Dget_create_plist(made.id), H5Pclose);
    const Handle type(H5Dget_type(made.id), H5Tclose);
    if (H5Pget_layout(creation) != H5D_CHUNKED || H5Pget_nfilters(creation) != 1 || H5Tget_size(type) != 4 ||
        H5Tget_order(type) != H5T_ORDER_LE)
      return 0;
    std::array<unsigned, 20>
        values{};  // scale type, scale, numbers a chunk, class, size, sign, order, fill value ...
    std::size_t count = values.size();
    unsigned flags = 0, config = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(creation, 0, &flags, &count, values.data(), 0, nullptr, &config);
    H5D_fill_value_t fill = H5D_FILL_VALUE_ERROR;
    H5Pfill_value_defined(creation, &fill);
    hsize_t chunk = 0;
    H5Pget_chunk(creation, 1, &chunk);
    const bool ours = filter == H5Z_FILTER_SCALEOFFSET && fill == H5D_FILL_VALUE_UNDEFINED &&
                      values[0] == H5Z_SO_FLOAT_DSCALE &&
                      static_cast<int>(values[1]) == *made.description->decimals;
    return ours ? chunk : 0;
  }

  void read_packed(const Open& from, std::size_t first, std::size_t count, float* out) const {
    check_library_memory();
    std::vector<char> packed;
    std::vector<float> numbers(from.packed_rows);
    for (std::size_t row = first, end = first + count; row < end;) {
      const hsize_t chunk = row / from.packed_rows * from.packed_rows;
      hsize_t size = 0;
      std::uint32_t unfiltered = 0;
      const bool found = H5Dget_chunk_storage_size(from.id, &chunk, &size) >= 0;
      packed.resize(size);
      if (!found || H5Dread_chunk(from.id, H5P_DEFAULT, &chunk, &unfiltered, packed.data()) < 0 ||
          unfiltered || !unpack_chunk(packed, *from.description->decimals, std::span(numbers)))
        fail(fmt::format("dataset {} cannot be read (the file is damaged)", from.description->path));
      const std::size_t here = std::min<std::size_t>(end, chunk + from.packed_rows) - row;
      std::copy_n(numbers.data() + (row - chunk), here, out);
      row += here;
      out += here;
    }
  }

  /// Selects rows [first, first + count) and reads them.
  void read(const Open& from, std::size_t first, std::size_t count, hid_t type, void* out) const {
    if (first + count > from.lengths[0])
      throw std::logic_error("rows beyond the end of " + from.description->path);
    std::vector<hsize_t> begin(from.lengths.size(), 0), length = from.lengths;
    begin[0] = first;
    length[0] = count;
    if (count == 0 || from.row_values == 0) return;
    check_library_memory();
    const Handle file_space(H5Dget_space(from.id), H5Sclose);
    H5Sselect_hyperslab(file_space, H5S_SELECT_SET, begin.data(), nullptr, length.data(), nullptr);
    const Handle memory_space(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr),
                              H5Sclose);
    if (H5Dread(from.id, type, memory_space, file_space, H5P_DEFAULT, out) < 0)
      fail(fmt::format("dataset {} cannot be read (the file is damaged)", from.description->path));
  }

  template <class T>
  void read_values(const std::string& path, std::size_t first, std::size_t count, std::vector<T>& out) const {
    const Open& from = dataset(path);
    out.resize(count * from.row_values);
    if constexpr (std::is_same_v<T, float>)
      if (from.packed_rows && first + count <= from.lengths[0]) {
        read_packed(from, first, count, out.data());
        return check_finite(from, first, out);
      }
    read(from, first, count, memory_type(type_of<T>), out.data());
    check_finite(from, first, out);
  }

  template <class T>
  void check_finite(const Open& from, std::size_t first, const std::vector<T>& out) const {
    if constexpr (std::is_floating_point_v<T>) {
      for (std::size_t i = 0; i < out.size(); ++i)
        if (std::isnan(out[i]) || (std::isinf(out[i]) && !from.description->may_be_infinite))
          fail(fmt::format("dataset {} holds a non-finite number in row {}", from.description->path,
                           first + i / from.row_values));
    }
  }
};

void FileWriter::copy(const FileReader& from, const std::string& dataset) {
  const FileReader::Impl::Open& source = from.impl_->dataset(dataset);
  const Dataset& description = impl_->format->find(dataset);
  if (impl_->open.count(dataset) || description.unit != source.description->unit ||
      description.type != source.description->type || description.shape.size() != source.lengths.size())
    throw std::logic_error("dataset " + dataset + " cannot be copied");
  impl_->make_groups(dataset);
  if (H5Ocopy(from.impl_->file, dataset.c_str(), impl_->file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT) <
      0) {
    impl_->whole.check();
    from.impl_->fail(fmt::format("dataset {} cannot be copied (the file is damaged)", dataset));
  }
  Impl::Open& made = impl_->open[dataset];
  made.description = &description;
  made.rows = source.lengths[0];
  made.row_values = source.row_values;
  made.id = Handle(H5Dopen2(impl_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
}

FileReader::FileReader(const std::filesystem::path& file, const Format& format, Scope scope)
    : impl_(std::make_unique<Impl>()) {
  silence_library();
  impl_->name = file;
  impl_->format = &format;
  std::error_code failure;
  if (!std::filesystem::is_regular_file(file, failure))
    throw InputError({file.string()}, "is not there",
                     fmt::format("check the path, or make it with {}", format.made_by));
  const std::string remedy = fmt::format("make the file anew with {}", format.made_by);
  impl_->input = InputBytes(file);
  impl_->bytes = static_cast<std::uint64_t>(std::max<std::int64_t>(0, state_of(impl_->input.descriptor()).size));
  impl_->checksum = impl_->input.read_checksum(remedy);
  if (scope == Scope::everything) impl_->input.check(impl_->checksum, remedy);
  check_library_memory();
  const Handle access(access_for_reading(impl_->input.descriptor()), H5Pclose);
  impl_->file = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!impl_->file.valid()) impl_->fail("is not an HDF5 file, or is cut off");
  impl_->check_format();
  if (scope == Scope::everything)
    for (const Dataset& description : format.datasets) impl_->open_dataset(description);
  for (const AttributeInfo& attribute : format.attributes)
    if (!attribute.may_be_absent && H5Aexists(impl_->file, attribute.name.c_str()) <= 0)
      impl_->fail(fmt::format("attribute '{}' is missing", attribute.name));
}

FileReader::~FileReader() = default;

bool FileReader::has(const std::string& dataset) const { return impl_->open.count(dataset) > 0; }
bool FileReader::has_attribute(const std::string& name) const {
  return H5Aexists(impl_->file, name.c_str()) > 0;
}
std::size_t FileReader::length(const std::string& axis) const {
  const auto found = impl_->axes.find(axis);
  return found == impl_->axes.end() ? 0 : found->second;
}
std::size_t FileReader::rows(const std::string& dataset) const { return impl_->dataset(dataset).lengths[0]; }
std::size_t FileReader::row_size(const std::string& dataset) const {
  return impl_->dataset(dataset).row_values;
}

void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<double>& out) const {
  impl_->read_values(d, first, count, out);
}
void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<float>& out) const {
  impl_->read_values(d, first, count, out);
}
void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<std::int32_t>& out) const {
  impl_->read_values(d, first, count, out);
}
void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<std::uint32_t>& out) const {
  impl_->read_values(d, first, count, out);
}
void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<std::uint64_t>& out) const {
  impl_->read_values(d, first, count, out);
}

void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count,
                           std::vector<std::string>& out) const {
  const Impl::Open& from = impl_->dataset(d);
  const Handle type(H5Dget_type(from.id), H5Tclose);
  const std::size_t values = count * from.row_values;
  out.assign(values, "");
  if (H5Tis_variable_str(type) > 0) {
    std::vector<char*> words(values, nullptr);
    impl_->read(from, first, count, type, words.data());
    for (std::size_t i = 0; i < values; ++i)
      if (words[i]) {
        out[i] = words[i];
        H5free_memory(words[i]);
      }
    return;
  }
  const std::size_t width = H5Tget_size(type);
  std::vector<char> bytes(values * width);
  impl_->read(from, first, count, type, bytes.data());
  for (std::size_t i = 0; i < values; ++i) {
    const char* begin = bytes.data() + i * width;
    out[i].assign(begin, std::find(begin, begin + width, '\0'));
  }
}

std::string FileReader::text_attribute(const std::string& name) const {
  return impl_->text_of(impl_->file, name);
}

double FileReader::number_attribute(const std::string& name) const {
  double value = 0;
  impl_->read_number(name, H5T_NATIVE_DOUBLE, &value);
  return value;
}

std::string FileReader::dataset_attribute(const std::string& dataset, const std::string& name) const {
  return impl_->text_of(impl_->dataset(dataset).id, name);
}

Where FileReader::where() const { return {impl_->name.string()}; }

const std::string& FileReader::checksum() const { return impl_->checksum; }

namespace {

/// The root attribute `format`; empty: not one of ours.
std::string written_format(const std::filesystem::path& file) {
  silence_library();
  const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (!opened.valid() || H5Aexists(opened, "format") <= 0) return "";
  const Handle attribute(H5Aopen(opened, "format", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0) return "";
  std::string format(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, format.data()) < 0 || !format.starts_with("dresslife-")) return "";
  return format.c_str();  // padded with zeros
}

}  // namespace

bool is_dresslife_file(const std::filesystem::path& file) {
  return begins_with_checksum(file) || !written_format(file).empty();
}

const Format* format_of(const std::filesystem::path& file) {
  const std::string written = written_format(file);
  for (const Format* format :
       {&motion_format(), &strain_format(), &life_format(), &preview_format(), &screening_format()})
    if (format->name == written) return format;
  return nullptr;
}

}  // namespace dresslife::pipeline
