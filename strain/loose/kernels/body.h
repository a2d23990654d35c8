// The hot loops of loose cables for one instruction set. portable.cpp, avx2.cpp and avx512.cpp include this file, each for its
// own set (pipeline/base/simd.h).
//
// Along a cable each node depends on the previous one. One pass therefore computes the slope, the contacts and the elimination of
// a node, so that the contacts of one node use the waiting time of another. Cables need 2 to 60 iterations: a cable at rest gives
// its lane to the next.
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
constexpr int most_shifts = 60;  // by factors of four: more than any cable needs
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
  double down[pack_size] = {}, largest[pack_size] = {};  // of the step: slope along it, largest movement of a node [m]
  double shift[pack_size] = {}, shifts[pack_size] = {};  // added stiffness per length [N/m2], and number of increases
  double took[pack_size] = {};                           // number of iterations

  void begin(int lane) {
    busy[lane] = 1;
    trying[lane] = shift[lane] = shifts[lane] = took[lane] = 0;
  }
};

inline DoubleMask set(const double* of) { return greater(load<Pack>(of), Pack(0.0)); }

/// A pack of cables, starting at lane `first`.
struct Lines {
  const LineBatch& of;
  std::size_t first;

  Pair pair(const double* values, std::size_t node) const {
    const double* const from = values + 2 * node * of.lanes + first;
    return {load<Pack>(from), load<Pack>(from + of.lanes)};
  }
  void put(const Pair& pair, double* values, std::size_t node) const {
    double* const to = values + 2 * node * of.lanes + first;
    store(pair.x, to);
    store(pair.y, to + of.lanes);
  }
  static Pair same(const double* values, std::size_t node) {
    return {Pack(values[2 * node]), Pack(values[2 * node + 1])};
  }

  void answer() const;
  Pair sideways(const Pair& path, const Pair& offset) const;
  template <class Use>
  void walk(const Use& use) const;
  struct Touch;
  void contacts(std::size_t node, Touch& touch) const;
  void rub(std::size_t node, Touch& touch) const;
  void put_friction() const;
  struct Elimination;
  Pack eliminate(Elimination& elimination, bool searches) const;
  void judge(int most, const Pack& there, Progress& progress) const;
  DoubleMask newton_step(const Elimination& done, Progress& progress) const;
  Pack substitute(const DoubleMask& steps, const Pack& back) const;
  void go(const DoubleMask& steps, Progress& progress) const;
  void round(int most, Progress& progress) const;
};

/// Computes strain and tension from the gain of the path (W33), and the derivative of the tension by the gain.
inline void Lines::answer() const {
  const std::size_t last = of.nodes - 1;
  const double per_length = 0.5 / (of.spacing * of.spacing);
  Pack ends(0.0), inside(0.0), steep(0.0);
  Pair before{ends, ends};
  for (std::size_t i = 0; i <= last; ++i) {
    const Pair A = pair(of.path, i);
    const Pack bent = Pack(of.elongation[i]) - dot(same(of.curvature, i), A);
    if (i == 0) {
      ends = bent;
    } else {
      const Pair way = A - before;
      steep += dot(way, way);
      if (i < last) inside += bent;
      if (i == last) ends += bent;
    }
    before = A;
  }
  const Pack sum = inside + 0.5 * ends + per_length * steep;
  const Pack rate = at(of.free_length_rate, first), mean = sum / Pack(static_cast<double>(last));
  const Pack tried = (1.0 + mean) / rate - 1.0 - at(of.slipped, first);
  const Pack strain = smaller(larger(tried, at(of.least_strain, first)), at(of.most_strain, first));
  const Pack EA = at(of.axial_stiffness, first);
  store(strain, of.strain + first);
  store(EA * strain, of.tension + first);
  store(simd::select(equal(strain, tried), EA / rate, Pack(0.0)), of.stiffness + first);
}

/// Contributions of contact and friction at one node, per length.
struct Lines::Touch {
  Pack press, by_neighbours, xx, xy, yy;  // by_neighbours: part of press
  Pair slope;

  inline Touch() : press(0.0), by_neighbours(0.0), xx(0.0), xy(0.0), yy(0.0), slope{Pack(0.0), Pack(0.0)} {}

  /// Adds friction along a direction. moved: from the point where the cable sticks. most: largest force.
  inline void add_friction(const Pair& direction, const Pack& moved, const Pack& stick, const Pack& most) {
    const Pack held = stick * moved, force = smaller(larger(held, -most), most);
    const Pack stiffness = simd::select(equal(held, force), stick, Pack(0.0));
    slope = slope + force * direction;
    xx += stiffness * direction.x * direction.x;
    yy += stiffness * direction.y * direction.y;
    xy += stiffness * direction.x * direction.y;
  }

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

inline void Lines::contacts(std::size_t node, Touch& touch) const {
  const std::size_t k = first;
  const Pack zero(0.0), wall = at(of.wall_stiffness, k);
  const Pair A = pair(of.path, node), place = pair(of.place, node), offset = A - place;
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
  if (bits(beside)) {
    const Pack others = touch.press;
    touch.add(beside, wall, side * along, depth, zero);
    touch.by_neighbours = touch.press - others;
  }
}

/// Adds dry friction (W42).
inline void Lines::rub(std::size_t node, Touch& touch) const {
  const Pack stick = at(of.stick, first);
  if (!bits(greater(stick, Pack(0.0)))) return;
  const Pair around = pair(of.around, node), out{around.y, -around.x};
  const Pair moved = pair(of.path, node) - pair(of.before, node);
  const Pair stretch = pair(of.stretch, node), most = pair(of.most_friction, node);
  touch.add_friction(around, stretch.x + dot(around, moved), stick, most.x);
  touch.add_friction(out, stretch.y + dot(out, moved), stick, most.y);
}

/// Moves the points where cables stick: the displacement from them is at most that at the largest friction, before and now. Stores
/// the contact forces if the batch has `press`.
inline void Lines::put_friction() const {
  const Pack stick = at(of.stick, first), zero(0.0);
  const Pack friction = at(of.friction, first), load = at(of.line_load, first);
  const Pack soft = simd::select(greater(stick, zero), 1.0 / stick, zero);
  for (std::size_t i = 1; i + 1 < of.nodes; ++i) {
    Touch touch;
    contacts(i, touch);
    const Pair around = pair(of.around, i), out{around.y, -around.x};
    const Pair moved = pair(of.path, i) - pair(of.before, i);
    const Pair stretch = pair(of.stretch, i), before = pair(of.most_friction, i);
    const Pair most{friction * (load + touch.press - touch.by_neighbours), friction * touch.by_neighbours};
    const auto held = [&](const Pack& to, const Pack& one, const Pack& other) {
      const Pack farthest = soft * smaller(one, other);
      return smaller(larger(to, -farthest), farthest);
    };
    put({held(stretch.x + dot(around, moved), before.x, most.x), held(stretch.y + dot(out, moved), before.y, most.y)},
        of.stretch, i);
    put(most, of.most_friction, i);
    if (of.press) store(touch.press, of.press + i * of.lanes + first);
  }
}

/// Computes the gain of the path and the slope of the energy without contact at each inner node, and calls
/// use(node, gained, slope).
template <class Use>
inline void Lines::walk(const Use& use) const {
  const std::size_t last = of.nodes - 1;
  const double h = of.spacing, per_h = 1 / h, per_h2 = per_h * per_h;
  Pair here = pair(of.path, 0), next = pair(of.path, 1);
  // A clamp holds the cable as it was laid: beyond it is the mirror image, also of its place in `rest`.
  Pair bent_before = here, bent_here = same(of.curvature, 0) - pair(of.rest, 0) + Pack(2 * per_h2) * (next - here);
  const Pack bending = at(of.bending_stiffness, first) * Pack(per_h), mass = at(of.mass_per_length, first) * Pack(h);
  const Pack drag = at(of.drag, first) * Pack(h), tension = at(of.tension, first);
  for (std::size_t i = 0; i < last; ++i) {
    const Pair hose_bends = same(of.curvature, i + 1), K = Pack(h) * same(of.curvature, i), pull = same(of.pull, i);
    const Pair after = i + 2 <= last ? pair(of.path, i + 2) : here;
    const Pair bent_next = hose_bends - pair(of.rest, i + 1) + Pack(per_h2) * ((here - next) + (after - next));
    if (i > 0) {
      const Pair gained = Pack(per_h) * ((here - pair(of.path, i - 1)) - (next - here)) - K;
      const Pair slope = bending * ((bent_before - bent_here) + (bent_next - bent_here)) + tension * gained -
                         mass * pull + drag * (here - pair(of.before, i));
      use(i, gained, slope);
    }
    bent_before = bent_here;
    bent_here = bent_next;
    here = next;
    next = after;
  }
}

constexpr int sides = 2;  // right-hand sides of the linear system: -slope and gained

/// Forward elimination, node after node: L D L^T of bending, tension, drag and contact, and its right-hand sides.
/// Stores for each node the inverse of its pivot, this inverse times the coupling to the next node, and the right-hand sides
/// times the inverse. negative: number of negative pivots, which is that of negative eigenvalues (Sylvester). With the inverse
/// matrix M, products are known before the back substitution, because r M s is the sum of the nodes' products in the elimination.
struct Lines::Elimination {
  Pack tied2, tie, diagonal, negative;
  Pack downhill, along, soft;  // slope M slope, -slope M gained, gained M gained
  // result of eliminating the previous nodes: for the diagonals of this node and the next, and for the coupling
  Pack here_xx, here_xy, here_yy, next_xx, next_xy, next_yy;
  Pack xx, xy, yx, yy;
  Pair here[sides], next[sides];  // to be subtracted from the right-hand sides of this node and the next

  inline Elimination(const LineBatch& of, std::size_t k, const Pack& shift) {
    const double h = of.spacing;
    tied2 = at(of.bending_stiffness, k) * Pack(1 / (h * h * h));
    const Pack pulled = at(of.tension, k) * Pack(1 / h);
    tie = -4.0 * tied2 - pulled;
    diagonal = 6.0 * tied2 + 2.0 * pulled + Pack(h) * (at(of.drag, k) + shift);
    negative = downhill = along = soft = Pack(0.0);
    here_xx = here_xy = here_yy = next_xx = next_xy = next_yy = Pack(0.0);
    xx = xy = yx = yy = Pack(0.0);
    for (int s = 0; s < sides; ++s) here[s] = next[s] = {Pack(0.0), Pack(0.0)};
  }
  inline void add(const Lines& lines, std::size_t i, const Touch& touch, const Pair (&right)[sides]) {
    const LineBatch& batch = lines.of;
    const std::size_t last = batch.nodes - 1, lanes = batch.lanes;
    const double h = batch.spacing;
    const bool at_clamp = i == 1 || i + 1 == last;
    const Pack own = at_clamp ? diagonal + tied2 : diagonal;
    const Pack dxx = own + Pack(h) * touch.xx + here_xx;
    const Pack dyy = own + Pack(h) * touch.yy + here_yy;
    const Pack dxy = Pack(h) * touch.xy + here_xy;
    const Pack determinant = dxx * dyy - dxy * dxy, inverse = 1.0 / determinant;
    negative += simd::select(greater(Pack(0.0), determinant), Pack(1.0),
                             simd::select(greater(Pack(0.0), dxx + dyy), Pack(2.0), Pack(0.0)));
    const Pack ixx = dyy * inverse, ixy = -(dxy * inverse), iyy = dxx * inverse;
    const Pack exx = tie + xx, exy = xy, eyx = yx, eyy = tie + yy;
    const Pack f_xx = ixx * exx + ixy * eyx, f_xy = ixx * exy + ixy * eyy;
    const Pack f_yx = ixy * exx + iyy * eyx, f_yy = ixy * exy + iyy * eyy;
    double* const to = batch.factors + 7 * i * lanes + lines.first;
    const Pack values[] = {ixx, ixy, iyy, f_xx, f_xy, f_yx, f_yy};
    for (std::size_t v = 0; v < 7; ++v) store(values[v], to + v * lanes);
    here_xx = next_xx - exx * f_xx - eyx * f_yx;
    here_xy = next_xy - exx * f_xy - eyx * f_yy;
    here_yy = next_yy - exy * f_xy - eyy * f_yy;
    const Pack far = -(tied2 * tied2);
    next_xx = far * ixx, next_xy = far * ixy, next_yy = far * iyy;
    xx = -(tied2 * f_xx), xy = -(tied2 * f_yx), yx = -(tied2 * f_xy), yy = -(tied2 * f_yy);
    double* const solution[sides] = {batch.solved, batch.soft};
    Pair y[sides], x[sides];
    for (int s = 0; s < sides; ++s) {
      y[s] = right[s] - here[s];
      x[s] = {ixx * y[s].x + ixy * y[s].y, ixy * y[s].x + iyy * y[s].y};
      lines.put(x[s], solution[s], i);
      here[s] = next[s] + Pair{f_xx * y[s].x + f_yx * y[s].y, f_xy * y[s].x + f_yy * y[s].y};
      next[s] = tied2 * x[s];
    }
    downhill += dot(y[0], x[0]);
    along += dot(y[1], x[0]);
    soft += dot(y[1], x[1]);
  }
};

/// Computes the slope of the energy at each inner node, with contact, and eliminates along the cable. Returns the slope along the
/// last step if `searches`, else 0.
inline Pack Lines::eliminate(Elimination& elimination, bool searches) const {
  Pack there(0.0);
  const Pack h(of.spacing);
  walk([&](std::size_t i, const Pair& gained, const Pair& without_contact) {
    Touch touch;
    contacts(i, touch);
    rub(i, touch);
    const Pair slope = without_contact + h * touch.slope;
    if (searches) there += dot(slope, pair(of.going, i));
    elimination.add(*this, i, touch, {{-slope.x, -slope.y}, gained});
  });
  return there;
}

/// Back substitution: `step` becomes the solution for -slope minus `back` times that for gained, in the lanes of `steps`. Returns
/// the square of the largest movement of a node.
inline Pack Lines::substitute(const DoubleMask& steps, const Pack& back) const {
  const std::size_t last = of.nodes - 1, lanes = of.lanes;
  const Pack tied2 = at(of.bending_stiffness, first) * Pack(1 / (of.spacing * of.spacing * of.spacing));
  Pack largest(0.0);
  Pair near{largest, largest}, after = near;  // of the two nodes behind
  for (std::size_t i = last - 1; i > 0; --i) {
    const double* const f = of.factors + 7 * i * lanes + first;
    const Pack ixx = load<Pack>(f), ixy = load<Pack>(f + lanes), iyy = load<Pack>(f + 2 * lanes);
    const Pack exx = load<Pack>(f + 3 * lanes), exy = load<Pack>(f + 4 * lanes);
    const Pack eyx = load<Pack>(f + 5 * lanes), eyy = load<Pack>(f + 6 * lanes);
    const Pair far = tied2 * after, y = pair(of.solved, i) - back * pair(of.soft, i);
    const Pair x = y - Pair{ixx * far.x + ixy * far.y, ixy * far.x + iyy * far.y} -
                   Pair{exx * near.x + exy * near.y, eyx * near.x + eyy * near.y};
    put(select(steps, x, pair(of.step, i)), of.step, i);
    largest = larger(dot(x, x), largest);
    after = near;
    near = x;
  }
  return largest;
}

/// Returns the lanes whose step is taken as a whole.
inline DoubleMask whole_steps(const Progress& progress) {
  return at_least(Pack(whole_step), load<Pack>(progress.largest)) &
         at_least(Pack(static_cast<double>(most_whole_steps)), load<Pack>(progress.took));
}

/// Returns whether any cable searches along its step.
inline bool any_searches(const Progress& progress) { return bits(set(progress.trying)) & ~bits(whole_steps(progress)); }

/// Decides for cables that try a step: accept its share, try a shorter one, or give up.
inline void Lines::judge(int most, const Pack& there, Progress& progress) const {
  const Pack zero(0.0);
  const Pack down = load<Pack>(progress.down), share = load<Pack>(progress.share), tries = load<Pack>(progress.tries);
  const DoubleMask good =
      whole_steps(progress) | at_least(-0.5 * down, there) | at_least(tries, Pack(static_cast<double>(most_tries)));
  const DoubleMask ends =
      set(progress.trying) & good & at_least(load<Pack>(progress.took), Pack(static_cast<double>(most)));
  const Pack shorter = smaller(larger(-down / (there - down), Pack(0.1)), Pack(0.7));
  store(simd::select(good, share, share * shorter), progress.share);
  store(tries + 1.0, progress.tries);
  store(simd::select(ends, zero, load<Pack>(progress.busy)), progress.busy);
  store(simd::select(good, zero, load<Pack>(progress.trying)), progress.trying);
}

/// Computes the step to the minimum of the local quadratic, for cables that do not try one. If the quadratic is not positive
/// definite, the next attempt adds more stiffness. Returns the lanes with a new step.
inline DoubleMask Lines::newton_step(const Elimination& done, Progress& progress) const {
  const Pack zero(0.0), one(1.0);
  const Pack shift = load<Pack>(progress.shift), shifts = load<Pack>(progress.shifts);
  const Pack spring = at(of.stiffness, first) / Pack(of.length), whole = 1.0 + spring * done.soft;
  // The whole matrix is positive definite if its eigenvalues with and without the rank-one part agree (Haynsworth).
  const DoubleMask positive =
      (equal(done.negative, zero) & greater(whole, zero)) | (equal(done.negative, one) & at_least(zero, whole));
  const DoubleMask wants = set(progress.busy) & equal(load<Pack>(progress.trying), zero);
  const DoubleMask steps = wants & (positive | at_least(shifts, Pack(static_cast<double>(most_shifts - 1))));
  const Pack larger_shift = simd::select(equal(shift, zero), Pack(first_shift), 4.0 * shift);
  store(simd::select(steps, zero, simd::select(wants, larger_shift, shift)), progress.shift);
  store(simd::select(steps, zero, simd::select(wants, shifts + 1.0, shifts)), progress.shifts);
  const Pack back = spring * done.along / whole, largest = square_root(substitute(steps, back));
  const auto begin = [&](const Pack& value, double* of_lanes) {
    store(simd::select(steps, value, load<Pack>(of_lanes)), of_lanes);
  };
  begin(back * done.along - done.downhill, progress.down);
  begin(largest, progress.largest);
  begin(smaller(Pack(longest_step) / largest, one), progress.share);
  begin(one, progress.trying);
  begin(one, progress.tries);
  begin(load<Pack>(progress.took) + one, progress.took);
  return steps;
}

/// Moves the path by `share` of the step; a cable with a short step rests there. A node in contact with a round wall moves in polar
/// coordinates about the wall's centre, because a straight movement would press it in by the square of its length. steps: lanes
/// with a new step. Stores what a search along the step needs: `from`, where it begins, and `going`, the direction of movement
/// of each node at its new position.
inline void Lines::go(const DoubleMask& steps, Progress& progress) const {
  const Pack share = load<Pack>(progress.share), zero(0.0);
  const DoubleMask moves = set(progress.trying);
  const bool searches = any_searches(progress);
  const Pack play = at(of.play, first), far = at(of.farthest, first), near = at(of.nearest, first);
  for (std::size_t i = 1; i + 1 < of.nodes; ++i) {
    const Pair at_first = pair(of.path, i), step = pair(of.step, i), place = pair(of.place, i);
    const Pair from = searches ? select(steps, at_first, pair(of.from, i)) : at_first;
    const Pair offset = from - place;
    const DoubleMask on_play = greater(dot(offset, offset), play * play);
    const Pair centre = select(on_play, place, {zero, zero}), arm = from - centre;
    const Pack reach2 = dot(arm, arm);
    const DoubleMask round =
        (on_play | at_least(reach2, far * far) | at_least(near * near, reach2)) & greater(reach2, zero) & moves;
    Pair path = from + share * step, going = step;
    if (bits(round)) {
      // rise, turn: of the step, over the distance from the centre. The turn is by 2 atan(half), half = share turn/2, equal to the
      // angle up to the third power, without sine and cosine. One division gives 1/reach2 and 1/(1 + half^2).
      const Pair across{-arm.y, arm.x};
      const Pack side = 0.5 * share * dot(across, step), reach4 = reach2 * reach2, sum = reach4 + side * side;
      const Pack inverse = 1.0 / (reach2 * sum), per_reach2 = sum * inverse, scale = reach4 * (reach2 * inverse);
      const Pack rise = per_reach2 * dot(arm, step), turn = per_reach2 * dot(across, step), half = side * per_reach2;
      const Pack cosine = (1.0 - half * half) * scale, sine = 2.0 * half * scale, stretch = 1.0 + share * rise;
      const Pair now{arm.x * cosine - arm.y * sine, arm.x * sine + arm.y * cosine};
      path = select(round, centre + stretch * now, path);
      if (searches) going = select(round, rise * now + (stretch * turn * scale) * Pair{-now.y, now.x}, going);
    }
    put(select(moves, path, at_first), of.path, i);
    if (!searches) continue;
    put(from, of.from, i);
    put(going, of.going, i);
  }
  const DoubleMask rests = moves & greater(Pack(at_rest), load<Pack>(progress.largest));
  store(simd::select(rests, zero, load<Pack>(progress.busy)), progress.busy);
  store(simd::select(rests, zero, load<Pack>(progress.trying)), progress.trying);
}

/// Does one iteration for each cable: the slope of the energy, then a step of Newton's method or a shorter share of the last one.
__attribute__((flatten)) void Lines::round(int most, Progress& progress) const {
  answer();
  Elimination elimination(of, first, load<Pack>(progress.shift));
  const Pack there = eliminate(elimination, any_searches(progress));
  judge(most, there, progress);
  go(newton_step(elimination, progress), progress);
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
  if (kept.stick[cable.lane] == 0) return;
  for (const auto row : how_cables_rub)
    copy(kept.*row + cable.lane, kept.lanes, bench.*row + lane, bench.lanes, 2 * bench.nodes);
}

void from_bench(const LineBatch& bench, std::size_t lane, const WaitingCable& cable) {
  const LineBatch& kept = *cable.kept;
  copy(bench.path + lane, bench.lanes, kept.path + cable.lane, kept.lanes, 2 * bench.nodes);
}

/// Cables have no influence on each other.
void relax(const LineBatch& room, const WaitingCable* cables, std::size_t count, int most) {
  LineBatch bench = room;
  bench.lanes = bench.cables = pack_size;
  Progress progress;
  const WaitingCable* in_lane[pack_size] = {};
  std::size_t next = 0;
  const auto take = [&](std::size_t lane) {
    in_lane[lane] = next < count ? &cables[next++] : nullptr;
    if (!in_lane[lane]) return;
    to_bench(*in_lane[lane], bench, lane);
    progress.begin(static_cast<int>(lane));
  };
  for (std::size_t lane = 0; lane < pack_size; ++lane) {
    take(lane);
    if (!in_lane[lane]) to_bench(cables[0], bench, lane);  // valid numbers for a spare lane
  }
  while (bits(set(progress.busy))) {
    Lines{bench, 0}.round(most, progress);
    for (std::size_t lane = 0; lane < pack_size; ++lane) {
      if (!in_lane[lane] || progress.busy[lane] > 0) continue;
      *in_lane[lane]->iterations = static_cast<std::int32_t>(progress.took[lane]);
      from_bench(bench, lane, *in_lane[lane]);
      take(lane);
    }
  }
}

// ---- from sample to sample ---------------------------------------------------------------------------------

inline Pair turned(const Pair& of, const Pair& by) { return {of.x * by.x - of.y * by.y, of.x * by.y + of.y * by.x}; }
inline Pair turned_back(const Pair& of, const Pair& by) {
  return {of.x * by.x + of.y * by.y, of.y * by.x - of.x * by.y};
}
inline Pack length(const Pair& of) { return square_root(dot(of, of)); }

/// Returns the direction in which a cable slides on its support: around the hose's axis, or around its place if its play limits it.
inline Pair Lines::sideways(const Pair& path, const Pair& offset) const {
  const Pack play = at(of.play, first), zero(0.0);
  const Pair arm = select(greater(dot(offset, offset), play * play), offset, path);
  const Pack reach = length(arm), per_reach = simd::select(greater(reach, zero), 1.0 / reach, zero);
  return {-(per_reach * arm.y), per_reach * arm.x};
}

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
    for (std::size_t k = 0; k < batch.cables; k += pack_size) {
      const Lines lines{batch, k};
      const Pair frame = lines.pair(memory.frame, i), at = lines.pair(batch.path, i);
      const Pair place = turned(lines.pair(memory.laid, i), frame), before = turned(at, frame);
      const bool clamped = i == 0 || i == last;
      lines.put(Lines::same(hose.rest, i) + turned(lines.pair(memory.laid_bent, i), Lines::same(hose.turn, i)),
                batch.rest, i);
      lines.put(before, batch.before, i);
      if (!batch.place) {
        if (clamped) lines.put(place, batch.path, i);
        continue;
      }
      lines.put(place, batch.place, i);
      lines.put(lines.sideways(before, before - place), batch.around, i);
      const Pair path = ahead == 0 ? at : gone_on(at, Pack(ahead) * lines.pair(memory.velocity, i));
      lines.put(clamped ? place : turned(path, frame), batch.path, i);
    }
}

void follow(const LineBatch& batch, const LineAnswer& answer) {
  const std::size_t last = batch.nodes - 1;
  const Pack half(0.5), inverse(1 / (batch.spacing * batch.spacing));
  for (std::size_t k = 0; k < batch.cables; k += pack_size) {
    const Lines lines{batch, k};
    Pair behind = lines.pair(batch.path, 1), here = lines.pair(batch.path, 0);  // beyond a clamp: the mirror image
    Pack rate_behind(0.0), sum(0.0);
    for (std::size_t i = 0; i <= last; ++i) {
      const Pair K = Lines::same(batch.curvature, i);
      const Pair ahead = i < last ? lines.pair(batch.path, i + 1) : behind, way = here - behind;
      const Pack rate = Pack(batch.elongation[i]) - dot(K, here);
      if (i > 0) {
        const Pack gain = half * (rate_behind + rate + inverse * dot(way, way));
        store(gain, answer.gain + (i - 1) * batch.lanes + k);
        sum += gain;
      }
      lines.put(K - lines.pair(batch.rest, i) + inverse * ((behind - here) + (ahead - here)), answer.bends, i);
      rate_behind = rate;
      behind = here;
      here = ahead;
    }
    store(sum / Pack(static_cast<double>(last)), answer.mean_gain + k);
  }
}

void put_states(const LineBatch& batch, const LineMemory& memory, const HoseFrame& hose, const LineAnswer& answer) {
  const std::size_t last = batch.nodes - 1;
  for (std::size_t k = 0; k < batch.cables; k += pack_size) {
    const Lines lines{batch, k};
    Pack bent(0.0), missed(0.0);
    Pair own_behind{bent, bent}, own_here = own_behind;  // curvature of the path in a straight hose
    for (std::size_t i = 0; i <= last; ++i) {
      const Pair bends = lines.pair(answer.bends, i), turn = Lines::same(hose.turn, i);
      const Pair from_rest = bends + Lines::same(hose.rest, i), own = from_rest - Lines::same(batch.curvature, i);
      if (i > 0 && i < last) bent += dot(from_rest, from_rest);
      if (i > 1) {
        const Pair wave = (own_behind - own_here) + (own - own_here);
        missed += dot(wave, wave);
      }
      lines.put(turned_back(bends, turn), answer.hose_bends, i);
      lines.put(turned_back(lines.pair(batch.path, i), turn) - lines.pair(memory.laid, i), answer.offset, i);
      own_behind = own_here;
      own_here = own;
    }
    store(at(answer.bent, k) + bent, answer.bent + k);
    store(at(answer.missed, k) + missed / Pack(144.0), answer.missed + k);
  }
}

void rub(const LineBatch& batch) {
  for (std::size_t k = 0; k < batch.cables; k += pack_size) Lines{batch, k}.put_friction();
}

void end(const LineBatch& batch, const LineMemory& memory, double time) {
  for (std::size_t i = 0; i < batch.nodes; ++i)
    for (std::size_t k = 0; k < batch.cables; k += pack_size) {
      const Lines lines{batch, k};
      const Pair frame = lines.pair(memory.frame, i), at = lines.pair(batch.path, i);
      if (time > 0)
        lines.put(Pack(1 / time) * turned_back(at - lines.pair(batch.before, i), frame), memory.velocity, i);
      lines.put(turned_back(at, frame), batch.path, i);
    }
}

// ---- rings ------------------------------------------------------------------------------------------------

void place(const LineBatch& batch, const double* laid, const double* frame) {
  for (std::size_t k = 0; k < batch.cables; k += pack_size) {
    const Lines lines{batch, k};
    for (std::size_t i = 1; i + 1 < batch.nodes; ++i)
      lines.put(turned(lines.pair(laid, i), Lines::same(frame, i)), batch.path, i);
  }
}

/// Returns the direction of a cable's movement when its ring turns.
inline Pair across(const Pair& path) { return {-path.y, path.x}; }

void turn(const LineBatch& batch, const double* laid, const double* frame, const double* turned,
          const RingSystem& system) {
  place(batch, laid, frame);
  const std::size_t last = batch.nodes - 1, lanes = batch.lanes;
  const double h = batch.spacing;
  for (std::size_t k = 0; k < batch.cables; k += pack_size) {
    const Lines lines{batch, k};
    lines.answer();
    const Pack zero(0.0), counts = at(batch.counts, k), pulled = at(batch.tension, k) * Pack(1 / h);
    const Pack bending = at(batch.bending_stiffness, k) * Pack(1 / (h * h * h));
    const Pack tie = 4.0 * bending + pulled, inside = 2.0 * pulled + Pack(h) * at(batch.drag, k);
    const Pack per_radius = at(batch.per_radius, k), stick = at(batch.stick, k);
    const Pack radius = simd::select(greater(per_radius, zero), 1.0 / per_radius, zero);
    const bool is_first = k == 0, is_last = k + pack_size >= batch.cables;
    lines.walk([&](std::size_t i, const Pair& gained, const Pair& slope) {
      const bool at_clamp = i == 1 || i + 1 == last;
      const Pair A = lines.pair(batch.path, i), way = across(A);
      // friction against the turn
      const Pack most = lines.pair(batch.most_friction, i).x;
      const Pack held = stick * (lines.pair(batch.stretch, i).x + radius * Pack(turned[i]));
      const Pack force = smaller(larger(held, -most), most);
      const Pack stiffness = simd::select(equal(held, force), radius * radius * stick, zero);
      const Pack diagonal = (at_clamp ? 7.0 : 6.0) * bending + inside;
      Pack sums[] = {dot(slope, way) + Pack(h) * radius * force,
                     diagonal * dot(A, A) - dot(slope, A) + Pack(h) * stiffness, zero, zero};
      if (i + 1 < last) sums[2] = -(tie * dot(A, lines.pair(batch.path, i + 1)));
      if (i + 2 < last) sums[3] = bending * dot(A, lines.pair(batch.path, i + 2));
      double* const kept = system.sums + 4 * (i - 1) * most_lanes;
      for (std::size_t v = 0; v < 4; ++v) {
        const Pack sum = is_first ? counts * sums[v] : load<Pack>(kept + v * most_lanes) + counts * sums[v];
        if (!is_last)
          store(sum, kept + v * most_lanes);
        else
          (v == 0 ? system.slope[i - 1] : system.bands[3 * (i - 1) + v - 1]) = sum_of_lanes(sum);
      }
      store(Pack(counts * dot(gained, way)), system.table + (i - 1) * lanes + k);
    });
  }
}

void eliminate_turn(const double* bands, std::size_t rows, const LineBatch& batch, double* table, double* scaled) {
  const std::size_t lanes = batch.lanes;
  for (std::size_t k = 0; k < batch.cables; k += pack_size) {
    Pack before(0.0), before2(0.0);  // of the two previous rows
    for (std::size_t i = 0; i < rows; ++i) {
      Pack x = load<Pack>(table + i * lanes + k);
      if (i > 0) x -= Pack(bands[3 * (i - 1) + 1]) * before;
      if (i > 1) x -= Pack(bands[3 * (i - 2) + 2]) * before2;
      store(x, table + i * lanes + k);
      store(x / Pack(bands[3 * i]), scaled + i * lanes + k);
      before2 = before;
      before = x;
    }
  }
}

/// A sum depends on that of the previous row, so eight columns are summed at a time.
void products(const double* a, const double* b, std::size_t rows, const LineBatch& batch, double* product) {
  const std::size_t lanes = batch.lanes;
  for (std::size_t k = 0; k < batch.cables; k += most_lanes)
    for (std::size_t j = 0; j < batch.cables; j += pack_size) {
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
const LooseKernels set{relax, begin, follow, put_states, rub, end, place, turn, eliminate_turn, products};

}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
