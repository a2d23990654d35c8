#include "fatigue/strain_file.h"

#include <algorithm>
#include <unordered_map>

#include "pipeline/job/job.h"

namespace dresslife::fatigue {
namespace {

constexpr std::size_t block_rows = 1 << 15;  // rows of site tables: a few megabytes of text

}  // namespace

void in_blocks(std::size_t rows, const std::function<void(std::size_t, std::size_t)>& copy) {
  for (std::size_t first = 0; first < rows; first += block_rows) copy(first, std::min(block_rows, rows - first));
}

TextColumn read_column(const pipeline::FileReader& file, const std::string& dataset) {
  TextColumn column;
  std::unordered_map<std::string, int> known;
  std::vector<std::string> texts;
  in_blocks(file.rows(dataset), [&](std::size_t first, std::size_t count) {
    file.read_rows(dataset, first, count, texts);
    for (const std::string& text : texts) {
      const auto [entry, fresh] = known.emplace(text, static_cast<int>(column.values.size()));
      if (fresh) column.values.push_back(text);
      column.index.push_back(entry->second);
    }
  });
  return column;
}

SiteSet::SiteSet(const pipeline::FileReader& file, std::string group)
    : file_(file),
      group_(std::move(group)),
      segment_(file.read<std::int32_t>(group_ + "/site/segment")),
      offset_(file.read<std::uint64_t>(group_ + "/reversal/offset")),
      material_(read_column(file, group_ + "/site/material")) {
  check(file.length("segment"));
}

void SiteSet::check(std::size_t segments) const {
  const std::string remedy = "make the file again with dresslife-strain";
  const auto outside = [&](std::int32_t s) { return s < 0 || static_cast<std::size_t>(s) >= segments; };
  if (const auto bad = std::ranges::find_if(segment_, outside); bad != segment_.end()) {
    throw pipeline::InputError(
        file_.where(), fmt::format("{}/site/segment names segment {} (there are {})", group_, *bad, segments), remedy);
  }
  if (offset_.empty() || offset_.front() != 0 || !std::ranges::is_sorted(offset_) ||
      offset_.back() != file_.rows(group_ + "/reversal/strain")) {
    throw pipeline::InputError(
        file_.where(), fmt::format("{}/reversal/offset does not divide the turning points among the sites", group_),
        remedy);
  }
}

std::vector<std::size_t> SiteSet::Block::cuts(std::size_t parts) const {
  std::vector<std::size_t> sites;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::uint64_t from = offset.front() + (offset.back() - offset.front()) * part / parts;
    sites.push_back(begin + (std::ranges::lower_bound(offset, from) - offset.begin()));
  }
  sites.front() = begin;
  sites.push_back(end);
  return sites;
}

void SiteSet::check_materials(const pipeline::Job& job) const {
  const auto describes = [&](const std::string& name) {
    return std::ranges::any_of(job.dresspacks, [&](const auto& mounted) {
      const auto& materials = mounted.dresspack.materials;
      return std::ranges::any_of(materials, [&](const pipeline::Material& material) { return material.name == name; });
    });
  };
  for (const std::string& name : material_.values)
    if (!describes(name))
      throw pipeline::InputError(
          file_.where(), fmt::format("{}/site/material names '{}', which its job does not describe", group_, name),
          "make the file again with dresslife-strain");
}

std::size_t SiteSet::end_of_block(std::size_t begin) const {
  const auto first = offset_.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto after = std::upper_bound(first + 1, offset_.end(), *first + block_reversals);
  return std::max<std::size_t>(after - offset_.begin() - 1, begin + 1);
}

void SiteSet::for_each_block(const Visit& visit) const {
  std::vector<float> strains, next;
  std::size_t begin = 0, end = 0;
  const auto read_ahead = [&] {  // reads the block after `end`
    if (end == size()) return;
    file_.read_rows(group_ + "/reversal/strain", offset_[end], offset_[end_of_block(end)] - offset_[end], next);
  };
  for (read_ahead(); end < size(); begin = end) {
    std::swap(strains, next);
    end = end_of_block(begin);
    visit({begin, end, strains, std::span(offset_).subspan(begin, end - begin + 1)}, read_ahead);
  }
}

void SiteSet::check_alternating(std::size_t site, std::span<const float> strains) const {
  const std::size_t bad = first_going_on(strains, [](float strain) { return strain; });
  if (bad == strains.size()) return;
  throw pipeline::InputError(
      file_.where(),
      fmt::format("{}/reversal/strain continues from {} to {} at turning point {} of site {} (rises and falls "
                  "must alternate to be counted as half_cycles)",
                  group_, strains[bad - 1], strains[bad], bad, site),
      "make the file again with dresslife-strain, or set fatigue.counting to repeating");
}

std::vector<Reversal> SiteSet::reversals_of(std::size_t site) const {
  std::vector<float> strains;
  std::vector<std::uint32_t> samples;
  const std::size_t count = offset_[site + 1] - offset_[site];
  file_.read_rows(group_ + "/reversal/strain", offset_[site], count, strains);
  file_.read_rows(group_ + "/reversal/sample", offset_[site], count, samples);
  std::vector<Reversal> reversals;
  for (std::size_t i = 0; i < count; ++i) {
    if (samples[i] >= file_.length("sample") || (i > 0 && samples[i] <= samples[i - 1])) {
      throw pipeline::InputError(
          file_.where(),
          fmt::format("{}/reversal/sample holds {} for a turning point of site {} (must rise and stay below {})",
                      group_, samples[i], site, file_.length("sample")),
          "make the file again with dresslife-strain");
    }
    reversals.push_back({strains[i], samples[i]});
  }
  return reversals;
}

}  // namespace dresslife::fatigue
