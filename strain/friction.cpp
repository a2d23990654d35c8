#include "strain/friction.h"

#include <algorithm>
#include <cmath>

namespace dresslife::strain {
namespace {

/// Rows of deviations (mean, then the powers) to what is held of them (the powers). Runs twice, the first
/// time to settle.
void hold(const std::vector<double>& deviations, int powers, std::size_t stride, std::size_t samples,
          const LayerSlip& slip, std::vector<double>& held) {
  held.assign(powers * stride, 0.0);
  std::vector<double> slope_slip(powers, 0.0);
  Slider slider;
  for (int run = 0; run < 2; ++run)
    for (std::size_t t = 0; t < samples; ++t) {
      const double before = slider.slip();
      const double away = deviations[stride + t], slides = 1 - slip.elastic;
      held[t] = slider.next(slides * away, cap_at(slip.cap, deviations[t])) + slip.elastic * away;
      const bool sliding = slider.slip() != before;
      for (int power = 1; power < powers; ++power) {
        const double slope = deviations[(1 + power) * stride + t];
        held[power * stride + t] =
            Slider::next_slope(slides * slope, sliding, slope_slip[power]) + slip.elastic * slope;
      }
    }
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

bool HeldStrains::any_turned() const {
  return std::any_of(means_.plan().begin(), means_.plan().end(),
                     [](const LayerSlip& slip) { return slip.sliding == Sliding::along_ancestor; });
}

std::size_t HeldStrains::bytes(std::size_t samples) const {
  std::vector<bool> held(kept_.size(), false);
  for (const Part& part : construction_.parts())
    if (means_.plan()[part.layer].friction) held[construction_.layers()[part.layer].level - 1] = true;
  std::size_t rows = 0, scratch = 0;
  for (std::size_t level = 0; level < held.size(); ++level) {
    if (!held[level]) continue;
    rows +=
        static_cast<std::size_t>(powers(static_cast<int>(level))) * (any_turned() ? 1 + phases_per_pitch : 1);
    scratch = std::max<std::size_t>(scratch, powers(static_cast<int>(level)) + 1);
  }
  return (rows + scratch) * padded(samples) * sizeof(double);
}

void HeldStrains::begin(double arc, const SegmentMotion& motion) {
  arc_ = arc;
  motion_ = &motion;
  samples_ = motion.samples;
  stride_ = padded(samples_);
  for (Rows& rows : kept_) rows.part = nobody;
}

const HeldStrains::Rows& HeldStrains::rows_of(int part, int level) {
  Rows& rows = kept_[level];
  if (rows.part != part) fill(rows, part);
  rows.part = part;
  return rows;
}

/// The parts above are asked for on the way, each of them at a level of its own.
void HeldStrains::fill(Rows& rows, int part) {
  const auto& plan = means_.plan();
  BundleNesting nesting = nesting_to(construction_, plan, part, arc_, surface_fibres(0));
  const int level = static_cast<int>(nesting.steps.size()) - 1, powers = this->powers(level);
  nesting.order = powers - 1;
  means_.attach(nesting, part, *motion_);
  if (const int parent = construction_.parts()[part].parent; parent != dresspack_itself)
    attach(nesting, parent);
  deviations_.resize((powers + 1) * stride_);
  const auto hold_turned = [&](int turn, std::vector<double>& held) {
    kernels().deviations(pointers(nesting), turn, turned_level(construction_, construction_.ancestry(part)),
                         motion_->columns(construction_, plan, part), 0, samples_, deviations_.data(),
                         stride_);
    hold(deviations_, powers, stride_, samples_, plan[construction_.parts()[part].layer], held);
  };
  for (int turn = 0; any_turned() && turn < phases_per_pitch; ++turn) hold_turned(turn, rows.turned[turn]);
  hold_turned(-1, rows.own);
}

void HeldStrains::attach(BundleNesting& nesting, int part) {
  const std::vector<int> line = construction_.ancestry(part);
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (!means_.plan()[construction_.parts()[line[k]].layer].friction) continue;
    const Rows& rows = rows_of(line[k], static_cast<int>(k));
    SlidingNumbers& slide = nesting.steps[k].slide;
    slide.held = rows.own.data();
    for (int turn = 0; turn < phases_per_pitch; ++turn)
      slide.turned_held[turn] = rows.turned[turn].empty() ? nullptr : rows.turned[turn].data();
    slide.held_stride = stride_;
  }
}

}  // namespace dresslife::strain
