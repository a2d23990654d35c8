#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <type_traits>

#include "pipeline/files/checksum.h"
#include "pipeline/files/file_driver.h"
#include "pipeline/files/file_reader_impl.h"
#include "pipeline/files/hdf5_objects.h"
#include "pipeline/files/scale_offset.h"
#include "pipeline/whole_file.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_chunk_bytes = 64
                                         << 20;  // one is held unpacked; other programs write 1 MB and less

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

}  // namespace

void FileReader::Impl::fail(const std::string& what) const {
  throw_if_out_of_memory();
  throw InputError({name.string()}, what, fmt::format("make the file anew with {}", format->made_by));
}

const FileReader::Impl::Open& FileReader::Impl::dataset(const std::string& path) const {
  const auto found = open.find(path);
  if (found == open.end()) fail(fmt::format("dataset {} is missing", path));
  return found->second;
}

Handle FileReader::Impl::one_value(hid_t object, const std::string& attribute) const {
  Handle id(H5Aopen(object, attribute.c_str(), H5P_DEFAULT), H5Aclose);
  if (!id.valid()) fail(fmt::format("attribute '{}' is missing", attribute));
  const Handle space(H5Aget_space(id), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1)
    fail(fmt::format("attribute '{}' holds {} values (must be one)", attribute,
                     H5Sget_simple_extent_npoints(space)));
  return id;
}

std::string FileReader::Impl::text_of(hid_t object, const std::string& attribute) const {
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

void FileReader::Impl::read_number(const std::string& attribute, hid_t type, void* number) const {
  if (H5Aread(one_value(file, attribute), type, number) < 0)
    fail(fmt::format("attribute '{}' is missing or not a number", attribute));
}

void FileReader::Impl::check_format() {
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

void FileReader::Impl::open_dataset(const Dataset& description) {
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

void FileReader::Impl::check_type(const Open& made) const {
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

void FileReader::Impl::check_shape(Open& made) {
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

void FileReader::Impl::check_storage(const Open& made) const {
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
  if (chunk_size > most_chunk_bytes) fail(fmt::format("dataset {} has chunks of {} bytes", path, chunk_size));
  check_fits(made, creation, needed, chunk_size);
  if (H5Dget_num_chunks(made.id, space, &found) < 0 || found != needed)
    fail(fmt::format("dataset {} has {} of its {} chunks (the file is damaged)", path, found, needed));
  if (H5Pget_nfilters(creation) > 0) check_filtered(made, chunk);
}

/// The library takes a chunk that says it is not filtered for whole, however short it lies in the file, and
/// reads on behind it.
void FileReader::Impl::check_filtered(const Open& made, const std::vector<hsize_t>& chunk) const {
  std::vector<hsize_t> at(chunk.size(), 0);
  while (at[0] < made.lengths[0]) {
    unsigned skipped = 0;
    haddr_t place = 0;
    hsize_t size = 0;
    if (H5Dget_chunk_info_by_coord(made.id, at.data(), &skipped, &place, &size) < 0 || skipped != 0)
      fail(fmt::format("dataset {} has a chunk that is not packed as it should be (the file is damaged)",
                       made.description->path));
    std::size_t axis = at.size() - 1;
    for (at[axis] += chunk[axis]; axis > 0 && at[axis] >= made.lengths[axis]; at[axis] += chunk[axis])
      at[axis--] = 0;
  }
}

void FileReader::Impl::check_fits(const Open& made, hid_t creation, hsize_t chunks,
                                  hsize_t chunk_size) const {
  constexpr hsize_t least_index_bytes = 4;  // of a chunk: at least its length stands somewhere
  const std::string& path = made.description->path;
  const hsize_t least = H5Pget_nfilters(creation) > 0 ? least_index_bytes : chunk_size;
  if (chunks > bytes / least)
    fail(fmt::format("dataset {} promises {} chunks of {} bytes in a file of {} (the file is damaged)", path,
                     chunks, chunk_size, bytes));
  if (H5Dget_storage_size(made.id) > bytes)
    fail(fmt::format("dataset {} is larger than its file of {} bytes (the file is damaged)", path, bytes));
}

std::size_t FileReader::Impl::packed_rows_of(const Open& made) {
  const Handle creation(H5Dget_create_plist(made.id), H5Pclose);
  const Handle type(H5Dget_type(made.id), H5Tclose);
  if (H5Pget_layout(creation) != H5D_CHUNKED || H5Pget_nfilters(creation) != 1 || H5Tget_size(type) != 4 ||
      H5Tget_order(type) != H5T_ORDER_LE)
    return 0;
  std::array<unsigned, 20>
      values{};  // scale type, scale, numbers a chunk, class, size, sign, order, fill value ...
  std::size_t count = values.size();
  unsigned flags = 0, config = 0;
  const H5Z_filter_t filter = H5Pget_filter2(creation, 0, &flags, &count, values.data(), 0, nullptr, &config);
  H5D_fill_value_t fill = H5D_FILL_VALUE_ERROR;
  H5Pfill_value_defined(creation, &fill);
  hsize_t chunk = 0;
  H5Pget_chunk(creation, 1, &chunk);
  const bool ours = filter == H5Z_FILTER_SCALEOFFSET && fill == H5D_FILL_VALUE_UNDEFINED &&
                    values[0] == H5Z_SO_FLOAT_DSCALE &&
                    static_cast<int>(values[1]) == *made.description->decimals;
  return ours ? chunk : 0;
}

void FileReader::Impl::read_packed(const Open& from, std::size_t first, std::size_t count, float* out) const {
  check_library_memory();
  std::vector<char> packed;
  std::vector<float> numbers(from.packed_rows);
  for (std::size_t row = first, end = first + count; row < end;) {
    const hsize_t chunk = row / from.packed_rows * from.packed_rows;
    hsize_t size = 0;
    std::uint32_t unfiltered = 0;
    const bool found = H5Dget_chunk_storage_size(from.id, &chunk, &size) >= 0;
    packed.resize(size);
    if (!found || H5Dread_chunk(from.id, H5P_DEFAULT, &chunk, &unfiltered, packed.data()) < 0 || unfiltered ||
        !unpack_chunk(packed, *from.description->decimals, std::span(numbers)))
      fail(fmt::format("dataset {} cannot be read (the file is damaged)", from.description->path));
    const std::size_t here = std::min<std::size_t>(end, chunk + from.packed_rows) - row;
    std::copy_n(numbers.data() + (row - chunk), here, out);
    row += here;
    out += here;
  }
}

void FileReader::Impl::read(const Open& from, std::size_t first, std::size_t count, hid_t type,
                            void* out) const {
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
void FileReader::Impl::read_values(const std::string& path, std::size_t first, std::size_t count,
                                   std::vector<T>& out) const {
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
void FileReader::Impl::check_finite(const Open& from, std::size_t first, const std::vector<T>& out) const {
  if constexpr (std::is_floating_point_v<T>) {
    for (std::size_t i = 0; i < out.size(); ++i)
      if (std::isnan(out[i]) || (std::isinf(out[i]) && !from.description->may_be_infinite))
        fail(fmt::format("dataset {} holds a non-finite number in row {}", from.description->path,
                         first + i / from.row_values));
  }
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
  impl_->bytes =
      static_cast<std::uint64_t>(std::max<std::int64_t>(0, state_of(impl_->input.descriptor()).size));
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
