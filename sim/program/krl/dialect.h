// What KRL's instructions, functions and system variables mean: moves, frames, BAS and the functions behind
// WITH. krl.cpp holds the moves, basics.cpp what BAS.SRC and $CONFIG.DAT of a controller define.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/program/krl/frames.h"

namespace dresslife::sim {

class Krl final : public Dialect {
 public:
  /// tools, work_objects: those that the program's files do not hold. Both and the code must outlive this.
  Krl(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects);

  std::optional<Value> constant(const std::string& name) override;
  std::optional<Value> function(const Expression& call, Interpreter& run) override;
  bool instruction(const Statement& statement, Interpreter& run) override;
  bool matters(const std::string& name) const override;
  bool only_waits(const std::string& name) const override { return name == "wait_sec"; }
  bool harmless(const std::string& name) const override;
  bool writes(const std::string& name, int position, const Expression& argument) const override;
  const RecordType* type_of(const std::string& name) const override;
  Value initial(const std::string& type) const override;
  void store(Value& place, Value value) const override;
  std::string form_of(const std::string& type) const override;
  bool gives_lists() const override { return false; }
  Value of_form(const Value& value, const char* type) const;
  std::optional<double> letter(const Value& text) const override;
  bool shares(const std::string& name, int module) const override;
  bool is_of_module(const std::string& name) const override;
  void may_have_run(const Statement& statement, const Cause& why, Interpreter& run) override;

  /// Indices of the instructions that are SPL points of spline blocks.
  const std::set<std::size_t>& spline_points() const { return spline_points_; }

  /// What the numbers of a target count from.
  enum class From {
    origin,  ///< of the base, or of the axes
    place,   ///< before the move, along the base (PTP_REL, LIN_REL)
    tool     ///< before the move, along the tool (LIN_REL ... #TOOL)
  };

 private:
  /// $TOOL and $BASE as a move finds them, in the robot's base frame.
  struct Frames {
    Frame tool, base;
    std::string tool_name, base_name;
    bool stationary = false;  ///< $IPO_MODE is #TCP: the tool stands at $BASE, the work hangs at $TOOL
    Value unknown;            ///< why they are not known; known: they are
    Value base_too;           ///< why the base is not, where the tool is not either

    bool same(const Frames& other) const;
    Frame flange(const Frame& pose) const;  ///< that holds the tool at the pose
    Frame pose(const Frame& flange) const;
  };

  // ---- krl.cpp: moves
  static std::optional<Instruction::Kind> kind_of(const std::string& name);
  bool move(Instruction::Kind kind, const Statement& statement, Interpreter& run);
  void move_now(Instruction::Kind kind, const Statement& statement, Interpreter& run);
  void go_round(const Statement& statement, const Expression* whole_angle,
                const std::optional<std::array<double, 6>>& start, Instruction move, Interpreter& run);
  static void ask_for_kind(const Value* kind, const char* what, const Place& place, Interpreter& run);
  static bool keeps_orientation(const Place& place, bool unknown, Interpreter& run);
  bool stands_still(const Expression& target, Interpreter& run) const;
  bool read_via(const Expression& via, From from, const Frames& frames, Instruction& move, Interpreter& run);
  bool read_target(const Expression& written, From from, const Frames& frames, Instruction& move,
                   Interpreter& run);
  bool read_known_target(const Expression& written, From from, const Frames& frames, Instruction& move,
                         Interpreter& run);
  static std::optional<std::array<double, 6>> given_place(bool axes, Interpreter& run);
  Value place_here(bool axes, Interpreter& run) const;
  void ask_for_place_before(const Expression& written, bool axes, Interpreter& run);
  void ask_for_target(const Expression& written, const Value& value, Interpreter& run);
  void ask_for_part(const Expression& written, const krl::Coordinates& read, Interpreter& run);
  bool read_external(const Expression& written, const Value& value, bool relative, Instruction& move,
                     Interpreter& run);
  std::optional<std::array<double, 6>> place_before(const Frames& frames) const;
  void set_frames(const Frames& frames, Instruction& move, Interpreter& run);
  bool ask_for_frames(const Frames& frames, const Statement& statement, Interpreter& run);
  static void ask_for_frame(const Value& unknown, const Statement& statement, Interpreter& run);
  bool read_speed(const Statement& statement, Instruction& move, Interpreter& run);
  bool read_axis_speed(const Statement& statement, Instruction& move, Interpreter& run);
  bool read_path_speed(const Statement& statement, Instruction& move, Interpreter& run);
  bool read_override(const Statement& statement, Instruction& move, Interpreter& run);
  void read_zone(const Statement& statement, Instruction& move, Interpreter& run);
  bool wait(const Statement& statement, Interpreter& run);
  static void wait_for_robot(const Statement& statement, Interpreter& run);
  void interrupt(const Statement& statement, Interpreter& run);
  void handlers_happen(long number, Interpreter& run);
  void add_origins(const Expression& target, const Frames& frames, Instruction& move, Interpreter& run);

  // ---- basics.cpp: frames, BAS, functions
  Frames current_frames(Interpreter& run);
  Frame current(const char* variable, const char* list, Frames& frames, std::string& name, Interpreter& run);
  std::string name_of(const char* list, const std::array<double, 6>& numbers, Interpreter& run);
  std::optional<Value> named_frame(const std::string& path);
  Value numbered(const char* list, const Value& number, Interpreter& run);
  void basics(const Statement& statement, Interpreter& run);
  void initialise(const Place& place, Interpreter& run);
  void joint_data(const Place& place, Interpreter& run);
  void path_data(const Place& place, Interpreter& run);
  void form_frames(const Place& place, Interpreter& run);
  void set_axes(const char* list, const Value& percent, const Place& place, Interpreter& run);
  Value axis_speed(const Value& percent, Interpreter& run);
  Value axis_acceleration(const Value& percent, Interpreter& run);
  Value path_speed(const Value& speed, Interpreter& run);
  void set_path_acceleration(const Value& percent, const Place& place, Interpreter& run);
  void use_tool(const Value& number, const Place& place, Interpreter& run);
  void use_base(const Value& number, const Place& place, Interpreter& run);
  std::optional<Value> spline_function(const Expression& call, const std::vector<Value>& values,
                                       Interpreter& run);
  static Value state_of(const Value& name, Interpreter& run);
  std::optional<Value> arithmetic(const Expression& call, const std::vector<Value>& values);

  // ---- values
  Value record(const std::array<double, 6>& numbers, const char* type) const;
  Value frame_value(const Frame& frame) const { return record(krl::numbers_of(frame), "frame"); }
  Value prototype(const std::string& type, int depth) const;
  static std::optional<double> setting(const std::string& name, const char* field, Interpreter& run);

  const Code& code_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& work_objects_;
  mutable std::map<std::string, Value> prototypes_;
  std::set<std::size_t> spline_points_;

  struct Handler {
    const Statement* call;
    int module;  // that declares it
  };
  std::map<long, Handler> handlers_;  // by the interrupts' numbers
  std::set<long> braking_;            // interrupts that are on and stop moves

  // Where the robot stands: axes after a move to axes, else a pose and the frames in which it is given.
  std::optional<std::array<double, 6>> axes_, numbers_;
  Frames numbers_in_;
  Value lost_;  // why it is not known where the last move led
  std::array<std::optional<double>, 6> external_;
};

namespace krl {

/// DEF_ACC_CP as KUKA delivers it [m/s2]: without $config.dat it stands on both sides of a percentage.
constexpr double standard_path_acceleration = 2.3;
/// $JERK_MA.CP and DEF_JERK_STRUC.CP of published backups of KR 6, KR 125, KR 210 (KSS 8.3 to 8.6) [m/s3].
constexpr double standard_path_jerk = 500;

/// A part of a variable: "$vel" "cp", "tool_data" 3.
Expression field_at(const std::string& name, const std::string& field, const Place& place);
Expression element_at(const std::string& name, int index, const Place& place);

}  // namespace krl

}  // namespace dresslife::sim
