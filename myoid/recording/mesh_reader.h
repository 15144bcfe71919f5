#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "myoid/core/geometry.h"

namespace myoid::recording {

/// A surface of triangles, in the file's unit.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>>
      triangles;  ///< Indices of vertices, counterclockwise from outside.
};

/// Reads the mesh files that OpenSim models name: .vtp (VTK's XML PolyData, ASCII), .stl (ASCII and
/// binary) and .obj. Polygons become fans of triangles, strips are taken apart, vertices that
/// several triangles of an .stl repeat become one. Throws ReadError, with the line where there is
/// one, for other endings, encodings of .vtp other than ASCII, indices that do not exist and
/// numbers that are none.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);
[[nodiscard]] TriangleMesh parse_mesh(std::string_view bytes, const std::filesystem::path& path);

/// The mesh with its vertices gathered in cells of a cube grid, one for each cell (their mean), and
/// without the triangles that vanish by that. No vertex moves farther than the cell's diagonal.
[[nodiscard]] TriangleMesh simplified(const TriangleMesh& mesh, double cell);

}  // namespace myoid::recording
