#include "pipeline/report/job_page.h"

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <random>

#include "pipeline/base/whole_file.h"
#include "pipeline/report/cross_section.h"
#include "pipeline/report/json.h"
#include "pipeline/report/key_samples.h"
#include "pipeline/report/page_shell.h"
#include "pipeline/report/scene_data.h"
#include "pipeline/report/simple_mesh.h"
#include "pipeline/resolve/job_text.h"
#include "tests/catch.h"
#include "tests/pipeline/sample_life.h"
#include "tests/pipeline/scratch.h"

namespace dresslife::pipeline {
namespace {

constexpr std::size_t most_bytes = 5'000'000;  // of a page of a motion of three minutes

TEST_CASE("json: texts stay inside their element, numbers read back") {
  CHECK(Json("a\"b\\c\n</script>&").text == R"("a\"b\\c\u000a\u003c/script\u003e\u0026")");
  CHECK(Json(0.1).text == "0.1");
  CHECK(std::stod(Json(1.0 / 3).text) == 1.0 / 3);
  CHECK(Json(std::numeric_limits<double>::infinity()).text == "null");
  CHECK(Json(std::vector<double>{1, 2.5}).text == "[1,2.5]");
}

TEST_CASE("json: objects hold values of all kinds, and grow") {
  CHECK(Json({}).text == "{}");
  const Json inner{{"a", 1}, {"b", "x"}};
  CHECK(inner.text == R"({"a":1,"b":"x"})");
  CHECK(Json({}).add("c", inner).add("d", false).text == R"({"c":{"a":1,"b":"x"},"d":false})");
  CHECK(Json{{"e", std::vector<Json>{inner, 2}}}.add(inner).add(Json({})).text ==
        R"({"e":[{"a":1,"b":"x"},2],"a":1,"b":"x"})");
}

TEST_CASE("json: base64 as RFC 4648 has it") {
  CHECK(base64("") == "");
  CHECK(base64("f") == "Zg==");
  CHECK(base64("fo") == "Zm8=");
  CHECK(base64("foobar") == "Zm9vYmFy");
  CHECK(base64(std::string_view("\xff\x00\x80", 3)) == "/wCA");
}

TEST_CASE("json: whole steps miss by half a step") {
  const Steps steps(-1.25, 3.5);
  for (double value = -1.25; value <= 3.5; value += 0.0371)
    // Rounding of low + step n: one ulp of 3.5.
    CHECK(std::abs(steps.value(steps.of(value)) - value) <= steps.step / 2 + 1e-15);
  CHECK(Steps(2, 2).of(2) == 0);
}

TEST_CASE("key samples: a straight line needs its ends, corners are kept") {
  Histories straight{{0, 1, 2, 3.5, 4}, 1, {0, 2, 4, 7, 8}};
  CHECK(key_samples(straight, {1e-9}) == std::vector<std::size_t>{0, 4});
  Histories corner{{0, 1, 2, 3, 4}, 1, {0, 1, 2, 1, 0}};
  CHECK(key_samples(corner, {1e-9}) == std::vector<std::size_t>{0, 2, 4});
  Histories one{{3}, 1, {5}};
  CHECK(key_samples(one, {1}) == std::vector<std::size_t>{0});
}

TEST_CASE("key samples: nothing is missed by more than its tolerance, and fewer are kept where more is allowed") {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  Histories walk;
  walk.width = 3;
  std::vector<double> now(3, 0.0);
  for (int k = 0; k < 2000; ++k) {
    walk.time.push_back(0.04 * k + 0.01 * (k % 3));
    for (double& x : now) walk.rows.push_back(x += normal(random));
  }
  std::size_t before = walk.time.size() + 1;
  for (const double allowed : {0.5, 2.0, 8.0}) {
    const auto keys = key_samples(walk, {allowed, 2 * allowed, 4 * allowed});
    const auto miss = largest_misses(walk, keys);
    for (std::size_t q = 0; q < 3; ++q) CHECK(miss[q] <= allowed * (1 << q) * (1 + 1e-9));  // rounding of slopes
    CHECK(keys.back() == walk.time.size() - 1);
    CHECK(keys.size() < before);
    before = keys.size();
  }
}

/// Returns a ball of 2 n^2 triangles, radius 1.
std::vector<Triangle> ball(int n) {
  const auto corner = [n](int i, int j) {
    const double theta = M_PI * i / n, phi = 2 * M_PI * j / n;
    return Eigen::Vector3d(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  };
  std::vector<Triangle> triangles;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      triangles.push_back({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      triangles.push_back({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return triangles;
}

TEST_CASE("simple mesh: few triangles stay, many become few near the surface") {
  CHECK(simplified(ball(10), 200).size() == 200);
  const auto few = simplified(ball(100), 2000);
  CHECK(few.size() <= 2000);
  CHECK(few.size() > 300);
  double area = 0;
  for (const Triangle& triangle : few) {
    area += (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).norm() / 2;
    // A corner is replaced by the mean of corners in a cube with edge 0.128, the first of 2/1000 2^k that leaves few enough. Its
    // error is within the cube's diagonal.
    for (const auto& corner : triangle) CHECK(std::abs(corner.norm() - 1) < 0.128 * std::sqrt(3.0));
  }
  CHECK(area == Approx(4 * M_PI).epsilon(0.15));  // flat triangles of this size cut into the ball
}

TEST_CASE(
    "cross-section: wires are distinguished by the paths that the files have, layer after layer and part after part") {
  Dresspack dresspack;
  Component wire, cable, tube;
  wire.name = "wire";
  wire.layer = "layer 1";
  wire.count = 2;
  cable.name = "cable";
  cable.count = 2;
  cable.components = {wire};
  tube.name = "tube";
  tube.plain = PlainPart{};
  dresspack.components = {tube, cable, wire};
  CHECK(wire_paths(dresspack) == std::vector<std::string>{"cable 1/layer 1/wire 1", "cable 1/layer 1/wire 2",
                                                          "cable 2/layer 1/wire 1", "cable 2/layer 1/wire 2",
                                                          "layer 1/wire 1", "layer 1/wire 2"});
}

TEST_CASE("scene data: shapes in their frames, and a mesh that is lost is reported") {
  const Scratch scratch;
  std::ofstream(scratch / "gun.obj") << "v 0 0 0\nv 1000 0 0\nv 0 500 0\nf 1 2 3\n";
  Setup setup;
  Link link{"</script>", {{{0, 0, 0}, {0, 0, 1}, 0.2}}, {}, {}};
  link.boxes.push_back({{1, 2, 3}, {0, 0, M_PI / 2}, {0.1, 0.2, 0.3}});
  link.meshes.push_back({scratch / "gun.obj", 1e-3, Vector3d::Zero(), Vector3d::Zero()});
  setup.robot.links = {link};
  std::vector<std::string> notes;
  const std::string text = scene_data(setup, notes).text;
  CHECK(notes.empty());
  CHECK(text.find("</script>") == std::string::npos);
  CHECK(text.find(R"("kind":"capsule","from":[0,0,0],"to":[0,0,1],"radius":0.2)") != std::string::npos);
  CHECK(text.find(R"("kind":"box","position":[1,2,3],"quaternion":[0,0,0.707106781186547)") != std::string::npos);
  // 0 .. 1 m in 65535 steps; corners 0 0 0, 1 0 0, 0 0.5 0.
  CHECK(text.find(R"("low":0,"step":1.5259021896696422e-05,"triangles":"AAAAAAAA//8AAAAAAAAAgAAA")") !=
        std::string::npos);
  std::filesystem::remove(scratch / "gun.obj");
  scene_data(setup, notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0].find("gun.obj: error: cannot be read") != std::string::npos);
}

TEST_CASE("job page: a life alone makes a page, whatever its names are") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "";
  SampleLife life;
  life.worst_component = "</script><img src=x onerror=alert(1)>/wire 1";
  life.line_name = "<!--<script>\"'&";
  life.job = "robot: {name: \"</pre><script>alert(2)</script>\"}\n";
  write_sample_life(scratch / "life.h5", life);
  const JobFolder files{"</title><b>job & \"co\"", folder};
  const std::string page = job_page(files);
  CHECK(page.size() < most_bytes);
  CHECK(page.starts_with("<!DOCTYPE html>\n<!-- Written by dresslife; "));
  CHECK(page.find(" -->\n<html lang=\"en\">\n<!-- dresslife page made from ") != std::string::npos);
  for (const char* hostile : {"<img", "onerror=alert(1)>", "<script>alert", "</title><b>", "<!--<script>"}) {
    INFO(hostile);
    CHECK(page.find(hostile) == std::string::npos);
  }
  CHECK(page.find("<h1>&lt;/title&gt;&lt;b&gt;job &amp; &quot;co&quot;</h1>") != std::string::npos);
  CHECK(page.find("motion.h5 is not there") != std::string::npos);
  CHECK(page.find("strain.h5 is not there") != std::string::npos);
  const std::string from = "relative to the study's folder, which contains that of this page";
  CHECK(page.find(from) == std::string::npos);
  life.warnings = warnings_text({{WarningKind::motion, "job/job.yaml:4:3", "too fast"}});
  write_sample_life(scratch / "life.h5", life);
  CHECK(job_page(files).find(from) != std::string::npos);
}

TEST_CASE("job page: nothing is fetched from anywhere") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "";
  write_sample_life(scratch / "life.h5");
  ::setenv("DRESSLIFE_THREE", folder.c_str(), 1);
  const std::string page = job_page({"job", folder});
  ::unsetenv("DRESSLIFE_THREE");
  for (const char* word : {"http", "<link", "@import", "url(", "<script src", "<iframe"}) {
    INFO(word);
    CHECK(page.find(word) == std::string::npos);
  }
  CHECK(page.find("apt-get install libjs-three") != std::string::npos);
}

TEST_CASE("job page: made again when a result or the page's own parts change, else left alone") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "";
  SampleLife life;
  write_sample_life(scratch / "life.h5", life);
  const JobFolder files{"job", folder};
  CHECK(refresh_job_page(files));
  const FileState first = state_of(files.page());
  CHECK_FALSE(refresh_job_page(files));
  CHECK(state_of(files.page()) == first);
  life.repeats = 500;
  write_sample_life(scratch / "life.h5", life);
  CHECK(refresh_job_page(files));
  CHECK_FALSE(refresh_job_page(files));
  std::ofstream(scratch / "three.min.js") << "window.THREE = {};";
  std::filesystem::create_directories(scratch / "examples/js/controls");
  std::ofstream(scratch / "examples/js/controls/OrbitControls.js") << "THREE.OrbitControls = 1;";
  ::setenv("DRESSLIFE_THREE", folder.c_str(), 1);
  CHECK(refresh_job_page(files));
  CHECK(read_text(files.page()).find("<script>window.THREE = {};</script>") != std::string::npos);
  ::unsetenv("DRESSLIFE_THREE");
}

TEST_CASE("job page: one of other results than those beside it is removed, and nothing else") {
  const Scratch scratch;
  const JobFolder files{"job", scratch / ""};
  SampleLife life;
  write_sample_life(scratch / "life.h5", life);
  remove_old_job_page(files);  // without an old page
  refresh_job_page(files);
  remove_old_job_page(files);
  CHECK(std::filesystem::exists(files.page()));
  life.repeats = 500;
  write_sample_life(scratch / "life.h5", life);
  remove_old_job_page(files);
  CHECK_FALSE(std::filesystem::exists(files.page()));
  std::ofstream(files.page()) << "<html>somebody's own</html>";
  remove_old_job_page(files);
  remove_job_page(files);
  CHECK(std::filesystem::exists(files.page()));
}

TEST_CASE("job page: without damage, without wires, with several dresspacks") {
  const Scratch scratch;
  const std::filesystem::path folder = scratch / "";
  SampleLife life;
  SECTION("no damage") { life.repeats = std::numeric_limits<double>::infinity(); }
  SECTION("no failure") { life.planned_hours = std::numeric_limits<double>::infinity(); }
  SECTION("no wires") { life.wires = false; }
  SECTION("two dresspacks") { life.dresspacks = {"hose", "sensor <cable>"}; }
  SECTION("one sample") { life.samples = 1; }
  write_sample_life(scratch / "life.h5", life);
  const std::string page = job_page({"job", folder});
  const std::size_t begin = page.find("id=\"data\">");
  const std::string data = page.substr(begin, page.find("</script>", begin) - begin);
  for (const char* word : {"nan", "inf", "<"}) CHECK(data.find(word) == std::string::npos);
  CHECK(page.find("after no damage") == std::string::npos);
}

}  // namespace
}  // namespace dresslife::pipeline
