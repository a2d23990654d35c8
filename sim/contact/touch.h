// Places and forces of the dresspack's contacts, summed over the motion.
//
// (S13) W = sum over steps of |f_t| |v_t| h: rubbing work of a segment on an obstacle [J], which wears the
// cover. In a contact of the hose with itself each of the two segments gets half of it. Memory: segments
// times obstacles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/contact/contact.h"

namespace dresslife::sim {

class Touch {
 public:
  /// Obstacles: the robot's links, then floor, dresspack (itself), cell and guide rings.
  Touch(int segments, const std::vector<std::string>& links, int rings = 0);

  /// Adds the contacts of one step of h [s].
  void add(const std::vector<Contact>& contacts, double h);
  /// Starts a new sample: resets the sums since the previous sample.
  void begin_sample();

  const std::vector<std::string>& obstacles() const { return obstacles_; }
  size_t column(int obstacle) const;  ///< index in obstacles() of a Contact::obstacle
  // Of the whole motion:
  const std::vector<double>& work() const { return work_; }                    ///< (segment, obstacle) [J]
  const std::vector<double>& largest_force() const { return largest_force_; }  ///< (segment, obstacle) normal [N]
  // Since the previous sample:
  const std::vector<double>& sample_force() const { return sample_force_; }  ///< (segment) largest of all steps [N]
  const std::vector<double>& sample_work() const { return sample_work_; }    ///< (segment) [J]
  const std::vector<std::int32_t>& sample_obstacle() const {
    return sample_obstacle_;
  }  ///< (segment) obstacle with the largest force; -1: none

 private:
  void add_segment(int segment, const Contact& contact, double work);

  size_t links_;
  std::vector<std::string> obstacles_;
  std::vector<double> work_, largest_force_, step_force_, sample_force_, sample_work_;
  std::vector<std::int32_t> sample_obstacle_;
};

}  // namespace dresslife::sim
