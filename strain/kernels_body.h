// The hot loops, for one instruction set: included by kernels_*.cpp, each of which defines DRESSLIFE_MACHINE
// and, in front of this file, the target. Needs every standard header it uses to be included before the
// target is set.
#include "strain/pack.h"
// pack.h declares what the templates below are used with
#include "strain/kernels.h"

namespace dresslife::strain {
namespace DRESSLIFE_MACHINE_KERNELS {
namespace {

// ---- strains of a bundle ----------------------------------------------------------------------------------

typedef float FloatPack __attribute__((vector_size(pack_size * sizeof(float))));

inline Pack load_pack(const double* from) {
  Pack pack;
  __builtin_memcpy(&pack, from, sizeof(pack));
  return pack;
}

template <class To, class Vector>
inline void store_pack(const Vector& pack, To* to) {
  __builtin_memcpy(to, &pack, sizeof(pack));
}

/// The states along a chain at one pack of samples: rods[0] is the dresspack, rods[k] the part of level k.
struct Descent {
  Rod<Pack> rods[highest_level + 1];
  Pack free_strain[highest_level + 1];
};

/// The part of step k in its parent `rod`, once its free strain is known. held: what friction holds of its
/// deviation, at this sample.
inline Rod<Pack> step_down(const Rod<Pack>& rod, const ChainStep& step, const Placement& place,
                           const Rod<double>& rest, const Pack& free_strain, const double* held) {
  const Rod<Pack> glued = child(rod, place);
  if (step.slide.sliding == Sliding::glued) return glued;
  if (held == nullptr) return slid(glued, free_strain, rest, place.kinematics);
  Series<Pack> strain;
  strain.order = glued.stretch.order;
  for (int power = 0; power <= strain.order; ++power)
    strain.at[power] = load_pack(held + power * step.slide.held_stride);
  strain.at[0] += free_strain;
  return slid_unevenly(glued, strain, rest, place.kinematics);
}

inline const double* at_sample(const double* row, std::size_t sample) { return row ? row + sample : nullptr; }

/// The parent of level `level` when the ancestor of level `turned_level` is moved on by `turn` sixths of its
/// pitch.
inline Rod<Pack> turned_parent(const BundlePointers& chain, const Descent& descent, int turned_level,
                               int level, int turn, std::size_t sample) {
  const int first = turned_level - 1;
  Rod<Pack> rod = descent.rods[first];
  for (int k = first; k < level; ++k)
    rod = step_down(rod, chain.steps[k], chain.steps[k].turned[turn], chain.steps[k].turned_rest[turn],
                    descent.free_strain[k], at_sample(chain.steps[k].slide.turned_held[turn], sample));
  return rod;
}

/// Axial strain of a component that slides; level: of its parent (0 = the dresspack).
inline Pack free_strain(const BundlePointers& chain, const Descent& descent, int level,
                        const Placement& place, const SlidingNumbers& slide, std::size_t sample) {
  switch (slide.sliding) {
    case Sliding::glued:
      break;
    case Sliding::clamp_to_clamp:
      return load_pack(slide.clamp_strain + sample);
    case Sliding::over_pitch:
      return mean_path_rate(descent.rods[level], place) / slide.mean_rest_rate - 1.0;
    case Sliding::along_ancestor: {
      Pack sum{};
      for (int turn = 0; turn < phases_per_pitch; ++turn)
        sum += path_rate(turned_parent(chain, descent, slide.helical_level, level, turn, sample), place);
      return sum / (phases_per_pitch * slide.mean_rest_rate) - 1.0;
    }
  }
  return Pack{};
}

/// The first `steps` parts of the chain.
inline void descend(const BundlePointers& chain, const DeformationColumns& in, std::size_t sample,
                    Descent& descent, int steps) {
  descent.rods[0] = uniform_rod<Pack>(load_pack(in.elongation + sample), load_pack(in.curvature1 + sample),
                                      load_pack(in.curvature2 + sample), load_pack(in.twist + sample),
                                      chain.order + chain.step_count);
  for (int k = 0; k < steps; ++k) {
    const ChainStep& step = chain.steps[k];
    descent.free_strain[k] = free_strain(chain, descent, k, step.place, step.slide, sample);
    descent.rods[k + 1] = step_down(descent.rods[k], step, step.place, step.rest, descent.free_strain[k],
                                    at_sample(step.slide.held, sample));
  }
}

inline void descend(const BundlePointers& chain, const DeformationColumns& in, std::size_t sample,
                    Descent& descent) {
  descend(chain, in, sample, descent, chain.step_count);
}

void deviations(const BundlePointers& chain, int turn, int turned_level, const DeformationColumns& in,
                std::size_t first, std::size_t count, double* out, std::size_t stride) {
  const int last = chain.step_count - 1;
  const ChainStep& step = chain.steps[last];
  const Placement& place = turn < 0 ? step.place : step.turned[turn];
  const Rod<double>& rest = turn < 0 ? step.rest : step.turned_rest[turn];
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent, last);
    const Pack mean = free_strain(chain, descent, last, step.place, step.slide, first + t);
    const Rod<Pack> parent = turn < 0 || turned_level == 0
                                 ? descent.rods[last]
                                 : turned_parent(chain, descent, turned_level, last, turn, first + t);
    const Rod<Pack> glued = child(parent, place);
    const Series<Pack> ratio = glued.stretch * (constant_series(1.0, rest.stretch.order) / rest.stretch);
    store_pack(mean, out + t);
    store_pack(Pack(ratio.at[0] - 1.0 - mean), out + stride + t);
    for (int power = 1; power <= ratio.order; ++power)
      store_pack(ratio.at[power], out + (1 + power) * stride + t);
  }
}

/// Strains of one node's fibres at a pack of samples. sliding: its axial strain when it slides.
inline void strains_of_node(const BundlePointers& chain, const Rod<Pack>& parent, const WireNode& node,
                            const Pack& sliding, Pack* strain) {
  const WireState<Pack> wire = wire_state(parent, node.place);
  Pack axial = wire.stretch * node.inverse_rest_stretch - 1.0;
  Pack bend1 = wire.bend1, bend2 = wire.bend2;
  if (node.slide.sliding != Sliding::glued) {
    axial = sliding;
    if (node.place.kinematics == pipeline::Kinematics::exact) {  // curvature per path length stays (W11)
      const Pack factor = (1.0 + sliding) * node.rest.stretch * wire.inverse_stretch;
      bend1 *= factor;
      bend2 *= factor;
    }
  }
  axial *= node.strain_factor;
  bend1 -= node.rest.bend1;
  bend2 -= node.rest.bend2;
  for (int f = 0; f < chain.fibre_count; ++f) {
    const Fibre& fibre = chain.fibres[f];
    strain[f] = fibre.on_axis
                    ? axial
                    : axial + fibre_strain(bend1, bend2, node.wire_radius, fibre.phi_sine, fibre.phi_cosine);
  }
}

constexpr int most_fibres = 64;
constexpr double inverse_root_3 = 0.57735026918962576;

void node_strains(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                  std::size_t count, double* out, std::size_t stride) {
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    Pack strain[most_fibres];
    for (int n = 0; n < chain.node_count; ++n) {
      const WireNode& node = chain.nodes[n];
      const Pack sliding = free_strain(chain, descent, chain.step_count, node.place, node.slide, first + t);
      strains_of_node(chain, descent.rods[chain.step_count], node, sliding, strain);
      for (int f = 0; f < chain.fibre_count; ++f)
        store_pack(strain[f], out + (static_cast<std::size_t>(n) * chain.fibre_count + f) * stride + t);
    }
  }
}

/// What the strain of a node is made of (see Ingredient).
inline void ingredients_of_node(const BundlePointers& chain, const Descent& descent, const WireNode& node,
                                const Pack& sliding, Pack* out) {
  const WireState<Pack> wire = wire_state(descent.rods[chain.step_count], node.place);
  const Pack glued = wire.stretch * node.inverse_rest_stretch - 1.0;
  out[mean_strain] = sliding;
  out[deviation] = node.strain_factor * glued - sliding;
  out[shear] = (inverse_root_3 * node.strain_factor * node.shear_radius) * wire.twist;
  for (int f = 0; f < chain.fibre_count; ++f) {
    const Fibre& fibre = chain.fibres[f];
    out[first_bending + f] = fibre.on_axis ? Pack{}
                                           : fibre_strain(wire.bend1, wire.bend2, node.wire_radius,
                                                          fibre.phi_sine, fibre.phi_cosine);
  }
}

void node_ingredients(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                      std::size_t count, double* out, std::size_t stride) {
  const int kinds = ingredients(chain.fibre_count);
  Pack values[ingredients(most_fibres)];
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    for (int n = 0; n < chain.node_count; ++n) {
      const WireNode& node = chain.nodes[n];
      ingredients_of_node(chain, descent, node,
                          free_strain(chain, descent, chain.step_count, node.place, node.slide, first + t),
                          values);
      for (int k = 0; k < kinds; ++k)
        store_pack(values[k], out + (static_cast<std::size_t>(n) * kinds + k) * stride + t);
    }
  }
}

/// Fourier coefficients of five evenly spaced values around the layer (W13).
struct FiveToWaves {
  double factor[waves_per_layer][waves_per_layer];
  FiveToWaves() {
    for (int n = 0; n < waves_per_layer; ++n) {
      const double angle = 2 * 3.141592653589793 * n / waves_per_layer;
      factor[0][n] = 1.0 / waves_per_layer;
      factor[1][n] = 2.0 / waves_per_layer * std::sin(angle);
      factor[2][n] = 2.0 / waves_per_layer * std::cos(angle);
      factor[3][n] = 2.0 / waves_per_layer * std::sin(2 * angle);
      factor[4][n] = 2.0 / waves_per_layer * std::cos(2 * angle);
    }
  }
};

void layer_waves(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                 std::size_t count, float* out, std::size_t stride) {
  const FiveToWaves to_waves;
  const int layers = chain.node_count / waves_per_layer;
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    for (int layer = 0; layer < layers; ++layer) {
      Pack strain[waves_per_layer][most_fibres];
      Pack sliding{};
      for (int n = 0; n < waves_per_layer; ++n) {
        const WireNode& node = chain.nodes[layer * waves_per_layer + n];
        if (n == 0 || node.slide.sliding != Sliding::over_pitch)  // the mean over the pitch is the layer's
          sliding = free_strain(chain, descent, chain.step_count, node.place, node.slide, first + t);
        strains_of_node(chain, descent.rods[chain.step_count], node, sliding, strain[n]);
      }
      for (int f = 0; f < chain.fibre_count; ++f)
        for (int w = 0; w < waves_per_layer; ++w) {
          Pack sum = to_waves.factor[w][0] * strain[0][f];
          for (int n = 1; n < waves_per_layer; ++n) sum += to_waves.factor[w][n] * strain[n][f];
          const std::size_t row =
              (static_cast<std::size_t>(layer) * chain.fibre_count + f) * waves_per_layer + w;
          store_pack(__builtin_convertvector(sum, FloatPack), out + row * stride + t);
        }
    }
  }
}

void ingredient_waves(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                      std::size_t count, float* out, std::size_t stride) {
  const FiveToWaves to_waves;
  const int layers = chain.node_count / waves_per_layer, kinds = ingredients(chain.fibre_count);
  Pack values[waves_per_layer][ingredients(most_fibres)];
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    for (int layer = 0; layer < layers; ++layer) {
      for (int n = 0; n < waves_per_layer; ++n) {
        const WireNode& node = chain.nodes[layer * waves_per_layer + n];
        ingredients_of_node(chain, descent, node,
                            free_strain(chain, descent, chain.step_count, node.place, node.slide, first + t),
                            values[n]);
      }
      for (int k = 0; k < kinds; ++k)
        for (int w = 0; w < waves_per_layer; ++w) {
          Pack sum = to_waves.factor[w][0] * values[0][k];
          for (int n = 1; n < waves_per_layer; ++n) sum += to_waves.factor[w][n] * values[n][k];
          const std::size_t row = (static_cast<std::size_t>(layer) * kinds + k) * waves_per_layer + w;
          store_pack(__builtin_convertvector(sum, FloatPack), out + row * stride + t);
        }
    }
  }
}

void add_path_rates(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                    std::size_t count, double weight, double* sum, std::size_t stride) {
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    for (int n = 0; n < chain.node_count; ++n) {
      double* to = sum + static_cast<std::size_t>(n) * stride + t;
      store_pack(
          Pack(load_pack(to) + weight * path_rate(descent.rods[chain.step_count], chain.nodes[n].place)), to);
    }
  }
}

// ---- turning points ---------------------------------------------------------------------------------------

typedef float Floats __attribute__((vector_size(lanes * sizeof(float))));
typedef std::int32_t Ints __attribute__((vector_size(lanes * sizeof(std::int32_t))));

template <class Vector, class Value>
inline Vector load_lanes(const Value* from) {
  Vector vector;
  __builtin_memcpy(&vector, from, sizeof(vector));
  return vector;
}

/// Bit j: mask of lane j.
inline unsigned bits(const Ints& mask) {
#if defined(__AVX512F__)
  return _mm512_movepi32_mask(reinterpret_cast<const __m512i&>(mask));
#elif defined(__AVX2__)
  const __m256* half = reinterpret_cast<const __m256*>(&mask);
  return static_cast<unsigned>(_mm256_movemask_ps(half[0]) | _mm256_movemask_ps(half[1]) << 8);
#else
  typedef std::int64_t Words __attribute__((vector_size(lanes * sizeof(std::int32_t))));
  const Words w = reinterpret_cast<const Words&>(mask);
  if (((w[0] | w[1] | w[2] | w[3]) | (w[4] | w[5] | w[6] | w[7])) == 0) return 0;
  unsigned found = 0;
  for (int lane = 0; lane < lanes; ++lane) found |= mask[lane] ? 1u << lane : 0;
  return found;
#endif
}

/// Values of one ingredient at sixteen wires.
struct Around {
  Floats sine1, cosine1, sine2, cosine2;

  explicit Around(const float (*shape)[lanes])
      : sine1(load_lanes<Floats>(shape[0])),
        cosine1(load_lanes<Floats>(shape[1])),
        sine2(load_lanes<Floats>(shape[2])),
        cosine2(load_lanes<Floats>(shape[3])) {}

  inline Floats at(const float* waves, std::size_t stride, std::size_t t) const {
    return (waves[t] + waves[stride + t] * sine1 + waves[2 * stride + t] * cosine1) +
           (waves[3 * stride + t] * sine2 + waves[4 * stride + t] * cosine2);
  }
};

inline Floats square_root_of(const Floats& x) {
  Floats root;
  for (int lane = 0; lane < lanes; ++lane) root[lane] = __builtin_sqrtf(x[lane]);
  return root;
}

void mix(MixedLanes& state, const float* waves, std::size_t stride, std::size_t count, int fibres,
         float* out) {
  const Around around(state.shape);
  const std::size_t per_kind = waves_per_layer * stride;
  const Floats zero{};
  Floats slip = load_lanes<Floats>(state.slip);
  for (std::size_t t = 0; t < count; ++t) {
    const Floats mean = around.at(waves + mean_strain * per_kind, stride, t);
    const Floats away = around.at(waves + deviation * per_kind, stride, t);
    Floats cap = state.cap + state.cap_per_mean * mean;
    cap = cap > 0.0f ? cap : zero;
    // return mapping (W17): what is held is the deviation less the slip, cut at the cap; the slip follows
    Floats held = away - slip;
    held = held > cap ? cap : held;
    held = held < -cap ? -cap : held;
    slip = away - held;
    const Floats axial = mean + held;
    const Floats scale = state.scales ? (1.0f + axial) / (1.0f + (mean + away)) : Floats{} + 1.0f;
    Floats torsion{};
    if (state.with_shear)
      torsion =
          around.at(waves + shear * per_kind, stride, t) * scale - load_lanes<Floats>(state.rest[0].data());
    for (int f = 0; f < fibres; ++f) {
      Floats strain = axial;
      if (!state.on_axis)
        strain += around.at(waves + (first_bending + f) * per_kind, stride, t) * scale -
                  load_lanes<Floats>(state.rest[1 + f].data());
      if (state.with_shear) {
        const Floats size = square_root_of(strain * strain + torsion * torsion);
        strain = strain < 0.0f ? -size : size;
      }
      store_pack(strain, out + (f * count + t) * lanes);
    }
  }
  store_pack(slip, state.slip);
}

/// Factors of the waves for sixteen wires (W13), all times `sign`: +1 or the direction in which each wire
/// moves.
struct WaveShape {
  Floats sign, sine1, cosine1, sine2, cosine2;

  WaveShape(const LaneState& state, const Floats& of)
      : sign(of),
        sine1(of * load_lanes<Floats>(state.shape[0])),
        cosine1(of * load_lanes<Floats>(state.shape[1])),
        sine2(of * load_lanes<Floats>(state.shape[2])),
        cosine2(of * load_lanes<Floats>(state.shape[3])) {}

  inline __attribute__((always_inline)) Floats at(const Waves& waves, std::size_t t) const {
    return (waves.at[0][t] * sign + waves.at[1][t] * sine1 + waves.at[2][t] * cosine1) +
           (waves.at[3][t] * sine2 + waves.at[4][t] * cosine2);
  }
  inline __attribute__((always_inline)) void flip(const Ints& where) {
    sign = where ? -sign : sign;
    sine1 = where ? -sine1 : sine1;
    cosine1 = where ? -cosine1 : cosine1;
    sine2 = where ? -sine2 : sine2;
    cosine2 = where ? -cosine2 : cosine2;
  }
};

/// The same for strains that are there already.
struct Strains {
  Floats sign;

  Strains(const LaneState&, const Floats& of) : sign(of) {}

  inline __attribute__((always_inline)) Floats at(const float* strain, std::size_t t) const {
    return sign * load_lanes<Floats>(strain + t * lanes);
  }
  inline __attribute__((always_inline)) void flip(const Ints& where) { sign = where ? -sign : sign; }
};

const Floats forward = Floats{} + 1.0f;

/// Decided wires: strain times direction rises to `extreme`; a turn is where it has fallen from there by the
/// gate. Scans samples [from, to) and turns with them.
template <class Shape, class Source>
void scan_decided(LaneState& state, const Source& waves, std::size_t from, std::size_t to,
                  TurningPoint** end) {
  Shape toward(state, load_lanes<Floats>(state.direction));
  Floats extreme = toward.sign * load_lanes<Floats>(state.extreme);
  Ints extreme_at = load_lanes<Ints>(state.extreme_at);
  const unsigned used = (1u << state.used) - 1;
  for (std::size_t t = from; t < to; ++t) {
    const std::int32_t sample = state.sample + static_cast<std::int32_t>(t);
    const Floats y = toward.at(waves, t);
    const Ints further = y > extreme;
    extreme = further ? y : extreme;
    extreme_at = further ? Ints{} + sample : extreme_at;
    const Ints turned = extreme - y > state.below_gate;
    unsigned left = bits(turned);
    if (__builtin_expect(left != 0, 0)) {
      alignas(64) float strain[lanes];
      alignas(64) std::int32_t at[lanes];
      store_pack(Floats(toward.sign * extreme), strain);
      store_pack(extreme_at, at);
      for (left &= used; left != 0; left &= left - 1) {
        const int lane = __builtin_ctz(left);
        *end[lane]++ = {strain[lane], static_cast<std::uint32_t>(at[lane])};
      }
      toward.flip(turned);
      extreme = turned ? -y : extreme;
      extreme_at = turned ? Ints{} + sample : extreme_at;
    }
  }
  store_pack(toward.sign, state.direction);
  store_pack(Floats(toward.sign * extreme), state.extreme);
  store_pack(extreme_at, state.extreme_at);
}

struct Stretch {
  std::size_t end;   ///< the sample after the last one seen
  unsigned decided;  ///< wires that have moved by the gate there
};

/// Wires that have not moved by the gate yet: follows their lowest and highest strain from sample `from` to
/// the first at which one of them has, or to `to`.
template <class Shape, class Source>
Stretch scan_undecided(LaneState& state, const Source& waves, std::size_t from, std::size_t to) {
  const Shape shape(state, forward);
  const Ints undecided = load_lanes<Floats>(state.direction) == 0.0f;
  Floats low = load_lanes<Floats>(state.low), high = load_lanes<Floats>(state.high);
  Ints low_at = load_lanes<Ints>(state.low_at), high_at = load_lanes<Ints>(state.high_at);
  unsigned decided = 0;
  std::size_t t = from;
  for (; t < to && decided == 0; ++t) {
    const std::int32_t sample = state.sample + static_cast<std::int32_t>(t);
    const Floats x = shape.at(waves, t);
    const Ints lower = x<low, higher = x> high;
    low = lower ? x : low;
    high = higher ? x : high;
    low_at = lower ? Ints{} + sample : low_at;
    high_at = higher ? Ints{} + sample : high_at;
    decided = bits(undecided & (high - low > state.below_gate));
  }
  store_pack(low, state.low);
  store_pack(high, state.high);
  store_pack(low_at, state.low_at);
  store_pack(high_at, state.high_at);
  return {t, decided};
}

/// Starts the wires that have moved by the gate.
void decide(LaneState& state, unsigned decided, TurningPoint** end) {
  for (; decided != 0; decided &= decided - 1) {  // the newer of lowest and highest is where the wire is now
    const int lane = __builtin_ctz(decided);
    const bool rising = state.high_at[lane] > state.low_at[lane];
    const std::int32_t before = rising ? state.low_at[lane] : state.high_at[lane];
    if (lane < state.used && before > 0)
      *end[lane]++ = {rising ? state.low[lane] : state.high[lane], static_cast<std::uint32_t>(before)};
    state.direction[lane] = rising ? 1.0f : -1.0f;
    state.extreme[lane] = rising ? state.high[lane] : state.low[lane];
    state.extreme_at[lane] = rising ? state.high_at[lane] : state.low_at[lane];
  }
}

template <class Shape, class Source>
void scan_from(LaneState& state, const Source& waves, std::size_t count, TurningPoint** end) {
  const Shape shape(state, forward);
  std::size_t from = 0;
  if (state.sample == 0) {
    const Floats x = shape.at(waves, 0);
    store_pack(x, state.low);
    store_pack(x, state.high);
    store_pack(x, state.extreme);
    for (int lane = 0; lane < state.used; ++lane) *end[lane]++ = {state.low[lane], 0};
    from = 1;
  }
  // Undecided wires have direction 0, so the decided scan leaves them alone; it runs piece by piece between
  // the samples at which others are decided.
  while (from < count) {
    Stretch stretch{count, 0};
    if (bits(load_lanes<Floats>(state.direction) == 0.0f) != 0)
      stretch = scan_undecided<Shape>(state, waves, from, count);
    scan_decided<Shape>(state, waves, from, stretch.end, end);
    decide(state, stretch.decided, end);
    from = stretch.end;
  }
  store_pack(shape.at(waves, count - 1), state.last);
  state.sample += static_cast<std::int32_t>(count);
}

void scan(LaneState& state, const Waves& waves, std::size_t count, TurningPoint** end) {
  scan_from<WaveShape>(state, waves, count, end);
}

void scan_strains(LaneState& state, const float* strain, std::size_t count, TurningPoint** end) {
  scan_from<Strains>(state, strain, count, end);
}

}  // namespace

extern const Kernels set;
const Kernels set{DRESSLIFE_MACHINE_NAME, node_strains, layer_waves,    deviations, node_ingredients,
                  ingredient_waves,       mix,          add_path_rates, scan,       scan_strains};

}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
