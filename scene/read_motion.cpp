// Motions at the start.
#include "scene/draft.hpp"
#include "scene/record_reader.hpp"

namespace undex::scene {

void read_radial(const TableReader& table, std::optional<RadialMotion>& into) {
  const Node* node = table.table("radial");
  if (!node) return;
  const std::size_t before = table.report().size();
  RadialMotion motion;
  read_fields(TableReader(*node, table.path_of("radial"), "radial", table.dimension(), table.report()), motion);
  if (table.report().size() == before) into = motion;
}

}  // namespace undex::scene
