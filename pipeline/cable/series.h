// Truncated power series in a length l: f(l) = f0 + f1 l + f2 l^2 + .... They contain the derivatives along a component that
// nested helices need (W6). Every level of nesting needs one order: the child's rotation rate depends on the slope of its lay
// angle, which depends on the slope of its parent's rotation rate.
//
// T is double or a pack of samples (strain/kernels/body.h). Orders are run-time numbers below `capacity`.
//
// The functions of this header and of helix.h are compiled once per instruction set (kernels.h). Their namespace has the name of
// the set, because the linker merges two copies of one name, and an older machine might then run the wide copy.
#pragma once

#ifndef DRESSLIFE_MACHINE
#define DRESSLIFE_MACHINE any_machine
#endif

#include <array>
#include <cassert>
#include <cmath>

namespace dresslife::helices {

template <class T>
struct Series {
  static constexpr int capacity = 8;  ///< orders 0 .. capacity - 1

  int order = 0;               ///< highest power kept
  std::array<T, capacity> at;  ///< coefficients; those above `order` are undefined and are not copied

  Series() {}
  Series(const Series& other) { *this = other; }
  Series& operator=(const Series& other) {
    order = other.order;
    for (int k = 0; k <= order; ++k) at[k] = other.at[k];
    return *this;
  }
};

inline namespace DRESSLIFE_MACHINE {

inline double square_root(double x) { return std::sqrt(x); }

template <class T>
Series<T> constant_series(const T& value, int order) {
  assert(order < Series<T>::capacity);
  Series<T> series;
  series.order = order;
  series.at[0] = value;
  for (int k = 1; k <= order; ++k) series.at[k] = value * 0.0;
  return series;
}

template <class A, class B>
auto operator+(const Series<A>& a, const Series<B>& b) {
  Series<decltype(a.at[0] + b.at[0])> sum;
  sum.order = a.order < b.order ? a.order : b.order;
  for (int k = 0; k <= sum.order; ++k) sum.at[k] = a.at[k] + b.at[k];
  return sum;
}

template <class A, class B>
auto operator-(const Series<A>& a, const Series<B>& b) {
  Series<decltype(a.at[0] - b.at[0])> difference;
  difference.order = a.order < b.order ? a.order : b.order;
  for (int k = 0; k <= difference.order; ++k) difference.at[k] = a.at[k] - b.at[k];
  return difference;
}

template <class A, class B>
auto operator*(const Series<A>& a, const Series<B>& b) {
  Series<decltype(a.at[0] * b.at[0])> product;
  product.order = a.order < b.order ? a.order : b.order;
  for (int k = 0; k <= product.order; ++k) {
    product.at[k] = a.at[0] * b.at[k];
    for (int m = 1; m <= k; ++m) product.at[k] += a.at[m] * b.at[k - m];
  }
  return product;
}

template <class T>
Series<T> operator*(double factor, Series<T> series) {
  for (int k = 0; k <= series.order; ++k) series.at[k] = factor * series.at[k];
  return series;
}

/// Adds a number to a series.
template <class T>
Series<T> operator+(double value, Series<T> series) {
  series.at[0] = value + series.at[0];
  return series;
}

template <class T>
Series<T> operator/(const Series<T>& numerator, const Series<T>& denominator) {
  Series<T> quotient;
  quotient.order = numerator.order < denominator.order ? numerator.order : denominator.order;
  const T inverse = 1.0 / denominator.at[0];
  for (int k = 0; k <= quotient.order; ++k) {
    T rest = numerator.at[k];
    for (int m = 1; m <= k; ++m) rest -= denominator.at[m] * quotient.at[k - m];
    quotient.at[k] = rest * inverse;
  }
  return quotient;
}

/// Returns the square root of a series. Precondition: its value is positive.
template <class T>
Series<T> square_root(const Series<T>& square) {
  Series<T> root;
  root.order = square.order;
  root.at[0] = square_root(square.at[0]);
  if (root.order == 0) return root;
  const T half_inverse = 0.5 / root.at[0];
  for (int k = 1; k <= root.order; ++k) {
    T rest = square.at[k];
    for (int m = 1; m < k; ++m) rest -= root.at[m] * root.at[k - m];
    root.at[k] = rest * half_inverse;
  }
  return root;
}

/// Returns the slope df/dl. Its order is one less.
template <class T>
Series<T> slope(const Series<T>& series) {
  assert(series.order > 0);
  Series<T> result;
  result.order = series.order - 1;
  for (int k = 0; k <= result.order; ++k) result.at[k] = (k + 1.0) * series.at[k + 1];
  return result;
}

/// Returns the series in the variable m with l = scale m.
template <class T>
Series<T> stretched(Series<T> series, double scale) {
  double power = 1;
  for (int k = 0; k <= series.order; ++k, power *= scale) series.at[k] = power * series.at[k];
  return series;
}

/// Returns sin(angle + rate l) from sine and cosine of the angle. For the cosine, pass (cosine, -sine), because it is the sine a
/// quarter turn later.
inline Series<double> sine_series(double sine, double cosine, double rate, int order) {
  assert(order < Series<double>::capacity);
  const double pattern[4] = {sine, cosine, -sine, -cosine};
  Series<double> series;
  series.order = order;
  double factor = 1;
  for (int k = 0; k <= order; ++k) {
    series.at[k] = factor * pattern[k % 4];
    factor *= rate / (k + 1);
  }
  return series;
}

}  // namespace DRESSLIFE_MACHINE
}  // namespace dresslife::helices
