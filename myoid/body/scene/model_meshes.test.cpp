#include "myoid/body/scene/model_meshes.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::body {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kModel = R"(<OpenSimDocument Version="40000"><Model name="m">
<Ground name="ground"><attached_geometry><Mesh name="g"><mesh_file>floor.obj</mesh_file></Mesh></attached_geometry></Ground>
<BodySet><objects><Body name="shank"><mass>1</mass><inertia>1 1 1 0 0 0</inertia>
<attached_geometry>
<Mesh name="a"><scale_factors>2 1 -1</scale_factors><mesh_file>bone.obj</mesh_file></Mesh>
<Mesh name="b"><Appearance><visible>false</visible></Appearance><mesh_file>hidden.obj</mesh_file></Mesh>
</attached_geometry>
<components><PhysicalOffsetFrame name="turned"><socket_parent>..</socket_parent>
<attached_geometry><Mesh name="c"><mesh_file>plate.obj</mesh_file></Mesh></attached_geometry>
<translation>0 0 0.5</translation><orientation>0 0 1.5707963267948966</orientation></PhysicalOffsetFrame></components>
</Body></objects></BodySet></Model></OpenSimDocument>)";

const std::string kOldModel = R"(<OpenSimDocument Version="20303"><Model name="m">
<BodySet><objects><Body name="ground"/><Body name="shank"><mass>1</mass>
<VisibleObject><GeometrySet><objects>
<DisplayGeometry><geometry_file> bone.vtp </geometry_file><transform>0 0 1.5707963267948966 0.1 0 0</transform>
<scale_factors>1 2 1</scale_factors><display_preference>4</display_preference></DisplayGeometry>
<DisplayGeometry><geometry_file>no.vtp</geometry_file><display_preference>0</display_preference></DisplayGeometry>
</objects></GeometrySet><scale_factors>3 1 1</scale_factors><transform>0 0 0 0 0 1</transform></VisibleObject>
</Body></objects></BodySet></Model></OpenSimDocument>)";

void write(const std::filesystem::path& file, const std::string& text) { std::ofstream(file) << text; }

TEST(ModelMeshes, OfBodiesAndFramesAreListedWithPlaceAndScale) {
  const std::vector<MeshUse> uses = list_meshes(kModel, "m.osim");
  ASSERT_EQ(uses.size(), 3U);
  EXPECT_EQ(uses[0].file, "floor.obj");
  EXPECT_EQ(uses[0].body, 0);
  EXPECT_EQ(uses[1].file, "bone.obj");
  EXPECT_EQ(uses[1].scale, Vec3(2.0, 1.0, -1.0));
  EXPECT_EQ(uses[2].file, "plate.obj");
  EXPECT_EQ(uses[2].body, 1);
  // A quarter turn about z, then half a meter up it.
  EXPECT_LT((uses[2].X_BM * Vec3(1.0, 0.0, 0.0) - Vec3(0.0, 1.0, 0.5)).norm(), 1e-12);
}

TEST(ModelMeshes, OfOldDocumentsAreListedToo) {
  const std::vector<MeshUse> uses = list_meshes(kOldModel, "m.osim");
  ASSERT_EQ(uses.size(), 1U);
  EXPECT_EQ(uses[0].file, "bone.vtp");
  EXPECT_EQ(uses[0].scale, Vec3(3.0, 2.0, 1.0));
  EXPECT_LT((uses[0].X_BM * Vec3(1.0, 0.0, 0.0) - Vec3(0.1, 1.0, 1.0)).norm(), 1e-12);
}

TEST(ModelMeshes, AreTakenIntoTheBodyAndMirroredOnesTurned) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder / "Geometry");
  write(folder / "Geometry/bone.obj", "v 0 0 0\nv 1 0 0\nv 0 1 1\nf 1 2 3\n");
  const LoadedMeshes loaded = load_meshes(kModel, folder / "m.osim");
  ASSERT_EQ(loaded.meshes.size(), 1U);
  EXPECT_EQ(loaded.meshes[0].body, 1);
  EXPECT_EQ(loaded.meshes[0].mesh.vertices[1], Vec3(2.0, 0.0, 0.0));
  EXPECT_EQ(loaded.meshes[0].mesh.vertices[2], Vec3(0.0, 1.0, -1.0));
  EXPECT_EQ(loaded.meshes[0].mesh.triangles[0], (std::array<int, 3>{0, 2, 1}));
  EXPECT_THAT(sentences(loaded.notes), Contains(HasSubstr("2 mesh files are not there: floor.obj")));
}

TEST(ModelMeshes, AModelThatComesWithoutItsMeshesSaysNothingOfThem) {
  const test::TemporaryFolder folder;
  const LoadedMeshes loaded = load_meshes(kModel, folder / "m.osim");
  EXPECT_THAT(loaded.meshes, IsEmpty());
  EXPECT_THAT(loaded.notes, IsEmpty());
}

TEST(ModelMeshes, ThatCannotBeReadAreSaid) {
  const test::TemporaryFolder folder;
  write(folder / "bone.obj", "v 0 0\n");
  EXPECT_THAT(sentences(load_meshes(kModel, folder / "m.osim").notes), Contains(HasSubstr("bone.obj:1")));
}

TEST(ModelMeshes, OfMoreTrianglesThanAskedForAreSimplified) {
  const test::TemporaryFolder folder;
  std::string text;  // a square meter in steps of 20 mm
  for (int i = 0; i <= 50; ++i)
    for (int k = 0; k <= 50; ++k) text += "v " + std::to_string(0.02 * i) + ' ' + std::to_string(0.02 * k) + " 0\n";
  for (int i = 0; i < 50; ++i) {
    for (int k = 0; k < 50; ++k) {
      const int at = 51 * i + k + 1;
      text += "f " + std::to_string(at) + ' ' + std::to_string(at + 51) + ' ' + std::to_string(at + 52) + ' ' +
              std::to_string(at + 1) + '\n';
    }
  }
  write(folder / "plate.obj", text);
  const LoadedMeshes loaded = load_meshes(kModel, folder / "m.osim", {.most_triangles = 800});
  ASSERT_EQ(loaded.meshes.size(), 1U);
  EXPECT_LE(loaded.meshes[0].mesh.triangles.size(), 800U);
  EXPECT_GT(loaded.meshes[0].mesh.triangles.size(), 100U);
  EXPECT_THAT(sentences(loaded.notes), Contains(HasSubstr("of 5000 triangles")));
}

TEST(ModelMeshes, OfPublicModelsAreAllListed) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  for (const auto& [name, least] : {std::pair{"rajagopal2016", 50U}, {"gait2392_v20302", 20U}, {"arm26_v20303", 20U}}) {
    const auto file = folder / name / "model.osim";
    const std::string text = read_text_file(file);
    EXPECT_GE(list_meshes(text, file).size(), least) << name;
  }
}

}  // namespace
}  // namespace myoid::body
