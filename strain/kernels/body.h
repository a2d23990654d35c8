// The hot loops for one instruction set. portable.cpp, avx2.cpp and avx512.cpp include this file, each for its own set
// (pipeline/base/simd.h).
#include "pipeline/base/simd.h"
// simd.h declares the functions that the templates below use
#include "strain/kernels/kernels.h"
#include "strain/kernels/turning.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

using namespace simd;

// ---- strains of a bundle ----------------------------------------------------------------------------------

/// The states along a nesting at one pack of samples: rods[0] is the dresspack, rods[k] the part of level k.
struct Descent {
  ComponentState<Pack> rods[highest_level + 1];
  Pack free_strain[highest_level + 1];
};

/// Returns the part of step k in its parent `rod`. free_strain: its strain without friction. held: the strain that friction holds
/// of its deviation, at this sample. Not inlined, because copies at every call would be most of the compile time.
__attribute__((noinline, flatten)) ComponentState<Pack> step_down(const ComponentState<Pack>& rod,
                                                                  const NestingLevel& step, const Placement& place,
                                                                  const ComponentState<double>& rest,
                                                                  const Pack& free_strain, const double* held) {
  const ComponentState<Pack> glued = child(rod, place);
  if (step.slide.sliding == Sliding::glued) {
    if (step.slide.radial_share == 1) return glued;
    Series<Pack> strain =
        step.slide.radial_share * (glued.stretch * (constant_series(1.0, rest.stretch.order) / rest.stretch));
    strain.at[0] -= step.slide.radial_share;
    return slid_unevenly(glued, strain, rest, place.kinematics);
  }
  if (held == nullptr) return slid(glued, free_strain, rest, place.kinematics);
  Series<Pack> strain;
  strain.order = glued.stretch.order;
  for (int power = 0; power <= strain.order; ++power)
    strain.at[power] = load<Pack>(held + power * step.slide.held_stride);
  strain.at[0] += free_strain;
  return slid_unevenly(glued, strain, rest, place.kinematics);
}

inline const double* at_sample(const double* row, std::size_t sample) { return row ? row + sample : nullptr; }

/// Returns the parent of level `level` with the ancestor of level `turned_level` moved by `turn` sixths of its pitch.
inline ComponentState<Pack> turned_parent(const BundlePointers& nesting, const Descent& descent, int turned_level,
                                          int level, int turn, std::size_t sample) {
  const int first = turned_level - 1;
  ComponentState<Pack> rod = descent.rods[first];
  for (int k = first; k < level; ++k)
    rod = step_down(rod, nesting.steps[k], nesting.steps[k].turned[turn], nesting.steps[k].turned_rest[turn],
                    descent.free_strain[k], at_sample(nesting.steps[k].slide.turned_held[turn], sample));
  return rod;
}

/// Returns the axial strain of a component that slides. level: of its parent (0 = the dresspack).
inline Pack free_strain(const BundlePointers& nesting, const Descent& descent, int level, const Placement& place,
                        const SlidingNumbers& slide, std::size_t sample) {
  switch (slide.sliding) {
    case Sliding::glued:
      break;
    case Sliding::clamp_to_clamp:
      return slide.radial_share * load<Pack>(slide.clamp_strain + sample);
    case Sliding::over_pitch:
      return slide.radial_share * (mean_path_rate(descent.rods[level], place) / slide.mean_rest_rate - 1.0);
    case Sliding::along_ancestor: {
      Pack sum{};
      for (int turn = 0; turn < phases_per_pitch; ++turn)
        sum += path_rate(turned_parent(nesting, descent, slide.helical_level, level, turn, sample), place);
      return slide.radial_share * (sum / (phases_per_pitch * slide.mean_rest_rate) - 1.0);
    }
  }
  return Pack{};
}

/// Loads the parent of the nesting's last part, as stored by part_states().
inline void load_parent(const BundlePointers& nesting, std::size_t sample, ComponentState<Pack>& rod) {
  const double* row = nesting.parent + sample;
  for (Series<Pack>* series : {&rod.stretch, &rod.bend1, &rod.bend2, &rod.twist}) {
    series->order = nesting.order + 1;
    for (int power = 0; power <= series->order; ++power, row += nesting.parent_stride)
      series->at[power] = load<Pack>(row);
  }
}

/// Computes the first `steps` parts of the nesting; with a given parent only the last of them.
inline void descend(const BundlePointers& nesting, const DeformationColumns& in, std::size_t sample, Descent& descent,
                    int steps) {
  const int known = nesting.parent ? nesting.step_count - 1 : 0;
  if (nesting.parent)
    load_parent(nesting, sample, descent.rods[known]);
  else
    descent.rods[0] = uniform_rod<Pack>(load<Pack>(in.elongation + sample), load<Pack>(in.curvature1 + sample),
                                        load<Pack>(in.curvature2 + sample), load<Pack>(in.twist + sample),
                                        nesting.order + nesting.step_count);
  for (int k = known; k < steps; ++k) {
    const NestingLevel& step = nesting.steps[k];
    descent.free_strain[k] = free_strain(nesting, descent, k, step.place, step.slide, sample);
    descent.rods[k + 1] = step_down(descent.rods[k], step, step.place, step.rest, descent.free_strain[k],
                                    at_sample(step.slide.held, sample));
  }
}

inline void descend(const BundlePointers& nesting, const DeformationColumns& in, std::size_t sample, Descent& descent) {
  descend(nesting, in, sample, descent, nesting.step_count);
}

void deviations(const BundlePointers& nesting, int turn, int turned_level, const DeformationColumns& in,
                std::size_t first, std::size_t count, double* out, std::size_t stride) {
  const int last = nesting.step_count - 1;
  const NestingLevel& step = nesting.steps[last];
  const Placement& place = turn < 0 ? step.place : step.turned[turn];
  const ComponentState<double>& rest = turn < 0 ? step.rest : step.turned_rest[turn];
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent, last);
    const Pack mean = free_strain(nesting, descent, last, step.place, step.slide, first + t);
    const ComponentState<Pack> parent = turn < 0 || turned_level == 0
                                            ? descent.rods[last]
                                            : turned_parent(nesting, descent, turned_level, last, turn, first + t);
    const ComponentState<Pack> glued = child(parent, place);
    const Series<Pack> ratio = glued.stretch * (constant_series(1.0, rest.stretch.order) / rest.stretch);
    store(mean, out + t);
    const double share = step.slide.radial_share;
    store(Pack(share * (ratio.at[0] - 1.0) - mean), out + stride + t);
    for (int power = 1; power <= ratio.order; ++power)
      store(Pack(share * ratio.at[power]), out + (1 + power) * stride + t);
  }
}

inline FibreShape shape_of(const Fibre& fibre, const WireNode& node) {
  return fibre.on_axis
             ? FibreShape{}
             : fibre_shape(node.place.kinematics, node.rest, node.wire_radius, fibre.phi_sine, fibre.phi_cosine);
}

/// Computes the strains of one node's fibres at a pack of samples. sliding: its axial strain if it slides.
inline void strains_of_node(const BundlePointers& nesting, const ComponentState<Pack>& parent, const WireNode& node,
                            const Pack& sliding, Pack* strain) {
  const WireState<Pack> wire = wire_state(parent, node.place);
  Pack axial = node.slide.radial_share * (wire.stretch * node.inverse_rest_stretch - 1.0);
  Pack bend1 = wire.bend1, bend2 = wire.bend2;
  if (node.slide.sliding != Sliding::glued || node.slide.radial_share != 1) {
    if (node.slide.sliding != Sliding::glued) axial = sliding;
    if (!is_thesis(node.place.kinematics)) {  // curvature per path length is constant (W11)
      const Pack factor = (1.0 + axial) * node.rest.stretch * wire.inverse_stretch;
      bend1 *= factor;
      bend2 *= factor;
    }
  }
  axial *= node.strain_factor;
  bend1 -= node.rest.bend1;
  bend2 -= node.rest.bend2;
  for (int f = 0; f < nesting.fibre_count; ++f) {
    strain[f] =
        nesting.fibres[f].on_axis ? axial : fibre_strain(shape_of(nesting.fibres[f], node), axial, bend1, bend2);
  }
}

constexpr int most_fibres = 64;
constexpr double inverse_root_3 = 0.57735026918962576;

__attribute__((flatten)) void node_strains(const BundlePointers& nesting, const DeformationColumns& in,
                                           std::size_t first, std::size_t count, double* out, std::size_t stride) {
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent);
    Pack strain[most_fibres];
    for (int n = 0; n < nesting.node_count; ++n) {
      const WireNode& node = nesting.nodes[n];
      const Pack sliding = free_strain(nesting, descent, nesting.step_count, node.place, node.slide, first + t);
      strains_of_node(nesting, descent.rods[nesting.step_count], node, sliding, strain);
      for (int f = 0; f < nesting.fibre_count; ++f)
        store(strain[f], out + (static_cast<std::size_t>(n) * nesting.fibre_count + f) * stride + t);
    }
  }
}

inline double shear_by_twist(const WireNode& node) {
  return inverse_root_3 * node.strain_factor * node.shear_radius / rest_length(node.place.kinematics, node.rest);
}

/// Computes the ingredients of the strain of a node (see Ingredient).
inline void ingredients_of_node(const BundlePointers& nesting, const Descent& descent, const WireNode& node,
                                const Pack& sliding, Pack* out) {
  const WireState<Pack> wire = wire_state(descent.rods[nesting.step_count], node.place);
  const Pack glued = node.slide.radial_share * (wire.stretch * node.inverse_rest_stretch - 1.0);
  out[mean_strain] = sliding;
  out[deviation] = node.strain_factor * glued - sliding;
  out[shear] = shear_by_twist(node) * wire.twist;
  for (int f = 0; f < nesting.fibre_count; ++f) {
    const FibreShape shape = shape_of(nesting.fibres[f], node);
    out[first_bending + f] = shape.by_bend1 * wire.bend1 + shape.by_bend2 * wire.bend2;
  }
}

/// Returns whether two nodes have the same mean over the pitch: the wires of one layer have it in common.
inline bool same_over_pitch(const WireNode& a, const WireNode& b) {
  return a.slide.sliding == Sliding::over_pitch && b.slide.sliding == Sliding::over_pitch &&
         a.place.radius == b.place.radius && a.place.turn_rate == b.place.turn_rate &&
         a.slide.mean_rest_rate == b.slide.mean_rest_rate && a.slide.radial_share == b.slide.radial_share;
}

void node_ingredients(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first, std::size_t count,
                      double* out, std::size_t stride) {
  const int kinds = ingredients(nesting.fibre_count);
  Pack values[ingredients(most_fibres)];
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent);
    Pack sliding{};
    for (int n = 0; n < nesting.node_count; ++n) {
      const WireNode& node = nesting.nodes[n];
      if (n == 0 || !same_over_pitch(nesting.nodes[n - 1], node))
        sliding = free_strain(nesting, descent, nesting.step_count, node.place, node.slide, first + t);
      ingredients_of_node(nesting, descent, node, sliding, values);
      for (int k = 0; k < kinds; ++k) store(values[k], out + (static_cast<std::size_t>(n) * kinds + k) * stride + t);
    }
  }
}

// ---- waves of a layer -------------------------------------------------------------------------------------
//
// Single precision is enough here because a strain is never computed as a difference of stretches. It follows from the changes
// of the parent's stretch, bending and twist against the construction at rest:
//     q = (V^2 - V0^2) / V0^2 = (R^2 dsigma (sigma + sigma0) + dy (y + y0)) / V0^2,
//     strain = sqrt(1 + q) - 1 = q / (1 + sqrt(1 + q)).

constexpr std::size_t chunk = 256;  ///< samples per chunk: the rows stay in the first-level cache

struct alignas(64) PartState {
  float rows[part_rows][chunk];

  FloatPack operator()(int row, std::size_t t) const { return load<FloatPack>(rows[row] + t); }
};

/// A part of the nesting in the undeformed construction.
struct PartAtRest {
  double stretch = 1, bend1 = 0, bend2 = 0, twist = 0;

  /// steps > 0: the last of the first `steps` parts; 0: the dresspack.
  PartAtRest(const BundlePointers& nesting, int steps) {
    bend2 = nesting.rest_curvature;
    if (steps == 0) return;
    const ComponentState<double>& rest = nesting.steps[steps - 1].rest;
    stretch = rest.stretch.at[0];
    bend1 = rest.bend1.at[0];
    bend2 = rest.bend2.at[0];
    twist = rest.twist.at[0];
  }
};

/// Writes a part's state in single precision to rows[PartRow * stride], from that in double precision.
inline void put_part(const ComponentState<Pack>& rod, const PartAtRest& rest, int order, float* rows,
                     std::size_t stride) {
  const Series<Pack>* const of[] = {&rod.stretch, &rod.bend1, &rod.bend2, &rod.twist};
  const double at_rest[] = {rest.stretch, rest.bend1, rest.bend2, rest.twist};
  const auto put = [&](int row, const Pack& value) { store(in_single(value), rows + row * stride); };
  for (int k = 0; k < 4; ++k) {
    put(part_stretch + k, of[k]->at[0]);
    put(stretch_change + k, of[k]->at[0] - at_rest[k]);
    if (order > 0 && of[k]->order > 0) put(stretch_slope + k, of[k]->at[1]);
  }
}

__attribute__((flatten)) void part_states(const BundlePointers& nesting, const DeformationColumns& in,
                                          std::size_t first, std::size_t count, double* out, float* rows,
                                          std::size_t stride) {
  const PartAtRest rest(nesting, nesting.step_count);
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent);
    const ComponentState<Pack>& rod = descent.rods[nesting.step_count];
    double* row = out + t;
    for (const Series<Pack>* series : {&rod.stretch, &rod.bend1, &rod.bend2, &rod.twist})
      for (int power = 0; power <= nesting.order; ++power, row += stride)
        store(power <= series->order ? series->at[power] : Pack{}, row);  // `thesis` has no slopes
    if (rows) put_part(rod, rest, nesting.order, rows + t, stride);
  }
}

/// A helix in a parent at rest, in single precision. Names as in helix.h; a 0 means at rest.
struct HelixNumbers {
  float radius, turn_rate, tangent, c, inverse_c;
  float sigma0, stretch0, strain0, pitch0, inverse_pitch0, second0, inverse_one_and_second0;

  HelixNumbers(const Placement& p, const PartAtRest& parent) {
    const double sigma = p.turn_rate + parent.twist, A = p.radius * p.radius * sigma * sigma;
    const double y2 = parent.stretch * parent.stretch, inverse2 = 1 / (A + y2);
    const double bend = p.radius * p.radius * (parent.bend1 * parent.bend1 + parent.bend2 * parent.bend2);
    const double second =
        0.25 * A * bend * inverse2 * inverse2 * (1 + 3.0 / 16 * bend * (4 * y2 - A) * inverse2 * inverse2);
    radius = static_cast<float>(p.radius);
    turn_rate = static_cast<float>(p.turn_rate);
    tangent = static_cast<float>(p.lay_tangent);
    c = static_cast<float>(p.lay_cosine);
    inverse_c = static_cast<float>(1 / p.lay_cosine);
    sigma0 = static_cast<float>(sigma);
    stretch0 = static_cast<float>(parent.stretch);
    strain0 = static_cast<float>(parent.stretch - 1);
    pitch0 = static_cast<float>(A + y2);
    inverse_pitch0 = static_cast<float>(inverse2);
    second0 = static_cast<float>(second);
    inverse_one_and_second0 = static_cast<float>(1 / (1 + second));
  }
};

/// A parent's state at a pack of samples, and the values that all parts on one helix in it have in common.
struct ParentAt {
  FloatPack stretch, bend1, bend2, twist, stretch_by, bend1_by, bend2_by, twist_by;  ///< by: changes
  FloatPack sigma, turning, twisting;  ///< turning: R sigma; twisting: R^2 (sigma^2 - sigma0^2)

  /// of: returns the rows of PartRow.
  template <class Source>
  ParentAt(const HelixNumbers& helix, const Source& of, std::size_t t)
      : stretch(of(part_stretch, t)),
        bend1(of(part_bend1, t)),
        bend2(of(part_bend2, t)),
        twist(of(part_twist, t)),
        stretch_by(of(stretch_change, t)),
        bend1_by(of(bend1_change, t)),
        bend2_by(of(bend2_change, t)),
        twist_by(of(twist_change, t)),
        sigma(helix.turn_rate + twist),
        turning(helix.radius * sigma),
        twisting(helix.radius * helix.radius * twist_by * (sigma + helix.sigma0)) {}

  /// Returns mean_path_rate() over that at rest, minus one.
  inline FloatPack mean_over_pitch(const HelixNumbers& helix) const {
    const FloatPack y2 = stretch * stretch, A = turning * turning;
    const FloatPack q = (twisting + stretch_by * (stretch + helix.stretch0)) * helix.inverse_pitch0;
    const FloatPack root = inverse_root(1.0f + q), inverse2 = root * root * helix.inverse_pitch0;
    const FloatPack first = q * inverse(1.0f + (1.0f + q) * root);
    const FloatPack bend = helix.radius * helix.radius * (bend1 * bend1 + bend2 * bend2) * (inverse2 * inverse2);
    const FloatPack second = 0.25f * A * bend * (1.0f + 0.1875f * bend * (4.0f * y2 - A));
    return first + (second - helix.second0) * (1.0f + first) * helix.inverse_one_and_second0;
  }
};

inline bool slides_from_afar(const SlidingNumbers& slide) {
  return slide.sliding == Sliding::clamp_to_clamp || slide.sliding == Sliding::along_ancestor;
}

inline FloatPack in_single(const double* from) {
  return joined(in_single(load<Pack>(from)), in_single(load<Pack>(from + pack_size)));
}

/// Returns the address in `out` at which fill_part() stores the strain of a node that slides from afar: the five rows of the
/// first waves of its layer, for five nodes.
inline float* waiting_place(float* out, int node, int kinds, std::size_t stride) {
  return out + (node / waves_per_layer * kinds * waves_per_layer + node % waves_per_layer) * stride;
}

/// Returns whether the last part's state follows from its parent's rows alone, see part_from().
inline bool rows_suffice(const BundlePointers& nesting) {
  return nesting.parent_rows != nullptr &&
         single_suffices(nesting.steps[nesting.step_count - 1], nesting.nodes, nesting.node_count, nesting.order);
}

/// The rows of PartRow of a part.
struct RowsOfParent {
  const float* rows;
  std::size_t stride;

  inline FloatPack operator()(int row, std::size_t t) const { return load<FloatPack>(rows + row * stride + t); }
};

/// The rows of PartRow of the dresspack: uniform; at rest only its curvature is not zero.
struct RowsOfDresspack {
  const DeformationColumns& in;
  std::size_t first;
  float rest_curvature;

  __attribute__((always_inline)) FloatPack operator()(int row, std::size_t t) const {
    switch (row) {
      case part_stretch:
        return 1.0f + in_single(in.elongation + first + t);
      case stretch_change:
        return in_single(in.elongation + first + t);
      case part_bend1:
      case bend1_change:
        return in_single(in.curvature1 + first + t);
      case part_bend2:
        return in_single(in.curvature2 + first + t);
      case bend2_change:
        return in_single(in.curvature2 + first + t) - rest_curvature;
      case part_twist:
      case twist_change:
        return in_single(in.twist + first + t);
      default:
        return FloatPack{};
    }
  }
};

/// Computes the state of the last part from that of its parent, as child() and slid() do, in changes, to rows[PartRow * stride].
/// With N = R sigma^2 + y X, V / V0 = 1 + e and (1 + e)^2 = 1 + q,
///     bend2 = c N / V (1 + strain) / (1 + e),    bend2 - bend2_0 = c / V0 (N - N0 + N m),
///     m = (1 + strain) / (1 + q) - 1 = (strain - q) / (1 + q);    glued, strain = e: m = -e / (1 + e),
/// and the twist in the same way with M = sigma stretch. The slopes of the part in a parent without slopes
/// (`slopes`), along this parent:
///     radial' = -theta' X,   X' = theta' radial,   y' = R X',   y'' = -R theta'^2 X,   w = V'/V = y y'/V^2,
///     a' = -R sigma y' / V^2,   a'' = -R sigma (y'' - 2 y' w) / V^2;   (N / V)' = (N' - N w) / V,
/// for a sliding part times its factor, which has the slope w0 - w: (1 + strain) of the rest's, w0. Precondition of slopes:
/// slopes_in_single().
template <Sliding how, bool slopes, class Source>
void part_from(const Source& of, const BundlePointers& nesting, std::size_t first, std::size_t count, float* rows,
               std::size_t stride) {
  const NestingLevel& step = nesting.steps[nesting.step_count - 1];
  const PartAtRest parent0(nesting, nesting.step_count - 1), rest(nesting, nesting.step_count);
  const HelixNumbers helix(step.place, parent0);
  const double rest_V = rest.stretch / step.place.lay_cosine;
  const double rest_X = parent0.bend1 * step.place.sine.at[0] - parent0.bend2 * step.place.cosine.at[0];
  const double rest_radial = parent0.bend1 * step.place.cosine.at[0] + parent0.bend2 * step.place.sine.at[0];
  const double rest_y = parent0.stretch + step.place.radius * rest_X;
  const auto y0 = static_cast<float>(rest_y);
  const auto w0 =
      static_cast<float>(rest_y * step.place.radius * step.place.turn_rate * rest_radial / (rest_V * rest_V));
  const auto scale = static_cast<float>(step.place.lay_cosine / rest_V);
  const auto inverse_V0_squared = static_cast<float>(1 / (rest_V * rest_V));
  const auto sine = static_cast<float>(step.place.sine.at[0]);
  const auto cosine = static_cast<float>(step.place.cosine.at[0]);
  const float at_rest[] = {static_cast<float>(rest.stretch), static_cast<float>(rest.bend1),
                           static_cast<float>(rest.bend2), static_cast<float>(rest.twist)};
  const float R = helix.radius;
  const auto share = static_cast<float>(step.slide.radial_share);
  const double* const held = step.slide.held;
  const bool gives = step.slide.radial_share != 1;
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const ParentAt p(helix, of, t);
    const FloatPack X = p.bend1 * sine - p.bend2 * cosine, radial = p.bend1 * cosine + p.bend2 * sine;
    const FloatPack X_by = p.bend1_by * sine - p.bend2_by * cosine;
    const FloatPack y = p.stretch + R * X, y_by = p.stretch_by + R * X_by;
    const FloatPack q = (p.twisting + y_by * (y + y0)) * inverse_V0_squared;
    const FloatPack root = inverse_root(1.0f + q);
    const FloatPack e = q * inverse(1.0f + (1.0f + q) * root);
    FloatPack strain = e, m = -e * root, along = FloatPack{} + 1.0f;  // along: factor of bend1
    if constexpr (how == Sliding::glued) {
      if (gives) {
        strain = share * e;
        m = (strain - q) * (root * root);
        along = (1.0f + strain) * root;
      }
    } else {
      strain = share *
               (how == Sliding::over_pitch ? p.mean_over_pitch(helix) : in_single(step.slide.clamp_strain + first + t));
      if (held) strain += in_single(held + first + t);
      m = (strain - q) * (root * root);
      along = (1.0f + strain) * root;
    }
    const FloatPack N = p.turning * p.sigma + y * X, M = p.sigma * p.stretch;
    const FloatPack N_by = R * p.twist_by * (p.sigma + helix.sigma0) + y_by * X + y0 * X_by;
    const FloatPack M_by = p.twist_by * p.stretch + helix.sigma0 * p.stretch_by;
    const FloatPack y_slope = of(stretch_slope, t) + R * (of(bend1_slope, t) * sine - of(bend2_slope, t) * cosine) +
                              R * helix.turn_rate * radial;
    const FloatPack over_V2 = root * root * inverse_V0_squared;
    const FloatPack angle_slope = R * (of(twist_slope, t) * y - p.sigma * y_slope) * over_V2;
    const FloatPack by[] = {strain * at_rest[0], helix.c * (angle_slope - radial) * along - at_rest[1],
                            scale * (N_by + N * m), scale * (M_by + M * m)};
    const auto put = [&](int row, const FloatPack& value) { store(value, rows + row * stride + t); };
    for (int k = 0; k < 4; ++k) {
      put(part_stretch + k, at_rest[k] + by[k]);
      put(stretch_change + k, by[k]);
    }
    if constexpr (slopes) {
      const FloatPack w = y * y_slope * over_V2, left = how == Sliding::glued ? -w : w0 - 2.0f * w;
      const FloatPack X_slope = helix.turn_rate * radial;
      const FloatPack y_curve = -R * helix.turn_rate * helix.turn_rate * X;
      const FloatPack angle_curve = -p.turning * (y_curve - 2.0f * y_slope * w) * over_V2;
      const FloatPack over_V = helix.c * scale * root * along;  // along the part, with the factor of sliding
      put(stretch_slope, helix.c * (at_rest[0] + by[0]) * (how == Sliding::glued ? w : w0 + FloatPack{}));
      put(bend1_slope, helix.c * helix.c * along *
                           (angle_curve + helix.turn_rate * X +
                            (how == Sliding::glued ? FloatPack{} : (angle_slope - radial) * (w0 - w))));
      put(bend2_slope, over_V * (y_slope * X + y * X_slope + N * left));
      put(twist_slope, over_V * (M * left));
    }
  }
}

template <bool slopes, class Source>
void part_from(const Source& of, const BundlePointers& nesting, std::size_t first, std::size_t count, float* rows,
               std::size_t stride) {
  const Sliding how = nesting.steps[nesting.step_count - 1].slide.sliding;
  if (how == Sliding::glued)
    part_from<Sliding::glued, slopes>(of, nesting, first, count, rows, stride);
  else if (how == Sliding::over_pitch)
    part_from<Sliding::over_pitch, slopes>(of, nesting, first, count, rows, stride);
  else
    part_from<Sliding::clamp_to_clamp, slopes>(of, nesting, first, count, rows, stride);
}

void part_rows_of_dresspack(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first,
                            std::size_t count, float* rows, std::size_t stride) {
  const RowsOfDresspack of{in, first, static_cast<float>(nesting.rest_curvature)};
  if (nesting.order > 0)
    part_from<true>(of, nesting, first, count, rows, stride);
  else
    part_from<false>(of, nesting, first, count, rows, stride);
}

void fill_from_rows(const BundlePointers& nesting, std::size_t first, std::size_t count, PartState& state, float* out,
                    std::size_t stride, int kinds) {
  part_from<false>(RowsOfParent{nesting.parent_rows + first, nesting.parent_stride}, nesting, first, count,
                   state.rows[0], chunk);
  for (int n = 0; n < nesting.node_count; ++n)
    if (const SlidingNumbers& slide = nesting.nodes[n].slide; slides_from_afar(slide))
      for (std::size_t t = 0; t < count; t += float_pack_size)
        store(FloatPack(static_cast<float>(slide.radial_share) * in_single(slide.clamp_strain + first + t)),
              waiting_place(out, n, kinds, stride) + t);
}

/// Fills the state for samples [first, first + count), and stores the strains of nodes that slide from afar at their
/// waiting_place().
__attribute__((flatten)) void fill_part(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first,
                                        std::size_t count, PartState& state, float* out, std::size_t stride,
                                        int kinds) {
  if (rows_suffice(nesting)) return fill_from_rows(nesting, first, count, state, out, stride, kinds);
  const std::size_t whole_packs = (count + float_pack_size - 1) / float_pack_size * float_pack_size;
  const int steps = nesting.step_count;
  const PartAtRest rest(nesting, steps);
  bool any_from_afar = false;
  for (int n = 0; n < nesting.node_count; ++n) any_from_afar |= slides_from_afar(nesting.nodes[n].slide);
  for (std::size_t t = 0; t < whole_packs; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent);
    put_part(descent.rods[steps], rest, nesting.order, state.rows[0] + t, chunk);
    for (int n = 0; any_from_afar && n < nesting.node_count; ++n)
      if (const WireNode& node = nesting.nodes[n]; slides_from_afar(node.slide))
        store(in_single(free_strain(nesting, descent, steps, node.place, node.slide, first + t)),
              waiting_place(out, n, kinds, stride) + t);
  }
}

/// The numbers of a node for the loops. Names as in helix.h; a 0 means at rest.
struct NodeNumbers {
  float sine, cosine, y0, inverse_V0, inverse_V0_squared;
  float rest_stretch, rest_bend1, rest_bend2;
  float strain0, inverse_rest_stretch;  ///< strain0: of the thesis' formula at rest

  NodeNumbers(const WireNode& node, const PartAtRest& parent) {
    const Placement& p = node.place;
    const double X = parent.bend1 * p.sine.at[0] - parent.bend2 * p.cosine.at[0];
    sine = static_cast<float>(p.sine.at[0]);
    cosine = static_cast<float>(p.cosine.at[0]);
    y0 = static_cast<float>(parent.stretch + p.radius * X);
    inverse_V0 = static_cast<float>(1 / node.rest_rate);
    inverse_V0_squared = static_cast<float>(1 / (node.rest_rate * node.rest_rate));
    rest_stretch = static_cast<float>(node.rest.stretch);
    rest_bend1 = static_cast<float>(node.rest.bend1);
    rest_bend2 = static_cast<float>(node.rest.bend2);
    strain0 = static_cast<float>(node.rest_rate - 1);
    inverse_rest_stretch = static_cast<float>(node.inverse_rest_stretch);
  }
};

/// Numbers that the nodes of a layer have in common.
struct LayerNumbers : HelixNumbers {
  float mean_strain0, inverse_mean_rest_rate, radial_share;
  bool sticks;  ///< its curvature is that of the parent's: glued, and rigid in the radial direction

  LayerNumbers(const WireNode& node, const PartAtRest& parent)
      : HelixNumbers(node.place, parent),
        mean_strain0(static_cast<float>(node.slide.mean_rest_rate - 1)),
        inverse_mean_rest_rate(static_cast<float>(1 / node.slide.mean_rest_rate)),
        radial_share(static_cast<float>(node.slide.radial_share)),
        sticks(node.slide.sliding == Sliding::glued && node.slide.radial_share == 1) {}
};

/// FibreShape in single precision.
struct FibreNumbers {
  float by_bend1, by_bend2, scale;

  FibreNumbers() = default;
  FibreNumbers(const Fibre& fibre, const WireNode& node) {
    const FibreShape shape = shape_of(fibre, node);
    by_bend1 = static_cast<float>(shape.by_bend1);
    by_bend2 = static_cast<float>(shape.by_bend2);
    scale = static_cast<float>(shape.scale);
  }
};

struct FiveNodes : LayerNumbers {
  const BundlePointers& nesting;
  const WireNode* nodes;
  NodeNumbers node[waves_per_layer];

  FiveNodes(const BundlePointers& of, const WireNode* at, const PartAtRest& parent)
      : LayerNumbers(at[0], parent),
        nesting(of),
        nodes(at),
        node{{at[0], parent}, {at[1], parent}, {at[2], parent}, {at[3], parent}, {at[4], parent}} {}
};

/// The fibres of a layer at its nodes.
struct FibresAtNodes {
  FibreNumbers at[most_fibres][waves_per_layer];

  explicit FibresAtNodes(const FiveNodes& layer) {
    for (int f = 0; f < layer.nesting.fibre_count; ++f)
      for (int n = 0; n < waves_per_layer; ++n) at[f][n] = {layer.nesting.fibres[f], layer.nodes[n]};
  }
};

/// wire_state() with the glued strain instead of the stretch.
struct NodeState {
  FloatPack strain, bend1, bend2, twist, inverse_stretch;
};

/// A layer at a pack of samples.
template <bool thesis, bool with_bend1>
struct LayerAt : ParentAt {
  const LayerNumbers& layer;
  const PartState& part;
  std::size_t t;
  FloatPack cosine, cosine_squared, sine_cosine;  ///< of the thesis' angle (13)

  LayerAt(const LayerNumbers& of, const PartState& in, std::size_t at)
      : ParentAt(of, in, at), layer(of), part(in), t(at) {
    if constexpr (thesis) {
      const FloatPack angle = (of.tangent + of.radius * twist) * inverse(stretch);
      cosine = inverse_root(1.0f + angle * angle);
      cosine_squared = cosine * cosine;
      sine_cosine = angle * cosine_squared;
    }
  }

  inline NodeState operator()(const NodeNumbers& n) const {
    const FloatPack X = bend1 * n.sine - bend2 * n.cosine, radial = bend1 * n.cosine + bend2 * n.sine;
    if constexpr (thesis)
      return {layer.radial_share * ((thesis_strain(layer.radius * X) - n.strain0) * n.inverse_rest_stretch),
              -cosine * radial, cosine_squared * X, sine_cosine * X, FloatPack{} + 1.0f};
    const FloatPack y = stretch + layer.radius * X, V2 = turning * turning + y * y, inverse_V = inverse_root(V2);
    const FloatPack y_change = stretch_by + layer.radius * (bend1_by * n.sine - bend2_by * n.cosine);
    const FloatPack q = (twisting + y_change * (y + n.y0)) * n.inverse_V0_squared;
    const FloatPack scale = layer.c * inverse_V;
    NodeState state;
    state.strain = layer.radial_share * (q * inverse(1.0f + V2 * inverse_V * n.inverse_V0));
    state.bend1 = FloatPack{};
    state.bend2 = scale * (turning * sigma + y * X);
    state.twist = scale * sigma * stretch;
    state.inverse_stretch = layer.inverse_c * inverse_V;
    if constexpr (with_bend1) {
      const FloatPack y_slope = part(stretch_slope, t) +
                                layer.radius * (part(bend1_slope, t) * n.sine - part(bend2_slope, t) * n.cosine) +
                                layer.radius * layer.turn_rate * radial;
      state.bend1 =
          layer.c * (layer.radius * (part(twist_slope, t) * y - sigma * y_slope) * inverse_V * inverse_V - radial);
    }
    return state;
  }

  inline FloatPack thesis_strain(const FloatPack& by_bending) const {
    return cosine_squared * (stretch_by + layer.strain0 + by_bending) + layer.radius * sine_cosine * twist;
  }

  /// Returns the mean of the glued strain over the pitch.
  inline FloatPack mean_strain_over_pitch() const {
    if constexpr (thesis)
      return layer.radial_share * ((thesis_strain(FloatPack{}) - layer.mean_strain0) * layer.inverse_mean_rest_rate);
    return layer.radial_share * mean_over_pitch(layer);
  }

  /// Returns the factor that keeps the curvature per path length (W11); 1 where it does not apply.
  inline FloatPack curvature_factor(const FloatPack& axial, const NodeNumbers& n, const NodeState& node) const {
    return layer.sticks || thesis ? FloatPack{} + 1.0f : (1.0f + axial) * n.rest_stretch * node.inverse_stretch;
  }

  /// Computes the strain of each node if the layer slides; 0 if it is glued. waiting: strains that fill_part() stored for this
  /// layer.
  inline void sliding(Sliding how, const float* waiting, std::size_t stride, FloatPack* strain) const {
    const FloatPack of_layer = how == Sliding::over_pitch ? mean_strain_over_pitch() : FloatPack{};
    const bool from_afar = how == Sliding::clamp_to_clamp || how == Sliding::along_ancestor;
    for (int n = 0; n < waves_per_layer; ++n)
      strain[n] = from_afar ? load<FloatPack>(waiting + n * stride + t) : of_layer;
  }
};

/// Converts five evenly spaced values around the layer to mean, sine, cosine, and sine and cosine of twice the angle (W13).
struct FiveToWaves {
  float sine1, sine2, cosine1, cosine2;  ///< of one fifth and two fifths of a turn, times 2/5

  FiveToWaves() {
    const double fifth = 2 * 3.141592653589793 / waves_per_layer, scale = 2.0 / waves_per_layer;
    sine1 = static_cast<float>(scale * std::sin(fifth));
    sine2 = static_cast<float>(scale * std::sin(2 * fifth));
    cosine1 = static_cast<float>(scale * std::cos(fifth));
    cosine2 = static_cast<float>(scale * std::cos(2 * fifth));
  }

  inline void store_waves(const FloatPack* value, float* out, std::size_t stride) const {
    const FloatPack near = value[1] + value[4], far = value[2] + value[3];
    const FloatPack near_odd = value[1] - value[4], far_odd = value[2] - value[3];
    const FloatPack front = 0.4f * value[0];
    store(FloatPack(0.5f * front + 0.2f * (near + far)), out);
    store(FloatPack(sine1 * near_odd + sine2 * far_odd), out + stride);
    store(FloatPack(front + cosine1 * near + cosine2 * far), out + 2 * stride);
    store(FloatPack(sine2 * near_odd - sine1 * far_odd), out + 3 * stride);
    store(FloatPack(front + cosine2 * near + cosine1 * far), out + 4 * stride);
  }
};

/// Computes the waves of the strains of a layer that slides and whose fibres depend on bend2 only. From W6 and
/// W11 bend2 = (1 + strain) rest_stretch (R sigma^2 + y X) / V^2.
template <Sliding how>
void sliding_strains_of_layer(const FiveNodes& layer, const PartState& part, std::size_t count, float* out,
                              std::size_t stride) {
  const FiveToWaves to_waves;
  const BundlePointers& nesting = layer.nesting;
  const auto factor_of_wall = static_cast<float>(layer.nodes[0].strain_factor);
  const FibresAtNodes fibres(layer);
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const LayerAt<false, false> at(layer, part, t);
    FloatPack axial[waves_per_layer], bend2[waves_per_layer], strain[waves_per_layer];
    at.sliding(how, out, stride, axial);
    const FloatPack turning2 = at.turning * at.turning, turning_sigma = at.turning * at.sigma;
    for (int n = 0; n < waves_per_layer; ++n) {
      const NodeNumbers& node = layer.node[n];
      const FloatPack X = at.bend1 * node.sine - at.bend2 * node.cosine, y = at.stretch + layer.radius * X;
      const FloatPack over_V2 = inverse(turning2 + y * y);
      bend2[n] = (turning_sigma + y * X) * over_V2 * ((1.0f + axial[n]) * node.rest_stretch) - node.rest_bend2;
      axial[n] *= factor_of_wall;
    }
    for (int f = 0; f < nesting.fibre_count; ++f) {
      for (int n = 0; n < waves_per_layer; ++n)
        strain[n] = (axial[n] + fibres.at[f][n].by_bend2 * bend2[n]) * fibres.at[f][n].scale;
      to_waves.store_waves(strain, out + f * waves_per_layer * stride + t, stride);
    }
  }
}

/// Computes the waves of the strains of a layer's fibres at `count` samples.
template <bool thesis, bool with_bend1, Sliding how>
void strains_of_layer(const FiveNodes& layer, const PartState& part, std::size_t count, float* out,
                      std::size_t stride) {
  constexpr bool glued = how == Sliding::glued;
  if constexpr (!thesis && !with_bend1 && !glued) return sliding_strains_of_layer<how>(layer, part, count, out, stride);
  const FiveToWaves to_waves;
  const BundlePointers& nesting = layer.nesting;
  const auto factor_of_wall = static_cast<float>(layer.nodes[0].strain_factor);
  const FibresAtNodes fibres(layer);
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const LayerAt<thesis, with_bend1> at(layer, part, t);
    FloatPack axial[waves_per_layer], bend1[waves_per_layer], bend2[waves_per_layer], strain[waves_per_layer];
    at.sliding(how, out, stride, axial);
    for (int n = 0; n < waves_per_layer; ++n) {
      const NodeState node = at(layer.node[n]);
      if (glued) axial[n] = node.strain;
      const FloatPack factor = at.curvature_factor(axial[n], layer.node[n], node);
      bend1[n] = node.bend1 * factor - layer.node[n].rest_bend1;
      bend2[n] = node.bend2 * factor - layer.node[n].rest_bend2;
      axial[n] *= factor_of_wall;
    }
    for (int f = 0; f < nesting.fibre_count; ++f) {
      for (int n = 0; n < waves_per_layer; ++n) {
        const FibreNumbers& fibre = fibres.at[f][n];
        strain[n] = axial[n] + fibre.by_bend2 * bend2[n];
        if constexpr (with_bend1) strain[n] += fibre.by_bend1 * bend1[n];
        strain[n] *= fibre.scale;
      }
      to_waves.store_waves(strain, out + f * waves_per_layer * stride + t, stride);
    }
  }
}

/// Computes the waves of the ingredients of a layer at `count` samples.
template <bool thesis, bool with_bend1, Sliding how>
void ingredients_of_layer(const FiveNodes& layer, const PartState& part, std::size_t count, float* out,
                          std::size_t stride) {
  const FiveToWaves to_waves;
  const BundlePointers& nesting = layer.nesting;
  const auto factor_of_wall = static_cast<float>(layer.nodes[0].strain_factor);
  const FibresAtNodes fibres(layer);
  float by_twist[waves_per_layer];
  for (int n = 0; n < waves_per_layer; ++n) by_twist[n] = static_cast<float>(shear_by_twist(layer.nodes[n]));
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const LayerAt<thesis, with_bend1> at(layer, part, t);
    NodeState node[waves_per_layer];
    FloatPack sliding[waves_per_layer], value[waves_per_layer];
    at.sliding(how, out, stride, sliding);
    for (int n = 0; n < waves_per_layer; ++n) node[n] = at(layer.node[n]);
    const auto put = [&](int kind, const auto& of_node) {
      for (int n = 0; n < waves_per_layer; ++n) value[n] = of_node(n);
      to_waves.store_waves(value, out + kind * waves_per_layer * stride + t, stride);
    };
    put(mean_strain, [&](int n) { return sliding[n]; });
    put(deviation, [&](int n) { return FloatPack(factor_of_wall * node[n].strain - sliding[n]); });
    if (nesting.with_shear) put(shear, [&](int n) { return FloatPack(by_twist[n] * node[n].twist); });
    for (int f = 0; f < nesting.fibre_count; ++f)
      put(first_bending + f, [&](int n) {
        const FibreNumbers& fibre = fibres.at[f][n];
        return FloatPack(node[n].bend1 * fibre.by_bend1 + node[n].bend2 * fibre.by_bend2);
      });
  }
}

/// Computes the waves of mean strain and deviation only, which determine the slip of wires.
template <bool thesis, Sliding how>
void deviations_of_layer(const FiveNodes& layer, const PartState& part, std::size_t count, float* out,
                         std::size_t stride) {
  const FiveToWaves to_waves;
  const auto factor_of_wall = static_cast<float>(layer.nodes[0].strain_factor);
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const LayerAt<thesis, false> at(layer, part, t);
    FloatPack sliding[waves_per_layer], away[waves_per_layer];
    at.sliding(how, out, stride, sliding);
    for (int n = 0; n < waves_per_layer; ++n) away[n] = factor_of_wall * at(layer.node[n]).strain - sliding[n];
    to_waves.store_waves(sliding, out + mean_strain * waves_per_layer * stride + t, stride);
    to_waves.store_waves(away, out + deviation * waves_per_layer * stride + t, stride);
  }
}

}  // namespace
}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain

#include "strain/kernels/sliding.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

using OfLayer = void (*)(const FiveNodes&, const PartState&, std::size_t, float*, std::size_t);

/// The loops of one kind for each value of Sliding.
struct BySliding {
  OfLayer glued, over_pitch, clamp_to_clamp, along_ancestor;

  OfLayer operator()(Sliding how) const {
    switch (how) {
      case Sliding::over_pitch:
        return over_pitch;
      case Sliding::clamp_to_clamp:
        return clamp_to_clamp;
      case Sliding::along_ancestor:
        return along_ancestor;
      case Sliding::glued:
        break;
    }
    return glued;
  }
};

template <bool thesis, bool with_bend1>
constexpr BySliding strains_by_sliding{strains_of_layer<thesis, with_bend1, Sliding::glued>,
                                       strains_of_layer<thesis, with_bend1, Sliding::over_pitch>,
                                       strains_of_layer<thesis, with_bend1, Sliding::clamp_to_clamp>,
                                       strains_of_layer<thesis, with_bend1, Sliding::along_ancestor>};
template <bool thesis, bool with_bend1>
constexpr BySliding ingredients_by_sliding{ingredients_of_layer<thesis, with_bend1, Sliding::glued>,
                                           ingredients_of_layer<thesis, with_bend1, Sliding::over_pitch>,
                                           ingredients_of_layer<thesis, with_bend1, Sliding::clamp_to_clamp>,
                                           ingredients_of_layer<thesis, with_bend1, Sliding::along_ancestor>};
template <bool thesis>
constexpr BySliding deviations_by_sliding{
    deviations_of_layer<thesis, Sliding::glued>, deviations_of_layer<thesis, Sliding::over_pitch>,
    deviations_of_layer<thesis, Sliding::clamp_to_clamp>, deviations_of_layer<thesis, Sliding::along_ancestor>};

/// Runs `by` over all layers, chunk by chunk. Layers of `sliding` with closed forms use these instead. kinds: waves per layer.
void over_layers(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first, std::size_t count,
                 int kinds, float* out, std::size_t stride, const SlidingLayer* sliding, const BySliding& by) {
  const int layers = nesting.node_count / waves_per_layer;
  const PartAtRest at_rest(nesting, nesting.step_count);
  const std::size_t per_layer = static_cast<std::size_t>(kinds) * waves_per_layer * stride;
  const SlidingLayer* any_closed = nullptr;
  for (int layer = 0; sliding && layer < layers; ++layer)
    if (sliding[layer].closed) any_closed = &sliding[layer];
  PartState part;
  BendShape shape;
  for (std::size_t done = 0; done < count; done += chunk) {
    const std::size_t here = count - done < chunk ? count - done : chunk;
    fill_part(nesting, in, first + done, here, part, out + done, stride, kinds);
    if (any_closed) shape.fill(*any_closed, part, here);
    for (int layer = 0; layer < layers; ++layer) {
      const WireNode* nodes = nesting.nodes + layer * waves_per_layer;
      float* const to = out + layer * per_layer + done;
      if (any_closed && shape.suits(sliding[layer]))
        closed_strains_of_layer(sliding[layer], nesting.fibre_count, part, shape, here, to, stride);
      else
        by(nodes->slide.sliding)(FiveNodes(nesting, nodes, at_rest), part, here, to, stride);
    }
  }
}

bool is_thesis(const BundlePointers& nesting) {
  return nesting.node_count > 0 && is_thesis(nesting.nodes[0].place.kinematics);
}

void layer_waves(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first, std::size_t count,
                 float* out, std::size_t stride) {
  over_layers(nesting, in, first, count, nesting.fibre_count, out, stride, nesting.sliding,
              is_thesis(nesting)  ? strains_by_sliding<true, true>
              : nesting.order > 0 ? strains_by_sliding<false, true>
                                  : strains_by_sliding<false, false>);
}

/// Computes the strains of one node with one fibre. out: contains the strain from fill_part() if the node slides from afar.
template <bool thesis, bool with_bend1>
void strains_of_one(const BundlePointers& nesting, const WireNode& of, const PartAtRest& at_rest, const PartState& part,
                    std::size_t count, float* out) {
  const LayerNumbers layer(of, at_rest);
  const NodeNumbers number(of, at_rest);
  const Sliding how = of.slide.sliding;
  const FibreNumbers fibre(nesting.fibres[0], of);
  const auto factor_of_wall = static_cast<float>(of.strain_factor);
  for (std::size_t t = 0; t < count; t += float_pack_size) {
    const LayerAt<thesis, with_bend1> at(layer, part, t);
    const NodeState node = at(number);
    const FloatPack axial = how == Sliding::glued        ? node.strain
                            : how == Sliding::over_pitch ? at.mean_strain_over_pitch()
                                                         : load<FloatPack>(out + t);
    const FloatPack factor = at.curvature_factor(axial, number, node);
    FloatPack strain = axial * factor_of_wall + fibre.by_bend2 * (node.bend2 * factor - number.rest_bend2);
    if constexpr (with_bend1) strain += fibre.by_bend1 * (node.bend1 * factor - number.rest_bend1);
    store(FloatPack(strain * fibre.scale), out + t);
  }
}

void node_strains_in_single(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first,
                            std::size_t count, float* out, std::size_t stride) {
  const PartAtRest at_rest(nesting, nesting.step_count);
  const auto strains = is_thesis(nesting)  ? strains_of_one<true, true>
                       : nesting.order > 0 ? strains_of_one<false, true>
                                           : strains_of_one<false, false>;
  PartState part;
  for (std::size_t done = 0; done < count; done += chunk) {
    const std::size_t here = count - done < chunk ? count - done : chunk;
    fill_part(nesting, in, first + done, here, part, out + done, stride, 1);
    for (int n = 0; n < nesting.node_count; ++n)
      strains(nesting, nesting.nodes[n], at_rest, part, here, out + n * stride + done);
  }
}

void ingredient_waves(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first, std::size_t count,
                      float* out, std::size_t stride) {
  over_layers(nesting, in, first, count, ingredients(nesting.fibre_count), out, stride, nullptr,
              is_thesis(nesting)  ? ingredients_by_sliding<true, true>
              : nesting.order > 0 ? ingredients_by_sliding<false, true>
                                  : ingredients_by_sliding<false, false>);
}

void deviation_waves(const BundlePointers& nesting, const DeformationColumns& in, std::size_t first, std::size_t count,
                     float* out, std::size_t stride) {
  over_layers(nesting, in, first, count, deviation + 1, out, stride, nullptr,
              is_thesis(nesting) ? deviations_by_sliding<true> : deviations_by_sliding<false>);
}

__attribute__((flatten)) void add_path_rates(const BundlePointers& nesting, const DeformationColumns& in,
                                             std::size_t first, std::size_t count, double weight, double* sum,
                                             std::size_t stride) {
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(nesting, in, first + t, descent);
    for (int n = 0; n < nesting.node_count; ++n) {
      double* to = sum + static_cast<std::size_t>(n) * stride + t;
      store(Pack(load<Pack>(to) + weight * path_rate(descent.rods[nesting.step_count], nesting.nodes[n].place)), to);
    }
  }
}

// ---- wires composed one by one ----------------------------------------------------------------------------

/// Values of one ingredient at a pack of wires; its first wire is lane `at`.
struct Around {
  FloatPack sine1, cosine1, sine2, cosine2;

  Around() = default;
  Around(const float (*shape)[lanes], int at)
      : sine1(load<FloatPack>(shape[0] + at)),
        cosine1(load<FloatPack>(shape[1] + at)),
        sine2(load<FloatPack>(shape[2] + at)),
        cosine2(load<FloatPack>(shape[3] + at)) {}

  inline FloatPack at(const float* waves, std::size_t stride, std::size_t t) const {
    return (waves[t] + waves[stride + t] * sine1 + waves[2 * stride + t] * cosine1) +
           (waves[3 * stride + t] * sine2 + waves[4 * stride + t] * cosine2);
  }
  /// side 2: also at the opposite angles (W28).
  template <int side>
  inline void at(const float* waves, std::size_t stride, std::size_t t, FloatPack* value) const {
    if constexpr (side == 1) {
      value[0] = at(waves, stride, t);
    } else {
      const FloatPack even = waves[t] + waves[2 * stride + t] * cosine1 + waves[4 * stride + t] * cosine2;
      const FloatPack odd = waves[stride + t] * sine1 + waves[3 * stride + t] * sine2;
      value[0] = even + odd;
      value[1] = even - odd;
    }
  }
};

/// The sliders of a pack of wires (W17).
struct Sliders {
  FloatPack slip;
  float cap0, cap_per_mean, share;

  Sliders() = default;
  Sliders(const MixedLanes& state, int lane)
      : slip(load<FloatPack>(state.slip + lane)),
        cap0(state.cap),
        cap_per_mean(state.cap_per_mean),
        share(1 - state.elastic) {}

  /// Returns the held strains. Return mapping: the deviation minus the slip is limited to the cap, then the slip is updated.
  inline FloatPack next(const FloatPack& mean, const FloatPack& away) {
    const FloatPack cap = larger(cap0 + cap_per_mean * mean, FloatPack{});
    const FloatPack slides = share * away;
    const FloatPack held = smaller(larger(slides - slip, -cap), cap);
    slip = slides - held;
    return held;
  }
};

/// Range of the slips of a pack of wires at the end of the motion. One sample limits a slip to [slides - cap, slides + cap]. The
/// later samples limit it to [least, most]. Both limits in succession are again one range.
struct SlipRange {
  FloatPack least, most;

  inline void before(const Sliders& of, const FloatPack& mean, const FloatPack& away) {
    const FloatPack cap = larger(of.cap0 + of.cap_per_mean * mean, FloatPack{});
    const FloatPack slides = of.share * away;
    const FloatPack low = smaller(larger(slides - cap, least), most);
    most = smaller(larger(slides + cap, least), most);
    least = low;
  }
};

void mix_pack(MixedLanes& state, int lane, const float* waves, std::size_t stride, std::size_t count, int fibres,
              float* out) {
  const Around around(state.shape, lane);
  const std::size_t per_kind = waves_per_layer * stride;
  const FloatPack zero{};
  Sliders sliders(state, lane);
  for (std::size_t t = 0; t < count; ++t) {
    const FloatPack mean = around.at(waves + mean_strain * per_kind, stride, t);
    const FloatPack away = around.at(waves + deviation * per_kind, stride, t);
    const FloatPack by_friction = sliders.next(mean, away);
    const FloatPack axial = mean + (by_friction + state.elastic * away);
    const FloatPack scale =
        state.scales ? (1.0f + axial) / (1.0f + (mean + away) * state.inverse_radial_share) : zero + 1.0f;
    FloatPack torsion{};
    if (state.with_shear)
      torsion = around.at(waves + shear * per_kind, stride, t) * scale - load<FloatPack>(state.rest[0].data() + lane);
    for (int f = 0; f < fibres; ++f) {
      FloatPack strain = axial, sheared = torsion;
      if (!state.on_axis) {
        strain += around.at(waves + (first_bending + f) * per_kind, stride, t) * scale -
                  load<FloatPack>(state.rest[1 + f].data() + lane);
        const FloatPack per_own_length = load<FloatPack>(state.fibre_scale[f].data() + lane);
        strain *= per_own_length;
        sheared *= per_own_length;
      }
      if (state.with_shear) {
        const FloatPack size = square_root(strain * strain + sheared * sheared);
        strain = select(greater(zero, strain), -size, size);
      }
      store(strain, out + (f * count + t) * lanes + lane);
    }
  }
  store(sliders.slip, state.slip + lane);
}

/// The most frequent case: one fibre at the surface, no shear, curvature per path length. side 2: with their images.
template <int side>
void mix_plain(MixedLanes* const* states, int lane, const float* waves, std::size_t stride, std::size_t count,
               float* const* out) {
  const Around around(states[0]->shape, lane);
  const float* const bending = waves + first_bending * waves_per_layer * stride;
  const float* const deviations = waves + deviation * waves_per_layer * stride;
  const float elastic = states[0]->elastic, inverse_radial_share = states[0]->inverse_radial_share;
  Sliders sliders[side];
  FloatPack rest[side], per_own_length[side];
  for (int k = 0; k < side; ++k) {
    sliders[k] = Sliders(*states[k], lane);
    rest[k] = load<FloatPack>(states[k]->rest[1].data() + lane);
    per_own_length[k] = load<FloatPack>(states[k]->fibre_scale[0].data() + lane);
  }
  for (std::size_t t = 0; t < count; ++t) {
    FloatPack mean[side], away[side], bend[side];
    around.at<side>(waves, stride, t, mean);
    around.at<side>(deviations, stride, t, away);
    around.at<side>(bending, stride, t, bend);
    for (int k = 0; k < side; ++k) {
      const FloatPack axial = mean[k] + (sliders[k].next(mean[k], away[k]) + elastic * away[k]);
      const FloatPack scale = (1.0f + axial) / (1.0f + (mean[k] + away[k]) * inverse_radial_share);
      store(FloatPack((axial + (bend[k] * scale - rest[k])) * per_own_length[k]), out[k] + t * lanes + lane);
    }
  }
  for (int k = 0; k < side; ++k) store(sliders[k].slip, states[k]->slip + lane);
}

void mix(MixedLanes& state, MixedLanes* images, const float* waves, std::size_t stride, std::size_t count, int fibres,
         float* out, float* images_out) {
  static_assert(mean_strain == 0);
  const bool plain = fibres == 1 && state.scales && !state.with_shear && !state.on_axis;
  MixedLanes* const states[] = {&state, images};
  float* const to[] = {out, images_out};
  for (int lane = 0; lane < state.used; lane += float_pack_size) {  // a group has no more images than wires
    if (plain && images) {
      mix_plain<2>(states, lane, waves, stride, count, to);
    } else if (plain) {
      mix_plain<1>(states, lane, waves, stride, count, to);
    } else {
      mix_pack(state, lane, waves, stride, count, fibres, out);
      if (images) mix_pack(*images, lane, waves, stride, count, fibres, images_out);
    }
  }
}

/// The slip of a sample depends on that of the previous sample. `together` packs at a time use the waiting time.
template <int together>
void settle_packs(const MixedRun* runs, int lane, std::size_t stride, std::size_t count) {
  Around around[together];
  Sliders sliders[together];
  SlipRange range[together];
  for (int k = 0; k < together; ++k) {
    around[k] = Around(runs[k].state->shape, lane);
    sliders[k] = Sliders(*runs[k].state, lane);
    range[k] = {load<FloatPack>(runs[k].state->least_slip + lane), load<FloatPack>(runs[k].state->most_slip + lane)};
  }
  for (std::size_t t = count; t-- > 0;)
    for (int k = 0; k < together; ++k) {
      const FloatPack mean = around[k].at(runs[k].waves + mean_strain * waves_per_layer * stride, stride, t);
      range[k].before(sliders[k], mean, around[k].at(runs[k].waves + deviation * waves_per_layer * stride, stride, t));
    }
  for (int k = 0; k < together; ++k) {
    store(range[k].least, runs[k].state->least_slip + lane);
    store(range[k].most, runs[k].state->most_slip + lane);
  }
}

void settle(const MixedRun* runs, std::size_t run_count, std::size_t stride, std::size_t count) {
  constexpr int together = 4;
  for (int lane = 0; lane < lanes; lane += float_pack_size) {
    std::size_t k = 0;
    for (; k + together <= run_count; k += together) settle_packs<together>(runs + k, lane, stride, count);
    for (; k < run_count; ++k) settle_packs<1>(runs + k, lane, stride, count);
  }
}

// ---- measures by which the wires of a bound are ranked -----------------------------------------------------

StrainMeasures measures(const float* strain, std::size_t count) {
  const FloatPack zero{};
  FloatPack low = zero + strain[0], high = low, cycle_sum{}, range_sum{};
  const auto take = [&](const FloatPack& before, const FloatPack& now) {
    low = -larger(-low, -now);
    high = larger(high, now);
    cycle_sum += cycle_share(before, now);
    range_sum += range_share(before, now);
  };
  std::size_t k = 1;
  for (; k + float_pack_size <= count; k += float_pack_size)
    take(load<FloatPack>(strain + k - 1), load<FloatPack>(strain + k));
  if (k < count && count > float_pack_size) {  // the rest of the samples; the lanes before them do not move
    float lane[float_pack_size];
    for (int j = 0; j < float_pack_size; ++j) lane[j] = static_cast<float>(j);
    const auto taken = static_cast<float>(float_pack_size - (count - k));
    const float* const last = strain + count - float_pack_size;
    const FloatPack now = load<FloatPack>(last);
    take(select(greater(FloatPack(taken), load<FloatPack>(lane)), now, load<FloatPack>(last - 1)), now);
  } else if (k < count) {  // fewer than one pack in total; spare lanes stay at the first strain
    float from[float_pack_size], to[float_pack_size];
    for (int lane = 0; lane < float_pack_size; ++lane, ++k) {
      from[lane] = k < count ? strain[k - 1] : strain[0];
      to[lane] = k < count ? strain[k] : strain[0];
    }
    take(load<FloatPack>(from), load<FloatPack>(to));
  }
  return {-largest_lane(-low), largest_lane(high), sum_of_lanes(cycle_sum), sum_of_lanes(range_sum)};
}

}  // namespace

extern const Kernels set;
const Kernels set{DRESSLIFE_MACHINE_NAME,
                  float_pack_size,
                  node_strains,
                  node_strains_in_single,
                  layer_waves,
                  deviations,
                  part_states,
                  part_rows_of_dresspack,
                  node_ingredients,
                  ingredient_waves,
                  deviation_waves,
                  mix,
                  settle,
                  add_path_rates,
                  scan,
                  scan_strains,
                  rank,
                  rank_strains,
                  measures};

}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
