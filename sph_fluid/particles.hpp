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

  // Rates one evaluation earlier, for the predictor; they only shape a correction, so single precision serves.
  std::vector<float> ax_before, ay_before, az_before, compression_before;

  std::size_t size() const { return x.size(); }

  void resize(std::size_t n, bool with_energy) {
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &ax, &ay, &az, &compression, &heat, &closing}) a->assign(n, 0.0);
    for (auto* a : {&ax_before, &ay_before, &az_before, &compression_before}) a->assign(n, 0.0f);
    if (with_energy) energy.assign(n, 0.0);
    id.resize(n);
  }

  /// Puts the particles of first .. first + order.size() into the order given by their present indices.
  void permute(std::uint32_t first, const std::vector<std::uint32_t>& order, std::vector<double>& spare) {
    const std::size_t n = order.size();
    if (spare.size() < n) spare.resize(n);
    for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy, &ax, &ay, &az, &compression, &heat})
      reorder(*a, first, order, spare.data());
    for (auto* a : {&ax_before, &ay_before, &az_before, &compression_before})
      reorder(*a, first, order, reinterpret_cast<float*>(spare.data()));
    reorder(id, first, order, reinterpret_cast<std::uint32_t*>(spare.data()));
  }

  /// The rates of the last evaluation become those before it.
  void remember_rates() {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < size(); ++i) {
      ax_before[i] = float(ax[i]);
      ay_before[i] = float(ay[i]);
      az_before[i] = float(az[i]);
      compression_before[i] = float(compression[i]);
    }
  }

  std::size_t memory_bytes() const {
    std::size_t bytes = id.capacity() * sizeof(std::uint32_t);
    for (const auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass, &energy, &ax, &ay, &az, &compression, &heat, &closing})
      bytes += a->capacity() * sizeof(double);
    return bytes + 4 * ax_before.capacity() * sizeof(float);
  }

 private:
  template <class T>
  static void reorder(std::vector<T>& a, std::uint32_t first, const std::vector<std::uint32_t>& order, T* spare) {
    if (a.empty()) return;
    T* data = a.data();
    const std::size_t n = order.size();
#pragma omp parallel
    {
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < n; ++k) spare[k] = data[order[k]];
#pragma omp for schedule(static)
      for (std::size_t k = 0; k < n; ++k) data[first + k] = spare[k];
    }
  }
};

}  // namespace undex::sph
