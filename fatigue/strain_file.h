// The sites of a strain.h5 with their reversals, read in blocks of limited memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fatigue/rainflow.h"
#include "pipeline/files/files.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

/// A text dataset with few different values: each value once, and for every row the index of its value.
struct TextColumn {
  std::vector<std::string> values;  ///< in order of appearance
  std::vector<int> index;           ///< (row)
  const std::string& operator[](std::size_t row) const { return values[index[row]]; }
};
TextColumn read_column(const pipeline::FileReader& file, const std::string& dataset);

/// One set of sites of the file: the job's own (group "") or those of a bound ("/bound_stick", "/bound_free").
class SiteSet {
 public:
  /// @throws pipeline::InputError when offsets, segments or samples contradict each other.
  SiteSet(const pipeline::FileReader& file, std::string group);

  std::size_t size() const { return segment_.size(); }
  int segment(std::size_t site) const { return segment_[site]; }
  const TextColumn& material() const { return material_; }
  /// @throws pipeline::InputError when the job does not describe the material of a site.
  void check_materials(const pipeline::Job& job) const;
  std::size_t reversals() const { return offset_.back(); }

  /// Consecutive sites with the strains of all their reversals.
  struct Block {
    std::size_t begin = 0, end = 0;  ///< sites
    std::span<const float> strains;
    std::span<const std::uint64_t> offset;  ///< (sites + 1) offsets in the file
    std::span<const float> strains_of(std::size_t site) const {
      return strains.subspan(offset[site - begin] - offset[0], offset[site - begin + 1] - offset[site - begin]);
    }
    /// Returns `parts` + 1 sites that divide the block into parts with about equal numbers of reversals.
    std::vector<std::size_t> cuts(std::size_t parts) const;
  };
  /// Calls `visit` for blocks that cover all sites in order. A block has about `block_reversals` reversals, or one site if that
  /// has more. `visit` must call read_ahead() once, on the thread on which it was called; other threads can work meanwhile.
  using Visit = std::function<void(const Block& block, const std::function<void()>& read_ahead)>;
  void for_each_block(const Visit& visit) const;
  static constexpr std::size_t block_reversals = 1 << 20;

  std::vector<Reversal> reversals_of(std::size_t site) const;
  /// @throws pipeline::InputError, which names the site, when its rises and falls do not alternate.
  void check_alternating(std::size_t site, std::span<const float> strains) const;

 private:
  void check(std::size_t segments) const;
  std::size_t end_of_block(std::size_t begin) const;  ///< end of the block's sites

  const pipeline::FileReader& file_;
  std::string group_;
  std::vector<std::int32_t> segment_;
  std::vector<std::uint64_t> offset_;
  TextColumn material_;
};

/// Calls `copy(first, count)` for blocks of rows that cover [0, rows).
void in_blocks(std::size_t rows, const std::function<void(std::size_t first, std::size_t count)>& copy);

}  // namespace dresslife::fatigue
