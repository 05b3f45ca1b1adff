// Pairs of the scheme paper, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/paper_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
void paper_rates(const PairInput& in, const PairOutput& out) {
  pass<AnyKernel, Paper, T>(in, out);
}

template void paper_rates<double>(const PairInput&, const PairOutput&);
template void paper_rates<float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
