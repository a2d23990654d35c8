#include "sim/program/fanuc/backup.h"

#include <algorithm>
#include <array>
#include <set>

#include "pipeline/base/joined.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/settings/document.h"
#include "sim/program/interpreter/encoding.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

namespace fs = std::filesystem;

/// Returns the trimmed text between the first and the last ' of `text`; empty: no pair.
std::string quoted(std::string_view text) {
  const std::size_t begin = text.find('\''), end = text.rfind('\'');
  return begin == std::string_view::npos || end <= begin
             ? ""
             : std::string(trimmed(text.substr(begin + 1, end - begin - 1)));
}

class VariableFile {
 public:
  VariableFile(const SourceFile& file, FanucVariables& into) : text_(file.text()), into_(into) {}

  void run() {
    while (!text_.empty()) {
      const std::size_t end = std::min(text_.find('\n'), text_.size());
      line(trimmed(text_.substr(0, end)));
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
  }

 private:
  void line(std::string_view line) {
    if (line.starts_with("[")) {
      if (const std::size_t close = line.find(']'); close + 1 < line.size() && line[close + 1] != ' ')
        return begin(line.substr(close + 1, line.find(' ', close) - close - 1), line);
      element(line);
    } else if (variable_ == "$MACROTABLE") {
      macro(line);
    } else if (position_) {
      coordinates(line);
    }
  }

  /// Begins a variable: [*NUMREG*]$NUMREG  Storage: ...
  void begin(std::string_view name, std::string_view line) {
    variable_ = upper_case(name);
    position_ = nullptr;
    if (name == "$OFFSET_CART") into_.offsets_are_frames = line.ends_with("TRUE");
  }

  /// Reads an element: [5] = 3  'name', or [1,7] = 'name' with a position on the following lines.
  void element(std::string_view line) {
    FanucCursor at(line);
    at.take_sign('[');
    const auto first = at.number();
    const auto second = at.take_sign(',') ? at.number() : std::nullopt;
    position_ = nullptr;
    if (!first || !at.take_sign(']') || !at.take_sign('=')) return;
    const int number = static_cast<int>(std::clamp(second.value_or(*first), 0.0, 1e6));
    if (!second) {
      const auto value = at.number();
      if (!value) return;
      if (variable_ == "$NUMREG") into_.registers[number] = *value;
      if (variable_ == "$MNUFRAMENUM" && number == 1) into_.frame_number = static_cast<int>(*value);
      if (variable_ == "$MNUTOOLNUM" && number == 1) into_.tool_number = static_cast<int>(*value);
      return;
    }
    if (*first != 1) return;  // another group
    std::map<int, FanucPosition>* list = variable_ == "$POSREG"     ? &into_.position_registers
                                         : variable_ == "$MNUFRAME" ? &into_.frames
                                         : variable_ == "$MNUTOOL"  ? &into_.tools
                                                                    : nullptr;
    if (!list || list->size() >= ImportLimits::values) return;
    FanucPosition made;
    made.frame = made.tool = -1;
    position_ = &((*list)[number] = made);
    const std::size_t name = line.rfind('\'');
    if (line.find("Uninitialized", name < line.size() ? name : 0) != std::string_view::npos) {
      position_->form = FanucPosition::Form::pose;  // the form if a program assigns components
      position_->values.assign(6, NAN);
      position_ = nullptr;
    }
  }

  /// Reads "X: 1.0 Y: ...", "J1 = 1.0 deg J2 = ...", "Group: 1 Config: N U T, 0, 0, 0" or "EXT1: 0.0 mm".
  void coordinates(std::string_view line) {
    if (const std::size_t config = line.find("Config:"); config != std::string_view::npos) {
      position_->configuration = fanuc_configuration(trimmed(line.substr(config + 7))).value_or(ArmConfiguration{});
      return;
    }
    FanucCursor at(line);
    while (!at.at_end()) {
      const std::string name = at.word();
      if (name.empty()) {
        at.move_to(at.offset() + 1);
        continue;
      }
      if (!at.take_sign(':') && !at.take_sign('=')) continue;
      set(name, at.number().value_or(NAN));
    }
  }

  void set(const std::string& name, double value) {
    constexpr std::string_view names = "xyzwpr";
    FanucPosition& p = *position_;
    const bool joint = name.size() == 2 && name[0] == 'j' && name[1] >= '1' && name[1] <= '9';
    const std::size_t which = joint              ? static_cast<std::size_t>(name[1] - '1')
                              : name.size() == 1 ? names.find(name[0])
                                                 : std::string_view::npos;
    if (name.starts_with("ext") && p.external_axes.size() < 12) return p.external_axes.push_back(value);
    if (which == std::string_view::npos) return;
    p.form = joint ? FanucPosition::Form::joints : FanucPosition::Form::pose;
    if (p.values.size() <= which) p.values.resize(joint ? which + 1 : 6, NAN);
    p.values[which] = value;
  }

  /// Reads a field: $MACROTABLE[5].$MACRO_NAME Access: RO: STRING[37] = 'MOVE TO HOME'
  void macro(std::string_view line) {
    if (line.find("$MACRO_NAME") != std::string_view::npos) macro_ = lower_case(quoted(line));
    if (line.find("$PROG_NAME") == std::string_view::npos || macro_.empty()) return;
    if (std::string program = lower_case(quoted(line)); !program.empty()) into_.macros[macro_] = program;
  }

  std::string_view text_;
  FanucVariables& into_;
  std::string variable_;               // its name in capitals
  FanucPosition* position_ = nullptr;  // the position of the current element; null: none
  std::string macro_;
};

// ---- folders ---------------------------------------------------------------------------------------------

constexpr std::array variable_files{"numreg.va", "posreg.va", "sysframe.va", "framevar.va", "sysmacro.va", "system.va"};

bool is_listing(const fs::path& file) { return lower_case(file.extension().string()) == ".ls"; }
bool is_variable_file(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  return std::ranges::find(variable_files, name) != variable_files.end();
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files = pipeline::entries_of(folder);
  std::erase_if(files, [](const fs::path& file) { return pipeline::kind_of(file) != pipeline::FileKind::file; });
  return files;
}

/// Returns the variable files of a folder of listings. If it has none, returns those of its parent folder, because a
/// backup in two languages has its listings in two folders.
std::vector<fs::path> variables_of(const fs::path& folder) {
  for (const fs::path& place : {folder, fs::absolute(folder).lexically_normal() / ".."}) {
    std::vector<fs::path> files = files_in(place);
    std::erase_if(files, [](const fs::path& file) { return !is_variable_file(file); });
    if (!files.empty()) return files;
  }
  return {};
}

std::string text_of(const fs::path& file) {
  const pipeline::PlainFile source(file);
  return source.size() > ImportLimits::file_bytes ? "" : decoded_text(source.text());
}

/// Finds the programs that a listing calls (CALL, RUN, macros) without running it.
Calls calls_of_listing(const fs::path& file, const std::map<std::string, std::string>& macros) {
  Calls made;
  const SourceFile source(file.string(), text_of(file));
  if (source.text().find("/PROG") == std::string::npos) return made;  // a log, not a program
  Program ignored;
  Problems unread;
  const FanucListing listing = parse_fanuc(source, 0, ignored, unread);
  made.name = listing.name;
  for (const FanucStatement& s : listing.statements) {
    FanucCursor at(s.text);
    const std::string first = at.word();
    const bool position = at.take("P") || at.take("PR");
    made.moves |= position && (first == "j" || first == "l" || first == "c" || first == "a" || first == "s");
    const std::string text = lower_case(s.text);
    for (const std::string call : {"call ", "run "})
      for (std::size_t found = text.find(call); found != std::string::npos; found = text.find(call, found + 1)) {
        FanucCursor named(std::string_view(text).substr(found + call.size()));
        made.names.insert(std::string(named.name()));
      }
    const std::size_t arguments = std::min(text.find('('), text.size());
    if (const auto macro = macros.find(std::string(trimmed(std::string_view(text).substr(0, arguments))));
        macro != macros.end())
      made.names.insert(macro->second);
  }
  return made;
}

}  // namespace

void read_fanuc_variables(const SourceFile& file, FanucVariables& into) { VariableFile(file, into).run(); }

std::vector<fs::path> fanuc_files_beside(const fs::path& listing) {
  std::vector<fs::path> made;
  FanucVariables variables;
  std::map<std::string, fs::path> beside;  // stem in lower case -> listing
  const fs::path folder = listing.has_parent_path() ? listing.parent_path() : fs::path(".");
  for (const fs::path& file : files_in(folder))
    if (is_listing(file)) beside.try_emplace(lower_case(file.stem().string()), file);
  for (const fs::path& file : variables_of(folder)) {
    made.push_back(file);
    read_fanuc_variables(SourceFile(file.string(), text_of(file)), variables);
  }
  std::set<std::string> known{lower_case(listing.stem().string())};
  std::vector<fs::path> open{listing};
  while (!open.empty()) {
    const Calls outline = calls_of_listing(open.back(), variables.macros);
    open.pop_back();
    for (const std::string& word : outline.names)
      if (const auto found = beside.find(word); found != beside.end() && known.insert(word).second) {
        made.push_back(found->second);
        open.push_back(found->second);
      }
  }
  return made;
}

FanucFolder fanuc_folder(const fs::path& folder) {
  FanucFolder made;
  FanucVariables variables;
  std::vector<fs::path> listings;
  for (const fs::path& file : files_in(folder))
    if (is_listing(file)) listings.push_back(file);
  for (const fs::path& file : variables_of(folder)) {
    made.variables.push_back(file);
    read_fanuc_variables(SourceFile(file.string(), text_of(file)), variables);
  }
  for (const fs::path& file : listings)
    if (Calls calls = calls_of_listing(file, variables.macros); !calls.name.empty()) {
      made.listings.push_back(file);
      made.calls[calls.name] = std::move(calls);
    }
  return made;
}

namespace {

/// Returns the folder of the listings: `folder`, or the only subfolder with listings. Throws InputError otherwise.
fs::path folder_of_listings(const fs::path& folder, const std::vector<fs::path>& files) {
  std::vector<std::string> within;
  for (const fs::path& file : files) {
    if (!is_listing(file) || text_of(file).find("/PROG") == std::string::npos) continue;
    if (pipeline::inode_of(file.parent_path()) == pipeline::inode_of(folder)) return folder;
    const std::string place = file.parent_path().string();
    if (std::ranges::find(within, place) == within.end()) within.push_back(place);
  }
  if (within.size() == 1) return within[0];
  if (within.size() > 12) within.resize(12);
  throw pipeline::InputError({folder.string()},
                             within.empty() ? "holds no Fanuc program (.ls with /PROG)"
                                            : fmt::format("holds programs of several robots or languages in {}",
                                                          pipeline::joined(within, ", ")),
                             within.empty() ? "list the programs on the controller (.ls); .tp files are not read"
                                            : "name one of these folders");
}

}  // namespace

Backup fanuc_backup(const fs::path& folder, const std::vector<fs::path>& files, const std::string& routine) {
  const FanucFolder found = fanuc_folder(folder_of_listings(folder, files));
  Backup backup{Language::fanuc, found.listings, routine};
  if (routine.empty()) backup.routine = only_start(folder, uncalled_programs(found.calls), "program");
  const std::string start = lower_case(backup.routine.substr(0, backup.routine.find('(')));
  backup.files.insert(backup.files.end(), found.variables.begin(), found.variables.end());
  for (const fs::path& file : found.listings)
    if (lower_case(file.stem().string()) == start) put_first(file, backup);
  return backup;
}

}  // namespace dresslife::sim
