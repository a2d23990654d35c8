#include "pipeline/settings/echo_text.h"

#include "tests/catch.h"

using namespace dresslife::pipeline;

namespace {

struct Inner {
  double length = 2;
  std::vector<double> table;
};

void describe(Fields& f, Inner& inner) {
  f.number("length_mm", inner.length, Need::optional, any_number(), "The length.");
  f.numbers("table_mm", inner.table, Need::optional, "The table.");
}

struct Outer {
  std::string name;
  std::optional<double> angle;
  bool free = false, by_word = false;
  double size = 1;
  Inner inner;
  std::vector<Inner> list;
  std::filesystem::path file;
};

void describe(Fields& f, Outer& outer) {
  f.text("name", outer.name, Need::optional, "The name.");
  f.maybe_number("angle_deg", outer.angle, any_number(), "The angle.");
  f.boolean("free", outer.free, Need::optional, "Whether it is free.");
  f.number_or_word("size_mm", outer.size, outer.by_word, "auto", Need::optional, any_number(), "The size.");
  f.group("inner", outer.inner, Need::optional, "The inner part.", !outer.free);
  f.list("list", outer.list, Need::optional, "The list.");
  f.path("file", outer.file, Need::optional, "The file.");
}

TEST_CASE("echo_text: the joined sections are the text of the whole structure") {
  std::vector<Outer> all(1);
  const auto change = [&](const auto& how) { how(all.emplace_back()); };
  change([](Outer& o) { o.name = "n"; });
  change([](Outer& o) { o.angle = 0; });
  change([](Outer& o) { o.free = true; });
  change([](Outer& o) { o.by_word = true; });
  change([](Outer& o) { o.size = 3; });
  change([](Outer& o) { o.inner.length = 3; });
  change([](Outer& o) { o.inner.table = {2}; });  // the bytes of 2, as in the default length
  change([](Outer& o) { o.list.resize(1); });
  change([](Outer& o) { o.list.resize(2); });
  change([](Outer& o) { o.list = {{2, {1, 2}}, {2, {}}}; });
  change([](Outer& o) { o.list = {{2, {1}}, {2, {2}}}; });
  change([](Outer& o) { o.file = "/a/file"; });
  for (Outer& outer : all) {
    const Describe described = [&](Fields& f) { describe(f, outer); };
    CHECK(joined_text(echo_sections(described, {})) == to_yaml(echo_fields(described)));
    const PathText name = [](const std::filesystem::path& file) { return file.filename().string(); };
    CHECK(joined_text(echo_sections(described, name)) == to_yaml(echo_fields(described, name)));
  }
}

TEST_CASE("echo_text: a structure without values is an empty map") {
  const Describe nothing = [](Fields&) {};
  CHECK(joined_text(echo_sections(nothing, {})) == to_yaml(echo_fields(nothing)));
}

}  // namespace
