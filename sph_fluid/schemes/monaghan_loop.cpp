// Monaghan's pairs, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/monaghan_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class Kernel, class T>
void monaghan_rates(const PairInput& in, const PairOutput& out) {
  pass<Kernel, Monaghan, T>(in, out);
}

template void monaghan_rates<Gaussian, double>(const PairInput&, const PairOutput&);
template void monaghan_rates<Gaussian, float>(const PairInput&, const PairOutput&);
template void monaghan_rates<WendlandC2, double>(const PairInput&, const PairOutput&);
template void monaghan_rates<WendlandC2, float>(const PairInput&, const PairOutput&);
template void monaghan_rates<AnyKernel, double>(const PairInput&, const PairOutput&);
template void monaghan_rates<AnyKernel, float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
