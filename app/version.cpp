#include "app/version.hpp"

#include "sph_fluid/pairs/cpu_level.hpp"

namespace undex::app {
namespace {

#if defined(__clang__)
const char* const compiler = "clang " __clang_version__;
#else
const char* const compiler = "g++ " __VERSION__;
#endif

/// Raised with every change after which a scene gives other digits: a checkpoint of before is then refused.
constexpr int numerics_version = 10;

std::string build_type() { return *UNDEX_BUILD_TYPE ? UNDEX_BUILD_TYPE : "none"; }

}  // namespace

std::string version_number() { return UNDEX_VERSION; }

std::string version_line() {
  const std::string git = UNDEX_GIT;
  return std::string("undex ") + UNDEX_VERSION + (git.empty() ? "" : " (" + git + ")") + ", " + compiler + ", " + build_type() +
         ", " + sph::cpu_level();
}

std::string numerics_line() {
  return "numerics " + std::to_string(numerics_version) + ", " + compiler + ", " + build_type() + ", " + sph::cpu_level();
}

// None of these texts holds a character that JSON would escape.
std::string version_json() {
  std::string text;
  const auto add = [&](const std::string& key, const std::string& value) {
    text += text.empty() ? "{" : ", ";
    text += '"' + key + "\": \"" + value + '"';
  };
  add("version", UNDEX_VERSION);
  add("git", UNDEX_GIT);
  add("compiler", compiler);
  add("build_type", build_type());
  add("cpu_level", sph::cpu_level());
  return text + "}";
}

}  // namespace undex::app
