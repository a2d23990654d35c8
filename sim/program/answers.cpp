#include "sim/program/answers.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "pipeline/base/plain_file.h"
#include "pipeline/base/words.h"
#include "pipeline/settings/document.h"

namespace dresslife::sim {
namespace {

using Kind = Question::Kind;

struct Entry {
  Question question;
  std::vector<std::string> comments;
  bool certain = false;  ///< every way through the program needs it
};

std::string quoted(const std::string& text) {
  std::string inner;
  for (char c : text) inner += c == '\'' ? std::string("''") : std::string(1, c);
  return "'" + inner + "'";
}

/// Replaces control characters of a program's text by blanks, so that a YAML comment stays on one line.
std::string on_one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}

/// Returns each question once, in the order of the problems, with the texts of all problems that ask it.
std::vector<Entry> entries_of(const std::vector<Problem>& problems) {
  constexpr std::size_t most_comments = 4;  // problems that one answer solves
  std::vector<Entry> entries;
  std::map<std::pair<Kind, std::string>, std::size_t> known;
  for (const Problem& problem : problems)
    for (const Question& question : problem.questions) {
      const auto [at, is_new] = known.emplace(std::pair(question.kind, question.name), entries.size());
      if (is_new) entries.push_back({question, {}});
      Entry& entry = entries[at->second];
      entry.certain |= problem.certain;
      if (entry.question.form.empty()) entry.question.form = question.form;
      if (entry.comments.size() >= most_comments) continue;
      const std::string file = std::filesystem::path(problem.where.file).filename().string();
      entry.comments.push_back(on_one_line(fmt::format("{}:{}: {}", file, problem.where.line, problem.what)));
    }
  std::stable_partition(entries.begin(), entries.end(), [](const Entry& entry) { return entry.certain; });
  return entries;
}

std::string_view section_of(Kind kind) {
  return pipeline::word_at({"values", "assume", "tools", "work_objects"}, kind);
}

std::string line_of(const Question& question) {
  if (question.kind == Kind::value)
    return fmt::format("{{name: {}, value: {}}}", quoted(question.name), quoted(question.preset));
  if (question.kind == Kind::branch)
    return fmt::format("{{line: {}, take: {}}}", quoted(question.name), quoted(question.preset));
  const bool fanuc = question.name.starts_with("UTOOL[") || question.name.starts_with("UFRAME[");
  return fmt::format("{{name: {}, position_mm: [], {}}}", quoted(question.name),
                     fanuc ? "wpr_deg: [0, 0, 0]" : "quaternion: [1, 0, 0, 0]");
}

std::string frame_line(const pipeline::MotionFrame& frame) {
  const auto& p = frame.position;
  return fmt::format("  - {{name: {}, position_mm: [{}, {}, {}], quaternion: [{}]{}}}\n", quoted(frame.name),
                     fmt::format("{:.9g}", p.x() * 1e3), fmt::format("{:.9g}", p.y() * 1e3),
                     fmt::format("{:.9g}", p.z() * 1e3), fmt::join(frame.quaternion, ", "),
                     frame.stationary ? ", stationary: true" : "");
}

}  // namespace

std::size_t question_count(const std::vector<Problem>& problems) { return entries_of(problems).size(); }

std::string answers_text(const std::vector<Problem>& problems, const pipeline::Motion& given) {
  const std::vector<Entry> entries = entries_of(problems);
  std::string text =
      "# What the program does not say. Write each answer between its quotes or brackets, and import again with --answers.\n"
      "# Before each stands where it is needed. One that stays empty ends the import where the program needs it.\n"
      "# A tool is given in the flange's frame, a work object in the robot's base frame.\n";
  for (const Kind kind : {Kind::tool, Kind::work_object, Kind::value, Kind::branch}) {
    std::string lines;
    if (kind == Kind::tool)
      for (const auto& frame : given.tools) lines += frame_line(frame);
    if (kind == Kind::work_object)
      for (const auto& frame : given.work_objects) lines += frame_line(frame);
    const auto answered = [&](const std::string& name) {
      return std::ranges::any_of(
          entries, [&](const Entry& entry) { return entry.question.kind == kind && entry.question.name == name; });
    };
    if (kind == Kind::value)
      for (const auto& value : given.values)
        if (!value.value.empty() && !answered(value.name))
          lines += fmt::format("  - {{name: {}, value: {}}}\n", quoted(value.name), quoted(value.value));
    if (kind == Kind::branch)
      for (const auto& branch : given.assume)
        if (!branch.take.empty() && !answered(branch.line))
          lines += fmt::format("  - {{line: {}, take: {}}}\n", quoted(branch.line), quoted(branch.take));
    bool certain = true;
    for (const Entry& entry : entries) {
      if (entry.question.kind != kind) continue;
      if (std::exchange(certain, entry.certain) != entry.certain)
        lines +=
            "  # ---- Only some ways through the program need these: leave empty what other answers rule out. ----\n";
      for (const std::string& comment : entry.comments) lines += "  # " + comment + "\n";
      if (!entry.question.form.empty()) lines += "  # write: " + entry.question.form + "\n";
      lines += "  - " + line_of(entry.question) + "\n";
    }
    if (!lines.empty()) text += fmt::format("{}:\n{}", section_of(kind), lines);
  }
  return text;
}

void add_answers(const std::filesystem::path& file, pipeline::Motion& motion) {
  pipeline::Node document = pipeline::read_yaml(file);
  const auto text_of = [](const pipeline::Node& entry, const char* key) {
    const pipeline::Node* node = entry.is_map() ? entry.find(key) : nullptr;
    return node && node->is_scalar() ? std::optional(node->text) : std::nullopt;
  };
  for (pipeline::Entry& section : document.entries) {
    if (section.key != "tools" && section.key != "work_objects" && section.key != "values" && section.key != "assume")
      throw pipeline::InputError(section.where, fmt::format("has '{}', which is no answer", section.key),
                                 "keep tools, work_objects, values and assume; options or a job give the rest");
    std::erase_if(section.value.items, [&](const pipeline::Node& entry) {  // empty entries
      const pipeline::Node* position = entry.is_map() ? entry.find("position_mm") : nullptr;
      const auto name = text_of(entry, "name"), line = text_of(entry, "line");
      if (section.key == "tools" || section.key == "work_objects")
        return position && position->is_list() && position->items.empty();
      if (section.key == "values" && name && text_of(entry, "value") == "")
        return motion.values.push_back({*name, ""}), true;
      if (section.key == "assume" && line && text_of(entry, "take") == "")
        return motion.assume.push_back({*line, ""}), true;
      return false;
    });
  }
  pipeline::Motion read = pipeline::motion_from(document);
  const auto append = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  append(motion.tools, read.tools);
  append(motion.work_objects, read.work_objects);
  append(motion.values, read.values);
  append(motion.assume, read.assume);
}

}  // namespace dresslife::sim
