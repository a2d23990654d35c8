#include "sim/program/fanuc/words.h"

#include <algorithm>
#include <utility>

namespace dresslife::sim {
namespace {

using Words = std::pair<std::string_view, std::string_view>;

constexpr Words anywhere[] = {
    {"AN", "ON"},
    {"AUS", "OFF"},
    {"AUFRUF", "CALL"},
    {"BALM", "UALM"},
    {"BENUTZER", "UFRAME"},
    {"BENUTZER_NUM", "UFRAME_NUM"},
    {"ENDE", "END"},
    {"FUER", "FOR"},
    {"Interrupt", "Skip"},
    {"LABEL", "LBL"},
    {"MELDUNG", "MESSAGE"},
    {"SONST", "ELSE"},
    {"SPERRE", "LOCK"},
    {"SPRUNG", "JMP"},
    {"TRAGLST", "PAYLOAD"},
    {"WARTE", "WAIT"},
    {"WENN", "IF"},
    {"WKZ", "UTOOL"},
    {"WKZ_NUM", "UTOOL_NUM"},
    {"WKZ_Offset", "Tool_Offset"},
    {"Grad", "deg"},
    {"msek", "msec"},
    {"sek", "sec"},
};

/// Words that are translated only before a bracket, because names can contain the same letters.
constexpr Words before_bracket[] = {{"A", "DO"},  {"E", "DI"},  {"gA", "GO"}, {"gE", "GI"}, {"i", "R"},
                                    {"aA", "AO"}, {"aE", "AI"}, {"RA", "RO"}, {"RE", "RI"}};

constexpr Words phrases[] = {
    {"ZEIT VOR", "TB"},          {"ZEIT NACH", "TA"},  {"WEG VOR", "DB"},   {"WEG NACH", "DA"},
    {"FB-PSPS", "TC_ONLINE"},    {"FREIG.", "UNLOCK"}, {"IST ", "SELECT "}, {"IRQ BEDINGUNG", "SKIP CONDITION"},
    {"max_Geschw.", "max_speed"}};

bool letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' ||
         static_cast<unsigned char>(c) >= 0x80;
}
bool letter_or_digit(char c) { return letter(c) || (c >= '0' && c <= '9'); }

class Translation {
 public:
  explicit Translation(std::string_view text) : text_(text) {}

  std::string run() {
    while (at_ < text_.size()) {
      if (text_[at_] == '\'')
        copy_to(text_.find('\'', at_ + 1));
      else if (text_[at_] == '[')
        bracket();
      else if (text_[at_] == ':' && depth_ > 0)
        comment();
      else if (letter(text_[at_]))
        word();
      else
        sign();
    }
    return std::move(made_);
  }

 private:
  void copy_to(std::size_t last) {
    const std::size_t end = std::min(last == std::string_view::npos ? text_.size() : last + 1, text_.size());
    made_ += text_.substr(at_, end - at_);
    at_ = end;
  }

  void bracket() {  // DI[1] [&] DI[2]
    if (text_.substr(at_, 3) == "[&]" || text_.substr(at_, 3) == "[+]") {
      made_ += text_[at_ + 1] == '&' ? " AND " : " OR ";
      at_ += 3;
      return;
    }
    ++depth_;
    copy_to(at_);
  }

  void comment() { copy_to(text_.find(']', at_) - 1); }

  void sign() {
    if (text_[at_] == ']') --depth_;
    copy_to(at_);
  }

  void word() {
    for (const auto& [german, english] : phrases)
      if (text_.substr(at_, german.size()) == german) {
        made_ += english;
        at_ += german.size();
        return;
      }
    std::size_t end = at_;
    while (end < text_.size() && letter_or_digit(text_[end])) ++end;
    const std::string_view found = text_.substr(at_, end - at_);
    const bool program = last_ == "CALL" || last_ == "RUN";
    last_ = program ? found : english(found, end);
    made_ += last_;
    at_ = end;
  }

  std::string_view english(std::string_view found, std::size_t end) const {
    if (end < text_.size() && text_[end] == '[')
      for (const auto& [german, english] : before_bracket)
        if (found == german) return english;
    for (const auto& [german, english] : anywhere)
      if (found == german) return english;
    return found;
  }

  std::string_view text_, last_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string made_;
};

}  // namespace

std::string fanuc_in_english(std::string_view statement) { return Translation(statement).run(); }

}  // namespace dresslife::sim
