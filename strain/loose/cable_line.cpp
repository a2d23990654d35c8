#include "strain/loose/cable_line.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dresslife::strain {
namespace {

using Eigen::Vector2d;

// A cable rests where Newton's next step moves no node by more. The steps shrink quadratically, so what is
// left is far less; 1e-7 m over two elements of 30 mm are 1e-4 1/m of curvature, 5e-7 of a cable's strain.
constexpr double at_rest = 1e-7;  // [m]
// Farther in one step, contacts would be jumped over: a cable's radius.
constexpr double longest_step = 4e-3;  // [m]
constexpr double first_shift = 100;    // of stiffness per length where that is not positive [N/m2]

double squared(double x) { return x * x; }

}  // namespace

CableLine::CableLine(const LooseCable& cable, const HoseLine& hose, double rest_curvature)
    : cable_(cable), rest_curvature_(rest_curvature), tension_(cable, -rest_curvature * cable.place[0]) {
  const std::size_t nodes = hose.nodes();
  for (auto* field :
       {&path_, &before_, &velocity_, &place_, &bent_, &slope_, &gained_, &step_, &soft_, &from_, &going_})
    field->assign(nodes, Vector2d::Zero());
  for (Vector2d& at : path_) at = {cable.place[0], cable.place[1]};
  gain_.assign(nodes - 1, 0.0);
  press_.assign(nodes, 0.0);
  blocks_.resize(nodes);
  factors_.resize(nodes);
}

void CableLine::begin(const HoseLine& hose, const std::vector<Vector2d>& frame, double step, bool goes_on) {
  drag_ = cable_.drag / step;
  if (!goes_on) step = 0;
  const Vector2d a0(cable_.place[0], cable_.place[1]);
  const std::size_t last = hose.nodes() - 1;
  for (std::size_t i = 0; i <= last; ++i) {
    place_[i] = turned(a0, frame[i]);
    before_[i] = turned(path_[i], frame[i]);  // path_ waits in the frame
    path_[i] = turned(path_[i] + step * velocity_[i], frame[i]);
  }
  path_[0] = place_[0];
  path_[last] = place_[last];
}

void CableLine::measure(const HoseLine& hose) {
  const double h = hose.spacing;
  double before = 0;
  for (std::size_t i = 0; i < hose.nodes(); ++i) {
    const double bent = hose.elongation[i] - hose.curvature[i].dot(path_[i]);
    if (i > 0) gain_[i - 1] = (before + bent) / 2 + (path_[i] - path_[i - 1]).squaredNorm() / (2 * h * h);
    before = bent;
  }
  tension_.answer(gain_, pull_);
}

void CableLine::smooth_slope(const HoseLine& hose) {
  const double h = hose.spacing, inverse = 1 / (h * h), bending = cable_.bending_stiffness / h;
  const double mass = h * cable_.mass_per_length;
  const std::size_t last = hose.nodes() - 1;
  for (std::size_t i = 1; i < last; ++i)
    bent_[i] = hose.curvature[i] - hose.rest[i] + inverse * (path_[i - 1] - 2 * path_[i] + path_[i + 1]);
  // A clamp holds it along the hose's end, A' = 0: beyond lies the mirror image.
  bent_[0] = hose.curvature[0] - hose.rest[0] + 2 * inverse * (path_[1] - path_[0]);
  bent_[last] = hose.curvature[last] - hose.rest[last] + 2 * inverse * (path_[last - 1] - path_[last]);
  const std::vector<double>& T = pull_.tension;
  for (std::size_t i = 1; i < last; ++i) {
    const Vector2d in = (path_[i] - path_[i - 1]) / h, out = (path_[i + 1] - path_[i]) / h;
    const Vector2d curved = h / 2 * hose.curvature[i];
    gained_[i] = in - out - 2 * curved;
    slope_[i] = bending * (bent_[i - 1] - 2 * bent_[i] + bent_[i + 1]) + T[i - 1] * (in - curved) -
                T[i] * (out + curved) - mass * hose.pull[i] + h * drag_ * (path_[i] - before_[i]);
  }
}

/// Contact along `normal`, which leads out of what is touched. depth > 0. across: stiffness across the normal
/// over that along it.
void CableLine::touch(std::size_t node, const Vector2d& normal, double depth, double across) {
  const double k = cable_.wall_stiffness;
  press_[node] += k * depth;
  slope_[node] -= k * depth * normal;
  Block& block = blocks_[node];
  block.xx += k * (squared(normal.x()) * (1 - across) + across);
  block.yy += k * (squared(normal.y()) * (1 - across) + across);
  block.xy += k * normal.x() * normal.y() * (1 - across);
}

/// Adds contact per length to slope_ and blocks_, times the spacing.
void CableLine::contacts(const HoseLine& hose) {
  for (std::size_t i = 1; i + 1 < hose.nodes(); ++i) {
    press_[i] = 0;
    blocks_[i] = {};
    const Vector2d smooth = slope_[i], &at = path_[i];
    slope_[i].setZero();
    const double away2 = at.squaredNorm();
    if (away2 > squared(cable_.farthest)) {
      const double away = std::sqrt(away2), depth = away - cable_.farthest;
      touch(i, -at / away, depth, depth / away);
    }
    if (away2 < squared(cable_.nearest) && away2 > 0) {
      const double away = std::sqrt(away2), depth = cable_.nearest - away;
      touch(i, at / away, depth, -depth / away);
    }
    if (cable_.play == 0) {  // a spring in every direction
      const Vector2d offset = at - place_[i];
      const double moved = offset.norm();
      touch(i, moved > 0 ? Vector2d(-offset / moved) : Vector2d::UnitX(), moved, 1);
    } else if (const Vector2d offset = at - place_[i]; offset.squaredNorm() > squared(cable_.play)) {
      const double moved = offset.norm(), depth = moved - cable_.play;
      touch(i, -offset / moved, depth, depth / moved);
    }
    if (cable_.gap < without_limit) {
      const Vector2d along = Vector2d(-place_[i].y(), place_[i].x()).normalized();
      const double moved = along.dot(at);
      if (std::abs(moved) > cable_.gap)
        touch(i, moved > 0 ? Vector2d(-along) : along, std::abs(moved) - cable_.gap, 0);
    }
    slope_[i] = smooth + hose.spacing * slope_[i];
  }
}

/// L D L^T of bending, tension, drag and contact. Returns how many pivots are negative, which is how many
/// eigenvalues are (Sylvester).
std::size_t CableLine::factor(const HoseLine& hose, double shift) {
  const double h = hose.spacing, bending = cable_.bending_stiffness / (h * h * h);
  const std::size_t last = hose.nodes() - 1;
  const std::vector<double>& T = pull_.tension;
  std::size_t negative = 0;
  tied2_ = bending;
  // what the elimination of the nodes before leaves: of the diagonal of this node and the next, and the tie
  Block here, next;
  double xx = 0, xy = 0, yx = 0, yy = 0;
  for (std::size_t i = 1; i < last; ++i) {
    const bool at_clamp = i == 1 || i + 1 == last;
    const double diagonal = bending * (at_clamp ? 7 : 6) + (T[i - 1] + T[i]) / h + h * (drag_ + shift);
    const Block& contact = blocks_[i];
    const double dxx = diagonal + h * contact.xx + here.xx, dyy = diagonal + h * contact.yy + here.yy;
    const double dxy = h * contact.xy + here.xy, determinant = dxx * dyy - dxy * dxy;
    negative += determinant < 0 ? 1 : dxx + dyy < 0 ? 2 : 0;
    const double inverse = 1 / determinant;
    Factor& f = factors_[i];
    f.inverse = {dyy * inverse, -dxy * inverse, dxx * inverse};
    const double tie = -4 * bending - T[i] / h;
    const double exx = tie + xx, exy = xy, eyx = yx, eyy = tie + yy;
    f.e_xx = f.inverse.xx * exx + f.inverse.xy * eyx;
    f.e_xy = f.inverse.xx * exy + f.inverse.xy * eyy;
    f.e_yx = f.inverse.xy * exx + f.inverse.yy * eyx;
    f.e_yy = f.inverse.xy * exy + f.inverse.yy * eyy;
    here = {next.xx - exx * f.e_xx - eyx * f.e_yx, next.xy - exx * f.e_xy - eyx * f.e_yy,
            next.yy - exy * f.e_xy - eyy * f.e_yy};
    next = {-tied2_ * tied2_ * f.inverse.xx, -tied2_ * tied2_ * f.inverse.xy,
            -tied2_ * tied2_ * f.inverse.yy};
    xx = -tied2_ * f.e_xx, xy = -tied2_ * f.e_yx, yx = -tied2_ * f.e_xy, yy = -tied2_ * f.e_yy;
  }
  return negative;
}

void CableLine::substitute(std::vector<Vector2d>& right) const {
  const std::size_t last = right.size() - 1;
  for (std::size_t i = 1; i < last; ++i) {
    const Factor& f = factors_[i];
    const Vector2d y = right[i];
    right[i] = {f.inverse.xx * y.x() + f.inverse.xy * y.y(), f.inverse.xy * y.x() + f.inverse.yy * y.y()};
    if (i + 1 < last)
      right[i + 1] -= Vector2d(f.e_xx * y.x() + f.e_yx * y.y(), f.e_xy * y.x() + f.e_yy * y.y());
    if (i + 2 < last) right[i + 2] -= tied2_ * right[i];
  }
  for (std::size_t i = last - 1; i-- > 1;) {
    const Factor& f = factors_[i];
    const Vector2d& x = right[i + 1];
    right[i] -= Vector2d(f.e_xx * x.x() + f.e_xy * x.y(), f.e_yx * x.x() + f.e_yy * x.y());
    if (i + 2 < last) {
      const Vector2d far = tied2_ * right[i + 2];
      right[i] -= Vector2d(f.inverse.xx * far.x() + f.inverse.xy * far.y(),
                           f.inverse.xy * far.x() + f.inverse.yy * far.y());
    }
  }
}

/// step_: to the minimum of the quadratic at hand, shifted by as much stiffness as makes that positive.
/// Returns the slope along it.
double CableLine::newton_step(const HoseLine& hose) {
  const std::size_t last = hose.nodes() - 1;
  const double spring = pull_.stiffness / hose.length;
  for (double shift = 0;; shift = shift == 0 ? first_shift : 4 * shift) {
    const std::size_t negative = factor(hose, shift);
    if (negative > 1) continue;
    for (std::size_t i = 1; i < last; ++i) {
      step_[i] = -slope_[i];
      soft_[i] = gained_[i];
    }
    substitute(step_);
    substitute(soft_);
    double along = 0, soft = 0;
    for (std::size_t i = 1; i < last; ++i) {
      along += gained_[i].dot(step_[i]);
      soft += gained_[i].dot(soft_[i]);
    }
    // The whole matrix is positive if its eigenvalues with and without the rank one say so (Haynsworth).
    const double whole = 1 + spring * soft;
    if ((whole > 0) != (negative == 0)) continue;
    const double back = spring * along / whole;
    double down = 0;
    for (std::size_t i = 1; i < last; ++i) {
      step_[i] -= back * soft_[i];
      down += slope_[i].dot(step_[i]);
    }
    return down;
  }
}

/// path_: `share` of the step on from from_. A node that lies against a round wall goes along it: in polar
/// coordinates about its centre, since a straight way would press it in by the square of its length. going_:
/// where each node is heading there.
void CableLine::go(double share) {
  for (std::size_t i = 1; i + 1 < path_.size(); ++i) {
    const Vector2d& step = step_[i];
    const bool on_play = (from_[i] - place_[i]).squaredNorm() > squared(cable_.play);
    const Vector2d centre = on_play ? place_[i] : Vector2d(0, 0), arm = from_[i] - centre;
    const double reach2 = arm.squaredNorm();
    if (reach2 == 0 || (!on_play && reach2 < squared(cable_.farthest) && reach2 > squared(cable_.nearest))) {
      path_[i] = from_[i] + share * step;
      going_[i] = step;
      continue;
    }
    const double reach = std::sqrt(reach2);
    const Vector2d out = arm / reach, across(-out.y(), out.x());
    const double rise = out.dot(step), turn = across.dot(step) / reach;
    // by 2 atan(half), which is the angle itself up to its third power: no sine, no cosine
    const double half = share * turn / 2, scale = 1 / (1 + half * half);
    const Vector2d by((1 - half * half) * scale, 2 * half * scale);
    const Vector2d now = turned(out, by);
    path_[i] = centre + (reach + share * rise) * now;
    going_[i] = rise * now + (reach + share * rise) * turn * scale * turned(across, by);
  }
}

int CableLine::relax(const HoseLine& hose, int most) {
  const std::size_t last = hose.nodes() - 1;
  const auto evaluate = [&] {
    measure(hose);
    smooth_slope(hose);
    contacts(hose);
  };
  evaluate();
  for (int iteration = 1;; ++iteration) {
    const double down = newton_step(hose);
    double largest = 0;
    for (std::size_t i = 1; i < last; ++i) largest = std::max(largest, step_[i].squaredNorm());
    largest = std::sqrt(largest);
    double share = std::min(1.0, longest_step / largest);
    from_ = path_;
    for (int tries = 0; tries < 12; ++tries) {
      go(share);
      evaluate();
      if (largest < at_rest) break;
      double there = 0;
      for (std::size_t i = 1; i < last; ++i) there += slope_[i].dot(going_[i]);
      if (there <= -0.5 * down) break;
      share *= std::clamp(-down / (there - down), 0.1, 0.7);
    }
    if (largest < at_rest || iteration == most) return iteration;
  }
}

/// The sample counts in bent() and missed().
void CableLine::judge_mesh(const HoseLine& hose) {
  const auto own = [&](std::size_t i) { return Vector2d(bent_[i] - hose.curvature[i] + hose.rest[i]); };
  Vector2d before = own(0), here = own(1);
  for (std::size_t i = 1; i + 1 < hose.nodes(); ++i) {
    const Vector2d after = own(i + 1);
    bent_sum_ += (bent_[i] + hose.rest[i]).squaredNorm();
    missed_sum_ += (before - 2 * here + after).squaredNorm() / 144;
    before = here;
    here = after;
  }
}

void CableLine::end(const HoseLine& hose, const std::vector<Vector2d>& frame, double step,
                    CableState& state) {
  tension_.settle(gain_, pull_);
  judge_mesh(hose);
  const std::size_t nodes = hose.nodes();
  state.strain = pull_.strain;
  state.gain = gain_;
  state.tension = pull_.tension;
  state.press = press_;
  state.offset.resize(2 * nodes);
  state.curvature.resize(2 * nodes);
  for (std::size_t i = 0; i < nodes; ++i) {
    const Vector2d own = turned_back(bent_[i], hose.turn[i]);
    state.curvature[2 * i] = -own.y();
    state.curvature[2 * i + 1] = own.x() + rest_curvature_;
    const Vector2d at = turned_back(path_[i], hose.turn[i]);
    state.offset[2 * i] = at.x() - cable_.place[0];
    state.offset[2 * i + 1] = at.y() - cable_.place[1];
    if (step > 0) velocity_[i] = turned_back(path_[i] - before_[i], frame[i]) / step;
    path_[i] = turned_back(path_[i], frame[i]);
  }
}

}  // namespace dresslife::strain
