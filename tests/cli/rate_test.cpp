// `dresslife rate` and `dresslife validate`, run as a user runs them.
#include <sstream>

#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife::tests;

namespace {

const std::string source = DRESSLIFE_SOURCE_DIR;

constexpr const char* cable = R"(name: lead
source: made for the tests
diameter_mm: 6
mass_kg_per_m: 0.05
bending_stiffness_Nm2: 0.02
torsional_stiffness_Nm2: 0.02
axial_stiffness_N: 10000
damping_time_ms: 20
damping_source: made for the tests
components:
  - {name: core, count: 3, radius_mm: 0.8, helix_radius_mm: 1.2, lay_angle_deg: 12, components: [
      {name: wire, count: 6, radius_mm: 0.05, helix_radius_mm: 0.3, lay_angle_deg: 8, material: copper}]}
ratings:
  - {rig: {kind: torsion, twist_deg_per_m: 270}, cycles: 1e+6, source: data sheet}
)";

/// Returns the cells of a row of a Markdown table.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream parts(line);
  for (std::string cell; std::getline(parts, cell, '|');) cells.push_back(cell);
  return cells;
}

std::string row_of(const std::string& table, const std::string& name) {
  const std::size_t at = table.find("| " + name + " |");
  return at == std::string::npos ? "" : table.substr(at, table.find('\n', at) - at);
}

/// Returns all numbers of a cell.
std::vector<double> numbers_in(std::string cell) {
  std::erase(cell, ',');
  std::vector<double> numbers;
  for (const char* at = cell.c_str(); *at;) {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    numbers.push_back(value);
    at = end;
  }
  return numbers;
}

}  // namespace

TEST_CASE("rate: a cable's lives in every shipped rig stand beside its maker's rating") {
  Scratch scratch;
  scratch.write("lead.yaml", cable);
  const Outcome outcome = must_run(scratch, "dresslife", "rate lead.yaml --quiet");
  INFO(outcome.err);
  const std::string csv = content(scratch / "runs/rate_lead/rate.csv");
  std::size_t rigs = 0;
  for (const auto& entry : fs::directory_iterator(source + "/config/rigs")) {
    if (entry.path().extension() != ".yaml") continue;
    ++rigs;
    CHECK(csv.find("\nlead," + entry.path().stem().string() + ",") != std::string::npos);
  }
  CHECK(std::count(csv.begin(), csv.end(), '\n') == static_cast<std::ptrdiff_t>(rigs) + 2);  // header, rating
  CHECK(csv.find(",torsion: twist_deg_per_m 270,done,") != std::string::npos);
  CHECK(csv.find(",1000000,data sheet\n") != std::string::npos);
  CHECK(outcome.out.find("1,000,000 (") != std::string::npos);
  CHECK(outcome.out.find("own values (uncertainty.enabled=false). dresslife run of a rig") != std::string::npos);
  // The rating's own rig has half as much more twist than the shipped one: the life must be shorter.
  const auto life = [&](const std::string& job) {
    const std::size_t at = csv.find("\nlead," + job + ",") + 1;
    const std::string line = csv.substr(at, csv.find('\n', at) - at);
    const std::size_t done = line.find(",done,");
    REQUIRE(done != std::string::npos);
    return numbers_in(line.substr(done + 6, line.find(',', done + 6) - done - 6)).at(0);
  };
  CHECK(life("rating_1") < life("torsion"));
  CHECK(run(scratch, "dresslife", "rate lead.yaml").err.find(" ran\n") == std::string::npos);

  scratch.write("hose.yaml",
                std::string(cable).substr(0, std::string(cable).find("components:")) + "inner_diameter_mm: 5\n");
  const Outcome empty = run(scratch, "dresslife", "rate hose.yaml");
  CHECK(empty.status == 1);
  CHECK(empty.err.find("hose.yaml: error: holds no cable (a part that holds parts); name another") !=
        std::string::npos);
}

TEST_CASE("rate: all problems of a cable beside others are listed, each once") {
  Scratch scratch;
  const std::string lead = "helix_radius_mm: 8, slack_percent: 1, data_sheet: '4G1,5'";
  scratch.write("hose.yaml",
                "name: hose\nsource: test\ninner_diameter_mm: 30\ndiameter_mm: 40\nmass_kg_per_m: 1\n"
                "bending_stiffness_Nm2: 1\ncomponents:\n  - {name: p, " +
                    lead + ", ratings: [{rig: {kind: torsion}, cycles: 1e6, source: test}, " +
                    "{rig: {kind: rolling_flex, radius_diameters: 10}, cycles: 1e6, source: test}]}\n" +
                    "  - {name: q, phase_deg: 180, " + lead + "}\n");
  const Outcome outcome = run(scratch, "dresslife", "rate hose.yaml --quiet");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.status == 1);
  CHECK(outcome.out.find("needs twist_deg_per_m; give it (and 1 more problems, listed below the jobs)") !=
        std::string::npos);
  const std::size_t listed = outcome.err.find("a rig of kind rolling_flex needs travel_m; give it (job p-rating_2)");
  CHECK(listed != std::string::npos);
  CHECK(outcome.err.find("needs travel_m", listed + 40) == std::string::npos);
}

/// Returns the numbers after ",done," of each row: cycles_p10, cycles_p50, cycles_p90, worst_wire_cycles, cycles_all_stick,
/// cycles_all_free, ..
std::vector<std::vector<double>> lives_in(const std::string& csv) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t done = line.find(",done,");
    if (done == std::string::npos) continue;
    std::istringstream parts(line.substr(done + 6));
    std::vector<double>& row = rows.emplace_back();
    for (std::string cell; std::getline(parts, cell, ',');) row.push_back(std::atof(cell.c_str()));
  }
  return rows;
}

TEST_CASE("rate: the median lies between the same number with a glued and with a free inside") {
  Scratch scratch;
  must_run(scratch, "dresslife", "rate control_cable --quiet");
  const auto rows = lives_in(content(scratch / "runs/rate_control_cable/rate.csv"));
  CHECK(rows.size() >= 7);
  for (const std::vector<double>& row : rows) {
    // Friction may distribute strain over wires better than free sliding by 1 %. Lives follow at most the tenth power.
    CHECK(row.at(1) >= row.at(4) * 0.9);
    CHECK(row.at(1) <= row.at(5) * 1.1);
    CHECK(row.at(4) <= row.at(5));
  }
}

TEST_CASE("rate: warnings of the rigs' jobs are printed, except those of a bend that the rig prescribes") {
  Scratch scratch;
  std::string text = content(source + "/config/dresspacks/control_cable.yaml");
  const std::string lay = "lay_length_mm: 60";
  REQUIRE(text.find(lay) != std::string::npos);
  scratch.write("long_lay.yaml", text.replace(text.find(lay), lay.size(), "lay_length_mm: 150"));
  const auto warnings = [&](const std::string& of) {
    std::string words = must_run(scratch, "dresslife", "rate " + of + " --quiet").err;
    CHECK(words.find("smallest bend radius") == std::string::npos);
    return words;
  };
  const std::string chain =
      "energy_chain: warning: a bend contains few turns of control_cable/layer 1/core (lay 150 mm)";
  CHECK(warnings("long_lay.yaml").find(chain) != std::string::npos);
  const std::string shipped = warnings("control_cable");
  CHECK(shipped.find("torsion: warning: 'control_cable 1' is pulled with") != std::string::npos);
  CHECK(shipped.find("few turns") == std::string::npos);
}

TEST_CASE("rate: in torsion with a free lower end a heavier weight shortens the life") {
  Scratch scratch;
  std::string text = std::string(cable).substr(0, std::string(cable).find("ratings:")) + "ratings:\n";
  for (const char* weight : {"0", "1", "10", "50"})
    text += std::string("  - {rig: {kind: torsion, twist_deg_per_m: 180, weight_kg: ") + weight +
            "}, cycles: 1, source: test}\n";
  scratch.write("lead.yaml", text);
  const Outcome outcome = must_run(scratch, "dresslife", "rate lead.yaml --quiet");
  const auto rows = lives_in(content(scratch / "runs/rate_lead/rate.csv"));
  REQUIRE(rows.size() > 4);
  for (std::size_t i = rows.size() - 3; i < rows.size(); ++i) CHECK(rows[i].at(1) < rows[i - 1].at(1));
  CHECK(outcome.out.find("A heavier weight shortens the life.") != std::string::npos);
  CHECK(outcome.out.find("torsion, 180 deg/m, both ends held ") != std::string::npos);
  CHECK(outcome.out.find("torsion, 180 deg/m, lower end free, 1 kg ") != std::string::npos);
}

TEST_CASE("rate: a fault of all tests is one message") {
  Scratch scratch;
  scratch.write("lead.yaml", cable);
  const Outcome outcome = run(scratch, "dresslife", "rate lead.yaml --quiet --set calibration=WRONG");
  CHECK(outcome.status == 1);
  CHECK(outcome.out.empty());
  CHECK(outcome.err == "WRONG: error: cannot be read (No such file or directory); check the path\n");
}

TEST_CASE("validate: run-outs and breaks are judged, and a model without a failure is caught") {
  Scratch scratch;
  const std::string job =
      "    job: {motion: {rig: {kind: axial, elongation_percent: 0.2}}, dresspack: {cable: {name: wire, source: test, "
      "radius_mm: 0.1, components: [{name: strand, radius_mm: 0.1, helix_radius_mm: 0, material: copper}]}}}\n"
      "    what: pulled\n    source: made for the tests\n    criterion: first_wire\n";
  const auto one = [&](const std::string& name, const std::string& more) {
    return "  - name: " + name + "\n" + job + more;
  };
  scratch.write("o.yaml", "observations:\n" + one("early", "    cycles: 10\n    outcome: run_out\n") +
                              one("late", "    cycles: 1e+11\n    outcome: rating\n") +
                              one("soon", "    cycles: 10\n    outcome: broken_by\n") +
                              one("ever",
                                  "    cycles: 1e+9\n    outcome: broken\n    vary: "
                                  "{fatigue.endurance_strain: [0.01]}\n"));
  const Outcome outcome = must_run(scratch, "dresslife", "validate o.yaml --quiet");
  INFO(outcome.err);
  CHECK(row_of(outcome.out, "early").ends_with("| agrees |"));
  CHECK(row_of(outcome.out, "late").find("MISS: too short by") != std::string::npos);
  CHECK(row_of(outcome.out, "soon").find("MISS: too long by") != std::string::npos);
  CHECK(row_of(outcome.out, "ever").ends_with("| MISS: too long, no failure predicted |"));
  CHECK(unmarked_content(scratch / "runs/validate_o/validation.svg").starts_with("<svg "));

  const auto refused = [&](const std::string& text) {
    scratch.write("bad.yaml", text);
    const Outcome bad = run(scratch, "dresslife", "validate bad.yaml");
    CHECK(bad.status == 1);
    return bad.err;
  };
  CHECK(refused("observations: []\n").find("holds no observations; write 'observations:' and a list") !=
        std::string::npos);
  CHECK(refused("observations:\n" + one("x", "    outcome: broken\n"))
            .find("'x' must have either cycles or hours (or stiffness_Nm2, decrement or bending); give one of them") !=
        std::string::npos);
  CHECK(refused("observations:\n" + one("a", "    cycles: 5\n") + one("a", "    cycles: 5\n"))
            .find("two observations are named 'a'") != std::string::npos);
  CHECK(refused("observations:\n" + one("a/b", "    cycles: 5\n")).find("is not made of letters, digits and _") !=
        std::string::npos);
}

TEST_CASE("validate: the shipped table is what the code says") {
  // A fast row of each kind: a wire that broke, a wire in tension, a clip and a cable in torsion.
  const std::string page = content(source + "/config/observations/README.md");
  const std::string all = content(source + "/config/observations/published.yaml") + "\n" +
                          content(source + "/config/observations/ratings.yaml");
  Scratch scratch;
  std::string some = "observations:\n";
  const std::vector<std::string> names{"wire_limit", "sheet_76_MPa", "wire_300_MPa", "clip_5_deg",
                                       "seventh_axis_torsion"};
  for (const std::string& name : names) {
    const std::size_t at = all.find("  - name: " + name + "\n");
    REQUIRE(at != std::string::npos);
    some += all.substr(at, std::min(all.find("\n  - name: ", at), all.size() - 1) + 1 - at);
  }
  scratch.write("some.yaml", some);
  const Outcome outcome = must_run(scratch, "dresslife", "validate some.yaml --quiet");
  INFO(outcome.err);
  for (const std::string& name : names) {
    const auto shipped = cells_of(row_of(page, name)), now = cells_of(row_of(outcome.out, name));
    INFO(name);
    REQUIRE(shipped.size() == now.size());
    REQUIRE(shipped.size() > 7);
    CHECK(shipped[3] == now[3]);
    CHECK(shipped[7] == now[7]);
    // Instruction sets round strains differently in the seventh digit, and lives follow the tenth power. Two digits are printed:
    // 10 %. A change of the constants, the kinematics or the friction changes lives much more.
    const auto before = numbers_in(shipped[4]), after = numbers_in(now[4]);
    REQUIRE(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i) CHECK(after[i] == Approx(before[i]).epsilon(0.1));
  }
}
