// A program of a stage that failed.
#pragma once

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

/// The program has printed its error already, so the program that started it prints nothing more. what() is for a caller that
/// continues without the program.
class StageFailed : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace dresslife::pipeline
