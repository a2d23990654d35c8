// The turning points of one history as they are found.
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

/// A growing row of turning points that a kernel writes into without asking for room each time.
class TurningList {
 public:
  std::span<const TurningPoint> points() const { return {points_.get(), size_}; }
  std::size_t size() const { return size_; }
  void clear() { size_ = 0; }

  /// Where the next point goes, with room for `more` points; set_end() states their end.
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
