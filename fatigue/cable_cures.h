// Cause and remedy of a large force in a cable, as text of the warning.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pipeline/cable/cable_force.h"
#include "pipeline/files/files.h"
#include "pipeline/job/job.h"

namespace dresslife::fatigue {

/// Returns the component of a cable in /cable of a strain file. Errors: InputError if the job does not have it.
const pipeline::Component& component_of(const pipeline::FileReader& strain, const pipeline::Job& job,
                                        std::size_t dresspack, std::size_t component);

/// Data of a cable besides its force.
struct CableFacts {
  std::string name;
  std::string key;     ///< its dresspack as a line of the job: "dresspack"
  std::string number;  ///< of its component in a key path
  const pipeline::Component* component = nullptr;
  const pipeline::Dresspack* dresspack = nullptr;
  double room = 0, least_gain = 0, most_gain = 0;  ///< /cable/room, /cable/path_gain
  bool has_room = false;                           ///< the file contains these
  double winding_slack = 0;                        ///< see pipeline/cable/excess.h; 0: unknown, or not needed
  double slack_factor = 1;                         ///< its slack over slack_percent
  const pipeline::Motion* motion = nullptr;        ///< null: clamps of a robot move the dresspack
  std::string between{};  ///< " between the base clamp and clamp 1"; empty: its dresspack has two clamps
};

/// Returns the data of all cables of a strain file.
std::vector<CableFacts> facts_of(const pipeline::FileReader& strain, const pipeline::Job& job);

/// Returns a key of the component, which all its `count` cables share, as a line of the job:
/// "dresspack.components.2.slack_percent".
std::string cable_key(const CableFacts& facts, const char* key);

/// Words of a remedy. Bends in opposite directions pull cables that wind around the hose's axis, whatever their slack.
inline constexpr std::string_view gentle_clamps = "clamps between which the hose bends less, and in one direction only";

struct Cure {
  std::string cause, remedy;
};

/// Returns the cause and the remedy of a large force: a slack whose force is within the limit, by the gains of the path and by
/// the excess that a helix in its room can take. acceleration: motion.acceleration_percent.
Cure cure_of(const CableFacts& facts, const pipeline::CableForce& cable, bool sticks, bool compressed,
             double acceleration);

/// Returns "at 1.2 s, program step 3 'text'".
std::string moment_of(const pipeline::FileReader& strain, std::size_t sample);

}  // namespace dresslife::fatigue
