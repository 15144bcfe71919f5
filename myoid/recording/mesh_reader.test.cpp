#include "myoid/recording/mesh_reader.h"

#include <bit>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

/// Six times the signed volume inside: positive if the triangles turn outward, and that of the solid.
double volume_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += at(0).dot(at(1).cross(at(2)));
  }
  return sum / 6.0;
}

/// A cube of edge 2 about the origin, as four-cornered faces.
const std::string kCubeObj =
    "# cube\nv -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 1//1 4//1 3//1 2//1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf -4 -1 -5 -8\n";

const std::string kCubeVtp = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
<PolyData><Piece NumberOfPoints="8" NumberOfVerts="0" NumberOfPolys="6">
<PointData Normals="n"><DataArray type="Float32" Name="n" NumberOfComponents="3" format="ascii">
 0 0 1 0 0 1 0 0 1 0 0 1 0 0 1 0 0 1 0 0 1 0 0 1</DataArray></PointData>
<Points>
<DataArray type="Float32" NumberOfComponents="3" format="ascii">
-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1  -1 -1 1  1 -1 1  1 1 1  -1 1 1
</DataArray></Points>
<Polys>
<DataArray type="Int32" Name="connectivity" format="ascii">
 0 3 2 1  4 5 6 7  0 1 5 4  1 2 6 5  2 3 7 6  4 7 3 0 </DataArray>
<DataArray type="Int32" Name="offsets" format="ascii"> 4 8 12 16 20 24 </DataArray>
</Polys></Piece></PolyData></VTKFile>
)";

TEST(MeshReader, ReadsTheSameCubeFromEveryFormat) {
  const TriangleMesh obj = parse_mesh(kCubeObj, "cube.obj");
  EXPECT_EQ(obj.vertices.size(), 8U);
  EXPECT_EQ(obj.triangles.size(), 12U);
  EXPECT_DOUBLE_EQ(volume_of(obj), 8.0);
  const TriangleMesh vtp = parse_mesh(kCubeVtp, "cube.VTP");
  EXPECT_EQ(vtp.triangles.size(), 12U);

  // The same triangles as .stl, as text and as bytes.
  std::string text = "solid cube\n";
  std::string bytes(80, ' ');
  const auto append = [&](std::uint32_t word) {
    for (int k = 0; k < 4; ++k) bytes += static_cast<char>((word >> (8 * k)) & 0xFFU);
  };
  append(12);
  for (const auto& t : obj.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (int k = 0; k < 3; ++k) append(0);
    for (const int corner : t) {
      text += "  vertex";
      for (const double x : obj.vertices[static_cast<std::size_t>(corner)]) {
        text += ' ' + std::to_string(x);
        append(std::bit_cast<std::uint32_t>(static_cast<float>(x)));
      }
      text += '\n';
    }
    text += " endloop\nendfacet\n";
    bytes += std::string(2, '\0');
  }
  text += "endsolid cube\n";
  for (const auto& [name, content] : {std::pair{"text", text}, std::pair{"bytes", bytes}}) {
    const TriangleMesh stl = parse_mesh(content, "cube.stl");
    EXPECT_EQ(stl.vertices.size(), 8U) << name;
    EXPECT_DOUBLE_EQ(volume_of(stl), 8.0) << name;
  }
}

TEST(MeshReader, TakesStripsApartWithAllTrianglesTurningAlike) {
  const std::string text =
      "<VTKFile><PolyData><Piece><Points><DataArray format=\"ascii\">0 0 0 1 0 0 0 1 0 1 1 0 0 2 0"
      "</DataArray></Points><Strips><DataArray Name=\"connectivity\" format=\"ascii\">0 1 2 3 4"
      "</DataArray><DataArray Name=\"offsets\" format=\"ascii\">5</DataArray></Strips></Piece>"
      "</PolyData></VTKFile>";
  const TriangleMesh mesh = parse_mesh(text, "s.vtp");
  ASSERT_EQ(mesh.triangles.size(), 3U);
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    EXPECT_GT((at(1) - at(0)).cross(at(2) - at(0)).z(), 0.0);
  }
}

TEST(MeshReader, RefusesBrokenFilesWithThePlace) {
  const auto replaced = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::vector<std::array<std::string, 3>> broken{
      {"m.ply", "ply", "'.ply'"},
      {"m.vtp", "hello", "PolyData"},
      {"m.vtp", replaced(kCubeVtp, "format=\"ascii\">\n-1", "format=\"binary\">\n-1"), "m.vtp:7"},
      {"m.vtp", replaced(kCubeVtp, "1 1 1  -1", "1 one 1  -1"), "m.vtp:8"},
      {"m.vtp", replaced(kCubeVtp, " 4 7 3 0 ", " 4 7 3 9 "), "vertex 10 of 8"},
      {"m.vtp", replaced(kCubeVtp, "20 24", "20 99"), "offset 99"},
      // Found by fuzzing: an array without content.
      {"m.vtp", "<PolyData><Points>\n<DataArray type=\"Float32\"/></Points></PolyData>", "m.vtp:2"},
      {"m.vtp", replaced(kCubeVtp, " 4 7 3 0 ", " 4 7 3 1e300 "), "no vertex"},
      {"m.vtp", replaced(kCubeVtp, "20 24", "20 1e300"), "1e+300"},
      {"m.stl", "solid s\nfacet\nouter loop\nvertex 0 0 0\n", "cut off"},
      {"m.stl", "solid s\nvertex 0 0 0\nvertex 0 0 1\nendloop\n", "m.stl:4"},
      {"m.stl", std::string(200, 'x'), "solid"},
      {"m.obj", "v 0 0\n", "m.obj:1"},
      {"m.obj", "v 0 0 0\nf 1 2 3\n", "vertex 2 of 1"},
      {"m.obj", "v 0 0 0\nf a b c\n", "m.obj:2"},
      {"m.obj", "v 0 0 0\nf 1 1 3e27\n", "m.obj:2"},
      {"m.obj", "v 0 inf 0\n", "m.obj:1"}};
  for (const auto& [name, text, said] : broken) {
    try {
      (void)parse_mesh(text, name);
      ADD_FAILURE() << said;
    } catch (const ReadError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(said));
    }
  }
}

TEST(MeshReader, SimplifiesWithinTheCellsDiagonalAndKeepsTheSolid) {
  // A ball of 40 x 80 faces.
  std::string text;
  const int rows = 40;
  const int columns = 80;
  for (int i = 0; i <= rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const double a = M_PI * i / rows;
      const double b = 2.0 * M_PI * k / columns;
      text += "v " + std::to_string(std::sin(a) * std::cos(b)) + ' ' + std::to_string(std::sin(a) * std::sin(b)) + ' ' +
              std::to_string(std::cos(a)) + '\n';
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int k = 0; k < columns; ++k) {
      const int next = (k + 1) % columns;
      text += "f";
      for (const int v : {i * columns + k, (i + 1) * columns + k, (i + 1) * columns + next, i * columns + next})
        text += ' ' + std::to_string(v + 1);
      text += '\n';
    }
  }
  const TriangleMesh ball = parse_mesh(text, "ball.obj");
  const TriangleMesh small = simplified(ball, 0.15);
  EXPECT_LT(small.triangles.size(), ball.triangles.size() / 2);
  for (const Vec3& p : small.vertices) {
    // A mean of points of the sphere within one cell: at most diagonal^2 / 8 inside.
    EXPECT_LT(p.norm(), 1.0 + 1e-6);
    EXPECT_GT(p.norm(), 1.0 - 3.0 * 0.15 * 0.15 / 8.0);
  }
  EXPECT_NEAR(volume_of(small), volume_of(ball), 0.03 * volume_of(ball));
}

}  // namespace
}  // namespace myoid::recording
