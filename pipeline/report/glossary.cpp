#include "pipeline/report/glossary.h"

#include <fmt/format.h>

#include "pipeline/report/plot.h"

namespace dresslife::pipeline {
namespace {

constexpr struct {
  const char *word, *meaning;
} entries[] = {
    // sorted by word
    {"bend radius", "radius of the circle that fits a curve at a place; the smaller it is, the more the hose is bent"},
    {"bore", "inside of a hose, where its cables and hoses lie (inner_diameter_mm)"},
    {"cable", "part of a dresspack with conductors in it, in a jacket of its own"},
    {"calendar", "a life in months, at the job's operating hours per week (fatigue.operating_hours_per_week)"},
    {"calibration", "the uncertain parameters, narrowed by observed lives; a file that dresslife calibrate writes"},
    {"candidate", "a job that a search tries: one set of values of the keys that are free"},
    {"clamp", "holds the dresspack in place, direction and twist; the base clamp is nearer to the robot's base"},
    {"component",
     "a kind of part in a dresspack: count equal parts on one circle, which may hold components themselves"},
    {"conductor",
     "bundle of wires in one insulation; it has failed when it has lost its share of wires at one place "
     "(fatigue.failed_wires_percent)"},
    {"core", "what fills the middle of a hose and is not described as parts (core_diameter_mm)"},
    {"cycle", "one closed loop of strain, as counted by the rainflow method"},
    {"damage", "share of the life that a cycle, or a repeat of the motion, uses up; the life ends at 1 (Miner)"},
    {"dresspack", "the hose on a robot with everything in it: cables, water and air hoses"},
    {"ESTIMATE", "a number without a measurement on this dresspack; the life depends on it"},
    {"fails first", "what fails first in most of the samples that fail, and in which share of them"},
    {"force warning", "the model computes a force that would tear a cable: do not plan with the hours"},
    {"free length", "length of dresspack between its clamps (routing.free_length_m)"},
    {"friction inside", "between wires, conductors and cables; it decides how much of a bend stretches the wires"},
    {"glued, stuck", "parts that cannot slide on each other; a bound, not a best estimate (strain.slip: stick)"},
    {"job",
     "one robot with one program and its dresspacks: what one life is computed for; dresslife new writes a first one"},
    {"lay", "the helix on which a part is wound: its angle to the axis, its length for one turn, its hand"},
    {"level", "a step down in a dresspack: 1 its cables, 2 their conductors, 3 the wires of these"},
    {"life", "hours of motion, or repeats of the program, until something fails"},
    {"loose", "a cable that lies free in its bore, with room and slack, and moves to where it rests"},
    {"mean stress",
     "a constant stress below a cycle; pull shortens a life, and copper loses part of it with time (relaxation)"},
    {"observation",
     "what is known of a real cable or dresspack: a maker's rating, a stiffness, a test, one that broke or has "
     "not broken"},
    {"p10, p50, p90",
     "of 100 equal dresspacks 10, 50, 90 have failed by then, over the scatter of wires and the "
     "uncertain inputs; in tables: replace after, half failed, 90 % failed"},
    {"play, room", "how far a loose cable can leave its place, until it meets the wall, the core or a neighbour"},
    {"prior, posterior", "the distribution of a parameter before and after observations"},
    {"rating", "cycles that a maker promises of a cable in a standard test rig"},
    {"repeat", "one run of the robot's program"},
    {"replace after",
     "the p10: by then 1 of 10 such dresspacks has failed; \"over 40,000\" is beyond fatigue.robot_life_hours"},
    {"replace if glued .. free",
     "the same number if nothing inside the cables could slip, and if everything slipped "
     "without friction"},
    {"rig", "a standard test for cables: energy chain, rolling flex, torsion and others"},
    {"sample", "one moment of a motion; or one set of values of all uncertain parameters"},
    {"scatter", "equal wires under equal strains break at different times"},
    {"segment", "one of the rigid pieces into which the hose is cut; 1 is nearest to the tool in tables"},
    {"share of the uncertainty", "of the spread of predicted lives, what one uncertain parameter explains"},
    {"slack",
     "length of the hose beyond the distance of its clamps; of a cable, beyond the path on which it was installed "
     "(slack_percent)"},
    {"slip", "whether parts slide on each other: stick, free, or friction, the best estimate (strain.slip)"},
    {"strain", "change of length over length; 0.01 is one per cent"},
    {"study", "many jobs that are run and compared; its YAML file lists the keys that vary"},
    {"twist", "turn of the hose about its own axis per length"},
    {"uncertainty",
     "the inputs of a dresspack that are not known exactly, such as friction, slack and copper; each has a distribution"},
    {"warning", "results stand, but a person should look before believing them; it names its cause and a remedy"},
};

}  // namespace

std::string glossary_html() {
  std::string text = "<details id=\"words\"><summary>What the words mean</summary>\n<dl>\n";
  for (const auto& entry : entries)
    text += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(entry.word), escaped(entry.meaning));
  return text + "</dl></details>\n";
}

}  // namespace dresslife::pipeline
