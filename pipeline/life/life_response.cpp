#include "pipeline/life/life_response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

#include "pipeline/base/constants.h"
#include "pipeline/base/lists.h"
#include "pipeline/base/statistics.h"

namespace dresslife::pipeline {
namespace {

using StrainPoint = std::array<double, strain_parameters>;

constexpr double farthest = LifeResponse::farthest;
constexpr std::size_t friction = index_of(Uncertain::friction_inside), slack = index_of(Uncertain::slack),
                      of_rest = index_of(Uncertain::rest), hose_stiffness = index_of(Uncertain::hose_stiffness);

std::size_t number_of(Inside inside) { return static_cast<std::size_t>(inside); }

/// Returns whether all z of a point, except those in `free`, are 0.
bool is_zero_but(const StrainPoint& point, std::initializer_list<std::size_t> free) {
  for (std::size_t p = 0; p < point.size(); ++p)
    if (point[p] != 0 && std::ranges::find(free, p) == free.end()) return false;
  return true;
}

void sort_once(std::vector<double>& nodes) {
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

constexpr double strain_power = 5;  // see together()

}  // namespace

double together(double base, std::span<const double> alone) {
  const auto changes = [&](double life) { return life != base; };
  const auto first = std::ranges::find_if(alone, changes);
  if (first == alone.end()) return base;
  if (std::none_of(first + 1, alone.end(), changes))
    return *first;  // a plan needs 1e8 lives, and two powers take most of their time
  double factor = 1, added = 0;
  for (const double life : alone) {
    if (life == base) continue;
    const double ratio = std::pow(10.0, (base - life) / strain_power);
    ratio < 1 ? factor *= ratio : added += ratio - 1;
  }
  return base - strain_power * std::log10(factor + added);
}

// ---- the response -----------------------------------------------------------------------------------------

namespace {

/// The parameters of which combinations are computed.
constexpr std::array crossed{friction, slack, hose_stiffness};
bool is_crossed(std::size_t parameter) { return std::ranges::find(crossed, parameter) != crossed.end(); }

/// W over the crossed parameters, for one kind of slip.
class CrossedLives {
 public:
  /// as_is: those of the job's own slip, if `inside` is a bound; else null.
  CrossedLives(const LifeResponse& response, Inside inside, const CrossedLives* as_is)
      : response_(response), as_is_(as_is), materials_(response.strength.size() * response.slope.size()) {
    for (std::size_t k = 0; k < response.points.size(); ++k)
      if (response.inside[k] == inside && is_zero_but(response.points[k], {friction, slack, hose_stiffness}))
        computed_[response.points[k]] = k;
    if (!as_is) return;
    const auto zero_of = [](const std::vector<double>& nodes) { return std::ranges::find(nodes, 0.0) - nodes.begin(); };
    const auto own = static_cast<std::size_t>(zero_of(response.strength)) * response.slope.size() +
                     static_cast<std::size_t>(zero_of(response.slope));
    shift_ = response.bound[number_of(inside)] - at({})[own];
  }

  std::vector<double> nodes_of(std::size_t parameter) const {
    std::vector<double> nodes = mapped(computed_, [&](const auto& computed) { return computed.first[parameter]; });
    sort_once(nodes);
    return nodes;
  }

  /// Returns W (strength, slope) at nodes of the crossed parameters.
  std::vector<double> at(const StrainPoint& point) const {
    const auto found = computed_.find(point);
    if (found == computed_.end()) return estimated(point);
    const auto begin = response_.worst_life.begin() + static_cast<std::ptrdiff_t>(found->second * materials_);
    std::vector<double> lives(begin, begin + static_cast<std::ptrdiff_t>(materials_));
    for (double& life : lives) life += shift_;
    return lives;
  }

 private:
  std::vector<double> estimated(const StrainPoint& point) const {
    StrainPoint base{}, one = point, other = point;
    if (point[friction] != 0 && point[slack] != 0)  // they combine at the stiffness of this point
      one[slack] = 0, other[friction] = 0, base[hose_stiffness] = point[hose_stiffness];
    else
      one[hose_stiffness] = 0, other[friction] = other[slack] = 0;
    if (one == point || other == point) return changed_as_is(point);
    std::vector<double> lives = at(base);
    const std::vector<double> of_one = at(one), of_other = at(other);
    for (std::size_t k = 0; k < lives.size(); ++k) lives[k] = together(lives[k], std::array{of_one[k], of_other[k]});
    return lives;
  }

  /// Returns W of a bound that was not computed at this point: it changes as that of the job's own slip.
  std::vector<double> changed_as_is(const StrainPoint& point) const {
    std::vector<double> lives = as_is_->at(point);
    if (point == StrainPoint{}) {
      for (double& life : lives) life += shift_;
      return lives;
    }
    const std::vector<double> own = as_is_->at({}), here = at({});
    for (std::size_t k = 0; k < lives.size(); ++k) lives[k] += here[k] - own[k];
    return lives;
  }

  const LifeResponse& response_;
  const CrossedLives* as_is_;
  std::size_t materials_;
  std::map<StrainPoint, std::size_t> computed_;
  double shift_ = 0;  ///< of a bound
};

}  // namespace

LifeSurface::LifeSurface(const LifeResponse& response) : response_(response) {
  std::map<StrainPoint, std::size_t> index;
  for (std::size_t k = 0; k < response.points.size(); ++k)
    if (response.inside[k] == Inside::as_is) index[response.points[k]] = k;
  for (std::size_t p = 0; p < strain_parameters; ++p) {
    if (is_crossed(p)) continue;
    for (const auto& [point, k] : index)
      if (is_zero_but(point, {p})) nodes_[p].push_back(point[p]), alone_[p].push_back(k);
  }
  const CrossedLives as_is(response, Inside::as_is, nullptr);
  for (const Inside inside : {Inside::as_is, Inside::glued, Inside::free}) {
    const bool bound = inside != Inside::as_is;
    const CrossedLives lives(response, inside, bound ? &as_is : nullptr);
    Table& of = tables_[number_of(inside)];
    of.friction = bound ? std::vector{0.0} : as_is.nodes_of(friction);
    of.slack = as_is.nodes_of(slack), of.stiffness = as_is.nodes_of(hose_stiffness);
    for (const double f : of.friction)
      for (const double s : of.slack)
        for (const double k : of.stiffness) {
          StrainPoint point{};
          point[friction] = f, point[slack] = s, point[hose_stiffness] = k;
          const std::vector<double> here = lives.at(point);
          of.worst.insert(of.worst.end(), here.begin(), here.end());
        }
  }
  at_zero_ = worst(response.worst_life, 0, place_among(response.strength, 0), place_among(response.slope, 0));
}

/// Returns the place of z among increasing nodes: between node `below` and the next one, at `share` of their distance. `share` is
/// outside of [0, 1] for z beyond the end nodes.
LifeSurface::Place LifeSurface::place_among(const std::vector<double>& nodes, double z) {
  if (nodes.size() < 2) return {};
  std::size_t below = 0;
  while (below + 2 < nodes.size() && z > nodes[below + 1]) ++below;
  return {below, (z - nodes[below]) / (nodes[below + 1] - nodes[below])};
}

namespace {

/// Interpolates linearly between the values of two nodes.
template <class Place, class ValueAt>
double between(const Place& place, const ValueAt& value_at) {
  const double first = value_at(place.below);
  return place.share == 0 ? first : first + place.share * (value_at(place.below + 1) - first);
}

}  // namespace

double LifeSurface::worst(const std::vector<double>& lives, std::size_t point, const Place& strength,
                          const Place& slope) const {
  const std::size_t slopes = response_.slope.size();
  const double* const of_point = lives.data() + point * response_.strength.size() * slopes;
  return between(
      strength, [&](std::size_t s) { return between(slope, [&](std::size_t t) { return of_point[s * slopes + t]; }); });
}

double LifeSurface::crossed_worst(const Table& of, const ParameterPoint& z, const Place& strength,
                                  const Place& slope) const {
  return between(place_among(of.friction, z[friction]), [&](std::size_t f) {
    return between(place_among(of.slack, z[slack]), [&](std::size_t s) {
      return between(place_among(of.stiffness, z[hose_stiffness]), [&](std::size_t k) {
        return worst(of.worst, (f * of.slack.size() + s) * of.stiffness.size() + k, strength, slope);
      });
    });
  });
}

double LifeSurface::alone(std::size_t p, const ParameterPoint& z, const Place& strength, const Place& slope) const {
  // Rest positions beyond those of the computed starts are unknown.
  const double at = p == of_rest ? std::clamp(z[p], nodes_[p].front(), nodes_[p].back()) : z[p];
  return between(place_among(nodes_[p], at),
                 [&](std::size_t k) { return worst(response_.worst_life, alone_[p][k], strength, slope); });
}

LifeSurface::Factors LifeSurface::factors_at(const ParameterPoint& z) {
  // both are factors, step^z
  static const auto step = [](Uncertain parameter) {
    return std::log10(uncertain_parameters()[index_of(parameter)].step);
  };
  static const Factors steps{step(Uncertain::model), step(Uncertain::motion)};
  return {steps[0] * z[index_of(Uncertain::model)], steps[1] * z[index_of(Uncertain::motion)]};
}

double LifeSurface::change(const ParameterPoint& far, const Factors& factors, Inside inside) const {
  ParameterPoint z = far;
  for (double& one : z) one = std::clamp(one, -farthest, farthest);
  if (inside != Inside::as_is) z[friction] = 0;
  const Place strength = place_among(response_.strength, z[index_of(Uncertain::strength)]);
  const Place slope = place_among(response_.slope, z[index_of(Uncertain::slope)]);
  std::array<double, strain_parameters> lives{crossed_worst(tables_[number_of(inside)], z, strength, slope)};
  std::size_t count = 1;
  for (std::size_t p = 0; p < strain_parameters; ++p)
    if (nodes_[p].size() > 1) lives[count++] = alone(p, z, strength, slope);
  double sum = together(worst(response_.worst_life, 0, strength, slope), std::span(lives).first(count)) - at_zero_;
  for (const double factor : factors) sum += factor;
  return sum;
}

double LifeSurface::log10_life(const ParameterPoint& z, double u, const Factors& factors, Inside inside) const {
  const Place scatter = place_among(response_.scatter, z[index_of(Uncertain::scatter)]);
  const auto at = [&](std::size_t share) {
    return between(scatter, [&](std::size_t k) { return response_.planned[k][share]; });
  };
  const double median = at(1);
  const double planned =
      u < 0 ? median + u / normal_decile * (median - at(0)) : median + u / normal_decile * (at(2) - median);
  const double life = planned + change(z, factors, inside);
  return life < LifeResponse::endless ? life : infinity;
}

bool LifeSurface::depends_on(std::size_t parameter) const {
  if (parameter < strain_parameters) return depends_on_strain(parameter);
  const std::size_t slopes = response_.slope.size(), of_point = response_.strength.size() * slopes;
  const std::vector<double>& W = response_.worst_life;
  if (parameter == index_of(Uncertain::strength)) {
    for (std::size_t k = 0; k < W.size(); ++k)
      if (W[k] != W[k - k % of_point + k % slopes]) return true;
    return false;
  }
  if (parameter == index_of(Uncertain::slope)) {
    for (std::size_t k = 0; k < W.size(); ++k)
      if (W[k] != W[k - k % slopes]) return true;
    return false;
  }
  return parameter == index_of(Uncertain::model) || parameter == index_of(Uncertain::motion) ||
         std::ranges::any_of(response_.planned, [&](const auto& lives) { return lives != response_.planned.front(); });
}

/// Returns whether W differs between two points with as_is that differ in this parameter only.
bool LifeSurface::depends_on_strain(std::size_t parameter) const {
  const auto of_point = static_cast<std::ptrdiff_t>(response_.strength.size() * response_.slope.size());
  const auto begin_of = [&](std::size_t point) {
    return response_.worst_life.begin() + static_cast<std::ptrdiff_t>(point) * of_point;
  };
  for (std::size_t one = 0; one < response_.points.size(); ++one)
    for (std::size_t other = 0; other < one; ++other) {
      if (response_.inside[one] != Inside::as_is || response_.inside[other] != Inside::as_is) continue;
      StrainPoint apart = response_.points[one];
      for (std::size_t p = 0; p < apart.size(); ++p) apart[p] -= response_.points[other][p];
      if (is_zero_but(apart, {parameter}) && !std::equal(begin_of(one), begin_of(one) + of_point, begin_of(other)))
        return true;
    }
  return false;
}

// ---- as text ----------------------------------------------------------------------------------------------

namespace {

template <class Numbers>
std::string line(const char* name, const Numbers& numbers) {
  std::string text = name;
  for (const double number : numbers) text += fmt::format(" {:.6g}", number);
  return text + "\n";
}

std::vector<double> numbers_after(std::istringstream& line) {
  std::vector<double> numbers;
  for (std::string word; line >> word;) {
    std::size_t used = 0;
    const double number = std::stod(word, &used);
    if (used != word.size() || !std::isfinite(number)) throw std::invalid_argument("not a number");
    numbers.push_back(number);
  }
  return numbers;
}

void check(const LifeResponse& response) {
  const auto holds_zero = [](const std::vector<double>& nodes) {
    return std::ranges::find(nodes, 0.0) != nodes.end() &&
           std::adjacent_find(nodes.begin(), nodes.end(), std::greater_equal<>()) == nodes.end();
  };
  const bool whole =
      !response.points.empty() && response.points[0] == StrainPoint{} &&
      response.inside.size() == response.points.size() && response.inside[0] == Inside::as_is &&
      holds_zero(response.strength) && holds_zero(response.slope) && holds_zero(response.scatter) &&
      response.worst_life.size() == response.points.size() * response.strength.size() * response.slope.size() &&
      response.planned.size() == response.scatter.size() && response.scatter_shared >= 0 &&
      response.scatter_shared <= 1 && response.residual_spread >= 0 &&
      response.knowledge.mean.size() == Eigen::Index(uncertain_count) &&
      response.knowledge.covariance.size() == Eigen::Index(uncertain_count * uncertain_count);
  if (!whole) throw std::invalid_argument("lists of other lengths");
}

/// Copies numbers into an array; throws std::invalid_argument for another length.
template <std::size_t size>
void fix(std::array<double, size>& array, const std::vector<double>& numbers) {
  if (numbers.size() != array.size()) throw std::invalid_argument("a list of another length");
  std::ranges::copy(numbers, array.begin());
}

/// Reads a line that consists of a name and a text; returns whether it is one.
bool read_name(LifeResponse& response, const std::string& name, const std::string& rest) {
  std::string* const to = name == "mode"           ? &response.mode
                          : name == "dresspack"    ? &response.dresspack
                          : name == "construction" ? &response.construction
                          : name == "material"     ? &response.material
                                                   : nullptr;
  if (to) *to = rest;
  return to != nullptr;
}

void read_numbers(LifeResponse& response, const std::string& name, const std::vector<double>& numbers,
                  std::vector<double>& covariance) {
  const auto add_point = [&](Inside inside) {
    fix(response.points.emplace_back(), numbers);
    response.inside.push_back(inside);
  };
  if (name == "mean") {
    response.knowledge.mean =
        Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
  } else if (name == "covariance") {
    covariance.insert(covariance.end(), numbers.begin(), numbers.end());
  }
  if (name == "point")
    add_point(Inside::as_is);
  else if (name == "glued_point")
    add_point(Inside::glued);
  else if (name == "free_point")
    add_point(Inside::free);
  else if (name == "planned")
    fix(response.planned.emplace_back(), numbers);
  else if (name == "bound")
    fix(response.bound, numbers);
  else if (name == "strength")
    response.strength = numbers;
  else if (name == "slope")
    response.slope = numbers;
  else if (name == "scatter")
    response.scatter = numbers;
  else if (name == "scatter_shared" && numbers.size() == 1)
    response.scatter_shared = numbers[0];
  else if (name == "residual_spread" && numbers.size() == 1)
    response.residual_spread = numbers[0];
  else if (name == "worst_life")
    response.worst_life = numbers;
}

}  // namespace

std::string LifeResponse::text() const {
  constexpr std::array<const char*, inside_count> point_names{"point", "glued_point", "free_point"};
  std::string text =
      "mode " + mode + "\ndresspack " + dresspack + "\nconstruction " + construction + "\nmaterial " + material + "\n";
  text += line("mean", std::vector<double>(knowledge.mean.begin(), knowledge.mean.end()));
  for (Eigen::Index row = 0; row < knowledge.covariance.rows(); ++row)
    text += line("covariance",
                 std::vector<double>(knowledge.covariance.row(row).begin(), knowledge.covariance.row(row).end()));
  for (std::size_t k = 0; k < points.size(); ++k) text += line(point_names[number_of(inside[k])], points[k]);
  text += line("strength", strength) + line("slope", slope) + line("scatter", scatter) + line("bound", bound);
  for (const auto& lives : planned) text += line("planned", lives);
  text += line("scatter_shared", std::array{scatter_shared});
  if (residual_spread != 1) text += line("residual_spread", std::array{residual_spread});
  return text + line("worst_life", worst_life);
}

LifeResponse LifeResponse::from_text(const std::string& text) {
  LifeResponse response;
  response.points.clear(), response.inside.clear(), response.worst_life.clear();
  response.knowledge.mean = Eigen::VectorXd::Zero(0);
  std::vector<double> covariance;
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) {
    std::istringstream words(one);
    std::string name;
    words >> name;
    if (!read_name(response, name, one.substr(std::min(one.size(), name.size() + 1))))
      read_numbers(response, name, numbers_after(words), covariance);
  }
  if (covariance.size() == uncertain_count * uncertain_count)
    response.knowledge.covariance =
        Eigen::Map<const Eigen::MatrixXd>(covariance.data(), uncertain_count, uncertain_count);
  check(response);
  return response;
}

}  // namespace dresslife::pipeline
