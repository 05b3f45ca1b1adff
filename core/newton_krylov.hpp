// Newton's method where only the function F is known: steps in the space of Arnoldi's vectors, as GMRES takes them (Saad,
// Schultz 1986, SIAM J. Sci. Stat. Comput. 7, 856), the products J v being differences of F (Knoll, Keyes 2004, J. Comput.
// Phys. 193, 357), and no longer than they are trusted to be (Brown, Saad 1990, SIAM J. Sci. Stat. Comput. 11, 450).
#pragma once

#include <Eigen/Dense>

#include <functional>
#include <vector>

#include "core/vector.hpp"

namespace undex {

class KrylovSpace {
 public:
  using Values = std::vector<Vec3>;
  /// About a place x with the value F(x); `moved(d)` is F(x + d). `difference` is the largest component of d, in units of x.
  /// Takes at most so many products; fewer where |F + J dx| comes down to that share of |F|.
  KrylovSpace(const Values& value, int products, double share, double difference,
              const std::function<Values(const Values&)>& moved);

  /// The dx of this space, |dx| <= longest, that makes |F + J dx| least.
  Values step(double longest) const;

 private:
  std::vector<Values> basis_;
  double norm_;              ///< of F
  Eigen::MatrixXd product_;  ///< J basis = basis product_; a row more than columns
};

}  // namespace undex
