// Assignment of segments and clamps of a motion file to spans and dresspacks.
#include "pipeline/files/motion_layout.h"

#include "tests/catch.h"
#include "tests/pipeline/files/still_motion.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

/// Writes a file with these segments and without samples; empty lists: the datasets are absent.
void write_motion(const std::filesystem::path& name, std::size_t segments, std::size_t clamps,
                  const std::vector<std::int32_t>& clamp_segment, const std::vector<std::int32_t>& dresspack,
                  const std::vector<std::string>& names) {
  write_still_motion(name, segments, clamps, [&](FileWriter& file) {
    if (!clamp_segment.empty()) file.append("/clamp/segment", clamp_segment);
    if (names.empty()) return;
    file.set_axis("dresspack", names.size());
    file.append("/segment/dresspack", dresspack);
    file.append("/dresspack/name", names);
  });
}

std::string layout(const std::filesystem::path& name) {
  const FileReader file(name, motion_format());
  std::string text;
  for (const MotionSpan& span : motion_spans(file))
    text += fmt::format("{}: {}+{} {}-{}; ", span.dresspack, span.first_segment, span.segments, span.base_clamp,
                        span.tool_clamp);
  return text;
}

TEST_CASE("motion layout: files of one dresspack and of several are divided into spans") {
  const Scratch scratch;
  write_motion(scratch / "old.h5", 6, 3, {}, {}, {});
  CHECK(layout(scratch / "old.h5") == "0: 0+6 0-2; ");  // an old file has no data of the clamp between
  write_motion(scratch / "one.h5", 6, 3, {0, 4, 6}, {0, 0, 0, 0, 0, 0}, {""});
  CHECK(layout(scratch / "one.h5") == "0: 0+4 0-1; 0: 4+2 1-2; ");
  write_motion(scratch / "two.h5", 6, 5, {0, 2, 2, 5, 6}, {0, 0, 1, 1, 1, 1}, {"a", "b"});
  CHECK(layout(scratch / "two.h5") == "0: 0+2 0-1; 1: 2+3 2-3; 1: 5+1 3-4; ");
  CHECK(dresspack_names(FileReader(scratch / "two.h5", motion_format())) == std::vector<std::string>{"a", "b"});
  CHECK(dresspack_names(FileReader(scratch / "one.h5", motion_format())) == std::vector<std::string>{""});
  CHECK(dresspack_names(FileReader(scratch / "old.h5", motion_format())) == std::vector<std::string>{""});
}

TEST_CASE("motion layout: segments that are not as long together as the job's hoses are refused") {
  const Scratch scratch;
  Format format{"dresslife-sample", 1, "dresslife-maker", "tests", {}, {}};
  format.datasets = {{"/segment/length", Type::f64, {"segment"}, "m", ""}};
  const auto refusal = [&](const std::vector<double>& lengths, const std::vector<double>& hoses) {
    FileWriter writer(scratch / "f.h5", format);
    writer.append("/segment/length", std::span<const double>(lengths));
    writer.commit();
    return message_of([&] { check_lengths(FileReader(scratch / "f.h5", format), hoses); });
  };
  CHECK(refusal({0.25, 0.25, 0.5}, {1}).empty());
  CHECK(refusal({double(0.1f), double(0.2f), double(0.3f)}, {0.6}).empty());  // kept in single precision
  const auto says = [&](const std::string& words) { return Catch::Contains("f.h5: error: " + words); };
  CHECK_THAT(refusal({0.25, 0.25}, {1}),
             says("has segments of 0.5 m together where routing.free_length_m of its job is 1; make the file"));
  CHECK_THAT(refusal({1.5, -0.5}, {1}), says("has a segment whose rest length is -0.5 m"));
  CHECK_THAT(refusal({1, 0}, {1}), says("has a segment whose rest length is 0 m"));
  CHECK_THAT(refusal({1e308, 1e308}, {1}), says("has segments of inf m together"));
  CHECK_THAT(refusal({1}, {1, 1}), says("holds 1 dresspacks (its job has 2)"));

  write_motion(scratch / "two.h5", 6, 5, {0, 2, 2, 5, 6}, {0, 0, 1, 1, 1, 1}, {"a", "b"});  // 0.1 m each
  const FileReader two(scratch / "two.h5", motion_format());
  CHECK_NOTHROW(check_lengths(two, {0.2, 0.4}));
  CHECK_THROWS_WITH(check_lengths(two, {0.4, 0.2}), Catch::Contains("has segments of 0.2 m together"));
}

TEST_CASE("motion layout: what contradicts itself is refused") {
  const Scratch scratch;
  const auto refused = [&](std::vector<std::int32_t> clamps, std::vector<std::int32_t> dresspack,
                           const std::string& words) {
    const std::size_t count = clamps.size();
    write_motion(scratch / "bad.h5", 6, count, clamps, dresspack, {"a", "b"});
    INFO(words);
    CHECK(message_of([&] { layout(scratch / "bad.h5"); }).find(words) != std::string::npos);
  };
  const std::string rises = "/clamp/segment does not rise from 0 to the number of segments, span by span";
  const std::vector<std::int32_t> halves{0, 0, 0, 1, 1, 1};
  refused({0, 3, 6}, halves, rises);  // the second dresspack has no base clamp
  refused({0, 3, 3, 5}, halves, rises);
  refused({1, 3, 3, 6}, halves, rises);
  refused({0, 4, 4, 6}, halves, rises);
  refused({0, 2, 2, 3, 3, 6}, halves, rises);
  refused({0, 4, 3, 6}, halves, rises);
  const std::string counts = "/segment/dresspack does not count the dresspacks up one by one";
  refused({0, 3, 3, 6}, {0, 0, 0, 0, 0, 0}, counts);
  refused({0, 3, 3, 6}, {0, 0, 1, 0, 1, 1}, counts);
  refused({0, 3, 3, 6}, {1, 1, 1, 1, 1, 1}, counts);
}

}  // namespace
}  // namespace dresslife::pipeline
