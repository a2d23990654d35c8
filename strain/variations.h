// Strains of the likely worst wires with other friction, slack, play and grips: what dresslife-fatigue needs
// to tell how a life depends on what is not known (pipeline/job/uncertainty.h).
//
// Friction inside is crossed with slack, friction along the hose and grips are moved one by one. Friction
// inside is also taken away, and made so large that nothing slips at any pressure: the bounds of a cable. Play is left
// out: in the shipped programs it moves lives by a tenth of a decade, and would cost as much as a slack.
// Where cables lie and pull is worked out again for each but friction inside. The wires are those that see most in
// each segment and layer of the job as it is, and where cables lie otherwise those of the cables that bend most there, too.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "pipeline/job/job.h"
#include "pipeline/job/uncertainty.h"
#include "strain/starts.h"

namespace dresslife::strain {

/// In how many ways cables are laid besides the job's own, at most; 0 where its uncertainty is off.
std::size_t placements_at_most(const pipeline::Job& job);

/// Likely worst wires of the job as it is, and those of an evaluation whose cables lie otherwise. Segments as in
/// Evaluation::likely_of_bent().
std::vector<Evaluation::Site> with_likely_of_bent(std::vector<Evaluation::Site> likely, Evaluation& placed, std::size_t segment,
                                                  const DeformationHistory& history, std::size_t row);

class Variations {
 public:
  static constexpr double reach = 1.5;  ///< 87 % of all that may be lie between
  using Point =
      std::array<double, 5>;  ///< z of the strain parameters but rest, in the order of uncertain_parameters()
  using Spans = std::vector<std::unique_ptr<Evaluation>>;
  /// Evaluations of all spans with other factors; they stay the caller's.
  using Build = std::function<const Spans&(const pipeline::StrainFactors&)>;

  /// Nothing is varied where the job's uncertainty is off, or nothing can slide.
  Variations(const pipeline::Job& job, const Spans& as_given, const Build& build);

  bool empty() const { return points_.empty(); }
  const std::vector<Point>& points() const { return points_; }  ///< (variation)
  const std::vector<pipeline::Inside>& inside() const { return inside_; }  ///< (variation)
  const std::vector<std::int32_t>& rests() const { return rests_; }        ///< (variation) rest of the starts
  /// Evaluations of a span that want the motion like the job's own.
  std::vector<Evaluation*> placed(std::size_t span) const;

  /// Cables of all variations go on from where the job's own are now.
  void go_on() const;
  /// The rests of starts become variations, too. All samples were added.
  void add(const Starts& starts);

  /// The result of a variation for a site: its row in the file and its turning points.
  using Put =
      std::function<void(std::size_t variation, const std::vector<std::size_t>& sites, const SiteRows& rows)>;
  /// Of one segment, right after the job's own evaluation of it.
  void evaluate(std::size_t span, std::size_t segment, const DeformationHistory& history, std::size_t row,
                const Put& put) const;

 private:
  /// One way in which cables lie, with factors of friction inside and the variation that each of them is.
  struct Placement {
    const Spans* spans;
    std::vector<double> factors;
    std::vector<std::size_t> variation;
  };
  /// Friction inside: at z, or as a bound has it.
  struct Friction {
    double z = 0;
    pipeline::Inside inside = pipeline::Inside::as_is;
    double factor() const;
  };
  void add(const Spans& spans, Point z, const std::vector<Friction>& friction);

  bool enabled_;
  const Spans& as_given_;
  std::vector<Point> points_;
  std::vector<pipeline::Inside> inside_;
  std::vector<std::int32_t> rests_;
  std::vector<Placement> placements_;
};

}  // namespace dresslife::strain
