// The gradients of the Riemann scheme, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/reconstruction.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class Kernel, class T>
void reconstruction(const PairInput& in, const PairOutput& out) {
  pass<Kernel, Reconstruction, T>(in, out);
}

template void reconstruction<Gaussian, double>(const PairInput&, const PairOutput&);
template void reconstruction<Gaussian, float>(const PairInput&, const PairOutput&);
template void reconstruction<WendlandC2, double>(const PairInput&, const PairOutput&);
template void reconstruction<WendlandC2, float>(const PairInput&, const PairOutput&);
template void reconstruction<AnyKernel, double>(const PairInput&, const PairOutput&);
template void reconstruction<AnyKernel, float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
