// One description of a struct: reading, refusals, writing and the manual of its keys.
#include "pipeline/settings/fields.h"

#include <map>
#include <random>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;

namespace {

enum class Colour { red, green, blue };
constexpr std::string_view word(Colour value) {
  constexpr std::string_view words[]{"red", "green", "blue"};
  return static_cast<std::size_t>(value) < 3 ? words[static_cast<std::size_t>(value)] : "";
}

struct Part {
  double width = 1;
  Colour colour = Colour::green;
};
void describe(Fields& f, Part& part) {
  f.number("width_mm", part.width, Need::required, above(0), "The width.");
  f.choice("colour", part.colour, "The colour of the part.");
}

struct Whole {
  std::string name;
  double share = 0.5, mass = 2;
  bool by_word = false, whole = false;
  int count = 3;
  std::optional<double> angle;
  Eigen::Vector3d place{1, 2, 3};
  std::vector<double> list{1};
  std::vector<Colour> colours{Colour::red};
  std::vector<Part> parts;
  std::optional<Part> spare;
};
void describe(Fields& f, Whole& of) {
  f.text("name", of.name, Need::required, "The name.");
  f.number("share", of.share, Need::optional, between(0, 1), "The share.");
  f.number_or_word("mass_kg", of.mass, of.by_word, "measured", Need::optional, at_least(1), "The mass.");
  f.boolean("whole", of.whole, Need::optional, "Whether it is whole.");
  f.integer("count", of.count, Need::optional, between(1, 9), "The number.");
  f.maybe_number("angle_deg", of.angle, any_number(), "The angle.");
  f.vector("place_mm", of.place, Need::optional, "The place.");
  f.numbers("list", of.list, Need::optional, "The list.");
  f.choices("colours", of.colours, "The colours.");
  f.list("parts", of.parts, Need::optional, "The parts.");
  f.maybe_group("spare", of.spare, "A part in reserve.");
}

Whole read(const std::string& keys) {
  Whole whole;
  read_fields(parse_yaml("name: it\n" + keys, "file.yaml"), whole);
  return whole;
}

std::string refusal(const std::string& keys) {
  return message_of([&] { read(keys); });
}

}  // namespace

TEST_CASE("fields: every kind of value is read in SI units, each item of a list by itself, and comes back") {
  const Whole of = read(
      "share: 1\nmass_kg: measured\nwhole: true\ncount: 9\nangle_deg: 180\nplace_mm: [10, -20, 30]\nlist: [4, 5, 6]\n"
      "colours: [blue, red]\nparts:\n  - {width_mm: 5, colour: red}\n  - {width_mm: 7}\n"
      "  - {width_mm: 9, colour: blue}\nspare: {width_mm: 2}\n");
  CHECK(of.share == 1);
  CHECK(of.by_word);
  CHECK(of.mass == 2);
  CHECK(of.whole);
  CHECK(of.count == 9);
  CHECK(*of.angle == Approx(std::acos(-1.0)));
  CHECK((of.place - Eigen::Vector3d(0.01, -0.02, 0.03)).norm() < 1e-15);
  CHECK(of.list == std::vector<double>{4, 5, 6});
  CHECK(of.colours == std::vector<Colour>{Colour::blue, Colour::red});
  REQUIRE(of.parts.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(of.parts[k].width == Approx(0.005 + 0.002 * double(k)));
  CHECK(of.parts[0].colour == Colour::red);
  CHECK(of.parts[1].colour == Colour::green);
  CHECK(of.parts[2].colour == Colour::blue);
  CHECK(of.spare->width == Approx(0.002));
  const std::string written = to_yaml(echo_fields(of));
  Whole again;
  read_fields(parse_yaml(written, "echo"), again);
  CHECK(to_yaml(echo_fields(again)) == written);
  CHECK(again.parts.size() == 3);
  CHECK(again.by_word);
  CHECK(read("colours: green\nmass_kg: 1.5\n").colours == std::vector<Colour>{Colour::green});
  CHECK_FALSE(read("mass_kg: 1.5\n").by_word);
  CHECK_FALSE(read("").angle);
}

TEST_CASE("fields: the ends of a range are in it, and what lies beyond is refused") {
  for (const char* fits : {"share: 0", "share: 1", "mass_kg: 1", "count: 1", "count: 9", "count: 5.0",
                           "angle_deg: -400", "share: +0.5", "share: 5e-1"})
    CHECK(refusal(fits) == "");
  for (const auto& [keys, words] : std::map<std::string, std::string>{
           {"share: -0.001", "share is -0.001 (must be 0 .. 1)"},
           {"share: 1.001", "share is 1.001 (must be 0 .. 1)"},
           {"mass_kg: 0.99", "(must be >= 1 kg)"},
           {"mass_kg: heavy", "must be a number or measured, the unit is in the key: kg"},
           {"count: 0", "(must be 1 .. 9)"},
           {"count: 2.5", "(must be a whole number)"},
           {"share: '1'", "must be a number); write it without quotes; give"},
           {"share: [1]", "is not one value"},
           {"share: .inf", "must be finite"},
           {"share: -.inf", "must be finite"},
           {"share: .NaN", "must be finite"},
           {"share: 1x", "must be a number"},
           {"share:", "share has no value"},
           {"whole: yes", "must be true or false"},
           {"place_mm: [1, 2]", "must be three numbers"},
           {"list: []", "must be a list of numbers"},
           {"colours: []", "is an empty list"},
           {"colours: [red, pink]", "(must be red | green | blue)"},
           {"parts: [{width_mm: 0}]", "parts[1].width_mm is 0 (must be > 0 mm)"},
           {"parts: [{width_mm: 1}, {colour: red}]", "parts[2]"},
           {"parts: [{width_mm: 1}, 3]", "parts[2] must be a map of settings"},
           {"parts: {}", "parts must be a list"},
           {"spare: 3", "spare must be a map of settings"},
           {"spare: width_mm:1", "spare must be a map of settings; write a space after the colon"},
           {"spare: {width_mm: 1, colour: pink}", "spare.colour is 'pink'"},
           {"shar: 1", "did you mean 'share'?"},
           {"angle: 1", "its unit is deg, write 'angle_deg'"},
           {"share_kg: 1", "this key carries no unit, write 'share'"},
           {"mass_lb: 1", "did you mean 'mass_kg'? Its unit is kg"},
           {"share_x: 1", "did you mean 'share'?\n"},
           {"unlike_anything: 1", "keys here: name, share"}})
    CHECK_THAT(refusal(keys) + "\n", Catch::Contains(words));
  // All errors at once, each at its line.
  CHECK_THAT(refusal("share: 2\ncount: 0\n"), Catch::Contains("file.yaml:2:8") && Catch::Contains("file.yaml:3:8"));
}

TEST_CASE(
    "fields: a wire gauge is answered with its section where a section is asked for, a word without digits is not") {
  double section = 1, length = 1;
  const Describe wire = [&](Fields& f) {
    f.number("section_mm2", section, Need::optional, above(0), "The section.");
    f.number("length_mm", length, Need::optional, above(0), "The length.");
  };
  const auto refused = [&](const std::string& keys) {
    return message_of([&] { read_fields(parse_yaml(keys, "file.yaml"), wire); });
  };
  // AWG 36 has a diameter of 0.127 mm by definition.
  for (const char* gauge : {"AWG 36", "awg 36", "AWG36"})
    CHECK_THAT(refused(std::string("section_mm2: ") + gauge), Catch::Contains("write 0.01267 for AWG 36; give "));
  for (const char* none : {"section_mm2: AWG", "section_mm2: gauge 36", "length_mm: AWG 36"})
    CHECK_THAT(refused(none), Catch::Contains("must be a number") && !Catch::Contains("for AWG"));
}

TEST_CASE("fields: a range in words holds what it says") {
  CHECK(any_number().text() == "any");
  CHECK(above(2).text() == "> 2");
  CHECK(at_least(2).text() == ">= 2");
  CHECK(between(-1, 2).text() == "-1 .. 2");
  CHECK(Range{-std::numeric_limits<double>::infinity(), 3}.text() == "<= 3");
  CHECK_FALSE(above(2).holds(2));
  CHECK(at_least(2).holds(2));
  CHECK(between(-1, 2).holds(-1));
  CHECK(between(-1, 2).holds(2));
  CHECK_FALSE(between(-1, 2).holds(2.001));
}

TEST_CASE("fields: the nearest word is that of the least edit distance, by its definition") {
  const std::function<std::size_t(std::string_view, std::string_view)> distance =
      [&](std::string_view a, std::string_view b) -> std::size_t {
    if (a.empty() || b.empty()) return a.size() + b.size();
    return std::min({distance(a.substr(1), b) + 1, distance(a, b.substr(1)) + 1,
                     distance(a.substr(1), b.substr(1)) + (a[0] != b[0])});
  };
  std::mt19937 random(3);
  const auto any_word = [&] {
    std::string text(1 + random() % 6, 'a');
    for (char& letter : text) letter = static_cast<char>('a' + random() % 3);
    return text;
  };
  for (int round = 0; round < 100; ++round) {
    const std::string sought = any_word();
    std::vector<std::string> words;
    for (int k = 0; k < 4; ++k) words.push_back(any_word());
    std::size_t least = 100;
    for (const std::string& one : words) least = std::min(least, distance(sought, one));
    const std::string found = nearest_word(sought, words);
    CAPTURE(sought, found, least);
    if (least > std::max<std::size_t>(2, sought.size() / 3))
      CHECK(found.empty());
    else
      CHECK((!found.empty() && distance(sought, found) == least));
  }
  CHECK(nearest_word("damping_time", {"damping_time_ms"}) == "damping_time_ms");
}

TEST_CASE("fields: the manual has a row for every key with its unit, range and default") {
  const std::vector<KeyRow> rows = key_rows<Whole>("whole");
  const auto row = [&](const std::string& map, const std::string& key) {
    for (const KeyRow& one : rows)
      if (one.map == map && one.key == key) return one;
    FAIL("no row of " + map + " " + key);
    return KeyRow{};
  };
  CHECK(row("whole", "share").allowed == "0 .. 1");
  CHECK(row("whole", "share").fallback == "0.5");
  CHECK(row("whole", "mass_kg").unit == "kg");
  CHECK(row("whole", "count").fallback == "3");
  CHECK(row("whole", "place_mm").unit == "mm");
  CHECK_THAT(row("whole", "colours").allowed, Catch::Contains("red") && Catch::Contains("blue"));
  CHECK(row("parts[]", "width_mm").allowed == "> 0");
  CHECK(row("parts[]", "colour").fallback == "green");
}
