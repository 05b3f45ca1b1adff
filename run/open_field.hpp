// The one-dimensional flow of a scene's charge in water without end, as it runs, at the scene's fluid probes: as long as nothing
// else than the charge can have come there.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/history.hpp"
#include "output/samples.hpp"
#include "run/spherical_flow.hpp"
#include "scene/scene.hpp"

namespace undex::run {

class OpenField {
 public:
  /// Of the scene as it was read, before a start has changed it. Opens history/<probe>_1d.csv under `folder` where the scene asks
  /// for it; where the run goes on, visit_state opens them, which knows their rows.
  OpenField(const scene::Scene& scene, const std::filesystem::path& folder, bool goes_on);
  void visit_state(StateVisitor& state);
  /// Takes the flow to `time` [s] and appends a row to the history of each probe that only the charge's wave can have reached.
  void sample(double time);
  void flush();
  /// Of each probe by its name with "_1d".
  std::map<std::string, output::Samples> samples() const;

 private:
  struct Place {
    std::string name;
    double radius;  ///< from the charge's middle [m]
    double away;    ///< to the nearest thing that sends a wave back [m]
    double end;     ///< when that may have come [s]
    std::filesystem::path path;
    output::Samples samples;
    std::optional<output::History> history;
  };
  void look_for_echoes();

  std::vector<Place> places_;
  double echo_ = 0;  ///< distance from the charge's middle to what sends a wave back first [m]
  bool echoed_ = false;
  std::optional<SphericalFlow> flow_;
};

}  // namespace undex::run
