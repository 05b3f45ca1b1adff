// The concentration that particles are shifted by, compiled once per instruction set; see pair_loop.hpp for the choice at
// start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/shifting.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
void concentration(const PairInput& in, const PairOutput& out) {
  pass<AnyKernel, Concentration, T>(in, out);
}

template void concentration<double>(const PairInput&, const PairOutput&);
template void concentration<float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
