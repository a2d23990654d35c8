// Where on its surface a dresspack is rubbed: what wears a place through (fatigue/wear.h).
//
// (S23) W = sum over steps of N |v| h [J], N the normal force and |v| the sliding speed of a contact, by place
// along the dresspack, by angle around it and by obstacle. Archard's law multiplies W by a wear rate. (S13) is
// friction times sliding instead, and by segment.
//
// The surface is divided into cells: along the hose a whole number to a segment, about cell_share of the hose's
// diameter long and not below least_cell, around it sectors of equal width. The angle turns with the hose: 0 is
// the d1 of its segments. The place of a contact is continuous. With a ring it is that of (S15). Other contacts
// are found on straight segments, on a face at their ends. Such a contact is spread evenly over one segment's
// length about it, so that contacts at the ends of neighbours make an even line. Memory: cells and sectors times
// obstacles that rub.
#pragma once

#include <map>
#include <vector>

#include "sim/contact/touch.h"

namespace dresslife::sim {

struct RubbedPatch {
  int dresspack = 0;
  double position = 0, length = 0;  ///< its middle, from the base clamp along the dresspack; its length [m]
  double angle = 0, width = 0;      ///< its middle, from d1 toward d2; its width [rad]
  std::size_t obstacle = 0;         ///< of Touch::obstacles()
  double work = 0;                  ///< W of (S23) [J]
  double time = 0;                  ///< sample until which this obstacle rubbed this cell most [s]
};

class Rubbing {
 public:
  /// 5 degrees: 2.6 mm of a hose of 60 mm, a fifth of the width of a worn-through wall.
  static constexpr int sectors = 72;
  static constexpr double cell_share = 1.0 / 12, least_cell = 1e-3;  ///< [1], [m]

  explicit Rubbing(const Rod& rod);
  /// The contacts of one step of h [s]. state: after the step.
  void add(const std::vector<Contact>& contacts, const RodState& state, double h);
  /// A sample was taken at this time [s].
  void end_sample(double time);
  /// Without those below a millionth of the largest. obstacles: of the same run.
  std::vector<RubbedPatch> patches(const Touch& obstacles) const;

 private:
  struct Cells {
    int first_segment = 0, segments = 0, per_segment = 1, first = 0;
    int count() const { return segments * per_segment; }
  };
  struct Field {
    std::vector<double> work;  ///< (cell, sector) [J]
    std::vector<double> sample, largest,
        time;  ///< (cell) since the sample before, the largest of them, and when
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
