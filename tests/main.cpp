#define CATCH_CONFIG_RUNNER  // in version 2, compiles all of Catch2 in this file
#include "tests/catch.h"

int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
