// State of a part over the motion, from which all parts in it are computed.
#pragma once

#include <cstddef>
#include <vector>

#include "strain/history.h"
#include "strain/kernels/kernels.h"

namespace dresslife::strain {

class PartStates {
 public:
  /// nesting: to the part; its order is that of its parts plus one. in_double: computes double precision also.
  void fill(const BundleNesting& nesting, const DeformationColumns& columns, std::size_t samples, bool in_double);
  bool in_double() const { return in_double_; }
  /// Makes the nesting of one of its parts start from this state.
  void lend(BundlePointers& nesting) const;

 private:
  std::vector<double> rows_;
  std::vector<float> single_;
  std::size_t stride_ = 0;
  bool in_double_ = false;
};

}  // namespace dresslife::strain
