// The pair schemes, one line each. From it follow their names, what others ask about them, and their compiled loops
// (schemes/loops.hpp; sph_fluid/CMakeLists.txt reads this file).
//   name           in scenes; the scheme stands in schemes/<name>.hpp
//   rates          the pass that gives forces, rates of density and heat
//   gradients      TWO_PASSES only: the pass before it
//   viscous        dissipates by Monaghan's viscosity, which limits the step; or inviscid
//   rings          also over rings about an axis, in axisymmetric scenes; or no_rings
//   kernels        those with a compiled loop of their own; one more serves all others (AnyKernel)
#pragma once

#include <utility>

namespace undex::sph {

// clang-format off
#define UNDEX_SCHEMES(ONE_PASS, TWO_PASSES)                                                             \
  ONE_PASS(monaghan, Monaghan, viscous, rings, Gaussian, WendlandC2)                                    \
  ONE_PASS(monaghan_switch, MonaghanSwitch, viscous, no_rings)                                          \
  ONE_PASS(paper, Paper, viscous, no_rings)                                                             \
  TWO_PASSES(riemann, Riemann, Reconstruction, inviscid, rings, Gaussian, WendlandC2)                   \
  TWO_PASSES(riemann_corrected, RiemannCorrected, CorrectedReconstruction, inviscid, rings, WendlandC4)
// clang-format on

enum class SchemeName {
#define UNDEX_NAME(name, ...) name,
  UNDEX_SCHEMES(UNDEX_NAME, UNDEX_NAME)
#undef UNDEX_NAME
};

/// Their names in scenes.
inline constexpr std::pair<const char*, SchemeName> scheme_names[] = {
#define UNDEX_PAIR(name, ...) {#name, SchemeName::name},
    UNDEX_SCHEMES(UNDEX_PAIR, UNDEX_PAIR)
#undef UNDEX_PAIR
};

/// Does the scheme's dissipation come from Monaghan's viscosity?
constexpr bool is_viscous(SchemeName scheme) {
  constexpr bool viscous = true, inviscid = false;
#define UNDEX_ONE(name, rates, kind, ...) kind,
#define UNDEX_TWO(name, rates, gradients, kind, ...) kind,
  constexpr bool kinds[] = {UNDEX_SCHEMES(UNDEX_ONE, UNDEX_TWO)};
#undef UNDEX_ONE
#undef UNDEX_TWO
  return kinds[int(scheme)];
}

/// Does the scheme compute rings about an axis?
constexpr bool has_rings(SchemeName scheme) {
  constexpr bool rings = true, no_rings = false;
#define UNDEX_ONE(name, rates, kind, ringed, ...) ringed,
#define UNDEX_TWO(name, rates, gradients, kind, ringed, ...) ringed,
  constexpr bool ringed[] = {UNDEX_SCHEMES(UNDEX_ONE, UNDEX_TWO)};
#undef UNDEX_ONE
#undef UNDEX_TWO
  return ringed[int(scheme)];
}

}  // namespace undex::sph
