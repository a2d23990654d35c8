#include "pipeline/report/paraview.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <iterator>
#include <vector>

#include "pipeline/base/plain_file.h"
#include "pipeline/files/files.h"
#include "pipeline/files/motion_layout.h"
#include "pipeline/job/setup.h"
#include "pipeline/report/plot.h"
#include "pipeline/report/stored_job.h"

namespace dresslife::pipeline {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a file relative to the XDMF file, in the form that its reader needs in front of a dataset's path.
std::string name_from(const fs::path& output, const fs::path& file) {
  return escaped(fs::proximate(file, output.has_parent_path() ? output.parent_path() : fs::path(".")).generic_string());
}

/// References to one row of a dataset, or to one number per segment in one row.
class Slab {
 public:
  Slab(std::string file, std::size_t rows, std::size_t segments)
      : file_(std::move(file)), rows_(rows), segments_(segments) {}

  std::string scalars(const std::string& dataset, std::size_t sample, int bytes) const {
    return slab(dataset, fmt::format("{} 0 1 1 1 {}", sample, segments_), fmt::format("{} {}", rows_, segments_), "3 2",
                fmt::format("{}", segments_), bytes);
  }
  /// Returns a reference to component `k` of a dataset of pairs.
  std::string component(const std::string& dataset, std::size_t sample, int k, int bytes) const {
    return slab(dataset, fmt::format("{} 0 {} 1 1 1 1 {} 1", sample, k, segments_),
                fmt::format("{} {} 2", rows_, segments_), "3 3", fmt::format("{}", segments_), bytes);
  }
  std::string constant(const std::string& dataset) const {
    return fmt::format(
        "<DataItem Dimensions=\"{}\" NumberType=\"Float\" Precision=\"8\" Format=\"HDF\">{}:{}</DataItem>", segments_,
        file_, dataset);
  }

 private:
  std::string slab(const std::string& dataset, const std::string& selection, const std::string& whole,
                   const char* shape, const std::string& result, int bytes) const {
    return fmt::format(
        "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}\"><DataItem Dimensions=\"{1}\" "
        "Format=\"XML\">{2}</DataItem>"
        "<DataItem Dimensions=\"{3}\" NumberType=\"Float\" Precision=\"{4}\" "
        "Format=\"HDF\">{5}:{6}</DataItem></DataItem>",
        result, shape, selection, whole, bytes, file_, dataset);
  }

  std::string file_;
  std::size_t rows_, segments_;
};

std::string attribute(const char* name, const char* centre, std::size_t values, const std::string& item) {
  return fmt::format("<Attribute Name=\"{}\" Center=\"{}\" Dimensions=\"{}\">{}</Attribute>\n", name, centre, values,
                     item);
}

/// Returns positions to a tenth of a millimetre. They are in the text, because ParaView rejects positions in parts of a dataset.
std::string geometry(std::size_t points, const std::string& places) {
  return fmt::format(
      "<Geometry GeometryType=\"XYZ\"><DataItem Dimensions=\"{} 3\" "
      "Format=\"XML\">{}</DataItem></Geometry>\n",
      points, places);
}
void add_place(std::string& places, const Vector3d& at) {
  fmt::format_to(std::back_inserter(places), "{:.4f} {:.4f} {:.4f} ", at.x(), at.y(), at.z());
}

/// Returns numbers that are repeated at every time step, because a reference to one list makes the Xdmf3 readers abort.
std::string numbers(std::size_t count, const char* type, const std::string& values) {
  return fmt::format("<DataItem Dimensions=\"{}\" NumberType=\"{}\" Format=\"XML\">{}</DataItem>", count, type, values);
}

// ---- the robot --------------------------------------------------------------------------------------------

/// Shapes of the links: every capsule is a line of two points, every box has eight points, in the frames of their links.
class Shapes {
 public:
  explicit Shapes(const Robot& robot) {
    for (std::size_t link = 0; link < robot.links.size(); ++link) {
      for (const Capsule& capsule : robot.links[link].capsules) {
        // cell type 2: a line, with its number of points
        cells_ += fmt::format("2 2 {} {} ", points_.size(), points_.size() + 1);
        add_cell(link, capsule.radius);
        points_.push_back({link, capsule.from});
        points_.push_back({link, capsule.to});
      }
      for (const Box& box : robot.links[link].boxes) add_box(link, box);
    }
  }

  bool empty() const { return points_.empty(); }

  std::string grid(const std::vector<double>& pose) const {
    std::string places;
    for (const auto& [link, point] : points_) {
      const double* p = &pose[7 * link];
      const Vector3d at = Vector3d(p[0], p[1], p[2]) + Eigen::Quaterniond(p[3], p[4], p[5], p[6]) * point;
      add_place(places, at);
    }
    return fmt::format(
        "<Grid Name=\"robot\"><Topology TopologyType=\"Mixed\" "
        "NumberOfElements=\"{}\">{}</Topology>\n{}{}{}</Grid>\n",
        count_, numbers(numbers_, "Int", cells_), geometry(points_.size(), places),
        attribute("radius [m]", "Cell", count_, numbers(count_, "Float", radii_)),
        attribute("link", "Cell", count_, numbers(count_, "Int", links_)));
  }

 private:
  void add_cell(std::size_t link, double radius, std::size_t numbers = 4) {
    ++count_;
    numbers_ += numbers;
    radii_ += fmt::format("{:.6g} ", radius);
    links_ += fmt::format("{} ", link);
  }

  void add_box(std::size_t link, const Box& box) {
    const Eigen::Quaterniond turn = from_roll_pitch_yaw(box.orientation);
    cells_ += "9 ";  // cell type 9: a hexahedron, first its lower face, then its upper face
    for (int corner = 0; corner < 8; ++corner)
      cells_ += fmt::format("{} ", points_.size() + static_cast<std::size_t>(corner));
    add_cell(link, 0, 9);
    for (const double z : {-0.5, 0.5})
      for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}})
        points_.push_back({link, box.position + turn * box.sides.cwiseProduct(Vector3d(x, y, z))});
  }

  std::vector<std::pair<std::size_t, Vector3d>> points_;  // (link, position in its frame)
  std::string cells_, radii_, links_;
  std::size_t count_ = 0, numbers_ = 0;
};

// ---- the dresspacks ---------------------------------------------------------------------------------------

/// A line through the segments of each dresspack.
struct HoseLines {
  std::size_t lines = 0;
  std::string cells, radii;  ///< text of XDMF data items

  HoseLines(const std::vector<std::size_t>& dresspack_of_segment, const Setup& setup) {
    std::string points_of_lines, radius_of_each;
    std::size_t count = 0;
    for (std::size_t first = 0; first < dresspack_of_segment.size();) {
      std::size_t end = first;
      while (end < dresspack_of_segment.size() && dresspack_of_segment[end] == dresspack_of_segment[first]) ++end;
      points_of_lines += fmt::format("2 {} ", end - first);
      for (std::size_t k = first; k < end; ++k) {
        points_of_lines += fmt::format("{} ", k);
        radius_of_each += fmt::format("{:.6g} ", setup.dresspacks.at(dresspack_of_segment[k]).dresspack.diameter / 2);
      }
      ++lines;
      count += 2 + end - first;
      first = end;
    }
    cells = numbers(count, "Int", points_of_lines);
    radii = numbers(dresspack_of_segment.size(), "Float", radius_of_each);
  }
};

}  // namespace

std::string xdmf_text(const JobFiles& files, const fs::path& output) {
  const FileReader motion(files.motion, motion_format());
  check_of_one_job(files);
  const bool strain = kind_of(files.strain) != FileKind::absent, life = kind_of(files.life) != FileKind::absent;
  const Setup setup = setup_from(stored_job(motion));
  const std::vector<double> times = motion.read<double>("/time");
  const std::vector<std::size_t> of_segment = dresspack_of_segments(motion);
  const Slab moved(name_from(output, files.motion), times.size(), of_segment.size());
  const Slab strained(name_from(output, files.strain), times.size(), of_segment.size());
  const Slab lived(name_from(output, files.life), times.size(), of_segment.size());
  const HoseLines hose(of_segment, setup);
  const Shapes shapes(setup.robot);
  const bool with_robot = !shapes.empty() && motion.has("/robot/link_pose");

  std::string text =
      "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
      "<Grid Name=\"job\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  const std::size_t segments = of_segment.size();
  const auto at_nodes = [&](const char* name, const std::string& item) {
    return attribute(name, "Node", segments, item);
  };
  std::vector<double> pose, centre;
  for (std::size_t k = 0; k < times.size(); ++k) {
    motion.read_rows("/segment/position", k, 1, centre);
    std::string places;
    for (std::size_t i = 0; i < segments; ++i) add_place(places, Eigen::Map<const Vector3d>(&centre[3 * i]));
    text += fmt::format(
        "<Grid Name=\"moment\" GridType=\"Collection\" CollectionType=\"Spatial\">\n<Time Value=\"{}\"/>\n"
        "<Grid Name=\"dresspack\"><Topology TopologyType=\"Mixed\" "
        "NumberOfElements=\"{}\">{}</Topology>\n{}{}",
        times[k], hose.lines, hose.cells, geometry(segments, places), at_nodes("radius [m]", hose.radii));
    text += at_nodes("tension [N]", moved.scalars("/tension", k, 8));
    if (motion.has("/contact/force")) text += at_nodes("contact force [N]", moved.scalars("/contact/force", k, 4));
    if (strain) {
      text += at_nodes("curvature 1 [1_m]", strained.component("/deformation/curvature", k, 0, 4));
      text += at_nodes("curvature 2 [1_m]", strained.component("/deformation/curvature", k, 1, 4));
      text += at_nodes("twist [rad_m]", strained.scalars("/deformation/twist", k, 4));
      text += at_nodes("elongation", strained.scalars("/deformation/elongation", k, 4));
    }
    if (life) text += at_nodes("damage per repeat", lived.constant("/segment/damage"));
    text += "</Grid>\n";
    if (with_robot) {
      motion.read_rows("/robot/link_pose", k, 1, pose);
      text += shapes.grid(pose);
    }
    text += "</Grid>\n";
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace dresslife::pipeline
