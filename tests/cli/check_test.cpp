// scripts/check guards the arrows between the rooms: a copy of the tree in which one is broken is refused.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/cli/process.h"

namespace fs = std::filesystem;
