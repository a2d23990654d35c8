// The hot loops of loose cables, compiled once per instruction set: cables of one hose side by side in the lanes of a
// register, node after node along them. This header contains only plain data and pointers (reason: strain/kernels/kernels.h).
// Equations: strain/loose/cable_lines.h and ring.h.
#pragma once

#include <cstddef>
#include <cstdint>

namespace dresslife::strain {

constexpr std::size_t most_lanes =
    8;  ///< lanes of the widest register in double precision; cables are padded to a multiple

/// Cables of one hose. Value i of cable k is at [i * lanes + k], component d of a node's vector at
/// [(2 * node + d) * lanes + k]. Used for the storage from sample to sample, and for the bench on which cables are computed.
/// Only registers that contain a cable are computed.
struct LineBatch {
  std::size_t nodes = 0, lanes = 0, cables = 0;
  double length = 0, spacing = 0;  ///< of the hose's axis, between nodes [m]

  // The hose, the same for all cables: (node, 2) K [1/m] and gravity minus acceleration [m/s2]; (node) elongation.
  const double *curvature = nullptr, *pull = nullptr, *elongation = nullptr;

  // (lane) properties of the cables, see LooseCable; infinity: no limit.
  double *bending_stiffness = nullptr, *axial_stiffness = nullptr, *mass_per_length = nullptr;
  double *wall_stiffness = nullptr, *play = nullptr, *farthest = nullptr, *nearest = nullptr, *gap = nullptr;
  double* per_radius = nullptr;  ///< 1 / |a0|, 0 on the hose's axis [1/m]
  double* drag = nullptr;        ///< eta of this sample [N/m2]
  double *friction = nullptr, *line_load = nullptr;
  double* stick = nullptr;             ///< stiffness of friction that holds [N/m2]; 0: no friction at this sample
  double* free_length_rate = nullptr;  ///< free length over that of the hose
  double *slipped = nullptr, *least_strain = nullptr, *most_strain = nullptr;  ///< see CableTension
  double* counts = nullptr;                                                    ///< 1: a cable, 0: a spare lane

  double* rest = nullptr;  ///< (node, 2, lane) K0 plus the curvature of its place in it [1/m]
  double *place = nullptr,
         *before = nullptr;  ///< (node, 2, lane) A0; null: a ring's cables, which stay at A0. A_before [m]
  double* path = nullptr;    ///< (node, 2, lane) A [m]
  /// Dry friction, (node, 2, lane): direction around the hose; displacement from the points where the cable sticks, around the
  /// hose and outward, at A_before [m]; largest forces in these directions [N/m].
  double *around = nullptr, *stretch = nullptr, *most_friction = nullptr;

  double *strain = nullptr, *tension = nullptr, *stiffness = nullptr;  ///< (lane) [1], [N], [N]
  double* press = nullptr;                                             ///< (node, lane) [N/m]; null: not needed

  // Scratch memory of the bench.
  double *solved = nullptr, *soft = nullptr, *step = nullptr, *from = nullptr, *going = nullptr;  ///< (node, 2, lane)
  double* factors = nullptr;                                                                      ///< (node, 7, lane)
};

/// Data that cables keep from sample to sample in addition to their batch, each (node, 2, lane).
struct LineMemory {
  const double *laid = nullptr,
               *laid_bent = nullptr;  ///< place and its second derivative in the frame in which it is constant
  const double* frame = nullptr;      ///< cosine and sine of this frame against the untwisted frame
  double* velocity = nullptr;         ///< in this frame [m/s]
};

/// The hose at one sample, (node, 2): see HoseLine.
struct HoseFrame {
  const double *turn = nullptr, *rest = nullptr;
};

/// Results for cables at rest.
struct LineAnswer {
  double* bends = nullptr;  ///< (node, 2, lane) curvature minus `rest`, in the untwisted frame [1/m]
  double *hose_bends = nullptr, *offset = nullptr;  ///< (node, 2, lane) `bends` in the hose's frame; b [m]
  double* gain = nullptr;                           ///< (element, lane)
  double* mean_gain = nullptr;                      ///< (lane)
  double *bent = nullptr, *missed = nullptr;        ///< (lane) sums that are increased, see CableLines::bent()
};

// Data of a cable that are copied to the bench: properties (lane), and positions (node, 2, lane).
constexpr double* LineBatch::*what_cables_are[] = {&LineBatch::bending_stiffness,
                                                   &LineBatch::axial_stiffness,
                                                   &LineBatch::mass_per_length,
                                                   &LineBatch::wall_stiffness,
                                                   &LineBatch::play,
                                                   &LineBatch::farthest,
                                                   &LineBatch::nearest,
                                                   &LineBatch::gap,
                                                   &LineBatch::per_radius,
                                                   &LineBatch::drag,
                                                   &LineBatch::stick,
                                                   &LineBatch::free_length_rate,
                                                   &LineBatch::slipped,
                                                   &LineBatch::least_strain,
                                                   &LineBatch::most_strain};
constexpr double* LineBatch::*where_cables_are[] = {&LineBatch::rest, &LineBatch::place, &LineBatch::before,
                                                    &LineBatch::path};
constexpr double* LineBatch::*how_cables_rub[] = {
    &LineBatch::around, &LineBatch::stretch, &LineBatch::most_friction};  ///< (node, 2, lane), where `stick` is not 0

/// A cable that waits for the bench.
struct WaitingCable {
  const LineBatch* kept;
  std::size_t lane;
  std::int32_t* iterations;  ///< receives the number of iterations
};

constexpr std::size_t bench_lanes = most_lanes;  ///< lanes of the bench

/// A ring's turn: slope of the sum of the energies (row), matrix of the turn without the cables' stretch (row, 3 bands), gains of
/// each cable (row, lane); row: an inner node.
struct RingSystem {
  double *slope = nullptr, *bands = nullptr, *table = nullptr;
  double* sums = nullptr;  ///< scratch memory (row, 4, most_lanes)
};

struct LooseKernels {
  /// Moves every cable to the minimum of its energy, in at most `most` iterations. The cables can belong to several batches of
  /// one hose at one sample. The first ones take the lanes of the bench; when one rests, the next takes its lane. Writes their
  /// paths to their batches.
  void (*relax)(const LineBatch& bench, const WaitingCable* cables, std::size_t count, int most);
  /// Starts the next sample: writes K0 and A0, and transforms the path from its frame to the untwisted one, `ahead` seconds
  /// later. Of a ring's cables it writes only K0, A_before and the path at the clamps.
  void (*begin)(const LineBatch&, const LineMemory&, const HoseFrame&, double ahead);
  /// Computes curvature and gain from the batch's path and its `rest`.
  void (*follow)(const LineBatch&, const LineAnswer&);
  /// Computes the positions in the hose's frame and the error by the distance of nodes. Precondition: follow().
  void (*put_states)(const LineBatch&, const LineMemory&, const HoseFrame&, const LineAnswer&);
  /// Moves the points where cables stick, and computes the largest friction from the contact forces at the present positions. Stores
  /// these forces if the batch has `press`.
  void (*rub)(const LineBatch&);
  /// Ends the sample: transforms the path back to its frame. Sets its velocity over `time` seconds; time 0: keeps the old
  /// velocity.
  void (*end)(const LineBatch&, const LineMemory&, double time);
  /// Moves every cable to its place in the ring's frame (node, 2), cosine and sine. laid: places in this frame (node, 2, lane).
  void (*place)(const LineBatch&, const double* laid, const double* frame);
  /// The same, and computes the system there, with tension and without contact. turned: since the previous sample (node) [rad].
  void (*turn)(const LineBatch&, const double* laid, const double* frame, const double* turned, const RingSystem&);
  /// Forward elimination. bands: factors of L D L^T. table: (row, lane) right-hand sides r, replaced by y, L y = r. scaled: y/D.
  void (*eliminate_turn)(const double* bands, std::size_t rows, const LineBatch&, double* table, double* scaled);
  /// Writes the sum over rows of a's column k times b's column j to product[k * lanes + j].
  void (*products)(const double* a, const double* b, std::size_t rows, const LineBatch&, double* product);
};

/// Returns the functions for the instruction set that every hot loop uses (pipeline/base/instruction_set.h).
const LooseKernels& loose_kernels();

}  // namespace dresslife::strain
