// The sites of a strain.h5 with their reversals, read in blocks of bounded memory.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fatigue/rainflow.h"
#include "pipeline/files.h"

namespace dresslife::fatigue {

/// A text dataset in which few values occur often: each value once, and the index of every row's.
struct TextColumn {
  std::vector<std::string> values;  ///< in order of appearance
  std::vector<int> index;           ///< (row)
  const std::string& operator[](std::size_t row) const { return values[index[row]]; }
  std::vector<std::string> rows(std::size_t first, std::size_t count) const;
  std::size_t longest() const;  ///< [bytes]
};
TextColumn read_column(const pipeline::FileReader& file, const std::string& dataset);

/// One set of sites of the file: the job's own (group "") or a bound ("/bound_stick", "/bound_free").
class SiteSet {
 public:
  /// @throws pipeline::InputError when offsets, segments or samples contradict each other.
  SiteSet(const pipeline::FileReader& file, std::string group);

  std::size_t size() const { return segment_.size(); }
  int segment(std::size_t site) const { return segment_[site]; }
  const TextColumn& material() const { return material_; }
  std::size_t reversals() const { return offset_.back(); }

  /// Calls `visit(site, strains)` for every site in order; strains are its reversals'. Reads blocks of
  /// about `block_reversals`, or one site where that has more.
  void for_each(const std::function<void(std::size_t, std::span<const float>)>& visit) const;
  static constexpr std::size_t block_reversals = 1 << 20;

  std::vector<Reversal> reversals_of(std::size_t site) const;

 private:
  void check(std::size_t segments) const;

  const pipeline::FileReader& file_;
  std::string group_;
  std::vector<std::int32_t> segment_;
  std::vector<std::uint64_t> offset_;
  TextColumn material_;
};

/// Calls `copy(first, count)` for blocks of rows that cover [0, rows).
void in_blocks(std::size_t rows, const std::function<void(std::size_t first, std::size_t count)>& copy);

}  // namespace dresslife::fatigue
