// A job: robot, motion, dresspacks with their routings, and the settings of each stage.
//
// Each part of a job has two files in this folder, with one describe() that lists its keys: name with unit, range, default and
// meaning. This list is used to read, check, echo and document the key (fields.h). All values in structs are SI; the unit in a
// YAML key is the unit in the file. Robot, motion, dresspack and material are catalogue entries: a job names a file of config/ or
// contains the entry itself. `from: NAME` starts from a catalogue entry.
//
// Prefer setup.h or pipeline/resolve/job_text.h: a file that includes job.h is compiled again after a change of any key.
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
  std::optional<Calibration> calibration;  ///< learned from observations; its medians are in the keys
};

void describe(Fields& f, Job& job);

/// Returns the knowledge about the job's parameters: that of its calibration, or the prior without a calibration.
ParameterKnowledge knowledge_of(const Job& job);

/// material_of returns the material of wires of material `name` after changed(). hose_material_of returns the material of a
/// hose's wall, which fatigue.material does not replace. All dresspacks share the materials: one name is one material.
/// Precondition: the job was read by read_job() or job_from().
Material material_of(const Job& job, const std::string& name);
const Material& hose_material_of(const Job& job, const Dresspack& dresspack);

}  // namespace dresslife::pipeline
