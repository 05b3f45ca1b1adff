// A simulation that goes on from saved state does what the one that was not cut does, to the last bit: scenes of every kind of
// state, cut after some steps.
#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "judge/judge.hpp"
#include "output/checkpoint.hpp"
#include "run/simulation.hpp"
#include "run/starts.hpp"
#include "scene/scene.hpp"

namespace undex::run {
namespace {

struct Cut {
  std::string name, scene;
  std::vector<std::pair<std::string, std::string>> settings;
  int steps = 25;  ///< before the cut, and after it
};

scene::Scene scene_of(const Cut& cut) {
  std::vector<scene::Override> overrides;
  for (const auto& [key, value] : cut.settings) overrides.push_back({key, value});
  scene::Scene scene = scene::read(std::filesystem::path(UNDEX_CASES) / cut.scene, judge::comparison_kinds(), overrides);
  begin(scene);
  return scene;
}

void advance(Simulation& simulation, const scene::Scene& scene, int steps) {
  for (int k = 0; k < steps; ++k) simulation.advance(scene.end_time);
}

std::string fingerprint(Simulation& simulation) {
  return output::fingerprint([&](StateVisitor& state) { simulation.visit_state(state); });
}

class ACutSimulation : public testing::TestWithParam<Cut> {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    omp_set_num_threads(2);
  }
  std::filesystem::path folder_ = std::filesystem::temp_directory_path() / ("undex_restore_" + std::to_string(getpid()));
};

TEST_P(ACutSimulation, GoesOnToTheSameBits) {
  scene::Scene scene = scene_of(GetParam());
  scene.fluid.numerics.threads = 2;
  Simulation whole(scene);
  const std::string start = fingerprint(whole);
  advance(whole, scene, GetParam().steps);
  output::write_checkpoint(folder_, {.time = whole.time(), .steps = whole.steps(), .scene = "", .numerics = "", .start = start},
                           [&](StateVisitor& state) { whole.visit_state(state); });
  const std::string at_cut = fingerprint(whole);
  advance(whole, scene, GetParam().steps);

  scene.fluid.numerics.threads = 1;
  Simulation resumed(scene);
  EXPECT_EQ(fingerprint(resumed), start);
  output::Checkpoint(folder_ / output::checkpoint_names[0]).restore([&](StateVisitor& state) { resumed.visit_state(state); });
  EXPECT_EQ(fingerprint(resumed), at_cut);
  EXPECT_NE(at_cut, start);
  advance(resumed, scene, GetParam().steps);
  EXPECT_EQ(resumed.time(), whole.time());
  EXPECT_EQ(resumed.energy().total(), whole.energy().total());
  EXPECT_EQ(fingerprint(resumed), fingerprint(whole));
}

const std::string spacing = "resolution.spacing";

INSTANTIATE_TEST_SUITE_P(
    Scenes, ACutSimulation,
    testing::Values(
        Cut{"gas", "sjogreen", {{spacing, "0.01"}}}, Cut{"burning_charge", "petn_slab", {{spacing, "4e-4"}}},
        Cut{"rigid_walls", "rigid_cylinder", {{spacing, "0.006"}, {"start.kind", "\"plain\""}}},
        Cut{"spherical_start", "rigid_cylinder", {{spacing, "0.006"}}},
        Cut{"from_a_run", "rigid_cylinder/chained.toml", {{spacing, "0.006"}}},
        Cut{"viscosity_switch", "rigid_cylinder", {{spacing, "0.006"}, {"scheme.name", "\"monaghan_switch\""}}},
        Cut{"corrected", "rigid_cylinder", {{spacing, "0.006"}, {"scheme.name", "\"riemann_corrected\""}}},
        Cut{"runge_kutta", "rigid_cylinder", {{spacing, "0.006"}, {"scheme.integrator", "\"ssp_rk3\""}}, 18},
        Cut{"mirror_wall", "al_tube_fem", {{spacing, "0.005"}}},
        Cut{"lined_wall", "al_tube_fem", {{spacing, "0.005"}, {"coupling.slip", "false"}}},
        Cut{"moving_runge_kutta", "al_tube_fem", {{spacing, "0.005"}, {"scheme.integrator", "\"ssp_rk3\""}}},
        Cut{"local_steps", "al_tube_fem", {{spacing, "0.005"}, {"scheme.local_steps", "true"}}, 20},
        Cut{"shells",
            "al_tube_fem",
            {{spacing, "0.005"},
             {"structure.element", "\"shell\""},
             {"structure.cells", "{through = 1, around = 48, along = 36}"}}},
        Cut{"two_structures", "two_panels", {{spacing, "0.004"}}},
        Cut{"one_system", "al_tube_sph", {{spacing, "0.005"}, {"solids.tube.spacing", "0.003175"}}},
        Cut{"one_system_lined",
            "al_tube_sph",
            {{spacing, "0.005"}, {"solids.tube.spacing", "0.003175"}, {"coupling.slip", "false"}}},
        Cut{"on_a_radius", "free_field/radial.toml", {{spacing, "1e-4"}}, 300},
        Cut{"radiating", "free_field/radiating.toml", {{spacing, "0.005"}}, 12},
        Cut{"radiating_local_steps", "free_field/radiating.toml", {{spacing, "0.005"}, {"scheme.local_steps", "true"}}, 12},
        Cut{"radiating_runge_kutta", "free_field/radiating.toml", {{spacing, "0.005"}, {"scheme.integrator", "\"ssp_rk3\""}}, 12},
        Cut{"plane_wave", "taylor_plate", {{spacing, "0.002"}}, 12}, Cut{"free_obstacle", "obstacles", {{spacing, "0.01"}}},
        Cut{"led_obstacle", "obstacles/piston.toml", {{"scheme.integrator", "\"ssp_rk3\""}}},
        Cut{"total_lagrangian", "taylor_bar_sph", {{spacing, "0.0008"}}, 60},
        Cut{"updated_lagrangian", "taylor_bar_sph/updated.toml", {{spacing, "0.0008"}}, 60},
        Cut{"updated_rings", "al_sphere_impact/axisymmetric.toml", {{spacing, "0.002"}}, 60},
        Cut{"contact", "colliding_rings", {{spacing, "0.002"}}, 200}, Cut{"finite_elements", "taylor_bar_fem", {}, 60},
        Cut{"failure", "al_sphere_impact", {{spacing, "0.002"}}, 60}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace undex::run
