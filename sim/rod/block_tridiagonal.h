// LDL^T of a symmetric block tridiagonal matrix with 6x6 blocks, one block at a time.
//
//     | D0    U0             |
//     | U0^T  D1    U1       |
//     |       U1^T  D2  ...  |
//     |             ...      |
//
// Block i is factored once its diagonal is complete. Its elimination changes only the diagonal and the
// right-hand side of block i + 1. The caller can therefore assemble block i + 1 just before, and the matrix passes
// through the cache once.
//
// Only the upper triangle of a diagonal block is used. Plain loops on row-major arrays; the pragmas let the compiler unroll and
// vectorise them. A loop over a triangle has a fixed length only after the loop around it is unrolled.
#pragma once

namespace dresslife::sim {

struct TridiagonalBlock {
  double diagonal[36];  ///< D; after factoring: L^T above the diagonal, 1/pivot on it
  double upper[36];     ///< U, coupling to the next block; after elimination: L^-1 U
  double value[6];      ///< right-hand side; after elimination: pivot^-1 L^-1 times it
};

/// Computes D = L diag(pivot) L^T in place. Returns the number of pivots that are not positive (negative eigenvalues, by
/// Sylvester).
inline int factor_diagonal(double* d) {
  int not_positive = 0;
#pragma GCC unroll 6
  for (int c = 0; c < 6; ++c) {
    double* row = d + 6 * c;
    if (!(row[c] > 0)) ++not_positive;
    const double inverse = 1 / row[c];
#pragma GCC unroll 6
    for (int r = c + 1; r < 6; ++r) {
      const double factor = row[r] * inverse;
#pragma GCC unroll 6
      for (int k = r; k < 6; ++k) d[6 * r + k] -= factor * row[k];
    }
#pragma GCC unroll 6
    for (int r = c + 1; r < 6; ++r) row[r] *= inverse;
    row[c] = inverse;
  }
  return not_positive;
}

/// x := L^-1 x. Number: double, or several right-hand sides side by side.
template <class Number>
inline void solve_lower(const double* d, Number* x) {
#pragma GCC unroll 6
  for (int c = 0; c < 5; ++c)
#pragma GCC unroll 6
    for (int r = c + 1; r < 6; ++r) x[r] -= d[6 * c + r] * x[c];
}

/// x := L^-T x
template <class Number>
inline void solve_lower_transposed(const double* d, Number* x) {
#pragma GCC unroll 6
  for (int r = 4; r >= 0; --r)
#pragma GCC unroll 6
    for (int k = r + 1; k < 6; ++k) x[r] -= d[6 * r + k] * x[k];
}

/// x := pivot^-1 x
template <class Number>
inline void scale_by_pivots(const double* d, Number* x) {
#pragma GCC unroll 6
  for (int r = 0; r < 6; ++r) x[r] *= d[7 * r];
}

/// Eliminates the value y of one block from the next: next -= (L^-1 U)^T y.
template <class Number>
inline void carry_down(const double* upper, const Number* y, Number* next) {
#pragma GCC unroll 6
  for (int k = 0; k < 6; ++k)
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) next[r] -= upper[6 * k + r] * y[k];
}

/// Eliminates the solved next block from this one: value -= pivot^-1 (L^-1 U) next.
template <class Number>
inline void carry_up(const double* d, const double* upper, const Number* next, Number* value) {
#pragma GCC unroll 6
  for (int r = 0; r < 6; ++r) {
    Number sum{};
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) sum += upper[6 * r + k] * next[k];
    value[r] -= d[7 * r] * sum;
  }
}

/// Factors `block` and eliminates it from `next` (null: last block). Returns the number of pivots that are not positive.
inline int eliminate(TridiagonalBlock& block, TridiagonalBlock* next) {
  const int not_positive = factor_diagonal(block.diagonal);
  const double* d = block.diagonal;
  solve_lower(d, block.value);
  scale_by_pivots(d, block.value);
  if (next == nullptr) return not_positive;
  double* u = block.upper;
#pragma GCC unroll 6
  for (int c = 0; c < 5; ++c)
#pragma GCC unroll 6
    for (int r = c + 1; r < 6; ++r)
#pragma GCC unroll 6
      for (int k = 0; k < 6; ++k) u[6 * r + k] -= d[6 * c + r] * u[6 * c + k];
#pragma GCC unroll 6
  for (int c = 0; c < 6; ++c) {
    double scaled[6];
#pragma GCC unroll 6
    for (int k = 0; k < 6; ++k) scaled[k] = u[6 * c + k] * d[7 * c];
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r)
#pragma GCC unroll 6
      for (int k = r & ~1; k < 6; ++k) next->diagonal[6 * r + k] -= u[6 * c + r] * scaled[k];
  }
  carry_down(u, block.value, next->value);
  return not_positive;
}

}  // namespace dresslife::sim
