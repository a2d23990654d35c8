// What nearly every test includes, compiled once for all of them (CMakeLists.txt). Tests include what they use all the
// same.
#pragma once

#include <random>

#include "pipeline/base/precompiled.h"
#include "tests/catch.h"
