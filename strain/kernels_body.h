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

/// The part of step k in its parent `rod`, once its free strain is known.
inline Rod<Pack> step_down(const Rod<Pack>& rod, const ChainStep& step, const Placement& place,
                           const Rod<double>& rest, const Pack& free_strain) {
  const Rod<Pack> glued = child(rod, place);
  if (step.slide.sliding == Sliding::glued) return glued;
  return slid(glued, free_strain, rest, place.kinematics);
}

/// The parent of level `level` when the ancestor of level `turned_level` is moved on by `turn` sixths of its
/// pitch.
inline Rod<Pack> turned_parent(const BundlePointers& chain, const Descent& descent, int turned_level,
                               int level, int turn) {
  const int first = turned_level - 1;
  Rod<Pack> rod = descent.rods[first];
  for (int k = first; k < level; ++k)
    rod = step_down(rod, chain.steps[k], chain.steps[k].turned[turn], chain.steps[k].turned_rest[turn],
                    descent.free_strain[k]);
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
        sum += path_rate(turned_parent(chain, descent, slide.helical_level, level, turn), place);
      return sum / (phases_per_pitch * slide.mean_rest_rate) - 1.0;
    }
  }
  return Pack{};
}

inline void descend(const BundlePointers& chain, const DeformationColumns& in, std::size_t sample,
                    Descent& descent) {
  descent.rods[0] = uniform_rod<Pack>(load_pack(in.elongation + sample), load_pack(in.curvature1 + sample),
                                      load_pack(in.curvature2 + sample), load_pack(in.twist + sample),
                                      chain.order + chain.step_count);
  for (int k = 0; k < chain.step_count; ++k) {
    const ChainStep& step = chain.steps[k];
    descent.free_strain[k] = free_strain(chain, descent, k, step.place, step.slide, sample);
    descent.rods[k + 1] = step_down(descent.rods[k], step, step.place, step.rest, descent.free_strain[k]);
  }
}

/// Strains of one node's fibres at a pack of samples.
inline void strains_of_node(const BundlePointers& chain, const Descent& descent, const WireNode& node,
                            std::size_t sample, Pack* strain) {
  const Rod<Pack>& parent = descent.rods[chain.step_count];
  const WireState<Pack> wire = wire_state(parent, node.place);
  const bool exact = node.place.kinematics == pipeline::Kinematics::exact;
  const double ideal = exact ? node.place.lay_cosine : 1;
  Pack axial = wire.stretch / (ideal * node.rest_rate) - 1.0;
  Pack bend1 = wire.bend1, bend2 = wire.bend2;
  if (node.slide.sliding != Sliding::glued) {
    axial = free_strain(chain, descent, chain.step_count, node.place, node.slide, sample);
    if (exact) {  // curvature per path length stays (W11)
      const Pack factor = (1.0 + axial) * (ideal * node.rest_rate) / wire.stretch;
      bend1 *= factor;
      bend2 *= factor;
    }
  }
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

void node_strains(const BundlePointers& chain, const DeformationColumns& in, std::size_t first,
                  std::size_t count, double* out, std::size_t stride) {
  for (std::size_t t = 0; t < count; t += pack_size) {
    Descent descent;
    descend(chain, in, first + t, descent);
    Pack strain[most_fibres];
    for (int n = 0; n < chain.node_count; ++n) {
      strains_of_node(chain, descent, chain.nodes[n], first + t, strain);
      for (int f = 0; f < chain.fibre_count; ++f)
        store_pack(strain[f], out + (static_cast<std::size_t>(n) * chain.fibre_count + f) * stride + t);
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
      for (int n = 0; n < waves_per_layer; ++n)
        strains_of_node(chain, descent, chain.nodes[layer * waves_per_layer + n], first + t, strain[n]);
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

inline bool any(const Ints& mask) {
#if defined(__AVX512F__)
  return _mm512_test_epi32_mask(reinterpret_cast<const __m512i&>(mask),
                                reinterpret_cast<const __m512i&>(mask)) != 0;
#else
  typedef std::int64_t Words __attribute__((vector_size(lanes * sizeof(std::int32_t))));
  const Words w = reinterpret_cast<const Words&>(mask);
  return ((w[0] | w[1] | w[2] | w[3]) | (w[4] | w[5] | w[6] | w[7])) != 0;
#endif
}

/// What of a LaneState changes from sample to sample, in registers.
struct LaneRegisters {
  Floats direction, extreme, low, high;
  Ints extreme_at, low_at, high_at;

  explicit LaneRegisters(const LaneState& state)
      : direction(load_lanes<Floats>(state.direction)),
        extreme(load_lanes<Floats>(state.extreme)),
        low(load_lanes<Floats>(state.low)),
        high(load_lanes<Floats>(state.high)),
        extreme_at(load_lanes<Ints>(state.extreme_at)),
        low_at(load_lanes<Ints>(state.low_at)),
        high_at(load_lanes<Ints>(state.high_at)) {}

  void save(LaneState& state) const {
    store_pack(direction, state.direction);
    store_pack(extreme, state.extreme);
    store_pack(low, state.low);
    store_pack(high, state.high);
    store_pack(extreme_at, state.extreme_at);
    store_pack(low_at, state.low_at);
    store_pack(high_at, state.high_at);
  }

  /// One sample; the wires that turn here, or have moved by the gate for the first time, come back as a mask.
  template <bool undecided>
  inline __attribute__((always_inline)) Ints advance(const Floats& x, std::int32_t now, float gate) {
    if constexpr (undecided) {
      low_at = x < low ? Ints{} + now : low_at;
      high_at = x > high ? Ints{} + now : high_at;
    }
    low = x < low ? x : low;
    high = x > high ? x : high;
    const Floats beyond = direction * (x - extreme);
    const Ints further = beyond > 0.0f;
    extreme = further ? x : extreme;
    extreme_at = further ? Ints{} + now : extreme_at;
    Ints event = (beyond < 0.0f) & (beyond <= -gate);
    if constexpr (undecided) event |= (direction == 0.0f) & (high > low) & (high - low >= gate);
    return event;
  }
};

/// Applies an event of TurningPoints::next to one lane of a saved state.
inline void turn_lane(LaneState& state, int lane, float x, std::int32_t now, TurningList* out) {
  if (state.direction[lane] != 0) {
    if (out) add_turning_point(*out, state.extreme[lane], state.extreme_at[lane]);
    state.direction[lane] = -state.direction[lane];
  } else {
    const bool rising = state.high_at[lane] == now;
    const std::int32_t before = rising ? state.low_at[lane] : state.high_at[lane];
    if (out && before > 0) add_turning_point(*out, rising ? state.low[lane] : state.high[lane], before);
    state.direction[lane] = rising ? 1.0f : -1.0f;
  }
  state.extreme[lane] = x;
  state.extreme_at[lane] = now;
}

/// Strains of sixteen wires at one sample (W13).
struct Shape {
  Floats sine1, cosine1, sine2, cosine2;

  explicit Shape(const LaneState& state)
      : sine1(load_lanes<Floats>(state.shape[0])),
        cosine1(load_lanes<Floats>(state.shape[1])),
        sine2(load_lanes<Floats>(state.shape[2])),
        cosine2(load_lanes<Floats>(state.shape[3])) {}

  inline __attribute__((always_inline)) Floats at(const Waves& waves, std::size_t t) const {
    return (waves.at[0][t] + waves.at[1][t] * sine1 + waves.at[2][t] * cosine1) +
           (waves.at[3][t] * sine2 + waves.at[4][t] * cosine2);
  }
};

constexpr std::size_t burst = 4;  // samples run on the speculation that no wire turns

template <bool undecided>
void scan_samples(LaneState& state, const Waves& waves, std::size_t from, std::size_t to, TurningList* out) {
  const Shape shape(state);
  const float gate = state.gate;
  const std::int32_t before = state.sample;
  LaneRegisters now(state);
  for (std::size_t t = from; t < to;) {
    const std::size_t end = t + burst < to ? t + burst : to;
    if (end - t == burst) {
      LaneRegisters ahead = now;
      Ints event{};
      for (std::size_t k = 0; k < burst; ++k)
        event |=
            ahead.advance<undecided>(shape.at(waves, t + k), before + static_cast<std::int32_t>(t + k), gate);
      if (!any(event)) {
        now = ahead;
        t = end;
        continue;
      }
    }
    for (; t < end; ++t) {
      const Floats x = shape.at(waves, t);
      const std::int32_t sample = before + static_cast<std::int32_t>(t);
      const Ints event = now.advance<undecided>(x, sample, gate);
      if (!any(event)) continue;
      now.save(state);
      alignas(64) float strain[lanes];
      alignas(64) std::int32_t turns[lanes];
      store_pack(x, strain);
      store_pack(event, turns);
      for (int lane = 0; lane < lanes; ++lane)
        if (turns[lane])
          turn_lane(state, lane, strain[lane], sample, lane < state.used ? &out[lane] : nullptr);
      now = LaneRegisters(state);
    }
  }
  now.save(state);
}

void scan(LaneState& state, const Waves& waves, std::size_t count, TurningList* out) {
  std::size_t from = 0;
  if (state.sample == 0) {
    const Floats x = Shape(state).at(waves, 0);
    store_pack(x, state.low);
    store_pack(x, state.high);
    store_pack(x, state.extreme);
    for (int lane = 0; lane < state.used; ++lane) add_turning_point(out[lane], state.low[lane], 0);
    from = 1;
  }
  bool undecided = false;
  for (int lane = 0; lane < lanes; ++lane) undecided |= state.direction[lane] == 0;
  if (undecided)
    scan_samples<true>(state, waves, from, count, out);
  else
    scan_samples<false>(state, waves, from, count, out);
  store_pack(Shape(state).at(waves, count - 1), state.last);
  state.sample += static_cast<std::int32_t>(count);
}

}  // namespace

extern const Kernels set;
const Kernels set{DRESSLIFE_MACHINE_NAME, node_strains, layer_waves, add_path_rates, scan};

}  // namespace DRESSLIFE_MACHINE_KERNELS
}  // namespace dresslife::strain
