#include "pipeline/settings/document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <unordered_set>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"

namespace dresslife::pipeline {
namespace {

constexpr int most_nodes = 1'000'000;  // far more than in any job; the library takes 10 s and 600 MB for this number
constexpr std::size_t most_bytes =
    16 << 20;  // far more than in any job; the library takes 4 s for comments of this size
constexpr int deepest_level = 64;

Where place(const YAML::Mark& mark, const std::string& file) {
  // The library counts from 0; -1: the node has no place.
  return {file, mark.line + 1, mark.line >= 0 ? mark.column + 1 : 0};
}

class Converter {
 public:
  explicit Converter(const std::string& file) : file_(file) {}

  Node convert(const YAML::Node& from, int depth = 0) {
    Node node;
    node.where = place(from.Mark(), file_);
    if (++nodes_ > most_nodes || depth > deepest_level)
      throw InputError(node.where, "document is too large or too deep (aliases of aliases?)", "write it out plainly");
    if (from.IsScalar()) {
      node.kind = Node::Kind::scalar;
      node.text = from.Scalar();
      node.quoted = from.Tag() == "!";
    } else if (from.IsSequence()) {
      node.kind = Node::Kind::list;
      for (const auto& item : from) node.items.push_back(convert(item, depth + 1));
    } else if (from.IsMap()) {
      node.kind = Node::Kind::map;
      std::unordered_set<std::string> keys;
      for (const auto& pair : from) add_entry(node, keys, pair.first, pair.second, depth);
    }
    return under_its_tag(from.Tag(), std::move(node));
  }

 private:
  /// Returns a value with a tag (`!uniform [1, 2]`) as a map whose only key is the tag.
  static Node under_its_tag(const std::string& tag, Node node) {
    if (tag.size() < 2 || tag[0] != '!') return node;
    Node map;
    map.where = node.where;
    map[tag] = std::move(node);
    map.entries.front().where = map.where;
    return map;
  }

  void add_entry(Node& map, std::unordered_set<std::string>& keys, const YAML::Node& key, const YAML::Node& value,
                 int depth) {
    const Where where = place(key.Mark(), file_);
    if (!key.IsScalar()) throw InputError(where, "a key must be a word", "write 'key: value'");
    if (key.Scalar() == "<<")
      throw InputError(where, "merge keys (<<) are not supported",
                       "write 'from: NAME' to start from a catalogue entry");
    if (!keys.insert(key.Scalar()).second)
      throw InputError(
          where, fmt::format("duplicate key '{}'", key.Scalar()),
          value.IsSequence() ? "keep one of the two, with the items of both in its list" : "keep one of the two");
    Node converted = convert(value, depth + 1);
    // The library gives a missing value the place of the next line.
    if (converted.where.line <= 0 || converted.kind == Node::Kind::null) converted.where = where;
    map.entries.push_back({key.Scalar(), where, std::move(converted)});
  }

  const std::string& file_;
  int nodes_ = 0;
};

/// Walks a stream of documents and keeps only the current place.
class Walker : public YAML::EventHandler {
 public:
  YAML::Mark begin;                           ///< of the document
  YAML::Mark last = YAML::Mark::null_mark();  ///< of the last key or value

  void OnDocumentStart(const YAML::Mark& mark) override { begin = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { last = mark; }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { last = mark; }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    last = mark;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    last = mark;
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    last = mark;
  }
  void OnMapEnd() override {}
};

/// Refuses a text that the library would read for too long. Its number of values is estimated from the signs between values.
void check_size(const std::string& text, const std::string& file) {
  if (text.size() > most_bytes)
    throw InputError({file}, fmt::format("has {} bytes (at most {} are read as YAML)", text.size(), most_bytes),
                     "leave out what is not needed, or keep poses in a CSV file");
  const auto values = std::ranges::count_if(text, [](char letter) {
    return letter == ',' || letter == '\n' || letter == ':' || letter == '[' || letter == '{';
  });
  if (values > most_nodes)
    throw InputError({file}, fmt::format("holds about {} values (at most {} are read)", values, most_nodes),
                     "leave out what is not needed, or keep poses in a CSV file");
}

/// Refuses errors that the library accepts: further documents, a stray ',' (the library reads an endless stream of empty
/// documents), and a quote that is never closed (the library detects it only in a text that does not end with a line feed).
void check_stream(const std::string& text, const std::string& file) {
  std::istringstream stream(text.substr(0, text.find_last_not_of(" \t\r\n") + 1));
  YAML::Parser parser(stream);
  Walker walker;
  try {
    if (!parser.HandleNextDocument(walker)) return;
    const YAML::Mark first = walker.begin;
    if (!parser.HandleNextDocument(walker)) return;
    const Where where = place(walker.begin, file);
    if (walker.begin.pos == first.pos)
      throw InputError(where, "is not YAML (no value begins like this)", "correct the line");
    throw InputError(where, "a second document begins here", "keep one document per file");
  } catch (const YAML::Exception& problem) {
    if (problem.msg != YAML::ErrorMsg::EOF_IN_SCALAR) throw;
    throw InputError(walker.last.is_null() ? Where{file, 1, 1} : place(walker.last, file),
                     "is not YAML (a quote that opens here or in the lines below is never closed)", "close it");
  }
}

/// Returns whether a tab indents a line of the text, counted from 0.
bool tab_indents(const std::string& text, int number) {
  std::istringstream lines(text);
  std::string line;
  for (int k = 0; k <= number; ++k)
    if (!std::getline(lines, line)) return false;
  return line.substr(0, line.find_first_not_of(" \t")).find('\t') != std::string::npos;
}

/// Returns what the library refuses, in words that name the usual slips.
InputError refusal_of(const YAML::Exception& problem, const std::string& text, const std::string& file) {
  struct Slip {
    std::string_view of_library, words, remedy;
  };
  static const Slip slips[] = {
      {YAML::ErrorMsg::MAP_VALUE, "a second ': ' in one value, or another indentation than the line above",
       "quote a text that contains ': ', or indent the line as its neighbours"},
      {YAML::ErrorMsg::END_OF_MAP, "no key of the map above: another indentation, or an item of a list",
       "indent it as the other keys of its map"},
      {YAML::ErrorMsg::END_OF_SEQ, "no item of the list above: another indentation, or a key of a map",
       "indent it as the other items of its list"},
      {YAML::ErrorMsg::END_OF_MAP_FLOW, "a { above is not closed", "close it with }"},
      {YAML::ErrorMsg::END_OF_SEQ_FLOW, "a [ above is not closed", "close it with ]"},
      {YAML::ErrorMsg::FLOW_END, "a bracket closes another than the last one that opened",
       "close each [ with ] and each { with }"},
      {YAML::ErrorMsg::UNKNOWN_TOKEN, "no text begins with this character", "quote the text"}};
  if (tab_indents(text, problem.mark.line))
    return InputError({file, problem.mark.line + 1, 1}, "is not YAML (a tab indents this line)", "indent with spaces");
  const Slip* const slip = std::ranges::find(slips, std::string_view(problem.msg), &Slip::of_library);
  return slip == std::end(slips)
             ? InputError(place(problem.mark, file), fmt::format("is not YAML ({})", problem.msg), "correct the line")
             : InputError(place(problem.mark, file), fmt::format("is not YAML ({})", slip->words),
                          std::string(slip->remedy));
}

/// Returns a scalar with the quotes and escapes that the library adds, for a line of its own or an item of []. The library tests every
/// letter with regular expressions, so texts that need no quotes at sight do not reach it: numbers, names, paths, sentences.
std::string scalar_text(const std::string& text, bool quoted, bool in_brackets) {
  constexpr std::string_view plain = ", _.+-/();='0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
  const bool begins = text[0] == '/' || std::isalnum(static_cast<unsigned char>(text[text[0] == '-']));
  if (!quoted && begins && text != "null" && text != "Null" && text != "NULL" && text.back() != ' ' &&
      text.find_first_not_of(plain.substr(in_brackets)) == text.npos)
    return text;
  YAML::Emitter out;
  if (in_brackets) out << YAML::Flow << YAML::BeginSeq;
  if (quoted) out << YAML::DoubleQuoted;
  out << text;
  if (in_brackets) out << YAML::EndSeq;
  const std::string written = out.c_str();
  return in_brackets ? written.substr(1, written.size() - 2) : written;
}

/// Writes a tree as the emitter of the library does, in a tenth of its time. Jobs are written several times in a study.
/// line: line break and indentation. The first line continues the current one.
void emit(std::string& out, const Node& node, const std::string& line) {
  const auto in_brackets = [](const Node& list) { return std::ranges::all_of(list.items, &Node::is_scalar); };
  const std::string inner = line + "  ";
  if (node.kind == Node::Kind::null) out += '~';
  if (node.is_scalar()) out += scalar_text(node.text, node.quoted, false);
  if (node.is_list() && in_brackets(node)) {
    const auto text = [](const Node& item) { return scalar_text(item.text, item.quoted, true); };
    out += '[' + joined(mapped(node.items, text), ", ") + ']';
  } else {
    for (const Node& item : node.items) {
      out += &item == &node.items.front() ? "-" : line + '-';
      out += item.is_list() && !in_brackets(item) ? inner : " ";
      emit(out, item, inner);
    }
  }
  if (node.is_map() && node.entries.empty()) out += "{}";
  for (const Entry& entry : node.entries) {
    if (&entry != &node.entries.front()) out += line;
    out += scalar_text(entry.key, false, false) + ':';
    out += entry.value.is_map() || !in_brackets(entry.value) ? inner : " ";
    emit(out, entry.value, inner);
  }
}

}  // namespace

const Node* Node::find(std::string_view key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Node* Node::find(std::string_view key) { return const_cast<Node*>(std::as_const(*this).find(key)); }

Node& Node::operator[](std::string_view key) {
  if (Node* found = find(key)) return *found;
  kind = Kind::map;
  entries.push_back({std::string(key), where, Node{}});
  entries.back().value.where = where;
  return entries.back().value;
}

Node scalar(std::string text) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = std::move(text);
  return node;
}

Node list_of(std::vector<Node> items) {
  Node node;
  node.kind = Node::Kind::list;
  node.items = std::move(items);
  return node;
}

void place_at(Node& node, const Where& where) {
  node.where = where;
  for (Node& item : node.items) place_at(item, where);
  for (Entry& entry : node.entries) {
    entry.where = where;
    place_at(entry.value, where);
  }
}

std::string key_at(const Node& tree, const std::string& place) {
  const auto inside = [&](const std::string& word, const Where& where, const Node& value) {
    if (where.text() == place || value.where.text() == place) return word;
    const std::string rest = key_at(value, place);
    return rest.empty() ? rest : word + "." + rest;
  };
  std::string path;
  for (const Entry& entry : tree.entries)
    if (path = inside(entry.key, entry.where, entry.value); !path.empty()) break;
  for (std::size_t k = 0; path.empty() && k < tree.items.size(); ++k)
    path = inside(std::to_string(k + 1), tree.items[k].where, tree.items[k]);
  return path;
}

Node parse_yaml(const std::string& text, const std::string& file) {
  check_size(text, file);
  YAML::Node document;
  try {
    check_stream(text, file);
    document = YAML::Load(text);
  } catch (const YAML::Exception& problem) {
    throw refusal_of(problem, text, file);
  }
  Node root = Converter(file).convert(document);
  if (root.where.line <= 0) root.where = {file, 1, 1};
  return root;
}

Node read_yaml(const std::filesystem::path& file) { return parse_yaml(read_text(file), file.string()); }

std::string to_yaml(const Node& node) {
  std::string text;
  emit(text, node, "\n");
  return text + '\n';
}

std::filesystem::path folder_of(const Where& where) {
  return where.file.starts_with("--set ") ? "" : std::filesystem::path(where.file).parent_path();
}

}  // namespace dresslife::pipeline
