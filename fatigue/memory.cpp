#include "fatigue/memory.h"

#include <fmt/format.h>

#include <algorithm>

#include "fatigue/strain_file.h"
#include "pipeline/files/files.h"

namespace dresslife::fatigue {
namespace {

/// Returns the largest number of turning points of one site, because a site is read as a whole.
double longest_site(const pipeline::FileReader& file, const std::string& group) {
  std::vector<std::uint64_t> offset;
  const std::string dataset = group + "/reversal/offset";
  std::uint64_t longest = 0;
  in_blocks(file.rows(dataset), [&](std::size_t first, std::size_t count) {
    const std::size_t before = first > 0 ? 1 : 0;
    file.read_rows(dataset, first - before, count + before, offset);
    for (std::size_t k = 1; k < offset.size(); ++k)
      if (offset[k] > offset[k - 1]) longest = std::max(longest, offset[k] - offset[k - 1]);
  });
  return static_cast<double>(longest);
}

}  // namespace

pipeline::MemoryNeed memory_of(const pipeline::FileReader& strain, std::size_t threads) {
  constexpr double program = 20 << 20;  // program, libraries, a job and the tables of its materials
  // Segment, offset and two indices of texts; damage, range and kind of each site; its life as written to the file.
  constexpr double of_a_site = 4 + 8 + 2 * 4 + 3 * 8 + 8;
  constexpr double of_a_bound_site = 4 + 8 + 2 * 4 + 2 * 8;
  constexpr double of_a_turn = 2 * sizeof(float);                                 // a block, and the next one
  constexpr double of_a_listed_turn = 2 * sizeof(Reversal) + 4 * sizeof(double);  // of one site with exact stress
  const std::string bytes_of_sites = "fewer simulation.segments or strain.surface_fibres";
  const std::string sampling = "a lower simulation.sample_rate_Hz, or split the motion";
  const auto rows = [&](const char* dataset) {
    return strain.has(dataset) ? static_cast<double>(strain.rows(dataset)) : 0.0;
  };
  const double sites = rows("/site/segment");
  const double bound = std::max(rows("/bound_stick/site/segment"), rows("/bound_free/site/segment"));
  double longest = 0, block = 0;
  for (const char* group : {"", "/bound_stick", "/bound_free"}) {
    const double of_group = longest_site(strain, group);
    longest = std::max(longest, of_group);
    block = std::max(block, std::min(rows((std::string(group) + "/reversal/strain").c_str()),
                                     static_cast<double>(SiteSet::block_reversals) + of_group));
  }
  pipeline::MemoryNeed need;
  need.add(program, "the program");
  need.add(of_a_site * sites + of_a_bound_site * bound, fmt::format("{:.0f} sites", sites + bound), bytes_of_sites);
  need.add(of_a_turn * block + of_a_listed_turn * longest * static_cast<double>(threads),
           "turning points being counted", sampling);
  const std::size_t samples = strain.rows("/time");
  const double joints =
      strain.has("/robot/joint_position") ? static_cast<double>(strain.row_size("/robot/joint_position")) : 0;
  // Per cable: three strains, both as read and separated; its force in memory and as written to the file.
  constexpr double of_a_cable = 2 * 3 + 2;
  constexpr double histories = 8;  // times, steps, damage by opening and closing, the worst wire's strain
  need.add(static_cast<double>(samples) * (histories + 2 * joints + of_a_cable * rows("/cable/span")) * sizeof(double),
           fmt::format("histories of {} samples", samples), sampling);
  // Tables of sites are copied and checked in blocks of text and numbers.
  constexpr double table_block = (1 << 15) * 300.0;
  need.add(std::min(table_block, sites * 300), "tables of sites");
  const std::map<std::string, std::size_t> axes{{"sample", samples},
                                                {"segment", strain.rows("/segment/length")},
                                                {"site", static_cast<std::size_t>(sites)},
                                                {"level", 4},
                                                {"cable", static_cast<std::size_t>(rows("/cable/span"))},
                                                {"cable_span", 1},
                                                {"probe", 1}};
  need.add(pipeline::file_buffers(pipeline::life_format(), axes) +
               pipeline::file_buffers(pipeline::strain_format(), axes) / 2,
           "what is being read and written");
  return need;
}

}  // namespace dresslife::fatigue
