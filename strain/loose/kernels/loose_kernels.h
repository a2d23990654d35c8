// The hot loops of loose cables, compiled once per instruction set: cables of one hose side by side in the lanes of a
// register, node after node along them. Everything here is plain data and pointers (strain/kernels/kernels.h says
// why). Equations: strain/loose/cable_lines.h and ring.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dresslife::strain {

constexpr std::size_t most_lanes = 8;  ///< of any register, in double precision: cables are padded to a multiple of it

/// Cables of one hose. Number i of cable k at [i * lanes + k], component d of a node's vector at
/// [(2 * node + d) * lanes + k].
struct LineBatch {
  std::size_t nodes = 0, lanes = 0;
  double length = 0, spacing = 0;  ///< of the hose's axis, of its nodes [m]

  // The hose, the same for all: (node, 2) K [1/m] and what pulls [m/s2]; (node) elongation.
  const double *curvature = nullptr, *pull = nullptr, *elongation = nullptr;

  // (lane) what the cables are, see LooseCable; no limit is infinite.
  const double *bending_stiffness = nullptr, *axial_stiffness = nullptr, *mass_per_length = nullptr;
  const double *wall_stiffness = nullptr, *play = nullptr, *farthest = nullptr, *nearest = nullptr, *gap = nullptr;
  const double* per_radius = nullptr;        ///< 1 / |a0|, 0 on the hose's axis [1/m]
  const double* drag = nullptr;              ///< eta of this sample [N/m2]
  const double* free_length_rate = nullptr;  ///< free length over that of the hose
  const double *slipped = nullptr, *least_strain = nullptr, *most_strain = nullptr;  ///< see CableTension
  const double* counts = nullptr;            ///< 1; 0: a spare lane

  const double* rest = nullptr;                      ///< (node, 2, lane) K0 and how its place bends in it [1/m]
  const double *place = nullptr, *before = nullptr;  ///< (node, 2, lane) A0, A_before [m]
  double* path = nullptr;                            ///< (node, 2, lane) A [m]

  double *strain = nullptr, *tension = nullptr, *stiffness = nullptr;  ///< (lane) [1], [N], [N]
  double* press = nullptr;                                             ///< (node, lane) [N/m]
  double *slope = nullptr, *gained = nullptr;                          ///< (node, 2, lane)
  double *step = nullptr, *soft = nullptr, *from = nullptr, *going = nullptr;  ///< (node, 2, lane), scratch
  double *blocks = nullptr, *factors = nullptr;  ///< (node, 3, lane), (node, 7, lane), scratch
};

/// What turns the cables of a ring: bands (row, 3), what each cable gains (row, lane) and the slope (row); row: a node
/// inside.
struct RingSystem {
  double *bands = nullptr, *table = nullptr, *slope = nullptr;
};

struct LooseKernels {
  /// Every cable to the minimum of its energy. iterations: (lane), at most `most` each.
  void (*relax)(const LineBatch&, int most, std::int32_t* iterations);
  /// Every cable to its place in the ring's frame (node, 2), cosine and sine; laid: its place in that (node, 2, lane).
  /// Then tension and slope of all but contact.
  void (*place)(const LineBatch&, const double* laid, const double* frame);
  void (*assemble_turn)(const LineBatch&, const RingSystem&);
  /// Of the slope alone.
  void (*slope_of_turn)(const LineBatch&, double* slope);
  /// bands: as factors. table: (row, lane) right-hand sides, which become solutions.
  void (*substitute_turn)(const double* bands, std::size_t rows, std::size_t lanes, double* table);
  /// Sum over rows of a's column k times b's column j, to product[k * lanes + j].
  void (*products)(const double* a, const double* b, std::size_t rows, std::size_t lanes, double* product);
};

/// For the instruction set that every hot loop runs on (pipeline/instruction_set.h).
const LooseKernels& loose_kernels();

}  // namespace dresslife::strain
