#include "sim/reprogram/program_ways.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>
#include <utility>

#include "pipeline/arm/other_turns.h"
#include "pipeline/base/constants.h"
#include "pipeline/base/order.h"
#include "pipeline/base/plain_file.h"
#include "pipeline/base/text.h"
#include "sim/robot/inverse_kinematics.h"
#include "sim/robot/legs.h"
#include "sim/robot/robot.h"

namespace dresslife::sim {
namespace {

/// A line of the program: all steps from one place of a file.
struct Line {
  pipeline::Where where;
  std::string name;
  std::vector<std::size_t> moves;  ///< indices of steps
  double cost = 0;
};

class Lines {
 public:
  Lines(const ReadProgram& read, const std::vector<double>& line_damage) {
    std::map<std::string, std::size_t> of_place;
    std::set<std::string> numbered;  // numbering of the simulation: by place and text
    std::size_t before = 0;
    for (std::size_t k = 0; k < read.motion.steps.size(); ++k) {
      const pipeline::MotionStep& step = read.motion.steps[k];
      const std::string key = fmt::format("{}:{}:{}", step.where.file, step.where.line, step.where.column);
      const auto [place, is_new] = of_place.try_emplace(key, lines_.size());
      if (is_new) {
        const std::string file = std::filesystem::path(step.where.file).filename().string();
        lines_.push_back({step.where, fmt::format("{}:{}", file, step.where.line), {}, 0});
      }
      if (step.is_move()) lines_[place->second].moves.push_back(k);
      of_step_.push_back(place->second);
      if (step.is_move()) before = place->second;  // the damage while the robot stands is added to the previous move
      const std::size_t number = numbered.size();
      if (numbered.insert(key + ":" + step.text).second && number < line_damage.size())
        lines_[before].cost += line_damage[number];
    }
  }

  const std::vector<Line>& all() const { return lines_; }
  std::size_t of_step(std::size_t step) const { return of_step_[step]; }

  std::vector<std::size_t> costly(std::size_t most) const {
    std::vector<std::size_t> order =
        pipeline::largest_first(lines_.size(), [&](std::size_t k) { return lines_[k].cost; });
    std::erase_if(order, [&](std::size_t k) { return lines_[k].moves.empty() || !(lines_[k].cost > 0); });
    if (order.size() > most) order.resize(most);
    return order;
  }

 private:
  std::vector<Line> lines_;
  std::vector<std::size_t> of_step_;
};

class Ways {
 public:
  Ways(const pipeline::Job& job, const ReadProgram& read, const std::vector<double>& line_damage)
      : robot_(job.robot),
        read_(read),
        lines_(read, line_damage),
        arm_(job.robot),
        turns_(pipeline::other_turns(robot_)) {
    Eigen::VectorXd accelerations = Eigen::VectorXd::Ones(static_cast<long>(axes_of(robot_).size()));
    const std::vector<Eigen::VectorXd> targets = legs_of(read.motion, robot_, accelerations).targets;
    std::size_t next = 0;
    for (const pipeline::MotionStep& step : read.motion.steps)
      joints_.push_back(step.is_move() ? targets.at(next++) : Eigen::VectorXd());
    find_chains();
    find_seams();
  }

  std::vector<ProgramWay> run(std::size_t most_lines) {
    std::vector<ProgramWay> ways;
    const auto add = [&](std::optional<ProgramWay> way) {
      if (!way) return;
      const auto same = [&](const ProgramWay& other) { return other.what == way->what && other.lines == way->lines; };
      if (std::ranges::none_of(ways, same)) ways.push_back(*std::move(way));
    };
    std::set<std::size_t> every;
    for (std::size_t k = 0; k < chain_of_.size(); ++k)
      if (read_.motion.steps[k].is_move()) every.insert(lines_.of_step(k));
    const Language language = read_.language;  // the language determines which changes a line can express
    const bool points = language == Language::rapid || language == Language::krl;
    const bool turns = points || language == Language::fanuc;
    for (const pipeline::NamedTurn& turn : turns_)
      if (turns) add(turned(turn, every, true));
    for (const std::size_t line : lines_.costly(most_lines)) {
      for (const pipeline::NamedTurn& turn : turns_)
        if (turns) add(turned(turn, {line}, false));
      for (const bool arm_first : {true, false})
        if (points) add(by_a_point(line, arm_first));
      for (const double factor : {0.7, 0.5}) add(slower(line, factor));
    }
    return ways;
  }

 private:
  bool is_joint_move(std::size_t step) const {
    const pipeline::MotionStep& s = read_.motion.steps[step];
    return s.is_move() && !leads_tool(s.path);
  }

  /// Numbers the chains. A chain begins at each joint move and at the first step.
  void find_chains() {
    std::size_t chain = 0;
    for (std::size_t k = 0; k < read_.motion.steps.size(); ++k) {
      if (k > 0 && is_joint_move(k)) ++chain;
      chain_of_.push_back(chain);
    }
  }

  /// Returns the lines of all chains that contain one of these lines; a line in several chains adds all of them.
  std::set<std::size_t> whole_chains(std::set<std::size_t> lines) const {
    for (std::size_t before = 0; before != lines.size();) {
      before = lines.size();
      std::set<std::size_t> chains;
      for (std::size_t k = 0; k < chain_of_.size(); ++k)
        if (lines.contains(lines_.of_step(k))) chains.insert(chain_of_[k]);
      for (std::size_t k = 0; k < chain_of_.size(); ++k)
        if (chains.contains(chain_of_[k]) && read_.motion.steps[k].is_move()) lines.insert(lines_.of_step(k));
    }
    return lines;
  }

  std::string names(const std::set<std::size_t>& lines, std::vector<std::string>& list) const {
    for (const std::size_t line : lines) list.push_back(lines_.all()[line].name);
    return list.front();
  }

  /// Returns the same tool poses with another configuration of wrist or arm; absent: a line has none, or cannot express it.
  std::optional<ProgramWay> turned(const pipeline::NamedTurn& turn, const std::set<std::size_t>& from, bool all) const {
    const std::set<std::size_t> lines = whole_chains(from);
    ProgramWay way{turn.name, {}, {}};
    if (!all) names(lines, way.lines);
    bool any = false;
    for (const std::size_t line : lines) {
      std::optional<LineChange> change;
      for (const std::size_t step : lines_.all()[line].moves) {
        std::optional<LineChange> here = turned(turn, step);
        if (!here || (change && (change->configuration != here->configuration || change->joints != here->joints)))
          return {};
        change = std::move(here);
      }
      if (!change || (!change->configuration && change->joints.empty()))
        continue;  // the end of the path states no configuration
      any = true;
      way.changes.push_back(*std::move(change));
    }
    return any ? std::optional(way) : std::nullopt;
  }

  std::optional<LineChange> turned(const pipeline::NamedTurn& turn, std::size_t k) const {
    const pipeline::MotionStep& step = read_.motion.steps[k];
    const Eigen::VectorXd& now = joints_[k];
    if (now.size() < 6) return {};
    const auto other = turn.turn({now.data(), now.data() + 6});
    if (!other) return {};
    LineChange change{.where = step.where, .reason = turn.name};
    if (!step.joints.empty()) {
      change.joints = *other;
      return change;
    }
    const auto programmed = arm_configuration(step.configuration);
    if (!programmed) return {};
    using Kind = ArmConfiguration::Kind;
    const bool watched = programmed->kind == Kind::abb || programmed->kind == Kind::fanuc;
    if (leads_tool(step.path) && !watched) return change;  // the configuration follows from the begin of the path
    if (!watched && programmed->kind != Kind::kuka) return {};
    change.configuration = arm_.configuration(Eigen::Map<const Eigen::VectorXd>(other->data(), 6), programmed->kind);
    return change;
  }

  /// Returns a joint move through a point, so that arm and wrist move one after the other.
  std::optional<ProgramWay> by_a_point(std::size_t line, bool arm_first) const {
    constexpr double none = degree;  // smallest movement of a part
    std::optional<std::vector<double>> point;
    for (const std::size_t k : lines_.all()[line].moves) {
      const std::size_t from = move_before(k);
      if (!is_joint_move(k) || from == k || joints_[k].size() != 6 || joints_[from].size() != 6) return {};
      const Eigen::VectorXd &a = joints_[from], &b = joints_[k];
      std::vector<double> here(6);
      for (int i = 0; i < 6; ++i) here[static_cast<std::size_t>(i)] = (i < 3) == arm_first ? b[i] : a[i];
      const Eigen::Map<const Eigen::VectorXd> on_the_way(here.data(), 6);
      if ((on_the_way - a).cwiseAbs().maxCoeff() <= none || (on_the_way - b).cwiseAbs().maxCoeff() <= none) return {};
      if (point && *point != here) return {};
      point = std::move(here);
    }
    if (!point) return {};
    ProgramWay way{
        fmt::format("by a point: {} first", arm_first ? "axes 1 to 3" : "axes 4 to 6"), {lines_.all()[line].name}, {}};
    way.changes.push_back({.where = lines_.all()[line].where, .point = *point, .reason = way.what});
    return way;
  }

  std::size_t move_before(std::size_t step) const {
    for (std::size_t k = step; k-- > 0;)
      if (read_.motion.steps[k].is_move()) return k;
    return step;
  }

  /// Collects the lines whose speed the process determines, as in a weld or a bead: RAPID's Arc and Disp instructions, moves
  /// with WELD_SPEED, and the lines between begin and end of a weld in Fanuc's and Yaskawa's programs.
  void find_seams() {
    const bool is_fanuc = read_.language == Language::fanuc, is_rapid = read_.language == Language::rapid;
    std::map<std::string, SourceFile> sources;
    for (const Instruction& move : read_.program.instructions) {
      const pipeline::Where& at = move.where;
      if (is_rapid) sources.try_emplace(at.file, at.file, pipeline::read_text(at.file));
      const std::string words =
          pipeline::lower_case(is_rapid ? sources.at(at.file).from(at.line, at.column) : move.text);
      const bool arc = words.starts_with("arc") && !words.starts_with("arcmove");
      if (is_rapid ? arc || words.starts_with("disp") : words.find("weld_speed") != std::string::npos)
        seams_.emplace(at.file, at.line);
    }
    if (!is_fanuc && read_.language != Language::inform) return;
    using Words = std::vector<std::string>;
    const Words begins = is_fanuc ? Words{"arc start", "weld start"} : Words{"arcon"},
                ends = is_fanuc ? Words{"arc end", "weld end"} : Words{"arcof"},
                comments = is_fanuc ? Words{"!"} : Words{"'", "//"};
    std::set<std::string> files;
    for (const pipeline::MotionStep& step : read_.motion.steps)
      if (!step.where.file.empty()) files.insert(step.where.file);
    for (const std::string& file : files) {
      std::istringstream text(pipeline::read_text(file));
      bool is_seam = false;
      int number = 0;
      for (std::string line; std::getline(text, line);) {
        ++number;
        if (is_seam) seams_.emplace(file, number);
        for (const std::string& comment : comments) line = line.substr(0, line.find(comment));
        line = pipeline::lower_case(line);
        const auto in_line = [&](const std::string& words) { return line.find(words) != std::string::npos; };
        if (std::ranges::any_of(begins, in_line)) is_seam = true;
        if (std::ranges::any_of(ends, in_line)) is_seam = false;
      }
    }
  }

  std::optional<ProgramWay> slower(std::size_t line, double factor) const {
    for (const std::size_t k : lines_.all()[line].moves) {
      const pipeline::MotionStep& step = read_.motion.steps[k];
      if (step.duration || seams_.contains({step.where.file, step.where.line}) ||
          !(step.speed || step.speed_percent || step.tool_speed))
        return {};
      if (read_.language == Language::krl && (leads_tool(step.path) || !step.speed_percent)) return {};
    }
    ProgramWay way{fmt::format("at {:.0f} % of its speed", 100 * factor), {lines_.all()[line].name}, {}};
    way.changes.push_back({.where = lines_.all()[line].where, .speed = factor, .reason = way.what});
    return way;
  }

  const pipeline::Robot& robot_;
  const ReadProgram& read_;
  const Lines lines_;
  const InverseKinematics arm_;
  const std::vector<pipeline::NamedTurn> turns_;
  std::vector<Eigen::VectorXd> joints_;          // (step) joint angles at its end; empty: no move
  std::vector<std::size_t> chain_of_;            // (step)
  std::set<std::pair<std::string, int>> seams_;  // file and line
};

}  // namespace

ReadProgram read_job_program(const pipeline::Job& job) {
  ReadProgram read;
  read.language = language_of(job.motion);
  read.program = read_program(job.motion, flange_at(job.robot));
  read.motion = motion_of(read.program, job.motion);
  return read;
}

std::vector<ProgramWay> program_ways(const pipeline::Job& job, const ReadProgram& read,
                                     const std::vector<double>& line_damage, std::size_t most_lines) {
  return Ways(job, read, line_damage).run(most_lines);
}

}  // namespace dresslife::sim
