// From the strains of every site to the statements of a report: which wire breaks first, where, and when.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "fatigue/damage.h"
#include "fatigue/strain_file.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/job/material.h"
#include "pipeline/job/strain.h"

namespace dresslife::pipeline {
struct Job;
}

namespace dresslife::fatigue {

constexpr std::size_t no_site = 0xffffffff;

/// Damage of every site of a set, and the data that order sites of equal damage.
struct SiteDamage {
  std::vector<double> damage;      ///< (site) per repeat of the motion
  std::vector<float> range;        ///< (site) largest minus smallest strain
  std::vector<std::uint8_t> wall;  ///< (site) 1: a place of the hose's wall, 0: a wire; empty: only wires

  bool is_wire(std::size_t site) const { return wall.empty() || wall[site] == 0; }
  /// Returns whether a comes before b: larger damage first, then larger range (damage is often 0), then lower index.
  bool worse(std::size_t a, std::size_t b) const;
  std::size_t worst_wire() const;  ///< no_site without wires
  std::size_t worst_wall() const;  ///< no_site without a wall
};

/// Damage counters of a set of sites: one for each of its materials, in the order of SiteSet::material(), and one for the wall of
/// each hose. The wall keeps its material when the job replaces that of all wires.
class SiteCounters {
 public:
  /// longest, compression: see DamageCounter.
  SiteCounters(const SiteSet& sites, const TextColumn& component, const pipeline::Job& job,
               double longest = most_reversals, Compression compression = Compression::by_rule);
  const DamageCounter& of(std::size_t site) const;
  bool is_wall(std::size_t site) const { return wall_of_component_[component_[site]] >= 0; }
  bool settle() const;  ///< whether any counter of the wires' materials does (DamageCounter::settles)

 private:
  std::vector<DamageCounter> by_material_;
  std::vector<DamageCounter> wall_;            // of the dresspacks with a wall
  std::vector<int> wall_of_component_;         // (component) index into wall_; -1: a wire
  std::span<const int> component_, material_;  // (site)
};

/// Returns the damage of all sites, computed on `threads` threads. Each site is computed alone, so the number of threads does not
/// change the result. progress: receives the share that is done.
SiteDamage damage_of(const SiteSet& sites, const SiteCounters& counters, std::size_t threads,
                     const std::function<void(double)>& progress);

/// Returns the worst site of each group, (group); no_site for an empty group. group_of(site) < groups, or no_site for a site
/// without a group.
std::vector<std::size_t> worst_by_group(const SiteDamage& all, std::size_t groups,
                                        const std::function<std::size_t(std::size_t)>& group_of);

/// (F24) If mean stress falls from repeat to repeat, damage_of() uses for each site the share from its outermost loop. This
/// function sets the worst site of each group to 1 / life (F23) and multiplies the others of the group by the same factor.
/// strains_of(site): strains of its reversals.
void settle(SiteDamage& all, const SiteCounters& counters, std::size_t groups,
            const std::function<std::size_t(std::size_t)>& group_of,
            const std::function<std::vector<float>(std::size_t)>& strains_of, std::size_t threads);

/// Returns the `count` worst wires with damage, worst first.
std::vector<std::size_t> worst_wires(const SiteDamage& all, std::size_t count);

/// The dresspack that a component's path names, and the path within it. In a job with one dresspack the path does not name it.
/// Errors: InputError for a name that the job does not have.
struct PathInJob {
  std::size_t dresspack = 0;
  std::string inside;
};
PathInJob path_in_job(const pipeline::Job& job, const std::string& component);

/// Returns the path without the number of a cable that is the only one of its name: "power cable/core 2".
std::string path_in_words(const pipeline::Job& job, const std::string& component);

/// Returns the path of a wire without the numbers of its parts: "signal cable 3/conductor 2/layer 1/wire 17" in a job
/// with a layer named "layer 1" is "signal cable/conductor/layer 1/wire".
std::string layer_of(const std::string& component, const std::vector<std::string>& layer_names);
std::vector<std::string> layer_names(const pipeline::Dresspack& dresspack);

/// Returns the strain at every sample, linear between the reversals. Precondition: reversals not empty.
std::vector<double> strain_between_reversals(const std::vector<Reversal>& reversals, std::size_t samples);

}  // namespace dresslife::fatigue
