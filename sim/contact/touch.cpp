#include "sim/contact/touch.h"

#include <algorithm>

namespace dresslife::sim {

Touch::Touch(int segments, const std::vector<std::string>& links, int rings) : links_(links.size()), obstacles_(links) {
  for (const char* other : {"floor", "dresspack", "cell"}) obstacles_.push_back(other);
  for (int k = 1; k <= rings; ++k) obstacles_.push_back("ring " + std::to_string(k));
  const size_t pairs = static_cast<size_t>(segments) * obstacles_.size();
  work_.assign(pairs, 0), largest_force_.assign(pairs, 0), step_force_.assign(pairs, 0);
  sample_force_.resize(segments), sample_work_.resize(segments), sample_obstacle_.resize(segments);
  begin_sample();
}

void Touch::begin_sample() {
  std::fill(sample_force_.begin(), sample_force_.end(), 0.0);
  std::fill(sample_work_.begin(), sample_work_.end(), 0.0);
  std::fill(sample_obstacle_.begin(), sample_obstacle_.end(), -1);
}

size_t Touch::column(int obstacle) const {
  switch (obstacle) {
    case floor_obstacle:
      return links_;
    case hose_obstacle:
      return links_ + 1;
    case cell_obstacle:
      return links_ + 2;
    default:
      return obstacle <= first_ring ? links_ + 3 + (first_ring - obstacle) : static_cast<size_t>(obstacle);
  }
}

// The normal forces of several contacts of one pair in one step are added.
void Touch::add_segment(int segment, const Contact& contact, double work) {
  const size_t obstacle = column(contact.obstacle), pair = segment * obstacles_.size() + obstacle;
  work_[pair] += work;
  sample_work_[segment] += work;
  const double force = step_force_[pair] += contact.normal_force;
  largest_force_[pair] = std::max(largest_force_[pair], force);
  if (force <= sample_force_[segment]) return;
  sample_force_[segment] = force;
  sample_obstacle_[segment] = static_cast<std::int32_t>(obstacle);
}

void Touch::add(const std::vector<Contact>& contacts, double h) {
  if (contacts.empty()) return;
  std::fill(step_force_.begin(), step_force_.end(), 0.0);
  for (const Contact& contact : contacts) {
    if (contact.normal_force <= 0) continue;
    const double work = contact.friction_force.norm() * contact.sliding_speed * h;
    const bool itself = contact.obstacle == hose_obstacle;
    add_segment(contact.segment, contact, itself ? work / 2 : work);
    if (itself) add_segment(contact.other, contact, work / 2);
  }
}

}  // namespace dresslife::sim
