#include "scene/units.hpp"

#include <udunits2.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>

namespace undex::scene {
namespace {

constexpr std::size_t longest = 60;

using Unit = std::unique_ptr<ut_unit, decltype(&ut_free)>;

/// The units of udunits2's database, and "deg". Null: there is no database.
ut_system* units() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);
    ut_system* read = ut_read_xml(nullptr);
    if (read)
      if (const Unit degree(ut_get_unit_by_name(read, "degree"), &ut_free); degree)
        ut_map_name_to_unit("deg", UT_ASCII, degree.get());
    return read;
  }();
  return system;
}

/// Seventy tenths of a millimetre are 0.007 m, and not what products of rounded factors make of them.
double without_noise(double value) {
  char digits[40];
  std::snprintf(digits, sizeof digits, "%.15g", value);
  return std::strtod(digits, nullptr);
}

}  // namespace

Converted in_unit(const std::string& text, const std::string& unit) {
  static std::mutex one_at_a_time;  // udunits2 keeps a state
  const std::lock_guard lock(one_at_a_time);
  const std::string wanted = unit.empty() ? "a number" : "a number in " + unit;
  if (text.size() > longest) return {{}, "must be " + wanted};
  const char* const end = text.data() + text.size();
  const char* begin = text.data();
  while (begin != end && *begin == ' ') ++begin;
  if (end - begin > 1 && *begin == '+') ++begin;
  double number = 0;
  const auto [after, error] = std::from_chars(begin, end, number);
  std::string name(after, end);
  name.erase(0, name.find_first_not_of(" *"));
  while (!name.empty() && name.back() == ' ') name.pop_back();
  if (error != std::errc() || !std::isfinite(number)) return {{}, "must be " + wanted + ", or a text that begins with a number"};
  if (name.empty()) return {{}, "has no unit: write the number without quotes, or name its unit"};
  if (!units()) return {{}, "has a unit, and the database of udunits2 is not installed (Debian: libudunits2-data)"};
  const Unit from(ut_parse(units(), name.c_str(), UT_UTF8), &ut_free);
  if (!from) return {{}, "has a unit that nobody knows, '" + name + "'; e.g. mm, g, us, GPa, g/cm3, m/s"};
  const Unit to(ut_parse(units(), unit.empty() ? "1" : unit.c_str(), UT_ASCII), &ut_free);
  if (!to || !ut_are_convertible(from.get(), to.get()))
    return {{}, unit.empty() ? "has a unit, and the value is a pure number" : "is none in units of " + unit};
  const std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from.get(), to.get()), &cv_free);
  const double value = converter ? cv_convert_double(converter.get(), number) : std::nan("");
  if (!std::isfinite(value)) return {{}, "is too large"};
  return {without_noise(value), {}};
}

}  // namespace undex::scene
