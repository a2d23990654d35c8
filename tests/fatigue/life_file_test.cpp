// The stage on small strain files with known answers: the contents of life.h5, the consistency of its parts, and refused inputs.
#include "fatigue/life_file.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>

#include "fatigue/failure_modes.h"
#include "fatigue/scatter.h"
#include "fatigue/verdict.h"
#include "pipeline/base/statistics.h"
#include "pipeline/cable/believable.h"
#include "pipeline/cable/cable_bending.h"
#include "pipeline/cable/cable_force.h"
#include "pipeline/cable/kink.h"
#include "pipeline/cable/polymer.h"
#include "pipeline/job/job.h"
#include "pipeline/life/life_response.h"
#include "pipeline/life/unvalidated_modes.h"
#include "tests/catch.h"
#include "tests/fatigue/materials.h"
#include "tests/fatigue/wire_lives.h"

using namespace dresslife;
using namespace dresslife::fatigue;
using namespace dresslife::fatigue_tests;
using pipeline::FileReader;
using pipeline::FileWriter;

namespace {

constexpr double same_sum = 1e-12;  // relative: equal terms in another order
constexpr std::size_t samples = 101, segments = 4;
constexpr double duration = 50;  // of the motion below [s]

/// A folder of this test alone, removed at its end.
struct Folder {
  Folder() { std::filesystem::create_directories(path); }
  ~Folder() { std::filesystem::remove_all(path); }
  std::filesystem::path path = std::filesystem::temp_directory_path() / fmt::format("dresslife-life-{}", ::getpid());
};

struct Site {
  int segment = 0;
  std::string component, material;
  std::vector<float> strain;  // of the reversals
  std::vector<std::uint32_t> sample;
};

struct StrainFile {
  std::vector<Site> sites, stick, free;
  std::vector<std::uint32_t> probes;  // sites; their histories are 1000 + sample
  std::vector<std::int32_t> step = std::vector<std::int32_t>(samples, 0);
  std::uint64_t wrong_offset = 0;  // added to the last offset
  std::vector<double> joints;      // (sample, 6); empty: none
  struct Fibre {
    std::uint32_t site;
    std::vector<float> strain, shear;  // (sample)
  };
  std::vector<Fibre> fibres;  // fibres that are evaluated on planes
  struct Rubbed {
    double position, work, time;  // [m], [J], [s]
  };
  struct Jacket {
    std::int32_t cable;
    double position, work;  // [m], [J]
    std::uint32_t sample;
    std::int32_t rest = 0;
  };
  std::vector<std::int32_t> rests;  // (start)
  std::vector<Jacket> jackets;      // patches of 5 mm in one sector of 10 degrees; empty: no table
  struct Cable {
    std::int32_t span;
    std::vector<double> place;     // base d1, d2, tool d1, d2 [m]
    std::array<double, 3> strain;  // largest, at the base and at the tool clamp; at the last sample, with linear rise
    std::int32_t dresspack = 0;
  };
  std::vector<Cable> cables;        // of its dresspack's first component
  double room = 0;                  // of each cable [m]; 0: no table
  double twist = 0;                 // of all segments at the last sample, with linear rise [rad/m]
  std::vector<double> hose_moment;  // (span) at the last sample, as the strains
  double varied_force = 0;          // of each cable at another friction on the hose [N]; 0: no variation
  std::uint32_t varied_sample = 40;
  double curvature = 0;                  // about d1 at sample 20 and, in the other direction, 60; otherwise 0 [1/m]
  double curvature_d2 = 0;               // with curvature about d1, of the first segment alone, at sample 20 [1/m]
  std::vector<Rubbed> rubbed;            // by link_4, 5 mm long, in one sector of 5 degrees; empty: no table
  double last_segment = 0.4;             // its length; the whole dresspack is 0.6 m longer [m]
  std::vector<std::int32_t> dresspacks;  // (segment); empty: one dresspack
};

/// 0, a, -a, 0 at samples 0, 20, 60, 100: one closed cycle of amplitude a.
Site swing(int segment, std::string component, float amplitude, std::string material = "copper") {
  return {segment, std::move(component), std::move(material), {0, amplitude, -amplitude, 0}, {0, 20, 60, 100}};
}

void write_set(FileWriter& file, const std::string& group, const std::vector<Site>& sites, std::uint64_t wrong_offset) {
  std::vector<std::int32_t> segment;
  std::vector<std::string> component, material;
  std::vector<std::uint64_t> offset{0};
  std::vector<float> strain;
  std::vector<std::uint32_t> sample;
  for (const Site& site : sites) {
    segment.push_back(site.segment);
    component.push_back(site.component);
    material.push_back(site.material);
    strain.insert(strain.end(), site.strain.begin(), site.strain.end());
    sample.insert(sample.end(), site.sample.begin(), site.sample.end());
    offset.push_back(strain.size());
  }
  offset.back() += wrong_offset;
  const std::vector<double> helix(sites.size() * 3, 0.5), fibre(sites.size() * 2, 0.25);
  file.append(group + "/site/segment", std::span<const std::int32_t>(segment));
  file.append(group + "/site/component", std::span<const std::string>(component));
  file.append(group + "/site/material", std::span<const std::string>(material));
  file.append(group + "/site/helix", std::span<const double>(helix));
  file.append(group + "/site/fibre", std::span<const double>(fibre));
  file.append(group + "/reversal/offset", std::span<const std::uint64_t>(offset));
  file.append(group + "/reversal/strain", std::span<const float>(strain));
  file.append(group + "/reversal/sample", std::span<const std::uint32_t>(sample));
}

void write_strain(const std::filesystem::path& path, const StrainFile& f) {
  FileWriter file(path, pipeline::strain_format());
  file.set_axis("segment", segments);
  file.set_axis("level", 1);
  file.set_axis("sample", samples);
  std::vector<double> time, probe;
  for (std::size_t t = 0; t < samples; ++t) time.push_back(duration * t / (samples - 1));
  const std::vector<double> lengths{0.1, 0.2, 0.3, f.last_segment};
  const std::vector<std::string> text{"approach", "weld", "retreat"};
  const std::vector<double> rows(samples * segments, 0.0);
  std::vector<double> twists;
  for (std::size_t k = 0; k < rows.size(); ++k)
    twists.push_back(f.twist * static_cast<double>(k / segments) / (samples - 1));
  std::vector<double> pairs(2 * samples * segments, 0.0);
  for (std::size_t k = 0; k < segments; ++k)
    pairs[2 * (20 * segments + k)] = f.curvature, pairs[2 * (60 * segments + k)] = -f.curvature;
  if (f.curvature_d2 > 0) {
    std::fill(pairs.begin(), pairs.end(), 0.0);
    pairs[2 * 20 * segments] = f.curvature, pairs[2 * 20 * segments + 1] = f.curvature_d2;
  }
  file.append("/time", std::span<const double>(time));
  file.append("/program/step", std::span<const std::int32_t>(f.step));
  file.append("/program/text", std::span<const std::string>(text));
  if (!f.joints.empty()) {
    file.set_axis("joint", f.joints.size() / samples);
    file.append("/robot/joint_position", std::span<const double>(f.joints));
  }
  file.append("/segment/length", std::span<const double>(lengths));
  file.append("/segment/wires_at", std::vector<double>{0, 0.2, 0.45, 0.8});  // the first at its clamp
  if (!f.dresspacks.empty()) {
    file.append("/segment/dresspack", std::span<const std::int32_t>(f.dresspacks));
    file.set_axis("dresspack", 2);
    file.append("/dresspack/name", std::vector<std::string>{"", "other"});
  }
  file.append("/deformation/curvature", std::span<const double>(pairs));
  file.append("/deformation/twist", std::span<const double>(twists));
  file.append("/deformation/elongation", std::span<const double>(rows));
  write_set(file, "", f.sites, f.wrong_offset);
  write_set(file, "/bound_stick", f.stick, 0);
  write_set(file, "/bound_free", f.free, 0);
  for (std::size_t p = 0; p < f.probes.size(); ++p) {
    for (std::size_t t = 0; t < samples; ++t) probe.push_back(1000 + double(t));
  }
  file.append("/probe/site", std::span<const std::uint32_t>(f.probes));
  file.append("/probe/strain", std::span<const double>(probe));
  for (double& value : probe) value = (value - 1000) * 1e-5;  // shear: a ramp from 0 to 1e-3
  file.append("/probe/shear", std::span<const double>(probe));
  for (const StrainFile::Fibre& fibre : f.fibres) {
    file.append("/plane/site", std::span<const std::uint32_t>(&fibre.site, 1));
    file.append("/plane/strain", std::span<const float>(fibre.strain));
    file.append("/plane/shear", std::span<const float>(fibre.shear));
  }
  for (const StrainFile::Rubbed& rubbed : f.rubbed) {
    file.append("/rubbing/dresspack", std::vector<std::int32_t>{0});
    file.append("/rubbing/place", std::vector<double>{rubbed.position, 5e-3, 1, std::numbers::pi / 36});
    file.append("/rubbing/obstacle", std::vector<std::string>{"link_4"});
    file.append("/rubbing/work", std::vector<double>{rubbed.work});
    file.append("/rubbing/time", std::vector<double>{rubbed.time});
  }
  for (const StrainFile::Jacket& jacket : f.jackets) {
    file.append("/jacket/cable", std::vector<std::int32_t>{jacket.cable});
    file.append("/jacket/rest", std::vector<std::int32_t>{jacket.rest});
    file.append("/jacket/place", std::vector<double>{jacket.position, 5e-3, 1, std::numbers::pi / 18});
    file.append("/jacket/work", std::vector<double>{jacket.work});
    file.append("/jacket/sample", std::vector<std::uint32_t>{jacket.sample});
  }
  if (!f.rests.empty()) file.append("/start/rest", f.rests);
  if (!f.cables.empty()) {
    file.set_axis("cable", f.cables.size());
    file.set_axis("cable_span", f.hose_moment.size());
    std::vector<double> strains, moments;
    for (std::size_t k = 0; k < f.cables.size(); ++k) {
      file.append("/cable/name", std::vector<std::string>{fmt::format("cable {}", k + 1)});
      file.append("/cable/span", std::vector<std::int32_t>{f.cables[k].span});
      file.append("/cable/dresspack", std::vector<std::int32_t>{f.cables[k].dresspack});
      file.append("/cable/component", std::vector<std::int32_t>{0});
      file.append("/cable/clamp_place", std::span<const double>(f.cables[k].place));
      if (f.room == 0) continue;
      file.append("/cable/room", std::vector<double>{f.room});
      file.append("/cable/path_gain", std::vector<double>{0, 0});
    }
    for (std::size_t t = 0; t < samples; ++t) {
      const double risen = double(t) / (samples - 1);
      for (const StrainFile::Cable& cable : f.cables)
        for (const double strain : cable.strain) strains.push_back(risen * strain);
      for (const double moment : f.hose_moment) moments.push_back(risen * moment);
    }
    file.append("/cable/strain", std::span<const double>(strains));
    file.append("/cable_span/hose_moment", std::span<const double>(moments));
    if (f.varied_force != 0) {
      file.append("/variation/z", std::vector<double>{0, 1.5, 0, 0, 0});
      file.append("/variation/stiffness", std::vector<double>{0});
      for (const char* at_own : {"/variation/inside", "/variation/rest"})
        file.append(at_own, std::vector<std::int32_t>{0});
      file.append("/variation/row/variation", std::vector<std::uint32_t>{0});
      file.append("/variation/row/site", std::vector<std::uint32_t>{0});
      file.append("/variation/row/turning", std::vector<std::uint32_t>{4});
      file.append("/variation/strain", std::vector<float>{0, 0.004f, -0.004f, 0});
      file.append("/variation/tension", std::vector<double>(f.cables.size(), f.varied_force));
      file.append("/variation/tension_sample", std::vector<std::uint32_t>(f.cables.size(), f.varied_sample));
      file.append("/variation/tension_place", std::vector<double>(f.cables.size(), 0.25));
      file.append("/variation/clamp_moment", std::vector<double>(2 * f.hose_moment.size(), 0));
      file.append("/variation/clamp_moment_place", std::vector<std::uint32_t>(2 * f.hose_moment.size(), 0));
      file.append("/variation/clamp_moment_tension", std::vector<double>(f.hose_moment.size(), 0));
    }
  }
  file.attribute("job", "made by a test");
  file.attribute("history", "");
  file.attribute("input_sha256", "");
  file.commit();
}

pipeline::Job test_job() {
  pipeline::Job job;
  job.uncertainty.enabled = false;  // except where a test enables it
  auto cu = copper(), al = aluminium();
  cu.name = "copper";
  al.name = "aluminium";
  job.dresspacks[0].dresspack.materials = {cu, al};
  pipeline::Component cable;
  cable.name = "cable";
  cable.components.resize(2);
  cable.components[0].layer = "layer 1";
  cable.components[1].layer = "layer 2";
  job.dresspacks[0].dresspack.components = {cable};
  job.dresspacks[0].routing.free_length = 1;
  return job;
}

StrainFile example() {
  StrainFile f;
  f.sites = {swing(0, "cable 1/layer 1/wire 1", 0.004f),  swing(0, "cable 1/layer 2/wire 1", 0.005f),
             swing(1, "cable 1/layer 1/wire 1", 0.006f),  swing(2, "cable 2/layer 1/wire 7", 0.01f),
             swing(2, "cable 2/layer 2/wire 12", 0.008f), swing(3, "cable 1/layer 1/wire 1", 0.0f)};
  // The worst site also has an inner cycle: 0.01 -> 0.002 -> 0.008 -> -0.01
  f.sites[3].strain = {0, 0.01f, 0.002f, 0.008f, -0.01f, 0};
  f.sites[3].sample = {0, 20, 30, 40, 60, 100};
  f.stick = {swing(2, "cable 2/layer 1/wire 7", 0.02f)};
  f.free = {swing(2, "cable 2/layer 1/wire 7", 0.001f), swing(2, "cable 2/layer 2/wire 12", 0.002f)};
  for (std::size_t t = 0; t < samples; ++t) f.step[t] = t < 35 ? 0 : t < 80 ? 1 : 2;
  return f;
}

struct Result {
  Notes notes;
  std::filesystem::path file;
};

Result run(const Folder& folder, const StrainFile& f, const pipeline::Job& job = test_job(),
           const std::string& name = "life.h5", std::size_t threads = 1) {
  const auto strain_path = folder.path / "strain.h5", life_path = folder.path / name;
  write_strain(strain_path, f);
  const FileReader strain(strain_path, pipeline::strain_format());
  FileWriter life(life_path, pipeline::life_format());
  Result result{write_life(strain, job, life, threads, [](double) {}), life_path};
  life.attribute("job", "made by a test");
  life.attribute("history", "");
  life.attribute("input_sha256", "");
  life.commit();
  return result;
}

double exact_damage(const Site& site, const pipeline::Job& job) {
  std::vector<Reversal> reversals;
  for (std::size_t i = 0; i < site.strain.size(); ++i) reversals.push_back({site.strain[i], site.sample[i]});
  return sum_of_damage(evaluate_cycles(reversals, pipeline::material_of(job, site.material), job.fatigue));
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::string bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("life.h5: damage of every site, and the worst one's life, place, moment and name") {
  const Folder folder;
  const StrainFile f = example();
  const Result result = run(folder, f);
  const FileReader life(result.file, pipeline::life_format());
  const auto damage = life.read<double>("/damage"), lives = life.read<double>("/life");
  REQUIRE(damage.size() == 6);
  for (std::size_t site = 0; site < 5; ++site) {
    CHECK(damage[site] == Approx(exact_damage(f.sites[site], test_job())).epsilon(DamageCounter::table_error));
    CHECK(lives[site] == 1 / damage[site]);
  }
  CHECK(damage[5] == 0);
  CHECK(lives[5] == std::numeric_limits<double>::infinity());
  CHECK(life.read<std::string>("/site/component")[4] == "cable 2/layer 2/wire 12");
  CHECK(life.read<std::string>("/site/material") == std::vector<std::string>(6, "copper"));
  CHECK(life.read<double>("/site/helix") == std::vector<double>(18, 0.5));

  CHECK(life.number_attribute("worst_site") == 3);
  CHECK(life.number_attribute("damage_per_repeat") == damage[3]);
  CHECK(life.number_attribute("life_repeats") == 1 / damage[3]);
  CHECK(life.number_attribute("repeat_seconds") == duration);
  CHECK(life.number_attribute("life_hours") == Approx(duration / 3600 / damage[3]));
  CHECK(life.number_attribute("life_months") == Approx(duration / 3600 / damage[3] / 80 / (365.2425 / 12 / 7)));
  CHECK(life.number_attribute("worst_segment_from_tool") == 2);
  CHECK(life.number_attribute("worst_position_from_tool") == Approx(0.4 + 0.3 / 2));
  CHECK(life.text_attribute("worst_component") == "cable 2/layer 1/wire 7");
  CHECK(life.number_attribute("worst_time") == Approx(30));  // the large cycle ends at sample 60
  CHECK(life.text_attribute("worst_step") == "weld");
  CHECK_THAT(result.notes.summary, Catch::Contains("until cable 2/layer 1/wire 7 breaks, 0.55 m from the tool, worst "
                                                   "during 'weld'"));
  CHECK(result.notes.warnings.empty());
}

TEST_CASE("life.h5: cycles, time, steps, segments and layers add up") {
  const Folder folder;
  const Result result = run(folder, example());
  const FileReader life(result.file, pipeline::life_format());
  const auto damage = life.read<double>("/damage");

  const auto site = life.read<std::uint32_t>("/cycles/site");
  const auto cycle_damage = life.read<double>("/cycles/damage");
  CHECK(site == std::vector<std::uint32_t>{3, 3, 4, 2, 1, 0});  // worst first; the undamaged site is not listed
  CHECK(cycle_damage[0] + cycle_damage[1] == Approx(damage[3]).epsilon(same_sum));
  CHECK(life.read<std::uint32_t>("/cycles/begin")[0] == 30);
  CHECK(life.read<std::uint32_t>("/cycles/end")[0] == 40);
  CHECK(life.read<double>("/cycles/range")[0] == Approx(0.006));
  CHECK(life.read<double>("/cycles/mean")[0] == Approx(0.005));

  CHECK(life.read<std::uint32_t>("/segment/worst_site") == std::vector<std::uint32_t>{1, 2, 3, 5});
  const auto segment_damage = life.read<double>("/segment/damage");
  for (std::size_t segment = 0; segment < segments; ++segment) {
    std::vector<double> rate;
    life.read_rows("/damage_rate", segment, 1, rate);
    REQUIRE(rate.size() == samples);
    CHECK(sum(rate) == Approx(segment_damage[segment]).epsilon(same_sum));
    life.read_rows("/damage_rate_opened", segment, 1, rate);
    CHECK(sum(rate) == Approx(segment_damage[segment]).epsilon(same_sum));
  }
  const auto by_step = life.read<double>("/program/damage");
  CHECK(by_step == std::vector<double>{0, sum(by_step), 0});  // both cycles end during the second line
  CHECK(sum(by_step) == Approx(damage[3]).epsilon(same_sum));
  // The inner cycle 0.002-0.008 opens at sample 30, the large one at 20 or, because the repeat is cyclic, 60.
  const auto opened = life.read<double>("/program/damage_opened");
  CHECK(sum(opened) == Approx(damage[3]).epsilon(same_sum));
  CHECK(opened[0] == Approx(cycle_damage[0] + cycle_damage[1]).epsilon(same_sum));

  CHECK(life.read<std::string>("/layer/component") ==
        std::vector<std::string>{"cable/layer 1/wire", "cable/layer 2/wire"});
  CHECK(life.read<std::uint32_t>("/layer/worst_site") == std::vector<std::uint32_t>{3, 4});
  CHECK(life.read<double>("/layer/damage") == std::vector<double>{damage[3], damage[4]});
}

TEST_CASE("life.h5: forces of the cables by span, and the span where they ask most of the hose") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.materials[0].tensile_strength = 230e6;
  dresspack.components[0].radius = 5e-3;
  dresspack.components[0].components.resize(1);
  pipeline::Component& wires = dresspack.components[0].components[0];
  wires.name = "wire", wires.material = "copper", wires.count = 100, wires.radius = 7.5e-5;
  job.dresspacks[0].routing.clamps.resize(1);
  const pipeline::CableForce force(dresspack, dresspack.components[0]);
  StrainFile f = example();
  f.cables = {{1, {0.01, 0, 0, 0.01}, {1e-4, 8e-5, -5e-5}},
              {0, {0.02, 0, 0.01, 0}, {-3e-4, -1e-4, -3e-4}},
              {1, {0, -0.015, 0.003, 0.004}, {2e-4, 2e-4, 1e-4}}};
  for (const double of_first : {1.0, 0.01}) {
    f.hose_moment = {of_first, 0.1};
    const Result result = run(folder, f, job);
    const FileReader life(result.file, pipeline::life_format());
    const auto tension = life.read<double>("/cable/tension");
    REQUIRE(tension.size() == 3 * samples);
    for (const std::size_t t : {std::size_t{0}, std::size_t{40}, samples - 1})
      for (std::size_t k = 0; k < 3; ++k)
        CHECK(tension[3 * t + k] == Approx(force.force(f.cables[k].strain[0] * double(t) / (samples - 1))));
    // The first span: one cable, with the larger moment at the lever of the base clamp or of the tool clamp.
    const double first = std::max(0.02 * std::abs(force.force(-1e-4)), 0.01 * std::abs(force.force(-3e-4)));
    const double base = std::hypot(0.01 * force.force(8e-5), 0.015 * force.force(2e-4)),
                 tool = std::hypot(0.01 * force.force(-5e-5) + 0.004 * force.force(1e-4), 0.003 * force.force(1e-4));
    const double second = std::max(base, tool);
    const bool in_first = first / of_first > second / 0.1;
    CHECK(in_first == (of_first < 1));  // the test covers both cases
    CHECK(life.number_attribute("clamp_moment_share") == Approx(in_first ? first / of_first : second / 0.1));
    CHECK(life.read<double>("/clamp/cable_moment").back() == Approx(in_first ? first : second));
    CHECK(life.read<double>("/clamp/hose_moment")[50] == Approx((in_first ? of_first : 0.1) / 2));
    CHECK(life.number_attribute("largest_force_share") == Approx(std::abs(force.force(-3e-4)) / force.strength()));
    // Of 10 mm. The largest force acts only at the third cable's base clamp.
    CHECK(life.number_attribute("strain_relief_share") == Approx(force.force(2e-4) / 42));
    const auto warns = [&](const std::string& words) {
      return std::any_of(
          result.notes.warnings.begin(), result.notes.warnings.end(),
          [&](const pipeline::Warning& warning) { return warning.line().find(words) != std::string::npos; });
    };
    CHECK_FALSE(warns("of its breaking force"));
    for (const char* words : {in_first ? "'cable 2' presses most" : "'cable 3' pulls most",
                              in_first ? "the cables between the base clamp and clamp 1 bend a clamp with"
                                       : "the cables between clamp 1 and the tool clamp bend a clamp with"})
      CHECK(warns(words) == (life.number_attribute("clamp_moment_share") > pipeline::believable_share));
  }
  f.cables[1].strain = {-1.2e-3, -4e-4, -1.2e-3};
  CHECK(force.force(-1.2e-3) < -pipeline::believable_share * force.strength());
  CHECK(std::ranges::any_of(run(folder, f, job).notes.warnings, [](const pipeline::Warning& warning) {
    return warning.line().find("'cable 2' is compressed between the base clamp and clamp 1 with") != std::string::npos;
  }));
  {  // in a second dresspack, whose first span is the third of the file
    pipeline::Job two = job;
    two.dresspacks.push_back(job.dresspacks[0]);
    two.dresspacks[1].name = "other";
    two.dresspacks[0].routing.free_length = 0.6, two.dresspacks[1].routing.free_length = 0.4;
    StrainFile third = f;
    third.dresspacks = {0, 0, 0, 1};
    third.cables[2].span = 2, third.cables[2].dresspack = 1, third.hose_moment.push_back(1);
    std::swap(third.cables[1].strain, third.cables[2].strain);
    CHECK(std::ranges::any_of(run(folder, third, two).notes.warnings, [](const pipeline::Warning& warning) {
      return warning.line().find("'cable 3' is compressed between the base clamp and clamp 1 with") !=
             std::string::npos;
    }));
  }
  const auto of_others = [&] {
    std::string words;
    for (const pipeline::Warning& warning : run(folder, f, job).notes.warnings)
      if (warning.kind == pipeline::WarningKind::other_values) words += warning.line();
    return words;
  };
  for (StrainFile::Cable& cable : f.cables) cable.strain = {};
  job.uncertainty.enabled = true;
  f.varied_force = 0.9 * pipeline::believable_share * force.strength();
  CHECK(of_others() == "");
  f.varied_force = 0.5 * force.strength();
  CHECK_THAT(
      of_others(),
      Catch::Contains("with 2.8 times the friction of the cables on their hose (strain.hose_friction_factor: 2.83) "
                      "'cable 1' is pulled with 50 % of its breaking force") &&
          Catch::Contains(", 0.25 m from the base clamp, "));
  f.varied_sample = samples;
  CHECK_THROWS_WITH(of_others(), Catch::Contains("/variation/tension_sample or clamp_moment_place of variation 1"));
  f.varied_sample = 40, f.cables[1].span = 2;
  CHECK_THROWS_AS(run(folder, f, job), pipeline::InputError);
}

TEST_CASE("life.h5: the bounds are the lives of their own sites") {
  const Folder folder;
  const StrainFile f = example();
  pipeline::Job mixed = test_job();
  mixed.strain.slip = {pipeline::Slip::stick, pipeline::Slip::free};
  const Result result = run(folder, f, mixed);
  const FileReader life(result.file, pipeline::life_format());
  const double stick = 1 / exact_damage(f.stick[0], test_job()), free = 1 / exact_damage(f.free[1], test_job());
  CHECK(life.number_attribute("life_repeats_all_stick") == Approx(stick).epsilon(DamageCounter::table_error));
  CHECK(life.number_attribute("life_repeats_all_free") == Approx(free).epsilon(DamageCounter::table_error));
  CHECK(life.number_attribute("life_hours_all_free") ==
        Approx(free * duration / 3600).epsilon(DamageCounter::table_error));
}

// A bound must use the relaxation of its own worst wire. The worst wire of another layer has a different relaxation. Selection
// by segment alone gave a free bound that was 4.6 % too long.
TEST_CASE("life.h5: mean stress relaxes in a bound as it does in the job") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.strain.slip = {pipeline::Slip::stick, pipeline::Slip::free};
  job.dresspacks[0].dresspack.materials[0].relaxation_threshold_strain = 2.8e-4;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> part(0, 1);
  for (int trial = 0; trial < 60; ++trial) {
    StrainFile f = example();
    f.sites.clear();
    for (const char* layer : {"layer 1", "layer 2"})
      for (int wire = 1; wire <= 3; ++wire) {
        // One large loop with smaller loops within it, about a mean. Relaxation of the large loop shifts the mean stress of the
        // others.
        Site& site = f.sites.emplace_back(swing(1, fmt::format("cable 1/{}/wire {}", layer, wire), 0));
        const float mean = 0.004f * (part(random) - 0.5f), large = 0.001f + 2e-4f * part(random);
        site.strain = {mean}, site.sample = {0};
        for (std::uint32_t turn = 1; turn < 20; ++turn) {
          const float size = turn < 3 ? large : large * part(random);
          site.strain.push_back(mean + (turn % 2 == 1 ? size : -size));
          site.sample.push_back(5 * turn);
        }
      }
    f.stick = f.free = f.sites;
    const FileReader life(run(folder, f, job).file, pipeline::life_format());
    INFO(trial);
    // Loops with a compressive mean stress shorten the glued bound (F38).
    CHECK(life.number_attribute("life_repeats_all_stick") <= life.number_attribute("life_repeats"));
    CHECK(life.number_attribute("life_repeats_all_free") == life.number_attribute("life_repeats"));
  }
}

// Slip removes the mean stress of glued wires, so the lower bound contains no longer life by compression (F38).
TEST_CASE("life.h5: compression lengthens the life of a glued job, but not the bound of a job with friction") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.uncertainty.enabled = true;
  StrainFile f = example();
  const auto wire = [](float middle) {
    Site site = swing(1, "cable 1/layer 1/wire 1", 0.002f);
    for (float& strain : site.strain) strain += middle;
    return site;
  };
  const auto lives = [&](float middle, pipeline::Slip inside) {
    f.sites = f.stick = f.free = {wire(middle)};
    job.strain.slip = {inside};
    const FileReader life(run(folder, f, job).file, pipeline::life_format());
    return std::array{life.number_attribute("life_repeats_all_stick"), life.number_attribute("life_repeats"),
                      life.number_attribute("life_repeats_all_free")};
  };
  const auto centred = lives(0, pipeline::Slip::friction), compressed = lives(-0.004f, pipeline::Slip::friction),
             pulled = lives(0.004f, pipeline::Slip::friction), glued = lives(-0.004f, pipeline::Slip::stick);
  CHECK(compressed[0] == Approx(centred[1]).epsilon(DamageCounter::table_error));
  CHECK(compressed[1] > 1.5 * centred[1]);
  CHECK(compressed[2] == compressed[1]);
  CHECK(pulled[0] == Approx(pulled[1]).epsilon(DamageCounter::table_error));
  CHECK(glued[0] == compressed[1]);
  CHECK(glued[1] == compressed[1]);
}

TEST_CASE("life.h5: a job that slips as a bound does is that bound, with all its wires") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.strain.slip = {pipeline::Slip::free};
  const Result slipping = run(folder, example(), job);
  const FileReader free(slipping.file, pipeline::life_format());
  CHECK(free.number_attribute("life_repeats_all_free") == free.number_attribute("life_repeats"));
  CHECK(free.number_attribute("life_repeats_all_stick") != free.number_attribute("life_repeats"));
  job.strain.slip = {pipeline::Slip::stick};
  const Result glued = run(folder, example(), job, "glued.h5");
  const FileReader stick(glued.file, pipeline::life_format());
  CHECK(stick.number_attribute("life_repeats_all_stick") == stick.number_attribute("life_repeats"));
}

TEST_CASE("life.h5: percentiles of the first wire and of the conductors") {
  const Folder folder;
  pipeline::Job job = test_job();
  const Result result = run(folder, example(), job);
  const FileReader life(result.file, pipeline::life_format());
  const auto damage = life.read<double>("/damage");
  CHECK(life.read<std::string>("/conductor/component") == std::vector<std::string>{"cable 1", "cable 2"});
  CHECK(life.read<std::uint32_t>("/conductor/wires") == std::vector<std::uint32_t>{2, 2});
  CHECK(life.read<std::uint32_t>("/conductor/worst_site") == std::vector<std::uint32_t>{2, 3});
  // Four wires, each represented by its worst segment.
  const std::vector<double> wires{damage[2], damage[1], damage[3], damage[4]};
  const double half = life_until(wires, 1, {job.fatigue.scatter_log10, job.fatigue.scatter_shared}, 0.5);
  CHECK(life.number_attribute("first_wire_life_hours_p50") == Approx(hours(half, duration)).epsilon(same_sum));
  CHECK(half < life.number_attribute("life_repeats"));
  const auto lives = life.read<double>("/conductor/life");
  REQUIRE(lives.size() == 2 * 9);
  CHECK(lives[9 + 6 + 2] ==
        life_until(std::vector{damage[3], damage[4]}, 2, {job.fatigue.scatter_log10, job.fatigue.scatter_shared}, 0.9));

  job.fatigue.scatter_log10 = 0;
  const Result exact = run(folder, example(), job, "exact.h5");
  const FileReader sharp(exact.file, pipeline::life_format());
  for (const char* end : {"p10", "p50", "p90"}) {
    CHECK(sharp.number_attribute(fmt::format("first_wire_life_hours_{}", end)) == sharp.number_attribute("life_hours"));
    // Two wires in a conductor: 10 % are one wire, so a break at one place is a break anywhere.
    CHECK(sharp.number_attribute(fmt::format("life_hours_{}", end)) == Approx(sharp.number_attribute("life_hours")));
  }
  CHECK(sharp.text_attribute("failing_conductor") == "cable 2");
  CHECK(sharp.number_attribute("failing_position_from_tool") == sharp.number_attribute("worst_position_from_tool"));
  CHECK(sharp.number_attribute("life_months_p10") == Approx(sharp.number_attribute("life_months")));
  job.fatigue.load_sharing = true;
  const Result shared = run(folder, example(), job, "shared.h5");
  const auto together = FileReader(shared.file, pipeline::life_format()).read<double>("/conductor/life");
  const auto alone = sharp.read<double>("/conductor/life");
  CHECK(together[9] == Approx(alone[9]).epsilon(same_sum));  // the first wire breaks at the same time
  CHECK(together[9 + 6] < alone[9 + 6]);                     // the last one breaks sooner
  CHECK(together[9 + 6] > alone[9]);
}

TEST_CASE("life.h5: the worst strain is its probe, or straight between its reversals") {
  const Folder folder;
  StrainFile f = example();
  f.probes = {1, 3};
  const Result probed = run(folder, f);
  const auto history = FileReader(probed.file, pipeline::life_format()).read<double>("/worst/strain");
  CHECK((history[0] == 1000 && history[100] == 1100));
  f.probes = {1};
  const Result bare = run(folder, f, test_job(), "bare.h5");
  const auto straight = FileReader(bare.file, pipeline::life_format()).read<double>("/worst/strain");
  REQUIRE(straight.size() == samples);
  CHECK(straight[10] == Approx(0.005));
  CHECK(straight[50] == Approx(-0.001));
  CHECK(straight[100] == 0);
}

TEST_CASE("life.h5: materials are each site's own, or the one that the job sets for all") {
  const Folder folder;
  StrainFile f = example();
  f.sites[4].material = "aluminium";
  const Result own = run(folder, f);
  const auto damage = FileReader(own.file, pipeline::life_format()).read<double>("/damage");
  CHECK(damage[4] == Approx(exact_damage(f.sites[4], test_job())).epsilon(DamageCounter::table_error));
  pipeline::Job job = test_job();
  job.fatigue.material = "aluminium";
  const Result all = run(folder, f, job, "all.h5");
  const auto aluminium_damage = FileReader(all.file, pipeline::life_format()).read<double>("/damage");
  CHECK(aluminium_damage[4] == damage[4]);
  CHECK(aluminium_damage[3] > damage[3]);
}

TEST_CASE("life.h5: no damage, no sites, and strains that no wire survives") {
  const Folder folder;
  StrainFile still = example();
  for (Site& site : still.sites) site.strain = {1e-6f, 2e-6f}, site.sample = {0, 100};
  still.sites[2].strain = {1e-6f, 3e-6f};
  const Result harmless = run(folder, still);
  const FileReader calm(harmless.file, pipeline::life_format());
  CHECK(calm.number_attribute("life_hours") == std::numeric_limits<double>::infinity());
  CHECK(calm.number_attribute("worst_site") == 2);  // the largest range
  CHECK(calm.rows("/cycles/site") == 0);
  CHECK(harmless.notes.summary == "no wire is damaged");

  const Result empty = run(folder, StrainFile{}, test_job(), "empty.h5");
  const FileReader none(empty.file, pipeline::life_format());
  CHECK(none.number_attribute("worst_segment_from_tool") == 0);
  CHECK(none.rows("/damage") == 0);
  CHECK(empty.notes.summary == "no wire was evaluated");

  StrainFile calm_site = example();  // nothing reverses; the first site ranks worst, without a turning point
  for (Site& site : calm_site.sites) site.strain = {}, site.sample = {};
  calm_site.probes = {};
  const Result unmoved = run(folder, calm_site, test_job(), "unmoved.h5");
  const FileReader rest(unmoved.file, pipeline::life_format());
  CHECK(rest.number_attribute("worst_site") == 0);
  CHECK(rest.number_attribute("life_hours") == std::numeric_limits<double>::infinity());
  CHECK(rest.read<double>("/worst/strain") == std::vector<double>(samples, 0.0));

  StrainFile absurd = example();
  absurd.sites[0] = swing(0, "cable 1/layer 1/wire 1", 40);
  const Result torn = run(folder, absurd, test_job(), "torn.h5");
  CHECK(FileReader(torn.file, pipeline::life_format()).number_attribute("life_repeats") == 0.5);
  REQUIRE(torn.notes.warnings.size() == 1);
  CHECK_THAT(torn.notes.warnings[0].words,
             Catch::Contains("1 of the cycles of cable 1/layer 1/wire 1 tear it on their first reversal") &&
                 Catch::Contains("in segment 4 from the tool"));

  pipeline::Job two = test_job();  // the first dresspack has three of the four segments
  two.dresspacks.push_back(two.dresspacks[0]);
  two.dresspacks[1].name = "other";
  two.dresspacks[0].routing.free_length = 0.6, two.dresspacks[1].routing.free_length = 0.4;
  absurd.dresspacks = {0, 0, 0, 1};
  const Result first = run(folder, absurd, two, "first.h5");
  REQUIRE(first.notes.warnings.size() == 1);
  CHECK_THAT(first.notes.warnings[0].words, Catch::Contains("in segment 3 from the tool"));
}

TEST_CASE("life.h5: a material whose cyclic curve contradicts its life curve is warned of") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.dresspacks[0].dresspack.materials[0].cyclic_strength = 100e6;
  const Result cyclic = run(folder, example(), job);
  REQUIRE(cyclic.notes.warnings.size() == 1);
  CHECK_THAT(cyclic.notes.warnings[0].words, Catch::Contains("material copper: K' 100 MPa"));
  job.fatigue.stress = pipeline::Stress::elastic;  // then they are not used
  CHECK(run(folder, example(), job).notes.warnings.empty());
}

TEST_CASE("life.h5: a job beyond the curvature or twist of its calibration's tests is warned of") {
  const Folder folder;
  StrainFile f = example();
  f.curvature = 3, f.curvature_d2 = 4, f.twist = -2;  // 5/m in one segment only
  pipeline::Job job = test_job();
  const auto doubted = [&](double curvature, double twist) {
    job.calibration.emplace();
    job.calibration->within.largest_curvature = curvature, job.calibration->within.largest_twist = twist;
    std::string words;
    for (const pipeline::Warning& warning : run(folder, f, job).notes.warnings)
      if (warning.kind == pipeline::WarningKind::calibration) words += warning.words + "\n";
    return words;
  };
  CHECK(doubted(5 / 1.04, 2 / 1.04).empty());
  CHECK_THAT(doubted(5 / 1.06, 2 / 1.04), Catch::Contains("a curvature [1/m] of 5.0 "));
  CHECK_THAT(doubted(5 / 1.04, 2 / 1.06), Catch::Contains("a twist [rad/m] of 2.0 "));
  job.calibration.emplace().own_spread = 0.2;
  const std::vector<pipeline::Warning> foreign = run(folder, f, job).notes.warnings;
  REQUIRE(foreign.size() == 1);
  CHECK_THAT(foreign[0].words, Catch::Contains("no dresspack with the motion and routing of this job"));
  job.calibration->residual_spread = 0.2;  // the records have this job
  CHECK(run(folder, f, job).notes.warnings.empty());
}

TEST_CASE("life.h5: the damage is divided among the joints and reported by clamp") {
  const Folder folder;
  pipeline::Job job = test_job();
  for (int k = 0; k < 3; ++k)
    job.robot.joints.push_back({"axis " + std::to_string(k + 1), {}, {}, {}, 0, 0, 0, 0, {}, 1, 0, {}, {}});
  for (int k = 0; k < 4; ++k) job.robot.links.push_back({"link " + std::to_string(k), {}, {}, {}});
  job.dresspacks[0].routing.base_clamp.emplace().link = "link 1";
  job.dresspacks[0].routing.tool_clamp.emplace().link = "link 3";
  StrainFile f = example();
  f.probes = {3};
  for (std::size_t t = 0; t < samples; ++t) {
    // The probe's strain is 1000 + sample. It consists only of the contributions of axes 2 and 3, 3 to 1 over the motion.
    const double s = double(t);
    f.joints.insert(f.joints.end(), {std::sin(s), 0.02 * s + 0.1 * std::sin(0.3 * s), 0.1 * std::sin(0.3 * s)});
  }
  const Result result = run(folder, f, job);
  const FileReader life(result.file, pipeline::life_format());
  CHECK(life.read<std::string>("/joint/name") == std::vector<std::string>{"axis 1", "axis 2", "axis 3", "carrying"});
  const auto damage = life.read<double>("/joint/damage"), by_line = life.read<double>("/program/joint_damage"),
             line = life.read<double>("/program/damage");
  REQUIRE(damage.size() == 4);
  CHECK(damage[0] == 0);  // the joint lies below the base clamp
  CHECK(sum(damage) == Approx(life.number_attribute("damage_per_repeat")).epsilon(same_sum));
  REQUIRE(by_line.size() == 12);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(by_line[4 * k] + by_line[4 * k + 1] + by_line[4 * k + 2] + by_line[4 * k + 3] ==
          Approx(line[k]).epsilon(same_sum));
  constexpr double ridge_pull = 1e-4;
  CHECK(life.number_attribute("joint_explained") == Approx(1).epsilon(ridge_pull));
  CHECK(life.text_attribute("worst_joint") != "");
  const auto segment = life.read<double>("/segment/damage"), clamp = life.read<double>("/clamp/damage");
  CHECK(life.read<std::string>("/clamp/name") == std::vector<std::string>{"base clamp", "tool clamp"});
  CHECK(clamp == std::vector<double>{segment[0] + segment[1] + segment[2], segment[3]});

  job.dresspacks[0].routing.clamps.resize(1);
  job.dresspacks[0].routing.clamps[0].clamp.link = "link 2";
  const auto lengths = life.read<double>("/segment/length");
  job.dresspacks[0].routing.clamps[0].at_length = lengths[0] + lengths[1];
  const Result between = run(folder, f, job, "between.h5");
  const FileReader three(between.file, pipeline::life_format());
  CHECK(three.read<std::string>("/clamp/name") ==
        std::vector<std::string>{"base clamp", "clamp 1 on link 2", "tool clamp"});
  CHECK(sum(three.read<double>("/clamp/damage")) == Approx(sum(segment)).epsilon(same_sum));
  CHECK(three.read<double>("/clamp/damage")[1] > 0);

  // Without joints in the file only the clamps have damage.
  f.joints.clear();
  const Result bare = run(folder, f, job, "bare.h5");
  const FileReader without(bare.file, pipeline::life_format());
  CHECK_FALSE(without.has("/joint/name"));
  CHECK_FALSE(without.has_attribute("worst_joint"));
  CHECK(without.has("/clamp/damage"));
}

TEST_CASE("life.h5: critical planes of the likely worst wires stand for the equivalent strain") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.dresspacks[0].dresspack.materials[0].poisson_ratio = 0.34;
  StrainFile f = example();
  f.sites[4].segment = 2;
  f.sites[4].component = "cable 2/layer 1/wire 12";  // same segment and layer as site 3
  const auto wave = [](float amplitude, double phase) {
    std::vector<float> values;
    for (std::size_t t = 0; t < samples; ++t)
      values.push_back(amplitude * static_cast<float>(std::sin(2 * M_PI * double(t) / (samples - 1) + phase)));
    return values;
  };
  const Result plain = run(folder, f, job, "plain.h5");
  // Site 0: strain and shear in proportion, 2 theta = 60 deg. Site 3: strain only.
  const float eps = 0.004f, gamma = static_cast<float>(std::sqrt(3) * 1.34 * eps);
  f.fibres = {{0, wave(eps, 0), wave(gamma, 0)}, {3, wave(0.02f, 0), wave(0, 0)}};
  const Result result = run(folder, f, job);
  const FileReader life(result.file, pipeline::life_format()), before(plain.file, pipeline::life_format());
  const auto damage = life.read<double>("/damage"), old = before.read<double>("/damage");
  const auto exact = [&](double amplitude) {
    return sum_of_damage(evaluate_cycles({{{0, 0}, {amplitude, 25}, {-amplitude, 75}, {0, 100}}},
                                         job.dresspacks[0].dresspack.materials[0], job.fatigue));
  };
  constexpr double single = 1e-5;  // histories in single precision; 101 samples include the peaks
  CHECK(damage[0] == Approx(exact(eps * ((1 - 0.34) / 2 + 1.34))).epsilon(DamageCounter::table_error + single));
  CHECK(damage[3] == Approx(exact(0.02)).epsilon(DamageCounter::table_error + single));
  CHECK(life.read<std::uint32_t>("/plane/site") == std::vector<std::uint32_t>{0, 3});
  constexpr double rounding = 1e-9;
  CHECK(life.read<double>("/plane/angle")[0] == Approx(M_PI / 6).epsilon(rounding));
  CHECK(life.read<double>("/plane/angle")[1] == Approx(0).margin(1e-15));
  CHECK(life.read<double>("/plane/damage") == std::vector<double>{damage[0], damage[3]});
  // A wire beside an evaluated one is multiplied by the same ratio. Wires of other segments and layers do not change.
  CHECK(damage[4] == Approx(old[4] * damage[3] / old[3]).epsilon(same_sum));
  CHECK(damage[1] == old[1]);
  CHECK(damage[2] == old[2]);
  // The result, its cycles and its strain are those of the plane.
  CHECK(life.number_attribute("worst_site") == 3);
  CHECK(life.number_attribute("worst_plane_angle") == Approx(0).margin(1e-15));
  CHECK(life.number_attribute("life_repeats") == 1 / damage[3]);
  const auto cycle_site = life.read<std::uint32_t>("/cycles/site");
  const auto cycle_damage = life.read<double>("/cycles/damage");
  for (const std::size_t site : {3, 4}) {
    double listed = 0;
    for (std::size_t k = 0; k < cycle_site.size(); ++k) listed += cycle_site[k] == site ? cycle_damage[k] : 0;
    CHECK(listed > 0);
    CHECK(listed == Approx(damage[site]).epsilon(same_sum));
  }
  CHECK(life.read<double>("/worst/strain")[25] == Approx(0.02));
  CHECK_FALSE(before.has("/plane/site"));
  // An evaluated wire with smaller damage must not hide a worse wire beside it.
  const StrainFile first = f;
  f.fibres[1] = {4, wave(0.001f, 0), wave(0, 0)};
  const Result lesser = run(folder, f, job, "lesser.h5");
  const auto less = FileReader(lesser.file, pipeline::life_format()).read<double>("/damage");
  CHECK(less[3] == Approx(old[3] * less[4] / old[4]).epsilon(same_sum));
  CHECK(less[3] > less[4]);
  f = first;
  // The file has the same bytes with any number of threads.
  const auto alone = bytes(run(folder, f, job, "one.h5").file), shared = bytes(run(folder, f, job, "three.h5", 3).file);
  const bool same = alone == shared;
  CHECK(same);
  f.fibres[1].site = 77;
  CHECK_THROWS_WITH(run(folder, f, job), Catch::Contains("/plane/site names site 77 (there are 6)"));
}

TEST_CASE("life.h5: out of phase shear opens no plane further than the strain alone") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.dresspacks[0].dresspack.materials[0].poisson_ratio = 0.34;
  StrainFile f = example();
  StrainFile::Fibre fibre{3, {}, {}};
  for (std::size_t t = 0; t < samples; ++t) {
    const double turn = 2 * M_PI * double(t) / (samples - 1);
    fibre.strain.push_back(static_cast<float>(0.02 * std::sin(turn)));
    fibre.shear.push_back(static_cast<float>(0.02 * 1.34 * std::cos(turn)));
  }
  f.fibres = {fibre};
  const Result shifted = run(folder, f, job);
  f.fibres[0].shear.assign(samples, 0);
  const Result alone = run(folder, f, job, "alone.h5");
  constexpr double single = 1e-5;
  CHECK(FileReader(shifted.file, pipeline::life_format()).number_attribute("life_repeats") ==
        Approx(FileReader(alone.file, pipeline::life_format()).number_attribute("life_repeats")).epsilon(single));
}

TEST_CASE("life.h5: the shear of the worst wire is reported from its probe") {
  const Folder folder;
  StrainFile f = example();
  const FileReader none(run(folder, f).file, pipeline::life_format());
  CHECK_FALSE(none.has_attribute("worst_shear_range"));
  f.probes = {3};
  const FileReader told(run(folder, f, test_job(), "told.h5").file, pipeline::life_format());
  CHECK(told.number_attribute("worst_shear_range") == Approx(1e-3));
}

TEST_CASE("life.h5: the hose's wall is reported beside the wires and not among them") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Material hose;
  hose.name = "polyamide";
  hose.youngs_modulus = 1.6e9;
  hose.strain_life_table = {{0.1, 1e3}, {0.01, 1e6}};
  job.dresspacks[0].dresspack.materials.push_back(hose);
  job.dresspacks[0].dresspack.hose_material = "polyamide";
  StrainFile f = example();
  const Result without = run(folder, f, job, "without.h5");
  f.sites.push_back(swing(3, "hose 1", 0.03f, "polyamide"));
  f.sites.push_back(swing(1, "hose 16", 0.06f, "polyamide"));
  f.stick.push_back(swing(1, "hose 16", 0.06f, "polyamide"));
  f.free.push_back(swing(1, "hose 16", 0.06f, "polyamide"));
  const Result result = run(folder, f, job);
  const FileReader life(result.file, pipeline::life_format()), wires(without.file, pipeline::life_format());
  // a cycle of amplitude 0.06: log-log between the two points, exponent -3
  CHECK(life.number_attribute("hose_life_repeats") ==
        Approx(1e3 * std::pow(0.06f / 0.1, -3)).epsilon(DamageCounter::table_error));
  CHECK(life.number_attribute("hose_life_hours") ==
        Approx(hours(life.number_attribute("hose_life_repeats"), duration)));
  CHECK(life.text_attribute("hose_component") == "hose 16");
  CHECK(life.number_attribute("hose_segment_from_tool") == 3);
  CHECK(life.number_attribute("hose_position_from_tool") == Approx(0.4 + 0.3 + 0.1));
  CHECK(life.number_attribute("hose_time") == Approx(30));
  CHECK(life.text_attribute("hose_step") == "weld");
  CHECK(life.read<std::uint32_t>("/hose/worst_site") == std::vector<std::uint32_t>{0xffffffff, 7, 0xffffffff, 6});
  CHECK(life.read<double>("/hose/damage")[1] == life.read<double>("/damage")[7]);
  CHECK_THAT(result.notes.summary,
             Catch::Contains("breaks") &&
                 Catch::EndsWith(
                     "the life of the hose's wall is not predicted"));  // 64 h from a life curve that is not credible
  // Strains are kept to 7 decimals above the least of their pack. Other sites change this least value. The error is multiplied
  // by the slope of the life.
  constexpr double packed = 1e-5;
  // Results for wires do not depend on the wall, although the wall's life is shorter.
  CHECK_FALSE(wires.has_attribute("hose_life_hours"));
  CHECK(life.number_attribute("hose_life_hours") < life.number_attribute("life_hours"));
  for (const char* name : {"life_hours", "life_hours_all_stick", "life_hours_all_free", "worst_site", "life_hours_p10",
                           "life_hours_p90", "conductor_life_hours_p50"})
    CHECK(life.number_attribute(name) == Approx(wires.number_attribute(name)).epsilon(packed));
  for (const char* dataset : {"/layer/component", "/conductor/component"})
    CHECK(life.read<std::string>(dataset) == wires.read<std::string>(dataset));
  for (const char* dataset : {"/segment/worst_site", "/cycles/site"})
    CHECK(life.read<std::uint32_t>(dataset) == wires.read<std::uint32_t>(dataset));
  // A material for all wires does not apply to the hose.
  job.fatigue.material = "aluminium";
  const Result other = run(folder, f, job, "other.h5");
  const FileReader changed(other.file, pipeline::life_format());
  CHECK(changed.number_attribute("hose_life_hours") == life.number_attribute("hose_life_hours"));
  CHECK(changed.number_attribute("life_hours") != life.number_attribute("life_hours"));
}

TEST_CASE("life.h5: the same input gives the same bytes") {
  const Folder folder;
  const auto once = bytes(run(folder, example(), test_job(), "once.h5").file);
  CHECK(once.size() > 10000);
  const auto again = bytes(run(folder, example(), test_job(), "again.h5").file);
  const bool same = once == again;  // not compared inside CHECK, which would print both
  CHECK(same);
  pipeline::Job relaxing = test_job();  // each layer of a segment has its own relaxation (F24)
  relaxing.dresspacks[0].dresspack.materials[0].relaxation_threshold_strain = 2.8e-4;
  const auto relaxed = bytes(run(folder, example(), relaxing, "relaxed.h5").file);
  for (const std::size_t threads : {2, 3, 8}) {  // also more threads than sites
    const auto shared = bytes(run(folder, example(), test_job(), "shared.h5", threads).file);
    const auto shared_relaxed = bytes(run(folder, example(), relaxing, "shared_relaxed.h5", threads).file);
    const bool also = once == shared && relaxed == shared_relaxed;
    CHECK(also);
  }
}

TEST_CASE("life.h5: strain files that contradict themselves are refused, and nothing is left behind") {
  const Folder folder;
  const auto refused = [&](const StrainFile& f, const std::string& words) {
    INFO(words);
    CHECK_THROWS_WITH(run(folder, f), Catch::Contains("strain.h5: error: ") && Catch::Contains(words) &&
                                          Catch::Contains("make the file again with dresslife-strain"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "life.h5"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "life.h5.part"));
  };
  StrainFile f = example();
  f.sites[0].segment = 9;
  refused(f, "/site/segment names segment 9 (there are 4)");
  f = example();
  f.wrong_offset = 1;
  refused(f, "/reversal/offset does not divide the turning points among the sites");
  f = example();
  f.sites[3].sample[5] = 777;
  refused(f, "/reversal/sample holds 777 for a turning point of site 3");
  f = example();
  f.sites[3].sample[2] = 20;
  refused(f, "/reversal/sample holds 20 for a turning point of site 3 (must rise");
  f = example();
  f.sites[3].strain[2] = 0.02f;
  CHECK_NOTHROW(run(folder, f));  // the repeated history merges reversals in the same direction
  std::filesystem::remove(folder.path / "life.h5");
  pipeline::Job once = test_job();
  once.fatigue.counting = pipeline::Counting::half_cycles;
  CHECK_THROWS_WITH(run(folder, f, once),
                    Catch::Contains("strain.h5: error: /reversal/strain continues from 0.01 to 0.02 at turning "
                                    "point 2 of site 3") &&
                        Catch::Contains("half_cycles"));
  CHECK_FALSE(std::filesystem::exists(folder.path / "life.h5"));
  f = example();
  f.step[7] = 3;
  refused(f, "/program/step names line 3 (/program/text has 3)");
  f = example();
  f.free.clear();
  refused(f, "/bound_free holds no sites");
  f = example();
  f.sites[1].material = "unobtainium";
  refused(f, "/site/material names 'unobtainium', which its job does not describe");
}

TEST_CASE("sites are visited in order with their own strains, also over many blocks") {
  const Folder folder;
  StrainFile f = example();
  f.sites.clear();
  const std::size_t each = 999, count = 2 * SiteSet::block_reversals / each + 7;
  for (std::size_t site = 0; site < count; ++site) {
    Site& made = f.sites.emplace_back(swing(0, "cable 1", 0));
    made.strain.resize(site % 3 == 0 ? each : site % 3);
    for (std::size_t i = 0; i < made.strain.size(); ++i)
      made.strain[i] = (i % 2 == 0 ? 1e-5f : -1e-5f) * static_cast<float>(1 + site % 1009);
    made.sample.assign(made.strain.size(), 0);
  }
  f.sites[count / 2].strain.assign(SiteSet::block_reversals + 5, 0.5f);  // one site that fills more than a block
  f.sites[count / 2].sample.assign(SiteSet::block_reversals + 5, 0);
  write_strain(folder.path / "many.h5", f);
  const FileReader strain(folder.path / "many.h5", pipeline::strain_format());
  const SiteSet sites(strain, "");
  std::size_t visited = 0;
  bool all_equal = true;
  constexpr float kept = 1.5e-7f;  // half of the seventh decimal, and rounding of 0.5 to float
  const auto same = [](float a, float b) { return std::abs(a - b) < kept; };
  sites.for_each_block([&](const SiteSet::Block& block, const std::function<void()>& read_ahead) {
    for (std::size_t site = block.begin; site < block.end; ++site, ++visited) {
      const std::span<const float> strains = block.strains_of(site);
      all_equal =
          all_equal && site == visited &&
          std::equal(strains.begin(), strains.end(), f.sites[site].strain.begin(), f.sites[site].strain.end(), same);
    }
    read_ahead();
  });
  CHECK(visited == count);
  CHECK(all_equal);

  // Every site is evaluated once, by whichever thread.
  const TextColumn component = read_column(strain, "/site/component");
  const SiteCounters counters(sites, component, test_job());
  const SiteDamage alone = damage_of(sites, counters, 1, [](double) {});
  CHECK(alone.damage[3 * 336] > 10 * alone.damage[3 * 100]);
  CHECK(alone.damage[3 * 100] > 0);
  for (const std::size_t threads : {2, 5}) {
    const SiteDamage shared = damage_of(sites, counters, threads, [](double) {});
    const bool all_same = shared.damage == alone.damage && shared.range == alone.range;
    CHECK(all_same);
  }
}

TEST_CASE("uncertainty: the planner's lives widen about those of the scatter, which stay as they were") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.uncertainty.enabled = false;
  const FileReader without(run(folder, example(), job, "without.h5").file, pipeline::life_format());
  job.uncertainty.enabled = true;
  const FileReader with(run(folder, example(), job, "with.h5").file, pipeline::life_format());
  CHECK_FALSE(without.has_attribute("scatter_life_hours_p10"));
  CHECK_FALSE(without.has_attribute("life_response"));
  for (const std::string end : {"p10", "p50", "p90"})
    CHECK(with.number_attribute("scatter_life_hours_" + end) == without.number_attribute("life_hours_" + end));
  CHECK(with.number_attribute("life_hours_p10") < without.number_attribute("life_hours_p10"));
  CHECK(with.number_attribute("life_hours_p90") > without.number_attribute("life_hours_p90"));
  CHECK(with.number_attribute("life_hours") == without.number_attribute("life_hours"));
  CHECK(with.read<double>("/damage") == without.read<double>("/damage"));
  CHECK(with.text_attribute("measure_next") ==
        "model");  // at these strains the slope of life is nearly that of (8)'s ductile part
}

TEST_CASE("uncertainty: one wire strained far above its neighbours leaves a conductor at most a decade more") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.uncertainty.enabled = true;
  job.fatigue.failed_wires_percent = 100;  // the other wire as well
  const auto ahead = [&](float of_other) {
    StrainFile f = example();
    f.sites.resize(4);
    for (std::size_t other = 0; other < 3; ++other)
      for (float& strain : f.sites[other].strain) strain *= 0.1f;
    f.sites.push_back(swing(2, "cable 2/layer 1/wire 8", of_other));
    const FileReader life(run(folder, f, job).file, pipeline::life_format());
    const auto response = pipeline::LifeResponse::from_text(life.text_attribute("life_response"));
    return std::pair(
        response.planned[response.planned.size() / 2][1] - std::log10(life.number_attribute("life_repeats")),
        std::log10(life.number_attribute("scatter_life_hours_p50") / life.number_attribute("life_hours")));
  };
  constexpr double digits = 1e-4;  // of the text, in decades
  const auto [near, by_scatter] = ahead(0.009f);
  CHECK(near == Approx(by_scatter).margin(digits));
  CHECK(near < 0.9);
  const auto [far, far_by_scatter] = ahead(0.002f);
  CHECK(far == Approx(1).margin(digits));
  CHECK(far_by_scatter == Approx(1).margin(digits));  // the same limit: no answer has two lives
  for (const double half : {1e3, 1e6, std::numeric_limits<double>::infinity()}) {
    const Percentiles lives = near_first_wire({500, half, std::numeric_limits<double>::infinity()}, 200);
    CHECK(lives[1] == Approx(std::min(half, 2000.0)));
    CHECK(lives[0] == Approx(std::max(20.0, 500 * lives[1] / std::min(half, 1e25))));
  }

  // Without uncertain parameters the bounds change by the same decade.
  job.uncertainty.enabled = false;
  StrainFile f = example();
  for (Site& site : f.sites)
    for (float& strain : site.strain) strain *= 0.008f;  // damage beyond 1e15 reversals
  f.stick = {swing(2, "cable 2/layer 1/wire 7", 0.01f)};
  const FileReader life(run(folder, f, job).file, pipeline::life_format());
  CHECK(std::isinf(life.number_attribute("life_hours_p50")));
  CHECK(life.number_attribute("life_hours_p50_all_glued") < 10.01 * life.number_attribute("life_hours_all_stick"));
}

TEST_CASE("uncertainty: the response equals the results of the stage with the changed keys") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.uncertainty.enabled = true;
  const FileReader told(run(folder, example(), job).file, pipeline::life_format());
  const auto response = pipeline::LifeResponse::from_text(told.text_attribute("life_response"));
  const double life = told.number_attribute("life_repeats");
  for (const double strength : response.strength)
    for (const double slope : response.slope) {
      pipeline::ParameterPoint z{};
      z[index_of(pipeline::Uncertain::strength)] = strength, z[index_of(pipeline::Uncertain::slope)] = slope;
      pipeline::Job moved = test_job();
      moved.fatigue.strength_factor =
          pipeline::uncertain_parameters()[index_of(pipeline::Uncertain::strength)].value(strength);
      moved.fatigue.slope_change = pipeline::uncertain_parameters()[index_of(pipeline::Uncertain::slope)].value(slope);
      const FileReader again(run(folder, example(), moved, "moved.h5").file, pipeline::life_format());
      constexpr double digits = 1e-5;  // of the text, in decades
      CHECK(pipeline::LifeSurface(response).change(z) ==
            Approx(std::log10(again.number_attribute("life_repeats") / life)).margin(digits));
    }
  pipeline::Job lasting = test_job();
  lasting.fatigue.model_factor = 3;
  const FileReader longer(run(folder, example(), lasting, "longer.h5").file, pipeline::life_format());
  CHECK(longer.number_attribute("life_repeats") == Approx(3 * life).epsilon(1e-4));
}

TEST_CASE("uncertainty: the response knows lives beyond those that count as damaged") {
  const Folder folder;
  pipeline::Job job = test_job();
  job.uncertainty.enabled = true;
  const auto worst_life = [&](float times) {
    StrainFile f = example();
    for (auto& site : f.sites)
      for (float& strain : site.strain) strain *= times;
    const FileReader life(run(folder, f, job).file, pipeline::life_format());
    CHECK(std::isinf(life.number_attribute("life_repeats")));
    const auto response = pipeline::LifeResponse::from_text(life.text_attribute("life_response"));
    return response.worst_life[response.worst_life.size() / 2];  // at the medians
  };
  // By the elastic line life ~ strain^(1/b). At 2N = 1e15 the plastic line adds 3e-6 of the strain of 1e-4.
  constexpr double plastic = 1e-4;
  const double twice = std::log10(2) / -copper().fatigue_strength_exponent;
  CHECK(worst_life(0.005f) - worst_life(0.01f) == Approx(twice).margin(plastic));
}

TEST_CASE("life.h5: abrasion stands beside the wires with its place, its time and the share in which it is first") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.diameter = 0.05;
  StrainFile f = example();
  const auto modes_of = [](const FileReader& life) {
    return pipeline::unvalidated_from(life.text_attribute("unvalidated_modes"));
  };
  const auto names_in = [](const FileReader& life) { return life.text_attribute("not_evaluated"); };
  {  // neither a thickness nor contacts are given
    const FileReader none(run(folder, f, job, "none.h5").file, pipeline::life_format());
    CHECK(modes_of(none).empty());
    CHECK(names_in(none) == "abrasion, jackets of the cables, corkscrew, fretting and grip at clamps, connectors");
  }
  pipeline::Material polymer;
  polymer.name = "polymer";
  polymer.wear = {{pipeline::Counterface::robot, 1e-14, 5, "test"}};
  dresspack.materials.push_back(polymer);
  dresspack.sleeve = pipeline::Sleeve{2e-3, "polymer", {}};
  dresspack.core_parts = "water hose";
  f.rubbed = {{0.65, 1e4, 20}, {0.15, 10, 30}};
  const Result result = run(folder, f, job, "worn.h5");
  const FileReader life(result.file, pipeline::life_format());
  const auto modes = modes_of(life);
  REQUIRE(modes.size() == 1);
  CHECK(names_in(life) == "water hose, jackets of the cables, corkscrew, fretting and grip at clamps, connectors");
  CHECK(modes[0].place == "link_4");
  CHECK(modes[0].position_from_tool == Approx(0.35));
  CHECK(modes[0].segment_from_tool == 1);  // the last segment, 0.4 m long
  CHECK(modes[0].time == 20);
  CHECK(modes[0].step == "weld");
  // A(t, 0) d / (k N s). The patch is shorter than the footprint of one diameter.
  const double area = 4.0 / 3 * 2e-3 * std::sqrt(2 * 0.025 * 2e-3), repeats = area * 0.05 / (1e-14 * 1e4);
  constexpr double six_figures = 1e-5, strata = 1e-3;  // of the text; 10,000 samples
  CHECK(modes[0].hours[1] == Approx(hours(repeats, duration)).epsilon(strata));
  const double spread = std::hypot(std::log10(5.0), 1.5 * std::log10(1.1));
  CHECK(std::log10(modes[0].hours[2] / modes[0].hours[0]) == Approx(2 * 1.28155 * spread).epsilon(strata));
  // Abrasion is independent of the wires. Its probability of being first, and p10 of both, follow from two normal lives.
  CHECK(modes[0].first_share >= 0);
  CHECK(modes[0].first_share <= 1);
  CHECK(modes[0].together_p10 <= life.number_attribute("life_hours_p10") * (1 + six_figures));
  CHECK(modes[0].together_p10 <= modes[0].hours[0] * (1 + six_figures));
  CHECK_THAT(result.notes.summary, Catch::Contains("; the surface lasts "));
  CHECK(modes[0].found_share > 0);
  CHECK_THAT(modes[0].note, Catch::Contains("A visual check every 2 weeks finds "));
  CHECK(modes[0].visible_from ==
        Approx(std::pow(0.5, 1.5)).epsilon(1e-3));  // area of half the depth; four digits in the text
  job.inspection.visible_depth_percent = 100;       // visible only at failure: no check finds it
  const auto unseen = modes_of(FileReader(run(folder, f, job, "unseen.h5").file, pipeline::life_format()));
  CHECK(unseen[0].hours == modes[0].hours);
  CHECK(unseen[0].found_share == 0);
  // The dresspack is replaced when 1 of 10 has failed by the wires. These wires fail before that, some of them after the wear.
  const double replaced = life.number_attribute("life_hours_p10");
  REQUIRE(replaced < job.fatigue.robot_life_hours);
  const double worn = pipeline::normal_share(std::log10(replaced / hours(repeats, duration)) / spread);
  CHECK(unseen[0].unseen_share < worn + strata);
  CHECK(unseen[0].unseen_share > 0.9 * worn - strata);
  CHECK_THAT(modes[0].note,
             Catch::StartsWith(fmt::format("By the model {:.0f} % of the dresspacks", 100 * unseen[0].unseen_share)));
  job.inspection.interval_weeks = 0;
  const auto unchecked = modes_of(FileReader(run(folder, f, job, "unchecked.h5").file, pipeline::life_format()));
  CHECK(std::isnan(unchecked[0].unseen_share));
  CHECK(unchecked[0].note.empty());
  // Contacts that were not simulated must not look like a hose that nothing rubs.
  const auto is_known = [&](const char* name) {
    const FileReader file(run(folder, f, job, name).file, pipeline::life_format());
    CHECK(modes_of(file).empty() == (names_in(file).find("abrasion") != std::string::npos));
    return !modes_of(file).empty();
  };
  job.robot.links.resize(2);
  CHECK_FALSE(is_known("no_shapes.h5"));
  job.robot.links[1].capsules.emplace_back();
  CHECK(is_known("shapes.h5"));
  job.robot.links[0].name = "arm", job.robot.joints.resize(1);
  job.robot.joints[0].origin = {0, 0, 0.05};  // a link of this length can lie within its neighbours
  CHECK(is_known("wrist.h5"));
  job.robot.joints[0].origin = {0, 0, 0.4};
  const FileReader partial(run(folder, f, job, "partial.h5").file, pipeline::life_format());
  CHECK(modes_of(partial).size() == 1);
  CHECK_THAT(names_in(partial), Catch::Contains("abrasion on arm,"));
  job.robot.links.resize(5), job.robot.joints.resize(5);  // the third has a shape, the second and the fifth are short
  for (std::size_t k = 1; k < 5; ++k)
    job.robot.links[k].name = fmt::format("link_{}", k), job.robot.joints[k].origin = {k % 3 == 1 ? 0.05 : 0.3, 0, 0};
  job.robot.links[1].capsules.clear(), job.robot.links[2].boxes.emplace_back();
  CHECK_THAT(names_in(FileReader(run(folder, f, job, "some.h5").file, pipeline::life_format())),
             Catch::Contains("abrasion on arm and link_3,"));
  job.simulation.self_contact = false;
  CHECK_FALSE(is_known("not_on_itself.h5"));
  job.simulation.self_contact = true, job.simulation.contact = false;
  CHECK_FALSE(is_known("no_contact.h5"));
  job.simulation.contact = true;

  f.rubbed[1] = {-0.15, 10, 30};
  CHECK_THROWS_WITH(
      run(folder, f, job, "damaged.h5"),
      Catch::Contains("/rubbing: row 2 is no patch of a dresspack; make the file again with dresslife-strain"));
}

TEST_CASE("life.h5: a twist that every repeat leaves winds a loose cable into a corkscrew") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.components[0].radius = 5e-3;
  dresspack.components[0].components.resize(1);
  pipeline::Component& wires = dresspack.components[0].components[0];
  wires.name = "wire", wires.material = "copper", wires.count = 100, wires.radius = 7.5e-5;
  StrainFile f = example();
  f.cables = {{0, {0, 0, 0, 0}, {0, 0, 0}}};
  f.hose_moment = {1};
  const auto coil_of = [&](const char* name) {
    const FileReader life(run(folder, f, job, name).file, pipeline::life_format());
    auto modes = pipeline::unvalidated_from(life.text_attribute("unvalidated_modes"));
    std::erase_if(modes, [](const auto& mode) { return mode.mode != pipeline::UnvalidatedMode::corkscrew; });
    return std::pair{modes, life.text_attribute("not_evaluated")};
  };
  CHECK(coil_of("no_room.h5").first.empty());
  CHECK_THAT(coil_of("no_room.h5").second, Catch::Contains(", corkscrew, "));
  {
    pipeline::Job two = job;
    two.dresspacks[0].dresspack.inner_diameter = 0.05;
    two.dresspacks.push_back(two.dresspacks[0]);
    two.dresspacks[1].dresspack.hose_corrugation.emplace();  // no law for its kinks
    two.dresspacks[0].name = "one", two.dresspacks[1].name = "other";
    two.dresspacks[0].routing.free_length = 0.6, two.dresspacks[1].routing.free_length = 0.4;
    StrainFile both = f;
    for (std::vector<Site>* const sites : {&both.sites, &both.stick, &both.free})
      for (Site& site : *sites) site.component = (site.segment < 3 ? "one/" : "other/") + site.component;
    both.dresspacks = {0, 0, 0, 1}, both.hose_moment.push_back(1);
    CHECK_THAT(
        FileReader(run(folder, both, two, "two.h5").file, pipeline::life_format()).text_attribute("not_evaluated"),
        Catch::Contains("jackets of the cables, kinks of the hose (other), corkscrew (one), corkscrew (other), "));
  }
  f.room = 0.01;
  const auto [still, rest] = coil_of("still.h5");
  CHECK_THAT(rest, !Catch::Contains("corkscrew"));
  REQUIRE(still.size() == 1);
  CHECK(std::isinf(still[0].hours[0]));
  CHECK(still[0].note == "Neither its forces nor its twist would wind it.");
  // Compression alone winds at 2 E I kappa/r. The cable has half of it, then the same as a pull.
  const pipeline::CableForce force(dresspack, dresspack.components[0]);
  const double bending = force.bending_stiffness();
  f.cables[0].strain[0] = -force.strain_at(bending * 20 / f.room);
  CHECK(coil_of("pressed.h5").first[0].note == "Forces and twist 2.0 times as large would wind it.");
  f.cables[0].strain[0] *= -1;
  CHECK(coil_of("pulled.h5").first[0].note == "Neither its forces nor its twist would wind it.");
  f.cables[0].strain[0] = 0;
  f.twist = 0.5;
  const auto [recorded, unknown] = coil_of("recorded.h5");  // without joints the twist that a repeat leaves is unknown
  CHECK(std::isinf(recorded[0].hours[0]));
  CHECK_THAT(unknown, Catch::Contains("corkscrew after many repeats"));
  for (std::size_t t = 0; t < samples; ++t)
    f.joints.push_back(2 * std::numbers::pi * static_cast<double>(t) / (samples - 1));
  const auto [wound, other] = coil_of("wound.h5");
  REQUIRE(wound.size() == 1);
  CHECK_THAT(other, !Catch::Contains("corkscrew"));
  // Without a force: torque 4/3 E I q at the tight coil. The twist of the last sample is the twist that a repeat leaves.
  const double torsion = pipeline::pull_and_twist(dresspack, dresspack.components[0]).relaxed() +
                         pipeline::torsion_of_polymer * pipeline::polymer_bending(dresspack.components[0]);
  const double tight = 4.0 / 3 * bending * std::sqrt(20 / f.room), torque = torsion * f.twist;
  constexpr double strata = 1e-3;  // 10,000 samples
  CHECK(wound[0].hours[1] == Approx(hours(tight / torque - 1, duration)).epsilon(strata));
  CHECK(wound[0].time == Approx(duration));
  CHECK_THAT(wound[0].note, Catch::EndsWith("A repeat leaves 29 degrees of twist."));
  f.last_segment = 2.4, job.dresspacks[0].routing.free_length = 3;  // with as much twist per metre
  CHECK(coil_of("long.h5").first[0].hours[1] == Approx(wound[0].hours[1]).epsilon(strata));
  f.last_segment = 0.4, job.dresspacks[0].routing.free_length = 1;
  for (double& angle : f.joints) angle /= 3;
  const auto elsewhere = coil_of("elsewhere.h5").first[0];
  CHECK(std::isinf(elsewhere.hours[0]));
  CHECK_THAT(elsewhere.note, Catch::Contains("The motion does not end in its first pose"));
  f.twist = 1.01 * tight / torsion;
  CHECK(coil_of("tight.h5").first[0].hours[1] == Approx(hours(1, duration)).epsilon(strata));
  // Stiffnesses have a factor of two: at half the critical torque the cables wind that are half as stiff or less.
  f.twist = 0.5 * tight / torsion;
  const auto half = coil_of("half.h5").first[0];
  CHECK(half.first_share == Approx(pipeline::normal_share(-std::log10(2) / 0.3)).margin(strata));
  CHECK(half.hours[0] == Approx(hours(1, duration)));
  CHECK(std::isinf(half.hours[1]));
  dresspack.materials[0].tensile_strength = 230e6;
  f.cables[0].strain = {-1e-3, 0, 0};  // a third of the force that breaks it
  CHECK(coil_of("forced.h5").first.empty());
  f.cables[0].strain = {0, 0, 0};
  CHECK(coil_of("unforced.h5").first.size() == 1);
  f.room = std::numeric_limits<double>::infinity();
  CHECK(coil_of("endless.h5").first.empty());
}

TEST_CASE("life.h5: of the cables in a hose the one whose jacket is worn through first is named, beside the wires") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.inner_diameter = 0.05;
  pipeline::Material polymer;
  polymer.name = "polymer";
  polymer.wear = {{pipeline::Counterface::robot, 1e-15, 5, "test"}, {pipeline::Counterface::hose, 1e-14, 5, "test"}};
  dresspack.materials.push_back(polymer);
  pipeline::Component& cable = dresspack.components.front();
  cable.radius = 5e-3;
  StrainFile f = example();
  f.cables = {{0, {0, 0, 0, 0}, {0, 0, 0}}, {0, {0, 0, 0, 0}, {0, 0, 0}}};
  f.hose_moment = {1};
  f.jackets = {{0, 0.65, 10, 20}, {1, 0.15, 1e4, 60}};
  const auto jackets_of = [&](const char* name) {
    const FileReader life(run(folder, f, job, name).file, pipeline::life_format());
    auto modes = pipeline::unvalidated_from(life.text_attribute("unvalidated_modes"));
    std::erase_if(modes, [](const auto& mode) { return mode.mode != pipeline::UnvalidatedMode::jacket; });
    return std::pair(modes, life.text_attribute("not_evaluated"));
  };
  CHECK(jackets_of("bare.h5").first.empty());
  CHECK_THAT(jackets_of("bare.h5").second, Catch::Contains("jackets of the cables"));
  cable.jacket = pipeline::Sleeve{1e-3, "polymer", {}};
  CHECK_THAT(jackets_of("frictionless.h5").second, Catch::Contains("jackets of the cables"));
  cable.friction = 0.3;
  const auto [modes, missing] = jackets_of("worn.h5");
  CHECK_THAT(missing, !Catch::Contains("jacket"));
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].place == "cable 2");
  CHECK(modes[0].position_from_tool == Approx(0.85));
  CHECK(modes[0].step == "weld");
  // A(t, 0) l / (k N s), with a footprint of ten diameters
  const double area = 4.0 / 3 * 1e-3 * std::sqrt(2 * cable.radius * 1e-3),
               repeats = area * 20 * cable.radius / (1e-14 * 1e4);
  constexpr double strata = 1e-3;  // 10,000 samples
  CHECK(modes[0].hours[1] == Approx(hours(repeats, duration)).epsilon(strata));
  job.cell.temperature = 43;
  CHECK(jackets_of("warm.h5").first[0].hours[1] == Approx(modes[0].hours[1] / std::exp(0.0175 * 20)).epsilon(strata));
  job.cell.temperature = pipeline::Cell::usual_temperature;
  // At the other half of the rests the same jacket has ten times the work. Log10 of its life is linear in the normal score of the
  // rest between the scores of the two halves, and constant beyond them. Wear rate, thickness and motion are normal and independent.
  job.uncertainty.enabled = true;
  const auto alone = jackets_of("one_rest.h5").first[0].hours;
  f.rests = {0, 1, 0, 1};
  f.jackets.push_back({1, 0.25, 1e5, 60, 1});
  const auto two = jackets_of("two_rests.h5").first[0];
  CHECK(two.position_from_tool == Approx(0.75));  // at the rest with the shortest life
  const auto spread = two.hours;
  const auto decades = [](double longer, double shorter) { return std::log10(longer / shorter); };
  const double half = pipeline::normal_quantile(0.75),
               deviation = decades(alone[1], alone[0]) / pipeline::normal_quantile(0.9);
  double failed = 0;  // share at the life spread[0]
  constexpr int parts = 1000;
  for (int k = 0; k < parts; ++k) {
    const double score = std::clamp(pipeline::normal_quantile((k + 0.5) / parts), -half, half);
    failed += pipeline::normal_share((decades(spread[0], alone[1]) + 0.5 - score / half / 2) / deviation) / parts;
  }
  constexpr double sampling = 0.01;  // three standard errors of the share of 10,000 samples
  CHECK(failed == Approx(0.1).margin(sampling));
  CHECK(decades(alone[1], spread[1]) ==
        Approx(0.5).margin(2.5 * sampling * deviation));            // 2.5: 1 over the normal density
  job.uncertainty.spread[index_of(pipeline::Uncertain::rest)] = 0;  // with a known rest only the job's own counts
  CHECK(jackets_of("known_rest.h5").first[0].hours == alone);
  job.uncertainty.enabled = false;
  CHECK(jackets_of("certain_rest.h5").first[0].hours[1] == Approx(modes[0].hours[1]).epsilon(strata));
  f.jackets[2].rest = 2;
  CHECK_THROWS_WITH(run(folder, f, job, "restless.h5"), Catch::Contains("/jacket: row 3 is of no rest of the cables"));
  f.jackets.pop_back(), f.rests.clear();
  f.jackets[1].cable = 2;
  CHECK_THROWS_WITH(
      run(folder, f, job, "damaged.h5"),
      Catch::Contains("/jacket: row 2 is no patch of a dresspack; make the file again with dresslife-strain"));
  f.jackets[1] = {1, 0.15, 1e4, 1000};
  CHECK_THROWS_WITH(run(folder, f, job, "late.h5"), Catch::Contains("/jacket: row 2 is of no sample"));
  f.jackets.clear(), dresspack.inner_diameter.reset();
  const auto bundle = jackets_of("no_hose.h5");
  CHECK(bundle.first.empty());
  CHECK_THAT(bundle.second, Catch::Contains("jackets of the cables"));
}

TEST_CASE("life.h5: a cable without described wires has the life of its rating, one with wires does not have it, too") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  pipeline::Rating bends;
  bends.rig.kind = pipeline::RigKind::tick_tock, bends.rig.radius = 0.1, bends.cycles = 1e6, bends.source = "test";
  pipeline::Component power;
  power.name = "power cable", power.radius = 0.01,
  power.plain = pipeline::PlainPart{pipeline::PlainKind::cable, {}, {}, {}, {}, {}};
  dresspack.components.push_back(power);
  dresspack.components.front().ratings = {bends};  // in addition to its wires
  const auto rated_modes = [&](const FileReader& life) {
    auto modes = pipeline::unvalidated_from(life.text_attribute("unvalidated_modes"));
    std::erase_if(modes, [](const auto& mode) { return mode.mode != pipeline::UnvalidatedMode::rating; });
    return modes;
  };
  StrainFile f = example();
  {
    const FileReader none(run(folder, f, job, "none.h5").file, pipeline::life_format());
    CHECK(rated_modes(none).empty());
    CHECK_THAT(none.text_attribute("not_evaluated"), Catch::StartsWith("power cable, abrasion"));
  }
  dresspack.components.back().ratings = {bends};
  f.curvature = 5;  // 1/m in both directions, half of the rig's
  const FileReader life(run(folder, f, job, "rated.h5").file, pipeline::life_format());
  const auto modes = rated_modes(life);
  REQUIRE(modes.size() == 1);
  CHECK(modes[0].place == "power cable");
  CHECK((modes[0].time == Approx(0.2 * duration) ||
         modes[0].time == Approx(0.6 * duration)));  // the bends to either side
  CHECK(modes[0].note == "Its rating is of bending alone: twist is not evaluated.");
  CHECK_THAT(life.text_attribute("not_evaluated"), Catch::StartsWith("twist of power cable, abrasion"));
  constexpr double strata = 1e-3;       // 10,000 samples
  const double ratio = (1 / 0.11) / 5;  // the rig's curvature refers to the axis
  CHECK(modes[0].hours[1] == Approx(hours(1e6 * std::pow(ratio, 5), duration)).epsilon(strata));
  CHECK(std::log10(modes[0].hours[2] / modes[0].hours[0]) ==
        Approx(2 * 1.28155 * 1.5 * std::log10(ratio)).epsilon(strata));
  // Bends to either side, with the range 2 f.curvature as the rig.
  for (const auto& [times, warned] : {std::pair{1.9, false}, {2.1, true}}) {
    f.curvature = times * 5 * ratio;
    const auto warnings = run(folder, f, job, "beyond.h5").notes.warnings;
    CHECK(std::ranges::any_of(warnings, [](const pipeline::Warning& warning) {
            return warning.words.starts_with(
                "the motion bends 'power cable' with 2.1 times the range of its maker's test");
          }) == warned);
  }
  f.curvature = 5;
  dresspack.components.back().plain->kind = pipeline::PlainKind::hose;
  const FileReader of_hose(run(folder, f, job, "hose.h5").file, pipeline::life_format());
  REQUIRE(rated_modes(of_hose).size() == 1);
  CHECK(rated_modes(of_hose)[0].hours[1] == Approx(modes[0].hours[1]));
  CHECK_THAT(of_hose.text_attribute("not_evaluated"),
             Catch::StartsWith("pressure of power cable, twist of power cable, abrasion"));
  dresspack.components.back().plain->pressure = 6e5, dresspack.components.back().plain->most_pressure = 10e5;
  const FileReader pressed(run(folder, f, job, "pressed.h5").file, pipeline::life_format());
  CHECK_THAT(pressed.text_attribute("not_evaluated"), Catch::StartsWith("twist of power cable, abrasion"));
}

TEST_CASE(
    "life.h5: a smooth tube kinks where the tightest bend passes its radius, in the share of tubes that kink there") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  pipeline::Component tube;
  tube.name = "air hose", tube.radius = 0.005, tube.helix_radius = 0.01;
  tube.plain.emplace().kind = pipeline::PlainKind::hose;
  tube.plain->bore = 0.008;
  dresspack.core_diameter = 0.03;
  dresspack.core_components = {tube};
  dresspack.core_components[0].name = "water hose";
  dresspack.core_components[0].plain->bore = 0.006;  // thicker, so that the other tube is closer to its limit
  StrainFile f = example();
  const double kinks_at = pipeline::kink_radius(pipeline::Tube{0.01, 0.008}).median;
  const auto kink_of = [&](const FileReader& life) {
    auto modes = pipeline::unvalidated_from(life.text_attribute("unvalidated_modes"));
    std::erase_if(modes, [](const auto& mode) { return mode.mode != pipeline::UnvalidatedMode::kink; });
    REQUIRE(modes.size() == 1);
    return modes[0];
  };
  {  // the axis of the tube is 10 mm closer to the centre of the bend
    f.curvature = 1 / (2 * kinks_at + 0.01);
    dresspack.components.push_back(tube);
    const FileReader life(run(folder, f, job, "wide.h5").file, pipeline::life_format());
    const auto wide = kink_of(life);
    CHECK(wide.place == "air hose");
    CHECK(wide.margin == Approx(2).epsilon(1e-3));  // four digits in the text
    CHECK_THAT(wide.note, Catch::Contains("Tubes of PTFE with thick walls kink at up to five times that"));
    CHECK(wide.time == Approx(0.2 * duration));
    CHECK(std::isinf(wide.hours[0]));
    CHECK(wide.first_share ==
          Approx(0.0013).margin(2e-4));  // of a factor of 2 in 3.01 deviations of 0.1, of 10,000 strata
    CHECK_THAT(life.text_attribute("not_evaluated"),
               Catch::StartsWith("fatigue and pressure of air hose, fatigue and pressure of water hose, abrasion"));
  }
  // A pressure is compared with its limit, so only the fatigue is left out. One without a limit is not.
  dresspack.core_components[0].plain->pressure = dresspack.components[0].plain->pressure = 6e5;
  dresspack.core_components[0].plain->most_pressure = 10e5;
  CHECK_THAT(
      FileReader(run(folder, f, job, "pressed.h5").file, pipeline::life_format()).text_attribute("not_evaluated"),
      Catch::StartsWith("fatigue and pressure of air hose, fatigue of water hose, abrasion"));
  f.curvature = 1 / (kinks_at + 0.01);
  const auto near = kink_of(FileReader(run(folder, f, job, "near.h5").file, pipeline::life_format()));
  CHECK(near.first_share == Approx(0.5).margin(1e-3));
  CHECK(near.hours[0] == Approx(hours(1, duration)));
  CHECK(std::isinf(near.hours[2]));
  dresspack.components.back().plain->least_bend_radius = 1.01 * kinks_at;
  const auto limited = kink_of(FileReader(run(folder, f, job, "limited.h5").file, pipeline::life_format()));
  CHECK(limited.first_share == 1);
  CHECK_THAT(limited.note, Catch::Contains("Its maker allows") && !Catch::Contains("PTFE"));
  f.curvature = 50;  // tighter than the position of the tube allows
  CHECK(kink_of(FileReader(run(folder, f, job, "folded.h5").file, pipeline::life_format())).first_share == 1);
  f.curvature = 3, f.curvature_d2 = 4;  // 5/m in the first segment, 0 in the next: 7.5/m at the clamp
  const auto clamped = kink_of(FileReader(run(folder, f, job, "clamped.h5").file, pipeline::life_format()));
  CHECK(clamped.margin == Approx((1 / 7.5 - 0.01) / (1.01 * kinks_at)).epsilon(1e-3));
  f.curvature = f.curvature_d2 = 0;
  const auto straight = kink_of(FileReader(run(folder, f, job, "straight.h5").file, pipeline::life_format()));
  CHECK(std::isinf(straight.margin));
  CHECK(straight.first_share == 0);
  // A smooth hose around the tubes, with and without the radius of its maker.
  f.curvature = 5;
  dresspack.inner_diameter = 0.8 * dresspack.diameter;
  dresspack.components.pop_back(), dresspack.core_components.clear();
  const auto own = kink_of(FileReader(run(folder, f, job, "hose.h5").file, pipeline::life_format()));
  CHECK(own.place == "the hose");
  CHECK_THAT(own.note, Catch::Contains("By its two diameters"));
  dresspack.least_bend_radius = 0.25;
  const auto stated = kink_of(FileReader(run(folder, f, job, "stated.h5").file, pipeline::life_format()));
  CHECK(stated.margin == Approx(0.2 / 0.25));
  CHECK(stated.first_share == 1);
  CHECK_THAT(stated.note, Catch::Contains("Its maker allows 250 mm or more") && !Catch::Contains("PTFE"));
}

TEST_CASE("life.h5: surfaces wear faster in a warm cell, and as before at 23 C") {
  const Folder folder;
  pipeline::Job job = test_job();
  pipeline::Dresspack& dresspack = job.dresspacks[0].dresspack;
  dresspack.diameter = 0.05;
  pipeline::Material polymer;
  polymer.name = "polymer";
  polymer.wear = {{pipeline::Counterface::robot, 1e-14, 5, "test"}};
  dresspack.materials.push_back(polymer);
  dresspack.sleeve = pipeline::Sleeve{2e-3, "polymer", {}};
  StrainFile f = example();
  f.rubbed = {{0.65, 1e4, 20}};
  const auto life_at = [&](double temperature) {
    job.cell.temperature = temperature;
    const FileReader life(run(folder, f, job, "warm.h5").file, pipeline::life_format());
    return pipeline::unvalidated_from(life.text_attribute("unvalidated_modes")).at(0).hours;
  };
  const auto usual = life_at(23), warm = life_at(43);
  constexpr double strata = 1e-3;  // 10,000 samples
  CHECK(usual[1] / warm[1] == Approx(std::exp(0.0175 * 20)).epsilon(strata));
  const double spread = std::hypot(std::log10(5.0), 1.5 * std::log10(1.1), 0.0075 * 20 / std::log(10.0));
  CHECK(std::log10(warm[2] / warm[0]) == Approx(2 * 1.28155 * spread).epsilon(strata));  // 0.4 % more than at 23 C
}
