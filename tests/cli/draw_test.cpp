// dresslife draw: a dresspack as a list and as a picture.
#include <fmt/format.h>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {}  // namespace

TEST_CASE("draw lists a dresspack's layers, what they add up to and what overlaps") {
  Scratch scratch;
  const Outcome drawn = must_run(scratch, "dresslife", "draw thesis_welding -o hose.svg");
  INFO(drawn.err);
  // 10 cables of 7 conductors of 92 wires of 0.15 mm.
  CHECK(drawn.out.find("6440 wires of 113.8 mm2") != std::string::npos);
  // Ten times the 0.0019, 0.226 and 4.14 N m2 of an independent calculation for one cable.
  CHECK(drawn.out.find("0.0187 when all slide, 2.26 when parts of level 2 are solid, 41.4 when parts of level 1") !=
        std::string::npos);
  CHECK(drawn.err.find("the 7 parts 'conductor' are 2.254 mm apart") != std::string::npos);

  // The picture defines each layer once and uses it for each of its parts. Overlapping layers have the colour of a warning.
  const std::string picture = unmarked_content(scratch / "hose.svg");
  CHECK(picture.rfind("<svg", 0) == 0);
  CHECK(count_of(picture, "<use ") == 10 + 7 + 31 + 25 + 18 + 12 + 6);
  CHECK(count_of(picture, "class=\"over\"") == 1);

  const Outcome built = run(scratch, "dresslife", "draw spot_welding -o hose.svg");  // the shipped default can be built
  CHECK(built.status == 0);
  CHECK(built.err.empty());
  CHECK(count_of(content(scratch / "hose.svg"), "class=\"over\"") == 0);
}

TEST_CASE("draw shows what a dresspack holds beside wires, and says that it has no life here") {
  Scratch scratch;
  const Outcome drawn = must_run(scratch, "dresslife", "draw handling -o hose.svg");
  INFO(drawn.err);
  // pi/4 (12^2 - 8^2) mm2 of 1200 kg/m3 and pi/4 8^2 of water; 50 MPa pi/64 (12^4 - 8^4) mm4.
  CHECK(drawn.out.find("hose for water, bore 8 mm, 0.126 kg/m, E I 0.0408 N m2 (ESTIMATE); no life here") !=
        std::string::npos);
  CHECK(drawn.out.find("fibre, 0.015 kg/m") != std::string::npos);
  CHECK(drawn.out.find("1792 wires") != std::string::npos);  // 4 cables of 7 cores of 64
  const std::string picture = content(scratch / "hose.svg");
  CHECK(count_of(picture, "class=\"plain\"") == 3);
  CHECK(count_of(picture, "class=\"water\"") == 1);
  CHECK(count_of(picture, "class=\"air\"") == 1);
}

TEST_CASE("draw shows two cables that lie in each other in the colour of a warning, and refuses two in one place") {
  Scratch scratch;
  const auto hose = [&](int angle) {
    std::string text =
        "name: hose\nsource: made up\ndiameter_mm: 40\ninner_diameter_mm: 34\nhose_material: hose_polyamide\n"
        "hose_corrugation: {pitch_mm: 3.4, height_mm: 3, wall_mm: 0.5}\ncomponents:\n";
    for (const auto& [name, phase] : {std::pair("a", 0), std::pair("b", angle)})
      text += fmt::format(
          "  - {{name: {}, radius_mm: 5, helix_radius_mm: 10, phase_deg: {}, components: [{{name: wire, count: 6, radius_mm: "
          "0.3, helix_radius_mm: 2, lay_angle_deg: 15, material: copper}}]}}\n",
          name, phase);
    scratch.write("hose.yaml", text);
    return run(scratch, "dresslife", "draw hose.yaml -o hose.svg");
  };
  const Outcome near = hose(40);  // 2 * 10 mm * sin(20 deg)
  CHECK(near.status == 0);
  CHECK(near.err.find("'a' and 'b' come as near as 6.84 mm") != std::string::npos);
  CHECK(count_of(content(scratch / "hose.svg"), "class=\"over\"") == 2);
  CHECK(count_of(content(scratch / "hose.svg"), "(overlap: red)") == 2);
  const Outcome same = hose(0);
  CHECK(same.status == 1);
  CHECK(same.err.find("hose.yaml:9:5: error: 'a' and 'b' come as near as 0 mm") == 0);
  CHECK(hose(180).err.empty());
  CHECK(count_of(content(scratch / "hose.svg"), "class=\"over\"") == 0);
}

TEST_CASE("a cable needs no more than its data sheet's line, and is as wide as that says") {
  Scratch scratch;
  const auto cable = [](const std::string& keys) {
    return "name: c\nsource: a data sheet\ncomponents:\n  - name: cable\n    helix_radius_mm: 0\n    data_sheet: 7 x 0.5 mm2, wire 0.1 "
           "mm, outer diameter 8.2 mm, jacket 1.1 mm\n" +
           keys;
  };
  scratch.write("cable.yaml", cable(""));
  const Outcome drawn = run(scratch, "dresslife", "draw cable.yaml");
  INFO(drawn.err);
  CHECK(drawn.status == 0);
  CHECK(drawn.out.find("c: 8.2 mm, ") == 0);
  scratch.write("hose.yaml", cable("inner_diameter_mm: 20\n"));
  CHECK(run(scratch, "dresslife", "draw hose.yaml").err.find("diameter_mm is missing") != std::string::npos);
}

TEST_CASE("draw, rate, check: the estimates of a cable whose part has another name than the cable") {
  Scratch scratch;
  for (const char* part : {"lead", "power"}) {
    scratch.write("cable.yaml", std::string("name: lead\nsource: test\ncomponents:\n  - {name: ") + part +
                                    ", helix_radius_mm: 0, data_sheet: '4G1,5'}\n");
    scratch.write(
        "job.yaml",
        "motion: {rig: {kind: rolling_flex, radius_diameters: 10, travel_m: 1}}\ndresspack: {cable: cable.yaml}\n");
    for (const char* command : {"draw cable.yaml", "rate cable.yaml", "check job.yaml"}) {
      const std::string printed = unwrapped(must_run(scratch, "dresslife", command).out);
      INFO(command << ": " << printed);
      CHECK(printed.find(std::string("ESTIMATE, not in the dresspack: data_sheet of ") + part +
                         ": conductor_class 6 (class 5 has wires of 0.25 mm") != std::string::npos);
      CHECK(printed.find("; friction_coefficient 0.3 (") != std::string::npos);
    }
  }
}

TEST_CASE("draw: a cable alone has the mass of its construction") {
  Scratch scratch;
  scratch.write("cable.yaml",
                "cable: {name: lead, source: test, data_sheet: \"4G2.5, class 6, outer diameter 12.1 mm\"}\n");
  const std::string drawn = must_run(scratch, "dresslife", "draw cable.yaml").out;
  INFO(drawn);
  // 9.97 mm2 of wires of 8900 kg/m3 and the remaining 105 mm2 of 1200 kg/m3: 0.2148 kg/m. Lays add 2 % to the copper.
  CHECK(drawn.find("lead: 12.1 mm, 0.2164 kg/m by its construction") == 0);
  CHECK(drawn.find("E I [N m2] of its construction") != std::string::npos);
  // A measured mass beside the data sheet counts, as it does for a part of a hose.
  const auto weighed = [&](const std::string& mass) {
    scratch.write("cable.yaml", "cable: {name: lead, source: test, mass_kg_per_m: " + mass +
                                    ", data_sheet: \"4G2.5, class 6, outer diameter 12.1 mm\"}\n");
    return run(scratch, "dresslife", "draw cable.yaml");
  };
  CHECK(weighed("0.25").out.find("lead: 12.1 mm, 0.25 kg/m") == 0);
  const Outcome grams = weighed("250");
  CHECK((grams.out + grams.err).find("mass_kg_per_m: 0.25 if that was g/m") != std::string::npos);
}

TEST_CASE("draw replaces pictures and nothing else") {
  Scratch scratch;
  scratch.write("mine.yaml", "keep: me\n");
  scratch.write("mine.svg", "keep: me\n");
  const Outcome refused = run(scratch, "dresslife", "draw control_cable -o mine.svg");
  CHECK(refused.status == 1);
  CHECK(refused.err.find("mine.svg: error: is there already and was not written by dresslife") == 0);
  CHECK(content(scratch / "mine.svg") == "keep: me\n");
  CHECK(run(scratch, "dresslife", "draw control_cable -o cable.pdf").err ==
        "cable.pdf: error: is neither an .svg nor a .png; name the picture accordingly\n");
  must_run(scratch, "dresslife", "draw control_cable -o cable.svg");
  CHECK(run(scratch, "dresslife", "draw sensor_cable -o cable.svg").status == 0);
  CHECK(content(scratch / "cable.svg").find("sensor_cable") != std::string::npos);
  const Outcome job = run(scratch, "dresslife", "draw mine.yaml");
  CHECK(job.status == 1);
  CHECK(job.err.find("keep") != std::string::npos);
}

TEST_CASE("a job by itself runs as a study of one") {
  Scratch scratch;
  write_small_job(scratch);
  const Outcome ran = run(scratch, "dresslife", "run job.yaml");
  INFO(ran.err);
  CHECK(ran.status == 0);
  CHECK(fs::exists(scratch / "runs/job/job/life.h5"));
  CHECK(ran.out.find("Report: runs/job/report.html") != std::string::npos);
  CHECK(run(scratch, "dresslife", "status job.yaml").out.find("1 of 1 jobs done") != std::string::npos);
}

TEST_CASE("draw: the dresspack of a job, of a job with several none, with their names") {
  const Scratch scratch;
  scratch.write("hose.yaml", content(fs::path(DRESSLIFE_SOURCE_DIR) / "config/dresspacks/handling.yaml"));
  scratch.write("job.yaml", "motion: hard\ndresspack: hose.yaml\n");
  CHECK(must_run(scratch, "dresslife", "draw job.yaml").out == must_run(scratch, "dresslife", "draw hose.yaml").out);
  scratch.write("one_key.yaml", "dresspack: hose.yaml\ndresspack.components.3.count: 1\n");
  CHECK(must_run(scratch, "dresslife", "draw one_key.yaml").out.find("     1 air hose ") != std::string::npos);
  scratch.write("two.yaml",
                "dresspacks:\n  - {name: a, dresspack: hose.yaml}\n  - {name: b, dresspack: control_cable}\n");
  const Outcome two = run(scratch, "dresslife", "draw two.yaml");
  CHECK(two.status == 1);
  CHECK(two.err ==
        "two.yaml:2:3: error: is a job with 2 dresspacks (one is drawn); name one of them: hose.yaml, control_cable\n");
}
