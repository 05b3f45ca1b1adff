// The Riemann scheme's pairs, compiled once per instruction set; see pair_loop.hpp for the choice at start-up. Its gradients are
// compiled in reconstruction_loop.cpp.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/riemann_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class Kernel, class T>
void riemann_rates(const PairInput& in, const PairOutput& out) {
  pass<Kernel, Riemann, T>(in, out);
}

template void riemann_rates<Gaussian, double>(const PairInput&, const PairOutput&);
template void riemann_rates<Gaussian, float>(const PairInput&, const PairOutput&);
template void riemann_rates<WendlandC2, double>(const PairInput&, const PairOutput&);
template void riemann_rates<WendlandC2, float>(const PairInput&, const PairOutput&);
template void riemann_rates<AnyKernel, double>(const PairInput&, const PairOutput&);
template void riemann_rates<AnyKernel, float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
