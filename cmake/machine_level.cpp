// Prints the name of the machine's instruction set, for CMake.
#include <cstdio>

#include "sph_fluid/pairs/machine_level.hpp"

int main() { std::printf("v%d", undex::sph::machine_level()); }
