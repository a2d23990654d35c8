// libFuzzer's entry for the files between the stages: FUZZ_FORMAT is motion, strain or life. Not part of the
// tests; built by scripts/fuzz.
//
// An input has one of two forms. Bytes that begin with HDF5's signature are a file after its checksum block. All other inputs
// are edits of the seed file named by DRESSLIFE_SEED: values, lengths, units, types, packed chunks and links are changed
// through the HDF5 library, because the library's own checksums would refuse most flipped bits. In both cases the checksum is
// corrected so that the reader accepts it. Then the next stage works on the file. It must end, or refuse the file with an
// InputError.
#include <fcntl.h>
#include <hdf5.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <optional>
#include <vector>

#include "fatigue/life_file.h"
#include "pipeline/base/digest.h"
#include "pipeline/files/checksum.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"
#include "pipeline/report/report.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/study/ranking.h"
#include "strain/strain_file.h"

namespace {

using namespace dresslife;
using Bytes = std::vector<unsigned char>;

enum class Kind { motion, strain, life };
constexpr Kind kind = Kind::FUZZ_FORMAT;
constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";

const pipeline::Format& format() {
  switch (kind) {
    case Kind::motion:
      return pipeline::motion_format();
    case Kind::strain:
      return pipeline::strain_format();
    case Kind::life:
      break;
  }
  return pipeline::life_format();
}

/// The seed, with chunks not larger than their contents, and its job.
struct Seed {
  Bytes bytes;
  std::string job;
};
Seed seed;

/// Reads numbers and pieces of an input in sequence; zeros after its end.
class Choices {
 public:
  Choices(const unsigned char* data, std::size_t size) : at_(data), left_(size) {}
  bool any() const { return left_ > 0; }
  template <class T>
  T next() {
    T value{};
    const std::size_t count = std::min(sizeof value, left_);
    std::memcpy(&value, at_, count);
    at_ += count;
    left_ -= count;
    return value;
  }
  Bytes piece(std::size_t most) {
    const std::size_t count = std::min(most, left_);
    Bytes bytes(at_, at_ + count);
    at_ += count;
    left_ -= count;
    return bytes;
  }

 private:
  const unsigned char* at_;
  std::size_t left_;
};

/// Returns a number that is critical for readers, or a number of the input.
double number(Choices& choices) {
  constexpr double notable[] = {0,     -0.0,   1,   -1,           0.5,          1e-300,
                                1e300, -1e300, 1e9, 4294967295.0, 2147483647.0, -2147483648.0};
  const auto which = choices.next<unsigned char>();
  return which < std::size(notable) ? notable[which] : choices.next<double>();
}

struct Closed {
  hid_t id;
  herr_t (*close)(hid_t);
  Closed(hid_t of, herr_t (*by)(hid_t)) : id(of), close(by) {}
  Closed(const Closed&) = delete;
  ~Closed() {
    if (id >= 0) close(id);
  }
  operator hid_t() const { return id; }
};

void set_text_attribute(hid_t object, const char* name, const std::string& text) {
  H5Adelete(object, name);
  const Closed type{H5Tcopy(H5T_C_S1), H5Tclose};
  H5Tset_size(type, std::max<std::size_t>(1, text.size()));
  const Closed space{H5Screate(H5S_SCALAR), H5Sclose};
  const Closed made{H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
  if (made >= 0) H5Awrite(made, type, text.empty() ? "" : text.data());
}

void set_number_attribute(hid_t object, const char* name, double value) {
  H5Adelete(object, name);
  const Closed space{H5Screate(H5S_SCALAR), H5Sclose};
  const Closed made{H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
  if (made >= 0) H5Awrite(made, H5T_NATIVE_DOUBLE, &value);
}

/// Writes `count` numbers or texts from a position on, in row order.
void change_values(hid_t dataset, Choices& choices) {
  const Closed space{H5Dget_space(dataset), H5Sclose};
  const Closed type{H5Dget_type(dataset), H5Tclose};
  const auto total = static_cast<hsize_t>(std::max<hssize_t>(0, H5Sget_simple_extent_npoints(space)));
  if (total == 0) return;
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> lengths(static_cast<std::size_t>(rank)), at(lengths.size());
  H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  hsize_t place = choices.next<std::uint32_t>() % total;
  for (std::size_t axis = lengths.size(); axis-- > 0;) {
    at[axis] = place % lengths[axis];
    place /= lengths[axis];
  }
  if (H5Sselect_elements(space, H5S_SELECT_SET, 1, at.data()) < 0) return;
  const Closed one{H5Screate(H5S_SCALAR), H5Sclose};
  if (H5Tget_class(type) == H5T_STRING) {
    Bytes text = choices.piece(std::min<std::size_t>(H5Tget_size(type), 40));
    text.resize(H5Tget_size(type));
    H5Dwrite(dataset, type, one, space, H5P_DEFAULT, text.data());
  } else {
    const double value = number(choices);
    H5Dwrite(dataset, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, &value);
  }
}

/// Replaces a dataset by one of the same name with an unexpected type, rank or storage.
void replace(hid_t file, const char* path, Choices& choices) {
  H5Ldelete(file, path, H5P_DEFAULT);
  const hid_t types[] = {H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I32LE, H5T_STD_U64BE, H5T_STD_I8LE, H5T_C_S1};
  const hid_t type = types[choices.next<unsigned char>() % std::size(types)];
  const int rank = choices.next<unsigned char>() % 4;
  std::vector<hsize_t> lengths, chunk;
  for (int axis = 0; axis < rank; ++axis) {
    lengths.push_back(axis == 0 ? choices.next<std::uint32_t>() >> choices.next<unsigned char>() % 32
                                : choices.next<unsigned char>() % 9u);
    chunk.push_back(std::max<hsize_t>(1, std::min<hsize_t>(lengths.back(), 64)));
  }
  const Closed creation{H5Pcreate(H5P_DATASET_CREATE), H5Pclose};
  if (rank > 0 && choices.next<unsigned char>() % 2) H5Pset_chunk(creation, rank, chunk.data());
  const Closed space{H5Screate_simple(rank, lengths.data(), nullptr), H5Sclose};
  const Closed made{H5Dcreate2(file, path, type, space, H5P_DEFAULT, creation, H5P_DEFAULT), H5Dclose};
  if (made >= 0) set_text_attribute(made, "unit", format().find(path).unit);
}

/// A packed chunk as bytes.
struct RawChunk {
  std::string dataset;
  bool unfiltered = false;
  Bytes bytes;
};

void write_raw(hid_t file, const RawChunk& raw) {
  const Closed dataset{H5Dopen2(file, raw.dataset.c_str(), H5P_DEFAULT), H5Dclose};
  hsize_t chunks = 0;  // the library crashes if it has not written a chunk itself
  if (dataset < 0 || H5Dget_num_chunks(dataset, H5S_ALL, &chunks) < 0 || chunks == 0) return;
  const Closed space{H5Dget_space(dataset), H5Sclose};
  const std::vector<hsize_t> first(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 1)), 0);
  H5Dwrite_chunk(dataset, H5P_DEFAULT, raw.unfiltered, first.data(), raw.bytes.size(), raw.bytes.data());
}

void edit_dataset(hid_t file, const std::string& path, Choices& choices, std::optional<RawChunk>& raw) {
  const Closed dataset{H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (dataset < 0) return;
  const Closed space{H5Dget_space(dataset), H5Sclose};
  const int rank = H5Sget_simple_extent_ndims(space);
  std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(rank, 1)));
  H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  switch (choices.next<unsigned char>() % 8) {
    case 0:
    case 1:
    case 2:
      return change_values(dataset, choices);
    case 3:
      if (lengths[0] > 1u << 24) return;  // lengthened before; the library would shorten it chunk by chunk for minutes
      lengths[0] = choices.next<std::uint32_t>() >> choices.next<unsigned char>() % 32;
      H5Dset_extent(dataset, lengths.data());
      return;
    case 4: {
      Bytes chunk = choices.piece(choices.next<std::uint16_t>() % 4096u + 1u);
      chunk.resize(std::max<std::size_t>(1, chunk.size()));
      raw = RawChunk{path, choices.next<unsigned char>() % 4 == 0, std::move(chunk)};
      return;
    }
    case 5:
      return set_text_attribute(dataset, "unit", choices.next<unsigned char>() % 2 ? "m" : "");
    case 6:
      return replace(file, path.c_str(), choices);
    default:
      H5Ldelete(file, path.c_str(), H5P_DEFAULT);
      if (choices.next<unsigned char>() % 2) H5Lcreate_soft("/time", file, path.c_str(), H5P_DEFAULT, H5P_DEFAULT);
  }
}

void edit_attribute(hid_t file, Choices& choices) {
  const auto& known = format().attributes;
  const std::size_t which = choices.next<unsigned char>() % (known.size() + 2);
  if (which < known.size()) {
    const char* const name = known[which].name.c_str();
    if (choices.next<unsigned char>() % 4 == 0)
      H5Adelete(file, name);
    else if (known[which].is_text)
      set_text_attribute(file, name, [&] {
        const Bytes text = choices.piece(40);
        return std::string(text.begin(), text.end());
      }());
    else
      set_number_attribute(file, name, number(choices));
  } else if (which == known.size()) {
    set_number_attribute(file, "format_version", number(choices));
  } else {
    std::string job = seed.job;
    job[choices.next<std::uint16_t>() % job.size()] = static_cast<char>(choices.next<unsigned char>());
    set_text_attribute(file, "job", job);
  }
}

/// A temporary file in memory, removed afterwards. (The library needs a name that leads to it, which no name in /proc does.)
class File {
 public:
  File() : descriptor_(::mkostemp(name_.data(), O_CLOEXEC)) {}
  explicit File(const Bytes& bytes) : File() { write(bytes.data(), bytes.size(), 0); }
  ~File() {
    ::unlink(name_.c_str());
    ::close(descriptor_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  const std::string& name() const { return name_; }

  std::size_t size() const { return static_cast<std::size_t>(::lseek(descriptor_, 0, SEEK_END)); }
  Bytes bytes() const {
    Bytes all(size());
    if (!pipeline::read_at(descriptor_, all.data(), all.size(), 0)) std::abort();
    return all;
  }
  /// Sets the checksum to that of the bytes after it.
  void sign() const {
    const Bytes all = bytes();
    if (all.size() < pipeline::checksum_block_bytes) return;
    const std::string_view data(reinterpret_cast<const char*>(all.data()), all.size());
    const std::string_view signed_part = data.substr(pipeline::checksum_block_bytes);
    const std::string block = pipeline::checksum_block(pipeline::xxh3(signed_part), signed_part.size());
    write(block.data(), block.size(), 0);
  }
  void write(const void* from, std::size_t count, std::uint64_t at) const {
    if (::pwrite(descriptor_, from, count, static_cast<off_t>(at)) != static_cast<ssize_t>(count)) std::abort();
  }

 private:
  std::string name_ = "/dev/shm/dresslife-fuzz-XXXXXX";
  int descriptor_;
};

void copy_attributes(hid_t from, hid_t to) {
  const auto copy = [](hid_t source, const char* name, const H5A_info_t*, void* target) -> herr_t {
    const Closed attribute{H5Aopen(source, name, H5P_DEFAULT), H5Aclose};
    const Closed type{H5Aget_type(attribute), H5Tclose}, space{H5Aget_space(attribute), H5Sclose};
    Bytes value(H5Tget_size(type));
    if (H5Aread(attribute, type, value.data()) < 0) return -1;
    const Closed made{H5Acreate2(*static_cast<hid_t*>(target), name, type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
    return H5Awrite(made, type, value.data());
  };
  if (H5Aiterate2(from, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, copy, &to) < 0) std::abort();
}

/// Copies a dataset into chunks not larger than its contents: changing a seed of 2 MB would be slow.
void copy_small(hid_t from, hid_t to, const std::string& path) {
  const Closed source{H5Dopen2(from, path.c_str(), H5P_DEFAULT), H5Dclose};
  if (source < 0) return;
  const Closed type{H5Dget_type(source), H5Tclose}, space{H5Dget_space(source), H5Sclose};
  const Closed creation{H5Dget_create_plist(source), H5Pclose}, links{H5Pcreate(H5P_LINK_CREATE), H5Pclose};
  std::vector<hsize_t> lengths(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  for (hsize_t& length : lengths) length = std::max<hsize_t>(1, length);
  H5Pset_chunk(creation, static_cast<int>(lengths.size()), lengths.data());
  H5Pset_create_intermediate_group(links, 1);
  const Closed made{H5Dcreate2(to, path.c_str(), type, space, links, creation, H5P_DEFAULT), H5Dclose};
  Bytes values(H5Tget_size(type) *
               static_cast<std::size_t>(std::max<hssize_t>(1, H5Sget_simple_extent_npoints(space))));
  if (H5Dread(source, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0 ||
      H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    std::abort();
  copy_attributes(source, made);
}

void make_seed(const std::string& large_name) {
  const File small_file;
  {
    const Closed large{H5Fopen(large_name.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose};
    const Closed access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose}, creation{H5Pcreate(H5P_FILE_CREATE), H5Pclose};
    H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
    H5Pset_userblock(creation, pipeline::checksum_block_bytes);
    const Closed small{H5Fcreate(small_file.name().c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose};
    for (const pipeline::Dataset& dataset : format().datasets) copy_small(large, small, dataset.path);
    copy_attributes(large, small);
  }
  small_file.sign();
  seed.bytes = small_file.bytes();
  seed.job = pipeline::FileReader(large_name, format()).text_attribute("job");
}

/// Applies the edits of the input. A raw chunk is edited last and after the file was opened again, because the library reads
/// beyond the end of a short chunk if it continues to edit.
void edit(const File& target, Choices choices) {
  const Closed access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_V18);
  const auto opened = [&] { return H5Fopen(target.name().c_str(), H5F_ACC_RDWR, access); };
  std::optional<RawChunk> raw;
  {
    const Closed file{opened(), H5Fclose};
    const auto& datasets = format().datasets;
    for (int k = 0; file >= 0 && k < 8 && choices.any(); ++k) {
      const std::size_t which = choices.next<unsigned char>() % (datasets.size() + datasets.size() / 4);
      if (which < datasets.size())
        edit_dataset(file, datasets[which].path, choices, raw);
      else
        edit_attribute(file, choices);
    }
  }
  const Closed file{raw ? opened() : H5I_INVALID_HID, H5Fclose};
  if (file >= 0) write_raw(file, *raw);
}

/// Processes the file as the next stage does, with the seed's job. Settings of other jobs are not part of this test.
void use(const std::string& name) {
  if (kind == Kind::life) {
    std::vector<pipeline::ReportProblem> problems;
    pipeline::report_page("fuzz", pipeline::read_ranking({{"job", name, ""}}), problems);
    return;
  }
  const pipeline::FileReader file(name, format());
  const std::string text = file.text_attribute("job");
  const pipeline::Job job = pipeline::job_from(pipeline::parse_yaml(text, name));
  if (text != seed.job) return;
  const auto silent = [](double) {};
  const std::string folder = std::getenv("DRESSLIFE_FUZZ_FOLDER");
  if (kind == Kind::motion) {
    pipeline::FileWriter out(folder + "/strain.h5", pipeline::strain_format());
    strain::write_strain(file, job, out, 1, silent);
  } else {
    pipeline::FileWriter out(folder + "/life.h5", pipeline::life_format());
    fatigue::write_life(file, job, out, 1, silent);
  }
}

int refused_or_used(const File& file) {
  try {
    use(file.name());
  } catch (const pipeline::InputError&) {
  }
  return 0;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  make_seed(std::getenv("DRESSLIFE_SEED"));
  try {  // a seed that is refused would test only the refusal
    use(File(seed.bytes).name());
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "%s\n", problem.what());
    std::abort();
  }
  std::ofstream whole("corpus/whole", std::ios::binary);
  for (auto at = pipeline::checksum_block_bytes; at < seed.bytes.size(); ++at)
    whole.put(static_cast<char>(seed.bytes[at]));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const bool whole = size >= signature.size() && std::memcmp(data, signature.data(), signature.size()) == 0;
  const File file(whole ? Bytes() : seed.bytes);
  if (whole)
    file.write(data, size, pipeline::checksum_block_bytes);
  else
    edit(file, {data, size});
  constexpr std::size_t largest = 64 << 20;  // the library has filled this length; larger ones only use memory
  if (file.size() > largest) return 0;
  file.sign();
  return refused_or_used(file);
}
