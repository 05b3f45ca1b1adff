#include "fem_structure/shell_elements.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "fem_structure/hexahedron_corners.hpp"
#include "fem_structure/pressure_step.hpp"

namespace undex::fem {
namespace {

constexpr int component[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
constexpr int place[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};

/// Gauss points and weights on [-1, 1], by Newton's steps on the Legendre polynomial.
void gauss(int n, std::vector<double>& point, std::vector<double>& weight) {
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
    for (int iteration = 0; iteration < 20; ++iteration) {
      double p = 1.0, before = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
        before = p;
        p = next;
      }
      slope = n * (x * p - before) / (x * x - 1.0);
      x -= p / slope;
    }
    point[i] = 2 * i + 1 == n ? 0.0 : x;
    weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  // Odd moments must vanish to the last digit: the enhanced strain is orthogonal to constant stress by them.
  for (int i = 0; i < n / 2; ++i) {
    point[n - 1 - i] = -point[i];
    weight[n - 1 - i] = weight[i];
  }
}

void cross(const materials::EightPoints (&a)[3], const materials::EightPoints (&b)[3], materials::EightPoints (&c)[3]) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (int q = 0; q < 8; ++q) c[i][q] = a[j][q] * b[k][q] - a[k][q] * b[j][q];
  }
}

double dot(const double (&a)[3], const double (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

int thickness_direction(const Mesh& mesh, bool axisymmetric, const std::string& who) {
  if (std::holds_alternative<TubeMesh>(mesh)) return 0;  // the blocks of a tube count the cells through its wall first
  if (axisymmetric && std::holds_alternative<RodMesh>(mesh)) return 1;
  if (!axisymmetric && std::holds_alternative<GmshMesh>(mesh)) return 2;  // as thickened() has the nodes
  if (const auto* plate = std::get_if<PlateMesh>(&mesh)) {
    int thinnest = 0;
    for (int d = 1; d < 3; ++d)
      if (plate->high[d] - plate->low[d] < plate->high[thinnest] - plate->low[thinnest]) thinnest = d;
    return thinnest;
  }
  throw std::invalid_argument(who +
                              ": shell elements need a wall whose thickness direction is known, that of a tube, a "
                              "plate or quadrangles in space; use hexahedra for a rod, or a gmsh mesh of a meridian");
}

/// Shape functions of the mid-surface at the points of a layer, for all layers of a batch; xi, eta in [-1, 1].
template <bool axisymmetric>
struct SolidShells<axisymmetric>::Rule {
  Lanes xi, eta, value[corners], along_xi[corners], along_eta[corners];

  Rule() {
    for (int q = 0; q < 8; ++q) {
      xi[q] = (q & 1 ? 1.0 : -1.0) / std::numbers::sqrt3;
      eta[q] = (q & 2 ? 1.0 : -1.0) / std::numbers::sqrt3;
      for (int a = 0; a < corners; ++a) {
        const double sx = corner[a][0] ? 1.0 : -1.0, sy = corner[a][1] ? 1.0 : -1.0;
        if constexpr (axisymmetric) {
          value[a][q] = 0.5 * (1 + sx * xi[q]);
          along_xi[a][q] = 0.5 * sx;
          along_eta[a][q] = 0.0;
        } else {
          value[a][q] = 0.25 * (1 + sx * xi[q]) * (1 + sy * eta[q]);
          along_xi[a][q] = 0.25 * sx * (1 + sy * eta[q]);
          along_eta[a][q] = 0.25 * sy * (1 + sx * xi[q]);
        }
      }
    }
  }
  static const Rule& get() {
    static const Rule rule;
    return rule;
  }
};

/// Corners between which the mid-surface's edges run: at eta = -1, +1 (along xi), then xi = -1, +1 (along eta). A ring's is one.
constexpr int edge_begin[4] = {0, 3, 0, 1}, edge_end[4] = {1, 2, 3, 2};

/// A vector field on a cell (positions or displacements) as mid-surface m and director d: x = m + zeta d, zeta in [-1, 1].
/// At the points in the plane: derivatives of m and d; at the corners and the middles of the edges: the samples.
template <bool axisymmetric>
struct SolidShells<axisymmetric>::Surface {
  Lanes m_xi[3], m_eta[3], d[3], d_xi[3], d_eta[3];
  double corner_d[corners][3];
  double edge_m[edges][3], edge_d[edges][3];  ///< of m the derivative along the edge

  /// The field halfway of a step that ended at x and displaced by u.
  Surface(const Surface& x, const Surface& u) {
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) {
        m_xi[i][q] = x.m_xi[i][q] - 0.5 * u.m_xi[i][q];
        m_eta[i][q] = x.m_eta[i][q] - 0.5 * u.m_eta[i][q];
        d[i][q] = x.d[i][q] - 0.5 * u.d[i][q];
        d_xi[i][q] = x.d_xi[i][q] - 0.5 * u.d_xi[i][q];
        d_eta[i][q] = x.d_eta[i][q] - 0.5 * u.d_eta[i][q];
      }
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < corners; ++a) corner_d[a][i] = x.corner_d[a][i] - 0.5 * u.corner_d[a][i];
      for (int edge = 0; edge < edges; ++edge) {
        edge_m[edge][i] = x.edge_m[edge][i] - 0.5 * u.edge_m[edge][i];
        edge_d[edge][i] = x.edge_d[edge][i] - 0.5 * u.edge_d[edge][i];
      }
    }
  }
  explicit Surface(const CellVectors& v) {
    const Rule& rule = Rule::get();
    double middle[3][corners];
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < corners; ++a) {
        middle[i][a] = 0.5 * (v[i][a + corners] + v[i][a]);
        corner_d[a][i] = 0.5 * (v[i][a + corners] - v[i][a]);
      }
      for (int edge = 0; edge < edges; ++edge) {
        edge_m[edge][i] = 0.5 * (middle[i][edge_end[edge]] - middle[i][edge_begin[edge]]);
        edge_d[edge][i] = 0.5 * (corner_d[edge_end[edge]][i] + corner_d[edge_begin[edge]][i]);
      }
      for (int q = 0; q < 8; ++q) m_xi[i][q] = m_eta[i][q] = d[i][q] = d_xi[i][q] = d_eta[i][q] = 0.0;
      for (int a = 0; a < corners; ++a)
        for (int q = 0; q < per_layer; ++q) {
          m_xi[i][q] += middle[i][a] * rule.along_xi[a][q];
          m_eta[i][q] += middle[i][a] * rule.along_eta[a][q];
          d[i][q] += corner_d[a][i] * rule.value[a][q];
          d_xi[i][q] += corner_d[a][i] * rule.along_xi[a][q];
          d_eta[i][q] += corner_d[a][i] * rule.along_eta[a][q];
        }
    }
    if constexpr (axisymmetric)  // along the angle
      for (int a = 0; a < corners; ++a)
        for (int q = 0; q < per_layer; ++q) {
          m_eta[2][q] += middle[0][a] * rule.value[a][q];
          d_eta[2][q] += corner_d[a][0] * rule.value[a][q];
        }
    for (int i = 0; i < 3; ++i)
      for (int q = per_layer; q < 8; ++q) {  // the other layers of a batch are alike
        m_xi[i][q] = m_xi[i][q - per_layer];
        m_eta[i][q] = m_eta[i][q - per_layer];
        d[i][q] = d[i][q - per_layer];
        d_xi[i][q] = d_xi[i][q - per_layer];
        d_eta[i][q] = d_eta[i][q - per_layer];
      }
  }
};

/// At all points: zeta, the covariant vectors of the layer, contravariant base (rows), weights; and for the enhanced strain
/// its shape, zeta j(0)/j(zeta), and the unit normal of the mid-surface.
template <bool axisymmetric>
struct SolidShells<axisymmetric>::Geometry {
  Lanes zeta[most_batches], along_xi[most_batches][3], along_eta[most_batches][3], inverse[most_batches][3][3];
  Lanes weight[most_batches], shape[most_batches];
  Lanes normal[3];
};

template <bool axisymmetric>
SolidShells<axisymmetric>::SolidShells(const Grid& grid, const materials::Solid& material, double linear_viscosity,
                                       double quadratic_viscosity, int through, int layers)
    : ElementSet(grid, material, linear_viscosity, quadratic_viscosity),
      layers_(layers),
      batches_((layers + layers_at_once - 1) / layers_at_once),
      through_(through),
      layer_zeta_(layers_at_once * batches_, 0.0),
      layer_weight_(layers_at_once * batches_, 0.0) {
  if (layers < 2 || layers > most_layers)
    throw std::invalid_argument("points_through = " + std::to_string(layers) + "; give 2 to " + std::to_string(most_layers));
  gauss(layers, layer_zeta_, layer_weight_);
  for (int local = 0; local < 2 * corners; ++local)
    for (int node = 0; node < 2 * corners; ++node) {
      const int high = local / corners, *along = corner[local % corners];
      bool same = corner[node][through] == high;
      if constexpr (axisymmetric) same &= (through == 0 ? corner[node][1] : 1 - corner[node][0]) == along[0];  // right-handed
      else same &= corner[node][(through + 1) % 3] == along[0] && corner[node][(through + 2) % 3] == along[1];
      if (same) order_[local] = node;
    }

  const std::size_t n = cells_.size(), points = 8 * batches_ * n, all_layers = layers_at_once * batches_ * n;
  for (auto& field : deviator_) field.assign(points, 0.0);
  plastic_strain_.assign(points, 0.0);
  temperature_.assign(points, material.T_room);
  if (materials::can_fail(material)) damage_.assign(points, 0.0);
  weight_.resize(points);
  const auto rest = materials::evaluate(material_.pressure, material_.rho0, material_.rho0, 0.0);
  pressure_.assign(all_layers, rest.pressure);
  energy_.assign(all_layers, 0.0);
  dilatation_.assign(all_layers, 1.0);
  viscous_pressure_.assign(n, 0.0);
  residual_.assign(n, 0.0);
  bulk_.assign(n, material_.rho0 * rest.bulk_sound * rest.bulk_sound);
  for (std::size_t c = 0; c < n; ++c) {
    CellVectors positions, x;
    collect(grid.nodes, cells_[c], positions);
    turn_in(positions, x);
    Geometry geometry;
    find_geometry(Surface(x), geometry);
    for (int b = 0; b < batches_; ++b)
      for (int q = 0; q < 8; ++q) weight_[at(c, 8 * b + q)] = geometry.weight[b][q];
  }
  find_first_steps(grid);
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::turn_in(const CellVectors& cell, CellVectors& local) const {
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 2 * corners; ++a) local[i][a] = cell[i][order_[a]];
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::turn_out(const CellVectors& local, CellVectors& cell) const {
  for (int i = 0; i < 3; ++i)
    for (int a = 0; a < 2 * corners; ++a) cell[i][order_[a]] = local[i][a];
}

template <bool axisymmetric>
bool SolidShells<axisymmetric>::find_geometry(const Surface& x, Geometry& geometry) const {
  Lanes middle;  // determinant on the mid-surface
  cross(x.m_xi, x.m_eta, geometry.normal);
  for (int q = 0; q < 8; ++q) {
    double& n0 = geometry.normal[0][q];
    double& n1 = geometry.normal[1][q];
    double& n2 = geometry.normal[2][q];
    middle[q] = n0 * x.d[0][q] + n1 * x.d[1][q] + n2 * x.d[2][q];
    const double over = 1.0 / std::sqrt(n0 * n0 + n1 * n1 + n2 * n2);
    n0 *= over;
    n1 *= over;
    n2 *= over;
  }
  constexpr double turn = axisymmetric ? 2.0 * std::numbers::pi : 1.0;  // per unit of eta
  double least = middle[0], most = 0.0;
  for (int b = 0; b < batches_; ++b) {
    auto& inverse = geometry.inverse[b];
    Lanes(&g1)[3] = geometry.along_xi[b];
    Lanes(&g2)[3] = geometry.along_eta[b];
    Lanes layer_weight, determinant;
    for (int q = 0; q < 8; ++q) {
      geometry.zeta[b][q] = layer_zeta_[layers_at_once * b + q / per_layer];
      layer_weight[q] = turn * layer_weight_[layers_at_once * b + q / per_layer];
    }
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) {
        g1[i][q] = x.m_xi[i][q] + geometry.zeta[b][q] * x.d_xi[i][q];
        g2[i][q] = x.m_eta[i][q] + geometry.zeta[b][q] * x.d_eta[i][q];
      }
    cross(g2, x.d, inverse[0]);
    cross(x.d, g1, inverse[1]);
    cross(g1, g2, inverse[2]);
    for (int q = 0; q < 8; ++q) {
      determinant[q] = g1[0][q] * inverse[0][0][q] + g1[1][q] * inverse[0][1][q] + g1[2][q] * inverse[0][2][q];
      const double over = 1.0 / determinant[q];
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 3; ++i) inverse[k][i][q] *= over;
      geometry.weight[b][q] = layer_weight[q] * determinant[q];
      geometry.shape[b][q] = geometry.zeta[b][q] * middle[q] * over;
    }
    for (int q = 0; q < 8; ++q) {
      least = std::min(least, determinant[q]);
      most += std::abs(determinant[q]);
    }
  }
  return least > 0.0 && std::isfinite(most);
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::find_strain(const Surface& x, const Surface& u, const Geometry& geometry,
                                            Lanes (*strain)[6]) const {
  const Rule& rule = Rule::get();
  double thickness[corners], shear[edges];
  for (int a = 0; a < corners; ++a) thickness[a] = dot(x.corner_d[a], u.corner_d[a]);
  for (int a = 0; a < edges; ++a) shear[a] = 0.5 * (dot(x.edge_m[a], u.edge_d[a]) + dot(x.edge_d[a], u.edge_m[a]));
  Lanes e33, e13, e23;  // constant through the thickness
  for (int q = 0; q < 8; ++q) {
    e33[q] = 0.0;
    for (int a = 0; a < corners; ++a) e33[q] += thickness[a] * rule.value[a][q];
    if constexpr (axisymmetric) {
      e13[q] = shear[0];
      e23[q] = 0.0;
    } else {
      e13[q] = 0.5 * ((1 - rule.eta[q]) * shear[0] + (1 + rule.eta[q]) * shear[1]);
      e23[q] = 0.5 * ((1 - rule.xi[q]) * shear[2] + (1 + rule.xi[q]) * shear[3]);
    }
  }
  for (int b = 0; b < batches_; ++b) {
    const auto& inverse = geometry.inverse[b];
    const auto& g1 = geometry.along_xi[b];
    const auto& g2 = geometry.along_eta[b];
    Lanes e11 = {}, e22 = {}, e12 = {};
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) {
        const double u1 = u.m_xi[i][q] + geometry.zeta[b][q] * u.d_xi[i][q];
        const double u2 = u.m_eta[i][q] + geometry.zeta[b][q] * u.d_eta[i][q];
        e11[q] += g1[i][q] * u1;
        e22[q] += g2[i][q] * u2;
        e12[q] += 0.5 * (g1[i][q] * u2 + g2[i][q] * u1);
      }
    Lanes m[3][3];  // sum over j of E_ij g^j
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) {
        m[0][i][q] = e11[q] * inverse[0][i][q] + e12[q] * inverse[1][i][q] + e13[q] * inverse[2][i][q];
        m[1][i][q] = e12[q] * inverse[0][i][q] + e22[q] * inverse[1][i][q] + e23[q] * inverse[2][i][q];
        m[2][i][q] = e13[q] * inverse[0][i][q] + e23[q] * inverse[1][i][q] + e33[q] * inverse[2][i][q];
      }
    for (int k = 0; k < 6; ++k) {
      const auto [i, j] = place[k];
      for (int q = 0; q < 8; ++q)
        strain[b][k][q] = inverse[0][i][q] * m[0][j][q] + inverse[1][i][q] * m[1][j][q] + inverse[2][i][q] * m[2][j][q];
    }
  }
}

template <bool axisymmetric>
double SolidShells<axisymmetric>::enhance(const Geometry& geometry, Moduli moduli, double residual, Lanes (*strain)[6]) const {
  const Lanes(&n)[3] = geometry.normal;
  double own = 0.0;
  for (int b = 0; b < batches_; ++b)
    for (int layer = 0; layer < layers_at_once; ++layer) {
      double volume = 0.0, opened = 0.0, lever = 0.0;
      for (int q = per_layer * layer; q < per_layer * (layer + 1); ++q) {
        const double trace = strain[b][0][q] + strain[b][1][q] + strain[b][2][q];
        const double along = n[0][q] * (n[0][q] * strain[b][0][q] + 2 * n[1][q] * strain[b][5][q]) +
                             n[1][q] * (n[1][q] * strain[b][1][q] + 2 * n[2][q] * strain[b][3][q]) +
                             n[2][q] * (n[2][q] * strain[b][2][q] + 2 * n[0][q] * strain[b][4][q]);
        const double w = geometry.weight[b][q], shape = geometry.shape[b][q];
        volume += w;
        opened += w * trace;
        lever += w * shape;
        residual += w * shape * moduli.twice_shear * (along - trace / 3.0);
        own += w * shape * shape * moduli.twice_shear * (2.0 / 3.0);
      }
      if (volume == 0.0) continue;  // an empty layer
      residual += moduli.bulk * lever * opened / volume;
      own += moduli.bulk * lever * lever / volume;
    }
  const double amplitude = -residual / own;
  for (int b = 0; b < batches_; ++b)
    for (int q = 0; q < 8; ++q) {
      const double size = amplitude * geometry.shape[b][q];
      strain[b][0][q] += size * n[0][q] * n[0][q];
      strain[b][1][q] += size * n[1][q] * n[1][q];
      strain[b][2][q] += size * n[2][q] * n[2][q];
      strain[b][3][q] += size * n[1][q] * n[2][q];
      strain[b][4][q] += size * n[2][q] * n[0][q];
      strain[b][5][q] += size * n[0][q] * n[1][q];
    }
  return amplitude;
}

template <bool axisymmetric>
double SolidShells<axisymmetric>::residual_of(const Geometry& geometry, const Lanes (*stress)[6]) const {
  const Lanes(&n)[3] = geometry.normal;
  double residual = 0.0;
  for (int b = 0; b < batches_; ++b)
    for (int q = 0; q < 8; ++q)
      residual += geometry.weight[b][q] * geometry.shape[b][q] *
                  (n[0][q] * (n[0][q] * stress[b][0][q] + 2 * n[1][q] * stress[b][5][q]) +
                   n[1][q] * (n[1][q] * stress[b][1][q] + 2 * n[2][q] * stress[b][3][q]) +
                   n[2][q] * (n[2][q] * stress[b][2][q] + 2 * n[0][q] * stress[b][4][q]));
  return residual;
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::spread(const Surface& x, const Geometry& geometry, const Lanes (*stress)[6],
                                       CellVectors& force) const {
  Lanes on_m_xi[3] = {}, on_m_eta[3] = {}, on_d_xi[3] = {}, on_d_eta[3] = {};
  Lanes s13 = {}, s23 = {}, s33 = {};
  for (int b = 0; b < batches_; ++b) {
    const auto& inverse = geometry.inverse[b];
    const auto& g1 = geometry.along_xi[b];
    const auto& g2 = geometry.along_eta[b];
    Lanes m[3][3], s11, s22, s12;  // g^k . sigma, times weight
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 3; ++i)
        for (int q = 0; q < 8; ++q)
          m[k][i][q] = geometry.weight[b][q] *
                       (inverse[k][0][q] * stress[b][component[0][i]][q] + inverse[k][1][q] * stress[b][component[1][i]][q] +
                        inverse[k][2][q] * stress[b][component[2][i]][q]);
    const auto contravariant = [&](int k, int l, int q) {
      return m[k][0][q] * inverse[l][0][q] + m[k][1][q] * inverse[l][1][q] + m[k][2][q] * inverse[l][2][q];
    };
    for (int q = 0; q < 8; ++q) {
      s11[q] = contravariant(0, 0, q);
      s22[q] = contravariant(1, 1, q);
      s12[q] = contravariant(0, 1, q);
      s13[q] += contravariant(0, 2, q);
      s23[q] += contravariant(1, 2, q);
      s33[q] += contravariant(2, 2, q);
    }
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) {
        const double zeta = geometry.zeta[b][q];
        const double along_xi = s11[q] * g1[i][q] + s12[q] * g2[i][q], along_eta = s12[q] * g1[i][q] + s22[q] * g2[i][q];
        on_m_xi[i][q] += along_xi;
        on_m_eta[i][q] += along_eta;
        on_d_xi[i][q] += zeta * along_xi;
        on_d_eta[i][q] += zeta * along_eta;
      }
  }
  const Rule& rule = Rule::get();
  double thickness[corners] = {}, shear[edges] = {};
  for (int q = 0; q < 8; ++q) {
    for (int a = 0; a < corners; ++a) thickness[a] += s33[q] * rule.value[a][q];
    if constexpr (axisymmetric) {
      shear[0] += s13[q];
    } else {
      shear[0] += 0.5 * (1 - rule.eta[q]) * s13[q];
      shear[1] += 0.5 * (1 + rule.eta[q]) * s13[q];
      shear[2] += 0.5 * (1 - rule.xi[q]) * s23[q];
      shear[3] += 0.5 * (1 + rule.xi[q]) * s23[q];
    }
  }
  for (int i = 0; i < 3; ++i) {
    double on_middle[corners], on_director[corners];
    for (int a = 0; a < corners; ++a) {
      Lanes middle, director;
      for (int q = 0; q < 8; ++q) {
        middle[q] = on_m_xi[i][q] * rule.along_xi[a][q] + on_m_eta[i][q] * rule.along_eta[a][q];
        director[q] = on_d_xi[i][q] * rule.along_xi[a][q] + on_d_eta[i][q] * rule.along_eta[a][q];
      }
      if (axisymmetric && i == 0)  // the hoop's part
        for (int q = 0; q < 8; ++q) {
          middle[q] += on_m_eta[2][q] * rule.value[a][q];
          director[q] += on_d_eta[2][q] * rule.value[a][q];
        }
      const auto total = [](const Lanes& v) { return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7])); };
      on_middle[a] = total(middle);
      on_director[a] = total(director) + thickness[a] * x.corner_d[a][i];
    }
    // Power of an edge's sample: 2 S E = S (m' . d_u + d . m'_u).
    for (int edge = 0; edge < edges; ++edge) {
      const double turned = 0.5 * shear[edge] * x.edge_m[edge][i], sheared = 0.5 * shear[edge] * x.edge_d[edge][i];
      on_director[edge_begin[edge]] += turned;
      on_director[edge_end[edge]] += turned;
      on_middle[edge_begin[edge]] -= sheared;
      on_middle[edge_end[edge]] += sheared;
    }
    for (int a = 0; a < corners; ++a) {
      force[i][a] = 0.5 * (on_middle[a] - on_director[a]);
      force[i][a + corners] = 0.5 * (on_middle[a] + on_director[a]);
    }
  }
}

/// What a step gave to the layers of a cell, and to it as a whole: works in [J].
template <bool axisymmetric>
struct SolidShells<axisymmetric>::Work {
  static constexpr int all_layers = layers_at_once * most_batches;
  double deviatoric[all_layers] = {};                       // of each layer
  double volume[all_layers] = {}, opened[all_layers] = {};  // halfway, and its gain [m^3]
  double intact[all_layers];                                // share of the points that have not failed
  double plastic = 0.0, most_strain = 0.0;
  Work() { std::fill_n(intact, all_layers, 1.0); }
};

template <bool axisymmetric>
bool SolidShells<axisymmetric>::advance_cell(std::size_t c, std::span<const Vec3> positions, std::span<const Vec3> displacements,
                                             double dt) {
  CellVectors x_cell, u_cell, x, u;
  collect(positions, cells_[c], x_cell);
  turn_in(x_cell, x);
  collect(displacements, cells_[c], u_cell);
  turn_in(u_cell, u);

  // Strain of the step in its midpoint configuration: metric changes are exact there for any rotation.
  const Surface change(u), now(x), halfway(now, change);
  Geometry geometry, end;
  if (!find_geometry(halfway, geometry) || !find_geometry(now, end)) return false;
  Lanes strain[most_batches][6], stress[most_batches][6];
  find_strain(halfway, change, geometry, strain);
  const double amplitude = enhance(geometry, {bulk_[c], 2.0 * material_.shear_modulus}, residual_[c], strain);

  Work work;
  for (int b = 0; b < batches_; ++b) advance_points(c, b, change, geometry, end, strain[b], dt, work, stress[b]);
  if (!advance_layers(c, dt, amplitude, work, end, x_cell, stress)) return false;
  for (int b = 0; b < batches_; ++b)
    for (int i = 0; i < 3; ++i)
      for (int q = 0; q < 8; ++q) stress[b][i][q] -= viscous_pressure_[c];
  CellVectors local, force;
  spread(now, end, stress, local);
  turn_out(local, force);
  return put_forces(c, force) && std::isfinite(bulk_[c] + residual_[c]);
}

/// The strain of a batch with the spin of the displacement itself. An empty layer has none.
template <bool axisymmetric>
void SolidShells<axisymmetric>::find_gradient(int b, const Surface& change, const Geometry& geometry, const Lanes (&strain)[6],
                                              Lanes (&gradient)[3][3]) const {
  const auto& inverse = geometry.inverse[b];
  Lanes slope[3][3];
  for (int i = 0; i < 3; ++i)
    for (int q = 0; q < 8; ++q) {
      const double u1 = change.m_xi[i][q] + geometry.zeta[b][q] * change.d_xi[i][q];
      const double u2 = change.m_eta[i][q] + geometry.zeta[b][q] * change.d_eta[i][q];
      for (int j = 0; j < 3; ++j)
        slope[i][j][q] = u1 * inverse[0][j][q] + u2 * inverse[1][j][q] + change.d[i][q] * inverse[2][j][q];
    }
  const int filled = std::min(8, per_layer * (layers_ - layers_at_once * b));
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      for (int q = 0; q < 8; ++q) gradient[i][j][q] = strain[component[i][j]][q] + 0.5 * (slope[i][j][q] - slope[j][i][q]);
      for (int q = filled; q < 8; ++q) gradient[i][j][q] = 0.0;
    }
}

/// Stress deviators of a batch of points.
template <bool axisymmetric>
void SolidShells<axisymmetric>::advance_points(std::size_t c, int b, const Surface& change, const Geometry& geometry,
                                               const Geometry& end, const Lanes (&strain)[6], double dt, Work& work,
                                               Lanes (&stress)[6]) {
  Lanes gradient[3][3], specific_volume, start_pressure;
  find_gradient(b, change, geometry, strain, gradient);
  materials::SolidPoints points;
  materials::SolidStep done;
  const std::size_t first = at(c, 8 * b);
  for (int q = 0; q < 8; ++q) {
    const int layer = layers_at_once * b + q / per_layer;
    const std::size_t k = layer_at(c, layer);
    specific_volume[q] = dilatation_[k] / material_.rho0;
    start_pressure[q] = pressure_[k];
    work.volume[layer] += geometry.weight[b][q];
    work.opened[layer] += geometry.weight[b][q] * (strain[0][q] + strain[1][q] + strain[2][q]);
    for (int part = 0; part < 6; ++part) points.deviator[part][q] = deviator_[part][first + q];
    points.plastic_strain[q] = plastic_strain_[first + q];
    points.temperature[q] = temperature_[first + q];
  }
  if (!damage_.empty()) std::copy_n(&damage_[first], 8, points.damage);
  materials::advance_deviator(material_, gradient, specific_volume, start_pressure, dt, points, done);
  if (!damage_.empty()) {
    std::copy_n(points.damage, 8, &damage_[first]);
    for (int q = 0; q < 8; ++q)
      work.intact[layers_at_once * b + q / per_layer] -= 1.0 / per_layer * (points.damage[q] >= materials::failed);
  }
  for (int q = 0; q < 8; ++q) {
    double& weight = weight_[first + q];
    work.most_strain = std::max(work.most_strain, done.strain_norm[q]);
    work.deviatoric[layers_at_once * b + q / per_layer] +=
        0.5 * (weight * done.old_work[q] + end.weight[b][q] * done.new_work[q]);
    work.plastic += 0.5 * (weight + end.weight[b][q]) * done.plastic_work[q];
    for (int k = 0; k < 6; ++k) stress[k][q] = deviator_[k][first + q] = points.deviator[k][q];
    plastic_strain_[first + q] = points.plastic_strain[q];
    temperature_[first + q] = points.temperature[q];
    weight = end.weight[b][q];
  }
}

/// Pressures of the layers, the cell's energies and its next stable step. False where a layer has swollen or shrunk by its own
/// volume.
template <bool axisymmetric>
bool SolidShells<axisymmetric>::advance_layers(std::size_t c, double dt, double amplitude, const Work& work, const Geometry& end,
                                               const CellVectors& x, Lanes (*stress)[6]) {
  // Bulk viscosity: of the whole cell, so that bending is not damped.
  double volume = 0.0, opened = 0.0;
  for (int layer = 0; layer < layers_; ++layer) {
    volume += work.volume[layer];
    opened += work.opened[layer];
  }
  const double shear = material_.shear_modulus, mean_density = cell_mass_[c] / volume;
  const double old_viscous = viscous_pressure_[c], old_sound = std::sqrt((bulk_[c] + 4.0 / 3.0 * shear) / mean_density);
  viscous_pressure_[c] = viscous_pressure(c, opened / (volume * dt), mean_density, old_sound);

  double stored = 0.0, bulk = 0.0;
  for (int layer = 0; layer < layers_; ++layer) {
    const double viscous = 0.5 * (old_viscous + viscous_pressure_[c]);
    if (!advance_pressure(c, layer, viscous, work, stored, bulk)) return false;
    const double pressure = pressure_[layer_at(c, layer)];
    const int first = per_layer * (layer % layers_at_once);
    for (int i = 0; i < 3; ++i)
      for (int q = first; q < first + per_layer; ++q) stress[layer / layers_at_once][i][q] -= pressure;
  }
  // What the lag of the enhanced strain did is not the nodes' work.
  const double old_residual = residual_[c];
  residual_[c] = residual_of(end, stress);
  stored -= 0.5 * (old_residual + residual_[c]) * amplitude;
  elastic_[c] += stored - work.plastic;
  plastic_[c] += work.plastic;
  viscous_[c] -= 0.5 * (old_viscous + viscous_pressure_[c]) * opened;
  bulk_[c] = bulk;
  follow_frequency(c, x, work.most_strain, bulk);
  return true;
}

/// Pressure of a layer from its mean dilatation, with `viscous` the mean viscous pressure [Pa]; adds to what the cell has stored
/// [J] and to its bulk modulus [Pa].
template <bool axisymmetric>
bool SolidShells<axisymmetric>::advance_pressure(std::size_t c, int layer, double viscous, const Work& work, double& stored,
                                                 double& bulk) {
  const std::size_t k = layer_at(c, layer);
  const double step = work.opened[layer] / work.volume[layer], old_dilatation = dilatation_[k], old_pressure = pressure_[k];
  if (!(std::abs(step) < 1.0)) return false;
  dilatation_[k] *= (1.0 + 0.5 * step) / (1.0 - 0.5 * step);
  const double density = material_.rho0 / dilatation_[k];
  const double reference_volume = work.volume[layer] / (0.5 * (old_dilatation + dilatation_[k]));
  const double swelling = work.opened[layer] / reference_volume;  // per reference volume, as the energies below
  const double other = energy_[k] + work.deviatoric[layer] / reference_volume - viscous * swelling;
  const auto guess = materials::evaluate(material_.pressure, material_.rho0, density, energy_[k] / material_.rho0);
  auto [pressure, state] = carried_pressure(material_,
                                            {.density = density,
                                             .mass = material_.rho0,
                                             .opened = swelling,
                                             .other_energy = other,
                                             .old_pressure = old_pressure,
                                             .intact = work.intact[layer]},
                                            guess);
  const bool spalled = materials::spalls(material_, state.pressure);
  if (spalled) {
    std::fill_n(&damage_[at(c, per_layer * layer)], per_layer, materials::failed);
    pressure = 0.0;
  }
  pressure_[k] = pressure;
  const double pressure_work = -0.5 * (old_pressure + pressure) * swelling, rho0 = material_.rho0;
  const bool broken = spalled || work.intact[layer] < 1.0;
  const materials::Warming warming =
      materials::warming(material_, {.before = old_dilatation / rho0,
                                     .after = dilatation_[k] / rho0,
                                     .energy = energy_[k] / rho0,
                                     .pressure_work = pressure_work / rho0,
                                     .dissipated = -viscous * swelling / rho0,
                                     .parted = materials::is_parted(material_, std::min(old_pressure, pressure), broken)});
  for (std::size_t q = at(c, per_layer * layer); q < at(c, per_layer * (layer + 1)); ++q)
    temperature_[q] = warming(temperature_[q]);
  energy_[k] = other + pressure_work;
  stored += work.deviatoric[layer] + reference_volume * pressure_work;
  bulk += 0.5 * layer_weight_[layer] * density * state.bulk_sound * state.bulk_sound;
  return true;
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::linear_cell_force(const CellVectors& x_cell, const CellVectors& u_cell, Moduli moduli,
                                                  CellVectors& force) const {
  CellVectors x, u;
  turn_in(x_cell, x);
  turn_in(u_cell, u);
  const Surface surface(x), change(u);
  Geometry geometry;
  find_geometry(surface, geometry);
  Lanes stress[most_batches][6];  // first the strain
  find_strain(surface, change, geometry, stress);
  enhance(geometry, moduli, 0.0, stress);
  for (int b = 0; b < batches_; ++b)
    for (int layer = 0; layer < layers_at_once; ++layer) {
      double volume = 0.0, opened = 0.0;
      for (int q = per_layer * layer; q < per_layer * (layer + 1); ++q) {
        volume += geometry.weight[b][q];
        opened += geometry.weight[b][q] * (stress[b][0][q] + stress[b][1][q] + stress[b][2][q]);
      }
      const double tension = volume > 0.0 ? moduli.bulk * opened / volume : 0.0;
      for (int q = per_layer * layer; q < per_layer * (layer + 1); ++q) {
        const double mean = (stress[b][0][q] + stress[b][1][q] + stress[b][2][q]) / 3.0;
        for (int k = 0; k < 3; ++k) stress[b][k][q] = moduli.twice_shear * (stress[b][k][q] - mean) + tension;
        for (int k = 3; k < 6; ++k) stress[b][k][q] *= moduli.twice_shear;
      }
    }
  CellVectors local;
  spread(surface, geometry, stress, local);
  turn_out(local, force);
}

template <bool axisymmetric>
ElementSet::Moduli SolidShells<axisymmetric>::moduli(std::size_t c) const {
  return {bulk_[c], 2.0 * material_.shear_modulus};
}

template <bool axisymmetric>
std::vector<double> SolidShells<axisymmetric>::shares_at(const std::array<double, 3>& unit) const {
  const auto side = [](double coordinate) {  // share of the high one of the two Gauss points
    return std::clamp(0.5 + 0.5 * std::numbers::sqrt3 * (2.0 * coordinate - 1.0), 0.0, 1.0);
  };
  const double zeta = 2.0 * unit[through_] - 1.0;
  double xi, eta = 0.0;
  if constexpr (axisymmetric) {
    xi = side(through_ == 0 ? unit[1] : 1.0 - unit[0]);
  } else {
    xi = side(unit[(through_ + 1) % 3]);
    eta = side(unit[(through_ + 2) % 3]);
  }
  std::vector<double> shares(per_layer * layers_, 0.0);
  int low = 0;
  while (low + 2 < layers_ && zeta > layer_zeta_[low + 1]) ++low;
  const double t = std::clamp((zeta - layer_zeta_[low]) / (layer_zeta_[low + 1] - layer_zeta_[low]), 0.0, 1.0);
  for (int p = 0; p < per_layer; ++p) {
    const double in_plane = (p & 1 ? xi : 1.0 - xi) * (p & 2 ? eta : 1.0 - eta);
    shares[per_layer * low + p] = in_plane * (1.0 - t);
    shares[per_layer * (low + 1) + p] = in_plane * t;
  }
  return shares;
}

template <bool axisymmetric>
Mat3 SolidShells<axisymmetric>::stress(std::size_t cell, int q) const {
  const std::size_t k = at(cell, q);
  const auto& s = deviator_;
  Mat3 full;
  full << s[0][k], s[5][k], s[4][k],  //
      s[5][k], s[1][k], s[3][k],      //
      s[4][k], s[3][k], s[2][k];
  return full - pressure_[layer_at(cell, q / per_layer)] * Mat3::Identity();
}

template <bool axisymmetric>
double SolidShells<axisymmetric>::pressure(std::size_t cell) const {
  double mean = 0.0;
  for (int layer = 0; layer < layers_; ++layer) mean += 0.5 * layer_weight_[layer] * pressure_[layer_at(cell, layer)];
  return mean;
}

template <bool axisymmetric>
void SolidShells<axisymmetric>::visit_state(StateVisitor& state) {
  ElementSet::visit_state(state);
  state("pressure", pressure_);
  state("energy", energy_);
  state("viscous pressure", viscous_pressure_);
  state("dilatation", dilatation_);
  state("residual", residual_);
  state("bulk modulus", bulk_);
}

template <bool axisymmetric>
std::size_t SolidShells<axisymmetric>::memory_bytes() const {
  std::size_t values = 0;
  for (const auto* field : {&pressure_, &energy_, &dilatation_, &viscous_pressure_, &residual_, &bulk_}) values += field->size();
  return shared_memory_bytes() + values * sizeof(double);
}

template class SolidShells<false>;
template class SolidShells<true>;

}  // namespace undex::fem
