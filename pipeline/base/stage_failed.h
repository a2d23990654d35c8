// A program of a stage that failed.
#pragma once

#include "pipeline/base/errors.h"

namespace dresslife::pipeline {

/// It has printed its error, so that the program that started it prints nothing more. what(): for a caller that goes on
/// without it.
class StageFailed : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace dresslife::pipeline
