// Rubbing work by place on the dresspack's surface, from which its wear follows (fatigue/wear.h).
//
// (S23) W = sum over steps of N |v| h [J], N the normal force and |v| the sliding speed of a contact, by place
// along the dresspack, by angle around it and by obstacle. Archard's law multiplies W by a wear rate. (S13) differs: it is
// friction times sliding, by segment.
//
// The surface is divided into cells. Along the hose their number per segment is whole; they are about cell_share of the hose's
// diameter long, and at least least_cell. Around the hose they are sectors of equal width. The angle turns with the hose: 0 is
// d1 of its segments. The place of a contact is continuous. For a ring it is that of (S15). Other contacts are found on straight
// segments, and on a face at their ends. Such a contact is distributed evenly over one segment's length around it, so that
// contacts at the ends of neighbours make a uniform line. Memory: cells times sectors times obstacles that rub.
#pragma once

#include <map>
#include <vector>

#include "sim/contact/touch.h"

namespace dresslife::sim {

struct RubbedPatch {
  int dresspack = 0;
  double position = 0, length = 0;  ///< of its middle, from the base clamp along the dresspack; its length [m]
  double angle = 0, width = 0;      ///< of its middle, from d1 toward d2; its width [rad]
  std::size_t obstacle = 0;         ///< index in Touch::obstacles()
  double work = 0;                  ///< W of (S23) [J]
  double time = 0;                  ///< end of the sample with the largest work of this obstacle on this cell [s]
};

/// Mean power of rubbing [W] below which a short run reports no rubbing. 1 mW is 0.1 MJ in the 30,000 h of a robot. It wears 1 mm3 of
/// polyamide (1e-5 mm3/(N m), config/materials). ESTIMATE: a hole in the crest of a corrugated hose takes 3 to 5 mm3. A wear rate may
/// be 5 times as large.
inline constexpr double least_rubbing_power = 1e-3;

class Rubbing {
 public:
  /// 5 degrees: 2.6 mm for a hose of 60 mm, a fifth of the width of a worn-through wall.
  static constexpr int sectors = 72;
  static constexpr double cell_share = 1.0 / 12, least_cell = 1e-3;  ///< [1], [m]

  explicit Rubbing(const Rod& rod);
  /// Adds the contacts of one step of h [s]. state: after the step.
  void add(const std::vector<Contact>& contacts, const RodState& state, double h);
  /// Ends a sample at this time [s].
  void end_sample(double time);
  /// Returns the patches with at least a millionth of the largest work. obstacles: of the same run.
  std::vector<RubbedPatch> patches(const Touch& obstacles) const;

 private:
  struct Cells {
    int first_segment = 0, segments = 0, per_segment = 1, first = 0;
    int count() const { return segments * per_segment; }
  };
  struct Field {
    std::vector<double> work;  ///< (cell, sector) [J]
    std::vector<double> sample, largest,
        time;  ///< (cell) work since the previous sample, its largest value, and the time of this value
  };
  const Cells& cells_of(int segment) const;
  void rub(Field& field, int segment, double place, bool spread, const Vector3& toward, const RodState& state,
           double work);

  const Rod& rod_;
  std::vector<Cells> cells_;  ///< (dresspack)
  int cells_in_all_ = 0;
  std::map<int, Field> fields_;  ///< by Contact::obstacle
};

}  // namespace dresslife::sim
