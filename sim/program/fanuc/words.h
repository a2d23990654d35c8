// Translates the German words of a Fanuc listing to English. A controller writes its listings in the language of its
// teach pendant.
//
// A[n] and E[n] are outputs and inputs, i[n] is a register, gA[n] and gE[n] are group outputs and inputs; AN and AUS,
// AUFRUF, SPRUNG, LABEL, WENN, SONST, WARTE, ENDE, BENUTZER_NUM, WKZ_NUM ... These words have no other meaning in an
// English listing, so every listing is translated. Program names, comments and quoted texts are not changed.
// Source: listings of one program that controllers wrote in both languages.
#pragma once

#include <string>
#include <string_view>

namespace dresslife::sim {

std::string fanuc_in_english(std::string_view statement);

}  // namespace dresslife::sim
