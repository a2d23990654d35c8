#include "sim/robot/loops.h"

#include <unordered_map>
#include <utility>

namespace dresslife::sim {
namespace {

using Eigen::VectorXd;

constexpr std::size_t fewest_rounds = 3;

struct SamePiece {
  bool operator()(const MotionPiece* a, const MotionPiece* b) const {
    const auto same = [](const VectorXd& x, const VectorXd& y) { return x.size() == y.size() && x == y; };
    return a->duration == b->duration && a->ramp == b->ramp && same(a->position, b->position) &&
           same(a->velocity_before, b->velocity_before) && same(a->velocity_change, b->velocity_change) &&
           same(a->acceleration, b->acceleration) && same(a->jerk, b->jerk);
  }
};
struct HashPiece {
  std::size_t operator()(const MotionPiece* piece) const {
    std::size_t hash = std::hash<double>{}(piece->duration);
    for (const VectorXd* of : {&piece->position, &piece->velocity_before})
      for (const double value : *of) hash = 31 * hash + std::hash<double>{}(value);
    return hash;
  }
};

}  // namespace

std::vector<std::size_t> first_equal_pieces(const JointMotion& motion) {
  std::unordered_map<const MotionPiece*, std::size_t, HashPiece, SamePiece> known;
  std::vector<std::size_t> first;
  for (const MotionPiece& piece : motion.pieces())
    first.push_back(known.try_emplace(&piece, first.size()).first->second);
  return first;
}

std::vector<MotionLoop> loops_of(const JointMotion& motion) {
  const std::vector<std::size_t> first = first_equal_pieces(motion);
  const std::size_t count = first.size() - 1;  // without the standstill after the program
  std::vector<std::size_t> next(count, count), seen(count, count);
  for (std::size_t k = count; k-- > 0;) next[k] = std::exchange(seen[first[k]], k);
  std::vector<MotionLoop> loops;
  std::size_t length = 0, end = 0;  // pieces before `end` are equal to those `length` earlier
  for (std::size_t k = 0; k < count;) {
    if (next[k] - k != length || k >= end) {
      length = next[k] - k;
      for (end = next[k]; end < count && first[end] == first[end - length];) ++end;
    }
    const std::size_t rounds = (end - k) / length;
    if (rounds < fewest_rounds) {
      ++k;
      continue;
    }
    const double begin = motion.pieces()[k].start;
    loops.push_back({begin, motion.pieces()[k + length].start - begin, static_cast<int>(rounds)});
    k += rounds * length;
  }
  return loops;
}

}  // namespace dresslife::sim
