// Storage of a dataset's values in a file: the checks of a FileReader, and the chunks that it unpacks itself.
#include <algorithm>
#include <array>

#include "pipeline/files/file_reader_impl.h"
#include "pipeline/files/list_deflate.h"
#include "pipeline/files/scale_offset.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_chunk_bytes =
    64 << 20;  // one chunk is kept unpacked; other programs write chunks of 1 MB or less

using Filters = std::vector<H5Z_filter_t>;

/// Returns the filters in the order of packing.
Filters filters_of(hid_t creation) {
  Filters filters;
  for (int k = 0; k < H5Pget_nfilters(creation); ++k) {
    unsigned flags = 0, config = 0;
    std::size_t no_values = 0;
    filters.push_back(
        H5Pget_filter2(creation, static_cast<unsigned>(k), &flags, &no_values, nullptr, 0, nullptr, &config));
  }
  return filters;
}

/// Returns whether the dataset contains numbers of this class and size, in the byte order of the memory.
bool is_of(H5T_class_t numbers, std::size_t bytes, hid_t dataset) {
  const Handle type(H5Dget_type(dataset), H5Tclose);
  return H5Tget_class(type) == numbers && H5Tget_size(type) == bytes && H5Tget_order(type) == H5T_ORDER_LE &&
         (numbers == H5T_FLOAT || H5Tget_sign(type) == H5T_SGN_NONE);
}

/// Returns whether the first filter of the dataset has the parameters of scale_offset.h.
bool is_scale_offset(hid_t creation, int decimals) {
  std::array<unsigned, 20> values{};  // scale type, scale, numbers per chunk, class, size, sign, order, fill value ...
  std::size_t count = values.size();
  unsigned flags = 0, config = 0;
  H5Pget_filter2(creation, 0, &flags, &count, values.data(), 0, nullptr, &config);
  H5D_fill_value_t fill = H5D_FILL_VALUE_ERROR;
  H5Pfill_value_defined(creation, &fill);
  return fill == H5D_FILL_VALUE_UNDEFINED && values[0] == H5Z_SO_FLOAT_DSCALE &&
         static_cast<int>(values[1]) == decimals;
}

}  // namespace

void FileReader::Impl::check_storage(Open& made) const {
  const std::string& path = made.description->path;
  const Handle creation(H5Dget_create_plist(made.id), H5Pclose);
  const Handle type(H5Dget_type(made.id), H5Tclose);
  hsize_t promised = H5Tget_size(type);
  for (const hsize_t length : made.lengths)
    if (__builtin_mul_overflow(promised, length, &promised)) fail(fmt::format("dataset {} is too large", path));
  const H5D_layout_t layout = H5Pget_layout(creation);
  if (H5Pget_external_count(creation) != 0 || layout == H5D_VIRTUAL)
    fail(fmt::format("dataset {} lies in other files (the data must lie in the file itself)", path));
  if (promised == 0) return;
  if (layout == H5D_CHUNKED) {
    check_chunks_are_there(made, creation);
    return choose_reading(made, creation);
  }
  if (H5Dget_storage_size(made.id) != promised) fail(fmt::format("dataset {} was never filled", path));
  if (promised > bytes)
    fail(fmt::format("dataset {} is larger than its file of {} bytes (the file is damaged)", path, bytes));
}

void FileReader::Impl::check_chunks_are_there(Open& made, hid_t creation) const {
  const std::string& path = made.description->path;
  made.chunk.resize(made.lengths.size());
  H5Pget_chunk(creation, static_cast<int>(made.chunk.size()), made.chunk.data());
  const Handle type(H5Dget_type(made.id), H5Tclose);
  hsize_t needed = 1, found = 0, chunk_size = H5Tget_size(type);
  for (std::size_t i = 0; i < made.chunk.size(); ++i) {
    const hsize_t along = made.lengths[i] / made.chunk[i] + (made.lengths[i] % made.chunk[i] != 0);
    if (__builtin_mul_overflow(needed, along, &needed) ||
        __builtin_mul_overflow(chunk_size, made.chunk[i], &chunk_size))
      fail(fmt::format("dataset {} is too large", path));
  }
  if (chunk_size > most_chunk_bytes) fail(fmt::format("dataset {} has chunks of {} bytes", path, chunk_size));
  check_fits(made, needed, chunk_size, H5Pget_nfilters(creation) > 0);
  const Handle space(H5Dget_space(made.id), H5Sclose);
  if (H5Dget_num_chunks(made.id, space, &found) < 0 || found != needed)
    fail(fmt::format("dataset {} has {} of its {} chunks (the file is damaged)", path, found, needed));
}

void FileReader::Impl::choose_reading(Open& made, hid_t creation) const {
  const Filters filters = filters_of(creation);
  const std::optional<int> decimals = made.description->decimals;
  const bool is_list = made.description->type == Type::u32 && made.chunk.size() == 1 && is_of(H5T_INTEGER, 4, made.id);
  const bool has_whole_rows = std::equal(made.chunk.begin() + 1, made.chunk.end(), made.lengths.begin() + 1);
  const std::size_t float_bytes = made.description->type == Type::f32 ? 4 : 8;
  if (filters.empty())
    read_without_cache(made);
  else if (filters == Filters{H5Z_FILTER_SCALEOFFSET} && decimals && is_scale_offset(creation, *decimals) &&
           has_whole_rows && is_of(H5T_FLOAT, float_bytes, made.id))
    made.packed_rows = made.chunk[0];
  else if (filters == Filters{H5Z_FILTER_DEFLATE} && is_list)
    made.packed_rows = made.chunk[0];
  else if (filters == Filters{H5Z_FILTER_DEFLATE} || filters == Filters{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE})
    made.chunks_to_be_checked = true;
  else
    throw InputError(
        {name.string()},
        fmt::format("dataset {} is packed by a filter of HDF5 that is not read here", made.description->path),
        "write it without filters, or with deflate (gzip), shuffled or not");
}

void FileReader::Impl::check_fits(const Open& made, hsize_t chunks, hsize_t chunk_size, bool filtered) const {
  constexpr hsize_t least_index_bytes = 4;  // per chunk: at least its length is stored
  const std::string& path = made.description->path;
  if (chunks > bytes / (filtered ? least_index_bytes : chunk_size))
    fail(fmt::format("dataset {} promises {} chunks of {} bytes in a file of {} (the file is damaged)", path, chunks,
                     chunk_size, bytes));
  if (H5Dget_storage_size(made.id) > bytes)
    fail(fmt::format("dataset {} is larger than its file of {} bytes (the file is damaged)", path, bytes));
}

void FileReader::Impl::read_without_cache(Open& made) const {
  made.id.reset();  // a dataset that is opened twice uses the cache of the first one
  const Handle access(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(access, 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  made.id = Handle(H5Dopen2(file, made.description->path.c_str(), access), H5Dclose);
  if (!made.id.valid()) fail(fmt::format("dataset {} cannot be opened", made.description->path));
}

void FileReader::Impl::read_chunk(const Open& from, const hsize_t* at, std::vector<char>& packed) const {
  hsize_t size = 0;
  std::uint32_t filters_skipped = 0;
  const bool found = H5Dget_chunk_storage_size(from.id, at, &size) >= 0;
  packed.resize(size);
  if (!found || H5Dread_chunk(from.id, H5P_DEFAULT, at, &filters_skipped, packed.data()) < 0 || filters_skipped != 0)
    fail_at_chunk(from);
}

void FileReader::Impl::fail_at_chunk(const Open& from) const {
  fail(fmt::format("dataset {} has a chunk that is not packed as it should be (the file is damaged)",
                   from.description->path));
}

template <class Use>
void FileReader::Impl::for_each_chunk(const Open& from, const Use& use) const {
  std::vector<char> packed;
  std::vector<hsize_t> at(from.chunk.size(), 0);
  while (at[0] < from.lengths[0]) {
    read_chunk(from, at.data(), packed);
    use(packed);
    std::size_t axis = at.size() - 1;
    for (at[axis] += from.chunk[axis]; axis > 0 && at[axis] >= from.lengths[axis]; at[axis] += from.chunk[axis])
      at[axis--] = 0;
  }
}

void FileReader::Impl::check_chunks(const Open& made) const {
  const Handle type(H5Dget_type(made.id), H5Tclose);
  std::size_t bytes_of_one = H5Tget_size(type);
  for (const hsize_t along : made.chunk) bytes_of_one *= along;
  Inflater inflater;
  std::vector<char> unpacked(bytes_of_one);
  for_each_chunk(made, [&](const std::vector<char>& packed) {
    if (!inflater.unpack(packed, unpacked)) fail_at_chunk(made);
  });
  made.chunks_to_be_checked = false;
}

std::string FileReader::Impl::stored(const Open& from) const {
  const Handle type(H5Dget_type(from.id), H5Tclose), creation(H5Dget_create_plist(from.id), H5Pclose);
  if (from.chunk.empty() || H5Tis_variable_str(type) > 0) return "";
  std::size_t length = 0;
  H5Tencode(type, nullptr, &length);
  std::string all(length, '\0');
  if (length == 0 || H5Tencode(type, all.data(), &length) < 0) return "";
  for (const H5Z_filter_t filter : filters_of(creation)) all += fmt::format(" {}", filter);
  for (std::size_t axis = 0; axis < from.chunk.size(); ++axis)
    all += fmt::format(" {}/{}", from.lengths[axis], from.chunk[axis]);
  for_each_chunk(from, [&](const std::vector<char>& packed) {
    all += fmt::format(" {}:", packed.size());
    all.append(packed.begin(), packed.end());
  });
  return all;
}

template <class T, class Unpack>
void FileReader::Impl::unpack_rows(const Open& from, std::size_t first, std::size_t count, T* out,
                                   const Unpack& unpack) const {
  std::vector<char> packed;
  std::vector<char>& unpacked = from.unpacked;
  const std::size_t row_values = from.row_values;
  for (std::size_t row = first, end = first + count; row < end;) {
    std::vector<hsize_t> chunk(from.lengths.size(), 0);
    chunk[0] = row / from.packed_rows * from.packed_rows;
    if (unpacked.empty() || from.unpacked_at != chunk[0]) {
      read_chunk(from, chunk.data(), packed);
      unpacked.resize(from.packed_rows * row_values * sizeof(T));
      if (!unpack(std::span<const char>(packed),
                  {reinterpret_cast<T*>(unpacked.data()), from.packed_rows * row_values})) {
        unpacked.clear();
        fail_at_chunk(from);
      }
      from.unpacked_at = chunk[0];
    }
    const std::size_t here = std::min<std::size_t>(end, chunk[0] + from.packed_rows) - row;
    std::copy_n(reinterpret_cast<const T*>(unpacked.data()) + (row - chunk[0]) * row_values, here * row_values, out);
    row += here;
    out += here * row_values;
  }
}

void FileReader::Impl::unpack_rows(const Open& from, std::size_t first, std::size_t count, float* out) const {
  unpack_rows(from, first, count, out, [&](std::span<const char> chunk, std::span<float> numbers) {
    return unpack_chunk(chunk, *from.description->decimals, numbers);
  });
}

void FileReader::Impl::unpack_rows(const Open& from, std::size_t first, std::size_t count, double* out) const {
  unpack_rows(from, first, count, out, [&](std::span<const char> chunk, std::span<double> numbers) {
    return unpack_chunk(chunk, *from.description->decimals, numbers);
  });
}

void FileReader::Impl::unpack_rows(const Open& from, std::size_t first, std::size_t count, std::uint32_t* out) const {
  Inflater inflater;
  unpack_rows(from, first, count, out, [&](std::span<const char> chunk, std::span<std::uint32_t> numbers) {
    return inflater.unpack(chunk, {reinterpret_cast<char*>(numbers.data()), numbers.size_bytes()});
  });
}

}  // namespace dresslife::pipeline
