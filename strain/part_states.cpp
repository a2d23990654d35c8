#include "strain/part_states.h"

namespace dresslife::strain {

void PartStates::fill(const BundleNesting& nesting, const DeformationColumns& columns, std::size_t samples,
                      bool in_double) {
  stride_ = padded(samples);
  single_.resize(part_rows * stride_);
  const NestingLevel& last = nesting.steps.back();
  const bool from_dresspack =
      nesting.steps.size() == 1 && slopes_in_single(last) && single_suffices(last, nullptr, 0, 0);
  in_double_ = in_double || !from_dresspack;
  if (from_dresspack)  // the result must not depend on in_double
    kernels().part_rows_of_dresspack(pointers(nesting), columns, 0, samples, single_.data(), stride_);
  if (!in_double_) return;
  rows_.resize(part_state_rows(nesting.order) * stride_);
  kernels().part_states(pointers(nesting), columns, 0, samples, rows_.data(), from_dresspack ? nullptr : single_.data(),
                        stride_);
}

void PartStates::lend(BundlePointers& nesting) const {
  nesting.parent = in_double_ ? rows_.data() : nullptr;
  nesting.parent_rows = single_.data();
  nesting.parent_stride = stride_;
}

}  // namespace dresslife::strain
