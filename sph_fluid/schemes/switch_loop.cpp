// Pairs of the scheme monaghan_switch, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/switch_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
void monaghan_switch_rates(const PairInput& in, const PairOutput& out) {
  pass<AnyKernel, MonaghanSwitch, T>(in, out);
}

template void monaghan_switch_rates<double>(const PairInput&, const PairOutput&);
template void monaghan_switch_rates<float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
