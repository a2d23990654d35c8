#include "pipeline/resolve/beds.h"

#include <fmt/format.h>

#include "pipeline/base/csv_rows.h"
#include "pipeline/cable/polymer.h"
#include "pipeline/job/kinematics.h"
#include "pipeline/resolve/cable_alone.h"

namespace dresslife::pipeline {
namespace {

void add_below(Node& parent, bool in_hose) {
  Node* const parts = parent.find("components");
  if (!parts || !parts->is_list()) return;
  for (Node& part : parts->items) {
    if (!part.is_map() || !part.find("components")) continue;
    const Node* const radius = part.find("helix_radius_mm");
    const bool on_axis = radius && number_in(radius->text) == 0.0;
    if (!in_hose && !on_axis && !part.find("radial_stiffness_N_per_m2")) {
      Node& bed = part["radial_stiffness_N_per_m2"];
      bed = scalar(fmt::format("{:g}", polymer_modulus));
      bed.where = part.entries.back().where = part.where;
    }
    add_below(part, false);
  }
}

}  // namespace

void add_beds(Node& dresspack, const Node& job) {
  const Node* const strain = job.find("strain");
  const Node* const kinematics = strain && strain->is_map() ? strain->find("kinematics") : nullptr;
  if (kinematics && kinematics->text == word(Kinematics::thesis)) return;
  add_below(dresspack, is_hose(dresspack));
}

}  // namespace dresslife::pipeline
