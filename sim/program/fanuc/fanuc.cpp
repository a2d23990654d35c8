#include "sim/program/fanuc/fanuc.h"

#include "sim/program/fanuc/backup.h"
#include "sim/program/fanuc/run.h"
#include "sim/program/interpreter/tokens.h"

namespace dresslife::sim {
namespace {

bool is_variables(const SourceFile& file) { return lower_case(file.name()).ends_with(".va"); }

/// Reports listings of different text with the same program name. A controller cannot hold both.
void check_names(const std::deque<SourceFile>& files, const std::vector<FanucListing>& listings, Problems& problems) {
  std::map<std::string, const FanucListing*> known;
  for (const FanucListing& listing : listings) {
    const auto [first, added] = known.try_emplace(listing.name, &listing);
    if (added || listing.name.empty() || files[first->second->file].text() == files[listing.file].text()) continue;
    problems.add({files[listing.file].name(), 1, 1},
                 fmt::format("is the program '{}', as {} is", listing.name, files[first->second->file].name()),
                 "give only one of them");
  }
}

}  // namespace

void read_fanuc(const std::deque<SourceFile>& files, const ImportOptions& options, const std::vector<NamedFrame>& tools,
                const std::vector<NamedFrame>& work_objects, Program& program, Problems& problems) {
  std::vector<FanucListing> listings;
  std::vector<Problems> parsing(files.size());
  FanucVariables variables;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (is_variables(files[i]))
      read_fanuc_variables(files[i], variables);
    else
      listings.push_back(parse_fanuc(files[i], static_cast<int>(i), program, parsing[i]));
  }
  if (listings.empty())
    return problems.add({files[0].name(), 1, 1}, "holds variables, no program", "give the listing (.ls), too");
  check_names(files, listings, problems);
  const std::size_t open = std::min(options.routine.find('('), options.routine.size());
  const std::string name = lower_case(options.routine.substr(0, open));
  const std::string arguments = options.routine.substr(open);
  const FanucListing* start = name.empty() ? &listings[0] : nullptr;
  for (const FanucListing& listing : listings)
    if (!name.empty() && listing.name == name) start = &listing;
  if (!start)
    return problems.add({files[0].name(), 1, 1}, fmt::format("is not the program '{}'", name),
                        "give the listing of that program");
  if (!problems.empty()) return;
  explore(
      [&](Exploration& exploration, Program& made, Problems& found) {
        FanucRun({files, listings, parsing, variables, options, tools, work_objects}, made, found, exploration)
            .run(*start, arguments);
      },
      program, problems);
}

}  // namespace dresslife::sim
