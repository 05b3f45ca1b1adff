// Pairs of the scheme riemann_corrected, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/pairs/cluster_work.hpp"
#include "sph_fluid/schemes/corrected_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class T>
void corrected_reconstruction(const PairInput& in, const PairOutput& out) {
  pass<AnyKernel, CorrectedReconstruction, T>(in, out);
}

template <class T>
void riemann_corrected_rates(const PairInput& in, const PairOutput& out) {
  pass<AnyKernel, RiemannCorrected, T>(in, out);
}

template void corrected_reconstruction<double>(const PairInput&, const PairOutput&);
template void corrected_reconstruction<float>(const PairInput&, const PairOutput&);
template void riemann_corrected_rates<double>(const PairInput&, const PairOutput&);
template void riemann_corrected_rates<float>(const PairInput&, const PairOutput&);

}  // namespace undex::sph::UNDEX_LEVEL
