// Sorts the indices of a list; the list itself does not change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace dresslife::pipeline {

/// Returns 0 .. size - 1.
inline std::vector<std::size_t> indices_of(std::size_t size) {
  std::vector<std::size_t> all(size);
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

/// Returns 0 .. size - 1, sorted by increasing key(index). Indices with equal keys keep their order.
template <class Key>
std::vector<std::size_t> smallest_first(std::size_t size, const Key& key) {
  std::vector<std::size_t> order = indices_of(size);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

/// Returns 0 .. size - 1, sorted by decreasing key(index). Indices with equal keys keep their order.
template <class Key>
std::vector<std::size_t> largest_first(std::size_t size, const Key& key) {
  std::vector<std::size_t> order = indices_of(size);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return key(a) > key(b); });
  return order;
}

inline std::vector<std::size_t> largest_first(const std::vector<double>& values) {
  return largest_first(values.size(), [&](std::size_t k) { return values[k]; });
}

}  // namespace dresslife::pipeline
