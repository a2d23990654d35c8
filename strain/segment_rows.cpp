#include "strain/segment_rows.h"

#include <algorithm>
#include <cassert>

#include "pipeline/base/errors.h"

namespace dresslife::strain {

SegmentRows::SegmentRows(std::size_t segments, std::size_t rows, std::size_t samples, const Scratch& scratch)
    : segments_(segments), rows_(rows) {
  if (scratch.beside.empty()) return;
  std::filesystem::path name = scratch.beside;
  pipeline::remove_leftovers(name += ".paths");  // of a killed run
  if (segments * rows * samples * sizeof(float) > scratch.room) file_ = std::make_unique<pipeline::WholeFile>(name);
}

void SegmentRows::begin(std::size_t samples) {
  block_samples_ = samples;
  block_.assign(segments_ * rows_ * samples, 0.0f);
}

void SegmentRows::end() {
  constexpr std::size_t at_once = 16;  // samples per tile: a cache line of each row
  const std::size_t rows = segments_ * rows_;
  std::vector<float> values(block_.size());
  for (std::size_t first = 0; first < block_samples_; first += at_once)
    for (std::size_t row = 0; row < rows; ++row)
      for (std::size_t t = first; t < std::min(first + at_once, block_samples_); ++t)
        values[row * block_samples_ + t] = block_[t * rows + row];
  append(std::move(values), block_samples_);
}

void SegmentRows::append(std::vector<float> values, std::size_t samples) {
  Block block{0, samples, 0, std::move(values)};
  if (!blocks_.empty()) {
    const Block& before = blocks_.back();
    block.first = before.first + before.samples;
    block.offset = before.offset + before.samples * segments_ * rows_;
  }
  if (file_) {
    file_->write_at(block.values.data(), block.values.size() * sizeof(float), block.offset * sizeof(float));
    file_->check();
    block.values = std::vector<float>();  // `= {}` would keep the memory
  }
  blocks_.push_back(std::move(block));
}

void SegmentRows::read(std::size_t segment, std::size_t row, std::size_t first, std::size_t count, double* to) const {
  std::vector<float> from_file;
  auto block = std::ranges::upper_bound(blocks_, first, {}, [](const Block& of) { return of.first + of.samples; });
  for (; count > 0; ++block) {
    assert(block != blocks_.end());
    const std::size_t skipped = first - block->first, here = std::min(count, block->samples - skipped);
    const std::size_t at = (segment * rows_ + row) * block->samples + skipped;
    const float* from = block->values.data() + at;
    if (file_) {
      from_file.resize(here);
      if (!pipeline::read_at(file_->descriptor(), from_file.data(), here * sizeof(float),
                             (block->offset + at) * sizeof(float)))
        throw pipeline::MachineFault({file_->final_name().string()}, "cannot be read again (the disk fails)",
                                     "choose another disk");
      from = from_file.data();
    }
    to = std::copy(from, from + here, to);
    first += here;
    count -= here;
  }
}

}  // namespace dresslife::strain
