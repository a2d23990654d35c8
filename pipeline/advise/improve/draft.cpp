#include "pipeline/advise/improve/draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "pipeline/advise/improve/scaled.h"
#include "pipeline/advise/improve/set_text.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/installation.h"
#include "pipeline/base/ownership.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/whole_file.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/settings/fields.h"
#include "pipeline/study/stage_program.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view command_line = "command line";

bool is_shipped(const char* shelf, const Node& entry) {
  return entry.is_scalar() && entry.text.find('/') == std::string::npos &&
         kind_of(shipped_catalogue() / shelf / (entry.text + ".yaml")) == FileKind::file;
}

Node named(const std::string& text) {
  Node node = scalar(text);
  place_at(node, {std::string(command_line)});
  return node;
}

bool is_yaml_file(const std::string& of) {
  return of.ends_with(".yaml") || of.ends_with(".yml") || fs::path(of).has_parent_path();
}

/// Returns the job with the name `of`; a null node: no such job.
Node job_named(const std::string& of) {
  if (of.ends_with(".urdf")) return {};
  if (is_yaml_file(of)) {
    Node document = read_document(of);
    return document.find("joints") ? Node{} : document;
  }
  const fs::path shipped = shipped_catalogue() / "jobs" / (of + ".yaml");
  return kind_of(shipped) == FileKind::file ? read_document(fs::proximate(shipped)) : Node{};
}

Robot robot_of(const Node& document) {
  Node alone;
  alone.where = document.where;
  alone["robot"] = *document.find("robot");
  resolve_job(alone);
  Robot robot;
  read_fields(*alone.find("robot"), robot);
  return robot;
}

/// Returns a motion at rest that every robot can perform.
Node standing(const Robot& robot) {
  std::string angles;
  for (const Joint& joint : robot.joints)
    if (joint.follows.empty())
      angles += fmt::format("{}{:.3f}", angles.empty() ? "" : ", ", std::clamp(0.0, joint.lower, joint.upper) / degree);
  return parse_yaml(fmt::format("{{name: standing, source: none, steps: [{{text: stand, joints_deg: [{}]}}]}}", angles),
                    std::string(command_line));
}

std::string link_or(const std::string& asked, const Node* routing, const char* clamp, const std::string& otherwise) {
  if (!asked.empty()) return asked;
  const Node* of = routing ? routing->find(clamp) : nullptr;
  const Node* link = of ? of->find("link") : nullptr;
  return link && link->is_scalar() ? link->text : otherwise;
}

constexpr std::array kept_settings{"mounting_pose_deg", "longest_bracket_mm", "side"};

/// Adds the kept keys of a routing that the found one does not have. given: null: no routing.
void keep_settings(Node& routing, const Node* given) {
  for (const char* key : kept_settings)
    if (const Node* value = given ? given->find(key) : nullptr; value && !routing.find(key)) routing[key] = *value;
}

/// Refuses unknown keys and wrong values of a given routing, which may lack keys.
void check_given(const Node& given) {
  Node document;
  document["routing"] = given;
  Routing routing;
  Problems problems;
  const Describe described([&](Fields& f) { f.group("routing", routing, Need::required, "The routing."); });
  read_fields(document, described, problems, Missing::allowed);
  problems.finish(given.where.file);
}

/// Returns clamps on the links, with placeholders for positions and length.
Node links_only(const RouteRequest& request, const Robot& robot, const Node* given) {
  if (robot.links.size() < 2)
    throw InputError({request.of}, "its robot has fewer than two links", "name a robot that moves");
  const std::string& base = robot.links[std::min<std::size_t>(3, robot.links.size() - 2)].name;
  Node routing = parse_yaml(
      "{base_clamp: {link: x, position_m: [0, 0, 0.1], direction: [1, 0, 0]}, "
      "tool_clamp: {link: x, position_m: [0, 0, 0.1], direction: [1, 0, 0]}, free_length_m: 2}",
      std::string(command_line));
  (*routing.find("base_clamp"))["link"] = named(link_or(request.base_link, given, "base_clamp", base));
  (*routing.find("tool_clamp"))["link"] =
      named(link_or(request.tool_link, given, "tool_clamp", robot.links.back().name));
  keep_settings(routing, given);
  return routing;
}

/// Returns the folder to which paths in an entry are relative.
fs::path folder_of(const Node& entry) {
  return entry.where.file == command_line ? fs::path() : fs::path(entry.where.file).parent_path();
}

/// Returns whether all paths in an entry have the same meaning in a job in that folder.
bool counts_from(const Node& entry, const fs::path& folder) {
  const auto within = [&](const Node& node) { return counts_from(node, folder); };
  return inode_of(folder / ".") == inode_of(folder_of(entry) / ".") && std::ranges::all_of(entry.items, within) &&
         std::ranges::all_of(entry.entries, [&](const Entry& one) { return within(one.value); });
}

/// Returns the name of an entry's file for a job in another folder.
Node file_from(const Node& entry, const fs::path& folder) {
  Node named = scalar((fs::path(".") / as_seen_from(folder, folder_of(entry) / entry.text)).string());
  place_at(named, entry.where);
  return named;
}

/// Returns a robot of a URDF for a job in another folder, so that messages name lines of the URDF. A null node: other keys may have
/// paths, too.
Node urdf_from(Node robot, const fs::path& folder) {
  for (Entry& key : robot.entries)
    if (key.key == "urdf" || key.key == "package_folder")
      key.value = file_from(key.value, folder);
    else if (!key.value.is_scalar() && key.key != "accelerations_deg_per_s2")
      return {};
  return robot;
}

/// Returns an entry for a job in another folder: a file is named by its path from that folder. A null node: no reference is
/// possible, so the entry must be written out.
Node reference(const Node& entry, const std::optional<fs::path>& folder) {
  if (!folder) return {};
  if (counts_from(entry, *folder)) return entry;
  if (entry.is_map() && entry.find("urdf")) return urdf_from(entry, *folder);
  if (!entry.is_scalar() || !fs::path(entry.text).has_extension()) return {};
  if (kind_of(folder_of(entry) / entry.text) != FileKind::file) return {};
  return file_from(entry, *folder);
}

std::string fit_for_a_file(std::string name) {
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_' && c != '-') c = '_';
  return name;
}

}  // namespace

bool is_kept_by_search(std::string_view key) {
  const auto is_in = [&](std::string_view kept) { return key == kept || key.starts_with(std::string(kept) + "."); };
  return key == "base_clamp.link" || key == "tool_clamp.link" || std::ranges::any_of(kept_settings, is_in);
}

Draft draft_of(const RouteRequest& request) {
  Draft draft;
  draft.name = fit_for_a_file(fs::path(request.of).stem().string());
  draft.document = job_named(request.of);
  const bool of_robot = draft.document.kind == Node::Kind::null;
  if (of_robot) {
    draft.document.where = {std::string(command_line)};
    draft.document["robot"] = named(request.of);
    draft.document["dresspack"] = named("spot_welding");
  }
  if (draft.document.find("dresspacks"))
    throw InputError(draft.document.find("dresspacks")->where, "a routing is proposed for one dresspack",
                     "name a job with dresspack and routing");
  std::ranges::copy_if(draft.document.entries, std::back_inserter(draft.robot_lines),
                       [](const Entry& line) { return line.key == "robot" || line.key.starts_with("robot."); });
  apply_lines(draft.document);
  if (!draft.document.find("robot")) refuse_other_kind(draft.document, DocumentKind::job);
  if (!draft.document.find("robot"))
    throw InputError(draft.document.where, "robot is missing", "name a robot, or a job that has one");
  if (!request.dresspack.empty()) draft.document["dresspack"] = named(request.dresspack);
  if (!request.motion.empty()) draft.document["motion"] = named(request.motion);
  Node whole = draft.document;
  for (const std::string& set : request.sets) apply_set(whole, set);
  draft.document = whole;
  const Robot robot = robot_of(whole);
  draft.exercise = !whole.find("motion");
  if (draft.exercise) whole["motion"] = standing(robot);
  const Node* const given = whole.find("routing");
  if (given && given->kind != Node::Kind::null) check_given(*given);
  Node routing = links_only(request, robot, given);
  whole["routing"] = std::move(routing);
  draft.job = job_from(std::move(whole));
  return draft;
}

void fill_tool_space(Draft& draft) {
  if (draft.exercise || draft.job.motion.is_prescribed()) return;
  const PassingFile described("job.yaml"), written("duration.yaml");
  write_text_if_changed(described.path(), with_mark(job_text(draft.job), Mark::yaml), Sync::never);
  if (run_stage_program("dresslife-sim",
                        {described.path().string(), "--duration", "-o", written.path().string(), "--quiet"},
                        StageWords::dropped) != 0)
    return;  // the search states the reason
  const Node found = read_yaml(written.path());
  const Node* const space = found.find("tool_space");
  if (!space) return;
  draft.tool_space = space->entries.front();
  Node whole = read_yaml(described.path());
  set_value(whole, draft.tool_space->key, draft.tool_space->value, draft.tool_space->where);
  draft.job.robot = job_from(std::move(whole)).robot;
}

std::string tool_space_words(const Draft& draft) {
  if (!draft.tool_space) return "";
  return fmt::format(
      "ESTIMATE: the shape of the tool, {}: {}. The hose keeps clear of it. Replace it by the shape of your tool.",
      draft.tool_space->key, set_text(draft.tool_space->value));
}

namespace {

/// Writes a named robot and the lines that change it as the job has them, instead of the whole robot. Returns whether that is
/// possible: the robot is the same, and its files have the same meaning in the folder.
bool keep_robot_lines(const Draft& draft, const std::optional<fs::path>& folder, Node& document) {
  Node named;
  named.entries = draft.robot_lines, named.kind = Node::Kind::map, named.where = document.where;
  const Node* const robot = named.find("robot");
  if (named.entries.size() < 2 || !robot || !folder) return false;
  const auto means_the_same = [&](const Entry& line) { return counts_from(line.value, *folder); };
  if (!std::ranges::all_of(named.entries, means_the_same)) return false;
  Node whole = named;
  apply_lines(whole);
  if (to_yaml(*whole.find("robot")) != to_yaml(*document.find("robot"))) return false;
  for (const Entry& line : named.entries) document[line.key] = line.value;
  return true;
}

}  // namespace

Node routed(const Draft& draft, const std::string& routing, const std::string& motion, double factor,
            const std::optional<fs::path>& folder) {
  Node document = draft.document;
  const Node resolved = parse_yaml(job_text(draft.job), std::string(command_line));
  const auto replace = [&](const char* shelf, const char* key) {
    const Node& entry = *document.find(key);
    if (is_shipped(shelf, entry)) return;
    const Node named = reference(entry, folder);
    document[key] = named.kind != Node::Kind::null ? named : *resolved.find(key);
  };
  if (!keep_robot_lines(draft, folder, document)) replace("robots", "robot");
  if (draft.exercise)
    document["motion"] = parse_yaml(motion, std::string(command_line));
  else
    replace("programs", "motion");
  if (factor != 1)
    document["dresspack"] = echo_fields(scaled(draft.job.dresspacks.front().dresspack, factor));
  else
    replace("dresspacks", "dresspack");
  if (document.find("cell")) replace("cells", "cell");
  if (Node* const of = document.find("calibration"); of && of->is_scalar() && folder && !counts_from(*of, *folder))
    *of = file_from(*of, *folder);
  Node found = parse_yaml(routing, std::string(command_line));
  keep_settings(found, document.find("routing"));
  document["routing"] = std::move(found);
  if (draft.tool_space) document[draft.tool_space->key] = draft.tool_space->value;
  return document;
}

}  // namespace dresslife::pipeline
