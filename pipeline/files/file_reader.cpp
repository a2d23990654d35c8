#include <algorithm>
#include <cmath>
#include <type_traits>

#include "pipeline/base/whole_file.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/file_driver.h"
#include "pipeline/files/file_reader_impl.h"
#include "pipeline/files/hdf5_objects.h"

namespace dresslife::pipeline {
namespace {

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
  input.check_reads();
  throw MachineFault({name.string()}, what, fmt::format("make the file again with {}", format->made_by));
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
    fail(fmt::format("attribute '{}' holds {} values (must be one)", attribute, H5Sget_simple_extent_npoints(space)));
  return id;
}

std::string FileReader::Impl::text_of(hid_t object, const std::string& attribute) const {
  const Handle id = one_value(object, attribute);
  const Handle type(H5Aget_type(id), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING) fail(fmt::format("attribute '{}' is not text", attribute));
  if (H5Tis_variable_str(type) > 0) {
    char* words = nullptr;
    if (H5Aread(id, type, &words) < 0 || !words) fail(fmt::format("attribute '{}' cannot be read", attribute));
    std::string text(words);
    H5free_memory(words);
    return text;
  }
  const std::size_t length = H5Tget_size(type);
  if (length > bytes)
    fail(fmt::format("attribute '{}' is a text of {} bytes in a file of {} (the file is damaged)", attribute, length,
                     bytes));
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
    throw InputError({name.string()},
                     fmt::format("has format version {} (this program reads up to {})", version, format->version),
                     "update dresslife");
}

void FileReader::Impl::open_dataset(const Dataset& description) {
  // H5Lexists requires that every group in the path exists.
  for (std::size_t slash = description.path.find('/', 1);; slash = description.path.find('/', slash + 1)) {
    const std::string way = description.path.substr(0, slash);
    const htri_t there = H5Lexists(file, way.c_str(), H5P_DEFAULT);
    if (there <= 0) {
      if (there == 0 && description.may_be_absent) return;
      fail(fmt::format("dataset {} is missing", description.path));
    }
    H5L_info_t link{};
    if (H5Lget_info(file, way.c_str(), &link, H5P_DEFAULT) < 0 || link.type != H5L_TYPE_HARD)
      fail(fmt::format("{} is a link (the data must lie in the file itself)", way));
    if (slash == std::string::npos) break;
  }
  Open made;
  made.description = &description;
  made.id = Handle(H5Dopen2(file, description.path.c_str(), H5P_DEFAULT), H5Dclose);
  if (!made.id.valid()) fail(fmt::format("{} is not a dataset or is damaged", description.path));
  check_type(made);
  check_shape(made);
  check_storage(made);
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
    fail(fmt::format("dataset {} has unit '{}' (must be '{}')", made.description->path, unit, made.description->unit));
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
    const AxisLength axis(shape[i]);
    if (axis.fixed ? made.lengths[i] != axis.fixed : made.lengths[i] < axis.plus)
      fail(fmt::format("dataset {} has length {} (must be {})", made.description->path, made.lengths[i], shape[i]));
    if (axis.fixed) continue;
    const auto [entry, fresh] = axes.emplace(axis.name, made.lengths[i] - axis.plus);
    if (!fresh && entry->second + axis.plus != made.lengths[i])
      fail(fmt::format("dataset {} has {} values along '{}' (others have {})", made.description->path, made.lengths[i],
                       shape[i], entry->second + axis.plus));
  }
}

void FileReader::Impl::read(const Open& from, std::size_t first, std::size_t count, hid_t type, void* out) const {
  if (first + count > from.lengths[0]) throw std::logic_error("rows beyond the end of " + from.description->path);
  std::vector<hsize_t> begin(from.lengths.size(), 0), length = from.lengths;
  begin[0] = first;
  length[0] = count;
  if (count == 0 || from.row_values == 0) return;
  if (from.chunks_to_be_checked) check_chunks(from);
  const Handle file_space(H5Dget_space(from.id), H5Sclose);
  H5Sselect_hyperslab(file_space, H5S_SELECT_SET, begin.data(), nullptr, length.data(), nullptr);
  const Handle memory_space(H5Screate_simple(static_cast<int>(length.size()), length.data(), nullptr), H5Sclose);
  if (H5Dread(from.id, type, memory_space, file_space, H5P_DEFAULT, out) < 0)
    fail(fmt::format("dataset {} cannot be read (the file is damaged)", from.description->path));
}

template <class T>
void FileReader::Impl::read_values(const std::string& path, std::size_t first, std::size_t count,
                                   std::vector<T>& out) const {
  const Open& from = dataset(path);
  if (from.packed_rows && first + count <= from.lengths[0]) {
    from.description->type == Type::f32   ? read_packed<float>(from, first, count, out)
    : from.description->type == Type::f64 ? read_packed<double>(from, first, count, out)
                                          : read_packed<std::uint32_t>(from, first, count, out);
  } else {
    out.resize(count * from.row_values);
    read(from, first, count, number_type(type_of<T>), out.data());
  }
  check_finite(from, first, out);
}

/// Stored: type of the numbers in the file.
template <class Stored, class T>
void FileReader::Impl::read_packed(const Open& from, std::size_t first, std::size_t count, std::vector<T>& out) const {
  const std::size_t numbers = count * from.row_values;
  if constexpr (std::is_same_v<Stored, T>) {
    out.resize(numbers);
    unpack_rows(from, first, count, out.data());
  } else if constexpr (sizeof(Stored) < sizeof(T) || std::is_same_v<T, float>) {
    std::vector<Stored> stored(numbers);
    unpack_rows(from, first, count, stored.data());
    out.assign(stored.begin(), stored.end());
  } else {
    throw std::logic_error("numbers of " + from.description->path + " read as others that do not hold them");
  }
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

/// Opens a file and checks its checksum, if requested, and its format.
void FileReader::open(const std::filesystem::path& file, const Format& format, bool checks_bytes) {
  silence_library();
  impl_->name = file;
  impl_->format = &format;
  if (kind_of(file) == FileKind::absent)
    throw InputError({file.string()}, "is not there",
                     fmt::format("check the path, or make it with {}", format.made_by));
  const std::string remedy = fmt::format("make the file again with {}", format.made_by);
  impl_->input = InputBytes(file);
  impl_->bytes = impl_->input.size();
  impl_->checksum = impl_->input.read_checksum(remedy);
  if (checks_bytes) impl_->input.check(impl_->checksum, remedy);
  const Handle access(access_for_reading(impl_->input), H5Pclose);
  impl_->file = Handle(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  if (!impl_->file.valid()) impl_->fail("is not an HDF5 file, or is cut off");
  impl_->check_format();
}

FileReader::FileReader(const std::filesystem::path& file, const Format& format, Scope scope)
    : impl_(std::make_unique<Impl>()) {
  open(file, format, scope == Scope::everything);
  if (scope == Scope::everything)
    for (const Dataset& description : format.datasets) impl_->open_dataset(description);
  for (const AttributeInfo& attribute : format.attributes)
    if (!attribute.may_be_absent && H5Aexists(impl_->file, attribute.name.c_str()) <= 0)
      impl_->fail(fmt::format("attribute '{}' is missing", attribute.name));
  impl_->input.check_reads();
}

FileReader::FileReader(const std::filesystem::path& file, const Format& format,
                       std::initializer_list<std::string_view> datasets)
    : impl_(std::make_unique<Impl>()) {
  open(file, format, true);
  for (const Dataset& description : format.datasets)
    if (std::ranges::find(datasets, description.path) != datasets.end()) impl_->open_dataset(description);
  impl_->input.check_reads();
}

FileReader::~FileReader() = default;

bool FileReader::has(const std::string& dataset) const { return impl_->open.count(dataset) > 0; }
bool FileReader::has_attribute(const std::string& name) const {
  const htri_t there = H5Aexists(impl_->file, name.c_str());
  if (there < 0) impl_->fail("cannot be read (the file is damaged)");  // HDF5's checksums of attributes do not match
  return there > 0;
}
std::size_t FileReader::length(const std::string& axis) const {
  const auto found = impl_->axes.find(axis);
  return found == impl_->axes.end() ? 0 : found->second;
}
std::size_t FileReader::rows(const std::string& dataset) const { return impl_->dataset(dataset).lengths[0]; }
std::size_t FileReader::row_size(const std::string& dataset) const { return impl_->dataset(dataset).row_values; }

void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count, std::vector<double>& out) const {
  impl_->read_values(d, first, count, out);
}
void FileReader::read_rows(const std::string& d, std::size_t first, std::size_t count, std::vector<float>& out) const {
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

std::string FileReader::stored(const std::string& dataset) const { return impl_->stored(impl_->dataset(dataset)); }

std::string FileReader::text_attribute(const std::string& name) const { return impl_->text_of(impl_->file, name); }

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

/// Returns the format of an open file.
std::string format_in(hid_t file) {
  constexpr std::size_t longest = 100;  // names of formats are short
  if (H5Aexists(file, "format") <= 0) return "";
  const Handle attribute(H5Aopen(file, "format", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || H5Tget_size(type) > longest) return "";
  std::string format(H5Tget_size(type), '\0');
  if (H5Aread(attribute, type, format.data()) < 0 || !format.starts_with("dresslife-")) return "";
  return format.c_str();  // padded with zeros
}

/// Returns the root attribute `format`; empty: not one of our formats, or no file. Errors: those of PlainFile.
std::string written_format(const std::filesystem::path& file) {
  if (kind_of(file) == FileKind::absent) return "";
  silence_library();
  InputBytes input(file);
  const Handle access(access_for_reading(input), H5Pclose);
  const Handle opened(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access), H5Fclose);
  const std::string format = opened.valid() ? format_in(opened) : "";
  input.check_reads();
  return format;
}

}  // namespace

bool is_dresslife_file(const std::filesystem::path& file) {
  return begins_with_checksum(file) || !written_format(file).empty();
}

const Format* format_of(const std::filesystem::path& file) {
  const std::string written = written_format(file);
  for (const Format* format :
       {&motion_format(), &strain_format(), &life_format(), &preview_format(), &screening_format(), &ways_format()})
    if (format->name == written) return format;
  return nullptr;
}

}  // namespace dresslife::pipeline
