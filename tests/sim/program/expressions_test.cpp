// What every language reckons and decides: random expressions, with as few parentheses as their meaning allows.
#include <cmath>
#include <numbers>
#include <random>

#include "tests/catch.h"
#include "tests/sim/program/reading.h"

using namespace dresslife;
using namespace dresslife::sim;
using dresslife::tests::Reader;
using dresslife::tests::Reading;

namespace {

/// How a language writes them.
struct Syntax {
  Language language;
  std::string file, begin, end;
  std::string wait, wait_one_if, otherwise;  // {}: a value, a condition
  std::vector<std::pair<std::string, double (*)(double)>> functions;
  std::string equal, unequal, both, either, no;
  std::vector<std::pair<std::string, double (*)(double, double)>> whole;  // operators of whole numbers
};

constexpr double degree = std::numbers::pi / 180;
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
    {Language::rapid, "main.mod",
     "MODULE Main\nPROC main()\nMoveAbsJ [[0,-10,10,0,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;\n", "ENDPROC\nENDMODULE\n",
     "WaitTime {};\n", "IF {} THEN\nWaitTime 1;\nELSE\n", "WaitTime 2;\nENDIF\n",
     {{"Abs({})", absolute}, {"Sin({})", sine}, {"Cos({})", cosine}, {"Tan({})", tangent}, {"Trunc({})", truncated}, {"Round({})", rounded}},
     "=", "<>", "AND", "OR", "NOT", {{"DIV", divided}, {"MOD", remainder_of}}},
    {Language::krl, "cell.src", "DEF cell()\nPTP {A1 0,A2 -90,A3 90,A4 0,A5 0,A6 0}\n", "END\n", "WAIT SEC {}\n",
     "IF {} THEN\nWAIT SEC 1\nELSE\n", "WAIT SEC 2\nENDIF\n",
     {{"ABS({})", absolute}, {"SIN({})", sine}, {"COS({})", cosine}, {"TAN({})", tangent}}, "==", "<>", "AND", "OR", "NOT", {{"/", divided}}},
    {Language::fanuc, "cell.ls", "/PROG CELL\n/MN\n:J P[1] 50% FINE ;\n",
     "/POS\nP[1]{\n GP1:\n UF : 0, UT : 0,\n J1=0 deg,J2=0 deg,J3=0 deg,J4=0 deg,J5=0 deg,J6=0 deg\n};\n/END\n",
     ":R[1]=({}) ;\n:WAIT R[1](sec) ;\n", ":IF ({}) THEN ;\n:WAIT 1(sec) ;\n:ELSE ;\n", ":WAIT 2(sec) ;\n:ENDIF ;\n",
     {{"ABS[{}]", absolute}, {"SIN[{}]", sine}, {"COS[{}]", cosine}, {"TAN[{}]", tangent}, {"TRUNC[{}]", truncated}, {"ROUND[{}]", rounded}},
     "=", "<>", "AND", "OR", "!", {{"DIV", divided}, {"MOD", remainder_of}}},
    {Language::urscript, "s.script", "def main():\nmovej([0,-1,1,0,0,0])\n", "end\n", "sleep({})\n", "if {}:\nsleep(1)\nelse:\n",
     "sleep(2)\nend\n",
     {{"sin(d2r({}))", sine}, {"cos(d2r({}))", cosine}, {"tan(d2r({}))", tangent}, {"floor({})", lower_whole}, {"ceil({})", upper_whole}},
     "==", "!=", "and", "or", "not", {{"%", remainder_of}}}};

struct Part {
  std::string text;
  double value;
  int binds;  // 1: a sum, or; 2: a product, and; 3: neither
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
      const auto& [name, of] = syntax_.functions[static_cast<std::size_t>(below(static_cast<int>(syntax_.functions.size())))];
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

  /// value: 0 or 1.
  Part condition(int depth) {
    const int kind = depth == 0 ? 0 : below(4);
    if (kind == 0) {
      const int a = below(3), b = below(3), op = below(6);
      const std::string names[]{"<", "<=", ">", ">=", syntax_.equal, syntax_.unequal};
      const bool holds[]{a < b, a <= b, a > b, a >= b, a == b, a != b};
      return {fmt::format("({}{}{})", a, names[op], b), double(holds[op]), 3};
    }
    const Part a = condition(depth - 1);
    // RAPID's NOT takes all that AND joins.
    if (kind == 1) return {fmt::format("{}({})", syntax_.no, a.text), 1 - a.value, syntax_.language == Language::rapid ? 1 : 3};
    const Part b = condition(depth - 1);
    if (kind == 2) return {a.within(2) + " " + syntax_.both + " " + b.within(2), a.value * b.value, 2};
    return {a.text + " " + syntax_.either + " " + b.text, std::max(a.value, b.value), 1};
  }

 private:
  const Syntax& syntax_;
  std::mt19937 engine_{11};
};

}  // namespace

TEST_CASE("every language reckons random expressions as arithmetic does, and decides as logic does", "[new]") {
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
    for (std::size_t k = 0; k < waits.size(); ++k) {
      INFO(texts[k] << " in " << syntax.file);
      CHECK(r.move(k + 1).dwell == Approx(waits[k]).epsilon(1e-9));
    }
  }
}
