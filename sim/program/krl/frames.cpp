#include "sim/program/krl/frames.h"

#include <cmath>

namespace dresslife::sim::krl {
namespace {

constexpr const char* no_value = "has no value yet";

}  // namespace

Value unset_value() {
  static const Value unset = unknown_value("", no_value);
  return unset;
}

bool is_unset(const Value& value) {
  if (value.kind == Value::Kind::unknown) return value.cause && value.cause->why == no_value;
  return value.kind == Value::Kind::list && std::ranges::all_of(value.items, is_unset);
}

Coordinates coordinates(const Value& record, const char* const (&names)[6]) {
  Coordinates read;
  read.unknown = truth_value(true);
  for (int i = 0; i < 6; ++i) {
    const Value* part = record.field(names[i]);
    if (!part || is_unset(*part)) continue;
    if (part->is_number()) {
      read.numbers[i] = part->number;
      read.given[i] = true;
    } else {
      const Value why = part->known() ? unknown_value("", "is no number") : *part;
      read.unknown = read.unknown.known() ? why : unknown_value(read.unknown, why);
    }
  }
  return read;
}

Frame frame_from(const std::array<double, 6>& n) {
  return {millimetre * Vector3(n[0], n[1], n[2]),
          rotation({0, 0, n[3] * degree}) * rotation({0, n[4] * degree, 0}) * rotation({n[5] * degree, 0, 0})};
}

std::array<double, 6> numbers_of(const Frame& frame) {
  const Matrix3 r = frame.orientation.toRotationMatrix();
  const double b = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  const bool pole =
      std::abs(std::cos(b)) < 1e-9;  // A and C turn about the same axis: C = 0, A takes the whole rotation
  const double a = pole ? std::atan2(-r(0, 1), r(1, 1)) : std::atan2(r(1, 0), r(0, 0));
  const double c = pole ? 0 : std::atan2(r(2, 1), r(2, 2));
  const Vector3 p = frame.position / millimetre;
  return {p.x(), p.y(), p.z(), a / degree, b / degree, c / degree};
}

}  // namespace dresslife::sim::krl
