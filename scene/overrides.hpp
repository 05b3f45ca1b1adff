// Command-line overrides: dotted paths into a scene document.
#pragma once

#include <vector>

#include "scene/document.hpp"
#include "scene/report.hpp"
#include "scene/scene.hpp"

namespace undex::scene {

/// Writes each value into the document. Elements of arrays of tables are addressed by their name or index; a material
/// given by name becomes a changed copy of it when one of its parameters is addressed. Keys that do not exist are
/// created: whether the scene knows them is the reader's affair, and its report then names the override.
void apply(const std::vector<Override>& overrides, Node& root, Report& report);

}  // namespace undex::scene
