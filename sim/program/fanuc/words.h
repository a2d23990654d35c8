// German words of a Fanuc listing as the English ones that the reader knows: a controller writes its listings
// in the language of its teach pendant.
//
// A[n] and E[n] are outputs and inputs, i[n] is a register, gA[n] and gE[n] are groups; AN and AUS, AUFRUF,
// SPRUNG, LABEL, WENN, SONST, WARTE, ENDE, BENUTZER_NUM, WKZ_NUM ... None of them means anything else in an
// English listing, so every listing is translated. Names of programs, comments and texts in quotes stay as
// they are. Source: listings of one program that controllers wrote in both languages.
#pragma once

#include <string>
#include <string_view>

namespace dresslife::sim {

std::string fanuc_in_english(std::string_view statement);

}  // namespace dresslife::sim
