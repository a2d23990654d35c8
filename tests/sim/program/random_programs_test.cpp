// Random programs of moves, branches, loops and calls in every language. A reference run in this test must give the same
// order of moves and waits as each reader.
#include <random>

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

constexpr int variables = 4, routines = 3;  // routines other than main write only to the last variable
const std::vector<std::string> comparisons{"<", "<=", ">", ">=", "=", "<>"};

struct Statement {
  enum class Kind { wait, add, assign, branch, select, count, loop, call } kind;
  int variable = 0, value = 0, to = 0;
  std::size_t comparison = 0;
  std::vector<Statement> body{}, other{}, rest{};
};
using Block = std::vector<Statement>;

constexpr int first_angle = 9;  // [deg] angle of the first move, because a motion needs at least one

bool is_move(const Statement& wait) { return wait.value % 3 == 0; }
int angle_of(const Statement& wait) { return 1 + wait.value % 8; }  // [deg]

class RandomProgram {
 public:
  explicit RandomProgram(unsigned seed) : engine_(seed) {
    for (int r = 0; r < routines; ++r) routine_.push_back(block(r, 3, 0));
  }
  const Block& routine(int r) const { return routine_[std::size_t(r)]; }
  /// Returns moves and waits in their order. Negative: minus the angle of axis 1 [deg]. Positive: a wait [s].
  std::vector<int> run() {
    course_ = {-first_angle};
    std::array<int, variables> values{};
    run(routine_[0], values);
    return course_;
  }

 private:
  int below(int count) { return int(engine_() % unsigned(count)); }
  Block block(int routine, int depth, unsigned taken) {  // taken: bits of variables that count enclosing loops
    Block made;
    for (int k = 1 + below(4); k-- > 0;) made.push_back(statement(routine, depth, taken));
    return made;
  }
  Statement statement(int routine, int depth, unsigned taken) {
    using Kind = Statement::Kind;
    const int variable = routine > 0 ? variables - 1 : below(variables), free = below(variables - 1);
    switch (below(depth > 0 ? 9 : 4)) {
      case 1:
        if (!(taken & 1u << variable)) return {Kind::add, variable, below(5) - 2};
        break;
      case 2:
        if (!(taken & 1u << variable)) return {Kind::assign, variable, below(6) - 1};
        break;
      case 4:
      case 5:
        return {Kind::branch,
                below(variables),
                below(5),
                0,
                std::size_t(below(6)),
                block(routine, depth - 1, taken),
                block(routine, depth - 1, taken)};
      case 6:
        return {Kind::select,
                below(variables),
                below(4),
                0,
                0,
                block(routine, depth - 1, taken),
                block(routine, depth - 1, taken),
                block(routine, depth - 1, taken)};
      case 7: {
        const int from = below(3);
        return {Kind::count, routine * 8 + depth, from, from + below(3), 0, block(routine, depth - 1, taken)};
      }
      case 8:
        if (routine == 0 && !(taken & 1u << free))
          return {Kind::loop, free, below(5), 1 + below(2), 0, block(routine, depth - 1, taken | 1u << free)};
        if (routine + 1 < routines) return {Kind::call, 0, routine + 1};
        break;
    }
    return {Kind::wait, 0, ++number_};
  }
  void run(const Block& block, std::array<int, variables>& values) {
    for (const Statement& one : block) {
      int& variable = values[std::size_t(one.kind == Statement::Kind::count ? 0 : one.variable)];
      switch (one.kind) {
        case Statement::Kind::wait:
          course_.push_back(is_move(one) ? -angle_of(one) : one.value);
          break;
        case Statement::Kind::add:
          variable += one.value;
          break;
        case Statement::Kind::assign:
          variable = one.value;
          break;
        case Statement::Kind::branch: {
          const std::array<bool, 6> holds{variable<one.value, variable <= one.value, variable> one.value,
                                          variable >= one.value, variable == one.value, variable != one.value};
          run(holds[one.comparison] ? one.body : one.other, values);
          break;
        }
        case Statement::Kind::select:
          run(variable == one.value ? one.body : variable == one.value + 2 ? one.other : one.rest, values);
          break;
        case Statement::Kind::count:
          for (int k = one.value; k <= one.to; ++k) run(one.body, values);
          break;
        case Statement::Kind::loop:
          for (; variable < one.value; variable += one.to) run(one.body, values);
          break;
        case Statement::Kind::call:
          run(routine_[std::size_t(one.value)], values);
          break;
      }
    }
  }
  std::mt19937 engine_;
  int number_ = 0;
  std::vector<Block> routine_;
  std::vector<int> course_;
};

/// Statements of a language. {v}: variable; {n}, {m}: numbers; {c}: comparison; {l}, {k}, {j}, {i}: unique labels.
struct Written {
  Language language;
  std::string variable, counter;
  std::string move, wait, add, assign, branch, otherwise, end, loop, again, count, counted, call;
  std::string select, first_case, other_case, rest, selected;  // empty: written as branches
  std::string equal, unequal;
};

class Writer {
 public:
  explicit Writer(const Written& as) : as_(as) {}
  std::string text(const Block& block) {
    std::string text;
    for (const Statement& one : block) text += this->text(one);
    return text;
  }

 private:
  std::string text(const Statement& one) {
    const int label = labels_ += 4;
    const std::string variable = fmt::format(fmt::runtime(as_.variable), one.variable + 1),
                      counter = fmt::format(fmt::runtime(as_.counter), one.variable + 10);
    const auto fill = [&](const std::string& words, const std::string& of, int n, int m = 0,
                          const std::string& comparison = "") {
      return fmt::format(fmt::runtime(words), fmt::arg("v", of), fmt::arg("n", n), fmt::arg("m", m),
                         fmt::arg("c", comparison), fmt::arg("l", label), fmt::arg("k", label + 1),
                         fmt::arg("j", label + 2), fmt::arg("i", label + 3));
    };
    switch (one.kind) {
      case Statement::Kind::wait:
        return is_move(one) ? fill(as_.move, "", angle_of(one)) : fill(as_.wait, "", one.value);
      case Statement::Kind::add:
        return fill(as_.add, variable, one.value);
      case Statement::Kind::assign:
        return fill(as_.assign, variable, one.value);
      case Statement::Kind::branch: {
        const std::string& name = comparisons[one.comparison];
        return fill(as_.branch, variable, one.value, 0,
                    name == "="    ? as_.equal
                    : name == "<>" ? as_.unequal
                                   : name) +
               text(one.body) + as_.otherwise + text(one.other) + as_.end;
      }
      case Statement::Kind::select:
        if (as_.select.empty())
          return fill(as_.branch, variable, one.value, 0, as_.equal) + text(one.body) + as_.otherwise +
                 fill(as_.branch, variable, one.value + 2, 0, as_.equal) + text(one.other) + as_.otherwise +
                 text(one.rest) + as_.end + as_.end;
        return fill(as_.select + as_.first_case, variable, one.value, one.value + 2) + text(one.body) +
               fill(as_.other_case, variable, one.value + 2) + text(one.other) + fill(as_.rest, variable, 0) +
               text(one.rest) + fill(as_.selected, variable, 0);
      case Statement::Kind::count:
        return fill(as_.count, counter, one.value, one.to) + text(one.body) + fill(as_.counted, counter, 1);
      case Statement::Kind::loop:
        return fill(as_.loop, variable, one.value) + text(one.body) + fill(as_.add, variable, one.to) +
               fill(as_.again, variable, one.value);
      case Statement::Kind::call:
        return fill(as_.call, "", one.value);
    }
    return "";
  }
  const Written& as_;
  int labels_ = 0;
};

const Written rapid{Language::rapid,
                    "v{}",
                    "c{}",
                    "MoveAbsJ [[{n},-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n",
                    "WaitTime {n};\n",
                    "{v}:={v}+({n});\n",
                    "{v}:={n};\n",
                    "IF {v}{c}{n} THEN\n",
                    "ELSE\n",
                    "ENDIF\n",
                    "WHILE {v}<{n} DO\n",
                    "ENDWHILE\n",
                    "FOR {v} FROM {n} TO {m} DO\n",
                    "ENDFOR\n",
                    "sub{n};\n",
                    "TEST {v}\n",
                    "CASE {n}:\n",
                    "CASE {n},99:\n",
                    "DEFAULT:\n",
                    "ENDTEST\n",
                    "=",
                    "<>"},
    krl{Language::krl,
        "v{}",
        "c{}",
        "PTP {{A1 {n},A2 -90,A3 90,A4 0,A5 0,A6 0}}\n",
        "WAIT SEC {n}\n",
        "{v}={v}+({n})\n",
        "{v}={n}\n",
        "IF {v}{c}{n} THEN\n",
        "ELSE\n",
        "ENDIF\n",
        "WHILE {v}<{n}\n",
        "ENDWHILE\n",
        "FOR {v}={n} TO {m}\n",
        "ENDFOR\n",
        "sub{n}()\n",
        "SWITCH {v}\n",
        "CASE {n}\n",
        "CASE {n},99\n",
        "DEFAULT\n",
        "ENDSWITCH\n",
        "==",
        "<>"},
    fanuc{Language::fanuc,
          "R[{}]",
          "R[{}]",
          ":J P[{n}] 50% FINE ;\n",
          ":WAIT {n}(sec) ;\n",
          ":{v}={v}+({n}) ;\n",
          ":{v}={n} ;\n",
          ":IF ({v}{c}{n}) THEN ;\n",
          ":ELSE ;\n",
          ":ENDIF ;\n",
          ":LBL[{l}] ;\n:IF {v}>={n},JMP LBL[{k}] ;\n",
          ":JMP LBL[{l}] ;\n:LBL[{k}] ;\n",
          ":FOR {v}={n} TO {m} ;\n",
          ":ENDFOR ;\n",
          ":CALL SUB{n} ;\n",
          ":SELECT {v}={n},JMP LBL[{l}] ;\n:={m},JMP LBL[{k}] ;\n:ELSE,JMP LBL[{j}] ;\n",
          ":LBL[{l}] ;\n",
          ":JMP LBL[{i}] ;\n:LBL[{k}] ;\n",
          ":JMP LBL[{i}] ;\n:LBL[{j}] ;\n",
          ":LBL[{i}] ;\n",
          "=",
          "<>"},
    urscript{Language::urscript,
             "v{}",
             "c{}",
             "movej([d2r({n}),-1,1,0,0,0])\n",
             "sleep({n})\n",
             "{v} = {v} + ({n})\n",
             "{v} = {n}\n",
             "if {v} {c} {n}:\n",
             "else:\n",
             "end\n",
             "while {v} < {n}:\n",
             "end\n",
             "{v} = {n}\nwhile {v} <= {m}:\n",
             "{v} = {v} + 1\nend\n",
             "sub{n}()\n",
             "",
             "",
             "",
             "",
             "",
             "==",
             "!="},
    inform{Language::inform,
           "I{:03}",
           "I{:03}",
           "MOVJ C{n:05} VJ=1\n",
           "TIMER T={n}.00\n",
           "SET {v} EXPRESS {v} + {n}\n",
           "SET {v} {n}\n",
           "IFTHENEXP {v}{c}{n}\n",
           "ELSE\n",
           "ENDIF\n",
           "WHILE {v}<{n}\n",
           "ENDWHILE\n",
           "FOR {v} START= {n} TO {m}\n",
           "NEXT {v}\n",
           "CALL JOB:SUB{n}\n",
           "",
           "",
           "",
           "",
           "",
           "=",
           "<>"};

/// Returns the files of a program in a language.
Files files_of(const Written& as, const RandomProgram& program) {
  Writer writer(as);
  Files files;
  std::string start, module, declared, fanuc_taught, inform_taught;
  for (int n = 1; n <= first_angle; ++n) {
    fanuc_taught += fmt::format(
        "P[{}]{{\n GP1:\n UF : 0, UT : 0,\n J1={} deg,J2=0 deg,J3=0 deg,J4=0 deg,J5=0 deg,J6=0 deg\n}};\n", n, n);
    inform_taught += fmt::format("C{:05}={},0,0,0,-90,0\n", n, n);
  }
  for (int v = 1; v <= variables; ++v)
    start += as.language == Language::urscript
                 ? fmt::format("global v{} = 0\n", v)
                 : fmt::format(fmt::runtime(as.assign), fmt::arg("v", fmt::format(fmt::runtime(as.variable), v)),
                               fmt::arg("n", 0));
  start += fmt::format(fmt::runtime(as.move), fmt::arg("n", first_angle));
  for (int r = 0; r < routines; ++r) {
    const std::string body = (r == 0 ? start : "") + writer.text(program.routine(r)),
                      name = r == 0 ? "main" : fmt::format("sub{}", r);
    if (as.language == Language::rapid) module += "PROC " + name + "()\n" + body + "ENDPROC\n";
    if (as.language == Language::krl) module += "DEF " + name + "()\n" + body + "END\n";
    if (as.language == Language::urscript) module = "def " + name + "():\n" + body + "end\n" + module;
    if (as.language == Language::fanuc)
      files.push_back({name + ".ls", "/PROG " + name + "\n/MN\n" + body + "/POS\n" + fanuc_taught + "/END\n"});
    if (as.language == Language::inform)
      files.push_back({name + ".JBI", "/JOB\n//NAME " + (r == 0 ? "MAIN" : fmt::format("SUB{}", r)) +
                                          "\n//POS\n///NPOS 9,0,0,0,0,0\n///TOOL 0\n///POSTYPE ANGLE\n///ANGLE\n" +
                                          inform_taught + "//INST\n///ATTR SC,RW\n///GROUP1 RB1\nNOP\n" + body +
                                          "END\n"});
  }
  for (int v = 1; v <= variables; ++v)
    declared += as.language == Language::rapid ? fmt::format("VAR num v{}:=0;\n", v) : fmt::format("INT v{}\n", v);
  for (int c = 10; c < 40 && as.language == Language::krl; ++c) declared += fmt::format("INT c{}\n", c);
  if (as.language == Language::rapid)
    files.push_back({"main.mod", "MODULE Main\n" + declared + module + "ENDMODULE\n"});
  if (as.language == Language::krl)
    files = {{"main.src", module}, {"main.dat", "DEFDAT main\n" + declared + "ENDDAT\n"}, held_frames};
  if (as.language == Language::urscript) files.push_back({"s.script", module});
  return files;
}

}  // namespace

TEST_CASE("every language runs random branches, loops and calls in the order in which they stand") {
  ImportOptions main;
  main.routine = "main";
  std::size_t run = 0;
  for (unsigned seed = 1; run < 100; ++seed) {
    RandomProgram program(seed);
    const std::vector<int> course = program.run();
    if (course.size() < 5 || course.size() > 300) continue;
    ++run;
    for (const Written* as : {&rapid, &krl, &fanuc, &urscript, &inform}) {
      const Files files = files_of(*as, program);
      const Reading reading = Reader{as->language, main}(files);
      INFO(files[0].first << ", seed " << seed << "\n" << files[0].second);
      REQUIRE(reading.problem() == "no such problem");
      std::vector<int> read;
      for (const Instruction& one : reading.program.instructions)
        read.push_back(one.kind == Instruction::Kind::dwell ? int(std::lround(one.dwell))
                                                            : -int(std::lround(one.target.joints.at(0) / degree)));
      REQUIRE(read == course);
    }
  }
}
