#include "pipeline/files/files.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "pipeline/base/constants.h"
#include "tests/catch.h"
#include "tests/pipeline/files/library.h"
#include "tests/pipeline/scratch.h"

#ifdef __SANITIZE_ADDRESS__
// The HDF5 library leaks some of its own memory when it opens a damaged file. The tests below damage hundreds.
extern "C" const char* __lsan_default_suppressions() { return "leak:libhdf5"; }
#endif

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns a format with every type, a trailing axis, an axis plus one, text and optional parts.
Format sample_format() {
  Format format{"dresslife-sample", 2, "dresslife-maker", "tests", {}, {}};
  format.datasets = {
      {"/time", Type::f64, {"sample"}, "s", "time"},
      {"/deep/er/field", Type::f64, {"sample", "place", "3"}, "m", "a field"},
      {"/single", Type::f32, {"sample"}, "1", "single precision"},
      {"/index", Type::i32, {"sample"}, "1", "signed"},
      {"/number", Type::u32, {"sample"}, "1", "unsigned"},
      {"/offset", Type::u64, {"sample+1"}, "1", "offsets"},
      {"/word", Type::text, {"line"}, "1", "text"},
      {"/life", Type::f64, {"line"}, "1", "may be infinite", true},
      {"/extra", Type::f64, {"extra"}, "1", "may be absent", false, true},
  };
  format.datasets[6].deflate = true;
  format.attributes = {{"total", "a number"}, {"note", "a text", true, true}};
  return format;
}

const std::vector<std::string> words{"signal cable 3/conductor 2", "", "Käfig", "a\nb"};

struct Content {
  std::vector<double> time{0, 0.1, 0.2}, field = std::vector<double>(3 * 2 * 3);
  std::vector<float> single{1.5f, -2.25f, 1e-30f};
  std::vector<std::int32_t> index{-5, 0, 2147483647};
  std::vector<std::uint32_t> number{0, 1, 4294967295u};
  std::vector<std::uint64_t> offset{0, 1, 2, 18446744073709551615ull};
  std::vector<double> life{1, infinity, 1e-300, 3};
  Content() {
    for (std::size_t i = 0; i < field.size(); ++i) field[i] = std::sqrt(static_cast<double>(i));
  }
};

void write_sample(const fs::path& file, const Format& format, const Content& content = {}) {
  FileWriter writer(file, format);
  writer.set_axis("place", 2);
  for (const Dataset& dataset : format.datasets) {
    if (dataset.path == "/time") writer.append("/time", std::span<const double>(content.time));
    if (dataset.path == "/deep/er/field") writer.append("/deep/er/field", std::span<const double>(content.field));
    if (dataset.path == "/single") writer.append("/single", std::span<const float>(content.single));
    if (dataset.path == "/index") writer.append("/index", std::span<const std::int32_t>(content.index));
    if (dataset.path == "/number") writer.append("/number", std::span<const std::uint32_t>(content.number));
    if (dataset.path == "/offset") writer.append("/offset", std::span<const std::uint64_t>(content.offset));
    if (dataset.path == "/word" && dataset.type == Type::text)
      writer.append("/word", std::span<const std::string>(words));
    if (dataset.path == "/life") writer.append("/life", std::span<const double>(content.life));
  }
  writer.attribute("total", 0.1);
  writer.commit();
}

/// Returns the error from reading all of a file that was written with the format `written` and is expected to be `expected`.
std::string refusal(const Format& written, const Format& expected, const Content& content = {}) {
  const Scratch scratch;
  const fs::path file = scratch / "f.h5";
  write_sample(file, written, content);
  const std::string message = message_of([&] {
    const FileReader reader(file, expected);
    for (const Dataset& dataset : expected.datasets)
      if (reader.has(dataset.path) && dataset.type != Type::text) reader.read<double>(dataset.path);
  });
  CHECK(message.find('\n') == std::string::npos);
  REQUIRE(message.starts_with(file.string() + ": error: "));
  return message.substr(file.string().size() + 9);
}

Format changed(const std::function<void(Format&)>& change) {
  Format format = sample_format();
  change(format);
  return format;
}

TEST_CASE("files: every type comes back as it was written") {
  const Scratch scratch;
  const Format format = sample_format();
  const Content content;
  write_sample(scratch / "f.h5", format);
  const FileReader reader(scratch / "f.h5", format);
  CHECK(reader.read<double>("/time") == content.time);
  CHECK(reader.read<double>("/deep/er/field") == content.field);
  CHECK(reader.read<float>("/single") == content.single);
  CHECK(reader.read<std::int32_t>("/index") == content.index);
  CHECK(reader.read<std::uint32_t>("/number") == content.number);
  CHECK(reader.read<std::uint64_t>("/offset") == content.offset);
  CHECK(reader.read<std::string>("/word") == words);
  CHECK(reader.read<double>("/life") == content.life);
  CHECK_FALSE(reader.has("/extra"));
  CHECK(reader.has("/time"));
  CHECK(reader.length("sample") == 3);
  CHECK(reader.length("place") == 2);
  CHECK(reader.length("nothing") == 0);
  CHECK(reader.rows("/offset") == 4);
  CHECK(reader.row_size("/deep/er/field") == 6);
  CHECK(reader.number_attribute("total") == 0.1);
  CHECK_FALSE(reader.has_attribute("note"));
  CHECK(reader.where().text() == (scratch / "f.h5").string());
}

TEST_CASE("files: values convert to the type of the dataset and of the reader") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/single", Type::f32, {"a"}, "1", ""}, {"/whole", Type::u32, {"a"}, "1", ""}};
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/single", std::span<const double>(std::vector<double>{0.1, 2}));
    writer.append("/whole", std::span<const std::int32_t>(std::vector<std::int32_t>{7, 8}));
    writer.commit();
  }
  const FileReader reader(scratch / "f.h5", format);
  CHECK(reader.read<double>("/single")[0] == static_cast<double>(0.1f));
  CHECK(reader.read<std::uint64_t>("/whole")[1] == 8);
}

TEST_CASE("files: attributes alone can be read, also of a file whose datasets are incomplete") {
  const Scratch scratch;
  const Format whole = sample_format();
  Format partial = whole;
  partial.datasets.resize(1);
  write_sample(scratch / "f.h5", partial);
  const FileReader reader(scratch / "f.h5", whole, FileReader::Scope::attributes);
  CHECK(reader.number_attribute("total") == 0.1);
  CHECK_FALSE(reader.has("/time"));
  CHECK(message_of([&] { reader.read<double>("/time"); }).find("dataset /time is missing") != std::string::npos);
}

TEST_CASE("files: rows are read from anywhere") {
  const Scratch scratch;
  const Format format = sample_format();
  write_sample(scratch / "f.h5", format);
  const FileReader reader(scratch / "f.h5", format);
  std::vector<double> rows;
  reader.read_rows("/deep/er/field", 1, 2, rows);
  const std::vector<double> field = Content().field;
  CHECK(rows == std::vector<double>(field.begin() + 6, field.end()));
  reader.read_rows("/deep/er/field", 3, 0, rows);
  CHECK(rows.empty());
  std::vector<std::string> some;
  reader.read_rows("/word", 2, 1, some);
  CHECK(some == std::vector<std::string>{"Käfig"});
}

TEST_CASE("files: rows appended one by one, in blocks and at once are the same") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/a", Type::f64, {"sample", "place"}, "1", ""}, {"/b", Type::f32, {"sample"}, "1", ""}};
  constexpr std::size_t samples = 30011, places = 3;  // several chunks and a rest
  std::vector<double> a(samples * places);
  std::vector<float> b(samples);
  std::mt19937 random(3);
  for (double& value : a) value = random();
  for (float& value : b) value = static_cast<float>(random());
  const auto write = [&](const fs::path& file, std::size_t block) {
    FileWriter writer(file, format);
    writer.set_axis("place", places);
    for (std::size_t first = 0; first < samples; first += block) {
      const std::size_t count = std::min(block, samples - first);
      writer.append("/a", std::span<const double>(a).subspan(first * places, count * places));
      writer.append("/b", std::span<const float>(b).subspan(first, count));
    }
    writer.commit();
  };
  write(scratch / "one.h5", 1);
  write(scratch / "some.h5", 777);
  write(scratch / "all.h5", samples);
  for (const char* name : {"one.h5", "some.h5", "all.h5"}) {
    const FileReader reader(scratch / name, format);
    CHECK(reader.read<double>("/a") == a);
    CHECK(reader.read<float>("/b") == b);
  }
  CHECK(bytes_of(scratch / "one.h5") == bytes_of(scratch / "some.h5"));
}

TEST_CASE("files: packed numbers are the same through this program's reader and through the HDF5 library's") {
  const Scratch scratch;
  Format packed{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  packed.datasets = {{"/a", Type::f32, {"sample"}, "1", ""}, {"/b", Type::u32, {"sample"}, "1", ""}};
  const Format plain = packed;
  packed.datasets[0].decimals = 7;
  packed.datasets[1].lists = true;
  constexpr std::size_t samples = 70001;  // two chunks and a rest
  std::vector<float> a(samples);
  std::vector<std::uint32_t> b(samples);
  std::mt19937 random(4);
  for (std::size_t k = 0; k < samples; ++k) {
    a[k] = 1e-3f * std::sin(0.01f * static_cast<float>(k)) * static_cast<float>(1 + k / 1000);
    b[k] = static_cast<std::uint32_t>(random() % 4293 + k);
  }
  for (const bool written_packed : {true, false}) {
    const fs::path file = scratch / "f.h5";
    {
      FileWriter writer(file, written_packed ? packed : plain);
      for (std::size_t first = 0; first < samples; first += 9999) {
        const std::size_t count = std::min<std::size_t>(9999, samples - first);
        writer.append("/a", std::span<const float>(a).subspan(first, count));
        writer.append("/b", std::span<const std::uint32_t>(b).subspan(first, count));
      }
      writer.commit();
    }
    CHECK(read_by_library<std::uint32_t>(file, "/b", H5T_NATIVE_UINT32) == b);
    const auto through_library = read_by_library<float>(file, "/a", H5T_NATIVE_FLOAT);
    const FileReader own(file, packed);
    CHECK(own.read<float>("/a") == through_library);
    CHECK(own.read<std::uint32_t>("/b") == b);
    std::vector<float> some, whole = own.read<float>("/a");
    own.read_rows("/a", 32760, 40, some);  // over the border of two chunks
    CHECK(some == std::vector<float>(whole.begin() + 32760, whole.begin() + 32800));
    std::vector<double> wider;
    own.read_rows("/a", 65530, 20, wider);
    CHECK(wider == std::vector<double>(whole.begin() + 65530, whole.begin() + 65550));
    std::vector<std::uint64_t> wider_list;
    own.read_rows("/b", 65530, 20, wider_list);
    CHECK(wider_list == std::vector<std::uint64_t>(b.begin() + 65530, b.begin() + 65550));
    if (written_packed) CHECK_THROWS_AS(own.read<std::int32_t>("/b"), std::logic_error);
    constexpr double kept = 0.5e-7 + 2e-8;  // half of the last decimal, and rounding of 0.14 to float
    double worst = 0;
    for (std::size_t k = 0; k < samples; ++k) worst = std::max(worst, std::abs(double(whole[k]) - a[k]));
    CHECK(worst <= (written_packed ? kept : 0));
  }
}

TEST_CASE("files: packed rows of doubles are the same through this program's reader and through the HDF5 library's") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/a", Type::f64, {"sample", "segment", "3"}, "m", ""},
                     {"/b", Type::f32, {"sample", "segment"}, "m", ""}};
  format.datasets[0].decimals = 11;
  format.datasets[1].decimals = 7;
  constexpr std::size_t segments = 60;
  for (const std::size_t samples : {1, 5, 2000}) {  // the last: eleven chunks and a rest
    std::vector<double> a(samples * segments * 3);
    std::vector<float> b(samples * segments);
    std::mt19937 random(4);
    std::uniform_real_distribution<double> anywhere(-1.0, 2.0);
    for (double& number : a) number = anywhere(random);
    for (std::size_t k = 0; k < b.size(); ++k) b[k] = 0.1f * static_cast<float>(a[3 * k]);
    {
      FileWriter writer(scratch / "f.h5", format);
      writer.set_axis("segment", segments);
      for (std::size_t sample = 0; sample < samples; ++sample) {
        writer.append("/a", std::span<const double>(a).subspan(sample * segments * 3, segments * 3));
        writer.append("/b", std::span<const float>(b).subspan(sample * segments, segments));
      }
      writer.commit();
    }
    const FileReader own(scratch / "f.h5", format);
    const auto whole = own.read<double>("/a");
    CHECK(whole == read_by_library<double>(scratch / "f.h5", "/a", H5T_NATIVE_DOUBLE));
    CHECK(own.read<float>("/b") == read_by_library<float>(scratch / "f.h5", "/b", H5T_NATIVE_FLOAT));
    double worst = 0;
    for (std::size_t k = 0; k < a.size(); ++k) worst = std::max(worst, std::abs(whole[k] - a[k]));
    constexpr double kept = 0.5e-11 + 2e-15;  // half of the last decimal, and rounding to double
    CHECK(worst <= kept);
    std::vector<double> row;
    for (std::size_t sample = 0; sample < samples; sample += 7) {
      own.read_rows("/a", sample, 1, row);
      REQUIRE(std::equal(row.begin(), row.end(), whole.begin() + static_cast<std::ptrdiff_t>(sample * segments * 3)));
      REQUIRE(row.size() == segments * 3);
    }
    std::vector<float> narrower;
    own.read_rows("/a", 0, 1, narrower);
    CHECK(narrower == std::vector<float>(whole.begin(), whole.begin() + segments * 3));
  }
}

TEST_CASE("files: a dataset copied from another file is that dataset, its rows count, and others are refused") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/group/a", Type::f64, {"site", "2"}, "m", ""},
                     {"/group/name", Type::text, {"site"}, "1", ""},
                     {"/b", Type::f64, {"site"}, "1", ""}};
  format.datasets[0].deflate = format.datasets[1].deflate = true;
  constexpr std::size_t sites = 20000;  // several chunks
  std::vector<double> a(2 * sites), b(sites, 1.0);
  std::vector<std::string> names;
  for (std::size_t k = 0; k < a.size(); ++k) a[k] = std::sqrt(static_cast<double>(k));
  for (std::size_t k = 0; k < sites; ++k) names.push_back("wire " + std::to_string(k));
  {
    FileWriter writer(scratch / "one.h5", format);
    writer.append("/group/a", a);
    writer.append("/group/name", std::span<const std::string>(names));
    writer.append("/b", b);
    writer.commit();
  }
  const FileReader one(scratch / "one.h5", format);
  for (const char* name : {"two.h5", "three.h5"}) {
    FileWriter writer(scratch / name, format);
    writer.copy(one, "/group/a");
    writer.copy(one, "/group/name");
    CHECK_THROWS_AS(writer.copy(one, "/group/a"), std::logic_error);
    writer.append("/b", b);
    writer.commit();
  }
  const FileReader two(scratch / "two.h5", format);
  CHECK(two.read<double>("/group/a") == a);
  CHECK(two.read<std::string>("/group/name") == names);
  CHECK(bytes_of(scratch / "two.h5") == bytes_of(scratch / "three.h5"));
  {
    FileWriter writer(scratch / "short.h5", format);
    writer.copy(one, "/group/a");
    writer.copy(one, "/group/name");
    writer.append("/b", std::span<const double>(b).first(3));
    CHECK_THROWS_AS(writer.commit(), std::logic_error);  // it has a different number of sites
  }
  Format other = format;
  other.datasets[0].unit = "1/m";
  FileWriter writer(scratch / "other.h5", other);
  CHECK_THROWS_AS(writer.copy(one, "/group/a"), std::logic_error);
}

TEST_CASE("files: the same content twice is the same bytes, and the file stays untouched") {
  const Scratch scratch;
  const Format format = sample_format();
  write_sample(scratch / "a.h5", format);
  write_sample(scratch / "b.h5", format);
  CHECK(bytes_of(scratch / "a.h5") == bytes_of(scratch / "b.h5"));
  const auto long_ago = fs::last_write_time(scratch / "a.h5") - std::chrono::hours(1);
  fs::last_write_time(scratch / "a.h5", long_ago);
  write_sample(scratch / "a.h5", format);
  CHECK(fs::last_write_time(scratch / "a.h5") == long_ago);
  Content other;
  other.time[2] = 0.25;
  write_sample(scratch / "a.h5", format, other);
  CHECK(fs::last_write_time(scratch / "a.h5") != long_ago);
  CHECK(FileReader(scratch / "a.h5", format).read<double>("/time")[2] == 0.25);
  CHECK(scratch.entries() == 2);
}

TEST_CASE("files: nothing is left behind without commit, and an older file stays") {
  const Scratch scratch;
  const Format format = sample_format();
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/time", std::span<const double>(Content().time));
    CHECK(scratch.entries() == 1);
    CHECK_FALSE(fs::exists(scratch / "f.h5"));
  }
  CHECK(scratch.entries() == 0);
  write_sample(scratch / "f.h5", format);
  const std::string before = bytes_of(scratch / "f.h5");
  { FileWriter writer(scratch / "f.h5", format); }
  CHECK(bytes_of(scratch / "f.h5") == before);
  CHECK(scratch.entries() == 1);
}

TEST_CASE("files: a writer that leaves something out is our fault and makes no file") {
  const Scratch scratch;
  const Format format = sample_format();
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/time", std::span<const double>(Content().time));
    CHECK_THROWS_AS(writer.commit(), std::logic_error);
  }
  CHECK(scratch.entries() == 0);
  {
    Content short_one;
    short_one.single.pop_back();
    CHECK_THROWS_WITH(write_sample(scratch / "g.h5", format, short_one),
                      Catch::Contains("/single has 2 rows, others of its axis 3"));
  }
  CHECK(scratch.entries() == 0);
  FileWriter writer(scratch / "h.h5", format);
  CHECK_THROWS_WITH(writer.append("/deep/er/field", std::span<const double>(Content().field)),
                    Catch::Contains("'place' is not set"));
  CHECK_THROWS_WITH(writer.append("/absent", std::span<const double>()), Catch::Contains("has no dataset /absent"));
}

TEST_CASE("files: long texts fit into attributes and rows") {
  const Scratch scratch;
  const Format format = sample_format();
  const std::string job(300'000, 'j');
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.set_axis("place", 2);
    const Content content;
    writer.append("/time", std::span<const double>(content.time));
    writer.append("/deep/er/field", std::span<const double>(content.field));
    writer.append("/single", std::span<const float>(content.single));
    writer.append("/index", std::span<const std::int32_t>(content.index));
    writer.append("/number", std::span<const std::uint32_t>(content.number));
    writer.append("/offset", std::span<const std::uint64_t>(content.offset));
    writer.append("/life", std::span<const double>(content.life));
    writer.set_text_width("/word", 5);
    writer.append("/word", std::span<const std::string>(std::vector<std::string>{"one", "three"}));
    CHECK_THROWS_AS(writer.append("/word", std::span<const std::string>(std::vector<std::string>{"eleven"})),
                    std::logic_error);
    writer.append("/word", std::span<const std::string>(std::vector<std::string>{"six", "seven"}));
    writer.attribute("total", 1.0);
    writer.attribute("note", job);
    writer.dataset_attribute("/time", "links", "base\narm");
    writer.commit();
  }
  const FileReader reader(scratch / "f.h5", format);
  CHECK(reader.text_attribute("note") == job);
  CHECK(reader.dataset_attribute("/time", "links") == "base\narm");
  CHECK(reader.read<std::string>("/word") == std::vector<std::string>{"one", "three", "six", "seven"});
}

TEST_CASE("files: tables without rows are whole, too") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/a", Type::f64, {"site", "level", "3"}, "1", ""},
                     {"/w", Type::text, {"site"}, "1", ""},
                     {"/offset", Type::u64, {"site+1"}, "1", ""}};
  {
    FileWriter writer(scratch / "f.h5", format);
    writer.set_axis("level", 0);
    writer.append("/a", std::span<const double>());
    writer.append("/w", std::span<const std::string>());
    writer.append("/offset", std::span<const std::uint64_t>(std::vector<std::uint64_t>{0}));
    writer.commit();
  }
  const FileReader reader(scratch / "f.h5", format);
  CHECK(reader.length("site") == 0);
  CHECK(reader.read<double>("/a").empty());
  CHECK(reader.read<std::string>("/w").empty());
}

TEST_CASE("files: what is absent, foreign or cut off is refused in one line with its remedy") {
  const Scratch scratch;
  const Format format = sample_format();
  const auto error = [&](const fs::path& file) {
    const std::string message = message_of([&] { FileReader reader(file, format); });
    CHECK(message.find('\n') == std::string::npos);
    return message;
  };
  CHECK(error(scratch / "absent.h5") ==
        (scratch / "absent.h5").string() + ": error: is not there; check the path, or make it with dresslife-maker");
  CHECK(error(scratch / ".") == (scratch / ".").string() + ": error: is a folder, not a file; name a file");
  const std::string remedy = "; make the file again with dresslife-maker, then run again";
  const fs::path text = scratch.write("text.h5", "time,strain\n0,1\n");
  CHECK(error(text) == text.string() + ": error: is not an HDF5 file, or is cut off" + remedy);
  const fs::path empty = scratch.write("empty.h5", "");
  CHECK(error(empty) == empty.string() + ": error: is not an HDF5 file, or is cut off" + remedy);

  write_sample(scratch / "whole.h5", format);
  const std::string whole = bytes_of(scratch / "whole.h5");
  for (const double share : {0.1, 0.5, 0.9, 0.999}) {
    const fs::path cut = scratch.write("cut.h5", whole.substr(0, static_cast<std::size_t>(share * whole.size())));
    const std::size_t size = bytes_of(cut).size();
    CHECK(error(cut) == (size < 512
                             ? cut.string() + ": error: is damaged (its first 512 bytes are no checksum)" + remedy
                             : fmt::format("{}: error: is cut off or has grown (it has {} bytes and promises {}){}",
                                           cut.string(), size, whole.size(), remedy)));
  }
  const fs::path grown = scratch.write("grown.h5", whole + "x");
  CHECK(error(grown).find("is cut off or has grown") != std::string::npos);
  CHECK(message_of([&] { FileReader reader(scratch / "whole.h5", motion_format()); }) ==
        (scratch / "whole.h5").string() +
            ": error: holds 'dresslife-sample' ('dresslife-motion' is expected); make the file again with "
            "dresslife-sim, then run again");
}

TEST_CASE("files: any bit that turns is noticed") {
  const Scratch scratch;
  const Format format = sample_format();
  write_sample(scratch / "whole.h5", format);
  const std::string whole = bytes_of(scratch / "whole.h5");
  std::mt19937 random(6);
  const auto notices = [&](std::size_t at, int bit) {
    std::string turned = whole;
    turned[at] = static_cast<char>(turned[at] ^ (1 << bit));
    const fs::path file = scratch.write("turned.h5", turned);
    return !message_of([&] { const FileReader reader(file, format); }).empty();
  };
  for (std::size_t at = 0; at < 530; ++at)
    CHECK(notices(at, static_cast<int>(random() % 8)));  // the statements about the contents
  for (int trial = 0; trial < 300; ++trial) CHECK(notices(random() % whole.size(), static_cast<int>(random() % 8)));
}

TEST_CASE("files: bytes changed anywhere in a file without checksum are refused or harmless, never a crash") {
  const Scratch scratch;
  const Format format = sample_format();
  write_sample(scratch / "whole.h5", format);
  const std::string whole =
      bytes_of(scratch / "whole.h5").substr(512);  // without the checksum block, as other programs write it
  CHECK(FileReader(scratch.write("other.h5", whole), format).checksum().empty());
  CHECK(FileReader(scratch / "other.h5", format).read<double>("/time") == Content().time);
  std::mt19937 random(5);
  int refused = 0;
  for (int trial = 0; trial < 400; ++trial) {
    std::string damaged = whole;
    for (int i = 0; i < 4; ++i)
      damaged[random() % std::min<std::size_t>(damaged.size(), 6000)] = static_cast<char>(random());
    const fs::path file = scratch.write("damaged.h5", damaged);
    const std::string message = message_of([&] {
      const FileReader reader(file, format);
      for (const Dataset& dataset : format.datasets) {
        if (!reader.has(dataset.path)) continue;
        if (dataset.type == Type::text)
          reader.read<std::string>(dataset.path);
        else
          reader.read<double>(dataset.path);
      }
    });
    if (message.empty()) continue;
    ++refused;
    CHECK(message.starts_with(file.string() + ": error: "));
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(refused > 100);
}

TEST_CASE("files: an axis plus one may be read before the axis itself") {
  const Scratch scratch;
  Format format{"dresslife-sample", 2, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/offset", Type::u64, {"site+1"}, "1", ""}, {"/site", Type::f64, {"site"}, "1", ""}};
  FileWriter writer(scratch / "a.h5", format);
  writer.append("/offset", std::span<const std::uint64_t>(std::vector<std::uint64_t>{0, 1, 3}));
  writer.append("/site", std::span<const double>(std::vector<double>{5, 6}));
  writer.commit();
  FileReader reader(scratch / "a.h5", format);
  CHECK(reader.read<std::uint64_t>("/offset") == std::vector<std::uint64_t>{0, 1, 3});
  CHECK(reader.read<double>("/site") == std::vector<double>{5, 6});
}

TEST_CASE("files: a file that does not keep its contract is refused, naming the dataset") {
  const Format right = sample_format();
  const std::string remedy = "; make the file again with dresslife-maker, then run again";
  CHECK(refusal(changed([](Format& f) { f.version = 3; }), right) ==
        "has format version 3 (this program reads up to 2); update dresslife");
  CHECK(refusal(changed([](Format& f) { f.datasets.erase(f.datasets.begin() + 1); }), right) ==
        "dataset /deep/er/field is missing" + remedy);
  CHECK(refusal(changed([](Format& f) { f.datasets.erase(f.datasets.begin()); }), right) ==
        "dataset /time is missing" + remedy);
  CHECK(refusal(changed([](Format& f) {
                  f.datasets[1].shape = {"sample", "6"};
                }),
                right) == "dataset /deep/er/field has 2 axes (must have 3)" + remedy);
  CHECK(refusal(changed([](Format& f) {
                  f.datasets[1].shape = {"sample", "3", "place"};
                }),
                right) == "dataset /deep/er/field has length 2 (must be 3)" + remedy);
  CHECK(refusal(changed([](Format& f) { f.datasets[0].unit = "ms"; }), right) ==
        "dataset /time has unit 'ms' (must be 's')" + remedy);
  CHECK(refusal(changed([](Format& f) { f.datasets[0].type = Type::i32; }), right) ==
        "dataset /time has the wrong type" + remedy);
  CHECK(refusal(changed([](Format& f) {
                  f.datasets[3].shape = {"line"};
                  f.datasets[6].shape = f.datasets[7].shape = {"other"};
                }),
                changed([](Format& f) { f.datasets[3].shape = {"line"}; })) ==
        "dataset /word has 4 values along 'line' (others have 3)" + remedy);
  CHECK(refusal(right, changed([](Format& f) {
                  f.attributes.push_back({"more", ""});
                })) == "attribute 'more' is missing" + remedy);
}

TEST_CASE("files: an older version is read") {
  const Scratch scratch;
  write_sample(scratch / "f.h5", changed([](Format& f) { f.version = 1; }));
  CHECK(FileReader(scratch / "f.h5", sample_format()).read<double>("/time").size() == 3);
}

TEST_CASE("files: numbers that are not finite are refused with their row, infinity only where it has no meaning") {
  const std::string remedy = "; make the file again with dresslife-maker, then run again";
  Content content;
  content.field[7] = std::nan("");
  CHECK(refusal(sample_format(), sample_format(), content) ==
        "dataset /deep/er/field holds a non-finite number in row 1" + remedy);
  content = {};
  content.time[2] = infinity;
  CHECK(refusal(sample_format(), sample_format(), content) ==
        "dataset /time holds a non-finite number in row 2" + remedy);
  content = {};
  content.single[0] = -std::numeric_limits<float>::infinity();
  CHECK(refusal(sample_format(), sample_format(), content) ==
        "dataset /single holds a non-finite number in row 0" + remedy);
  content = {};
  content.life[3] = std::nan("");
  CHECK(refusal(sample_format(), sample_format(), content) ==
        "dataset /life holds a non-finite number in row 3" + remedy);
}

TEST_CASE("files: attributes of the wrong kind are refused") {
  const Scratch scratch;
  const Format format = sample_format();
  write_sample(scratch / "f.h5", format);
  const FileReader reader(scratch / "f.h5", format);
  const std::string file = (scratch / "f.h5").string(),
                    remedy = "; make the file again with dresslife-maker, then run again";
  CHECK(message_of([&] { reader.text_attribute("total"); }) ==
        file + ": error: attribute 'total' is not text" + remedy);
  CHECK(message_of([&] { reader.number_attribute("format"); }) ==
        file + ": error: attribute 'format' is missing or not a number" + remedy);
  CHECK(message_of([&] { reader.text_attribute("job"); }) == file + ": error: attribute 'job' is missing" + remedy);
}

TEST_CASE("files: a place that cannot be written is the user's to correct") {
  const Scratch scratch;
  const fs::path file = scratch / "no folder/f.h5";
  CHECK(message_of([&] { FileWriter writer(file, sample_format()); }) ==
        file.string() +
            ": error: cannot be written (No such file or directory); check the folder, its permissions and the "
            "disk, then run again");
}

TEST_CASE("files: the manual lists every dataset of every format") {
  const std::string manual = file_manual();
  for (const Format* format : {&motion_format(), &strain_format(), &life_format()})
    for (const Dataset& dataset : format->datasets) {
      INFO(dataset.path);
      // The datasets of a bound repeat those of the file, in one line.
      const std::string bound = dataset.path.substr(0, dataset.path.find('/', 1));
      const std::string path = bound.starts_with("/bound_") ? dataset.path.substr(bound.size()) : dataset.path;
      if (path != dataset.path) CHECK(manual.find("`" + bound + "/") != std::string::npos);
      CHECK(manual.find("| `" + path + "` |") != std::string::npos);
      CHECK_FALSE(dataset.meaning.empty());
      CHECK_FALSE(dataset.unit.empty());
    }
}

TEST_CASE("a reader of a few datasets has only these, and reads no damaged file") {
  const Scratch scratch;
  const fs::path file = scratch / "f.h5";
  write_sample(file, sample_format());
  {
    const FileReader reader(file, sample_format(), {"/deep/er/field", "/word"});
    CHECK(reader.read<std::string>("/word") == words);
    CHECK(reader.read<double>("/deep/er/field") == Content().field);
    CHECK_FALSE(reader.has("/time"));
  }
  std::fstream(file, std::ios::in | std::ios::out).seekp(-1, std::ios::end).put('x');
  CHECK(message_of([&] { FileReader(file, sample_format(), {"/word"}); }).find("is damaged") != std::string::npos);
}

TEST_CASE("stored bytes are equal for equal values, and differ for other values, lengths and types") {
  const Scratch scratch;
  const auto stored = [&](const std::vector<std::string>& texts) {
    Format format{"dresslife-sample", 2, "dresslife-maker", "tests", {}, {}};
    format.datasets = {{"/word", Type::text, {"line"}, "1", "text"}, {"/life", Type::f64, {"line"}, "1", "numbers"}};
    format.datasets[0].deflate = true;
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/word", std::span<const std::string>(texts));
    writer.append("/life", std::span<const double>(std::vector<double>(texts.size(), 1.5)));
    writer.commit();
    return FileReader(scratch / "f.h5", format, {"/word"}).stored("/word");
  };
  const std::vector<std::string> texts(1000, "signal cable");
  std::vector<std::string> other = texts, longer = texts, wider = texts;
  other[700] = "signal cablf", longer.push_back(""), wider[700] = "signal cable 3";
  const std::string bytes = stored(texts);
  CHECK_FALSE(bytes.empty());
  CHECK(stored(texts) == bytes);
  for (const auto& others : {other, longer, wider}) CHECK(stored(others) != bytes);
}

}  // namespace
}  // namespace dresslife::pipeline
