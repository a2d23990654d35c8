// RAPID's instructions and functions, and the state of the robot that they share. rapid.cpp selects the instruction,
// moves.cpp contains the moves.
#pragma once

#include "sim/program/interpreter/interpreter.h"

namespace dresslife::sim {

/// The positions of an instruction's arguments: indices among the arguments without a name; -1: none, -2: the last,
/// -3: the last but one.
struct Signature {
  const char* name;
  Instruction::Kind kind;
  bool joints;  ///< the target is a jointtarget
  int via, target, speed, zone, tool;
};

/// Returns the signature of a move; null: the instruction is not a move.
const Signature* rapid_move(const std::string& instruction);

class Rapid final : public Dialect {
 public:
  Rapid(const Code& code, const std::vector<NamedFrame>& tools, const std::vector<NamedFrame>& work_objects)
      : code_(code), tools_(tools), work_objects_(work_objects) {}

  std::optional<Value> constant(const std::string& name) override;
  std::optional<Value> function(const Expression& call) override;
  bool instruction(const Statement& statement) override;
  bool matters(const std::string& name) const override;
  bool only_waits(const std::string& name) const override { return name == "waittime"; }
  /// Whether the routine is main: in production main repeats until the operator stops it.
  bool begins_again(const Routine& routine) const override { return routine.name == "main"; }
  bool harmless(const std::string& name) const override;
  std::string move_meant(const Statement& statement) const override;
  bool writes(const std::string& name, int position, const Expression& argument) const override;
  const RecordType* type_of(const std::string& name) const override { return code_.record(name); }
  void store(Value& place, Value value) const override;
  void no_such_component(const Expression& target, const RecordType& record) override;
  Value initial(const std::string& type) const override;
  std::string form_of(const std::string& type) const override;

 private:
  // ---- moves.cpp
  bool move(const Signature& signature, const Statement& statement);
  bool read_target(const Expression& written, bool joints, Instruction& move);
  std::optional<Frame> read_via(const Expression& written);
  bool read_speed(const Expression& written, Instruction& move);
  void read_weld_speed(const Statement& statement, Instruction& move);
  bool read_zone(const Expression& written, Instruction& move);
  bool read_tool(const Expression& written, Instruction& move);
  bool read_work_object(const Expression& written, Instruction& move);
  std::optional<NamedFrame> tool_of(const Expression& written);
  std::optional<NamedFrame> work_object_of(const Expression& written);
  bool read_options(const Statement& statement, Instruction& move);
  void check_arguments(const std::string& of, const std::vector<Expression>& arguments, int most,
                       const std::vector<std::string_view>& switches);
  void print_options(const Statement& statement);
  std::optional<Value> typed(const Expression& written, const char* type, const char* what);
  std::optional<Quaternion> turn_of_displacement(const Value& orient, const char* what, const Expression& written);
  void displace(const Statement& statement);
  std::optional<Value> position_with(const Expression* tool, const Expression* work_object);
  Value current_position(const Expression& call);
  void shift_external_axes(const Statement& statement);

  // ---- rapid.cpp
  Value tool_value(const NamedFrame& tool) const;
  Value work_object_value(const NamedFrame& object) const;
  void settings(const Statement& statement);
  void wait(const Statement& statement);
  bool arithmetic(const Statement& statement);
  void connect(const Statement& statement);
  bool named_data(const Statement& statement);
  Value offset(const Expression& call, bool in_tool);
  /// Returns the orientation as a unit quaternion. Another norm is a problem of `written`, and the quaternion is
  /// normalised. std::nullopt: the quaternion is 0.
  std::optional<Quaternion> checked(const Value& orient, const char* what, const Expression& written);
  Value text_to_value(const Expression& call);

  const Code& code_;
  const std::vector<NamedFrame>& tools_;
  const std::vector<NamedFrame>& work_objects_;
  double acceleration_percent_ = 100, jerk_percent_ = 100;
  double speed_factor_ = 1, speed_limit_ = INFINITY;                          // VelSet; limit [m/s]
  double override_ = 1;                                                       // SpeedRefresh
  Frame displacement_;                                                        // PDispSet and PDispOn
  std::vector<double> external_shift_;                                        // EOffsSet and EOffsOn [mm or deg]
  bool configuration_of_paths_ = true, configuration_of_joint_moves_ = true;  // ConfL, ConfJ

  /// The target of the last move.
  struct Reached {
    Value target;                  // robtarget or jointtarget
    bool by_joints = false;        // the target is a jointtarget
    Frame displacement;            // displacement during the move
    NamedFrame tool, work_object;  // tool and work object of the move
  };
  std::optional<Reached> reached_;
  Value lost_;                   // cause of an unknown target of the last move
  bool lost_by_joints_ = false;  // this move was a move to axis angles
};

}  // namespace dresslife::sim
