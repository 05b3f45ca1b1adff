// undex new: a scene of one's own, begun from one that works.
#pragma once

#include <filesystem>
#include <string>

namespace undex::app {

/// Copies a template into a new folder: the files that a page of docs/tasks shows ("plate", "tube", "free-field"), or a shipped
/// scene with its reference data ("rigid_cylinder"). The scene is called case.toml there. An empty name lists the templates.
/// Returns the exit code.
/// @throws UsageError where no template has that name or the folder is not empty, FileError where it cannot be written.
int new_scene(const std::string& name, const std::filesystem::path& folder);

}  // namespace undex::app
