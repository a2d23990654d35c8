// The effects of KRL's instructions, functions and system variables: moves, frames, BAS and the functions after WITH.
// krl.cpp contains the moves, basics.cpp the definitions of a controller's BAS.SRC and $CONFIG.DAT.
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
  /// tools, work_objects: frames that the program's files do not define. The arguments must outlive this object.
  Krl(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects);

  std::optional<Value> constant(const std::string& name) override;
  std::optional<Value> function(const Expression& call) override;
  bool instruction(const Statement& statement) override;
  bool matters(const std::string& name) const override;
  bool only_waits(const std::string& name) const override { return name == "wait_sec"; }
  bool harmless(const std::string& name) const override;
  bool writes(const std::string& name, int position, const Expression& argument) const override;
  const RecordType* type_of(const std::string& name) const override;
  Value initial(const std::string& type) const override;
  void store(Value& place, Value value) const override;
  void check_components(const Expression& aggregate) override;
  void no_such_component(const Expression& target, const RecordType& record) override;
  std::string form_of(const std::string& type) const override;
  bool gives_lists() const override { return false; }
  Value of_form(const Value& value, const char* type) const;
  std::optional<double> letter(const Value& text) const override;
  bool shares(const std::string& name, int module) const override;
  bool is_of_module(const std::string& name) const override;
  void may_have_run(const Statement& statement, const Cause& why) override;

  /// Indices of the instructions that are SPL points of spline blocks.
  const std::set<std::size_t>& spline_points() const { return spline_points_; }

  /// The reference of a target's numbers.
  enum class From {
    origin,  ///< origin of the base, or zero of the axes
    place,   ///< position before the move, in directions of the base (PTP_REL, LIN_REL)
    tool     ///< position before the move, in directions of the tool (LIN_REL ... #TOOL)
  };

 private:
  /// $TOOL in the flange frame and $BASE in the robot's base frame at a move.
  struct Frames {
    Frame tool, base;
    std::string tool_name, base_name;
    bool stationary =
        false;       ///< $IPO_MODE is #TCP: the tool stands at $BASE, the robot carries the work object at $TOOL
    Value unknown;   ///< cause of an unknown frame; a known value: both frames are known
    Value base_too;  ///< cause of an unknown base, if the tool is unknown, too

    bool same(const Frames& other) const;
    Frame flange(const Frame& pose) const;  ///< flange frame at a pose of the tool in the base
    Frame pose(const Frame& flange) const;  ///< pose of the tool in the base at a flange frame
  };

  // ---- krl.cpp: moves
  static std::optional<Instruction::Kind> kind_of(const std::string& name);
  void move(Instruction::Kind kind, const Statement& statement);
  void move_now(Instruction::Kind kind, const Statement& statement);
  void go_round(const Statement& statement, const Expression* whole_angle,
                const std::optional<std::array<double, 6>>& start, Instruction move);
  void ask_for_kind(const Value* kind, const char* what, const Place& place);
  void check_word(const Value* word, const char* of, const std::vector<std::string>& known, const Place& place);
  void check_marks(const Statement& statement);
  bool keeps_orientation(const Place& place, bool unknown);
  bool stands_still(const Expression& target) const;
  bool read_via(const Expression& via, From from, const Frames& frames, Instruction& move);
  bool read_target(const Expression& written, From from, const Frames& frames, Instruction& move);
  bool read_known_target(const Expression& written, From from, const Frames& frames, Instruction& move);
  std::optional<std::array<double, 6>> given_place(bool axes);
  Value place_here(bool axes) const;
  void ask_for_place_before(const Expression& written, bool axes);
  void ask_for_target(const Expression& written, const Value& value);
  void ask_for_part(const Expression& written, const krl::Coordinates& read);
  bool read_external(const Expression& written, const Value& value, bool relative, Instruction& move);
  std::optional<std::array<double, 6>> place_before(const Frames& frames) const;
  void set_frames(const Frames& frames, Instruction& move);
  bool ask_for_frames(const Frames& frames, const Statement& statement);
  void ask_for_frame(const Value& unknown, const Statement& statement);
  bool read_speed(const Statement& statement, Instruction& move);
  void note_setting(const char* variable, const std::string& what, const Place& place);
  std::optional<double> turn_speed(const Place& place);
  bool read_axis_speed(const Statement& statement, Instruction& move);
  bool read_path_speed(const Statement& statement, Instruction& move);
  bool read_override(const Statement& statement, Instruction& move);
  void read_zone(const Statement& statement, Instruction& move);
  void wait(const Statement& statement);
  void wait_for_robot(const Statement& statement);
  void interrupt(const Statement& statement);
  void handlers_happen(long number);
  void add_origins(const Expression& target, const Frames& frames, Instruction& move);

  // ---- basics.cpp: frames, BAS, functions
  Frames current_frames();
  Frame current(const char* variable, const char* list, Frames& frames, std::string& name);
  std::string name_of(const char* list, const std::array<double, 6>& numbers);
  std::optional<Value> named_frame(const std::string& path);
  Value numbered(const char* list, const Value& number);
  void basics(const Statement& statement);
  void initialise(const Place& place);
  void joint_data(const Place& place);
  void path_data(const Place& place);
  void form_frames(const Place& place);
  Value part_of_form(const std::string& type, const char* field, const Place& place);
  void set_axes(const char* list, const Value& percent, const Place& place);
  Value axis_speed(const Value& percent);
  Value axis_acceleration(const Value& percent);
  Value path_speed(const Value& speed);
  void set_path_acceleration(const Value& percent, const Place& place);
  void use_tool(const Value& number, const Place& place);
  void use_base(const Value& number, const Place& place);
  std::optional<Value> spline_function(const Expression& call, const std::vector<Value>& values);
  Value state_of(const Value& name);
  std::optional<Value> arithmetic(const Expression& call, const std::vector<Value>& values);

  // ---- values
  Value record(const std::array<double, 6>& numbers, const char* type) const;
  Value frame_value(const Frame& frame) const { return record(krl::numbers_of(frame), "frame"); }
  Value prototype(const std::string& type, int depth) const;
  std::optional<double> setting(const std::string& name, const char* field);

  const Code& code_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& work_objects_;
  mutable std::map<std::string, Value> prototypes_;
  std::set<std::size_t> spline_points_;

  struct Handler {
    const Statement* call;
    int module;  // module that declares the interrupt
  };
  std::map<long, Handler> handlers_;  // by the interrupts' numbers
  std::set<long> braking_;            // interrupts that are on and stop moves

  // The robot's position: axis angles after a move to axis angles, else a pose and its frames.
  std::optional<std::array<double, 6>> axes_, numbers_;
  Frames numbers_in_;
  Value lost_;  // cause of an unknown target of the last move
  std::array<std::optional<double>, 6> external_;
};

namespace krl {

/// DEF_ACC_CP as delivered by KUKA [m/s2]. Without $config.dat it cancels, because accelerations are percentages of it.
constexpr double standard_path_acceleration = 2.3;
/// Path speed [m/s] that no robot reaches.
constexpr double fastest_path = 10;
/// $JERK_MA.CP and DEF_JERK_STRUC.CP [m/s3] of public backups of KR 6, KR 125, KR 210 (KSS 8.3 to 8.6).
constexpr double standard_path_jerk = 500;

/// Returns the expression of a part of a variable: field "cp" of "$vel", element 3 of "tool_data".
Expression field_at(const std::string& name, const std::string& field, const Place& place);
Expression element_at(const std::string& name, int index, const Place& place);

}  // namespace krl

}  // namespace dresslife::sim
