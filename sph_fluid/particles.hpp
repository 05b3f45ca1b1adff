// The fluid's particles as a structure of arrays. State is what a restart needs; rates are what the last evaluation gave.
#pragma once

#include <cstdint>
#include <vector>

namespace undex::sph {

struct Particles {
  // State.
  std::vector<double> x, y, z;      ///< [m]
  std::vector<double> vx, vy, vz;   ///< [m/s]
  std::vector<double> rho;          ///< [kg/m^3]
  std::vector<double> mass;         ///< [kg]
  std::vector<double> energy;       ///< specific internal energy [J/kg]; empty where all laws are barotropic
  std::vector<std::uint32_t> id;    ///< place at the start

  // Rates.
  std::vector<double> ax, ay, az;   ///< [m/s^2]
  std::vector<double> compression;  ///< (d rho/dt)/rho [1/s]
  std::vector<double> heat;         ///< viscous heating, or the whole rate of `energy` where that is a field [W/kg]
  std::vector<double> closing;      ///< closing speed of neighbours [m/s]; not carried from step to step

  std::size_t size() const { return x.size(); }

  void resize(std::size_t n, bool with_energy) {
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &ax, &ay, &az, &compression, &heat, &closing}) a->assign(n, 0.0);
    if (with_energy) energy.assign(n, 0.0);
    id.resize(n);
  }

  /// Puts the particles of first .. first + order.size() into the order given by their present indices.
  void permute(std::uint32_t first, const std::vector<std::uint32_t>& order, std::vector<double>& spare) {
    const std::uint32_t n = std::uint32_t(order.size());
    if (spare.size() < n) spare.resize(n);
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy, &ax, &ay, &az, &compression, &heat}) {
      if (a->empty()) continue;
      double* data = a->data();
#pragma omp parallel
      {
#pragma omp for schedule(static)
        for (std::uint32_t k = 0; k < n; ++k) spare[k] = data[order[k]];
#pragma omp for schedule(static)
        for (std::uint32_t k = 0; k < n; ++k) data[first + k] = spare[k];
      }
    }
    std::uint32_t* ids = id.data();
    std::uint32_t* sorted = reinterpret_cast<std::uint32_t*>(spare.data());
    for (std::uint32_t k = 0; k < n; ++k) sorted[k] = ids[order[k]];
    for (std::uint32_t k = 0; k < n; ++k) ids[first + k] = sorted[k];
  }

  std::size_t memory_bytes() const {
    std::size_t bytes = id.capacity() * sizeof(std::uint32_t);
    for (const auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy, &ax, &ay, &az, &compression, &heat, &closing})
      bytes += a->capacity() * sizeof(double);
    return bytes;
  }
};

}  // namespace undex::sph
