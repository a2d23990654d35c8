// Two dresspacks in one file have the same strains and lives as in two separate files.
#include <Eigen/Geometry>
#include <cmath>
#include <map>

#include "fatigue/life_file.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/job/job.h"
#include "pipeline/resolve/job_text.h"
#include "pipeline/settings/document.h"
#include "strain/strain_file.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_job.h"
#include "tests/pipeline/scratch.h"
#include "tests/strain/hose_poses.h"

using namespace dresslife;
using pipeline::FileReader;
using pipeline::FileWriter;
using pipeline::Scratch;

namespace {

constexpr std::size_t samples = 60;
constexpr double packing = 1.1e-7;  // turning points are kept in steps of 5e-8 of strain above the least of their chunk
constexpr double of_packing = 1e-4;  // of a damage: 5e-8 of strains of 1e-2, to the power of 8 at most

/// A dresspack that bends and twists uniformly, with the amplitude of its motion.
struct Hose {
  std::string name;
  std::size_t segments;
  double length, much;
};
const Hose thick{"main hose", 8, 1.2, 1}, thin{"sensor cable", 5, 0.9, 1.7};

void stamp(FileWriter& file) {
  for (const char* name : {"job", "history", "input_sha256"}) file.attribute(name, "");
  file.commit();
}

void write_motion(const std::filesystem::path& name, const std::vector<Hose>& hoses) {
  FileWriter file(name, pipeline::motion_format());
  std::vector<std::int32_t> dresspack, clamp_segment;
  std::vector<double> length;
  std::vector<std::string> names;
  for (const Hose& hose : hoses) {
    clamp_segment.push_back(static_cast<std::int32_t>(length.size()));
    dresspack.insert(dresspack.end(), hose.segments, static_cast<std::int32_t>(names.size()));
    length.insert(length.end(), hose.segments, hose.length / hose.segments);
    clamp_segment.push_back(static_cast<std::int32_t>(length.size()));
    names.push_back(hose.name);
  }
  file.set_axis("segment", length.size());
  file.set_axis("clamp", clamp_segment.size());
  file.set_axis("dresspack", names.size());
  for (std::size_t t = 0; t < samples; ++t) {
    tests::HosePoses poses;
    const Eigen::Vector3d rate(2 * std::sin(0.3 * t), 1.5 * std::cos(0.2 * t), 3 * std::sin(0.1 * t));
    for (const Hose& hose : hoses) poses.add(hose.much * rate, hose.length, hose.segments);
    file.append("/time", std::vector<double>{0.04 * t});
    poses.append_to(file);
    file.append("/program/step", std::vector<std::int32_t>{static_cast<std::int32_t>(t / 10)});
    file.append("/contact/count", std::vector<std::int32_t>{0});
    file.append("/contact/max_depth", std::vector<double>{0});
    file.append("/energy", std::vector<double>{0, 0, 0});
    file.append("/tension", std::vector<double>(length.size(), 0.0));
  }
  file.append("/segment/length", length);
  file.append("/segment/dresspack", dresspack);
  file.append("/dresspack/name", names);
  file.append("/clamp/segment", clamp_segment);
  file.append("/program/text", std::vector<std::string>{"nod", "rest", "nod", "rest", "nod", "home"});
  stamp(file);
}

std::string block(const std::string& from, const std::string& to) {
  const std::size_t begin = pipeline::sample_job.find(from);
  return pipeline::sample_job.substr(begin, pipeline::sample_job.find(to) - begin);
}
const std::string thick_block = block("dresspack:", "routing:"), routing_block = block("routing:", "simulation:");
std::string routing_of(const Hose& hose) {
  std::string text = routing_block;
  const std::string own = "free_length_m: 1.2";
  return text.replace(text.find(own), own.size(), fmt::format("free_length_m: {}", hose.length));
}
/// A dresspack of one level only, with a wall.
const std::string thin_block =
    "dresspack:\n  name: cable\n  source: made for the tests\n  diameter_mm: 20\n  mass_kg_per_m: 0.3\n"
    "  bending_stiffness_Nm2: 0.2\n  torsional_stiffness_Nm2: 0.2\n  axial_stiffness_N: 1e5\n"
    "  damping_time_ms: 10\n  damping_source: guessed\n  hose_material: hose_polyamide\n  inner_diameter_mm: 17\n"
    "  components: [{name: core, count: 4, radius_mm: 0.3, helix_radius_mm: 3, lay_angle_deg: 15, material: "
    "copper}]\n";

std::string indented(const std::string& text) {
  std::string result = "    ";
  for (const char c : text.substr(0, text.size() - 1)) result += c == '\n' ? "\n    " : std::string(1, c);
  return result + "\n";
}

/// Returns the sample job with other dresspacks instead of its own, and probes in the second segment from the tool.
pipeline::Job job_of(const std::string& dresspacks, const std::vector<std::string>& probes) {
  std::string list;
  for (const std::string& probe : probes) list += "{segment_from_tool: 2, component: " + probe + "}, ";
  std::string text = pipeline::edited(pipeline::sample_job, thick_block, "");
  text = pipeline::edited(text, routing_block, dresspacks);
  return pipeline::job_from(pipeline::parse_yaml(text, "job.yaml"),
                            {"strain.slip=free", "strain.probes=[" + list + "]"});
}

std::string item(const Hose& hose, const std::string& dresspack) {
  return "  - name: " + hose.name + "\n" + indented(dresspack) + indented(routing_of(hose));
}

const std::string both = "dresspacks:\n" + item(thick, thick_block) + item(thin, thin_block);

/// Evaluates motion.h5 to strain.h5 and to life.h5. All three names begin with `stem`.
void evaluate(const Scratch& scratch, const std::string& stem, const pipeline::Job& job, std::size_t threads = 1,
              std::size_t history_bytes = strain::default_history_bytes) {
  {
    const FileReader motion(scratch / (stem + ".motion.h5"), pipeline::motion_format());
    FileWriter file(scratch / (stem + ".strain.h5"), pipeline::strain_format());
    strain::write_strain(
        motion, job, file, threads, [](double) {}, history_bytes);
    stamp(file);
  }
  const FileReader strained(scratch / (stem + ".strain.h5"), pipeline::strain_format());
  FileWriter file(scratch / (stem + ".life.h5"), pipeline::life_format());
  fatigue::write_life(strained, job, file, threads, [](double) {});
  stamp(file);
}

double furthest(const std::vector<float>& a, const std::vector<float>& b) {
  REQUIRE(a.size() == b.size());
  double most = 0;
  for (std::size_t k = 0; k < a.size(); ++k) most = std::max(most, std::abs(double(a[k]) - b[k]));
  return most;
}

/// Returns a dataset of the first file followed by the same dataset of the second file.
template <class T>
std::vector<T> one_after_the_other(const FileReader& first, const FileReader& second, const std::string& dataset) {
  std::vector<T> values = first.read<T>(dataset);
  const std::vector<T> more = second.read<T>(dataset);
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

}  // namespace

TEST_CASE("two dresspacks in one file have the strains and lives of two files") {
  const Scratch scratch;
  write_motion(scratch / "both.motion.h5", {thick, thin});
  write_motion(scratch / "thick.motion.h5", {thick});
  write_motion(scratch / "thin.motion.h5", {thin});
  evaluate(scratch, "both", job_of(both, {"main hose/cable 1/wire 1", "sensor cable/core 2"}));
  evaluate(scratch, "thick", job_of(thick_block + routing_of(thick), {"cable 1/wire 1"}));
  evaluate(scratch, "thin", job_of(thin_block + routing_of(thin), {"core 2"}));
  {
    const FileReader all(scratch / "both.strain.h5", pipeline::strain_format()),
        first(scratch / "thick.strain.h5", pipeline::strain_format()),
        second(scratch / "thin.strain.h5", pipeline::strain_format());
    for (const char* group : {"", "/bound_stick", "/bound_free"}) {
      CAPTURE(group);
      const std::string site = std::string(group) + "/site/", reversal = std::string(group) + "/reversal/";
      const std::size_t of_first = first.rows(site + "segment"), sites = all.rows(site + "segment");
      REQUIRE(sites == of_first + second.rows(site + "segment"));
      CHECK(furthest(all.read<float>(reversal + "strain"),
                     one_after_the_other<float>(first, second, reversal + "strain")) < packing);
      CHECK(all.read<std::uint32_t>(reversal + "sample") ==
            one_after_the_other<std::uint32_t>(first, second, reversal + "sample"));
      auto segment = one_after_the_other<std::int32_t>(first, second, site + "segment");
      for (std::size_t k = of_first; k < sites; ++k) segment[k] += 8;
      CHECK(all.read<std::int32_t>(site + "segment") == segment);
      auto component = one_after_the_other<std::string>(first, second, site + "component");
      for (std::size_t k = 0; k < sites; ++k)
        component[k] = (k < of_first ? "main hose/" : "sensor cable/") + component[k];
      CHECK(all.read<std::string>(site + "component") == component);
      // The first dresspack has two levels, the second one level. Zeros fill the rest of its table.
      const auto helix = all.read<double>(site + "helix"), own = second.read<double>(site + "helix");
      REQUIRE(helix.size() == 6 * sites);
      for (std::size_t k = of_first; k < sites; ++k)
        for (std::size_t i = 0; i < 6; ++i) CHECK(helix[6 * k + i] == (i < 3 ? own[3 * (k - of_first) + i] : 0));
    }
    CHECK(furthest(all.read<float>("/probe/strain"), one_after_the_other<float>(first, second, "/probe/strain")) <
          packing);
    const auto probe = all.read<std::uint32_t>("/probe/site"), own = second.read<std::uint32_t>("/probe/site");
    const std::size_t probes = first.rows("/probe/site");
    REQUIRE(probe.size() == probes + own.size());
    for (std::size_t k = 0; k < own.size(); ++k) CHECK(probe[probes + k] == own[k] + first.rows("/site/segment"));
    CHECK(all.read<std::int32_t>("/segment/dresspack")[8] == 1);
  }
  const FileReader all(scratch / "both.life.h5", pipeline::life_format()),
      first(scratch / "thick.life.h5", pipeline::life_format()),
      second(scratch / "thin.life.h5", pipeline::life_format());
  for (const char* dataset : {"/damage", "/segment/damage", "/layer/damage", "/clamp/damage", "/dresspack/damage"}) {
    CAPTURE(dataset);
    const auto damage = all.read<double>(dataset), own = one_after_the_other<double>(first, second, dataset);
    REQUIRE(damage.size() == own.size());
    for (std::size_t k = 0; k < own.size(); ++k) CHECK(damage[k] == Approx(own[k]).epsilon(of_packing));
  }
  CHECK(all.read<std::string>("/dresspack/name") == std::vector<std::string>{"main hose", "sensor cable"});
  CHECK(all.read<std::string>("/clamp/name") ==
        std::vector<std::string>{"main hose, base clamp", "main hose, tool clamp", "sensor cable, base clamp",
                                 "sensor cable, tool clamp"});
  CHECK(all.read<std::string>("/layer/component") ==
        std::vector<std::string>{"main hose/cable/wire", "sensor cable/core"});
  // The worse dresspack is reported. Its segment is counted from its own tool clamp.
  const bool worse_first = first.number_attribute("life_hours") < second.number_attribute("life_hours");
  const FileReader& worse = worse_first ? first : second;
  const std::string name = worse_first ? "main hose" : "sensor cable";
  CHECK(all.text_attribute("worst_dresspack") == name);
  CHECK(first.text_attribute("worst_dresspack").empty());
  for (const char* attribute :
       {"life_hours", "worst_segment_from_tool", "worst_position_from_tool", "worst_time", "life_repeats_all_stick"})
    CHECK(all.number_attribute(attribute) ==
          Approx(std::string(attribute) == "life_repeats_all_stick"
                     ? std::min(first.number_attribute(attribute), second.number_attribute(attribute))
                     : worse.number_attribute(attribute))
              .epsilon(of_packing));
  CHECK(all.text_attribute("worst_component") == name + "/" + worse.text_attribute("worst_component"));
  // Only the second dresspack has a wall.
  CHECK(all.number_attribute("hose_life_hours") ==
        Approx(second.number_attribute("hose_life_hours")).epsilon(of_packing));
  CHECK(all.text_attribute("hose_component") == "sensor cable/" + second.text_attribute("hose_component"));
  CHECK(all.number_attribute("hose_segment_from_tool") == second.number_attribute("hose_segment_from_tool"));
  CHECK_FALSE(first.has_attribute("hose_life_hours"));
}

TEST_CASE("two dresspacks in one file give the same bytes for any threads and any memory") {
  const Scratch scratch;
  write_motion(scratch / "one.motion.h5", {thick, thin});
  write_motion(scratch / "other.motion.h5", {thick, thin});
  evaluate(scratch, "one", job_of(both, {"main hose/cable 1/wire 1"}));
  evaluate(scratch, "other", job_of(both, {"main hose/cable 1/wire 1"}), 3, 1);
  for (const char* kind : {".strain.h5", ".life.h5"})
    CHECK(pipeline::read_text(scratch / (std::string("one") + kind)) ==
          pipeline::read_text(scratch / (std::string("other") + kind)));
}

TEST_CASE("what does not fit together among several dresspacks is reported") {
  const Scratch scratch;
  write_motion(scratch / "both.motion.h5", {thick, thin});
  write_motion(scratch / "thick.motion.h5", {thick});
  CHECK_THAT(pipeline::message_of([&] { evaluate(scratch, "both", job_of(both, {"core 2"})); }),
             Catch::Contains("strain.probes: 'core 2' does not begin with the name of a dresspack; begin it with "
                             "'main hose/'"));
  CHECK_THAT(pipeline::message_of([&] { evaluate(scratch, "both", job_of(both, {"sensor cable/cor 2"})); }),
             Catch::Contains("strain.probes: no wire is called 'sensor cable/cor 2'") &&
                 Catch::Contains("write it like 'sensor cable/core 1'"));
  CHECK_THAT(pipeline::message_of([&] { evaluate(scratch, "thick", job_of(both, {"main hose/cable 1/wire 1"})); }),
             Catch::Contains("holds 1 dresspacks (its job has 2)"));
}

TEST_CASE("a dresspack without wires leaves the wires of the others as they are") {
  const Scratch scratch;
  write_motion(scratch / "both.motion.h5", {thick, thin});
  write_motion(scratch / "bare.motion.h5", {thick, thin});
  evaluate(scratch, "both", job_of(both, {"main hose/cable 1/wire 1"}));
  pipeline::Job bare = job_of(both, {"main hose/cable 1/wire 1"});
  bare.dresspacks[1].dresspack.components.clear();
  evaluate(scratch, "bare", bare);
  const pipeline::FileReader with(scratch / "both.life.h5", pipeline::life_format()),
      without(scratch / "bare.life.h5", pipeline::life_format());
  const auto damage_of = [](const pipeline::FileReader& life) {
    const auto segment = life.read<std::int32_t>("/site/segment");
    const auto wire = life.read<std::string>("/site/component");
    const auto damage = life.read<double>("/damage");
    std::map<std::pair<std::string, std::int32_t>, double> of_main;
    for (std::size_t k = 0; k < damage.size(); ++k)
      if (wire[k].starts_with("main hose/")) of_main[{wire[k], segment[k]}] += damage[k];
    return of_main;
  };
  CHECK_FALSE(damage_of(without).empty());
  CHECK(damage_of(without) == damage_of(with));
}
