#define CATCH_CONFIG_RUNNER  // version 2 then compiles all of Catch2 here, and only here
#include "tests/catch.h"

int main(int argc, char** argv) { return Catch::Session().run(argc, argv); }
