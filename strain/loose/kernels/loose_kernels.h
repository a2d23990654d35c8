// The hot loops of loose cables, compiled once per instruction set: cables of one hose side by side in the lanes of a
// register, node after node along them. Everything here is plain data and pointers (strain/kernels/kernels.h says
// why). Equations: strain/loose/cable_lines.h and ring.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dresslife::strain {

constexpr std::size_t most_lanes = 8;  ///< of any register, in double precision: cables are padded to a multiple of it

/// Cables of one hose. Number i of cable k at [i * lanes + k], component d of a node's vector at
/// [(2 * node + d) * lanes + k]. Where they are kept from sample to sample, or where they come to rest.
struct LineBatch {
  std::size_t nodes = 0, lanes = 0;
  double length = 0, spacing = 0;  ///< of the hose's axis, of its nodes [m]

  // The hose, the same for all: (node, 2) K [1/m] and what pulls [m/s2]; (node) elongation.
  const double *curvature = nullptr, *pull = nullptr, *elongation = nullptr;

  // (lane) what the cables are, see LooseCable; no limit is infinite.
  double *bending_stiffness = nullptr, *axial_stiffness = nullptr, *mass_per_length = nullptr;
  double *wall_stiffness = nullptr, *play = nullptr, *farthest = nullptr, *nearest = nullptr, *gap = nullptr;
  double* per_radius = nullptr;        ///< 1 / |a0|, 0 on the hose's axis [1/m]
  double* drag = nullptr;              ///< eta of this sample [N/m2]
  double* free_length_rate = nullptr;  ///< free length over that of the hose
  double *slipped = nullptr, *least_strain = nullptr, *most_strain = nullptr;  ///< see CableTension
  double* counts = nullptr;            ///< 1; 0: a spare lane

  double* rest = nullptr;                      ///< (node, 2, lane) K0 and how its place bends in it [1/m]
  double *place = nullptr, *before = nullptr;  ///< (node, 2, lane) A0, A_before [m]
  double* path = nullptr;                      ///< (node, 2, lane) A [m]

  double *strain = nullptr, *tension = nullptr, *stiffness = nullptr;  ///< (lane) [1], [N], [N]
  double* press = nullptr;                                             ///< (node, lane) [N/m]; null: not needed
  double *slope = nullptr, *gained = nullptr;                          ///< (node, 2, lane)

  // Scratch, of where they come to rest alone.
  double *solved = nullptr, *soft = nullptr, *step = nullptr, *from = nullptr, *going = nullptr;  ///< (node, 2, lane)
  double *blocks = nullptr, *factors = nullptr;  ///< (node, 3, lane), (node, 7, lane)
};

/// What cables keep from sample to sample beside their batch, each (node, 2, lane).
struct LineMemory {
  const double *laid = nullptr, *laid_bent = nullptr;  ///< the place, and its second derivative, in the frame in which it stays
  const double* frame = nullptr;                       ///< cosine and sine of that frame against the untwisted one
  double* velocity = nullptr;                          ///< in that frame [m/s]
};

/// The hose at one sample, (node, 2): see HoseLine.
struct HoseFrame {
  const double *turn = nullptr, *rest = nullptr;
};

/// Cables where they rest.
struct LineAnswer {
  double* bends = nullptr;                          ///< (node, 2, lane) curvature less that at rest, untwisted frame [1/m]
  double *hose_bends = nullptr, *offset = nullptr;  ///< (node, 2, lane) the same in the hose's frame; b [m]
  double* gain = nullptr;                           ///< (element, lane)
  double* mean_gain = nullptr;                      ///< (lane)
  double *bent = nullptr, *missed = nullptr;        ///< (lane) sums that grow, see CableLines::bent()
};

// What a cable takes along to where it comes to rest: what it is (lane), and where (node, 2, lane).
constexpr double* LineBatch::*what_cables_are[] = {
    &LineBatch::bending_stiffness, &LineBatch::axial_stiffness, &LineBatch::mass_per_length, &LineBatch::wall_stiffness,
    &LineBatch::play, &LineBatch::farthest, &LineBatch::nearest, &LineBatch::gap, &LineBatch::per_radius, &LineBatch::drag,
    &LineBatch::free_length_rate, &LineBatch::slipped, &LineBatch::least_strain, &LineBatch::most_strain};
constexpr double* LineBatch::*where_cables_are[] = {&LineBatch::rest, &LineBatch::place, &LineBatch::before,
                                                    &LineBatch::path};

/// A cable that is to come to rest.
struct WaitingCable {
  const LineBatch* kept;
  std::size_t lane;
  std::int32_t* iterations;  ///< gets those that it takes
};

constexpr std::size_t bench_lanes = 2 * most_lanes;  ///< room for cables on their way to rest

/// What turns the cables of a ring: bands (row, 3) and what each cable gains (row, lane); row: a node inside.
struct RingSystem {
  double *bands = nullptr, *table = nullptr;
};

struct LooseKernels {
  /// Every cable to the minimum of its energy, in at most `most` iterations. They may be kept in several batches of one hose at one
  /// sample; the first ones take the lanes of the bench, and as one rests the next takes its place. Their paths are recorded, and how
  /// they press where their batch asks.
  void (*relax)(const LineBatch& bench, const WaitingCable* cables, std::size_t count, int most);
  /// The next sample: K0 and A0, and the path from its frame to the untwisted one, `ahead` seconds on.
  void (*begin)(const LineBatch&, const LineMemory&, const HoseFrame&, double ahead);
  /// Curvature and gain of the paths, from the batch's path and its rest.
  void (*follow)(const LineBatch&, const LineAnswer&);
  /// After follow(): how cables lie in the hose's frame, and what its nodes miss.
  void (*tell)(const LineBatch&, const LineMemory&, const HoseFrame&, const LineAnswer&);
  /// The sample is over: the path back to its frame, and its velocity over so many seconds; 0: it keeps that which it has.
  void (*end)(const LineBatch&, const LineMemory&, double time);
  /// Every cable to its place in the ring's frame (node, 2), cosine and sine; laid: its place in that (node, 2, lane).
  /// with_slope: then tension and slope of all but contact.
  void (*place)(const LineBatch&, const double* laid, const double* frame, bool with_slope);
  void (*assemble_turn)(const LineBatch&, const RingSystem&);
  /// Slope of the sum of the energies (row).
  void (*slope_of_turn)(const LineBatch&, double* slope);
  /// bands: as factors. table: (row, lane) right-hand sides, which become solutions.
  void (*substitute_turn)(const double* bands, std::size_t rows, std::size_t lanes, double* table);
  /// Sum over rows of a's column k times b's column j, to product[k * lanes + j].
  void (*products)(const double* a, const double* b, std::size_t rows, std::size_t lanes, double* product);
};

/// For the instruction set that every hot loop runs on (pipeline/base/instruction_set.h).
const LooseKernels& loose_kernels();

}  // namespace dresslife::strain
