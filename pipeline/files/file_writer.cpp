#include <algorithm>
#include <cstring>
#include <utility>

#include "pipeline/base/lists.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/file_driver.h"
#include "pipeline/files/file_reader_impl.h"
#include "pipeline/files/hdf5_objects.h"
#include "pipeline/files/list_deflate.h"
#include "pipeline/files/scale_offset.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t written_at_once = 1 << 16;  // size of a write call and of a chunk: large enough to amortise both
constexpr std::size_t packed_chunk_numbers =
    1 << 15;  // fewer calls; the range of values, and so the number of bits, hardly increases
static_assert(packed_chunk_numbers <= ListDeflater::most_numbers);

Handle text_type(std::size_t bytes) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(bytes, 1));
  H5Tset_cset(type, H5T_CSET_UTF8);
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

template <class T>
std::span<const T> numbers_at(const char* bytes, std::size_t count) {
  return {reinterpret_cast<const T*>(bytes), count};
}

bool write_text_attribute(hid_t object, const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size());
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const std::string padded = value.empty() ? std::string(1, '\0') : value;
  return attribute.valid() && H5Awrite(attribute, type, padded.data()) >= 0;
}

}  // namespace

struct FileWriter::Impl {
  struct Open {
    const Dataset* description = nullptr;
    Handle id, type;  // id: valid after the first write
    std::size_t row_values = 1, value_bytes = 0, rows = 0, chunk_rows = 1;
    std::vector<char> buffer;
    std::map<std::string, std::string> attributes;
    std::size_t row_bytes() const { return row_values * value_bytes; }
  };
  WholeFile whole;
  const Format* format = nullptr;
  Handle file;
  std::map<std::string, Open> open;  // sorted, so that equal calls give equal bytes
  std::map<std::string, std::size_t> axes, text_widths;
  std::vector<char> packed;  // the chunk being written
  ListDeflater deflater;
  std::string checksum;  // after commit()

  Impl(std::filesystem::path final_name, const Format& of) : whole(std::move(final_name)), format(&of) {}

  /// Closes the library's objects before the file. A file that is not needed gets no more writes.
  ~Impl() {
    whole.give_up();
    open.clear();
    file.reset();
  }

  /// Throws the error of the disk, if there is one. The disk makes a call of the library fail only if written bytes cannot be
  /// read back (file_driver.h); any other failure is a bug of this project.
  [[noreturn]] void fail(const std::string& what) const {
    whole.check();
    throw std::logic_error(whole.final_name().string() + ": HDF5 refuses " + what);
  }

  std::size_t axis_length(const std::string& text) const {
    const AxisLength axis(text);
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
      made.type = text_type(made.value_bytes);
    } else {
      made.type = Handle(H5Tcopy(number_type(made.description->type)), H5Tclose);
      made.value_bytes = H5Tget_size(made.type);
    }
    const std::size_t most = made.description->packed() ? packed_chunk_numbers * made.value_bytes : written_at_once;
    made.chunk_rows = std::max<std::size_t>(1, most / std::max<std::size_t>(1, made.row_bytes()));
    made.attributes["unit"] = made.description->unit;
    return made;
  }

  /// Creates a dataset at its first write, so that a dataset smaller than a chunk does not take a whole chunk on the disk.
  void create(Open& made) {
    const std::string& path = made.description->path;
    const auto& shape = made.description->shape;
    std::vector<hsize_t> lengths(shape.size()), most(shape.size()), chunk(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
      lengths[i] = i ? axis_length(shape[i]) : 0;
      most[i] = i ? lengths[i] : H5S_UNLIMITED;
      chunk[i] = i ? std::max<hsize_t>(1, lengths[i]) : made.chunk_rows;
    }
    const Handle space(H5Screate_simple(static_cast<int>(shape.size()), lengths.data(), most.data()), H5Sclose);
    const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
    H5Pset_chunk(creation, static_cast<int>(shape.size()), chunk.data());
    H5Pset_obj_track_times(creation, false);
    if (made.description->deflate) H5Pset_shuffle(creation);
    if (made.description->deflate || made.description->lists) H5Pset_deflate(creation, 1);
    if (made.description->decimals) {
      H5Pset_fill_value(creation, made.type, nullptr);  // a defined value would need a code of its own
      H5Pset_scaleoffset(creation, H5Z_SO_FLOAT_DSCALE, *made.description->decimals);
    }
    make_groups(path);
    made.id = Handle(H5Dcreate2(file, path.c_str(), made.type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose);
    if (!made.id.valid()) fail("dataset " + path);
    for (const auto& [name, value] : made.attributes)
      if (!write_text_attribute(made.id, name, value)) fail("attribute " + name + " of " + path);
  }

  /// Writes the rest of a dataset, or a whole dataset that is small.
  void finish(Open& target) {
    const std::size_t rows = target.row_bytes() ? target.buffer.size() / target.row_bytes() : 0;
    if (!target.id.valid()) {
      target.chunk_rows = std::max<std::size_t>(1, std::min(rows, target.chunk_rows));
      create(target);
    }
    flush(target);
  }

  /// Creates the groups above a dataset. Groups that the library creates contain the time of day, so each run would give other
  /// bytes.
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

  /// Takes about a chunk at a time, so that the buffer of a large table stays small.
  void put(Open& target, const void* bytes, std::size_t count) {
    whole.check();  // so that a full disk is detected before an hour of work
    const char* begin = static_cast<const char*>(bytes);
    const std::size_t most = std::max<std::size_t>(1, target.chunk_rows * target.row_bytes());
    for (std::size_t done = 0; done < count; done += most) {
      target.buffer.insert(target.buffer.end(), begin + done, begin + std::min(count, done + most));
      if (target.description->packed())
        flush_packed(target, false);
      else if (target.buffer.size() >= written_at_once)
        flush(target);
    }
  }

  /// Writes whole chunks; at the end also the last one, filled up with its last number.
  void flush_packed(Open& target, bool at_end) {
    const std::size_t whole_chunk = target.chunk_rows * target.row_bytes();
    if (whole_chunk == 0) return;
    std::size_t done = 0;
    for (; target.buffer.size() - done >= whole_chunk; done += whole_chunk)
      write_chunk(target, target.buffer.data() + done, target.chunk_rows);
    target.buffer.erase(target.buffer.begin(), target.buffer.begin() + static_cast<std::ptrdiff_t>(done));
    if (!at_end || target.buffer.empty()) return;
    const std::size_t rest = target.buffer.size();
    target.buffer.resize(whole_chunk);
    for (std::size_t at = rest; at < whole_chunk; at += target.value_bytes)
      std::copy_n(target.buffer.data() + rest - target.value_bytes, target.value_bytes, target.buffer.data() + at);
    write_chunk(target, target.buffer.data(), rest / target.row_bytes());
    target.buffer.clear();
  }

  /// rows: number of the chunk's rows that belong to the dataset.
  void write_chunk(Open& target, const char* numbers, std::size_t rows) {
    if (!target.id.valid()) create(target);
    const std::size_t count = target.chunk_rows * target.row_values;
    if (target.description->lists)
      deflater.pack(numbers_at<std::uint32_t>(numbers, count), packed);
    else if (target.description->type == Type::f32)
      pack_chunk(numbers_at<float>(numbers, count), *target.description->decimals, packed);
    else
      pack_chunk(numbers_at<double>(numbers, count), *target.description->decimals, packed);
    const auto& shape = target.description->shape;
    std::vector<hsize_t> first(shape.size(), 0), length(shape.size());
    for (std::size_t i = 0; i < shape.size(); ++i) length[i] = i ? axis_length(shape[i]) : target.rows + rows;
    first[0] = target.rows;
    if (H5Dset_extent(target.id, length.data()) < 0 ||
        H5Dwrite_chunk(target.id, H5P_DEFAULT, 0, first.data(), packed.size(), packed.data()) < 0)
      fail("dataset " + target.description->path);
    target.rows += rows;
  }

  void flush(Open& target) {
    if (target.description->packed()) return flush_packed(target, true);
    const std::size_t row_bytes = target.row_bytes();
    if (target.buffer.empty() || row_bytes == 0) return;
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
    const Handle memory_space(H5Screate_simple(static_cast<int>(shape.size()), count.data(), nullptr), H5Sclose);
    if (H5Dwrite(target.id, target.type, memory_space, file_space, H5P_DEFAULT, target.buffer.data()) < 0)
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
        return convert(double{});
      case Type::f32:
        return convert(float{});
      case Type::i32:
        return convert(std::int32_t{});
      case Type::u32:
        return convert(std::uint32_t{});
      case Type::u64:
        return convert(std::uint64_t{});
      case Type::text:
        return;
    }
  }

  void append_text(const std::string& path, std::span<const std::string> values) {
    const std::size_t longest =
        largest_of(values, std::size_t{0}, [](const std::string& value) { return value.size(); });
    Open& target = dataset(path, longest);
    if (longest > target.value_bytes) throw std::logic_error("text of " + path + " is longer than its width");
    std::vector<char> bytes(values.size() * target.value_bytes, '\0');
    for (std::size_t i = 0; i < values.size(); ++i)
      std::memcpy(bytes.data() + i * target.value_bytes, values[i].data(), values[i].size());
    put(target, bytes.data(), bytes.size());
  }

  /// Checks that every dataset exists, and that datasets agree on the length of common axes.
  void check_whole() {
    std::map<std::string, std::size_t> seen = axes;
    for (const Dataset& description : format->datasets) {
      const auto found = open.find(description.path);
      if (found == open.end()) {
        if (!description.may_be_absent) throw std::logic_error("dataset " + description.path + " was never written");
        continue;
      }
      const AxisLength axis(description.shape[0]);
      const auto [entry, fresh] = seen.emplace(axis.name, found->second.rows - axis.plus);
      if (!axis.fixed && !fresh && entry->second + axis.plus != found->second.rows)
        throw std::logic_error(
            fmt::format("{} has {} rows, others of its axis {}", description.path, found->second.rows, entry->second));
    }
  }
};

FileWriter::FileWriter(std::filesystem::path file, const Format& format) {
  silence_library();
  impl_ = std::make_unique<Impl>(std::move(file), format);
  const Handle access(access_for_writing(impl_->whole), H5Pclose);
  // Layout 1.8 allows attributes of more than 64 KiB (the job's text).
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  H5Pset_userblock(creation, checksum_block_bytes);
  impl_->file = Handle(H5Fcreate(impl_->whole.final_name().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  if (!impl_->file.valid()) impl_->fail("a new file");
  attribute("format", format.name);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle version(H5Acreate2(impl_->file, "format_version", H5T_STD_I32LE, space, H5P_DEFAULT, H5P_DEFAULT),
                       H5Aclose);
  if (!version.valid() || H5Awrite(version, H5T_NATIVE_INT, &format.version) < 0)
    impl_->fail("attribute format_version");
}

FileWriter::~FileWriter() = default;

void FileWriter::set_axis(const std::string& axis, std::size_t length) { impl_->axes[axis] = length; }
void FileWriter::set_text_width(const std::string& dataset, std::size_t bytes) { impl_->text_widths[dataset] = bytes; }
void FileWriter::append(const std::string& d, std::span<const double> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const float> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::int32_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::uint32_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::uint64_t> rows) { impl_->append(d, rows); }
void FileWriter::append(const std::string& d, std::span<const std::string> rows) { impl_->append_text(d, rows); }

void FileWriter::attribute(const std::string& name, const std::string& value) {
  if (!write_text_attribute(impl_->file, name, value)) impl_->fail("attribute " + name);
}

void FileWriter::attribute(const std::string& name, double value) {
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle made(H5Acreate2(impl_->file, name.c_str(), H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (!made.valid() || H5Awrite(made, H5T_NATIVE_DOUBLE, &value) < 0) impl_->fail("attribute " + name);
}

void FileWriter::dataset_attribute(const std::string& dataset, const std::string& name, const std::string& value) {
  Impl::Open& target = impl_->dataset(dataset);
  target.attributes[name] = value;
  if (target.id.valid() && !write_text_attribute(target.id, name, value)) impl_->fail("attribute " + name);
}

void FileWriter::commit() {
  for (auto& [path, target] : impl_->open) impl_->finish(target);
  impl_->check_whole();
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

void FileWriter::copy(const FileReader& from, const std::string& dataset) {
  const FileReader::Impl::Open& source = from.impl_->dataset(dataset);
  const Dataset& description = impl_->format->find(dataset);
  if (impl_->open.count(dataset) || description.unit != source.description->unit ||
      description.type != source.description->type || description.shape.size() != source.lengths.size())
    throw std::logic_error("dataset " + dataset + " cannot be copied");
  impl_->make_groups(dataset);
  if (H5Ocopy(from.impl_->file, dataset.c_str(), impl_->file, dataset.c_str(), H5P_DEFAULT, H5P_DEFAULT) < 0) {
    impl_->whole.check();
    from.impl_->fail(fmt::format("dataset {} cannot be copied (the file is damaged)", dataset));
  }
  Impl::Open& made = impl_->open[dataset];
  made.description = &description;
  made.rows = source.lengths[0];
  made.row_values = source.row_values;
  made.id = Handle(H5Dopen2(impl_->file, dataset.c_str(), H5P_DEFAULT), H5Dclose);
}

}  // namespace dresslife::pipeline
