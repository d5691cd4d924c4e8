#define CATCH_CONFIG_RUNNER
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>

#include "core/step/kernels.h"

int main(int argc, char** argv) {
  const char* kernels = std::getenv("PASTEFIT_KERNELS");
  if (kernels && *kernels && !pastefit::use_kernels(kernels)) {
    std::fprintf(stderr, "PASTEFIT_KERNELS: this processor runs %s\n", pastefit::usable_kernels().c_str());
    return 2;
  }
  return Catch::Session().run(argc, argv);
}
