#include "run/starts.hpp"

#include "run/plane_wave_start.hpp"
#include "run/run_start.hpp"
#include "run/spherical_start.hpp"

namespace undex::run {

std::string start_words(scene::Start::Kind kind) {
  using Kind = scene::Start::Kind;
  switch (kind) {
    case Kind::plain: break;
    case Kind::spherical: return "spherical start";
    case Kind::plane_wave: return "plane wave";
    case Kind::run: return "start from run";
  }
  return "";
}

std::string begin(scene::Scene& scene, const StartOptions& options) {
  using Kind = scene::Start::Kind;
  Stages silent;
  Stages& stages = options.stages ? *options.stages : silent;
  switch (scene.start.kind) {
    case Kind::plain: return "";
    case Kind::spherical: return begin_spherically(scene, stages);
    case Kind::plane_wave: return begin_with_plane_wave(scene);
    case Kind::run: return begin_from_run(scene, options, stages);
  }
  return "";
}

}  // namespace undex::run
