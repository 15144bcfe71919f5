// Surfaces: the first letter of the input chooses the kind of file.
#include "myoid/recording/mesh_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace rec = myoid::recording;
  if (size == 0) return 0;
  const char* const name = data[0] == 'v' ? "f.vtp" : data[0] == 's' ? "f.stl" : "f.obj";
  myoid::fuzz::read([&] {
    const rec::TriangleMesh mesh = rec::parse_mesh(myoid::fuzz::text(data + 1, size - 1), name);
    const auto count = static_cast<int>(mesh.vertices.size());
    for (const auto& triangle : mesh.triangles)
      for (const int vertex : triangle) myoid::fuzz::require(vertex >= 0 && vertex < count);
    static_cast<void>(rec::simplified(mesh, 0.1));
  });
  return 0;
}
