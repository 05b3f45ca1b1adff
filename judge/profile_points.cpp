#include "judge/profile_points.hpp"

#include <algorithm>
#include <cmath>

#include "core/constants.hpp"

namespace undex::judge {
namespace {

constexpr double FlowState::*quantities[3] = {&FlowState::density, &FlowState::velocity, &FlowState::pressure};

}  // namespace

output::NamedNumbers profile_errors(const Profile& profile) {
  double volume = 0, error[3] = {}, largest[3] = {};
  for (const ProfilePoint& point : profile) {
    volume += point.volume;
    for (int k = 0; k < 3; ++k) {
      error[k] += point.volume * std::abs(point.run.*quantities[k] - point.exact.*quantities[k]);
      largest[k] = std::max(largest[k], std::abs(point.exact.*quantities[k]));
    }
  }
  const auto relative = [&](int k) { return largest[k] > 0 ? error[k] / volume / largest[k] : nan; };
  const auto absolute = [&](int k) { return volume > 0 ? error[k] / volume : nan; };
  return {{"points", double(profile.size())}, {"l1_density", relative(0)},       {"l1_velocity", relative(1)},
          {"l1_pressure", relative(2)},       {"l1_density_kg_m3", absolute(0)}, {"l1_velocity_m_s", absolute(1)},
          {"l1_pressure_pa", absolute(2)}};
}

ProfileMean profile_mean(const Profile& profile, double low, double high) {
  ProfileMean sum;
  double volume = 0;
  for (const ProfilePoint& point : profile) {
    if (point.coordinate < low || point.coordinate > high) continue;
    volume += point.volume;
    for (const auto quantity : quantities) {
      sum.run.*quantity += point.volume * point.run.*quantity;
      sum.exact.*quantity += point.volume * point.exact.*quantity;
    }
  }
  for (const auto quantity : quantities) {
    sum.run.*quantity = volume > 0 ? sum.run.*quantity / volume : nan;
    sum.exact.*quantity = volume > 0 ? sum.exact.*quantity / volume : nan;
  }
  return sum;
}

Profile shells(const Profile& profile, double width) {
  Profile result;
  for (std::size_t begin = 0, end; begin < profile.size(); begin = end) {
    const double shell = std::floor(profile[begin].coordinate / width);
    ProfilePoint mean;
    for (end = begin; end < profile.size() && std::floor(profile[end].coordinate / width) == shell; ++end) {
      const ProfilePoint& point = profile[end];
      mean.volume += point.volume;
      mean.coordinate += point.volume * point.coordinate;
      for (const auto quantity : quantities) {
        mean.run.*quantity += point.volume * point.run.*quantity;
        mean.exact.*quantity += point.volume * point.exact.*quantity;
      }
    }
    mean.body = profile[begin].body;
    mean.coordinate /= mean.volume;
    for (const auto quantity : quantities) {
      mean.run.*quantity /= mean.volume;
      mean.exact.*quantity /= mean.volume;
    }
    result.push_back(mean);
  }
  return result;
}

double front_position(const Profile& profile, double FlowState::*quantity, double level, bool from_high) {
  if (profile.empty()) return nan;
  const auto at = [&](std::size_t k) -> const ProfilePoint& { return profile[from_high ? profile.size() - 1 - k : k]; };
  for (std::size_t k = 1; k < profile.size(); ++k) {
    const double before = at(k - 1).run.*quantity - level, here = at(k).run.*quantity - level;
    if (before * here > 0) continue;
    const double share = before == here ? 0.0 : before / (before - here);
    return at(k - 1).coordinate + share * (at(k).coordinate - at(k - 1).coordinate);
  }
  return nan;
}

double largest_pressure_error(const Profile& profile, const std::function<bool(const ProfilePoint&)>& counts) {
  double largest = nan;
  for (const ProfilePoint& point : profile)
    if (counts(point)) largest = std::fmax(largest, std::abs(point.run.pressure - point.exact.pressure));
  return largest;
}

output::Samples profile_table(const Profile& profile) {
  output::Samples table({{"coordinate", "m"},
                         {"body", ""},
                         {"volume", "m^d"},
                         {"density", "kg/m3"},
                         {"velocity", "m/s"},
                         {"pressure", "Pa"},
                         {"exact_density", "kg/m3"},
                         {"exact_velocity", "m/s"},
                         {"exact_pressure", "Pa"}});
  for (const ProfilePoint& p : profile)
    table.append({p.coordinate, double(p.body), p.volume, p.run.density, p.run.velocity, p.run.pressure, p.exact.density,
                  p.exact.velocity, p.exact.pressure});
  return table;
}

output::Samples exact_profile_table(const Profile& profile) {
  output::Samples table({{"coordinate", "m"}, {"exact_density", "kg/m3"}, {"exact_velocity", "m/s"}, {"exact_pressure", "Pa"}});
  for (const ProfilePoint& p : profile) table.append({p.coordinate, p.exact.density, p.exact.velocity, p.exact.pressure});
  return table;
}

}  // namespace undex::judge
