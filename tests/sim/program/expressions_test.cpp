// Values of expressions and conditions in every language: random expressions with the fewest possible parentheses.
#include <cmath>
#include <random>

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using namespace dresslife::tests;

namespace {

/// The syntax of expressions and waits in a language.
struct Syntax {
  Language language;
  std::string file, begin, end;
  std::string wait, wait_one_if, otherwise;  // {} is a value in wait, a condition in wait_one_if
  std::vector<std::pair<std::string, double (*)(double)>> functions;
  std::string equal, unequal, both, either, no;
  std::vector<std::pair<std::string, double (*)(double, double)>> whole;  // operators for whole numbers
};

double sine(double x) { return std::sin(x * degree); }
double cosine(double x) { return std::cos(x * degree); }
double tangent(double x) { return std::tan(x * degree); }
double divided(double a, double b) { return std::trunc(a / b); }
double absolute(double x) { return std::abs(x); }
double truncated(double x) { return std::trunc(x); }
double rounded(double x) { return std::round(x); }
double lower_whole(double x) { return std::floor(x); }
double upper_whole(double x) { return std::ceil(x); }
double remainder_of(double a, double b) { return std::fmod(a, b); }

const std::vector<Syntax> languages{
    {Language::rapid,
     "main.mod",
     "MODULE Main\nPROC main()\nMoveAbsJ [[0,-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n",
     "ENDPROC\nENDMODULE\n",
     "WaitTime {};\n",
     "IF {} THEN\nWaitTime 1;\nELSE\n",
     "WaitTime 2;\nENDIF\n",
     {{"Abs({})", absolute},
      {"Sin({})", sine},
      {"Cos({})", cosine},
      {"Tan({})", tangent},
      {"Trunc({})", truncated},
      {"Round({})", rounded}},
     "=",
     "<>",
     "AND",
     "OR",
     "NOT",
     {{"DIV", divided}, {"MOD", remainder_of}}},
    {Language::krl,
     "cell.src",
     "DEF cell()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\n",
     "END\n",
     "WAIT SEC {}\n",
     "IF {} THEN\nWAIT SEC 1\nELSE\n",
     "WAIT SEC 2\nENDIF\n",
     {{"ABS({})", absolute}, {"SIN({})", sine}, {"COS({})", cosine}, {"TAN({})", tangent}},
     "==",
     "<>",
     "AND",
     "OR",
     "NOT",
     {{"/", divided}}},
    {Language::fanuc,
     "cell.ls",
     "/PROG CELL\n/MN\n:J P[1] 50% FINE ;\n",
     "/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n J1=0 deg,J2=0 deg,J3=0 deg,J4=0 deg,J5=0 deg,J6=0 deg\n};\n/END\n",
     ":R[1]=({}) ;\n:WAIT R[1](sec) ;\n",
     ":IF ({}) THEN ;\n:WAIT 1(sec) ;\n:ELSE ;\n",
     ":WAIT 2(sec) ;\n:ENDIF ;\n",
     {{"ABS[{}]", absolute},
      {"SIN[{}]", sine},
      {"COS[{}]", cosine},
      {"TAN[{}]", tangent},
      {"TRUNC[{}]", truncated},
      {"ROUND[{}]", rounded}},
     "=",
     "<>",
     "AND",
     "OR",
     "!",
     {{"DIV", divided}, {"MOD", remainder_of}}},
    {Language::urscript,
     "s.script",
     "def main():\nmovej([0,-1,1,0,0,0])\n",
     "end\n",
     "sleep({})\n",
     "if {}:\nsleep(1)\nelse:\n",
     "sleep(2)\nend\n",
     {{"sin(d2r({}))", sine},
      {"cos(d2r({}))", cosine},
      {"tan(d2r({}))", tangent},
      {"floor({})", lower_whole},
      {"ceil({})", upper_whole}},
     "==",
     "!=",
     "and",
     "or",
     "not",
     {{"%", remainder_of}}}};

struct Part {
  std::string text;
  double value;
  int binds;  // precedence; 1: sum, OR; 2: product, AND; 3: others
  std::string within(int least) const { return binds < least ? "(" + text + ")" : text; }
};

class Random {
 public:
  explicit Random(const Syntax& syntax) : syntax_(syntax) {}

  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

  Part expression(int depth) {
    const int kind = depth == 0 ? 0 : below(7);
    if (kind == 0) {
      const double value = below(9) + 1.5;
      return {fmt::format("{:.1f}", value), value, 3};
    }
    if (kind == 1) {
      const auto& [name, of] =
          syntax_.functions[static_cast<std::size_t>(below(static_cast<int>(syntax_.functions.size())))];
      const Part x = expression(depth - 1);
      return {fmt::format(fmt::runtime(name), x.text), of(x.value), 3};
    }
    if (kind == 2) {
      const auto& [name, of] = syntax_.whole[static_cast<std::size_t>(below(static_cast<int>(syntax_.whole.size())))];
      const int a = below(40), b = 1 + below(9);
      return {fmt::format("({} {} {})", a, name, b), of(a, b), 3};
    }
    const Part a = expression(depth - 1), b = expression(kind == 6 ? 0 : depth - 1);
    if (kind == 3) return {a.text + "+" + b.within(2), a.value + b.value, 1};
    if (kind == 4) return {a.text + "-" + b.within(2), a.value - b.value, 1};
    if (kind == 5) return {a.within(2) + "*" + b.within(3), a.value * b.value, 2};
    return {a.within(2) + "/" + b.text, a.value / b.value, 2};
  }

  /// Returns a random condition. Its value is 0 or 1.
  Part condition(int depth) {
    const int kind = depth == 0 ? 0 : below(4);
    if (kind == 0) {
      const int a = below(3), b = below(3), op = below(6);
      const std::string names[]{"<", "<=", ">", ">=", syntax_.equal, syntax_.unequal};
      const bool holds[] = {a<b, a <= b, a> b, a >= b, a == b, a != b};
      return {fmt::format("({}{}{})", a, names[op], b), double(holds[op]), 3};
    }
    const Part a = condition(depth - 1);
    // NOT in RAPID applies to all operands joined by AND.
    if (kind == 1)
      return {fmt::format("{}({})", syntax_.no, a.text), 1 - a.value, syntax_.language == Language::rapid ? 1 : 3};
    const Part b = condition(depth - 1);
    if (kind == 2) return {a.within(2) + " " + syntax_.both + " " + b.within(2), a.value * b.value, 2};
    return {a.text + " " + syntax_.either + " " + b.text, std::max(a.value, b.value), 1};
  }

 private:
  const Syntax& syntax_;
  std::mt19937 engine_{11};
};

/// Checks waits of 1000 s plus each value of `expected`. before: declarations and assignments.
void check_values(const Syntax& syntax, const std::string& before,
                  const std::vector<std::pair<std::string, double>>& expected) {
  std::string text = syntax.begin;
  text.insert(before.starts_with("VAR") ? text.find("MoveAbsJ") : text.size(), before);
  for (const auto& [written, value] : expected) text += fmt::format(fmt::runtime(syntax.wait), "1000.0+" + written);
  const Reading r = Reader{syntax.language}({{syntax.file, text + syntax.end}});
  REQUIRE(r.problem() == "no such problem");
  REQUIRE(r.program.instructions.size() == expected.size() + 1);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    INFO(expected[k].first);
    // single precision has steps of 6e-5 near 1000
    const double step = syntax.language == Language::urscript ? 1e-9 : 4e-5;
    CHECK(r.move(k + 1).dwell - 1000 == Approx(expected[k].second).margin(step));
  }
}

}  // namespace

TEST_CASE("rapid: functions of numbers, texts, vectors and poses have their values") {
  check_values(languages[0],
               "VAR num list{3,2}:=[[1,2],[3,4],[5,6]];\nVAR pose one:=[[100,20,3],[1,0,0,0]];\n"
               "VAR pose other:=[[10,20,30],[1,0,0,0]];\n"
               "VAR pose product;\nVAR pose back;\nVAR pos moved;\nVAR orient turned;\nVAR orient pole;\n"
               "VAR orient unit;\nVAR pos sum;\n"
               "VAR pos less;\nVAR pos across;\nVAR pos twice;\nVAR pos half;\nVAR pos minus;\nVAR pose made;\n"
               "VAR robtarget p1:=[[100,200,300],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];\n"
               "turned:=OrientZYX(30,40,50);\npole:=OrientZYX(30,90,0);\nunit:=NOrient([0,3,0,4]);\n"
               "one.rot:=OrientZYX(90,0,0);\n"
               "other.rot:=OrientZYX(0,0,90);\nproduct:=PoseMult(one,other);\nback:=PoseInv(one);\n"
               "moved:=PoseVect(one,[10,20,30]);\n"
               "sum:=[1,2,3]+[4,6,8];\nless:=[1,2,3]-[4,6,8];\nacross:=[1,2,3]*[4,6,9];\ntwice:=2*[1,2,3];\n"
               "half:=[1,2,3]/2;\nminus:=-sum;\n"
               "made:=DefFrame(p1,Offs(p1,0,50,0),Offs(p1,-20,30,0));\n",
               {{"Sqrt(6.25)", 2.5},
                {"ASin(0.5)", 30},
                {"ACos(0.5)", 60},
                {"ATan(1)", 45},
                {"ATan2(1,-1)", 135},
                {"Exp(2)", std::exp(2.0)},
                {"Pow(2,5)", 32},
                {"Max(3,5)", 5},
                {"Min(3,5)", 3},
                {"Round(2.567\\Dec:=2)", 2.57},
                {"Trunc(2.567\\Dec:=1)", 2.5},
                {"BitNeg(5)", 250},
                {"BitAnd(12,10)", 8},
                {"BitOr(12,10)", 14},
                {"BitXOr(12,10)", 6},
                {"BitLSh(129,1)", 2},
                {"BitRSh(12,2)", 3},
                {"StrLen(\"Robot\")", 5},
                {"StrLen(StrPart(\"Robotics\",4,5))", 5},
                {"StrFind(\"Robotics\",1,\"aeiou\")", 2},
                {"StrFind(\"Robotics\",3,\"aeiou\")", 4},
                {"StrFind(\"Robotics\",1,\"zk\")", 9},
                {"StrFind(\"Robotics\",9,\"R\")", 9},
                {"StrFind(\"Robotics\",1,\"oRb\"\\NotInSet)", 5},
                {"StrMatch(\"Robotics\",1,\"bo\")", 3},
                {"StrMatch(\"Robotics\",4,\"bo\")", 9},
                {"StrMatch(\"Robotics\",9,\"bo\")", 9},
                {"StrLen(NumToStr(2.5678,2))", 4},
                {"StrLen(ValToStr(TRUE))", 4},
                {"StrLen(ValToStr(1.25))", 4},
                {"Dim(list,1)", 3},
                {"Dim(list,2)", 2},
                {"list{3,1}", 5},
                {"Distance([0,0,0],[3,4,12])", 13},
                {"DotProd([1,2,3],[4,5,6])", 32},
                {"VectMagn([2,3,6])", 7},
                {"EulerZYX(\\X,turned)", 50},
                {"EulerZYX(\\Y,turned)", 40},
                {"EulerZYX(\\Z,turned)", 30},
                {"EulerZYX(\\X,pole)", 0},
                {"EulerZYX(\\Y,pole)", 90},
                {"EulerZYX(\\Z,pole)", 30},
                {"unit.q2", 0.6},
                {"unit.q4", 0.8},
                // A turn by 90 deg about z moves the point (10, 20) to (-20, 10).
                {"product.trans.x", 80},
                {"product.trans.y", 30},
                {"product.trans.z", 33},
                {"EulerZYX(\\Z,product.rot)", 90},
                {"EulerZYX(\\X,product.rot)", 90},
                {"back.trans.x", -20},
                {"back.trans.y", 100},
                {"back.trans.z", -3},
                {"EulerZYX(\\Z,back.rot)", -90},
                {"moved.x", 80},
                {"moved.y", 30},
                {"moved.z", 33},
                {"sum.x", 5},
                {"sum.z", 11},
                {"less.y", -4},
                {"across.x", 0},
                {"across.y", 3},
                {"across.z", -2},
                {"twice.z", 6},
                {"half.y", 1},
                {"minus.x", -5},
                {"minus.y", -8},
                {"made.trans.y", 200},
                {"EulerZYX(\\Z,made.rot)", 90},
                {"EulerZYX(\\X,made.rot)", 0}});
}

TEST_CASE("krl: functions of numbers and bits, and frames in frames") {
  check_values(languages[1],
               "DECL FRAME f,g,h\nf={X 100,Y 20,Z 3,A 90,B 0,C 0}\ng=f:{X 10,Y 20,Z 30,A 0,B 0,C 90}\nh=INV_POS(f)\n",
               {{"SQRT(6.25)", 2.5},
                {"ACOS(0.5)", 60},
                {"ATAN2(1.0,-1.0)", 135},
                {"(12 B_AND 10)", 8},
                {"(12 B_OR 10)", 14},
                {"(12 B_EXOR 10)", 6},
                {"(B_NOT 10)", -11},
                {"-7/2", -3},
                {"7/2*2", 6},
                {"7.0/2", 3.5},
                {"g.X", 80},
                {"g.Y", 30},
                {"g.Z", 33},
                {"g.A", 90},
                {"g.C", 90},
                {"h.X", -20},
                {"h.Y", 100},
                {"h.Z", -3},
                {"h.A", -90}});
}

TEST_CASE("urscript: functions of numbers, lists and poses") {
  check_values(languages[3],
               "f=p[0.1,0.02,0.003,0,0,d2r(90)]\ng=pose_trans(f,p[0.01,0.02,0.03,0,0,d2r(30)])\nh=pose_inv(f)\n"
               "sum=pose_add(f,g)\n"
               "less=pose_sub(g,f)\nbetween=interpolate_pose(f,g,0.25)\nturn=rpy2rotvec([0,0,0.5])\n"
               "rpy=rotvec2rpy(rpy2rotvec([0.3,0.4,0.5]))\n",
               {{"sqrt(6.25)", 2.5},     {"r2d(asin(0.5))", 30},    {"r2d(acos(0.5))", 60},
                {"r2d(atan(1))", 45},    {"r2d(atan2(1,-1))", 135}, {"pow(2,5)", 32},
                {"log10(1000)", 3},      {"floor(-2.5)", -3},       {"ceil(2.5)", 3},
                {"norm([2,3,6])", 7},    {"length([1,2,3,4])", 4},  {"point_dist(f,p[0.13,0.06,0.123,0,0,0])", 0.13},
                {"1000*g[0]", 80},       {"1000*g[1]", 30},         {"1000*g[2]", 33},
                {"r2d(g[5])", 120},      {"1000*h[0]", -20},        {"1000*h[1]", 100},
                {"1000*h[2]", -3},       {"r2d(h[5])", -90},        {"1000*sum[0]", 180},
                {"r2d(sum[5])", -150},   {"1000*less[2]", 30},      {"r2d(less[5])", 30},
                {"1000*between[0]", 95}, {"r2d(between[5])", 97.5}, {"turn[2]", 0.5},
                {"rpy[0]", 0.3},         {"rpy[1]", 0.4},           {"rpy[2]", 0.5}});
}

TEST_CASE("every language reckons random expressions as arithmetic does, and decides as logic does") {
  for (const Syntax& syntax : languages) {
    Random random(syntax);
    std::string text = syntax.begin;
    std::vector<double> waits;
    std::vector<std::string> texts;
    while (waits.size() < 150) {
      const Part part = random.expression(4);
      if (!(std::abs(part.value) < 400)) continue;
      text += fmt::format(fmt::runtime(syntax.wait), "500.0+" + part.within(2));
      waits.push_back(500 + part.value), texts.push_back(part.text);
    }
    for (int k = 0; k < 150; ++k) {
      const Part part = random.condition(3);
      text += fmt::format(fmt::runtime(syntax.wait_one_if), part.text) + syntax.otherwise;
      waits.push_back(part.value == 1 ? 1 : 2), texts.push_back(part.text);
    }
    const Reading r = Reader{syntax.language}({{syntax.file, text + syntax.end}});
    REQUIRE(r.problem() == "no such problem");
    REQUIRE(r.program.instructions.size() == waits.size() + 1);
    const double rounding = syntax.language == Language::urscript ? 1e-9 : 2e-7;  // the others have single precision
    for (std::size_t k = 0; k < waits.size(); ++k) {
      INFO(texts[k] << " in " << syntax.file);
      CHECK(r.move(k + 1).dwell == Approx(waits[k]).epsilon(rounding));
    }
  }
}
