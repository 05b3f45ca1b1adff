#include "sph_fluid/walls/particles.hpp"

#include <omp.h>

#include <algorithm>

#include "sph_fluid/pairs/large_pages.hpp"

namespace undex::sph {
namespace {

/// to = from, by all threads.
template <class T>
void copy_all(std::vector<T>& to, const std::vector<T>& from) {
  to.resize(from.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[i];
}

/// Room for n, in large pages.
template <class T>
void reserve(std::vector<T>& array, std::size_t n) {
  array.reserve(n);
  ask_for_large_pages(array.data(), n * sizeof(T));
}

/// values[k] = array[place[k]]; back: array[place[k]] = values[k]. `array` may be empty.
template <class T>
void visit_in_order(StateVisitor& state, std::string_view name, std::vector<T>& array, const std::vector<std::uint32_t>& place) {
  std::vector<T> values(array.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = array[place[k]];
  state(name, values);
  if (!state.restores()) return;
  array.resize(values.size());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < values.size(); ++k) array[place[k]] = values[k];
}

}  // namespace

void Particles::resize(std::size_t n, bool with_energy) {
  for (auto* a : {&x, &y, &z, &vx, &vy, &vz, &rho, &mass}) {
    reserve(*a, n);
    a->assign(n, 0.0);
  }
  if (with_energy) energy.assign(n, 0.0);
  id.resize(n);
  halvings.assign(n, 0);
}

void Particles::make_room(SecondRow second, double alpha, bool of_stages, bool rings) {
  const std::size_t n = size();
  reserve(rate, n);
  reserve(predicted, n);
  if (!of_stages) reserve(earlier, n);
  if (second == SecondRow::gradient) reserve(gradient, n);
  if (second == SecondRow::corrected) reserve(corrected, n);
  rate.assign(n, SumRow{});
  if (second == SecondRow::viscosity) viscosity.assign(n, {alpha});
  if (of_stages) keep_start();
  else earlier.assign(n, EarlierRates{});
  predicted.resize(n);
  if (second == SecondRow::gradient) gradient.resize(n);
  if (second == SecondRow::corrected) corrected.resize(n);
  if (rings) ring.resize(n);
}

void Particles::permute(std::uint32_t first, const std::vector<std::uint32_t>& order) {
#pragma omp parallel
  for_each_array(*this, [&](Role role, auto& array) {
    const bool kept = role != Role::evaluated || !place.empty();
    if (role != Role::scratch && kept) reorder(array, first, order);
  });
}

/// By all threads of a team together. A thread keeps its share in those predicted rows that it writes next: other ones would come
/// from another core's cache.
template <class T>
void Particles::reorder(std::vector<T>& a, std::uint32_t first, const std::vector<std::uint32_t>& order) {
  static_assert(sizeof(T) <= sizeof(FluidRow));
  if (a.empty()) return;
  const std::size_t n = order.size(), t = std::size_t(omp_get_thread_num()), team = std::size_t(omp_get_num_threads());
  const std::size_t from = n * t / team, to = n * (t + 1) / team;
  T* const data = a.data();
  T* const spare = reinterpret_cast<T*>(predicted.data() + first + from);
  for (std::size_t k = from; k < to; ++k) spare[k - from] = data[order[k]];
#pragma omp barrier
  for (std::size_t k = from; k < to; ++k) data[first + k] = spare[k - from];
}

void Particles::insert_after(const std::vector<std::uint32_t>& places) {
  for_each_array(*this, [&](Role, auto& array) {
    if (array.empty()) return;
    std::size_t end = array.size(), to = end + places.size();
    array.resize(to);
    for (std::size_t k = places.size(); k-- > 0;) {
      const std::size_t behind = places[k] + 1;
      std::move_backward(array.begin() + std::ptrdiff_t(behind), array.begin() + std::ptrdiff_t(end),
                         array.begin() + std::ptrdiff_t(to));
      to -= end - behind;
      array[--to] = array[places[k]];
      end = behind;
    }
  });
}

void Particles::keep_start() {
  for_each_array(
      state_arrays, [](Role, auto& to, const auto& from) { copy_all(to, from); }, start, *this);
}

void Particles::restore_start() {
  for_each_array(
      state_arrays, [](Role, auto& to, const auto& from) { copy_all(to, from); }, *this, start);
}

void Particles::turn_rates() {
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < size(); ++i) {
    const SumRow& r = rate[i];
    if (!earlier.empty())
      earlier[i] = {.ax = float(r.fx), .ay = float(r.fy), .az = float(r.fz), .compression = float(r.compression)};
    rate[i] = SumRow{};
  }
}

void Particles::gather(const Particles& whole) {
  const std::size_t n = place.size();
  const auto copies = [&](Role role, auto& mine, const auto& all) {
    if (role == Role::rate || role == Role::index) return;
    mine.resize(all.empty() ? 0 : n);
    for (std::size_t k = 0; k < mine.size(); ++k) mine[k] = all[place[k]];
  };
  for_each_array(state_arrays, copies, *this, whole);
  for_each_array(further_arrays, copies, *this, whole);
  rate.resize(n);
  earlier.resize(n);
  other.resize(n);
  for (std::size_t k = 0; k < n; ++k) {
    const std::uint32_t i = place[k];
    rate[k] = whole.other[i].rate;
    earlier[k] = whole.other[i].earlier;
    other[k] = {whole.rate[i], whole.earlier[i]};
  }
}

void Particles::scatter(Particles& whole) const {
  const auto put = [&](Role, const auto& mine, auto& all) {
    for (std::size_t k = 0; k < mine.size(); ++k) all[place[k]] = mine[k];
  };
  for_each_array(state_arrays, put, *this, whole);
  for (std::size_t k = 0; k < place.size(); ++k) {
    const std::uint32_t i = place[k];
    whole.other[i] = {rate[k], earlier[k]};
    whole.rate[i] = other[k].rate;
    whole.earlier[i] = other[k].earlier;
  }
}

bool Particles::copy(std::string_view name, std::vector<double>& out) const {
  bool found = false;
  const auto from = [&](const auto& array, const auto& owner) {
    constexpr std::size_t count = std::tuple_size_v<decltype(array.member)>;
    if constexpr (requires { out[0] = double((owner.*array.member[0])[0]); }) {
      if (name != array.name || array.role == Role::index) return;
      found = true;
      out.resize(count * size());
      for (std::size_t a = 0; a < count; ++a) {
        const auto& values = owner.*array.member[a];
#pragma omp parallel for schedule(static)
        for (std::size_t i = 0; i < size(); ++i) out[count * i + a] = double(values[i]);
      }
    }
  };
  std::apply([&](const auto&... array) { (from(array, *this), ...); }, state_arrays);
  std::apply([&](const auto&... array) { (from(array, *this), ...); }, further_arrays);
  return found;
}

void* Particles::second_rows() {
  if (!gradient.empty()) return gradient.data();
  if (!corrected.empty()) return corrected.data();
  return viscosity.data();
}

void Particles::visit_state(StateVisitor& state, bool with_evaluated) {
  std::vector<std::uint32_t> of_id(size());
  for (std::size_t i = 0; i < size(); ++i) of_id[id[i]] = std::uint32_t(i);
  state("place in memory", of_id);
  const auto each = [&](const auto& array, auto& owner) {
    if (array.role == Role::index) return;
    if (array.role == Role::evaluated && !with_evaluated) {
      if (state.restores())
        for (const auto member : array.member)
          if (!(owner.*member).empty()) (owner.*member).resize(of_id.size());
      return;
    }
    constexpr std::size_t count = std::tuple_size_v<decltype(array.member)>;
    for (std::size_t a = 0; a < count; ++a) {
      const std::string component = count > 1 ? std::string("_") + "xyz"[a] : std::string();
      visit_in_order(state, std::string(array.name) + component, owner.*array.member[a], of_id);
    }
  };
  std::apply([&](const auto&... array) { (each(array, static_cast<ParticleState&>(*this)), ...); }, state_arrays);
  std::apply([&](const auto&... array) { (each(array, *this), ...); }, further_arrays);
}

std::size_t Particles::memory_bytes() const {
  std::size_t bytes = 0;
  const auto add = [&](Role, const auto& array) { bytes += array.capacity() * sizeof(array[0]); };
  for_each_array(state_arrays, add, *this);
  for_each_array(further_arrays, add, *this);
  for_each_array(state_arrays, add, start);
  return bytes;
}

}  // namespace undex::sph
