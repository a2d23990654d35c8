// One run of a Fanuc program (fanuc.h): executes statements with a program counter and writes moves and dwells.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "sim/program/fanuc/effects.h"
#include "sim/program/fanuc/values.h"
#include "sim/program/interpreter/exploration.h"
#include "sim/program/interpreter/passes.h"

namespace dresslife::sim {

/// Converts X Y Z [mm], W P R [deg] to a frame, and a frame to these six values.
Frame frame_of_fanuc(const std::vector<double>& values);
std::vector<double> fanuc_values_of(const Frame& frame);

class FanucRun {
 public:
  struct Surroundings {
    const std::deque<SourceFile>& files;
    const std::vector<FanucListing>& listings;
    std::vector<Problems>& parsing;  ///< (file) parse errors, reported when the listing is called
    const FanucVariables& variables;
    const ImportOptions& options;
    const std::vector<NamedFrame>&tools, &work_objects;
  };
  FanucRun(const Surroundings& around, Program& program, Problems& problems, Exploration& exploration);

  /// arguments: the values of AR[1], AR[2] ..., in the form of a call: "(1,'a',R[2])"; empty: none.
  void run(const FanucListing& listing, const std::string& arguments);

 private:
  struct Stop {};  // exception that ends the run
  struct Loop {
    int register_number;
    double last, step;
  };
  struct Routine {
    const FanucListing* listing;
    std::size_t at = 0;
    std::map<std::size_t, Loop> loops;  // index of the FOR -> its running loop
    std::set<std::size_t> decided;      // indices of statements that branched on known values
  };
  /// Passes of a loop up to now, to find the pass after which the loop repeats itself.
  struct Endless {
    explicit Endless(const std::vector<Instruction>& moves) : all(moves), begin(moves.size()) {}
    Passes all;                    // the passes of goes_on()
    std::string last;              // FanucValues::deciding_state() at the last pass
    std::set<std::string> states;  // those of waits()
    std::size_t begin;             // number of instructions at the start of the pass
    int passes = 0;
    long news = -1;  // Exploration::news() at the last pass
    int barren = 0;  // number of consecutive passes without news
  };
  struct Case {  // one case of a SELECT
    std::size_t statement;
    FanucNumber value;
    bool otherwise;
    std::string action;
  };

  // ---- statements: run.cpp
  void call(const FanucListing& listing, std::vector<FanucValues::Stored> arguments);
  void execute(const FanucStatement& s);
  void action(const std::string& text);
  void assignment(const std::string& word, FanucCursor& at);
  void block(const std::string& word);
  void jump(FanucCursor& at, bool certain);
  void jump_to(std::size_t target, bool certain);
  Endless& endless(std::size_t label);
  bool goes_on(std::size_t label);  // whether an endless loop runs another pass
  bool waits(std::size_t label);
  bool still_new(std::size_t label);
  void call_statement(const std::string& text, bool beside);
  std::vector<FanucValues::Stored> arguments_in(FanucCursor& at);
  void unread(const std::string& what);
  void wait(FanucCursor& at);
  bool read_whole(FanucCursor& at);
  void assign_register(FanucCursor& at);
  void assign_position(FanucCursor& at);
  std::optional<FanucPosition> position_sum(FanucCursor& at);
  void assign_frame(const std::string& word, FanucCursor& at);
  void set_frame(bool tool, int number, FanucCursor& at);
  void forget_frames(bool tool, const FanucCauses& why);
  void set_frame_component(bool tool, int number, int component, FanucCursor& at);
  void if_statement(FanucCursor& at);
  void conditional_action(const std::string& text);
  std::optional<bool> undecided(const std::string& action);
  bool no_matter(const FanucEffects& effects);
  void forget(const FanucEffects& effects, const FanucCauses& why);
  bool whole_program_no_matter();
  int ask(const std::string& what, int ways, const std::string& answers);
  int guess(int ways);
  void select();
  std::optional<std::size_t> chosen(const std::vector<Case>& cases, FanucNumber selected);
  std::optional<std::size_t> undecided_select(const std::vector<Case>& cases, std::size_t behind);
  void for_statement(FanucCursor& at);
  void end_for();

  // ---- moves: moves.cpp
  void move(FanucCursor& at, Instruction::Kind kind);
  struct Options {
    std::optional<FanucPosition> offset, tool_offset;
    bool remote = false, failed = false, skips = false, coordinated = false;
    bool camera = false;  // the offset is a camera result
    std::string calls;    // program called before or after the point
    std::string jumps;    // "[1]": label of Skip or SkipJump; empty: no jump
  };
  bool read_options(FanucCursor& at, Instruction& move, Options& options);
  bool read_option(FanucCursor& at, Instruction& move, Options& options);
  void unread_option(std::string_view written);
  FanucNumber needed(FanucCursor& at, const char* what);
  void offset_by(FanucCursor& at, std::optional<FanucPosition>& into, const std::string& condition);
  void offset_by_camera(FanucCursor& at, std::optional<FanucPosition>& into);
  bool skip_condition_comes(bool jumps);
  void missing_position(int number, const char* what);
  void doubt(int number);
  const NamedFrame* given_frame(bool tool, const std::string& name) const;
  struct WrittenPosition {
    bool registered;                        // PR[n]
    std::optional<int> number;              // no value: unknown
    std::optional<FanucPosition> position;  // no value: unknown number, other group, or no such P[n]
  };
  WrittenPosition position(FanucCursor& at);
  std::optional<FanucPosition> target_position(FanucCursor& at);
  bool place_joints(const FanucPosition& position, const Options& options, Instruction& move);
  bool place_via(const FanucPosition& via, const FanucPosition& target, const Options& own, const Options& options,
                 Instruction& move);
  std::optional<std::pair<NamedFrame, NamedFrame>> frames_of(FanucPosition& p);
  bool offsets_are_frames() const;
  bool place(const FanucPosition& position, const Options& options, Instruction& move, Frame& pose);
  bool read_speed(FanucCursor& at, Instruction& move);
  std::optional<double> override_share();
  bool active(bool tool, int& number);
  void compare_active(bool tool, int listed);
  std::optional<NamedFrame> frame(bool tool, int number);
  void use(const NamedFrame& frame, bool as_tool, Instruction& move);
  void emit(Instruction instruction);
  void stopped_on_the_way();
  void remember(const Instruction& move, const FanucPosition& target);

  // ---- words
  Routine& routine() { return routines_.back(); }
  const FanucStatement& statement() const;
  pipeline::Where where() const;
  std::string line_name() const;  // "cell.ls:12"
  std::optional<bool> assumed(int line);
  std::string program_name() const;
  void complain(const std::string& what, const std::string& remedy);
  bool refuse(const std::string& what, const std::string& remedy);  // complains; returns false
  void missing(const std::string& name, const std::string& what, const std::string& remedy,
               std::vector<Question> questions, bool decision = false);
  void missing_value(const std::string& what);  // the unknown value of values_.causes()
  std::vector<Question> questions_for(const FanucCauses& causes);
  void note(const std::string& what, bool may_move = false);
  void charge(long steps = 1);

  const Surroundings around_;
  Program& program_;
  Problems& problems_;
  Exploration& exploration_;
  FanucValues values_;
  FanucOutlook outlook_;
  std::vector<Routine> routines_;
  struct AssignedFrame {
    std::optional<Frame> frame;  // std::nullopt: unknown
    FanucCauses why;             // causes of an unknown frame
  };
  static constexpr int any_frame = -1;                    // key of an assignment to an unknown number
  std::map<std::pair<bool, int>, AssignedFrame> frames_;  // (tool?, number) -> frame assigned by the program
  std::optional<FanucPosition> last_;                     // position of the robot: JPOS and LPOS
  std::string offset_condition_, tool_offset_condition_;  // PR[n] of OFFSET CONDITION
  std::string skip_condition_;
  std::map<std::pair<const FanucListing*, std::size_t>, Endless> endless_;
  std::set<std::string> noted_;
  std::set<std::string> used_lines_;  // keys of the user's assumptions
  pipeline::Where last_jump_;         // last backward jump
  pipeline::Where last_decision_;
  long executed_ = 0, guessed_at_ = 0;
};

}  // namespace dresslife::sim
