#include "pipeline/job/document.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <unordered_set>

namespace dresslife::pipeline {
namespace {

constexpr int most_nodes = 2'000'000;  // far above any job; stops aliases that multiply without end
constexpr int deepest_level = 64;

Where place(const YAML::Mark& mark, const std::string& file) {
  // The library counts from 0, and a node without a place has -1.
  return {file, mark.line + 1, mark.line >= 0 ? mark.column + 1 : 0};
}

class Converter {
 public:
  explicit Converter(const std::string& file) : file_(file) {}

  Node convert(const YAML::Node& from, int depth = 0) {
    Node node;
    node.where = place(from.Mark(), file_);
    if (++nodes_ > most_nodes || depth > deepest_level)
      throw InputError(node.where, "document is too large or too deep (aliases of aliases?)",
                       "write it out plainly");
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
    return node;
  }

 private:
  void add_entry(Node& map, std::unordered_set<std::string>& keys, const YAML::Node& key,
                 const YAML::Node& value, int depth) {
    const Where where = place(key.Mark(), file_);
    if (!key.IsScalar()) throw InputError(where, "a key must be a word", "write 'key: value'");
    if (key.Scalar() == "<<")
      throw InputError(where, "merge keys (<<) are not supported",
                       "write 'from: NAME' to start from a catalogue entry");
    if (!keys.insert(key.Scalar()).second)
      throw InputError(where, fmt::format("duplicate key '{}'", key.Scalar()), "keep one of the two");
    Node converted = convert(value, depth + 1);
    // A value that is not there lies, for the library, where the next line begins.
    if (converted.where.line <= 0 || converted.kind == Node::Kind::null) converted.where = where;
    map.entries.push_back({key.Scalar(), where, std::move(converted)});
  }

  const std::string& file_;
  int nodes_ = 0;
};

/// Walks a stream of documents and keeps only where it is.
class Walker : public YAML::EventHandler {
 public:
  YAML::Mark begin;                           ///< of the document
  YAML::Mark last = YAML::Mark::null_mark();  ///< of the latest key or value

  void OnDocumentStart(const YAML::Mark& mark) override { begin = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { last = mark; }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { last = mark; }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    last = mark;
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    last = mark;
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    last = mark;
  }
  void OnMapEnd() override {}
};

/// Refuses what the library lets pass: further documents, a stray ',' (to it an endless stream of empty
/// documents) and a quote that is never closed, which it only notices in text that does not end in a line
/// feed.
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
      throw InputError(where, "is not YAML (no value begins like this)", "mend the line");
    throw InputError(where, "a second document begins here", "keep one document per file");
  } catch (const YAML::Exception& problem) {
    if (problem.msg != YAML::ErrorMsg::EOF_IN_SCALAR) throw;
    throw InputError(walker.last.is_null() ? Where{file, 1, 1} : place(walker.last, file),
                     "is not YAML (a quote that opens here or in the lines below is never closed)",
                     "close it");
  }
}

bool all_scalars(const Node& list) {
  return std::all_of(list.items.begin(), list.items.end(), [](const Node& item) { return item.is_scalar(); });
}

/// Text that needs no quotes at first sight: numbers, names, paths. The library looks at every letter with
/// regular expressions, which took half of the time in which a study finds that nothing is left to do.
bool plain_at_sight(std::string_view text) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  const auto is_letter = [](char letter) { return (letter | 0x20) >= 'a' && (letter | 0x20) <= 'z'; };
  if (text.empty() || (text[0] | 0x20) == 'n') return false;  // null is not plain
  const bool begins = is_letter(text[0]) || is_digit(text[0]) || text[0] == '/' ||
                      (text[0] == '-' && text.size() > 1 && is_digit(text[1]));
  return begins && std::all_of(text.begin(), text.end(), [&](char letter) {
           return is_letter(letter) || is_digit(letter) ||
                  std::string_view("_.+-/").find(letter) != std::string_view::npos;
         });
}

void emit_text(YAML::Emitter& out, const std::string& text) {
  if (plain_at_sight(text))
    out.WriteIntegralType(std::string_view(text));  // as it stands
  else
    out << text;
}

void emit(YAML::Emitter& out, const Node& node) {
  switch (node.kind) {
    case Node::Kind::null:
      out << YAML::Null;
      break;
    case Node::Kind::scalar:
      if (node.quoted)
        out << YAML::DoubleQuoted << node.text;
      else
        emit_text(out, node.text);
      break;
    case Node::Kind::list:
      if (all_scalars(node)) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const Node& item : node.items) emit(out, item);
      out << YAML::EndSeq;
      break;
    case Node::Kind::map:
      out << YAML::BeginMap;
      for (const Entry& entry : node.entries) {
        out << YAML::Key;
        emit_text(out, entry.key);
        out << YAML::Value;
        emit(out, entry.value);
      }
      out << YAML::EndMap;
      break;
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

Node parse_yaml(const std::string& text, const std::string& file) {
  YAML::Node document;
  try {
    check_stream(text, file);
    document = YAML::Load(text);
  } catch (const YAML::Exception& problem) {
    throw InputError(place(problem.mark, file), fmt::format("is not YAML ({})", problem.msg),
                     "mend the line");
  }
  Node root = Converter(file).convert(document);
  if (root.where.line <= 0) root.where = {file, 1, 1};
  return root;
}

Node read_yaml(const std::filesystem::path& file) { return parse_yaml(read_text(file), file.string()); }

std::string to_yaml(const Node& node) {
  YAML::Emitter out;
  emit(out, node);
  return std::string(out.c_str()) + "\n";
}

std::filesystem::path folder_of(const Where& where) {
  return where.file.starts_with("--set ") ? "" : std::filesystem::path(where.file).parent_path();
}

std::string read_text(const std::filesystem::path& file) {
  constexpr std::uintmax_t longest = 256 << 20;  // [bytes]; a day of recorded poses takes 100 MB
  const std::filesystem::file_status status = std::filesystem::status(file);
  if (std::filesystem::is_directory(status))
    throw InputError({file.string()}, "is a folder, not a file", "name a file");
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError({file.string()}, "is a device or a pipe, not a file", "save it as a file first");
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError({file.string()}, fmt::format("cannot be read ({})", std::strerror(errno)),
                     "check the path");
  if (const auto size = std::filesystem::file_size(file); size > longest)
    throw InputError({file.string()}, fmt::format("has {} bytes (at most {} are read)", size, longest),
                     "split it, or leave out what is not needed");
  std::ostringstream text;
  text << in.rdbuf();
  if (in.bad()) throw InputError({file.string()}, "cannot be read to its end", "check the disk");
  return text.str();
}

}  // namespace dresslife::pipeline
