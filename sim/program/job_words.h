// Remedies of the importer in the words of a job: readers name options of dresslife-import, which no other program has.
#pragma once

#include <string>

namespace dresslife::sim {

/// "--value 'di1=...'" as "motion.values: [{name: di1, value: VALUE}]", a line at the first level of a job; in the same way --assume,
/// --module, --frames and --routine. All other text stays.
std::string in_words_of_a_job(std::string text);

}  // namespace dresslife::sim
