// A YAML document as a tree in which every key and value has its file, line and column. Only document.cpp uses the YAML library.
// Duplicate keys, merge keys and oversized documents are refused.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

struct Entry;

struct Node {
  enum class Kind { null, scalar, list, map };
  Kind kind = Kind::null;
  std::string text;  ///< of a scalar
  bool quoted = false;
  std::vector<Node> items;     ///< of a list
  std::vector<Entry> entries;  ///< of a map, in the order of the file
  Where where;

  bool is_map() const { return kind == Kind::map; }
  bool is_list() const { return kind == Kind::list; }
  bool is_scalar() const { return kind == Kind::scalar; }
  const Node* find(std::string_view key) const;  ///< value of a map's key; null: no such key
  Node* find(std::string_view key);
  Node& operator[](std::string_view key);  ///< finds or adds the key; makes a null node a map
};

struct Entry {
  std::string key;
  Where where;
  Node value;
};

Node scalar(std::string text);
Node list_of(std::vector<Node> items);

/// Gives one place to a whole tree that was not read from a file, so that errors can point to it.
void place_at(Node& node, const Where& where);

/// Reads a document. Errors: InputError at the place that is not YAML or is not allowed.
Node parse_yaml(const std::string& text, const std::string& file);
Node read_yaml(const std::filesystem::path& file);

/// Returns the document as text. parse_yaml() reads it back to the same tree.
std::string to_yaml(const Node& node);

/// Returns the path of the key or value at a place, "motion.steps.2"; empty: there is none. place: Where::text().
std::string key_at(const Node& tree, const std::string& place);

/// Returns the folder to which file names at a place are relative: the folder of its file, or the current folder for `--set`.
std::filesystem::path folder_of(const Where& where);

}  // namespace dresslife::pipeline
