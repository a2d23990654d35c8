// From the strains of every site to what a report tells: which wire breaks first, where, when, and what moved
// then.
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

/// Damage of every site of a set, with what ranks equals.
struct SiteDamage {
  std::vector<double> damage;      ///< (site) per repeat of the motion
  std::vector<float> range;        ///< (site) largest minus smallest strain
  std::vector<std::uint8_t> wall;  ///< (site) 1: a place of the hose's wall, 0: a wire; empty: all wires

  bool is_wire(std::size_t site) const { return wall.empty() || wall[site] == 0; }
  /// Larger damage first; where equal (often 0), larger range first, then lower index.
  bool worse(std::size_t a, std::size_t b) const;
  std::size_t worst_wire() const;  ///< no_site without wires
  std::size_t worst_wall() const;  ///< no_site without a wall
};

/// What damages each site of a set: one counter for each of its materials, in the order of
/// SiteSet::material(), and one for the hose's wall, which keeps its material when the job gives all wires
/// another.
class SiteCounters {
 public:
  /// longest: see DamageCounter.
  SiteCounters(const SiteSet& sites, const TextColumn& component, const pipeline::Job& job,
               double longest = most_reversals);
  const DamageCounter& of(std::size_t site) const;
  bool is_wall(std::size_t site) const { return wall_of_component_[component_[site]] >= 0; }
  bool settle() const;  ///< whether any of them does (DamageCounter::settles)

 private:
  std::vector<DamageCounter> by_material_;
  std::vector<DamageCounter> wall_;            // of the dresspacks that have one
  std::vector<int> wall_of_component_;         // (component) index into wall_; -1: a wire
  std::span<const int> component_, material_;  // (site)
};

/// Damage of all sites, on `threads` threads. Each site is computed alone, so any number of threads gives the same
/// result. progress is called with the share that is done.
SiteDamage damage_of(const SiteSet& sites, const SiteCounters& counters, std::size_t threads,
                     const std::function<void(double)>& progress);

/// The worst site of each group, (group); no_site where a group is empty. group_of(site) < groups, or no_site
/// for a site of no group.
std::vector<std::size_t> worst_by_group(const SiteDamage& all, std::size_t groups,
                                        const std::function<std::size_t(std::size_t)>& group_of);

/// (F24) Where mean stress falls from repeat to repeat, damage_of() gives each site's damage with the share that
/// follows from its outermost loop. Here the worst site of each group gets 1 / life (F23), and the
/// others of the group change by the same factor. strains_of(site): its reversals'.
void settle(SiteDamage& all, const SiteCounters& counters, std::size_t groups,
            const std::function<std::size_t(std::size_t)>& group_of,
            const std::function<std::vector<float>(std::size_t)>& strains_of, std::size_t threads);

/// The `count` worst wires that are damaged at all, worst first.
std::vector<std::size_t> worst_wires(const SiteDamage& all, std::size_t count);

/// The dresspack of a job that a component's path names, and the path within it; before that of a job with
/// one dresspack nothing stands. Errors: InputError for a name that the job does not have.
struct PathInJob {
  std::size_t dresspack = 0;
  std::string inside;
};
PathInJob path_in_job(const pipeline::Job& job, const std::string& component);

/// Its path in words: without the number of a cable that is the only one of its name, "power cable/core 2".
std::string path_in_words(const pipeline::Job& job, const std::string& component);

/// Path of a wire without the numbers of its parts: "signal cable 3/conductor 2/layer 1/wire 17" of a job
/// whose components name a layer "layer 1" is "signal cable/conductor/layer 1/wire".
std::string layer_of(const std::string& component, const std::vector<std::string>& layer_names);
std::vector<std::string> layer_names(const pipeline::Dresspack& dresspack);

/// Strain at every sample from the reversals alone: straight between them. Precondition: reversals not empty.
std::vector<double> strain_between_reversals(const std::vector<Reversal>& reversals, std::size_t samples);

}  // namespace dresslife::fatigue
