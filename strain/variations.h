// Strains of the likely worst wires with other friction, slack and grips, from which dresslife-fatigue computes the
// influence of uncertain inputs on the life (pipeline/job/uncertainty.h).
//
// Lives depend on combinations of friction inside, slack and the hose's stiffness. At the job's own stiffness friction inside is
// crossed with slack. At another stiffness each is varied one by one, the bounds with each slack. The response combines the rest
// (pipeline/life/life_response.h). Friction along the hose and grips are varied one by one. Friction inside is also set to zero and
// to infinity (no slip at any pressure): the bounds of a cable. Play is not varied: in the shipped programs it changes lives by a
// tenth of a decade and would cost as much as a slack. Places and forces of cables are computed again for each variation except
// friction inside, and also for this where it acts on cables, because no hose surrounds them. The wires are the likely worst ones of
// each segment and layer of the job itself. If cables lie elsewhere, the likely worst wires of the cables that bend most there are
// added. A parameter whose spread is 1 is known and has no variations.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "pipeline/cable/cable_pulls.h"
#include "pipeline/job/job.h"
#include "pipeline/job/uncertainty.h"
#include "strain/evaluation.h"
#include "strain/shortening.h"
#include "strain/starts.h"

namespace dresslife::strain {

// Forces of the cables in one variation. dresslife-fatigue compares them with the limits of the forces at the job's own values.

/// Cables and spans are counted as in /cable and /cable_span of strain.h5.
struct VariedPulls {
  std::vector<double> tension;        ///< (cable) force of largest size over the motion, with its sign [N]
  std::vector<std::uint32_t> sample;  ///< (cable) its sample in the whole motion
  std::vector<double>
      place;  ///< (cable) its place, from the dresspack's base clamp [m]; -1: it is the same along the cable
  std::vector<double> moment;  ///< (span, 2) largest moment of all cables and of the hose, at the clamps [N m]
  std::vector<std::uint32_t> moment_place;  ///< (span, 2) sample of the cables' moment; cable that pulls most then
  std::vector<double> moment_tension;       ///< (span) force of that cable [N]
};

/// Precondition: the first pass has ended. shortening: of the motion that the evaluations follow, unless they follow all of it.
VariedPulls varied_pulls(const std::vector<std::unique_ptr<Evaluation>>& spans, const Shortening& shortening);

/// Returns the largest number of evaluations with other cable places besides the job's own; 0 if its uncertainty is off.
std::size_t placements_at_most(const pipeline::Job& job);

class Variations {
 public:
  static constexpr double reach = 1.5;  ///< 87 % of a normal distribution lie within +-1.5
  using Point =
      std::array<double, 5>;  ///< z of the strain parameters without rest, in the order of uncertain_parameters()
  using Spans = std::vector<std::unique_ptr<Evaluation>>;
  /// Creates evaluations of all spans with other factors and for this number of samples; the caller owns them.
  using Build = std::function<const Spans&(const pipeline::StrainFactors&, std::size_t samples)>;

  /// In the job's own motion. as_given: the job's own evaluations, of the whole motion. Variations with other places of cables follow
  /// the shortened motion, which must outlive this object. Without variations if the job's uncertainty is off or no part can slide.
  Variations(const pipeline::Job& job, const Spans& as_given, const Shortening& shortening, const Build& build);
  /// In the motion of a hose whose stiffness has this z; the first variation is that of the job's own factors. laid: with them. All
  /// follow the shortened motion.
  Variations(const pipeline::Job& job, double stiffness, const Spans& laid, const Shortening& shortening,
             const Build& build);

  bool empty() const { return points_.empty(); }
  double stiffness() const { return stiffness_; }                          ///< z of the hose's stiffness
  const std::vector<Point>& points() const { return points_; }             ///< (variation)
  const std::vector<pipeline::Inside>& inside() const { return inside_; }  ///< (variation)
  const std::vector<std::int32_t>& rests() const { return rests_; }        ///< (variation) rest of the starts
  /// Returns the evaluations of a span that need the motion in addition to the job's own.
  std::vector<Evaluation*> placed(std::size_t span) const;

  /// Finds the cables that bend most, where they do not lie at the job's own places. Precondition: all samples were added.
  void find_bent() const;
  /// Moves the cables of all variations to the present places of the job's own.
  void go_on() const;
  /// Adds the rests of starts as variations. Precondition: all samples were added.
  void add(const Starts& starts);

  /// Returns the forces of the cables, (variation). Precondition: all samples were added.
  std::vector<VariedPulls> pulls() const;

  /// Receives the results of a variation for some sites: their rows in the file and their turning points.
  using Put = std::function<void(std::size_t variation, const std::vector<std::size_t>& sites, const SiteRows& rows)>;
  /// Evaluates one segment. likely: the likely worst wires of the job's own evaluation there. history: of the whole motion in the
  /// job's own motion, else of the shortened motion.
  void evaluate(const std::vector<Evaluation::Site>& likely, std::size_t span, std::size_t segment,
                const DeformationHistory& history, std::size_t row, const Put& put) const;

 private:
  /// One set of cable places, with its factors of friction inside and the variation number of each factor.
  struct Placement {
    const Spans* spans;
    std::vector<double> factors;
    std::vector<std::size_t> variation;
  };
  /// Friction inside: at z, or of a bound.
  struct Friction {
    double z = 0;
    pipeline::Inside inside = pipeline::Inside::as_is;
    double factor() const;
  };
  /// Returns whether the cables of a placement do not lie where those of the job itself lie. Then other wires can be the worst.
  bool lies_elsewhere(const Placement& placement) const;
  static std::vector<Friction> other_frictions(const pipeline::Job& job, const Spans& spans);
  /// Returns the evaluations with friction inside at z; null: friction inside does not act on cables.
  using Rubbing = std::function<const Spans&(double z)>;
  static Rubbing rubbing(const pipeline::Job& job, const pipeline::StrainFactors& factors, const Spans& spans,
                         const Build& build);
  static void share_loose(const Spans& spans, const Spans& others);
  void add(const Spans& spans, Point z, const std::vector<Friction>& friction, const Rubbing& rubbing);
  /// Adds an evaluation with another value of a parameter than as_given_.
  void lay(const pipeline::Job& job, const Build& build, pipeline::Uncertain parameter, std::span<const double> nodes,
           const std::vector<Friction>& friction);

  bool enabled_;
  const Spans& as_given_;
  const Shortening& shortening_;
  double stiffness_ = 0;
  std::vector<Point> points_;
  std::vector<pipeline::Inside> inside_;
  std::vector<std::int32_t> rests_;
  std::vector<Placement> placements_;
};

}  // namespace dresslife::strain
