// Steps the benchmarks' block of water a number of times, for instructions.py to count what that takes.
//   block_steps VARIANT PARTICLES STEPS   one thread, a fixed step; prints particles and CPU level of the pair loops
//   block_steps --names                   the variants
#include <cstdio>
#include <cstdlib>
#include <string>

#include "bench/block.hpp"
#include "sph_fluid/pairs/cpu_level.hpp"

/// What is counted; instructions.py knows it by this name.
extern "C" [[gnu::noinline]] void counted_steps(undex::sph::Fluid& fluid, int steps) {
  for (int k = 0; k < steps; ++k) fluid.step(1e-7);
}

int main(int argc, char** argv) {
  using namespace undex;
  const std::string asked = argc > 1 ? argv[1] : "";
  const bool names = argc == 2 && asked == "--names";
  for (const bench::Variant& variant : bench::variants()) {
    if (names) std::puts(variant.name.c_str());
    if (argc != 4 || asked != variant.name) continue;
    sph::Fluid fluid(bench::block(variant, std::atof(argv[2]), 1));
    counted_steps(fluid, std::atoi(argv[3]));
    std::printf("%zu %s\n", fluid.particle_count(), sph::cpu_level());
    return 0;
  }
  return names ? 0 : 2;
}
