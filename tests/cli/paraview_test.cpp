// dresslife export: the data that ParaView reads of a job at every time agree with the job's files.
#include <Eigen/Geometry>
#include <map>
#include <sstream>

#include "pipeline/files/files.h"
#include "tests/catch.h"
#include "tests/cli/process.h"

using namespace dresslife;
using namespace dresslife::tests;

namespace {

constexpr double text_rounding = 5.1e-5;  // [m]: positions in the text have a tenth of a millimetre

/// Writes a job with two dresspacks between a bench and a turning spindle, which has a capsule and a box.
void write_spindle_job(const Scratch& scratch) {
  const std::string hose = R"({name: hose, source: made for the tests, diameter_mm: 40, mass_kg_per_m: 1.5,
    bending_stiffness_Nm2: 2, torsional_stiffness_Nm2: 2, axial_stiffness_N: 1e5, damping_time_ms: 40,
    damping_source: made for the tests, components: [{name: core, count: 4, radius_mm: 0.1, helix_radius_mm: 4,
    lay_angle_deg: 20, material: copper}]})";
  const auto routing = [](const std::string& y) {
    return "{free_length_m: 1.1, base_clamp: {link: bench, position_m: [0, " + y +
           ", 1], direction: [1, 0, 0]}, tool_clamp: {link: spindle, position_m: [1, " + y +
           ", 0], direction: [1, 0, 0]}}";
  };
  scratch.write("job.yaml", R"(robot:
  name: spindle
  source: made for the tests
  joints:
    - {name: spindle, origin_m: [0, 0, 1], axis: [1, 0, 0], lower_deg: -400, upper_deg: 400, speed_deg_per_s: 90,
       acceleration_deg_per_s2: 300}
  links:
    - {name: bench}
    - {name: spindle, capsules: [{from_m: [0.2, 0, -0.3], to_m: [0.8, 0.1, -0.3], radius_mm: 50}],
       boxes: [{position_m: [0.5, 0, -0.6], sides_m: [0.1, 0.2, 0.3]}]}
motion:
  name: turn
  steps: [{text: start, joints_deg: [0]}, {text: turn, joints_deg: [40]}, {text: back, joints_deg: [0]}]
dresspacks:
  - {name: one, dresspack: )" + hose +
                                ", routing: " + routing("0") + "}\n  - {name: two, dresspack: " + hose +
                                ", routing: " + routing("0.6") + R"(}
simulation: {segments: 8, sample_rate_Hz: 25}
strain: {slip: stick}
)");
}

const char* reads_every_moment = R"(
from paraview.simple import *
from paraview import servermanager
from vtkmodules.util.numpy_support import vtk_to_numpy
reader = XDMFReader(FileNames=['job.xdmf'])
reader.UpdatePipelineInformation()
for moment in reader.TimestepValues:
    reader.UpdatePipeline(moment)
    for k, name in enumerate(('dresspack', 'robot')):
        grid = servermanager.Fetch(reader).GetBlock(k)
        values = {'places': grid.GetPoints().GetData()}
        for data in (grid.GetPointData(), grid.GetCellData()):
            values.update((data.GetArrayName(i), data.GetArray(i)) for i in range(data.GetNumberOfArrays()))
        for what, array in values.items():
            print(repr(moment), name, what.replace(' ', '_'), *(repr(float(x)) for x in vtk_to_numpy(array).flat))
)";

/// Numbers that ParaView has read, by grid and name, one row per time.
struct Read {
  std::vector<double> times;
  std::map<std::string, std::vector<std::vector<double>>> rows;
};
Read read_by_paraview(const Scratch& scratch) {
  scratch.write("read.py", reads_every_moment);
  const Outcome outcome = run_shell(scratch, "timeout 120 pvpython --force-offscreen-rendering read.py");
  INFO(outcome.err);
  REQUIRE(outcome.status == 0);
  CHECK(outcome.err.find("ERR") == std::string::npos);
  Read read;
  std::istringstream lines(outcome.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    double time, value;
    std::string grid, what;
    REQUIRE(words >> time >> grid >> what);
    if (read.times.empty() || read.times.back() != time) read.times.push_back(time);
    auto& row = read.rows[grid + " " + what].emplace_back();
    while (words >> value) row.push_back(value);
  }
  return read;
}

/// Returns the numbers `first`, `first` + `stride`, ... of a row of `width` numbers.
std::vector<double> part(const std::vector<double>& all, std::size_t row, std::size_t width, std::size_t first = 0,
                         std::size_t stride = 1) {
  std::vector<double> taken;
  for (std::size_t k = row * width + first; k < (row + 1) * width; k += stride) taken.push_back(all[k]);
  return taken;
}

}  // namespace

TEST_CASE("ParaView reads every moment of a job: places, fields and links as its files hold them") {
  Scratch scratch;
  write_spindle_job(scratch);
  must_run(scratch, "dresslife", "run job.yaml --quiet");
  const std::string worst =
      pipeline::FileReader(scratch / "runs/job/job/life.h5", pipeline::life_format()).text_attribute("worst_dresspack");
  must_run(scratch, "dresslife", "plot runs/job/job --what deformation --time 1 -o deformed.svg");
  CHECK(content(scratch / "deformed.svg").find("Deformation of the " + worst + " at 1.00 s") != std::string::npos);
  must_run(scratch, "dresslife", "export runs/job/job --paraview job.xdmf");
  if (std::system("command -v pvpython >/dev/null 2>&1") != 0) {
    WARN("pvpython is not installed: ParaView was not asked");
    return;
  }
  const Read read = read_by_paraview(scratch);
  const fs::path job = scratch / "runs/job/job";
  const pipeline::FileReader motion(job / "motion.h5", pipeline::motion_format()),
      strain(job / "strain.h5", pipeline::strain_format()), life(job / "life.h5", pipeline::life_format());
  const auto times = motion.read<double>("/time"), position = motion.read<double>("/segment/position"),
             tension = motion.read<double>("/tension"), pose = motion.read<double>("/robot/link_pose"),
             curvature = strain.read<double>("/deformation/curvature"),
             twist = strain.read<double>("/deformation/twist"),
             elongation = strain.read<double>("/deformation/elongation"), damage = life.read<double>("/segment/damage");
  REQUIRE(read.times.size() == times.size());
  const std::size_t segments = damage.size();
  REQUIRE(segments == 16);
  const Eigen::Vector3d capsule[] = {{0.2, 0, -0.3}, {0.8, 0.1, -0.3}}, corner(0.45, -0.1, -0.75);
  double farthest = 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto row = [&](const char* name) { return read.rows.at(name).at(k); };
    REQUIRE(read.times[k] == Approx(times[k]).margin(1e-12));
    REQUIRE(row("dresspack tension_[N]") == part(tension, k, segments));
    REQUIRE(row("dresspack curvature_1_[1_m]") == part(curvature, k, 2 * segments, 0, 2));
    REQUIRE(row("dresspack curvature_2_[1_m]") == part(curvature, k, 2 * segments, 1, 2));
    REQUIRE(row("dresspack twist_[rad_m]") == part(twist, k, segments));
    REQUIRE(row("dresspack elongation") == part(elongation, k, segments));
    REQUIRE(row("dresspack damage_per_repeat") == damage);
    const auto places = row("dresspack places"), links = row("robot places");
    REQUIRE(places.size() == 3 * segments);
    for (std::size_t i = 0; i < places.size(); ++i)
      REQUIRE(std::abs(places[i] - position[3 * segments * k + i]) < text_rounding);
    // Two ends of the capsule, then the box beginning with its lower face.
    REQUIRE(links.size() == 3 * (2 + 8));
    const double* p = &pose[7 * (2 * k + 1)];
    const Eigen::Quaterniond turned(p[3], p[4], p[5], p[6]);
    const Eigen::Vector3d at(p[0], p[1], p[2]);
    for (const auto& [point, own] : {std::pair{0, capsule[0]}, {1, capsule[1]}, {2, corner}})
      REQUIRE((Eigen::Map<const Eigen::Vector3d>(&links[3 * static_cast<std::size_t>(point)]) - at - turned * own)
                  .cwiseAbs()
                  .maxCoeff() < text_rounding);
    farthest = std::max(farthest, std::abs(links[1] - read.rows.at("robot places")[0][1]));
    REQUIRE(row("robot link") == std::vector<double>{1, 1});
    REQUIRE(row("robot radius_[m]")[0] == Approx(0.05).epsilon(1e-6));
  }
  CHECK(farthest > 0.1);  // the link has moved
}
