#include "strain/friction.h"

#include <algorithm>
#include <optional>

namespace dresslife::strain {
namespace {

/// Computes the held strain `held` (its powers) from the rows of deviations (the mean, then the powers), from the state in which
/// one repeat leaves the slider.
void hold(const std::vector<double>& deviations, int powers, std::size_t stride, std::size_t samples,
          const LayerSlip& slip, std::vector<double>& held) {
  held.assign(powers * stride, 0.0);
  const double slides = 1 - slip.elastic;
  const double* const away = deviations.data() + stride;
  const auto deviation = [&](std::size_t t) { return slides * away[t]; };
  const auto cap = [&](std::size_t t) { return cap_at(slip.cap, deviations[t]); };
  Slider slider(settled_slip(samples, deviation, cap));
  double before = slider.slip();
  for (std::size_t t = 0; t < samples;
       ++t) {  // slips only: the previous one stays in a register, since no function is called
    slider.next(deviation(t), cap(t));
    held[t] = slider.slip();
  }
  std::vector<std::size_t> slid;  // samples at which it slides
  for (std::size_t t = 0; t < samples; ++t) {
    if (held[t] != before) slid.push_back(t);
    before = held[t];
    held[t] = deviation(t) - held[t] + slip.elastic * away[t];
  }
  // While the slider sticks, the slope of the held strain changes with that of the deviation. While it slides, the slope is that
  // of the cap, zero. The last slide may lie in the previous repeat, with the slip at one of its limits.
  std::optional<std::size_t> last;
  if (!slid.empty()) last = slid.back();
  for (std::size_t t = samples; !last && before != 0 && t-- > 0;)
    if (before == deviation(t) - cap(t) || before == deviation(t) + cap(t)) last = t;
  for (int power = 1; power < powers; ++power) {
    const double* const slope = away + power * stride;
    double* const of_slope = held.data() + power * stride;
    double slope_slip = last ? slides * slope[*last] : 0;
    std::size_t t = 0;
    const auto stick_until = [&](std::size_t end) {
      for (; t < end; ++t) of_slope[t] = slides * slope[t] - slope_slip + slip.elastic * slope[t];
    };
    for (const std::size_t next : slid) {
      stick_until(next);
      slope_slip = slides * slope[next];
    }
    stick_until(samples);
  }
}

/// Returns the level of the nearest helical ancestor of the last part of `line`; 0: the part itself is helical, or no ancestor.
int turned_level(const Construction& construction, const std::vector<int>& line) {
  for (int k = static_cast<int>(line.size()) - 1; k >= 0; --k) {
    const Layer& layer = construction.layers()[construction.parts()[line[k]].layer];
    if (layer.helix_radius > 0 && layer.lay_angle != 0) return k + 1 == static_cast<int>(line.size()) ? 0 : layer.level;
  }
  return 0;
}

}  // namespace

bool HeldStrains::any_turned() const {
  return std::ranges::any_of(means_.plan(),
                             [](const LayerSlip& slip) { return slip.sliding == Sliding::along_ancestor; });
}

std::size_t HeldStrains::bytes(std::size_t samples) const {
  std::vector<bool> held(kept_.size(), false);
  for (const Part& part : construction_.parts())
    if (means_.plan()[part.layer].friction) held[construction_.layers()[part.layer].level - 1] = true;
  std::size_t rows = 0, scratch = 0;
  for (std::size_t level = 0; level < held.size(); ++level) {
    if (!held[level]) continue;
    rows += static_cast<std::size_t>(powers(static_cast<int>(level))) * (any_turned() ? 1 + phases_per_pitch : 1);
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
  deviations_->of = {};
  deviations_->parent_is = nobody;
}

const HeldStrains::Rows& HeldStrains::rows_of(int part, int level) {
  Rows& rows = kept_[level];
  if (rows.part != part) fill(rows, part);
  rows.part = part;
  return rows;
}

/// Returns the nesting to a part. Requests the held strains of the parts above, each of which is stored at its own level.
BundleNesting HeldStrains::nesting_of(int part) {
  BundleNesting nesting = nesting_to(construction_, means_.plan(), part, arc_, surface_fibres(0));
  means_.attach(nesting, part, *motion_);
  if (const int parent = construction_.parts()[part].parent; parent != dresspack_itself) attach(nesting, parent);
  return nesting;
}

void HeldStrains::find_deviations(const BundleNesting& nesting, const PartDeviations::Of& of) {
  BundlePointers from = pointers(nesting);
  const DeformationColumns& columns = motion_->columns(construction_, means_.plan(), of.part);
  const int parent = construction_.parts()[of.part].parent;
  if (parent != dresspack_itself && !of.means && !any_turned()) {
    if (deviations_->parent_is != parent) {
      BundleNesting to_parent = nesting_of(parent);
      to_parent.order = nesting.order + 1;
      deviations_->parent.fill(to_parent, columns, samples_, true);
      deviations_->parent_is = parent;
    }
    deviations_->parent.lend(from);
  }
  const auto rows = static_cast<std::size_t>(nesting.order) + 2;  // the mean, and the powers
  deviations_->rows.resize(rows * stride_);
  kernels().deviations(from, of.turn, turned_level(construction_, construction_.ancestry(of.part)), columns, 0,
                       samples_, deviations_->rows.data(), stride_);
  deviations_->of = of;
}

void HeldStrains::fill(Rows& rows, int part) {
  const std::vector<int> line = construction_.ancestry(part);
  const int powers = this->powers(static_cast<int>(line.size()) - 1);
  const LayerSlip& slip = means_.plan()[construction_.parts()[part].layer];
  const bool held_above = std::any_of(line.begin(), line.end() - 1, [&](int above) {
    return means_.plan()[construction_.parts()[above].layer].friction;
  });
  std::optional<BundleNesting> nesting;
  const auto hold_turned = [&](int turn, std::vector<double>& held) {
    const PartDeviations::Of of{part, turn, held_above ? &means_ : nullptr};
    if (deviations_->of != of) {
      if (!nesting) {
        nesting = nesting_of(part);
        nesting->order = powers - 1;
      }
      find_deviations(*nesting, of);
    }
    hold(deviations_->rows, powers, stride_, samples_, slip, held);
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
