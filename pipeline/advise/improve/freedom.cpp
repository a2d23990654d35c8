#include "pipeline/advise/improve/freedom.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>

#include "pipeline/advise/improve/set_text.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/catalogue.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/units.h"

namespace dresslife::pipeline {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr const char* ways =
    "write LOW .. HIGH, SPREAD around, ANGLE deg around, LOW .. HIGH along LINK (or along [x, y, z]), or a "
    "list [A, B, ...]";
constexpr double steps = 1e4;  // number of steps of a range

/// Returns a round step of at most a ten-thousandth of a range.
double step_of(double range) { return std::pow(10, std::floor(std::log10(range / steps))); }

Node number_node(double value, double step) {
  const double decimals = std::max(0.0, -std::round(std::log10(step)));
  return scalar(shortest_text(std::stod(fmt::format("{:.{}f}", value, static_cast<int>(decimals)))));
}

std::optional<double> number_of(const Node& node) {
  const auto value = node.is_scalar() ? whole_number_in<double>(node.text) : std::nullopt;
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<Vector3d> vector_of(const Node& node) {
  if (!node.is_list() || node.items.size() != 3) return std::nullopt;
  Vector3d vector;
  for (Index k = 0; k < 3; ++k) {
    const std::optional<double> number = number_of(node.items[static_cast<std::size_t>(k)]);
    if (!number) return std::nullopt;
    vector[k] = *number;
  }
  return vector;
}

Node vector_node(const Vector3d& vector, double step) {
  return list_of({number_node(vector.x(), step), number_node(vector.y(), step), number_node(vector.z(), step)});
}

VectorXd one(double u) { return VectorXd::Constant(1, u); }
bool within(const VectorXd& place) {
  constexpr double rounding = 1e-9;
  return place.minCoeff() >= -rounding && place.maxCoeff() <= 1 + rounding;
}
VectorXd if_within(const VectorXd& place) { return within(place) ? place.cwiseMax(0).cwiseMin(1) : VectorXd(); }

class NumberRange : public FreeKey {
 public:
  NumberRange(double low, double high) : low_(low), high_(high) {}
  Node value_at(const VectorXd& place) const override {
    return number_node(low_ + place[0] * (high_ - low_), step_of(high_ - low_));
  }
  VectorXd place_of(const Node& value) const override {
    const std::optional<double> number = number_of(value);
    return number ? if_within(one((*number - low_) / (high_ - low_))) : VectorXd();
  }
  std::string end_words(Index, bool high) const override {
    return high ? fmt::format("at most {:.6g}", high_) : fmt::format("at least {:.6g}", low_);
  }

 private:
  double low_, high_;
};

/// A range for each coordinate of a position around its centre.
class PositionBox : public FreeKey {
 public:
  PositionBox(const Vector3d& centre, double spread) : centre_(centre), spread_(spread) {}
  Index variables() const override { return 3; }
  Node value_at(const VectorXd& place) const override {
    return vector_node(centre_ + spread_ * (2 * place.array() - 1).matrix(), step_of(2 * spread_));
  }
  VectorXd place_of(const Node& value) const override {
    const std::optional<Vector3d> vector = vector_of(value);
    return vector ? if_within((((*vector - centre_) / spread_).array() + 1) / 2) : VectorXd();
  }
  std::string end_words(Index variable, bool high) const override {
    return fmt::format("{} {} {:.6g}", "xyz"[variable], high ? "at most" : "at least",
                       centre_[variable] + (high ? spread_ : -spread_));
  }

 private:
  Vector3d centre_;
  double spread_;
};

class PositionLine : public FreeKey {
 public:
  PositionLine(const Vector3d& origin, const Vector3d& along, double low, double high)
      : origin_(origin), along_(along.normalized()), low_(low), high_(high) {}
  Node value_at(const VectorXd& place) const override {
    return vector_node(origin_ + (low_ + place[0] * (high_ - low_)) * along_, step_of(high_ - low_));
  }
  VectorXd place_of(const Node& value) const override {
    const std::optional<Vector3d> vector = vector_of(value);
    if (!vector || (*vector - origin_).cross(along_).norm() > step_of(high_ - low_)) return {};
    return if_within(one(((*vector - origin_).dot(along_) - low_) / (high_ - low_)));
  }
  std::string end_words(Index, bool high) const override {
    return fmt::format("{} {:.6g} along its line", high ? "at most" : "at least", high ? high_ : low_);
  }

 private:
  Vector3d origin_, along_;
  double low_, high_;
};

/// Directions within an angle of an axis, uniform in its tangent plane: tan(angle) q, with q in the unit disc. The unit square is
/// mapped to the disc after P. Shirley and K. Chiu (Journal of Graphics Tools 2 (1997) 45).
class DirectionCone : public FreeKey {
 public:
  DirectionCone(const Vector3d& axis, double angle_deg)
      : axis_(axis.normalized()), reach_(std::tan(angle_deg * std::numbers::pi / 180)) {
    first_ = axis_.unitOrthogonal();
    second_ = axis_.cross(first_);
  }
  Index variables() const override { return 2; }
  Node value_at(const VectorXd& place) const override {
    const Eigen::Vector2d q = reach_ * on_disc(2 * place[0] - 1, 2 * place[1] - 1);
    constexpr double step = 1e-4;
    return vector_node((axis_ + q.x() * first_ + q.y() * second_).normalized(), step);
  }
  VectorXd place_of(const Node& value) const override {
    const std::optional<Vector3d> vector = vector_of(value);
    if (!vector || vector->dot(axis_) <= 0) return {};
    const Vector3d q = *vector / vector->dot(axis_) - axis_;
    const Eigen::Vector2d square = on_square({q.dot(first_) / reach_, q.dot(second_) / reach_});
    return if_within((square.array() + 1) / 2);
  }
  std::string end_words(Index, bool) const override {
    return fmt::format("at most {:.3g} deg around", std::atan(reach_) * 180 / std::numbers::pi);
  }

 private:
  static Eigen::Vector2d on_disc(double a, double b) {
    constexpr double quarter = std::numbers::pi / 4;
    if (a == 0 && b == 0) return {0, 0};
    if (std::abs(a) > std::abs(b)) return a * Eigen::Vector2d(std::cos(quarter * b / a), std::sin(quarter * b / a));
    return b * Eigen::Vector2d(std::sin(quarter * a / b), std::cos(quarter * a / b));
  }
  static Eigen::Vector2d on_square(const Eigen::Vector2d& q) {
    constexpr double quarter = std::numbers::pi / 4;
    const double r = q.norm();
    if (r == 0) return {0, 0};
    if (std::abs(q.x()) > std::abs(q.y())) {
      const double a = std::copysign(r, q.x());
      return {a, a * std::atan(q.y() / q.x()) / quarter};
    }
    const double b = std::copysign(r, q.y());
    return {b * std::atan(q.x() / q.y()) / quarter, b};
  }

  Vector3d axis_, first_, second_;
  double reach_;
};

class Choice : public FreeKey {
 public:
  explicit Choice(std::vector<Node> values) : values_(std::move(values)) {}
  Node value_at(const VectorXd& place) const override {
    const auto at = static_cast<std::size_t>(place[0] * static_cast<double>(values_.size()));
    return values_[std::min(at, values_.size() - 1)];
  }
  VectorXd place_of(const Node& value) const override {
    const std::string text = to_yaml(value);
    for (std::size_t k = 0; k < values_.size(); ++k)
      if (to_yaml(values_[k]) == text) return one((static_cast<double>(k) + 0.5) / static_cast<double>(values_.size()));
    return {};
  }
  std::string end_words(Index, bool) const override { return ""; }

 private:
  std::vector<Node> values_;
};

/// Returns the value at a path, which all jobs must have in common. Null: a job has none, or the values differ.
const Node* common_value(const std::vector<Node>& documents, const std::string& path) {
  const Node* first = nullptr;
  for (const Node& document : documents) {
    const Node* node = value_at(document, path);
    if (!node || (first && to_yaml(*first) != to_yaml(*node))) return nullptr;
    first = first ? first : node;
  }
  return first;
}

/// Returns the vector from the origin of a link's frame to that of the next link, in the link's frame.
std::optional<Vector3d> along_link(const Job& job, const std::string& link) {
  const Robot& robot = job.robot;
  for (std::size_t k = 0; k < robot.joints.size() && k < robot.links.size(); ++k)
    if (robot.links[k].name == link && robot.joints[k].origin.norm() > 0) return robot.joints[k].origin;
  return std::nullopt;
}

/// Parser of the written range of a key.
class Reader {
 public:
  Reader(std::string path, const Node& written, const std::vector<Node>& documents,
         const std::vector<std::shared_ptr<const Job>>& jobs)
      : path_(std::move(path)), written_(written), documents_(documents), jobs_(jobs) {}

  std::unique_ptr<FreeKey> key() const {
    if (written_.is_list()) return choice();
    if (!written_.is_scalar()) refuse("is freed by neither a range nor a list");
    const std::string& text = written_.text;
    if (const std::size_t at = text.find(" around"); at != std::string::npos)
      return around(text.substr(0, at), text.substr(at + 7));
    if (const std::size_t at = text.find(" along "); at != std::string::npos)
      return line(text.substr(0, at), text.substr(at + 7));
    const auto [low, high] = range(text);
    return std::make_unique<NumberRange>(low, high);
  }

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& remedy = ways) const {
    throw InputError(written_.where, fmt::format("free.{} {}", path_, what), remedy);
  }

  double number(const std::string& written) const {
    const std::string text(trimmed(written));
    if (const std::optional<double> value = number_of(scalar(text))) return *value;
    refuse(fmt::format("is '{}', in which '{}' is no number", written_.text, text));
  }

  std::pair<double, double> range(const std::string& text) const {
    const std::size_t dots = text.find("..");
    if (dots == std::string::npos) refuse(fmt::format("is '{}'", written_.text));
    const double low = number(text.substr(0, dots)), high = number(text.substr(dots + 2));
    if (!(low < high))
      refuse(fmt::format("is '{}', which holds nothing", written_.text), "write the smaller number first");
    return {low, high};
  }

  Vector3d given_vector(const std::string& text) const {
    const Node node = parse_yaml(text, written_.where.file);
    const std::optional<Vector3d> vector = vector_of(node);
    if (!vector || vector->norm() == 0) refuse(fmt::format("is '{}', in which '{}' is no vector", written_.text, text));
    return *vector;
  }

  const Node& own_value() const {
    if (const Node* value = common_value(documents_, path_)) return *value;
    const bool counts_from_zero = (path_ + ".").find(".0.") != std::string::npos;
    refuse("is freed around its own value, which it has not, or not the same in all jobs",
           counts_from_zero ? "items of a list count from 1" : "give the value in every job, or write LOW .. HIGH");
  }

  std::unique_ptr<FreeKey> around(std::string spread, const std::string& centre) const {
    const std::size_t degrees = spread.find(" deg");
    const bool given = !trimmed(centre).empty();
    if (degrees != std::string::npos) {
      const double angle = number(spread.substr(0, degrees));
      if (!(angle > 0 && angle <= 80))
        refuse(fmt::format("is a cone of {} deg", angle), "give 0 to 80 deg to each side");
      const std::optional<Vector3d> axis = given ? given_vector(centre) : vector_of(own_value());
      if (!axis) refuse("is no direction, but is freed by an angle", "free directions by ANGLE deg around");
      return std::make_unique<DirectionCone>(*axis, angle);
    }
    const double far = number(spread);
    if (!(far > 0)) refuse("may not change at all", "give a spread above 0");
    if (centre.find('[') != std::string::npos) return std::make_unique<PositionBox>(given_vector(centre), far);
    if (given) return std::make_unique<NumberRange>(number(centre) - far, number(centre) + far);
    if (const std::optional<Vector3d> vector = vector_of(own_value()))
      return std::make_unique<PositionBox>(*vector, far);
    if (const std::optional<double> value = number_of(own_value()))
      return std::make_unique<NumberRange>(*value - far, *value + far);
    refuse("is neither a number nor a position", "free it by a list [A, B, ...]");
  }

  std::unique_ptr<FreeKey> line(const std::string& reach, const std::string& along) const {
    const auto [low, high] = range(reach);
    const std::optional<Vector3d> origin = vector_of(own_value());
    if (!origin) refuse("is no position, but is freed along a line");
    if (along.find('[') != std::string::npos)
      return std::make_unique<PositionLine>(*origin, given_vector(along), low, high);
    const std::optional<Vector3d> link = along_link(*jobs_.front(), along);
    if (!link)
      refuse(fmt::format("lies along '{}', which is no link that carries another away from it", along),
             "name another link, or write along [x, y, z]");
    return std::make_unique<PositionLine>(*origin, *link, low, high);
  }

  /// Files are relative to the study's folder.
  std::unique_ptr<FreeKey> choice() const {
    if (written_.items.empty()) refuse("may be one of nothing");
    std::vector<Node> values = written_.items;
    for (Node& value : values) {
      const std::filesystem::path file = folder_of(value.where) / value.text;
      if (value.is_scalar() && kind_of(file) == FileKind::file)
        value.text = std::filesystem::absolute(file).lexically_normal().string();
    }
    return std::make_unique<Choice>(std::move(values));
  }

  std::string path_;
  const Node& written_;
  const std::vector<Node>& documents_;
  const std::vector<std::shared_ptr<const Job>>& jobs_;
};

/// Returns whether a key belongs to the calculation or is a limit: another value changes the numbers, and no dresspack lives longer.
bool is_no_property(const std::string& path) {
  static const std::array<std::string_view, 4> settings{"simulation", "strain", "fatigue", "uncertainty"};
  static const std::array<std::string_view, 5> limits{"least_bend_radius_mm", "most_twist_deg_per_m", "most_tension_N",
                                                      "longest_bracket_mm", "hold_joint"};
  const auto is_any = [](const auto& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
  };
  return is_any(settings, std::string_view(path).substr(0, path.find('.'))) ||
         is_any(limits, std::string_view(path).substr(path.rfind('.') + 1));
}

/// Frees the position of a clamp by the reach of another bracket.
void free_place(Node& free, const std::string& path) {
  free[path + "position_m"] = scalar("0.15 around");
  free[path + "direction"] = scalar("45 deg around");
}

}  // namespace

Freedom Freedom::from(const Node& free, const std::vector<std::shared_ptr<const Job>>& jobs) {
  if (!free.is_map() || free.entries.empty())
    throw InputError(free.where, "free must be a map from keys to what they may be", ways);
  const std::vector<Node> documents = mapped(jobs, [](const auto& job) { return parse_yaml(job_text(*job), "job"); });
  Freedom freedom;
  std::vector<VectorXd> places;
  for (const Entry& entry : free.entries) {
    if (is_no_property(entry.key))
      throw InputError(
          entry.value.where,
          fmt::format("free.{} is a limit or a setting of the calculation, which makes no dresspack live longer",
                      entry.key),
          "free keys of routing, dresspack or motion; compare settings in a study (jobs:)");
    for (const FreeVariable& other :
         freedom.keys_)  // the later of the two would replace what the search chose for the other
      if ((entry.key + ".").starts_with(other.path + ".") || other.path.starts_with(entry.key + "."))
        throw InputError(entry.value.where,
                         fmt::format("free.{} and free.{} set the same value", other.path, entry.key),
                         "keep one of the two");
    const Node* own = common_value(documents, entry.key);
    freedom.keys_.push_back(
        {entry.key, Reader(entry.key, entry.value, documents, jobs).key(), own ? set_text(*own) : ""});
    places.push_back(own ? freedom.keys_.back().key->place_of(*own) : VectorXd());
  }
  if (std::all_of(places.begin(), places.end(), [](const VectorXd& place) { return place.size() > 0; })) {
    freedom.start_.emplace(freedom.variables());
    Index at = 0;
    for (const VectorXd& place : places) {
      freedom.start_->segment(at, place.size()) = place;
      at += place.size();
    }
  }
  return freedom;
}

Node Freedom::usual(const Job& job) {
  Node free;
  free.kind = Node::Kind::map;
  const bool single = job.dresspacks.size() == 1 && job.dresspacks.front().name.empty();
  for (std::size_t k = 0; k < job.dresspacks.size(); ++k) {
    const Routing& routing = job.dresspacks[k].routing;
    const std::string path = single ? "routing." : fmt::format("dresspacks.{}.routing.", k + 1);
    const double length = routing.free_length;
    free[path + "free_length_m"] = scalar(fmt::format("{:.4g} .. {:.4g}", 0.9 * length, 1.35 * length));
    for (const char* clamp : {"base_clamp", "tool_clamp"}) {
      const std::optional<Clamp>& of =
          std::string_view(clamp) == "base_clamp" ? routing.base_clamp : routing.tool_clamp;
      if (!of) continue;
      free_place(free, path + clamp + ".");
    }
    for (std::size_t i = 0; i < routing.clamps.size(); ++i) {
      const std::string of = fmt::format("{}clamps.{}.", path, i + 1);
      free_place(free, of);
      free[of + "at_length_m"] = scalar("0.1 around");
    }
    for (std::size_t i = 0; i < routing.rings.size(); ++i) {
      const std::string of = fmt::format("{}rings.{}.", path, i + 1);
      free_place(free, of);
      if (routing.rings[i].at_length) free[of + "at_length_m"] = scalar("0.1 around");
    }
    if (routing.tool_clamp) free[path + "pre_twist_deg"] = scalar("-180 .. 180");
  }
  place_at(free, {"free"});
  return free;
}

Index Freedom::variables() const {
  return sum_of(
      keys_, [](const FreeVariable& freed) { return freed.key->variables(); }, Index{0});
}

std::vector<std::string> Freedom::at_ends(const VectorXd& place) const {
  constexpr double end = 0.02;  // share of a range: a search of some dozen trials ends this near to an end
  std::vector<std::string> notes;
  Index at = 0;
  for (const FreeVariable& freed : keys_) {
    std::string words;
    for (Index k = 0; k < freed.key->variables(); ++k) {
      const double u = place[at + k];
      const std::string one = u < end || u > 1 - end ? freed.key->end_words(k, u > 1 - end) : "";
      if (!one.empty() && words.find(one) == std::string::npos) words += ", " + one;
    }
    if (!words.empty()) notes.push_back(freed.path + words);
    at += freed.key->variables();
  }
  return notes;
}

std::vector<std::string> Freedom::sets_at(const VectorXd& place) const {
  std::vector<std::string> sets;
  Index at = 0;
  for (const FreeVariable& freed : keys_) {
    const Index size = freed.key->variables();
    sets.push_back(freed.path + "=" + set_text(freed.key->value_at(place.segment(at, size))));
    at += size;
  }
  return sets;
}

}  // namespace dresslife::pipeline
