// Values of the elements of a list, elements that pass a test, sums and extremes. The function or test of an element may be a
// member, such as &Joint::name.
#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

namespace dresslife::pipeline {

/// Returns of(element) of each element.
template <class List, class Of>
auto mapped(List&& list, const Of& of) {
  std::vector<std::decay_t<decltype(std::invoke(of, *std::begin(list)))>> values;
  for (auto&& one : list) values.push_back(std::invoke(of, one));
  return values;
}

/// Returns the elements that pass a test.
template <class List, class Test>
auto filtered(const List& list, const Test& test) {
  std::vector<std::decay_t<decltype(*std::begin(list))>> some;
  std::ranges::copy_if(list, std::back_inserter(some), test);
  return some;
}

/// Returns sum + of(element) + ..., from the first element to the last.
template <class List, class Of = std::identity, class Number = double>
Number sum_of(const List& list, const Of& of = {}, Number sum = 0) {
  for (const auto& one : list) sum += std::invoke(of, one);
  return sum;
}

/// Returns the largest of `most` and of(element) of all elements.
template <class List, class Number, class Of = std::identity>
Number largest_of(const List& list, Number most, const Of& of = {}) {
  for (const auto& one : list) most = std::max<Number>(most, std::invoke(of, one));
  return most;
}

/// Returns the smallest of `least` and of(element) of all elements.
template <class List, class Number, class Of = std::identity>
Number smallest_of(const List& list, Number least, const Of& of = {}) {
  for (const auto& one : list) least = std::min<Number>(least, std::invoke(of, one));
  return least;
}

/// Returns the first element whose member has a value; null: none.
template <class List, class Member, class Value>
auto* find_in(List& list, Member member, const Value& value) {
  const auto found = std::ranges::find(list, value, member);
  return found == std::ranges::end(list) ? nullptr : &*found;
}

}  // namespace dresslife::pipeline
