#pragma once

#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "myoid/ground/core/geometry.h"

namespace myoid::recording {

/// A surface of triangles, in the file's unit.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< Indices of vertices, counterclockwise seen from outside.
};

/// Reads the mesh files that OpenSim models name: .vtp (VTK's XML PolyData, ASCII), .stl (ASCII and binary) and .obj.
/// Polygons become fans of triangles, strips are split, vertices that several triangles of an .stl repeat become one.
/// Throws ReadError, with the line if known, for other extensions, encodings of .vtp other than ASCII, indices that do
/// not exist and numbers that cannot be read.
[[nodiscard]] TriangleMesh read_mesh(const std::filesystem::path& path);
[[nodiscard]] TriangleMesh parse_mesh(std::string_view bytes, const std::filesystem::path& path);

/// Returns a coarser mesh: vertices in the same cell of a cubic grid become one (their mean), and
/// triangles that collapse are dropped. No vertex moves farther than the cell's diagonal.
[[nodiscard]] TriangleMesh simplified(const TriangleMesh& mesh, double cell);

}  // namespace myoid::recording
