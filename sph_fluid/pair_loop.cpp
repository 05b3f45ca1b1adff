// The fluid's passes over pairs, compiled once per instruction set; see pair_loop.hpp for the choice at start-up.
#include "sph_fluid/cluster_work.hpp"
#include "sph_fluid/monaghan_scheme.hpp"
#include "sph_fluid/reconstruction.hpp"
#include "sph_fluid/riemann_scheme.hpp"

namespace undex::sph::UNDEX_LEVEL {

template <class Kernel, class T>
void monaghan_rates(const PairInput& in, const PairOutput& out) {
  pass<Kernel, Monaghan, T>(in, out);
}

template <class Kernel, class T>
void riemann_rates(const PairInput& in, const PairOutput& out) {
  pass<Kernel, Reconstruction, T>(in, out);
  pass<Kernel, Riemann, T>(in, out);
}

#define UNDEX_INSTANTIATE(Kernel)                                                  \
  template void monaghan_rates<Kernel, double>(const PairInput&, const PairOutput&); \
  template void monaghan_rates<Kernel, float>(const PairInput&, const PairOutput&);  \
  template void riemann_rates<Kernel, double>(const PairInput&, const PairOutput&);  \
  template void riemann_rates<Kernel, float>(const PairInput&, const PairOutput&);
UNDEX_INSTANTIATE(Gaussian)
UNDEX_INSTANTIATE(WendlandC2)

}  // namespace undex::sph::UNDEX_LEVEL
