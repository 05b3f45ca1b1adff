#include "run/starts.hpp"

#include "run/plane_wave_start.hpp"
#include "run/run_start.hpp"
#include "run/spherical_start.hpp"

namespace undex::run {

std::string begin(scene::Scene& scene, const StartOptions& options) {
  using Kind = scene::Start::Kind;
  switch (scene.start.kind) {
    case Kind::plain: return "";
    case Kind::spherical: return begin_spherically(scene, StartNews(options.quiet));
    case Kind::plane_wave: return begin_with_plane_wave(scene);
    case Kind::run: return begin_from_run(scene, options);
  }
  return "";
}

}  // namespace undex::run
