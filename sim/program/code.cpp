#include "sim/program/code.h"

namespace dresslife::sim {

void Code::index() {
  for (std::size_t i = 0; i < routines.size(); ++i)
    by_name_.emplace(routines[i].name, i);  // the first one stays
}

const Routine* Code::find(const std::string& name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &routines[found->second];
}

const RecordType* Code::record(const std::string& name) const {
  for (const RecordType& type : records)
    if (type.name == name) return &type;
  return nullptr;
}

}  // namespace dresslife::sim
