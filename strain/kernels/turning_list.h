// List of the turning points of one history.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace dresslife::strain {

struct TurningPoint {
  float strain;
  std::uint32_t sample;
};

/// A growing array of turning points. A kernel writes into it without asking for room for each point.
class TurningList {
 public:
  std::span<const TurningPoint> points() const { return {points_.get(), size_}; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  /// Returns the address of the next point, with room for `more` points. Call set_end() after writing.
  TurningPoint* room(std::size_t more) {
    if (size_ + more > capacity_) grow(size_ + more);
    return points_.get() + size_;
  }
  void set_end(const TurningPoint* end) { size_ = static_cast<std::size_t>(end - points_.get()); }

  void add(float strain, std::uint32_t sample) {
    *room(1) = {strain, sample};
    ++size_;
  }

 private:
  void grow(std::size_t least) {
    capacity_ = std::max(least, 2 * capacity_);
    std::unique_ptr<TurningPoint[]> wider(new TurningPoint[capacity_]);
    std::copy_n(points_.get(), size_, wider.get());
    points_ = std::move(wider);
  }

  std::unique_ptr<TurningPoint[]> points_;
  std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace dresslife::strain
