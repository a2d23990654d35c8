#include "pipeline/settings/fields.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "pipeline/base/joined.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/text.h"
#include "pipeline/settings/echo_text.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

std::optional<double> parse_number(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  if (text == ".nan" || text == ".inf" || text == "-.inf" || text == ".NaN") return std::nan("");
  return whole_number_in<double>(text);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above_left = diagonal;
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, above_left + (a[i - 1] != b[j - 1])});
    }
  }
  return row.back();
}

/// Returns ", or 1200 if the comma separates thousands" if 1.200 was written as 1,200; else an empty text.
std::string thousands_words(const std::string& decimal, const std::string& whole) {
  const bool may_be = decimal.size() - decimal.find('.') == 4 && decimal[0] != '0' && decimal.substr(0, 2) != "-0";
  return may_be ? fmt::format(", or {} if the comma separates thousands", whole) : "";
}

/// Returns "write 2.03 with a point; " for 2,03; else an empty text.
std::string decimal_comma_words(std::string text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return "";
  const std::string whole = std::string(text).erase(comma, 1);
  text[comma] = '.';
  return parse_number(text) ? fmt::format("write {} with a point{}; ", text, thousands_words(text, whole)) : "";
}

/// Returns "write 0.5189 for AWG 20; " if the value is a wire gauge instead of a section; else an empty text.
std::string gauge_words(const std::string& text, Fields::Key key) {
  const bool is_gauge = unit_of_key(key).suffix == "mm2" && (text.starts_with("AWG") || text.starts_with("awg"));
  const std::optional<double> gauge =
      is_gauge ? parse_number(std::string_view(text).substr(std::min(text.size(), text.find_first_of("0123456789"))))
               : std::nullopt;
  return gauge ? fmt::format("write {:.4g} for AWG {:g}; ", square_mm_of_awg(*gauge), *gauge) : "";
}

/// A word that data sheets and other programs use for what a key gives.
struct OtherWord {
  std::string_view word, key;
  double factor;  ///< of the value; 0: the value follows from other numbers, too
};
constexpr OtherWord other_words[] = {{"hose_bore_mm", "inner_diameter_mm", 1},
                                     {"bore_mm", "inner_diameter_mm", 1},
                                     {"bore_diameter_mm", "inner_diameter_mm", 1},
                                     {"outer_diameter_mm", "diameter_mm", 1},
                                     {"diameter_mm", "radius_mm", 0.5},
                                     {"outer_diameter_mm", "radius_mm", 0.5},
                                     {"helix_diameter_mm", "helix_radius_mm", 0.5},
                                     {"lay_length_mm", "lay_angle_deg", 0},
                                     {"lay_angle_deg", "lay_length_mm", 0}};

std::string unit_note(Fields::Key key) {
  const Unit& unit = unit_of_key(key);
  return unit.name.empty() ? "" : fmt::format(" {}", unit.name);
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& words) {
  std::string best;
  std::size_t distance = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : words)
    if (const std::size_t d = edit_distance(word, candidate); d < distance) {
      distance = d;
      best = candidate;
    }
  return best;
}

std::string Range::text() const {
  const bool from = std::isfinite(low), to = std::isfinite(high);
  if (from && to) return fmt::format("{} .. {}", low, high);
  if (from) return fmt::format("{} {}", low_excluded ? ">" : ">=", low);
  if (to) return fmt::format("<= {}", high);
  return "any";
}

// ---- reading ----------------------------------------------------------------------------------------------

namespace {

class FieldReader final : public Fields {
 public:
  FieldReader(const Node& root, Problems& problems, Missing missing)
      : problems_(problems), passed_over_(problems.keys()), missing_(missing) {
    if (!root.is_map())
      throw InputError(root.where, "holds no settings (a map of 'key: value' lines is expected)", "write some");
    levels_.emplace_back().map = &root;
  }

  /// Adds a problem for each unknown or missing key of the root.
  void finish() { close(levels_.back()); }

  void text(Key key, std::string& value, Need need, std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      if (!node.is_scalar() || node.text.empty()) refuse(node, fmt::format("{} must be text", name_of(key)), meaning);
      value = node.text;
    });
  }

  void number(Key key, double& value, Need need, Range range, std::string_view meaning) override {
    read(key, need, meaning,
         [&](const Node& node) { value = number_of(node, key, range, meaning) * unit_of_key(key).to_si; });
  }

  void maybe_number(Key key, std::optional<double>& value, Range range, std::string_view meaning) override {
    read(key, Need::optional, meaning,
         [&](const Node& node) { value = number_of(node, key, range, meaning) * unit_of_key(key).to_si; });
  }

  void number_or_word(Key key, double& value, bool& by_word, std::string_view word, Need need, Range range,
                      std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      by_word = node.is_scalar() && node.text == word;
      if (!by_word) value = number_of(node, key, range, meaning, word) * unit_of_key(key).to_si;
    });
  }

  void integer(Key key, int& value, Need need, Range range, std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      const double number = number_of(node, key, range, meaning);
      constexpr double most = 1e9;  // of an int: 2.1e9
      if (number != std::floor(number) || std::abs(number) > most)
        refuse(node,
               fmt::format("{} is {} (must be a whole number{})", name_of(key), node.text,
                           std::abs(number) > most ? fmt::format(", at most {:g}", most) : ""),
               meaning);
      value = static_cast<int>(number);
    });
  }

  void boolean(Key key, bool& value, Need need, std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      if (!node.is_scalar() || (node.text != "true" && node.text != "false"))
        refuse(node, fmt::format("{} is '{}' (must be true or false)", name_of(key), node.text), meaning);
      value = node.text == "true";
    });
  }

  void vector(Key key, Eigen::Vector3d& value, Need need, std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      if (!node.is_list() || node.items.size() != 3)
        refuse(node, fmt::format("{} must be three numbers [x, y, z]", name_of(key)), meaning);
      for (int axis = 0; axis < 3; ++axis)
        value[axis] = number_of(node.items[axis], key, any_number(), meaning) * unit_of_key(key).to_si;
    });
  }

  void numbers(Key key, std::vector<double>& values, Need need, std::string_view meaning) override {
    read(key, need, meaning, [&](const Node& node) {
      if (!node.is_list() || node.items.empty())
        refuse(node, fmt::format("{} must be a list of numbers", name_of(key)), meaning);
      values.clear();
      for (const Node& item : node.items)
        values.push_back(number_of(item, key, any_number(), meaning) * unit_of_key(key).to_si);
    });
  }

  void path(Key key, std::filesystem::path& value, Need need, std::string_view meaning) override {
    std::string written;
    text(key, written, need, meaning);
    if (written.empty()) return;
    // The path is absolute, because a job may be used from another folder. A relative path is relative to the folder behind all
    // links.
    std::filesystem::path folder = folder_of(levels_.back().map->find(key)->where);
    if (!folder.empty()) folder = std::filesystem::weakly_canonical(folder);
    value = std::filesystem::absolute(folder / written).lexically_normal();
  }

  void place(Where& where) override { where = levels_.back().map->where; }
  void place_of(Key key, Where& where) override {
    if (const Node* value = levels_.back().map->find(key)) where = value->where;
  }

 protected:
  void choose(Key key, int& index, const Words& words, std::string_view meaning) override {
    read(key, Need::optional, meaning, [&](const Node& node) { index = word_of(node, key, words, meaning); });
  }

  void choose_some(Key key, std::vector<int>& indices, const Words& words, std::string_view meaning) override {
    read(key, Need::optional, meaning, [&](const Node& node) {
      if (node.is_list() && node.items.empty()) refuse(node, fmt::format("{} is an empty list", name_of(key)), meaning);
      std::vector<int> read;
      if (!node.is_list()) read.push_back(word_of(node, key, words, meaning));
      for (const Node& item : node.items) read.push_back(word_of(item, key, words, meaning));
      indices = std::move(read);
    });
  }

  bool enter(Key key, Need need, bool, std::string_view meaning, const char*) override {
    bool entered = false;
    read(key, need, meaning, [&](const Node& node) {
      const std::string problem = fmt::format("{} must be a map of settings", name_of(key));
      if (node.is_scalar() && node.text.find(':') != std::string::npos)
        throw InputError(node.where, problem, "write a space after the colon of a key");
      if (!node.is_map()) refuse(node, problem, meaning);
      Level level;
      level.path = name_of(key);
      level.map = &node;
      levels_.push_back(std::move(level));
      entered = true;
    });
    return entered;
  }

  void leave() override {
    const Level level = std::move(levels_.back());
    levels_.pop_back();
    close(level);
  }

  std::size_t enter_list(Key key, std::size_t, Need need, std::string_view meaning, const char*) override {
    Level level;
    level.path = name_of(key);
    read(key, need, meaning, [&](const Node& node) {
      if (!node.is_list()) refuse(node, fmt::format("{} must be a list", name_of(key)), meaning);
      level.list = &node;
    });
    levels_.push_back(std::move(level));
    return levels_.back().list ? levels_.back().list->items.size() : 0;
  }

  void enter_item(std::size_t index) override {
    static const Node nothing;
    const Node& node = levels_.back().list->items[index];
    Level level;
    level.path = fmt::format("{}[{}]", levels_.back().path, index + 1);
    level.map = &node;
    level.passed_over = passed_over_.contains(level.path);
    if (!level.passed_over && !node.is_map()) {
      problems_.add(node.where, fmt::format("{} must be a map of settings", level.path), "write {key: value, ...}",
                    level.path);
      level.passed_over = true;
    }
    if (level.passed_over) level.map = &nothing;
    levels_.push_back(std::move(level));
  }

  void leave_list() override { levels_.pop_back(); }

 private:
  struct Level {
    const Node* map = nullptr;
    const Node* list = nullptr;
    bool passed_over = false;        ///< the map was refused as a whole
    std::string path;                ///< path of the map, for messages: "dresspack.components[2]"
    std::vector<std::string> known;  ///< keys that were described up to now
    struct MissingKey {
      std::string key, meaning;
    };
    std::vector<MissingKey> missing;
  };

  [[noreturn]] static void refuse(const Node& node, const std::string& what, std::string_view meaning) {
    throw InputError(node.where, what, "give " + named(meaning));
  }

  /// Returns the first sentence of a meaning for use in another sentence: "the outer diameter of the hose".
  static std::string named(std::string_view meaning) {
    const std::size_t end = meaning.find(". ");
    std::string first(meaning.substr(0, end));
    if (first.ends_with('.')) first.pop_back();
    if (first.size() > 1 && std::islower(static_cast<unsigned char>(first[1])))  // not for a symbol, such as E
      first[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(first[0])));
    return first;
  }

  /// Calls `take` with the value of the key if the map has it and it was not refused. An exception of `take` is a problem of this
  /// key.
  template <class Take>
  void read(Key key, Need need, std::string_view meaning, const Take& take) {
    Level& level = levels_.back();
    level.known.emplace_back(key);
    if (level.passed_over || (!passed_over_.empty() && passed_over_.contains(name_of(key)))) return;
    const Node* node = level.map->find(key);
    if (!node && need == Need::required && missing_ == Missing::refused)
      level.missing.push_back({std::string(key), std::string(meaning)});
    if (!node) return;
    const std::string path = name_of(key);
    problems_.attempt(path, node->where, [&] {
      if (node->kind == Node::Kind::null) refuse(*node, fmt::format("{} has no value", path), meaning);
      take(*node);
    });
  }

  std::string name_of(Key key) const {
    const std::string& path = levels_.back().path;
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  /// Returns the number in a node. word: the word that is allowed instead; empty: none.
  double number_of(const Node& node, Key key, Range range, std::string_view meaning, std::string_view word = "") const {
    const std::optional<double> value = node.is_scalar() && !node.quoted ? parse_number(node.text) : std::nullopt;
    if (!value) {
      const std::string unit = unit_note(key);
      throw InputError(node.where,
                       fmt::format("{} is {} (must be a number{}{})", name_of(key),
                                   node.is_scalar() ? fmt::format("'{}'", node.text) : "not one value",
                                   word.empty() ? "" : fmt::format(" or {}", word),
                                   unit.empty() ? "" : fmt::format(", the unit is in the key:{}", unit)),
                       (node.quoted && parse_number(node.text) ? "write it without quotes; " : "") +
                           decimal_comma_words(node.text) + gauge_words(node.text, key) + "give " + named(meaning));
    }
    if (!std::isfinite(*value))
      throw InputError(node.where, fmt::format("{} is {} (must be finite)", name_of(key), node.text),
                       "give " + named(meaning));
    if (!range.holds(*value))
      throw InputError(node.where,
                       fmt::format("{} is {} (must be {}{})", name_of(key), node.text, range.text(), unit_note(key)),
                       "give " + named(meaning));
    const Unit& unit = unit_of_key(key);
    if (std::abs(*value) > unit.most || (range.low_excluded && range.low == 0 && *value < unit.least()))
      throw InputError(node.where,
                       fmt::format("{} is {} (its size must be {} .. {}{})", name_of(key), node.text,
                                   range.low_excluded ? unit.least() : 0.0, unit.most, unit_note(key)),
                       "give " + named(meaning) + in_millimetres(*value, unit));
    return *value;
  }

  /// Returns ", or 1.34 if 1340 is in millimetres" for a length in metres that is too large; else an empty text.
  static std::string in_millimetres(double value, const Unit& unit) {
    constexpr double per_metre = 1e3;
    return unit.name == "m" && std::abs(value) > unit.most && std::abs(value) <= per_metre * unit.most
               ? fmt::format(", or {:g} if {:g} is in millimetres", value / per_metre, value)
               : "";
  }

  int word_of(const Node& node, Key key, const Words& words, std::string_view meaning) const {
    if (node.is_scalar())
      for (std::size_t i = 0; i < words.size(); ++i)
        if (node.text == words[i]) return static_cast<int>(i);
    throw InputError(node.where, fmt::format("{} is '{}' (must be {})", name_of(key), node.text, joined(words, " | ")),
                     "give " + named(meaning));
  }

  /// Returns the key that an unknown key probably means; empty if none is near.
  std::string likely_key(const Level& level, const Entry& unknown, std::string& remedy) const {
    const std::optional<double> value = unknown.value.is_scalar() ? parse_number(unknown.value.text) : std::nullopt;
    for (const std::string& known : level.known)
      if (const std::string converted = value ? converted_text(unknown.key, *value, known) : ""; !converted.empty()) {
        remedy = fmt::format("its unit is {}, write '{}'", unit_of_key(known).name, converted);
        return known;
      }
    for (const OtherWord& other : other_words)
      if (const std::string known(other.key);
          other.word == unknown.key && std::ranges::find(level.known, known) != level.known.end()) {
        const Node* const radius = level.map->find("helix_radius_mm");
        const std::optional<double> helix = radius ? parse_number(radius->text) : std::nullopt;
        remedy = fmt::format("did you mean '{}'?", known);
        if (value && other.factor > 0)
          remedy += fmt::format(" Then write '{}: {:.4g}'", known, *value * other.factor);
        else if (value && helix && *value > 0 && known == "lay_angle_deg")  // the helix unrolled is a triangle
          remedy += fmt::format(" A lay length of {:g} mm is '{}: {:.3g}' at this helix_radius_mm", *value, known,
                                std::atan(2 * std::numbers::pi * *helix / *value) * 180 / std::numbers::pi);
        else if (other.factor == 0)
          remedy += " The tangent of the lay angle is the circumference of the layer's middle over the lay length";
        return known;
      }
    for (const std::string& known : level.known) {
      if (stem_of_key(known) != stem_of_key(unknown.key)) continue;
      const std::string_view unit = unit_of_key(known).name;
      remedy = unit.empty() ? fmt::format("this key carries no unit, write '{}'", known)
                            : fmt::format("its unit is {}, write '{}'", unit, known);
      return known;
    }
    // The unit is of another kind: mass_g for mass_kg_per_m.
    for (const std::string& known : level.known)
      if (const std::string stem(stem_of_key(known));
          stem.size() < known.size() && unknown.key.starts_with(stem + "_")) {
        remedy = fmt::format("did you mean '{}'? Its unit is {}", known, unit_of_key(known).name);
        return known;
      }
    const std::string nearest = nearest_word(unknown.key, level.known);
    remedy = nearest.empty() ? fmt::format("keys here: {}", joined(level.known, ", "))
                             : fmt::format("did you mean '{}'?", nearest);
    return nearest;
  }

  /// Adds a problem for each unknown or missing key. A key with a wrong name does not count as missing.
  void close(const Level& level) {
    if (level.passed_over) return;
    const auto path_of = [&](const std::string& key) { return level.path.empty() ? key : level.path + "." + key; };
    std::vector<std::string> misnamed;
    for (const Entry& entry : level.map->entries) {
      if (std::ranges::find(level.known, entry.key) != level.known.end()) continue;
      std::string remedy;
      std::string likely = likely_key(level, entry, remedy);
      // In "{percent_of_time: 12,5}", YAML takes the comma as the end of the value.
      if (const Entry* const before = &entry == &level.map->entries.front() ? nullptr : &entry - 1;
          before && entry.value.kind == Node::Kind::null &&
          entry.key.find_first_not_of("0123456789") == std::string::npos && !before->value.text.empty() &&
          before->value.text.find_first_not_of("-0123456789") == std::string::npos)
        likely = "",
        remedy = fmt::format("write '{}: {}.{}' with a decimal point{}", before->key, before->value.text, entry.key,
                             thousands_words(before->value.text + '.' + entry.key, before->value.text + entry.key));
      misnamed.push_back(likely);
      problems_.add(entry.where, fmt::format("unknown key '{}'", path_of(entry.key)), remedy,
                    likely.empty() ? "" : path_of(likely));
    }
    for (const auto& [key, meaning] : level.missing)
      if (std::ranges::find(misnamed, key) == misnamed.end())
        problems_.add(level.map->where, fmt::format("{} is missing", path_of(key)),
                      fmt::format("add '{}: ...': {}", key, named(meaning)), path_of(key));
  }

  Problems& problems_;
  const std::set<std::string> passed_over_;  ///< keys that were refused before
  const Missing missing_;
  std::vector<Level> levels_;
};
// ---- echo -------------------------------------------------------------------------------------------------

class FieldEcho final : public Fields {
 public:
  Node finish() { return std::move(levels_.front()); }
  /// omitted: groups of the root that are left out.
  explicit FieldEcho(const PathText& path_text, EchoKeys omitted = {})
      : path_text_(path_text), omitted_(std::move(omitted)) {
    open("", Node::Kind::map);
  }

  void text(Key key, std::string& value, Need, std::string_view) override {
    if (!value.empty()) put(key, scalar(value));
  }

  void number(Key key, double& value, Need, Range, std::string_view) override {
    put(key, scalar(text_in_unit(value, unit_of_key(key))));
  }

  void maybe_number(Key key, std::optional<double>& value, Range, std::string_view) override {
    if (value) put(key, scalar(text_in_unit(*value, unit_of_key(key))));
  }

  void number_or_word(Key key, double& value, bool& by_word, std::string_view word, Need, Range,
                      std::string_view) override {
    put(key, scalar(by_word ? std::string(word) : text_in_unit(value, unit_of_key(key))));
  }

  void integer(Key key, int& value, Need, Range, std::string_view) override { put(key, scalar(std::to_string(value))); }

  void boolean(Key key, bool& value, Need, std::string_view) override { put(key, scalar(value ? "true" : "false")); }

  void vector(Key key, Eigen::Vector3d& value, Need need, std::string_view meaning) override {
    std::vector<double> values(value.begin(), value.end());
    numbers(key, values, need, meaning);
  }

  void numbers(Key key, std::vector<double>& values, Need, std::string_view) override {
    if (values.empty()) return;
    put(key, list_of(mapped(values, [&](double value) { return scalar(text_in_unit(value, unit_of_key(key))); })));
  }

  void path(Key key, std::filesystem::path& value, Need, std::string_view) override {
    if (!value.empty()) put(key, scalar(path_text_ ? path_text_(value) : value.string()));
  }

  void place(Where&) override {}
  void place_of(Key, Where&) override {}

 protected:
  void choose(Key key, int& index, const Words& words, std::string_view) override {
    put(key, scalar(std::string(words[index])));
  }

  void choose_some(Key key, std::vector<int>& indices, const Words& words, std::string_view) override {
    if (indices.empty()) return;
    const auto items = mapped(indices, [&](int index) { return scalar(std::string(words[index])); });
    put(key, items.size() == 1 ? items[0] : list_of(items));
  }

  bool enter(Key key, Need, bool present, std::string_view, const char*) override {
    if (!present || (levels_.size() == 1 && omitted_.contains(key))) return false;
    open(key, Node::Kind::map);
    return true;
  }

  void leave() override { close(); }

  std::size_t enter_list(Key key, std::size_t count, Need, std::string_view, const char*) override {
    open(key, Node::Kind::list);
    return count;
  }

  void enter_item(std::size_t) override { open("", Node::Kind::map); }
  void leave_list() override { close(); }

 private:
  void put(Key key, Node value) { levels_.back()[key] = std::move(value); }

  void open(Key key, Node::Kind kind) {
    keys_.emplace_back(key);
    levels_.emplace_back().kind = kind;
  }
  /// What was opened last goes into the one before, unless it is empty; an item of a list always does.
  void close() {
    Node made = std::move(levels_.back());
    const std::string key = keys_.back();
    levels_.pop_back();
    keys_.pop_back();
    if (levels_.back().is_list())
      levels_.back().items.push_back(std::move(made));
    else if (!made.entries.empty() || !made.items.empty())
      put(key, std::move(made));
  }

  const PathText& path_text_;
  EchoKeys omitted_;
  std::vector<Node> levels_;       ///< open maps and lists, outermost first
  std::vector<std::string> keys_;  ///< key of each open map or list in the map around it
};
// ---- manual -----------------------------------------------------------------------------------------------

class KeyLister final : public Fields {
 public:
  explicit KeyLister(std::string title) { open(std::move(title), ""); }

  std::vector<KeyRow> finish() {
    std::vector<KeyRow> rows;
    for (Map& map : maps_) std::move(map.rows.begin(), map.rows.end(), std::back_inserter(rows));
    return rows;
  }

  void text(Key key, std::string& value, Need need, std::string_view meaning) override {
    row(key, need, "text", value.empty() ? "none" : value, meaning);
  }

  void number(Key key, double& value, Need need, Range range, std::string_view meaning) override {
    row(key, need, range.text(), text_in_unit(value, unit_of_key(key)), meaning);
  }

  void maybe_number(Key key, std::optional<double>&, Range range, std::string_view meaning) override {
    row(key, Need::optional, range.text(), "none", meaning);
  }

  void number_or_word(Key key, double& value, bool& by_word, std::string_view word, Need need, Range range,
                      std::string_view meaning) override {
    row(key, need, fmt::format("{} | {}", range.text(), word),
        by_word ? std::string(word) : text_in_unit(value, unit_of_key(key)), meaning);
  }

  void integer(Key key, int& value, Need need, Range range, std::string_view meaning) override {
    row(key, need, "whole, " + range.text(), std::to_string(value), meaning);
  }

  void boolean(Key key, bool& value, Need need, std::string_view meaning) override {
    row(key, need, "true | false", value ? "true" : "false", meaning);
  }

  void vector(Key key, Eigen::Vector3d& value, Need need, std::string_view meaning) override {
    const Unit& unit = unit_of_key(key);
    row(key, need, "[x, y, z]",
        fmt::format("[{}, {}, {}]", text_in_unit(value[0], unit), text_in_unit(value[1], unit),
                    text_in_unit(value[2], unit)),
        meaning);
  }

  void numbers(Key key, std::vector<double>&, Need need, std::string_view meaning) override {
    row(key, need, "list of numbers", "none", meaning);
  }

  void path(Key key, std::filesystem::path&, Need need, std::string_view meaning) override {
    row(key, need, "file", "none", meaning);
  }

  void place(Where&) override {}
  void place_of(Key, Where&) override {}

 protected:
  void choose(Key key, int& index, const Words& words, std::string_view meaning) override {
    row(key, Need::optional, joined(words, " | "), std::string(words[index]), meaning);
  }

  void choose_some(Key key, std::vector<int>& indices, const Words& words, std::string_view meaning) override {
    row(key, Need::optional, fmt::format("{}; one, or a list", joined(words, " | ")),
        indices.empty() ? "none" : std::string(words[indices[0]]), meaning);
  }

  bool enter(Key key, Need need, bool, std::string_view meaning, const char* type) override {
    // A written map is a file that a user may name. The manual lists the map's own key, but not its keys.
    const bool listed = need != Need::written && map_of(type).empty();
    row(key, need == Need::required ? Need::required : Need::optional, "map", "none",
        std::string(meaning) + reference(type));
    if (listed) open(path_of(key, ""), type);
    return listed;
  }
  void leave() override { open_.pop_back(); }

  std::size_t enter_list(Key key, std::size_t, Need need, std::string_view meaning, const char* type) override {
    const bool listed = map_of(type).empty();
    row(key, need, "list of maps", "none", std::string(meaning) + reference(type));
    if (listed) open(path_of(key, "[]"), type);
    return listed ? 1 : 0;
  }
  // Each enter_list() has one leave(), which closes the map of its only item.
  void enter_item(std::size_t) override {}
  void leave_list() override {}

 private:
  struct Map {
    std::string path, type;
    std::vector<KeyRow> rows;
  };

  void row(Key key, Need need, const std::string& allowed, const std::string& fallback, std::string_view meaning) {
    if (need == Need::written) return;
    Map& map = maps_[open_.back()];
    map.rows.push_back({map.path, std::string(key), std::string(unit_of_key(key).name), allowed,
                        need == Need::required ? "required" : fallback, std::string(meaning)});
  }

  /// Returns the path of the map that lists the keys of this type; empty if no map lists them yet.
  std::string map_of(const std::string& type) const {
    const Map* const found = find_in(maps_, &Map::type, type);
    return found ? found->path : "";
  }

  std::string reference(const char* type) const {
    const std::string map = map_of(type);
    return map.empty() ? "" : fmt::format(" Its keys are those of `{}`.", map);
  }

  std::string path_of(Key key, const char* suffix) const {
    return fmt::format("{}{}{}", open_.size() == 1 ? "" : maps_[open_.back()].path + ".", key, suffix);
  }

  void open(std::string path, const char* type) {
    open_.push_back(maps_.size());
    maps_.push_back({std::move(path), type, {}});
  }

  std::vector<Map> maps_;          ///< in the order of opening
  std::vector<std::size_t> open_;  ///< indices of the open maps, outermost first
};

}  // namespace

// ---- the three visits -------------------------------------------------------------------------------------

void read_fields(const Node& node, const Describe& described) {
  Problems problems;
  read_fields(node, described, problems);
  problems.finish(node.where.file);
}

void read_fields(const Node& node, const Describe& described, Problems& problems, Missing missing) {
  FieldReader reader(node, problems, missing);
  described(reader);
  reader.finish();
}

Node echo_fields(const Describe& described, const PathText& path_text) {
  FieldEcho echo(path_text);
  described(echo);
  return echo.finish();
}

EchoSections echo_sections(const Describe& described, const PathText& path_text, const EchoKeys& omitted) {
  FieldEcho echo(path_text, omitted);
  described(echo);
  Node whole = echo.finish();
  return mapped(whole.entries, [](Entry& entry) {
    Node alone;
    alone[entry.key] = std::move(entry.value);
    return std::pair(entry.key, to_yaml(alone));
  });
}

std::string joined_text(const EchoSections& sections) {
  std::string text;
  for (const auto& [key, section] : sections) text += section;
  return text.empty() ? "{}\n" : text;
}

std::vector<KeyRow> key_rows(const std::string& title, const Describe& described) {
  KeyLister lister(title);
  described(lister);
  return lister.finish();
}

std::string key_tables(const std::vector<KeyRow>& rows) {
  const auto cell = [](const std::string& text) {  // a bar would end the cell
    std::string escaped;
    for (const char c : text) escaped += c == '|' ? "\\|" : std::string(1, c);
    return escaped;
  };
  std::string text, map;
  for (const KeyRow& row : rows) {
    if (row.map != map)
      text += fmt::format("{}### {}\n\n| key | allowed | default | meaning |\n|---|---|---|---|\n",
                          map.empty() ? "" : "\n", row.map);
    map = row.map;
    text += fmt::format("| `{}` | {} | {} | {} |\n", row.key, cell(row.allowed), row.fallback, cell(row.meaning));
  }
  return text;
}

}  // namespace dresslife::pipeline
