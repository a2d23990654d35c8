// A job: robot, motion, dresspacks with their routings, and the settings of each stage.
//
// Each part has a pair of files of its own in this room, with one describe() that lists its keys once: name
// with unit, range, default and meaning. That list reads, checks, echoes and documents the key (see
// fields.h). All values here are SI; the unit in a YAML key is the unit of the file. Robot, motion, dresspack
// and material are catalogue entries: a job names a file of config/ or holds the entry itself, and `from:
// NAME` starts from a catalogue entry.
//
// Include setup.h or pipeline/resolve/job_text.h where they do: what includes this is compiled again for every key.
#pragma once

#include <optional>
#include <string>

#include "pipeline/job/calibration.h"
#include "pipeline/job/fatigue.h"
#include "pipeline/job/inspection.h"
#include "pipeline/job/setup.h"
#include "pipeline/job/strain.h"
#include "pipeline/job/uncertainty.h"

namespace dresslife::pipeline {

struct Job : Setup {
  Strain strain;
  Fatigue fatigue;
  Inspection inspection;
  Uncertainty uncertainty;
  std::optional<Calibration> calibration;  ///< what observations have taught; its medians stand in the keys
};

void describe(Fields& f, Job& job);

/// What is known of its parameters: from observations where it names a calibration, else its prior.
ParameterKnowledge knowledge_of(const Job& job);

/// The material that a wire of material `name` has under these settings, as changed() leaves it, and that of
/// a hose's wall, which fatigue.material leaves alone. Dresspacks share their materials: one name, one
/// material. Precondition: the job was read by read_job() or job_from().
Material material_of(const Job& job, const std::string& name);
const Material& hose_material_of(const Job& job, const Dresspack& dresspack);

}  // namespace dresslife::pipeline
