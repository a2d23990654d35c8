// Which geometry of nested helices counts (strain/README.md, W5 to W9).
#pragma once

#include <string_view>

namespace dresslife::pipeline {

enum class Kinematics { exact, thesis };
constexpr std::string_view word(Kinematics value) {
  switch (value) {
    case Kinematics::exact:
      return "exact";
    case Kinematics::thesis:
      return "thesis";
  }
  return {};
}
/// Whether (12) to (23) are used as they are printed; else the geometry itself.
constexpr bool is_thesis(Kinematics value) {
  switch (value) {
    case Kinematics::thesis:
      return true;
    case Kinematics::exact:
      return false;
  }
  return false;
}

}  // namespace dresslife::pipeline
