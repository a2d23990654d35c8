#include "sim/program/rapid/functions.h"

#include <algorithm>
#include <cmath>

#include "pipeline/base/constants.h"
#include "sim/program/interpreter/tokens.h"
#include "sim/program/rapid/types.h"

namespace dresslife::sim {
namespace {

Value finite(double x) { return std::isfinite(x) ? number_value(x) : Value{}; }

/// Returns the value as a record of the type; std::nullopt: another record, or not known.
std::optional<Value> record(const Code& code, Value value, const char* type) {
  const RecordType* wanted = code.record(type);
  if (value.kind != Value::Kind::list || !value.known()) return {};
  if (value.type) return value.type == wanted ? std::optional(std::move(value)) : std::nullopt;
  const auto shaped = [](auto&& self, Value& list, const RecordType* as) -> bool {
    if (list.kind != Value::Kind::list || list.items.size() != as->fields.size()) return false;
    for (std::size_t i = 0; i < list.items.size(); ++i)
      if (as->types[i] && !self(self, list.items[i], as->types[i])) return false;
    list.type = as;
    return true;
  };
  return shaped(shaped, value, wanted) ? std::optional(std::move(value)) : std::nullopt;
}

// ---- numbers ----------------------------------------------------------------------------------------------

/// Rounds or cuts a number to `decimals` decimals (Round and Trunc with \Dec).
double to_decimals(double x, double decimals, double (*cut)(double)) {
  const double scale = std::pow(10, std::clamp(std::trunc(decimals), 0.0, 15.0));
  return cut(x * scale) / scale;
}

constexpr double byte_size = 256;
bool is_byte(double x) { return x >= 0 && x < byte_size && x == std::trunc(x); }

/// Returns BitAnd(a, b) and similar functions of bytes; BitCheck counts bits from 1.
std::optional<Value> of_two_bytes(const std::string& name, unsigned a, unsigned b) {
  if (name == "bitand") return number_value(a & b);
  if (name == "bitor") return number_value(a | b);
  if (name == "bitxor") return number_value(a ^ b);
  if (b > 8) return {};
  if (name == "bitlsh") return number_value((a << b) % static_cast<unsigned>(byte_size));
  if (name == "bitrsh") return number_value(a >> b);
  if (name == "bitcheck" && b > 0) return truth_value((a >> (b - 1)) % 2 == 1);
  return {};
}

std::optional<Value> of_one_number(const std::string& name, double x, double decimals) {
  if (name == "abs" || name == "absdnum") return finite(std::abs(x));
  if (name == "sqrt" || name == "sqrtdnum") return finite(std::sqrt(x));
  if (name == "sin" || name == "sindnum") return finite(std::sin(x * degree));
  if (name == "cos" || name == "cosdnum") return finite(std::cos(x * degree));
  if (name == "tan" || name == "tandnum") return finite(std::tan(x * degree));
  if (name == "asin" || name == "asindnum") return finite(std::asin(x) / degree);
  if (name == "acos" || name == "acosdnum") return finite(std::acos(x) / degree);
  if (name == "atan" || name == "atandnum") return finite(std::atan(x) / degree);
  if (name == "exp") return finite(std::exp(x));
  if (name == "round" || name == "rounddnum") return finite(to_decimals(x, decimals, std::round));
  if (name == "trunc" || name == "truncdnum") return finite(to_decimals(x, decimals, std::trunc));
  if (name == "dnumtonum" || name == "numtodnum") return finite(x);
  if (name == "bitneg" && is_byte(x)) return number_value(byte_size - 1 - x);
  if (name == "valtostr") return text_value(fmt::format("{:.6g}", x));  // at most six digits (data type num)
  return {};
}

std::optional<Value> of_two_numbers(const std::string& name, double a, double b) {
  if (name == "pow" || name == "powdnum") return finite(std::pow(a, b));
  if (name == "atan2" || name == "atan2dnum") return finite(std::atan2(a, b) / degree);
  if (name.starts_with("bit") && is_byte(a) && is_byte(b))
    return of_two_bytes(name, static_cast<unsigned>(a), static_cast<unsigned>(b));
  if (name == "max") return number_value(std::max(a, b));
  if (name == "min") return number_value(std::min(a, b));
  if (name == "numtostr") return text_value(fmt::format("{:.{}f}", a, static_cast<int>(std::clamp(b, 0.0, 15.0))));
  return {};
}

// ---- texts ------------------------------------------------------------------------------------------------

std::optional<Value> of_text(const std::string& name, const std::vector<const Value*>& v) {
  const std::string& text = v[0]->text;
  if (name == "strlen" && v.size() == 1) return number_value(static_cast<double>(text.size()));
  if (name == "valtostr" && v.size() == 1) return *v[0];
  if (name == "strpart" && v.size() == 3 && v[1]->is_number() && v[2]->is_number()) {
    const double from = v[1]->number, count = v[2]->number;
    if (!(from >= 1 && count >= 0 && from - 1 + count <= static_cast<double>(text.size()))) return Value{};
    return text_value(text.substr(static_cast<std::size_t>(from) - 1, static_cast<std::size_t>(count)));
  }
  const bool searches = name == "strfind" || name == "strfind not" || name == "strmatch";
  if (searches && v.size() == 3 && v[1]->is_number() && v[2]->kind == Value::Kind::text) {
    const double from = v[1]->number;
    if (!(from >= 1 && from <= static_cast<double>(text.size()) + 1)) return Value{};
    const auto begin = static_cast<std::size_t>(from) - 1;
    const std::size_t found = name == "strmatch"  ? text.find(v[2]->text, begin)
                              : name == "strfind" ? text.find_first_of(v[2]->text, begin)
                                                  : text.find_first_not_of(v[2]->text, begin);
    return number_value(static_cast<double>(std::min(found, text.size()) + 1));
  }
  return {};
}

// ---- poses ------------------------------------------------------------------------------------------------

/// Returns OrientZYX(z, y, x) [deg]: rotation about z, then about the new y, then about the new x.
Quaternion from_zyx(double z, double y, double x) {
  return rotation({0, 0, z * degree}) * rotation({0, y * degree, 0}) * rotation({x * degree, 0, 0});
}

/// Returns EulerZYX(\X|\Y|\Z, orient) [deg].
Value euler_zyx(const Quaternion& q, char axis) {
  const Matrix3 r = q.toRotationMatrix();
  const double y = std::atan2(-r(2, 0), std::hypot(r(0, 0), r(1, 0)));
  constexpr double pole = 1e-9;  // largest |cos y| at which z and x turn about the same axis
  const bool at_pole = std::abs(std::cos(y)) < pole;
  if (axis == 'y') return finite(y / degree);
  if (axis == 'x') return finite(at_pole ? 0 : std::atan2(r(2, 1), r(2, 2)) / degree);
  return finite((at_pole ? std::atan2(-r(0, 1), r(1, 1)) : std::atan2(r(1, 0), r(0, 0))) / degree);
}

/// Returns DefFrame(p1, p2, p3): origin p1, x towards p2, p3 in the xy plane with positive y.
std::optional<Frame> frame_of_points(const Vector3& p1, const Vector3& p2, const Vector3& p3) {
  const Vector3 x = p2 - p1, in_plane = p3 - p1;
  const Vector3 z = x.cross(in_plane);
  constexpr double shortest = 1e-6;  // [m] from p1 to p2, and from p3 to the line p1 p2
  if (x.norm() < shortest || z.norm() < shortest * x.norm()) return {};
  Matrix3 r;
  r.col(0) = x.normalized();
  r.col(2) = z.normalized();
  r.col(1) = r.col(2).cross(r.col(0));
  return Frame{p1, Quaternion(r)};
}

std::optional<Value> of_poses(const Code& code, const std::string& name, const std::vector<RapidArgument>& arguments) {
  std::vector<Value> v;
  for (const RapidArgument& argument : arguments)
    if (argument.option.empty()) v.push_back(argument.value);
  const auto pose = [&](std::size_t i) -> std::optional<Frame> {
    const auto read = i < v.size() ? record(code, v[i], "pose") : std::nullopt;
    return read ? rapid_frame(*read) : std::nullopt;
  };
  const auto pos = [&](std::size_t i) -> std::optional<Vector3> {
    const auto read = i < v.size() ? record(code, v[i], "pos") : std::nullopt;
    return read ? std::optional(rapid_position(*read)) : std::nullopt;
  };
  const auto orient = [&](std::size_t i) -> std::optional<Quaternion> {
    const auto read = i < v.size() ? record(code, v[i], "orient") : std::nullopt;
    return read ? rapid_orientation(*read) : std::nullopt;
  };
  if (name == "posemult") {
    const auto a = pose(0), b = pose(1);
    return a && b ? rapid_pose(code, *a * *b) : Value{};
  }
  if (name == "poseinv") {
    const auto a = pose(0);
    return a ? rapid_pose(code, inverse(*a)) : Value{};
  }
  if (name == "posevect") {
    const auto frame = pose(0);
    const auto vector = pos(1);
    return frame && vector ? rapid_pos(code, frame->position + frame->orientation * *vector) : Value{};
  }
  if (name == "distance" || name == "dotprod") {
    const auto a = pos(0), b = pos(1);
    if (!a || !b) return Value{};
    return name == "distance" ? finite((*a - *b).norm() / millimetre) : finite(a->dot(*b) / (millimetre * millimetre));
  }
  if (name == "vectmagn") {
    const auto a = pos(0);
    return a ? finite(a->norm() / millimetre) : Value{};
  }
  if (name == "norient") {
    const auto read = v.empty() ? std::nullopt : record(code, v[0], "orient");
    if (!read) return Value{};
    const Quaternion q = rapid_quaternion(*read);
    constexpr double shortest = 1e-6;
    return q.norm() > shortest ? rapid_orient(code, q.normalized()) : Value{};
  }
  if (name == "eulerzyx") {
    const auto q = orient(0);
    for (const RapidArgument& argument : arguments)
      if (q && argument.option.size() == 1) return euler_zyx(*q, argument.option[0]);
    return Value{};
  }
  if (name == "defframe") {
    Vector3 points[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto target = i < v.size() ? record(code, v[i], "robtarget") : std::nullopt;
      if (!target) return Value{};
      points[i] = rapid_position(target->items[0]);
    }
    for (const RapidArgument& argument : arguments)
      if (!argument.option.empty()) return Value{};  // \Origin
    const auto frame = frame_of_points(points[0], points[1], points[2]);
    return frame ? rapid_pose(code, *frame) : Value{};
  }
  return {};
}

}  // namespace

Vector3 rapid_position(const Value& pos) {
  return millimetre * Vector3(item_number(pos, 0), item_number(pos, 1), item_number(pos, 2));
}

Quaternion rapid_quaternion(const Value& orient) {
  return Quaternion(item_number(orient, 0), item_number(orient, 1), item_number(orient, 2), item_number(orient, 3));
}

std::optional<Quaternion> rapid_orientation(const Value& orient) {
  const Quaternion q = rapid_quaternion(orient);
  constexpr double rounding = 0.02;  // error of the norm of components with two decimals
  if (!(std::abs(q.norm() - 1) < rounding)) return {};
  return q.normalized();
}

std::optional<Frame> rapid_frame(const Value& pose) {
  const auto q = rapid_orientation(pose.items[1]);
  if (!q) return {};
  return Frame{rapid_position(pose.items[0]), *q};
}

Value rapid_pos(const Code& code, const Vector3& position) {
  Value pos = rapid_initial(code, "pos");
  for (int i = 0; i < 3; ++i) pos.items[i].number = position[i] / millimetre;
  return pos;
}

Value rapid_orient(const Code& code, const Quaternion& q) {
  Value orient = rapid_initial(code, "orient");
  const double parts[] = {q.w(), q.x(), q.y(), q.z()};
  for (int i = 0; i < 4; ++i) orient.items[i].number = parts[i];
  return orient;
}

Value rapid_pose(const Code& code, const Frame& frame) {
  Value pose = rapid_initial(code, "pose");
  pose.items[0] = rapid_pos(code, frame.position);
  pose.items[1] = rapid_orient(code, frame.orientation);
  return pose;
}

std::optional<Value> rapid_function(const Code& code, const std::string& name,
                                    const std::vector<RapidArgument>& arguments) {
  std::vector<const Value*> v;
  double decimals = 0;
  bool outside = false;  // StrFind \NotInSet: the first letter outside of the set
  for (const RapidArgument& argument : arguments) {
    if (argument.option.empty())
      v.push_back(&argument.value);
    else if (argument.option == "dec")
      decimals = argument.value.number;
    else if (argument.option == "notinset")
      outside = true;
  }
  if (!v.empty() && v[0]->is_number()) {
    if (v.size() == 1)
      if (auto result = of_one_number(name, v[0]->number, decimals)) return result;
    if (v.size() == 2 && v[1]->is_number())
      if (auto result = of_two_numbers(name, v[0]->number, v[1]->number)) return result;
  }
  if (!v.empty() && v[0]->kind == Value::Kind::truth && name == "valtostr")
    return text_value(v[0]->number != 0 ? "TRUE" : "FALSE");
  if (!v.empty() && v[0]->kind == Value::Kind::text)
    if (auto result = of_text(outside ? name + " not" : name, v)) return result;
  if (name == "orientzyx") {
    for (const Value* value : v)
      if (!value->is_number()) return Value{};
    return v.size() == 3 ? rapid_orient(code, from_zyx(v[0]->number, v[1]->number, v[2]->number)) : Value{};
  }
  if (name == "dim" && v.size() == 2 && v[1]->is_number()) {
    const Value* list = v[0];
    for (double k = 1; k < v[1]->number && !list->items.empty() && k < 4; ++k) list = &list->items[0];
    return list->kind == Value::Kind::list ? number_value(static_cast<double>(list->items.size())) : Value{};
  }
  return of_poses(code, name, arguments);
}

bool rapid_asks_the_robot(const std::string& function) {
  static const pipeline::WordSet names = pipeline::word_set(
      "ainput aoutput bittst cdate clkread cspeedoverride ctime ctool cwobj dinput doutput executionmode filesize "
      "finddata fssize getmecunitname getnextmechunit getnextsym getserviceinfo getsignalorigin gettaskname gettime "
      "ginput ginputdnum goutput goutputdnum indinpos indspeed iomodestate iounitstate isfile ismechunitactive "
      "ispers isstopmoveact isstopstateevent issyncmoveon issysid isvar motionplannerno nonmotionmode opmode "
      "pathlevel pathlengthget pfrestart ppmovedinmanmode rawbyteslen readbin readdir readmotor readnum readstr "
      "readstrbin robname robos runmode socketgetstatus socketpeek taskrunmec taskrunrob testandset testdi "
      "testsignread triggdatavalid uialphaentry uiclientexist uidnumentry uidnumtune uilistview uimessagebox "
      "uinumentry uinumtune validio");
  return names.contains(function);
}

}  // namespace dresslife::sim
