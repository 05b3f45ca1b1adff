// An axisymmetric scene is of revolution, all of it; its planes of symmetry through the axis say nothing more.
#include "scene/draft.hpp"
#include "scene/revolution.hpp"

namespace undex::scene {

void settle_revolution(Draft& draft) {
  Scene& scene = draft.scene;
  if (scene.geometry != Geometry::axisymmetric || !draft.report.empty()) return;
  if (!draft.root.find("axis")) scene.axis = likeliest_axis(scene);
  const Meridian line = line_along(scene, scene.axis);
  const Places places(draft.root);
  for (const Objection& objection : objections(scene, line))
    draft.report.add(places.finding(objection.key, "dimension = \"axisymmetric\": " + objection.why));
  if (!draft.report.empty()) return;  // it has no meridian
  for (int a = 0; a < 3; ++a)
    if (a != scene.axis) scene.fluid.symmetry.axis[static_cast<std::size_t>(a)] = false;
  for (fem::Settings& each : scene.structures) std::erase_if(each.symmetry_axes, [&](int a) { return a != scene.axis; });
  scene.meridian = line;
}

}  // namespace undex::scene
