#include "strain/friction.h"

#include <algorithm>
#include <cmath>

namespace dresslife::strain {
namespace {

/// Rows of deviations (mean, then the powers) to what is held of them (the powers). Runs twice, the first
/// time to settle.
std::vector<double> held_of(const std::vector<double>& deviations, int powers, std::size_t stride,
                            std::size_t samples, const FrictionCap& cap) {
  std::vector<double> held(powers * stride, 0.0), slope_slip(powers, 0.0);
  Slider slider;
  for (int run = 0; run < 2; ++run)
    for (std::size_t t = 0; t < samples; ++t) {
      const double before = slider.slip();
      held[t] = slider.next(deviations[stride + t], cap_at(cap, deviations[t]));
      const bool sliding = slider.slip() != before;
      for (int power = 1; power < powers; ++power)
        held[power * stride + t] =
            Slider::next_slope(deviations[(1 + power) * stride + t], sliding, slope_slip[power]);
    }
  return held;
}

/// Level of the nearest helical ancestor of the last part of `line`; 0: the part itself, or nobody.
int turned_level(const Construction& construction, const std::vector<int>& line) {
  for (int k = static_cast<int>(line.size()) - 1; k >= 0; --k) {
    const Layer& layer = construction.layers()[construction.parts()[line[k]].layer];
    if (layer.helix_radius > 0 && layer.lay_angle != 0)
      return k + 1 == static_cast<int>(line.size()) ? 0 : layer.level;
  }
  return 0;
}

}  // namespace

HeldStrains::HeldStrains(const Construction& construction, const ClampMeans& means, double arc,
                         const DeformationColumns& columns, std::size_t samples)
    : construction_(construction), stride_(padded(samples)) {
  const auto& plan = means.plan();
  const bool turned = std::any_of(plan.begin(), plan.end(), [](const LayerSlip& slip) {
    return slip.sliding == Sliding::along_ancestor;
  });
  for (int part = 0; part < static_cast<int>(construction.parts().size()); ++part) {  // parents come first
    const LayerSlip& slip = plan[construction.parts()[part].layer];
    if (!slip.friction) continue;
    BundleChain chain = chain_to(construction, plan, part, arc, surface_fibres(0));
    chain.order = construction.levels() - static_cast<int>(chain.steps.size());
    means.attach(chain, part);
    attach(chain, part);
    const int powers = chain.order + 1;
    std::vector<double> deviations((powers + 1) * stride_);
    auto held = [&](int turn) {
      kernels().deviations(pointers(chain), turn, turned_level(construction, construction.ancestry(part)),
                           columns, 0, samples, deviations.data(), stride_);
      return held_of(deviations, powers, stride_, samples, slip.cap);
    };
    Rows& rows = rows_[part];
    for (int turn = 0; turned && turn < phases_per_pitch; ++turn) rows.turned[turn] = held(turn);
    rows.own = held(-1);
  }
}

void HeldStrains::attach(BundleChain& chain, int part) const {
  const std::vector<int> line = construction_.ancestry(part);
  for (std::size_t k = 0; k < line.size(); ++k) {
    const auto found = rows_.find(line[k]);
    if (found == rows_.end()) continue;
    SlidingNumbers& slide = chain.steps[k].slide;
    slide.held = found->second.own.data();
    for (int turn = 0; turn < phases_per_pitch; ++turn)
      slide.turned_held[turn] =
          found->second.turned[turn].empty() ? nullptr : found->second.turned[turn].data();
    slide.held_stride = stride_;
  }
}

}  // namespace dresslife::strain
