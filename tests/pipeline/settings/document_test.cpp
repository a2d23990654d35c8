#include "pipeline/settings/document.h"

#include <yaml-cpp/yaml.h>

#include <random>

#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

Node parsed(const std::string& text) { return parse_yaml(text, "f.yaml"); }
std::string refusal(const std::string& text) {
  return message_of([&] { parse_yaml(text, "f.yaml"); });
}

bool same_tree(const Node& one, const Node& other) {
  if (one.kind != other.kind || one.text != other.text || one.items.size() != other.items.size() ||
      one.entries.size() != other.entries.size())
    return false;
  for (std::size_t i = 0; i < one.items.size(); ++i)
    if (!same_tree(one.items[i], other.items[i])) return false;
  for (std::size_t i = 0; i < one.entries.size(); ++i)
    if (one.entries[i].key != other.entries[i].key || !same_tree(one.entries[i].value, other.entries[i].value))
      return false;
  return true;
}

TEST_CASE("document: key_at names the key or value at a place") {
  const Node tree = parsed("a: 1\nlist:\n  - {name: x}\n  - {name: y, deep: [1, 2]}\n");
  CHECK(key_at(tree, "f.yaml:1:1") == "a");
  CHECK(key_at(tree, "f.yaml:1:4") == "a");
  CHECK(key_at(tree, "f.yaml:4:5") == "list.2");
  CHECK(key_at(tree, "f.yaml:4:25") == "list.2.deep.2");
  CHECK(key_at(tree, "f.yaml:4:26").empty());
  CHECK(key_at(tree, "g.yaml:1:1").empty());
}

TEST_CASE("document: every key and value knows its line and column, counted from 1") {
  const Node root = parsed("a: 1\nlist:\n  - x\n  - {deep: [2,  3]}\nempty:\n");
  REQUIRE(root.is_map());
  REQUIRE(root.entries.size() == 3);
  CHECK(root.find("a")->where.text() == "f.yaml:1:4");
  CHECK(root.entries[1].where.text() == "f.yaml:2:1");
  const Node& list = *root.find("list");
  CHECK(list.items[0].where.text() == "f.yaml:3:5");
  const Node& deep = *list.items[1].find("deep");
  CHECK(list.items[1].entries[0].where.text() == "f.yaml:4:6");
  CHECK(deep.items[1].where.text() == "f.yaml:4:17");
  CHECK(deep.items[1].text == "3");
  CHECK(root.find("empty")->kind == Node::Kind::null);
  CHECK(root.find("empty")->where.line == 5);
  CHECK(root.find("absent") == nullptr);
}

TEST_CASE("document: quoted values are marked, because a quoted number is no number") {
  const Node root = parsed("a: '1'\nb: 1\nc: \"x\"\n");
  CHECK(root.find("a")->quoted);
  CHECK_FALSE(root.find("b")->quoted);
  CHECK(root.find("c")->quoted);
}

TEST_CASE("document: duplicate keys are refused at the second one") {
  CHECK(refusal("a: 1\nb: 2\na: 3\n") == "f.yaml:3:1: error: duplicate key 'a'; keep one of the two");
  CHECK(refusal("a: [1]\na: [2]\n") ==
        "f.yaml:2:1: error: duplicate key 'a'; keep one of the two, with the items of both in its list");
  CHECK(refusal("deep: {x: 1, y: 2, x: 3}\n") == "f.yaml:1:20: error: duplicate key 'x'; keep one of the two");
}

TEST_CASE("document: merge keys and keys that are no words are refused") {
  CHECK(refusal("a: &x {k: 1}\nb:\n  <<: *x\n") ==
        "f.yaml:3:3: error: merge keys (<<) are not supported; write 'from: NAME' to start from a catalogue "
        "entry");
  CHECK(refusal("? [1, 2]\n: 3\n") == "f.yaml:1:3: error: a key must be a word; write 'key: value'");
}

TEST_CASE("document: aliases are read as what they stand for") {
  const Node root = parsed("a: &x {k: 1}\nb: *x\n");
  REQUIRE(root.find("b")->find("k"));
  CHECK(root.find("b")->find("k")->text == "1");
}

TEST_CASE("document: an alias within itself and aliases that multiply are refused, not followed") {
  CHECK(refusal("a: &x [*x]\n").find("too large or too deep") != std::string::npos);
  std::string bomb = "a0: &a0 [x,x,x,x,x,x,x,x,x,x]\n";
  for (int i = 1; i < 9; ++i) {
    bomb += fmt::format("a{}: &a{} [", i, i);
    for (int k = 0; k < 10; ++k) bomb += fmt::format("{}*a{}", k ? "," : "", i - 1);
    bomb += "]\n";
  }
  CHECK(refusal(bomb).find("is too large or too deep (aliases of aliases?); write it out plainly") !=
        std::string::npos);
}

TEST_CASE("document: what is not YAML is refused where it stops being YAML") {
  CHECK(refusal("a: [1, 2\nb: 3\n").starts_with("f.yaml:2:"));
  CHECK(refusal("a: [1, 2\nb: 3\n").find(": error: is not YAML (") != std::string::npos);
  CHECK(refusal("a: 1\n  b: 2\n").starts_with("f.yaml:2:"));
  CHECK(refusal("a: *nobody\n").starts_with("f.yaml:1:"));
  CHECK(refusal("a: \tb: c\n").find("is not YAML") != std::string::npos);
}

TEST_CASE("document: usual slips in YAML are named, with their remedy") {
  for (
      const auto& [text, answer] : std::vector<std::pair<std::string, std::string>>{
          {"a: 1\nb:\n\tc: 2\n", "f.yaml:3:1: error: is not YAML (a tab indents this line); indent with spaces"},
          {"a: 1\nb:\n  - \tc\n  \t- d: 1: 2\n", "f.yaml:4:1: error: is not YAML (a tab indents this line)"},
          {"a: |\n  \tb\nc: d: 1\n",
           "f.yaml:3:5: error: is not YAML (a second ': ' in one value"},  // the tab belongs to a text
          {"a: b: c\n", "f.yaml:1:5: error: is not YAML (a second ': ' in one value"},
          {"a: 1\n  b: 2\n", "f.yaml:2:4: error: is not YAML (a second ': ' in one value, or another indentation"},
          {"a:\n  b: 2\n c: 1\n",
           "f.yaml:3:2: error: is not YAML (no key of the map above: another indentation, or an item of a list); indent it as the other keys"},
          {"a: {b: 1\nc: 2\n", "is not YAML (a { above is not closed)"},
          {"a: [1, 2}\n", "is not YAML (a bracket closes another than the last one that opened); close each [ with ]"},
          {"a: %b\n", "f.yaml:1:4: error: is not YAML (no text begins with this character); quote the text"}}) {
    INFO(text);
    CHECK(refusal(text).find(answer) != std::string::npos);
  }
}

TEST_CASE("document: a quote that is never closed is found near its line, not taken for the rest of the file") {
  const std::string never_closed =
      "is not YAML (a quote that opens here or in the lines below is never closed); close it";
  CHECK(refusal("a: 1\nb:\n  c: 'open\n  d: 2\ne: 3\n") == "f.yaml:3:3: error: " + never_closed);
  CHECK(refusal("a: \"open\nb: 1\n\n").find(never_closed) != std::string::npos);
  CHECK(refusal("'open") == "f.yaml:1:1: error: " + never_closed);
  CHECK(parsed("a: 'it''s'\nb: \"x\\\"y\"\n").find("b")->text == "x\"y");
}

TEST_CASE("document: a stray comma at the start is refused") {
  // The library's own loop over documents does not terminate for this text.
  CHECK(refusal(",").find("is not YAML (no value begins like this); correct the line") != std::string::npos);
  CHECK(refusal("# remark\n, a: 1\n").starts_with("f.yaml:2:1: error: is not YAML"));
}

TEST_CASE("document: a second document in one file is refused") {
  CHECK(refusal("a: 1\n---\nb: 2\n") == "f.yaml:2:1: error: a second document begins here; keep one document per file");
}

TEST_CASE("document: an empty file is an empty tree that has a place") {
  for (const char* text : {"", "\n\n", "# only a remark\n"}) {
    CHECK(parsed(text).kind == Node::Kind::null);
    CHECK(parsed(text).where.text() == "f.yaml:1:1");
  }
}

TEST_CASE("document: nesting without end is refused") {
  CHECK(refusal(std::string(100, '[') + std::string(100, ']')).find("error: ") != std::string::npos);
  CHECK(refusal(std::string(200000, '[')).find("error: ") != std::string::npos);
  CHECK(refusal(std::string(200000, '{')).find("error: ") != std::string::npos);
}

TEST_CASE("document: more than a million values are refused by the signs between them, other letters are not counted") {
  constexpr std::size_t million = 1'000'000;
  for (const char sign : {',', '\n', ':', '[', '{'}) {
    CAPTURE(sign);
    CHECK_THAT(refusal(std::string(million + 1, sign)), Catch::Contains("holds about 1000001 values"));
  }
  const std::string word(million + 1, 'x');
  CHECK(parsed("a: " + word + "\n").find("a")->text == word);
}

TEST_CASE("document: random bytes are read or refused, never anything else") {
  std::mt19937 random(1);
  const std::string letters = "ab:-[]{}, \n\t'\"#&*!|>%@`?\\0179.~\r";
  int refused = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::string text;
    const int length = static_cast<int>(random() % 60);
    for (int i = 0; i < length; ++i)
      text += trial % 2 ? letters[random() % letters.size()] : static_cast<char>(random() % 256);
    const std::string message = refusal(text);
    if (message.empty()) continue;
    ++refused;
    INFO(message);
    CHECK(message.starts_with("f.yaml"));
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(refused > 1000);  // the trials cover the refusals
}

TEST_CASE("document: a tree as text reads back to the same tree, whatever its words are") {
  Node root;
  const std::vector<std::string> words{"plain",
                                       "null",
                                       "~",
                                       "true",
                                       "1.50",
                                       "a: b",
                                       "# no remark",
                                       "- x",
                                       "two\nlines",
                                       "  spaces  ",
                                       "it's",
                                       "\"quoted\"",
                                       "",
                                       "[x]",
                                       "{",
                                       "&a",
                                       "*a",
                                       "!tag",
                                       "%",
                                       "@",
                                       "`",
                                       "a #b",
                                       "Universität °C",
                                       "tab\there",
                                       "back\\slash",
                                       "x:",
                                       "=",
                                       "<<"};
  for (std::size_t i = 0; i < words.size(); ++i) root[fmt::format("k{}", i)] = scalar(words[i]);
  root["list"] = list_of({scalar("a, b"), scalar("1e-4"), scalar("")});
  root["nested"]["deeper"] = list_of({list_of({scalar("1"), scalar("2")}), list_of({scalar("3")})});
  root["nothing"] = Node{};
  const Node again = parsed(to_yaml(root));
  INFO(to_yaml(root));
  CHECK(same_tree(root, again));
  CHECK(to_yaml(again) == to_yaml(root));
}

TEST_CASE("document: a key is found or added, and a new one takes its parent's place") {
  Node root = parsed("a:\n  b: 1\n");
  root["a"]["c"] = scalar("2");
  CHECK(root.find("a")->entries.size() == 2);
  CHECK(root["x"]["y"].where.text() == root.where.text());
}

TEST_CASE("document: files that cannot be read say so") {
  const Scratch scratch;
  CHECK(message_of([&] { read_yaml(scratch / "absent.yaml"); }) ==
        (scratch / "absent.yaml").string() + ": error: cannot be read (No such file or directory); check the path");
  CHECK(message_of([&] { read_yaml(scratch / "."); }) ==
        (scratch / ".").string() + ": error: is a folder, not a file; name a file");
}

/// Writes the node with the library's own layout.
void emit_by_library(YAML::Emitter& out, const Node& node) {
  const auto put = [&](const std::string& text, bool quoted) {
    if (quoted) out << YAML::DoubleQuoted;
    out << text;
  };
  switch (node.kind) {
    case Node::Kind::null:
      out << YAML::Null;
      break;
    case Node::Kind::scalar:
      put(node.text, node.quoted);
      break;
    case Node::Kind::list:
      if (std::all_of(node.items.begin(), node.items.end(), [](const Node& item) { return item.is_scalar(); }))
        out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const Node& item : node.items) emit_by_library(out, item);
      out << YAML::EndSeq;
      break;
    case Node::Kind::map:
      out << YAML::BeginMap;
      for (const Entry& entry : node.entries) {
        out << YAML::Key << entry.key << YAML::Value;
        emit_by_library(out, entry.value);
      }
      out << YAML::EndMap;
  }
}

Node random_tree(std::mt19937& random, int depth) {
  static const std::vector<std::string> texts{"a",
                                              "two words",
                                              " space before",
                                              "after ",
                                              "1e-5",
                                              "-3",
                                              "- x",
                                              "null",
                                              "n",
                                              "true",
                                              "a: b",
                                              "a #b",
                                              "a,b",
                                              "[x]",
                                              "ä",
                                              "line\nline",
                                              "",
                                              "~",
                                              "*a",
                                              "&a",
                                              "!t",
                                              "'q'",
                                              "\"d\"",
                                              "%x",
                                              "a: (b), c; d",
                                              "[a: b]",
                                              "a: \"b\"",
                                              "a: \\",
                                              ": a",
                                              "a: ",
                                              "a (b), c; d=e'f",
                                              "Null",
                                              "NULL",
                                              "nullx",
                                              "nothing",
                                              "it's, so",
                                              "a,",
                                              "(a)",
                                              "a)",
                                              "x;",
                                              "a=",
                                              "-a",
                                              "y",
                                              "Yes",
                                              "a:b",
                                              "x\ty",
                                              "\x01",
                                              "/path/x-y_z.h5",
                                              "C:\\x",
                                              "?",
                                              "a ? b",
                                              ":"};
  Node node;
  const int what = static_cast<int>(random() % (depth > 3 ? 2 : 4));
  node.kind = what == 0   ? Node::Kind::null
              : what == 1 ? Node::Kind::scalar
              : what == 2 ? Node::Kind::list
                          : Node::Kind::map;
  node.text = node.is_scalar() ? texts[random() % texts.size()] : "";
  node.quoted = node.is_scalar() && random() % 5 == 0;
  const bool flat = random() % 2;
  for (std::size_t i = node.is_scalar() ? 0 : random() % 4; i > 0; --i) {
    if (node.is_list()) {
      node.items.push_back(random_tree(random, depth + 1));
      if (flat) node.items.back() = scalar(texts[random() % texts.size()]);
    } else if (node.is_map()) {
      node.entries.push_back({texts[random() % texts.size()] + std::to_string(i), {}, random_tree(random, depth + 1)});
    }
  }
  return node;
}

TEST_CASE("document: a tree is written as the YAML library lays it out") {
  const auto by_library = [](const Node& tree) {
    YAML::Emitter out;
    emit_by_library(out, tree);
    return std::string(out.c_str()) + "\n";
  };
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    const Node tree = random_tree(random, 0);
    REQUIRE(to_yaml(tree) == by_library(tree));
  }
  for (const auto& job : std::filesystem::directory_iterator(DRESSLIFE_SOURCE_DIR "/config/jobs")) {
    const Node tree = read_yaml(job.path());
    CHECK(to_yaml(tree) == by_library(tree));
  }
}

}  // namespace
}  // namespace dresslife::pipeline
