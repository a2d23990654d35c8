// A job: robot, motion, dresspacks with their routings, and the settings of each stage.
//
// Each part has a pair of files of its own in this room, with one describe() that lists its keys once: name
// with unit, range, default and meaning. That list reads, checks, echoes and documents the key (see
// fields.h). All values here are SI; the unit in a YAML key is the unit of the file. Robot, motion, dresspack
// and material are catalogue entries: a job names a file of config/ or holds the entry itself, and `from:
// NAME` starts from a catalogue entry.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/job/document.h"
#include "pipeline/job/dresspack.h"
#include "pipeline/job/fatigue.h"
#include "pipeline/job/motion.h"
#include "pipeline/job/robot.h"
#include "pipeline/job/routing.h"
#include "pipeline/job/shapes.h"
#include "pipeline/job/simulation.h"
#include "pipeline/job/strain.h"

namespace dresslife::pipeline {

/// One of the robot's dresspacks as it is clamped.
struct MountedDresspack {
  std::string name;  ///< empty: the only one, given by the job's own keys `dresspack` and `routing`
  Dresspack dresspack;
  Routing routing;
  Where where;
};

struct Job {
  Robot robot;  ///< no joints with clamp_poses
  Motion motion;
  std::vector<MountedDresspack> dresspacks = std::vector<MountedDresspack>(1);  ///< at least one
  Cell cell;
  Simulation simulation;
  Strain strain;
  Fatigue fatigue;
};

/// Reads a job, looks up the catalogue entries that it names, applies `--set key.path=value` in their order,
/// checks everything that can be checked without running. Errors: InputError.
Job read_job(const std::filesystem::path& file, const std::vector<std::string>& sets = {});

/// The same for a job that is a tree already: a study's, or the `job` attribute of a file.
Job job_from(Node document, const std::vector<std::string>& sets = {});

/// The resolved job as YAML: catalogue entries written out, defaults filled in. Reads back to the same job.
std::string job_text(const Job& job);

/// What of the job each stage's result depends on; equal text (and equal files beside it), equal result.
enum class Part { sim, strain, fatigue };
std::string part_text(const Job& job, Part part);

/// Files beyond the job and the catalogue that dresslife-sim reads.
std::vector<std::filesystem::path> files_beside(const Job& job);

/// What tells a dresspack from the others: its name, or nothing where it is the only one; and the same as the
/// subject of a sentence: "dresspack 'main hose'", "dresspack".
std::string name_among(const Job& job, std::size_t dresspack);
std::string dresspack_words(const Job& job, std::size_t dresspack);

/// The material that a wire of material `name` has under these settings, and that of a hose's wall, which
/// fatigue.material leaves alone. Dresspacks share their materials: one name, one material. Precondition: the
/// job was read above.
const Material& material_of(const Job& job, const std::string& name);
const Material& hose_material_of(const Job& job, const Dresspack& dresspack);

/// Folders of the catalogue: "robots", "programs", "dresspacks", "materials". A name is looked up beside the
/// file that names it and in its parents (FOLDER/NAME.yaml, config/FOLDER/NAME.yaml; the working folder for
/// --set), then in the same way beside the job (a study or --set may change a job of another place), then in
/// the catalogue that comes with dresslife (installation.h: DRESSLIFE_CONFIG names another). Errors:
/// InputError with the near names.
Node catalogue_entry(const std::string& folder, const std::string& name, const Where& named_at,
                     const Where& job);

/// Sets the value at a key path (`simulation.segments`, `dresspacks.2.routing.free_length_m`); where: who
/// asks for it.
void set_value(Node& job, const std::string& path, Node value, const Where& where);

/// Sets the value at `key.path=value` in a job's tree; list items count from 1. Errors: InputError.
void apply_set(Node& job, const std::string& set);

/// Every key of a job, as Markdown tables.
std::string job_manual();

}  // namespace dresslife::pipeline
