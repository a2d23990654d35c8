// Settings structures: one describe() of a structure is used to read, check, echo and document it.
//
//   void describe(Fields& f, Hose& hose) {
//     f.number("diameter_mm", hose.diameter, Need::required, above(0), "The outer diameter.");
//   }
//
// The unit is the end of the key (units.h). The default is the value in the struct before it is described. Three visitors use the
// same describe(): read_fields() reads a document, echo_fields() writes one, key_rows() makes the manual. A meaning consists of
// whole sentences. Its first sentence names the value; messages print it after "give". An unknown key, a missing or non-finite
// value and a value outside its range are problems, with place, reason and remedy. A reader continues after a problem and reports
// all of them.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <typeinfo>
#include <vector>

#include "pipeline/settings/document.h"
#include "pipeline/settings/problems.h"

namespace dresslife::pipeline {

/// written: optional, and only programs of this project write it. The manual omits the key, or the keys of a map.
enum class Need { required, optional, written };

/// Allowed values, in the unit of the key.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_excluded = false;

  bool holds(double value) const { return (low_excluded ? value > low : value >= low) && value <= high; }
  std::string text() const;  ///< "> 0", "0 .. 100", "any"
};
inline Range any_number() { return {}; }
inline Range above(double low) { return {low, std::numeric_limits<double>::infinity(), true}; }
inline Range at_least(double low) { return {low}; }
inline Range between(double low, double high) { return {low, high}; }

class Fields {
 public:
  virtual ~Fields() = default;
  using Key = std::string_view;
  using Words = std::vector<std::string_view>;  ///< words of a choice, in the order of the enum's values

  /// Returns the words of an enumeration that counts from 0. Its word() is empty beyond the last value.
  template <class Enum>
  static Words words_of() {
    Words words;
    while (!word(static_cast<Enum>(words.size())).empty()) words.push_back(word(static_cast<Enum>(words.size())));
    return words;
  }

  virtual void text(Key key, std::string& value, Need need, std::string_view meaning) = 0;
  virtual void number(Key key, double& value, Need need, Range range, std::string_view meaning) = 0;
  virtual void maybe_number(Key key, std::optional<double>& value, Range range, std::string_view meaning) = 0;
  /// Reads a number, or this word. For the word, `by_word` becomes true and the value does not change.
  virtual void number_or_word(Key key, double& value, bool& by_word, std::string_view word, Need need, Range range,
                              std::string_view meaning) = 0;
  virtual void integer(Key key, int& value, Need need, Range range, std::string_view meaning) = 0;
  virtual void boolean(Key key, bool& value, Need need, std::string_view meaning) = 0;
  virtual void vector(Key key, Eigen::Vector3d& value, Need need, std::string_view meaning) = 0;
  virtual void numbers(Key key, std::vector<double>& values, Need need, std::string_view meaning) = 0;
  /// A file, relative to the folder of the document that names it.
  virtual void path(Key key, std::filesystem::path& value, Need need, std::string_view meaning) = 0;
  /// Gets the place at which the current map begins.
  virtual void place(Where& where) = 0;
  /// Gets the place of this key's value; does not change `where` if the key is missing.
  virtual void place_of(Key key, Where& where) = 0;

  /// Reads one value of an enumeration that has a word() for each value.
  template <class Enum>
  void choice(Key key, Enum& value, std::string_view meaning) {
    int index = static_cast<int>(value);
    choose(key, index, words_of<Enum>(), meaning);
    value = static_cast<Enum>(index);
  }
  /// Reads one word, or a list of words.
  template <class Enum>
  void choices(Key key, std::vector<Enum>& values, std::string_view meaning) {
    std::vector<int> indices;
    for (Enum value : values) indices.push_back(static_cast<int>(value));
    choose_some(key, indices, words_of<Enum>(), meaning);
    values.clear();
    for (int index : indices) values.push_back(static_cast<Enum>(index));
  }
  template <class T>
  void group(Key key, T& value, Need need, std::string_view meaning, bool present = true) {
    if (!enter(key, need, present, meaning, typeid(T).name())) return;
    describe(*this, value);
    leave();
  }
  template <class T>
  void maybe_group(Key key, std::optional<T>& value, std::string_view meaning, Need need = Need::optional) {
    if (!enter(key, need, value.has_value(), meaning, typeid(T).name())) return;
    if (!value) value.emplace();
    describe(*this, *value);
    leave();
  }
  template <class T>
  void list(Key key, std::vector<T>& values, Need need, std::string_view meaning) {
    values.resize(enter_list(key, values.size(), need, meaning, typeid(T).name()));
    for (std::size_t i = 0; i < values.size(); ++i) {
      enter_item(i);
      describe(*this, values[i]);
      leave();
    }
    leave_list();
  }

 protected:
  virtual void choose(Key key, int& index, const Words& words, std::string_view meaning) = 0;
  virtual void choose_some(Key key, std::vector<int>& indices, const Words& words, std::string_view meaning) = 0;
  virtual bool enter(Key key, Need need, bool present, std::string_view meaning, const char* type) = 0;
  virtual void leave() = 0;
  virtual std::size_t enter_list(Key key, std::size_t count, Need need, std::string_view meaning, const char* type) = 0;
  virtual void enter_item(std::size_t index) = 0;
  virtual void leave_list() = 0;
};

/// A function that describes a struct: it calls Fields once for each key.
using Describe = std::function<void(Fields&)>;

/// Reads a struct from a map. Errors: InputErrors with all problems (see the file head).
void read_fields(const Node& node, const Describe& described);
/// Whether a required key may be missing.
enum class Missing { refused, allowed };
/// Reads a struct and adds its problems to `problems`. Skips keys that `problems` has refused already. A refused value does not
/// change the struct.
void read_fields(const Node& node, const Describe& described, Problems& problems, Missing missing = Missing::refused);
/// Returns the text of a file path in a document. Without this function, paths are written as absolute paths.
using PathText = std::function<std::string(const std::filesystem::path&)>;
/// Writes a struct to a map, including defaults.
Node echo_fields(const Describe& described, const PathText& path_text = {});
/// A key in the manual.
struct KeyRow {
  std::string map;  ///< that contains the key: "routing.base_clamp", "motion.steps[]"; for the root its title
  std::string key, unit, allowed, fallback, meaning;
};
/// Returns all keys, map by map in the order of their description; `title` names the root. If a struct is in several places, its
/// keys are listed at the first place, and the other places refer to it.
std::vector<KeyRow> key_rows(const std::string& title, const Describe& described);
/// Returns a Markdown table for each map, with a heading.
std::string key_tables(const std::vector<KeyRow>& rows);

template <class T>
void read_fields(const Node& node, T& value) {
  read_fields(node, Describe([&](Fields& f) { describe(f, value); }));
}

template <class T>
Node echo_fields(T value) {
  return echo_fields(Describe([&](Fields& f) { describe(f, value); }));
}

template <class T>
std::vector<KeyRow> key_rows(const std::string& title) {
  T value{};
  return key_rows(title, Describe([&](Fields& f) { describe(f, value); }));
}

/// Returns the word nearest to `word` by edit distance; empty if none is near.
std::string nearest_word(std::string_view word, const std::vector<std::string>& words);

}  // namespace dresslife::pipeline
