// The hot loops of loose cables for one instruction set. portable.cpp, avx2.cpp and avx512.cpp include this file, each for its
// own set (pipeline/base/simd.h).
//
// Along a cable each node depends on the previous one. Two packs of cables at a time use the waiting time. Cables need 2 to 60
// iterations: a cable at rest gives its lane to the next.
#include "pipeline/base/simd.h"
// simd.h declares the functions that the templates below use
#include "strain/loose/kernels/loose_kernels.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

using namespace simd;

// A cable rests if Newton's next step moves every node by less. The steps shrink quadratically, so the remaining error is much
// smaller; 1e-7 m over two elements of 30 mm are 1e-4 1/m of curvature, 5e-7 of strain in a cable.
constexpr double at_rest = 1e-7;  // [m]
// A longer step would jump over contacts: a cable's radius.
constexpr double longest_step = 4e-3;  // [m]
// First addition to the stiffness per length if the matrix is not positive definite [N/m2]. With 100 four times as many shifts
// were needed (robot 1).
constexpr double first_shift = 2e4;
constexpr int most_shifts = 60;        // by factors of four: more than any cable needs
constexpr int most_tries = 12;
// Up to this length a step is taken as a whole, in the first most_whole_steps iterations. Many nodes then reach their contacts at
// once. A search along the step would stop at the first contact. Longer steps could end at another rest.
constexpr double whole_step = 1e-3;  // [m]
constexpr int most_whole_steps = 20;

inline Pack at(const double* of, std::size_t lane) { return load<Pack>(of + lane); }

struct Pair {
  Pack x, y;

  friend HWY_INLINE Pair operator+(const Pair& a, const Pair& b) { return {a.x + b.x, a.y + b.y}; }
  friend HWY_INLINE Pair operator-(const Pair& a, const Pair& b) { return {a.x - b.x, a.y - b.y}; }
  friend HWY_INLINE Pair operator*(const Pack& a, const Pair& b) { return {a * b.x, a * b.y}; }
};
inline Pack dot(const Pair& a, const Pair& b) { return a.x * b.x + a.y * b.y; }
inline Pair select(const DoubleMask& mask, const Pair& yes, const Pair& no) {
  return {simd::select(mask, yes.x, no.x), simd::select(mask, yes.y, no.y)};
}

/// Progress of the cables of a pack on their way to rest, (lane).
struct Progress {
  double busy[pack_size] = {};    // 1: a cable that does not rest yet
  double trying[pack_size] = {};  // 1: has a step of Newton's method, of which it tries a share
  double share[pack_size] = {}, tries[pack_size] = {};
  double down[pack_size] = {},
         largest[pack_size] = {};  // of the step: slope along it, largest movement of a node [m]
  double shift[pack_size] = {},
         shifts[pack_size] = {};  // added stiffness per length [N/m2], and number of increases
  double took[pack_size] = {};    // number of iterations

  void begin(int lane) {
    busy[lane] = 1;
    trying[lane] = shift[lane] = shifts[lane] = took[lane] = 0;
  }
};

inline DoubleMask set(const double* of) { return greater(load<Pack>(of), Pack(0.0)); }

/// `packs` packs of cables, starting at lane `first`.
template <int packs>
struct Lines {
  const LineBatch& of;
  std::size_t first;

  std::size_t lane(int p) const { return first + static_cast<std::size_t>(p) * pack_size; }
  Pair pair(const double* values, std::size_t node, int p) const {
    const double* const from = values + 2 * node * of.lanes + lane(p);
    return {load<Pack>(from), load<Pack>(from + of.lanes)};
  }
  void put(const Pair& pair, double* values, std::size_t node, int p) const {
    double* const to = values + 2 * node * of.lanes + lane(p);
    store(pair.x, to);
    store(pair.y, to + of.lanes);
  }
  static Pair same(const double* values, std::size_t node) {
    return {Pack(values[2 * node]), Pack(values[2 * node + 1])};
  }

  void answer() const;
  template <bool with_contact>
  void slopes() const;
  struct Touch;
  void contacts(std::size_t node, int p, Touch& touch) const;
  void put_press(int p) const;
  void factor(const Progress* progress, Pack* negative) const;
  void substitute() const;
  void judge(int most, Progress* progress) const;
  void newton_step(Progress* progress) const;
  void go(Progress* progress) const;
  Pack along_way(int p) const;
  void round(int most, Progress* progress) const;
};

/// Computes strain and tension from the gain of the path (W33), and the derivative of the tension by the gain.
template <int packs>
void Lines<packs>::answer() const {
  const std::size_t last = of.nodes - 1;
  const double per_length = 0.5 / (of.spacing * of.spacing);
  Pack ends[packs], inside[packs], steep[packs];
  Pair before[packs];
  for (std::size_t i = 0; i <= last; ++i) {
    const Pair K = same(of.curvature, i);
    const Pack e(of.elongation[i]);
    for (int p = 0; p < packs; ++p) {
      const Pair A = pair(of.path, i, p);
      const Pack bent = e - dot(K, A);
      if (i == 0) {
        ends[p] = bent;
        inside[p] = steep[p] = Pack(0.0);
      } else {
        const Pair way = A - before[p];
        steep[p] += dot(way, way);
        if (i < last) inside[p] += bent;
        if (i == last) ends[p] += bent;
      }
      before[p] = A;
    }
  }
  for (int p = 0; p < packs; ++p) {
    const std::size_t k = lane(p);
    const Pack sum = inside[p] + 0.5 * ends[p] + per_length * steep[p];
    const Pack rate = at(of.free_length_rate, k), mean = sum / Pack(static_cast<double>(last));
    const Pack tried = (1.0 + mean) / rate - 1.0 - at(of.slipped, k);
    const Pack strain = smaller(larger(tried, at(of.least_strain, k)), at(of.most_strain, k));
    const Pack EA = at(of.axial_stiffness, k);
    store(strain, of.strain + k);
    store(EA * strain, of.tension + k);
    store(simd::select(equal(strain, tried), EA / rate, Pack(0.0)), of.stiffness + k);
  }
}

/// Contributions of contact at one node, per length.
template <int packs>
struct Lines<packs>::Touch {
  Pack press, xx, xy, yy;
  Pair slope;

  inline Touch() : press(0.0), xx(0.0), xy(0.0), yy(0.0), slope{Pack(0.0), Pack(0.0)} {}

  /// Adds a contact in the lanes of `mask`. normal: out of the contact partner. depth > 0. across: stiffness across the normal
  /// over that along it.
  inline void add(const DoubleMask& mask, const Pack& stiffness, const Pair& normal, const Pack& depth,
                  const Pack& across) {
    const Pack none(0.0), force = stiffness * depth, rest = 1.0 - across;
    press += simd::select(mask, force, none);
    slope = slope - select(mask, force * normal, {none, none});
    xx += simd::select(mask, stiffness * (normal.x * normal.x * rest + across), none);
    yy += simd::select(mask, stiffness * (normal.y * normal.y * rest + across), none);
    xy += simd::select(mask, stiffness * (normal.x * normal.y * rest), none);
  }
};

template <int packs>
inline void Lines<packs>::contacts(std::size_t node, int p, Touch& touch) const {
  const std::size_t k = lane(p);
  const Pack zero(0.0), wall = at(of.wall_stiffness, k);
  const Pair A = pair(of.path, node, p), place = pair(of.place, node, p), offset = A - place;
  const Pack away2 = dot(A, A), moved2 = dot(offset, offset);
  const Pack far = at(of.farthest, k), near = at(of.nearest, k), play = at(of.play, k), gap = at(of.gap, k);
  const DoubleMask beyond = greater(away2, far * far);
  const DoubleMask within = greater(near * near, away2) & greater(away2, zero);
  if (bits(beyond | within)) {
    const Pack away = square_root(away2), per_away = 1.0 / away;
    const Pair out = per_away * A;
    const Pack deep = away - far, shallow = near - away;
    touch.add(beyond, wall, {-out.x, -out.y}, deep, deep * per_away);
    touch.add(within, wall, out, shallow, -(shallow * per_away));
  }
  // zero play: a spring in every direction
  const DoubleMask sprung = equal(play, zero), at_play = greater(moved2, play * play) | sprung;
  if (bits(at_play)) {
    const Pack moved = square_root(moved2), depth = moved - play;
    const Pack per_moved = simd::select(greater(moved, zero), 1.0 / moved, zero);
    touch.add(at_play, wall, -per_moved * offset, depth, simd::select(sprung, Pack(1.0), depth * per_moved));
  }
  const Pack per_radius = at(of.per_radius, k);
  const Pair along{-(per_radius * place.y), per_radius * place.x};
  const Pack moved = dot(along, A), side = simd::select(greater(moved, zero), Pack(-1.0), Pack(1.0));
  const Pack depth = -(side * moved) - gap;
  const DoubleMask beside = greater(depth, zero);
  if (bits(beside)) touch.add(beside, wall, side * along, depth, zero);
}

/// Stores the contact forces of cables at their present positions.
template <int packs>
void Lines<packs>::put_press(int p) const {
  for (std::size_t i = 1; i + 1 < of.nodes; ++i) {
    Touch touch;
    contacts(i, p, touch);
    store(touch.press, of.press + i * of.lanes + lane(p));
  }
}

/// Computes the slope of the energy at each inner node; with_contact: including contact, with its blocks.
template <int packs>
template <bool with_contact>
void Lines<packs>::slopes() const {
  const std::size_t last = of.nodes - 1, lanes = of.lanes;
  const double h = of.spacing, per_h = 1 / h, per_h2 = per_h * per_h;
  Pair here[packs], next[packs], bent_before[packs], bent_here[packs];
  Pack bending[packs], mass[packs], drag[packs], tension[packs];
  for (int p = 0; p < packs; ++p) {
    const std::size_t k = lane(p);
    const Pair clamped = pair(of.path, 0, p);
    here[p] = clamped;
    next[p] = pair(of.path, 1, p);
    // A clamp holds the cable as it was laid: beyond it is the mirror image, also of its place in `rest`.
    bent_here[p] = same(of.curvature, 0) - pair(of.rest, 0, p) + Pack(2 * per_h2) * (next[p] - here[p]);
    bending[p] = at(of.bending_stiffness, k) * Pack(per_h);
    mass[p] = at(of.mass_per_length, k) * Pack(h);
    drag[p] = at(of.drag, k) * Pack(h);
    tension[p] = at(of.tension, k);
  }
  for (std::size_t i = 0; i < last; ++i) {
    const Pair hose_bends = same(of.curvature, i + 1), K = Pack(h) * same(of.curvature, i),
               pull = same(of.pull, i);
    for (int p = 0; p < packs; ++p) {
      const Pair after = i + 2 <= last ? pair(of.path, i + 2, p) : here[p];
      const Pair bent_next =
          hose_bends - pair(of.rest, i + 1, p) + Pack(per_h2) * ((here[p] - next[p]) + (after - next[p]));
      if (i > 0) {
        const Pair A = here[p], ahead = next[p], behind = pair(of.path, i - 1, p);
        const Pair gained = Pack(per_h) * ((A - behind) - (ahead - A)) - K;
        Pair slope = bending[p] * ((bent_before[p] - bent_here[p]) + (bent_next - bent_here[p])) +
                     tension[p] * gained - mass[p] * pull + drag[p] * (A - pair(of.before, i, p));
        put(gained, of.gained, i, p);
        if constexpr (with_contact) {
          Touch touch;
          contacts(i, p, touch);
          slope = slope + Pack(h) * touch.slope;
          double* const block = of.blocks + 3 * i * lanes + lane(p);
          store(touch.xx, block);
          store(touch.xy, block + lanes);
          store(touch.yy, block + 2 * lanes);
        }
        put(slope, of.slope, i, p);
      }
      bent_before[p] = bent_here[p];
      bent_here[p] = bent_next;
      here[p] = next[p];
      next[p] = after;
    }
  }
}

/// Computes L D L^T of bending, tension, drag and contact: for each node the inverse of its pivot, and this inverse times the
/// coupling to the next node. negative: number of negative pivots, which is that of negative eigenvalues (Sylvester).
template <int packs>
void Lines<packs>::factor(const Progress* progress, Pack* negative) const {
  const std::size_t last = of.nodes - 1, lanes = of.lanes;
  const double h = of.spacing;
  Pack tied2[packs], tie[packs], diagonal[packs];
  // result of eliminating the previous nodes: for the diagonals of this node and the next, and for the coupling
  Pack here_xx[packs], here_xy[packs], here_yy[packs], next_xx[packs], next_xy[packs], next_yy[packs];
  Pack xx[packs], xy[packs], yx[packs], yy[packs];
  for (int p = 0; p < packs; ++p) {
    const std::size_t k = lane(p);
    tied2[p] = at(of.bending_stiffness, k) * Pack(1 / (h * h * h));
    const Pack pulled = at(of.tension, k) * Pack(1 / h);
    tie[p] = -4.0 * tied2[p] - pulled;
    diagonal[p] = 6.0 * tied2[p] + 2.0 * pulled + Pack(h) * (at(of.drag, k) + load<Pack>(progress[p].shift));
    negative[p] = here_xx[p] = here_xy[p] = here_yy[p] = next_xx[p] = next_xy[p] = next_yy[p] = Pack(0.0);
    xx[p] = xy[p] = yx[p] = yy[p] = Pack(0.0);
  }
  for (std::size_t i = 1; i < last; ++i) {
    const bool at_clamp = i == 1 || i + 1 == last;
    for (int p = 0; p < packs; ++p) {
      const double* const block = of.blocks + 3 * i * lanes + lane(p);
      const Pack own = at_clamp ? diagonal[p] + tied2[p] : diagonal[p];
      const Pack dxx = own + Pack(h) * load<Pack>(block) + here_xx[p];
      const Pack dyy = own + Pack(h) * load<Pack>(block + 2 * lanes) + here_yy[p];
      const Pack dxy = Pack(h) * load<Pack>(block + lanes) + here_xy[p];
      const Pack determinant = dxx * dyy - dxy * dxy, inverse = 1.0 / determinant;
      negative[p] += simd::select(greater(Pack(0.0), determinant), Pack(1.0),
                                  simd::select(greater(Pack(0.0), dxx + dyy), Pack(2.0), Pack(0.0)));
      const Pack ixx = dyy * inverse, ixy = -(dxy * inverse), iyy = dxx * inverse;
      const Pack exx = tie[p] + xx[p], exy = xy[p], eyx = yx[p], eyy = tie[p] + yy[p];
      const Pack f_xx = ixx * exx + ixy * eyx, f_xy = ixx * exy + ixy * eyy;
      const Pack f_yx = ixy * exx + iyy * eyx, f_yy = ixy * exy + iyy * eyy;
      double* const to = of.factors + 7 * i * lanes + lane(p);
      const Pack values[] = {ixx, ixy, iyy, f_xx, f_xy, f_yx, f_yy};
      for (std::size_t v = 0; v < 7; ++v) store(values[v], to + v * lanes);
      here_xx[p] = next_xx[p] - exx * f_xx - eyx * f_yx;
      here_xy[p] = next_xy[p] - exx * f_xy - eyx * f_yy;
      here_yy[p] = next_yy[p] - exy * f_xy - eyy * f_yy;
      const Pack far = -(tied2[p] * tied2[p]);
      next_xx[p] = far * ixx, next_xy[p] = far * ixy, next_yy[p] = far * iyy;
      xx[p] = -(tied2[p] * f_xx), xy[p] = -(tied2[p] * f_yx), yx[p] = -(tied2[p] * f_xy),
      yy[p] = -(tied2[p] * f_yy);
    }
  }
}

/// Solves for the right-hand sides -slope and gained; the solutions are `solved` and `soft`.
template <int packs>
void Lines<packs>::substitute() const {
  const std::size_t last = of.nodes - 1, lanes = of.lanes;
  constexpr int sides = 2;
  double* const solution[sides] = {of.solved, of.soft};
  Pack tied2[packs];
  Pair here[packs][sides],
      next[packs][sides];  // to be subtracted from the right-hand sides of this node and the next
  for (int p = 0; p < packs; ++p) {
    tied2[p] = at(of.bending_stiffness, lane(p)) * Pack(1 / (of.spacing * of.spacing * of.spacing));
    for (int s = 0; s < sides; ++s) here[p][s] = next[p][s] = {Pack(0.0), Pack(0.0)};
  }
  for (std::size_t i = 1; i < last; ++i)
    for (int p = 0; p < packs; ++p) {
      const double* const f = of.factors + 7 * i * lanes + lane(p);
      const Pack ixx = load<Pack>(f), ixy = load<Pack>(f + lanes), iyy = load<Pack>(f + 2 * lanes);
      const Pack exx = load<Pack>(f + 3 * lanes), exy = load<Pack>(f + 4 * lanes);
      const Pack eyx = load<Pack>(f + 5 * lanes), eyy = load<Pack>(f + 6 * lanes);
      const Pair slope = pair(of.slope, i, p);
      const Pair right[sides] = {{-slope.x, -slope.y}, pair(of.gained, i, p)};
      for (int s = 0; s < sides; ++s) {
        const Pair y = right[s] - here[p][s];
        const Pair x{ixx * y.x + ixy * y.y, ixy * y.x + iyy * y.y};
        put(x, solution[s], i, p);
        here[p][s] = next[p][s] + Pair{exx * y.x + eyx * y.y, exy * y.x + eyy * y.y};
        next[p][s] = tied2[p] * x;
      }
    }
  for (int p = 0; p < packs; ++p)
    for (int s = 0; s < sides; ++s)
      here[p][s] = next[p][s] = {Pack(0.0), Pack(0.0)};  // of the two nodes behind
  for (std::size_t i = last - 1; i > 0; --i)
    for (int p = 0; p < packs; ++p) {
      const double* const f = of.factors + 7 * i * lanes + lane(p);
      const Pack ixx = load<Pack>(f), ixy = load<Pack>(f + lanes), iyy = load<Pack>(f + 2 * lanes);
      const Pack exx = load<Pack>(f + 3 * lanes), exy = load<Pack>(f + 4 * lanes);
      const Pack eyx = load<Pack>(f + 5 * lanes), eyy = load<Pack>(f + 6 * lanes);
      for (int s = 0; s < sides; ++s) {
        const Pair near = here[p][s], far = tied2[p] * next[p][s], y = pair(solution[s], i, p);
        const Pair x = y - Pair{ixx * far.x + ixy * far.y, ixy * far.x + iyy * far.y} -
                       Pair{exx * near.x + exy * near.y, eyx * near.x + eyy * near.y};
        put(x, solution[s], i, p);
        next[p][s] = near;
        here[p][s] = x;
      }
    }
}

/// Decides for cables that try a step: accept its share, try a shorter one, or give up.
template <int packs>
void Lines<packs>::judge(int most, Progress* progress) const {
  const Pack zero(0.0);
  for (int p = 0; p < packs; ++p) {
    Progress& at_p = progress[p];
    const Pack there = along_way(p), down = load<Pack>(at_p.down), share = load<Pack>(at_p.share);
    const Pack tries = load<Pack>(at_p.tries);
    const DoubleMask whole = at_least(Pack(whole_step), load<Pack>(at_p.largest)) &
                             at_least(Pack(static_cast<double>(most_whole_steps)), load<Pack>(at_p.took));
    const DoubleMask good =
        whole | at_least(-0.5 * down, there) | at_least(tries, Pack(static_cast<double>(most_tries)));
    const DoubleMask ends =
        set(at_p.trying) & good & at_least(load<Pack>(at_p.took), Pack(static_cast<double>(most)));
    const Pack shorter = smaller(larger(-down / (there - down), Pack(0.1)), Pack(0.7));
    store(simd::select(good, share, share * shorter), at_p.share);
    store(tries + 1.0, at_p.tries);
    store(simd::select(ends, zero, load<Pack>(at_p.busy)), at_p.busy);
    store(simd::select(good, zero, load<Pack>(at_p.trying)), at_p.trying);
    if (of.press && bits(ends)) put_press(p);
  }
}

/// Computes the step to the minimum of the local quadratic, for cables that do not try one. If the quadratic is not positive
/// definite, the next attempt adds more stiffness.
template <int packs>
void Lines<packs>::newton_step(Progress* progress) const {
  const std::size_t last = of.nodes - 1;
  const Pack zero(0.0), one(1.0);
  Pack negative[packs], back[packs], along[packs], soft[packs], down[packs], largest[packs];
  DoubleMask steps[packs];
  factor(progress, negative);
  substitute();
  for (int p = 0; p < packs; ++p) along[p] = soft[p] = down[p] = largest[p] = zero;
  for (std::size_t i = 1; i < last; ++i)
    for (int p = 0; p < packs; ++p) {
      const Pair gained = pair(of.gained, i, p);
      along[p] += dot(gained, pair(of.solved, i, p));
      soft[p] += dot(gained, pair(of.soft, i, p));
    }
  for (int p = 0; p < packs; ++p) {
    Progress& at_p = progress[p];
    const Pack shift = load<Pack>(at_p.shift), shifts = load<Pack>(at_p.shifts);
    const Pack spring = at(of.stiffness, lane(p)) / Pack(of.length), whole = 1.0 + spring * soft[p];
    // The whole matrix is positive definite if its eigenvalues with and without the rank-one part agree (Haynsworth).
    const DoubleMask positive =
        (equal(negative[p], zero) & greater(whole, zero)) | (equal(negative[p], one) & at_least(zero, whole));
    const DoubleMask wants = set(at_p.busy) & equal(load<Pack>(at_p.trying), zero);
    steps[p] = wants & (positive | at_least(shifts, Pack(static_cast<double>(most_shifts - 1))));
    const Pack larger_shift = simd::select(equal(shift, zero), Pack(first_shift), 4.0 * shift);
    store(simd::select(steps[p], zero, simd::select(wants, larger_shift, shift)), at_p.shift);
    store(simd::select(steps[p], zero, simd::select(wants, shifts + 1.0, shifts)), at_p.shifts);
    back[p] = spring * along[p] / whole;
  }
  for (std::size_t i = 1; i < last; ++i)
    for (int p = 0; p < packs; ++p) {
      const Pair way = pair(of.solved, i, p) - back[p] * pair(of.soft, i, p);
      put(select(steps[p], way, pair(of.step, i, p)), of.step, i, p);
      put(select(steps[p], pair(of.path, i, p), pair(of.from, i, p)), of.from, i, p);
      down[p] += dot(pair(of.slope, i, p), way);
      largest[p] = larger(dot(way, way), largest[p]);
    }
  for (int p = 0; p < packs; ++p) {
    Progress& at_p = progress[p];
    const auto begin = [&](const Pack& value, double* of_lanes) {
      store(simd::select(steps[p], value, load<Pack>(of_lanes)), of_lanes);
    };
    largest[p] = square_root(largest[p]);
    begin(down[p], at_p.down);
    begin(largest[p], at_p.largest);
    begin(smaller(Pack(longest_step) / largest[p], one), at_p.share);
    begin(one, at_p.trying);
    begin(one, at_p.tries);
    begin(load<Pack>(at_p.took) + one, at_p.took);
  }
}

/// Sets path to `from` plus `share` of the step; a cable with a short step rests there. A node in contact with a round wall moves
/// in polar coordinates about the wall's centre, because a straight movement would press it in by the square of its length.
/// going: direction of movement of each node at its new position.
template <int packs>
void Lines<packs>::go(Progress* progress) const {
  Pack share[packs];
  DoubleMask moves[packs];
  for (int p = 0; p < packs; ++p) {
    share[p] = load<Pack>(progress[p].share);
    moves[p] = set(progress[p].trying);
  }
  for (std::size_t i = 1; i + 1 < of.nodes; ++i)
    for (int p = 0; p < packs; ++p) {
      const std::size_t k = lane(p);
      const Pack zero(0.0), play = at(of.play, k), far = at(of.farthest, k), near = at(of.nearest, k);
      const Pair from = pair(of.from, i, p), step = pair(of.step, i, p), place = pair(of.place, i, p);
      const Pair offset = from - place;
      const DoubleMask on_play = greater(dot(offset, offset), play * play);
      const Pair centre = select(on_play, place, {zero, zero}), arm = from - centre;
      const Pack reach2 = dot(arm, arm);
      const DoubleMask round = (on_play | at_least(reach2, far * far) | at_least(near * near, reach2)) &
                               greater(reach2, zero) & moves[p];
      Pair path = from + share[p] * step, going = step;
      if (bits(round)) {
        const Pack reach = square_root(reach2), per_reach = 1.0 / reach;
        const Pair out = per_reach * arm, across{-out.y, out.x};
        const Pack rise = dot(out, step), turn = dot(across, step) * per_reach;
        // turn by 2 atan(half), equal to the angle up to the third power, without sine and cosine
        const Pack half = 0.5 * share[p] * turn, scale = 1.0 / (1.0 + half * half);
        const Pack cosine = (1.0 - half * half) * scale, sine = 2.0 * half * scale;
        const Pair now{out.x * cosine - out.y * sine, out.x * sine + out.y * cosine};
        const Pair turned{across.x * cosine - across.y * sine, across.x * sine + across.y * cosine};
        const Pack far_out = reach + share[p] * rise;
        path = select(round, centre + far_out * now, path);
        going = select(round, rise * now + (far_out * turn * scale) * turned, going);
      }
      put(select(moves[p], path, pair(of.path, i, p)), of.path, i, p);
      put(going, of.going, i, p);
    }
  for (int p = 0; p < packs; ++p) {
    const DoubleMask rests = moves[p] & greater(Pack(at_rest), load<Pack>(progress[p].largest));
    if (!bits(rests)) continue;
    store(simd::select(rests, Pack(0.0), load<Pack>(progress[p].busy)), progress[p].busy);
    store(simd::select(rests, Pack(0.0), load<Pack>(progress[p].trying)), progress[p].trying);
    if (of.press) put_press(p);
  }
}

template <int packs>
Pack Lines<packs>::along_way(int p) const {
  Pack sum(0.0);
  for (std::size_t i = 1; i + 1 < of.nodes; ++i) sum += dot(pair(of.slope, i, p), pair(of.going, i, p));
  return sum;
}

/// Does one iteration for each cable: the slope of the energy, then a step of Newton's method or a shorter share of the last one.
template <int packs>
__attribute__((flatten)) void Lines<packs>::round(int most, Progress* progress) const {
  answer();
  slopes<true>();
  judge(most, progress);
  newton_step(progress);
  go(progress);
}

/// Copies `rows` numbers of a cable from one batch to another.
void copy(const double* from, std::size_t from_lanes, double* to, std::size_t to_lanes, std::size_t rows) {
  for (std::size_t i = 0; i < rows; ++i) to[i * to_lanes] = from[i * from_lanes];
}

void to_bench(const WaitingCable& cable, const LineBatch& bench, std::size_t lane) {
  const LineBatch& kept = *cable.kept;
  for (const auto row : what_cables_are) (bench.*row)[lane] = (kept.*row)[cable.lane];
  for (const auto row : where_cables_are)
    copy(kept.*row + cable.lane, kept.lanes, bench.*row + lane, bench.lanes, 2 * bench.nodes);
}

void from_bench(const LineBatch& bench, std::size_t lane, const WaitingCable& cable) {
  const LineBatch& kept = *cable.kept;
  copy(bench.path + lane, bench.lanes, kept.path + cable.lane, kept.lanes, 2 * bench.nodes);
  if (bench.press) copy(bench.press + lane, bench.lanes, kept.press + cable.lane, kept.lanes, bench.nodes);
}

/// Cables have no influence on each other.
void relax(const LineBatch& room, const WaitingCable* cables, std::size_t count, int most) {
  constexpr int packs = 2;
  LineBatch bench = room;
  bench.lanes = packs * pack_size;
  Progress progress[packs];
  const WaitingCable* in_lane[packs * pack_size] = {};
  std::size_t next = 0;
  const auto take = [&](std::size_t lane) {
    in_lane[lane] = next < count ? &cables[next++] : nullptr;
    if (!in_lane[lane]) return;
    to_bench(*in_lane[lane], bench, lane);
    progress[lane / pack_size].begin(static_cast<int>(lane % pack_size));
  };
  for (std::size_t lane = 0; lane < packs * pack_size; ++lane) {
    take(lane);
    if (!in_lane[lane]) to_bench(cables[0], bench, lane);  // valid numbers for a spare lane
  }
  const auto busy = [&](int p) { return bits(set(progress[p].busy)) != 0; };
  while (busy(0) || busy(1)) {
    if (!busy(1))
      Lines<1>{bench, 0}.round(most, progress);
    else if (!busy(0))
      Lines<1>{bench, pack_size}.round(most, progress + 1);
    else
      Lines<packs>{bench, 0}.round(most, progress);
    for (std::size_t lane = 0; lane < packs * pack_size; ++lane) {
      const Progress& at_lane = progress[lane / pack_size];
      if (!in_lane[lane] || at_lane.busy[lane % pack_size] > 0) continue;
      *in_lane[lane]->iterations = static_cast<std::int32_t>(at_lane.took[lane % pack_size]);
      from_bench(bench, lane, *in_lane[lane]);
      take(lane);
    }
  }
}

// ---- from sample to sample ---------------------------------------------------------------------------------

inline Pair turned(const Pair& of, const Pair& by) { return {of.x * by.x - of.y * by.y, of.x * by.y + of.y * by.x}; }
inline Pair turned_back(const Pair& of, const Pair& by) { return {of.x * by.x + of.y * by.y, of.y * by.x - of.x * by.y}; }
inline Pack length(const Pair& of) { return square_root(dot(of, of)); }

/// Returns the position after the same movement as in the previous sample. The distance from the hose's axis changes by the same
/// amount as before, because on a straight line a cable that slides along a round wall would leave it.
inline Pair gone_on(const Pair& at, const Pair& way) {
  const Pair to = at + way;
  const Pack distance = length(to), before = length(at), wanted = 2.0 * before - length(at - way);
  const DoubleMask round = greater(wanted, Pack(0.0)) & greater(2.0 * distance, before);
  return select(round, (wanted / distance) * to, to);
}

void begin(const LineBatch& batch, const LineMemory& memory, const HoseFrame& hose, double ahead) {
  const std::size_t last = batch.nodes - 1;
  for (std::size_t i = 0; i <= last; ++i)
    for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
      const Lines<1> lines{batch, k};
      const Pair frame = lines.pair(memory.frame, i, 0), at = lines.pair(batch.path, i, 0);
      const Pair place = turned(lines.pair(memory.laid, i, 0), frame);
      lines.put(Lines<1>::same(hose.rest, i) + turned(lines.pair(memory.laid_bent, i, 0), Lines<1>::same(hose.turn, i)),
                batch.rest, i, 0);
      lines.put(place, batch.place, i, 0);
      lines.put(turned(at, frame), batch.before, i, 0);
      const bool clamped = i == 0 || i == last;
      const Pair path = ahead == 0 ? at : gone_on(at, Pack(ahead) * lines.pair(memory.velocity, i, 0));
      lines.put(clamped ? place : turned(path, frame), batch.path, i, 0);
    }
}

void follow(const LineBatch& batch, const LineAnswer& answer) {
  const std::size_t last = batch.nodes - 1;
  const Pack half(0.5), inverse(1 / (batch.spacing * batch.spacing));
  for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
    const Lines<1> lines{batch, k};
    Pair behind = lines.pair(batch.path, 1, 0), here = lines.pair(batch.path, 0, 0);  // beyond a clamp: the mirror image
    Pack rate_behind(0.0), sum(0.0);
    for (std::size_t i = 0; i <= last; ++i) {
      const Pair K = Lines<1>::same(batch.curvature, i);
      const Pair ahead = i < last ? lines.pair(batch.path, i + 1, 0) : behind, way = here - behind;
      const Pack rate = Pack(batch.elongation[i]) - dot(K, here);
      if (i > 0) {
        const Pack gain = half * (rate_behind + rate + inverse * dot(way, way));
        store(gain, answer.gain + (i - 1) * batch.lanes + k);
        sum += gain;
      }
      lines.put(K - lines.pair(batch.rest, i, 0) + inverse * ((behind - here) + (ahead - here)), answer.bends, i, 0);
      rate_behind = rate;
      behind = here;
      here = ahead;
    }
    store(sum / Pack(static_cast<double>(last)), answer.mean_gain + k);
  }
}

void tell(const LineBatch& batch, const LineMemory& memory, const HoseFrame& hose, const LineAnswer& answer) {
  const std::size_t last = batch.nodes - 1;
  for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
    const Lines<1> lines{batch, k};
    Pack bent(0.0), missed(0.0);
    Pair own_behind{bent, bent}, own_here = own_behind;  // curvature of the path in a straight hose
    for (std::size_t i = 0; i <= last; ++i) {
      const Pair bends = lines.pair(answer.bends, i, 0), turn = Lines<1>::same(hose.turn, i);
      const Pair from_rest = bends + Lines<1>::same(hose.rest, i), own = from_rest - Lines<1>::same(batch.curvature, i);
      if (i > 0 && i < last) bent += dot(from_rest, from_rest);
      if (i > 1) {
        const Pair wave = (own_behind - own_here) + (own - own_here);
        missed += dot(wave, wave);
      }
      lines.put(turned_back(bends, turn), answer.hose_bends, i, 0);
      lines.put(turned_back(lines.pair(batch.path, i, 0), turn) - lines.pair(memory.laid, i, 0), answer.offset, i, 0);
      own_behind = own_here;
      own_here = own;
    }
    store(at(answer.bent, k) + bent, answer.bent + k);
    store(at(answer.missed, k) + missed / Pack(144.0), answer.missed + k);
  }
}

void end(const LineBatch& batch, const LineMemory& memory, double time) {
  for (std::size_t i = 0; i < batch.nodes; ++i)
    for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
      const Lines<1> lines{batch, k};
      const Pair frame = lines.pair(memory.frame, i, 0), at = lines.pair(batch.path, i, 0);
      if (time > 0)
        lines.put(Pack(1 / time) * turned_back(at - lines.pair(batch.before, i, 0), frame), memory.velocity, i, 0);
      lines.put(turned_back(at, frame), batch.path, i, 0);
    }
}

// ---- rings ------------------------------------------------------------------------------------------------

void place(const LineBatch& batch, const double* laid, const double* frame, bool with_slope) {
  for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
    const Lines<1> lines{batch, k};
    for (std::size_t i = 1; i + 1 < batch.nodes; ++i) {
      const Pair by = Lines<1>::same(frame, i), a0 = lines.pair(laid, i, 0);
      lines.put(turned(a0, by), batch.path, i, 0);
    }
    if (!with_slope) continue;
    lines.answer();
    lines.slopes<false>();
  }
}

/// Returns the direction of a cable's movement when its ring turns.
inline Pair across(const Pair& path) { return {-path.y, path.x}; }

void slope_of_turn(const LineBatch& batch, double* slope) {
  for (std::size_t i = 1; i + 1 < batch.nodes; ++i) {
    Pack sum(0.0);
    for (std::size_t k = 0; k < batch.lanes; k += pack_size) {
      const Lines<1> lines{batch, k};
      sum += at(batch.counts, k) * dot(lines.pair(batch.slope, i, 0), across(lines.pair(batch.path, i, 0)));
    }
    slope[i - 1] = sum_of_lanes(sum);
  }
}

void assemble_turn(const LineBatch& batch, const RingSystem& system) {
  const std::size_t last = batch.nodes - 1, lanes = batch.lanes;
  const double h = batch.spacing;
  for (std::size_t i = 1; i < last; ++i) {
    const bool at_clamp = i == 1 || i + 1 == last;
    Pack own(0.0), next(0.0), after(0.0);
    for (std::size_t k = 0; k < lanes; k += pack_size) {
      const Lines<1> lines{batch, k};
      const Pack counts = at(batch.counts, k), pulled = at(batch.tension, k) * Pack(1 / h);
      const Pack bending = at(batch.bending_stiffness, k) * Pack(1 / (h * h * h));
      const Pair A = lines.pair(batch.path, i, 0), slope = lines.pair(batch.slope, i, 0);
      const Pack diagonal = (at_clamp ? 7.0 : 6.0) * bending + 2.0 * pulled + Pack(h) * at(batch.drag, k);
      own += counts * (diagonal * dot(A, A) - dot(slope, A));
      if (i + 1 < last) next += counts * (4.0 * bending + pulled) * dot(A, lines.pair(batch.path, i + 1, 0));
      if (i + 2 < last) after += counts * bending * dot(A, lines.pair(batch.path, i + 2, 0));
      store(Pack(counts * dot(lines.pair(batch.gained, i, 0), across(A))),
            system.table + (i - 1) * lanes + k);
    }
    double* const row = system.bands + 3 * (i - 1);
    row[0] = sum_of_lanes(own);
    row[1] = -sum_of_lanes(next);
    row[2] = sum_of_lanes(after);
  }
}

void substitute_turn(const double* bands, std::size_t rows, std::size_t lanes, double* table) {
  for (std::size_t k = 0; k < lanes; k += pack_size) {
    Pack before(0.0), before2(0.0);  // of the two previous rows
    for (std::size_t i = 0; i < rows; ++i) {
      double* const at_row = table + i * lanes + k;
      Pack x = load<Pack>(at_row);
      if (i > 0) x -= Pack(bands[3 * (i - 1) + 1]) * before;
      if (i > 1) x -= Pack(bands[3 * (i - 2) + 2]) * before2;
      store(x, at_row);
      before2 = before;
      before = x;
    }
    Pack after(0.0), after2(0.0);
    for (std::size_t i = rows; i-- > 0;) {
      double* const at_row = table + i * lanes + k;
      const Pack x = load<Pack>(at_row) / Pack(bands[3 * i]) - Pack(bands[3 * i + 1]) * after -
                     Pack(bands[3 * i + 2]) * after2;
      store(x, at_row);
      after2 = after;
      after = x;
    }
  }
}

/// A sum depends on that of the previous row, so eight columns are summed at a time.
void products(const double* a, const double* b, std::size_t rows, std::size_t lanes, double* product) {
  for (std::size_t k = 0; k < lanes; k += most_lanes)
    for (std::size_t j = 0; j < lanes; j += pack_size) {
      Pack sum[most_lanes];
      for (Pack& of : sum) of = Pack(0.0);
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t c = 0; c < most_lanes; ++c)
          sum[c] += Pack(a[i * lanes + k + c]) * load<Pack>(b + i * lanes + j);
      for (std::size_t c = 0; c < most_lanes; ++c) store(sum[c], product + (k + c) * lanes + j);
    }
}

}  // namespace

extern const LooseKernels set;
const LooseKernels set{relax, begin, follow, tell, end, place, assemble_turn, slope_of_turn, substitute_turn, products};

}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
