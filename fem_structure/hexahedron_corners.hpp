// The corners of a hexahedron in the order of its nodes: the lower face round, then the upper one.
#pragma once

namespace undex::fem {

/// 0 or 1 along each of the cell's own directions.
inline constexpr int corner[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

}  // namespace undex::fem
