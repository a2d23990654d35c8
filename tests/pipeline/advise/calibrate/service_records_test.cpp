// Tables of maintenance systems: usual forms, rows that are counted, and refusals with their place.
#include "pipeline/advise/calibrate/service_records.h"

#include <unistd.h>

#include <fstream>

#include "pipeline/base/errors.h"
#include "tests/catch.h"
#include "tests/pipeline/scratch.h"

using namespace dresslife::pipeline;
using Catch::Contains;

namespace {

const std::filesystem::path folder = std::filesystem::temp_directory_path();

struct File {
  File(const std::string& name, const std::string& text)
      : path(folder / fmt::format("dresslife-{}-{}", ::getpid(), name)) {
    std::ofstream(path) << text;
  }
  ~File() { std::filesystem::remove(path); }
  std::filesystem::path path;
};

const Day today = *day_from("2026-11-23");

/// A job with 80 h per week.
constexpr const char* wire_job =
    "motion: {rig: {kind: axial, elongation_percent: 0.2}}\ndresspack: {cable: {name: wire, source: test, radius_mm: "
    "0.1, components: [{name: strand, radius_mm: 0.1, helix_radius_mm: 0, material: copper_halved}]}}\n";

/// Reads a table. since: empty: none. The job is wire_job.
ServiceTests read(const std::string& table, const std::string& since = "") {
  const File job("job.yaml", wire_job);
  const File file("plant.csv", table);
  std::optional<Day> day;
  if (!since.empty()) day = day_from(since);
  return read_service_tests({file.path, job.path.string(), day, today, {}});
}

/// Reads a table for which no job is named.
ServiceTests read_without_job(const std::filesystem::path& file) {
  return read_service_tests({file, "", {}, today, {}});
}

std::string refusal(const std::string& table, const std::string& since = "") {
  try {
    read(table, since);
  } catch (const InputError& error) {
    const std::string words = error.what(), name = "plant.csv";
    return words.substr(words.find(name) == words.npos ? 0 : words.find(name));
  }
  return "read";
}

}  // namespace

TEST_CASE("service records: the same plant in English with commas and in German with semicolons") {
  const std::string english =
      "robot,dresspack,installed,replaced,reason,hours_per_week\n"
      "R1,a,2024-01-01,2024-12-30,failed,70\nR1,a,2024-12-30,alive,,70\n"
      "R2,a,2022-05-02,2025-04-28,preventive,\nR3,a,2022-05-02,,,40.5\n";
  const std::string german =
      "Bemerkung;Roboter;Schlauchpaket;Einbaudatum;Ausbaudatum;Grund;Stunden pro Woche\n"
      "x;R1;a;01.01.2024;30.12.2024 14:05;Kabelbruch;70\n;R1;a;30.12.2024;in Betrieb;;70\n"
      ";R2;a;2.5.2022;28.04.2025;vorbeugend;\n;R3;a;02.05.2022;;;40,5\n";
  for (const std::string& table : {english, german}) {
    const ServiceTests plant = read(table, "2023-05-01");
    REQUIRE(plant.tests.size() == 1);
    const std::vector<ServiceRecord>& records = plant.tests.front().observation.service;
    REQUIRE(records.size() == 4);
    CHECK(records[0].hours == Approx(52 * 70));
    CHECK(records[0].failed);
    CHECK(records[0].entry_hours == 0);
    CHECK(records[1].hours == Approx(99 * 70));  // until today
    CHECK_FALSE(records[1].failed);
    CHECK(records[2].hours == Approx(156 * 80));  // hours per week from the job
    CHECK(records[2].entry_hours == Approx(52 * 80));
    CHECK_FALSE(records[2].failed);
    CHECK(records[3].entry_hours == Approx(52 * 40.5));
    CHECK_THAT(plant.words,
               Contains("4 dresspacks: 1 failed, 1 were removed without a failure, 2 are in use on 2026-11-23.") &&
                   Contains("Records begin on 2023-05-01. Put in before: 2; these count from their age") &&
                   Contains("Hours per week are those in which the job's program runs.") &&
                   Contains("without hours per week: 80 ("));
  }
}

TEST_CASE("service records: without a first day the first removal is it, and does not count") {
  const std::string table =
      "robot,installed,replaced,reason\nA,2024-01-01,2025-01-06,failed\nB,2024-01-01,2025-06-02,failed\nC,2025-03-03,,\n";
  const ServiceTests plant = read(table);
  const std::vector<ServiceRecord>& records = plant.tests.front().observation.service;
  REQUIRE(records.size() == 2);
  CHECK(records[0].entry_hours == Approx(53 * 80));
  CHECK(records[1].entry_hours == 0);
  CHECK_THAT(plant.words, Contains("Removed on that day, not counted: 1, of these failed: 1. --records-since") &&
                              Contains("without hours per week: 80 (fatigue.operating_hours_per_week of the job)") &&
                              !Contains("Hours per week are those"));
  CHECK(read(table, "2024-01-01").tests.front().observation.service.size() == 3);
  CHECK_THAT(refusal("robot,installed,replaced\nA,2024-01-01,\n"),
             Contains("has no dresspack that was removed") && Contains("--records-since"));
  CHECK_THAT(plant.words, !Contains("no failure counts"));
  CHECK_THAT(read("robot,installed,replaced,reason\nA,2024-01-01,2025-01-06,failed\nC,2024-03-03,,\n").words,
             Contains("no failure counts: the table's only failures (1) are on 2025-01-06, the day") &&
                 Contains("--records-since DATE"));
}

TEST_CASE("service records: what cannot be used is refused at its place, with a remedy") {
  const std::string titles = "robot,dresspack,installed,replaced,reason\n";
  const std::vector<std::array<std::string, 3>> cases{
      {"", "plant.csv:1:1: error: holds no table", "write the line"},
      {titles, "plant.csv:1:1: error: has titles and no row", "row per dresspack"},
      {"robot,installed\nA,2024-01-01\n", "plant.csv:1:1: error: the table has no column 'replaced'",
       "(it has robot, installed); add it, or rename one"},
      {"robot,roboter,installed,replaced\n", "plant.csv:1:7: error: columns 'robot' and 'roboter' both mean robot",
       "rename"},
      {titles + "A,a,03/02/2024,,\n", "plant.csv:2:5: error: '03/02/2024' is no date", "YYYY-MM-DD"},
      {titles + "A,a,2024-02-30,,\n", "plant.csv:2:5: error: '2024-02-30' is no date", "YYYY-MM-DD"},
      {titles + "A,a,2027-02-03,,\n", "plant.csv:2:5: error: 2027-02-03 is after today", "--today"},
      {titles + "A,a,2024-02-03,21/07/2025,preventive\n", "plant.csv:2:16: error: '21/07/2025' is no date",
       "write 2025-07-21"},
      {titles + "A,a,2024-02-03,45859,\n", "plant.csv:2:16: error: '45859' is no date",
       "write 2025-07-21 if that is the number of a spreadsheet"},
      {titles + "A,a,2024-02-03,soon,\n", "plant.csv:2:16: error: 'soon' is no date", "nothing while it is in use"},
      {titles + "A,a,2024-02-03,2024-01-03,failed\n", "plant.csv:2:16: error: replaced on 2024-01-03, before",
       "correct"},
      {titles + "A,a,2024-02-03,2025-01-03,\n", "plant.csv:2:27: error: a dresspack was removed and no reason",
       "failed or preventive"},
      {titles + "A,a,2024-02-03,2025-01-03,blue\n", "plant.csv:2:27: error: reason 'blue' does not say",
       "failed, preventive"},
      {titles + "A,a,2024-02-03,,failed\n", "plant.csv:2:16: error: the dresspack has a reason ('failed') and no date",
       "write when"},
      {titles + "A,a,2024-02-03\n", "plant.csv:2:5: error: a row of 3 cells (the table has 5 columns)",
       "fill its cells"},
      {titles + ",a,2024-02-03,,\n", "plant.csv:2:1: error: the robot has no name", "fill"},
      {titles + "A,a,2024-02-03,2025-01-03,failed\nA,a,2025-01-02,,\n",
       "plant.csv:3:1: error: 'A, a' is in use from 2025-01-02 on, and line 2 has it until 2025-01-03", "there twice"},
      {"robot,installed,replaced,hours in a week\nA,2024-02-03,,20\n",
       "plant.csv:1:26: error: column 'hours in a week' may mean hours_per_week, and is not known",
       "name it hours_per_week"},
      {"robot,installed,replaced,Operating Hours\nA,2024-02-03,,20\n",
       "plant.csv:1:26: error: column 'Operating Hours' may mean hours_per_week",
       "of an hour counter: its hours over the weeks"},
      {"robot,installed,replaced,hours_per_week\nA,2024-02-03,,200\n", "plant.csv:2:15: error: hours_per_week is '200'",
       "hours"}};
  // A dresspack that failed on its first day ends where the next begins: no overlap. A repeated row counts once.
  const std::string first_day = "A,a,2024-02-03,2024-02-03,failed\n";
  CHECK(refusal(titles + first_day + "A,a,2024-02-03,2025-01-03,failed\nA,a,2025-01-03,,\n") == "read");
  CHECK_THAT(refusal(titles + first_day + first_day),
             Contains("plant.csv:3:1: error: 'A, a' is in use from 2024-02-03"));
  for (const auto& [table, problem, remedy] : cases) {
    const std::string words = refusal(table);
    CHECK_THAT(words, Contains(problem) && Contains(remedy));
  }
  // All rows' at once.
  CHECK_THAT(refusal(titles + "A,a,2027-02-03,,\nB,a,2024-02-03,2024-01-03,failed\nC,a,2024-02-03,,\n"),
             Contains("plant.csv:2:5: error: 2027-02-03 is after") && Contains("plant.csv:3:16: error: replaced on"));
  CHECK_THAT(refusal("robot,installed,replaced,reason,job\nA,2024-01-01,2025-01-06,failed,none_such\n"),
             Contains("plant.csv:2:32"));
  CHECK_THAT(refusal(titles + "A,a,2024-01-01,2025-01-06,failed\n", "2025-06-01"),
             Contains("no dresspack was in use after 2025-06-01"));
}

TEST_CASE("service records: without a job the only one beside the table is meant") {
  Scratch scratch;
  const std::filesystem::path file =
      scratch.write("plant.csv", "robot,installed,replaced,reason\nA,2024-01-01,2025-01-06,failed\nB,2024-01-01,,\n");
  scratch.write("study.yaml", "base: irb6640_spot_welding\n");
  scratch.write("broken.yaml", "a: [\n");
  CHECK_THROWS_WITH(read_without_job(file), Contains("plant.csv:1:1: error: it is not known which job") &&
                                                Contains("give --job JOB.yaml, or a column job") &&
                                                !Contains("beside"));
  scratch.write("one.yaml", wire_job);
  const ServiceTests tests = read_without_job(file);
  CHECK_THAT(tests.words, Contains("Job: one.yaml, the only job beside the table."));
  CHECK(tests.tests.front().observation.name == "one");
  scratch.write("two.yaml", wire_job);
  CHECK_THROWS_WITH(read_without_job(file), Contains("Jobs beside the table: one.yaml, two.yaml"));
}

TEST_CASE("service records: reasons in German, and reasons that two readings explain") {
  const auto of = [](const std::string& reason) {
    return read("robot;installed;replaced;reason\nA;2024-01-01;2025-01-06;" + reason + "\nB;2024-01-01;;\n",
                "2024-01-01");
  };
  for (const char* failed :
       {"Leitung gerissen", "Aderbruch", "Schlauch geplatzt", "unplanmäßig", "außerplanmäßig", "Störung"})
    CHECK(of(failed).tests.front().observation.service.front().failed);
  for (const char* removed : {"Präventiv", "planmäßig", "vorbeugend, vor Bruch", "Crash", "Wartung"})
    CHECK_FALSE(of(removed).tests.front().observation.service.front().failed);
  // Unclear reasons: a cable broken by a crash, a cable that did not break, worn with or without failure.
  for (const char* unclear :
       {"Crash, Kabel gebrochen", "collision, cable broke", "nicht defekt", "not broken", "Kabel i.O., Zange defekt",
        "Kabelbruch verhindert", "cable ok, gun defect", "Verschleiß", "getauscht"})
    CHECK_THAT(refusal("robot;installed;replaced;reason\nA;2024-01-01;2025-01-06;" + std::string(unclear) + "\n"),
               Contains("does not say whether the dresspack failed"));
}

TEST_CASE("service records: a failure of a hose does not silently count as broken wires") {
  const auto words_of = [](const std::string& reason) {
    return read("robot;installed;replaced;reason\nA;2024-01-01;2025-01-06;failed\nB;2024-01-01;2025-01-07;" + reason +
                    "\nC;2024-01-01;2025-01-08;" + reason + "\nD;2024-01-01;;\n",
                "2024-01-01")
        .words;
  };
  for (const char* hose : {"hose cracked - failure", "Schlauch geplatzt", "Wellrohr gebrochen", "Rotura de la manguera",
                           "broken: outer jacket"})
    CHECK_THAT(words_of(hose), Contains("plant.csv:3:1: warning: ") && Contains("counts as broken wires (line 3, 4)") &&
                                   Contains("write preventive") && Contains("3 failed"));
  for (const char* other :
       {"cable broke", "those cables failed", "hose pack failed", "Schlauchpaket defekt", "preventive: hose worn"})
    CHECK_THAT(words_of(other), !Contains("warning"));
}

TEST_CASE("service records: dresspacks of several names that count as one job are named") {
  const std::string titles = "robot,dresspack,installed,replaced,reason\n", ends = ",2024-01-01,2025-01-06,failed\n";
  CHECK_THAT(read(titles + "A,roof" + ends + "A,floor" + ends, "2024-01-01").words,
             Contains("'floor', 'roof' all count as "));
  CHECK_THAT(read(titles + "A,roof" + ends + "B,roof" + ends, "2024-01-01").words, !Contains("all count as"));
}

TEST_CASE("service records: the report names unused columns and the reasons that count as broken wires") {
  const std::string titles = "robot,installed,replaced,reason,quantity,counter\n";
  const std::string words = read(titles +
                                     "A,2024-01-01,2025-01-06,gun defect,4,900\nB,2024-01-01,2025-01-07,failed,1,800\n"
                                     "C,2024-01-01,2025-01-08,gun defect,1,\nD,2024-01-01,2025-01-09,planned,1,\n",
                                 "2024-01-01")
                                .words;
  CHECK_THAT(words, Contains("Not used: 'quantity', 'counter'.") &&
                        Contains("Counted as broken wires by their reasons: 'failed' (1), 'gun defect' (2).\n"));
  CHECK_THAT(read("robot,installed,replaced,reason\nA,2024-01-01,2025-01-06,planned\n", "2024-01-01").words,
             !Contains("Not used") && !Contains("broken wires"));
}

TEST_CASE("service records: one dresspack under two spellings counts once") {
  const auto table = [](const std::string& name, const std::string& until) {
    return "robot,dresspack,installed,replaced,reason\nR 2,A,2024-01-01,2025-01-06,failed\n" + name + ",2024-01-01," +
           until + ",failed\n";
  };
  for (const char* name : {"r2,A", "R  2,a", "R2,A"})
    CHECK_THAT(refusal(table(name, "2025-01-06"), "2024-01-01"),
               Contains("plant.csv:3:1: error: ") && Contains("and line 2 has it until 2025-01-06"));
  CHECK(refusal(table("R 3,A", "2025-01-06"), "2024-01-01") == "read");
}

TEST_CASE("service records: failures of one age on one day are doubted") {
  const auto words_of = [](int alike, int others) {
    std::string table = "robot,installed,replaced,reason\n";
    for (int k = 0; k < alike; ++k) table += fmt::format("A{},2024-01-01,2025-01-06,failed\n", k);
    for (int k = 0; k < others; ++k) table += fmt::format("B{},2024-01-01,2025-02-{:02},failed\n", k, k + 1);
    return read(table, "2024-01-01").words;
  };
  CHECK_THAT(words_of(4, 1),
             Contains("plant.csv:2:1: warning: 4 of 5 failures are of dresspacks that were installed on "
                      "2024-01-01 and replaced on 2025-01-06"));
  CHECK_THAT(words_of(3, 3), Contains("3 of 6 failures"));
  for (const auto& [alike, others] : {std::pair(3, 4), {2, 0}})
    CHECK_THAT(words_of(alike, others), !Contains("warning"));
}

TEST_CASE("service records: titles and reasons in Spanish") {
  const auto of = [](const std::string& titles, const std::string& reason) {
    return read(titles + "\nA;x;2024-01-01;2025-01-06;" + reason + ";76\nB;x;2024-01-01;;;76\n", "2024-01-01");
  };
  const std::string plain = "Robot;Paquete;Fecha de instalacion;Fecha de sustitucion;Motivo;Horas por semana";
  for (const std::string& titles :
       {plain, std::string("M\u00e1quina;Mazo de cables;Fecha de instalaci\u00f3n;Reemplazado;Raz\u00f3n;h/semana")}) {
    const auto service = of(titles, "Rotura de cable").tests.front().observation.service;
    CHECK(service.front().failed);
    CHECK(service.size() == 2);
  }
  for (const char* failed : {"Aver\u00eda", "mantenimiento correctivo", "fallo", "no programado", "Falla"})
    CHECK(of(plain, failed).tests.front().observation.service.front().failed);
  for (const char* removed : {"preventivo", "Mantenimiento programado", "colisi\u00f3n", "inspecci\u00f3n"})
    CHECK_FALSE(of(plain, removed).tests.front().observation.service.front().failed);
  for (const char* unclear : {"sin fallo", "desgaste", "average wear"})
    CHECK_THAT(refusal(plain + "\nA;x;2024-01-01;2025-01-06;" + std::string(unclear) + ";76\n"),
               Contains("does not say whether the dresspack failed"));
}

TEST_CASE("service records: a dresspack of several programs has their shares of its hours") {
  const File job(
      "two.yaml",
      "motion: {rig: {kind: axial, elongation_percent: 0.2}}\ndresspack: {cable: {name: wire, source: test, radius_mm: "
      "0.1, components: [{name: strand, radius_mm: 0.1, helix_radius_mm: 0, material: copper_halved}]}}\n");
  const std::string name = job.path.string(),
                    titles = "robot;installed;replaced;reason;job\nA;2024-01-01;2025-01-06;failed;";
  const ServiceTests plant =
      read(titles + name + " 60 % + " + name + " 25,5 %\nB;2024-01-01;;;" + name + "\n", "2024-01-01");
  REQUIRE(plant.tests.size() == 2);
  const auto& programs = plant.tests.front().variants;
  REQUIRE(programs.size() == 2);
  CHECK(programs[0].share_of_time == Approx(0.6));
  CHECK(programs[1].share_of_time == Approx(0.255));
  CHECK(programs[0].name != programs[1].name);
  REQUIRE(plant.tests.back().variants.size() == 1);
  CHECK(plant.tests.back().variants.front().share_of_time == 1);
  for (const auto& [cell, words] : {std::pair{name + " 70 % + " + name + " 40 %",
                                              "plant.csv:2:32: error: the shares of the programs add up to 110 %"},
                                    {name + " 70 % + 40 %", "'40' is no job with its share"},
                                    {name + " 70 % + " + name + " 0 %", "is no job with its share"}})
    CHECK_THAT(refusal(titles + cell + "\n", "2024-01-01"), Contains(words));
}

TEST_CASE("service records: hours of a day in the column of a week are doubted, hours of a week are not") {
  const auto words_with = [](const std::string& hours) {
    return read("robot,installed,replaced,reason,hours_per_week\nR1,2024-01-01,2024-12-30,failed," + hours +
                "\nR2,2024-02-01,,," + hours + "\n")
        .words;
  };
  for (const char* hours : {"8", "16", "24"})
    CHECK_THAT(
        words_with(hours),
        Contains("plant.csv:3:1: warning: hours_per_week of 'R2' is " + std::string(hours) + " (limit more than 24)") &&
            Contains(fmt::format("hours_per_week: {} if that was per working day", 5 * std::stoi(hours))));
  for (const char* hours : {"40", "120", "168"}) CHECK_THAT(words_with(hours), !Contains("hours_per_week of"));
}

TEST_CASE("service records: ages that no dresspack has, and failures of the first days, are doubted") {
  const auto words_with = [](const std::string& row) {
    return read("robot,installed,replaced,reason,hours_per_week\n" + row + "\nR2,2024-02-01,,,70\n", "1960-01-01")
        .words;
  };
  CHECK_THAT(
      words_with("R1,1970-03-02,2026-02-14,failed,80"),
      Contains("plant.csv:2:1: warning: 'R1' was installed 20438 days before 2026-02-14 (limit 7300: 20 years)") &&
          Contains("Likely cause: the date of the robot, or a wrong year") && Contains("Remedy: installed: "));
  CHECK_THAT(words_with("R1,2014-01-06,2026-01-05,planned,80"),
             Contains("'R1' ran 50,100 h until 2026-01-05 (limit 40,000 h: the robot's life)"));
  CHECK_THAT(words_with("R1,2026-02-14,2026-02-15,failed,80"),
             Contains("'R1' failed 1 day after its installation (limit 7 or more)") && Contains("preventive"));
  for (const char* likely : {"R1,2026-02-14,2026-02-15,planned,80", "R1,2026-02-14,2026-02-21,failed,80",
                             "R1,2017-01-02,2026-02-14,failed,80"})
    CHECK_THAT(words_with(likely), !Contains("warning"));
  std::string many;
  for (int k = 0; k < 7; ++k) many += fmt::format("A{},1970-03-02,2025-02-{:02},failed,80\n", k, k + 1);
  CHECK_THAT(words_with(many + "B,2024-02-01,,,70"),
             Contains("'A4' was") && !Contains("'A5' was") && Contains("2 further rows have unlikely ages.\n"));
}
