#include "pipeline/resolve/catalogue.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "pipeline/base/installation.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "pipeline/resolve/beds.h"
#include "pipeline/resolve/cable_alone.h"
#include "pipeline/resolve/data_sheet.h"
#include "pipeline/resolve/document_kind.h"
#include "pipeline/resolve/estimates.h"
#include "pipeline/resolve/placement.h"
#include "pipeline/resolve/sources.h"
#include "pipeline/resolve/urdf_request.h"
#include "pipeline/settings/fields.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {

namespace {

namespace fs = std::filesystem;

struct Shelf {
  const char* key;     ///< of the job
  const char* folder;  ///< of the catalogue
  DocumentKind kind;   ///< of its entries
};
constexpr Shelf shelves[] = {{"robot", "robots", DocumentKind::robot},
                             {"motion", "programs", DocumentKind::motion},
                             {"dresspack", "dresspacks", DocumentKind::dresspack}};

/// Returns the folders beside the naming file and beside the job, and their parent folders.
std::vector<fs::path> folders_beside(const std::string& folder, const Where& named_at, const Where& job) {
  std::vector<fs::path> folders;
  std::error_code failure;
  for (const Where& origin : {named_at, job}) {
    fs::path here = fs::absolute(folder_of(origin) / "any", failure).lexically_normal().parent_path();
    for (; !here.empty(); here = here.parent_path()) {
      for (const fs::path& candidate : {here / folder, here / "config" / folder})
        if (is_folder(candidate)) folders.push_back(candidate);
      if (here == here.root_path()) break;
    }
  }
  return folders;
}

void merge(Node& base, const Node& over) {
  if (!base.is_map() || !over.is_map()) {
    base = over;
    return;
  }
  base.where = over.where;
  for (const Entry& entry : over.entries) {
    if (Node* found = base.find(entry.key))
      merge(*found, entry.value);
    else
      base.entries.push_back(entry);
  }
}

/// Merges items of equal `name` and adds the others.
void merge_by_name(Node& base, const Node& over) {
  if (!base.is_list() || !over.is_list()) return merge(base, over);
  const auto name = [](const Node& item) {
    const Node* found = item.find("name");
    return found ? found->text : std::string();
  };
  for (const Node& item : over.items) {
    const auto same = std::ranges::find_if(
        base.items, [&](const Node& known) { return !name(item).empty() && name(known) == name(item); });
    if (same != base.items.end())
      merge(*same, item);
    else
      base.items.push_back(item);
  }
}

/// Returns whether a key of a robot's entry belongs to its URDF.
bool is_of_urdf(std::string_view key) {
  constexpr std::array<std::string_view, 5> keys{"urdf", "tip", "package_folder", "collision",
                                                 "accelerations_deg_per_s2"};
  return std::ranges::find(keys, key) != keys.end();
}

/// Checks that a URDF's robot gets its accelerations, which no URDF has. Without this check the lines of the URDF would be
/// reported as incomplete.
void check_accelerations(const Node& robot, const UrdfRequest& request, const Where& asked) {
  std::vector<std::string> without;
  std::size_t driven = 0;
  const Node* joints = robot.find("joints");
  for (const Node& joint : joints ? joints->items : std::vector<Node>{}) {
    if (!joint.is_map() || joint.find("follows")) continue;
    ++driven;
    const Node* name = joint.find("name");
    if (!joint.find("acceleration_deg_per_s2")) without.push_back(name ? name->text : "?");
  }
  if (request.accelerations.size() > driven)
    throw InputError(request.accelerations_where,
                     fmt::format("accelerations_deg_per_s2 has {} numbers (the robot of {} has {} axes)",
                                 request.accelerations.size(), request.urdf.string(), driven),
                     fmt::format("give {} numbers in the order of the axes", driven));
  if (without.empty()) return;
  throw InputError(
      asked,
      fmt::format("{} has no accelerations of {} (a URDF cannot hold any)", request.urdf.string(),
                  fmt::join(without, ", ")),
      fmt::format(
          "give accelerations_deg_per_s2 beside 'urdf', {} numbers in the order of the axes (those of config/robots have {})",
          driven, shipped_accelerations));
}

/// Reads `urdf: FILE` with the keys that belong to it. All other keys of the entry replace those of the robot.
void read_urdf(Node& entry) {
  Node about = entry, over = entry;
  const auto is_about = [](const Entry& e) { return is_of_urdf(e.key); };
  std::erase_if(about.entries, [&](const Entry& e) { return !is_about(e); });
  std::erase_if(over.entries, is_about);
  UrdfRequest request;
  read_fields(about, request);
  if (const fs::path shown = fs::proximate(request.urdf); !shown.empty()) request.urdf = shown;
  Node robot = robot_from_urdf(request);
  for (const Entry& e : over.entries) {
    Node& known = robot[e.key];
    if (e.key == "joints" || e.key == "links" || e.key == "external_axes")
      merge_by_name(known, e.value);
    else
      known = e.value;
  }
  check_accelerations(robot, request, entry.where);
  entry = std::move(robot);
}

/// Returns whether a file is a program in a robot's language, or a table of joint angles.
bool is_program_file(const fs::path& file) {
  const std::string end = lower_case(file.extension().string());
  static const std::set<std::string> ends{".mod", ".modx", ".prg",    ".pgf",      ".src",
                                          ".ls",  ".jbi",  ".script", ".urscript", ".csv"};
  return ends.contains(end) && is_file(file);
}

void resolve(Node& entry, const std::string& folder, const Where& job, int depth = 0);

constexpr const char* lay_factor = "estimated_lay_factor";

/// Reads `cable: ...` of a dresspack (cable_alone.h). The other keys of the entry replace those of the result.
void read_cable(Node& entry, const Where& job, int depth) {
  const Node cable = *entry.find("cable");
  const Node* from = cable.is_scalar() ? &cable : cable.find("from");
  const Node* const factor = entry.find(lay_factor);
  Node alone;
  if (from) {
    const Node* part = cable.find("part");
    for (const Entry& other : cable.entries)
      if (other.key != "from" && other.key != "part")
        throw InputError(other.where, fmt::format("unknown key 'dresspack.cable.{}' beside from", other.key),
                         "give from and part, or the cable itself without from");
    Node dresspack = catalogue_entry("dresspacks", from->text, from->where, job);
    resolve(dresspack, "dresspacks", job, depth + 1);
    if (factor) dresspack[lay_factor] = *factor;
    alone = cable_alone(dresspack, part ? part->text : std::string(), part ? part->where : cable.where);
  } else if (cable.is_map()) {
    Node with_factor = cable;
    if (factor) with_factor[lay_factor] = *factor;
    alone = cable_alone(with_factor);
  } else {
    throw InputError(cable.where, "dresspack.cable is neither a name nor a map",
                     "name a dresspack, or give name, radius_mm and components of the cable");
  }
  Node over = entry;
  std::erase_if(over.entries, [](const Entry& e) { return e.key == "cable"; });
  const Where where = entry.where;
  merge(alone, over);
  alone.where = where;
  entry = std::move(alone);
}

void resolve(Node& entry, const std::string& folder, const Where& job, int depth) {
  if (depth > 16) throw InputError(entry.where, "'from' goes in a circle", "let one entry stand alone");
  if (entry.is_scalar()) {
    entry = catalogue_entry(folder, entry.text, entry.where, job);
    for (const Shelf& shelf : shelves)
      if (folder == shelf.folder) refuse_other_kind(entry, shelf.kind);
    resolve(entry, folder, job, depth + 1);
    return;
  }
  const Node* from = entry.is_map() ? entry.find("from") : nullptr;
  if (const Node* sheet = entry.is_map() && folder == "dresspacks" ? entry.find("data_sheet") : nullptr)
    throw InputError(
        sheet->where, "data_sheet describes a cable, and stands among the keys of a hose",
        "write 'cable: {name: NAME, data_sheet: TEXT}' for the cable alone, or give components with this key");
  if (!from && entry.is_map() && entry.find("cable") && folder == "dresspacks") return read_cable(entry, job, depth);
  if (!from && entry.is_map() && entry.find("urdf") && folder == "robots") return read_urdf(entry);
  if (!from) return;
  Node base = catalogue_entry(folder, from->text, from->where, job);
  if (const Node* const factor = entry.find(lay_factor); factor && base.is_map()) base[lay_factor] = *factor;
  Node over = entry;
  std::erase_if(over.entries, [&](const Entry& e) {
    const bool of_urdf = folder == "robots" && is_of_urdf(e.key) && base.is_map();
    if (of_urdf) base[e.key] = e.value;
    return of_urdf || e.key == "from";
  });
  resolve(base, folder, job, depth + 1);
  merge(base, over);
  entry = std::move(base);
}

/// Returns the catalogue folder of a key path: "dresspack", "dresspacks.2.dresspack"; null: the path is no catalogue entry.
const char* shelf_of(std::string_view path) {
  constexpr std::string_view list = "dresspacks.";
  if (path.starts_with(list)) {
    const std::size_t item = path.find('.', list.size());
    if (item == std::string_view::npos) return nullptr;
    path = path.substr(item + 1);
    if (path != "dresspack") return nullptr;
  }
  for (const Shelf& shelf : shelves)
    if (path == shelf.key) return shelf.folder;
  return nullptr;
}

void collect_materials(const Node& components, std::vector<const Node*>& names) {
  for (const Node& component : components.items) {
    if (const Node* name = component.find("material")) names.push_back(name);
    if (const Node* inner = component.find("components")) collect_materials(*inner, names);
    if (const Node* jacket = component.find("jacket"))
      if (const Node* name = jacket->find("material")) names.push_back(name);
  }
}

/// Returns the catalogue's material of this name. One entry may contain several materials.
Node material_entry(const Node& name, const Node& job) {
  Node material = catalogue_entry("materials", name.text, name.where, job.where);
  resolve(material, "materials", job.where);
  const Node* own_name = material.find("name");
  if (!own_name || own_name->text != name.text)
    throw InputError(material.where, fmt::format("the material is not named '{}' as its file is", name.text),
                     fmt::format("write 'name: {}'", name.text));
  return material;
}

void add_materials(Node& dresspack, const Node& job, const std::string& path, Problems& problems) {
  std::vector<const Node*> names;
  if (const Node* components = dresspack.find("components")) collect_materials(*components, names);
  if (const Node* hose = dresspack.find("hose_material")) names.push_back(hose);
  if (const Node* sleeve = dresspack.find("sleeve"))
    if (const Node* material = sleeve->find("material")) names.push_back(material);
  if (const Node* fatigue = job.find("fatigue"))
    if (const Node* material = fatigue->find("material")) names.push_back(material);
  std::vector<Node> wanted;
  for (const Node* name : names) wanted.push_back(*name);  // copies, because the tree changes below

  Node& materials = dresspack["materials"];
  if (materials.kind == Node::Kind::null) materials.kind = Node::Kind::list;
  std::set<std::string> unknown;  // each is reported at its first place
  for (const Node& name : wanted) {
    const bool there = std::ranges::any_of(materials.items, [&](const Node& material) {
      const Node* known = material.find("name");
      return known && known->text == name.text;
    });
    if (there || !name.is_scalar() || unknown.contains(name.text)) continue;
    const bool found = problems.attempt(path + ".materials", name.where,
                                        [&] { materials.items.push_back(material_entry(name, job)); });
    if (!found) unknown.insert(name.text);
  }
  if (materials.items.empty()) std::erase_if(dresspack.entries, [](const Entry& e) { return e.key == "materials"; });
}

/// Resolves a catalogue entry of a job. For a dresspack, also expands data sheets of cables and adds the materials of its wires.
void resolve_entry(Node* entry, const std::string& path, const std::string& folder, const Node& job,
                   Problems& problems) {
  if (!entry || !problems.attempt(path, entry->where, [&] { resolve(*entry, folder, job.where); })) return;
  if (folder != "dresspacks" || !entry->is_map()) return;
  expand_data_sheets(*entry, path, problems);
  expand_places(*entry, path, problems);
  add_estimates(*entry, job.find("robot"));
  add_beds(*entry, job);
  add_materials(*entry, job, path, problems);
}

/// Returns the items of a list for a word of a key path, which counts from 1: one, or the parts that `place: auto` made of one entry;
/// empty: there is none.
template <class List>
auto items_of(List& list, const std::string& word) {
  std::vector<decltype(&list.items.front())> found;
  for (std::size_t k = 0; k < list.items.size(); ++k) {
    const Node* const entry = list.items[k].is_map() ? list.items[k].find("entry") : nullptr;
    if (word == (entry ? entry->text : std::to_string(k + 1))) found.push_back(&list.items[k]);  // not 01: one spelling
  }
  return found;
}

/// Returns the word of a key path at `begin` and moves `begin` to the next word, or beyond the end of the path after the last
/// one.
std::string next_word(const std::string& path, std::size_t& begin) {
  const std::size_t dot = std::min(path.find('.', begin), path.size());
  std::string word = path.substr(begin, dot - begin);
  begin = dot + 1;
  return word;
}

/// Adds the nodes of a word of a key path in a node.
void step_into(Node& node, const std::string& word, const Where& where, const std::string& path,
               std::vector<Node*>& found) {
  if (node.is_list()) {
    const auto items = items_of(node, word);
    if (items.empty())
      throw InputError(where, fmt::format("'{}' of {} is not an item of the list", word, path),
                       fmt::format("items count from 1 to {}", node.items.size()));
    found.insert(found.end(), items.begin(), items.end());
    return;
  }
  if (node.is_scalar())
    throw InputError(where, fmt::format("'{}' of {} lies inside a single value", word, path), "shorten the path");
  if (Node* known = node.find(word)) return found.push_back(known);
  Node& added = node[word];
  node.entries.back().where = added.where = where;
  found.push_back(&added);
}

}  // namespace

std::string nearest_entry(const std::string& name, const std::vector<std::string>& entries) {
  const auto bare = [](const std::string& text) {
    std::string letters;
    for (const unsigned char c : text)
      if (std::isalnum(c)) letters += static_cast<char>(std::tolower(c));
    return letters;
  };
  const std::string wanted = bare(name);
  constexpr std::size_t telling = 4;  // shorter pieces occur in many names
  for (const std::string& entry : entries)
    if (wanted.size() >= telling && bare(entry).find(wanted) != std::string::npos) return entry;
  return nearest_word(name, entries);
}

Node catalogue_entry(const std::string& folder, const std::string& name, const Where& named_at, const Where& job) {
  if (name.ends_with(".urdf") && folder != "robots")
    throw InputError(named_at, fmt::format("'{}' is a robot description (URDF)", name),
                     "write it after 'robot:', robot: {urdf: FILE}");
  if (folder != "programs" && is_program_file(folder_of(named_at) / name))
    throw InputError(named_at, fmt::format("'{}' is a robot program or a table", name),
                     "write a program after 'motion:'");
  if (name.ends_with(".urdf")) {  // without other keys: the entry is the file itself
    Node entry;
    entry["urdf"] = scalar(name);
    place_at(entry, named_at);
    return entry;
  }
  if (folder == "programs" && is_program_file(folder_of(named_at) / name)) {  // the entry is the file itself
    Node entry;
    entry["program"] = scalar(name);
    place_at(entry, named_at);
    return entry;
  }
  const fs::path beside = (folder_of(named_at) / name).lexically_normal();
  const bool is_path = name.ends_with(".yaml") || name.find('/') != std::string::npos;
  std::error_code failure;
  if (is_path && fs::status(beside, failure).type() != fs::file_type::not_found) return read_document(beside);
  if (is_path)
    throw InputError(named_at, fmt::format("there is no file '{}'", beside.string()),
                     "check the path; it counts from the folder of the file that names it");
  std::vector<std::string> names;
  std::string program;  // with this name, in a robot's language
  const auto found_in = [&](const fs::path& place) {
    const fs::path file = place / (name + ".yaml");
    if (is_file(file)) return file.lexically_relative(fs::current_path()).empty() ? file : fs::proximate(file);
    for (const fs::path& entry : entries_of(place)) {
      if (entry.extension() == ".yaml") names.push_back(entry.stem().string());
      if (folder == "programs" && program.empty() && entry.stem() == name && is_program_file(entry))
        program = fs::proximate(entry, fs::absolute(folder_of(named_at) / ".")).string();
    }
    return fs::path();
  };
  const auto search = [&] {
    for (const fs::path& place : folders_beside(folder, named_at, job))
      if (fs::path file = found_in(place); !file.empty()) return file;
    return found_in(shipped_catalogue() / folder);
  };
  const std::string wanted =
      fmt::format("{}\n{}\n{}\n{}", folder, name, folder_of(named_at).string(), folder_of(job).string());
  if (const fs::path file = found_once(wanted, search); !file.empty()) return read_document(file);
  const fs::path beside_it = fs::path(beside).concat(".yaml");
  if (is_file(beside_it))
    throw InputError(named_at, fmt::format("'{}' is not in the catalogue (config/{})", name, folder),
                     fmt::format("write '{}.yaml' for the file beside the job", name));
  if (fs::is_directory(beside, failure)) {
    const std::vector<fs::path> inside = entries_of(beside);
    const auto file =
        std::ranges::find(inside, ".yaml", [](const fs::path& entry) { return entry.extension().string(); });
    throw InputError(named_at, fmt::format("'{}' is a folder", name),
                     fmt::format("name a file in it, such as '{}/{}'", name,
                                 file == inside.end() ? "NAME.yaml" : file->filename().string()));
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const std::string near = nearest_entry(name, names);
  const bool may_be_file = folder == "programs" && fs::path(name).has_extension();
  if (may_be_file && kind_of(beside) != FileKind::absent) {
    PlainFile{beside};  // refuses a file that cannot be read
    throw InputError(
        named_at,
        fmt::format("the file '{}' is no robot program by its name ('{}')", beside.string(),
                    beside.extension().string()),
        fmt::format(
            "rename it by its language: RAPID .mod, .modx, .prg or .pgf, KRL .src, Fanuc .ls, INFORM .jbi, URScript "
            ".script, joint angles .csv. For KRL: mv {} {}",
            beside.string(), fs::path(beside).replace_extension(".src").string()));
  }
  if (!program.empty())
    throw InputError(named_at, fmt::format("'{}' is a robot program, and is named by its file", name),
                     fmt::format("write '{}'", program));
  throw InputError(named_at,
                   fmt::format("'{}' is not in the catalogue (config/{}){}", name, folder,
                               may_be_file ? fmt::format(", and there is no file '{}'", beside.string()) : ""),
                   names.empty() ? "write the entry itself or a path to a .yaml file"
                                 : fmt::format("{}one of: {}", near.empty() ? "" : "did you mean '" + near + "'? ",
                                               fmt::join(names, ", ")));
}

void apply_lines(Node& job) {
  std::vector<Entry> lines;
  std::erase_if(job.entries, [&](const Entry& entry) {
    const bool is_line = entry.key.find('.') != std::string::npos;
    if (is_line) lines.push_back(entry);
    return is_line;
  });
  std::ranges::stable_sort(lines, {}, [](const Entry& line) { return std::ranges::count(line.key, '.'); });
  for (const Entry& line : lines) set_value(job, line.key, line.value, line.where);
}

namespace {

/// Prepares an entry for a key that must be known before the entry is resolved.
void open_entry(Node& entry) {
  if (!entry.is_scalar()) return;
  Node named;
  named.where = entry.where;
  named["from"] = entry;
  entry = std::move(named);
}

/// Prepares a dresspack for a factor of its estimated lays, which must be known before `cable` is resolved.
void expect_lay_factor(Node& dresspack, const Where& where) {
  open_entry(dresspack);
  if (const Node* const estimates = dresspack.find("estimates");
      estimates && estimates->text.find("lay_length_mm") != std::string::npos) {
    throw InputError(
        where,
        "estimated_lay_factor comes too late: another key of the dresspack was set before, so its lays are known",
        "write estimated_lay_factor in the dresspack, beside from or cable");
  }
}

}  // namespace

void set_value(Node& job, const std::string& path, Node value, const Where& where) {
  apply_lines(job);
  const bool of_part = path.find("components.") != std::string::npos && !where.file.empty();
  std::vector<Node*> nodes{&job};
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t here = begin;
    const std::string word = next_word(path, begin);
    if (word.empty()) throw InputError(where, "has an empty word in its key path", "write key.path=value");
    // A catalogue entry is resolved as soon as a path leads into it. A cable's data sheets are expanded then.
    const char* const folder = here > 0 ? shelf_of(path.substr(0, here - 1)) : nullptr;
    if (folder && word == lay_factor)
      expect_lay_factor(*nodes.front(), where);
    else if (folder && folder == std::string_view("robots") && is_of_urdf(word))
      open_entry(*nodes.front());
    else if (folder && word != "from" && word != "cable")
      resolve(*nodes.front(), folder, job.where);
    std::vector<Node*> next;
    for (Node* const node : nodes) {
      step_into(*node, word, where, path, next);
      // As in merge(): doubts about a part, such as an overlap, point to the key that changed it, not to its own file.
      if (begin > path.size() && of_part && node->is_map()) node->where = where;
    }
    nodes = std::move(next);
  }
  for (Node* const node : nodes) *node = value;
}

const Node* value_at(const Node& tree, const std::string& path) {
  const Node* node = &tree;
  for (std::size_t begin = 0; node && begin <= path.size();) {
    const std::string word = next_word(path, begin);
    if (node->is_list()) {
      const auto items = items_of(*node, word);
      node = items.empty() ? nullptr : items.front();
    } else {
      node = node->find(word);
    }
  }
  return node;
}

void apply_set(Node& job, const std::string& set) {
  const Where where{"--set " + set};
  const std::size_t equals = set.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(where, "is not key.path=value", "write for example --set simulation.segments=80");
  Node value = parse_yaml(set.substr(equals + 1), where.file);
  place_at(value, where);  // a command line has no line numbers
  set_value(job, set.substr(0, equals), std::move(value), where);
}

void resolve_job(Node& job, Problems& problems) {
  for (const Shelf& shelf : shelves) resolve_entry(job.find(shelf.key), shelf.key, shelf.folder, job, problems);
  Node* list = job.find("dresspacks");
  for (std::size_t i = 0; list && i < list->items.size(); ++i)
    resolve_entry(list->items[i].find("dresspack"), fmt::format("dresspacks[{}].dresspack", i + 1),
                  shelf_of("dresspack"), job, problems);
}

void resolve_job(Node& job) {
  Problems problems;
  resolve_job(job, problems);
  problems.finish(job.where.file);
}

}  // namespace dresslife::pipeline
