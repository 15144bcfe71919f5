#include "myoid/ground/core/provenance.h"

#include <gtest/gtest.h>

namespace myoid::inline ground {
namespace {

// The two examples of FIPS 180-4 that NIST publishes with the algorithm.
TEST(Sha256, AgreesWithThePublishedExamples) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST(WithoutPlaces, WritesPathsFromTheFolderOfTheStudy) {
  Provenance all;
  all.command = "myoid run /home/a/patient/study.toml --out /home/a/results";
  all.inputs = {{"/home/a/patient/walk.c3d", "1"}, {"/opt/arm.osim", "2"}, {"near.sto", "3"}};
  all.options_json = R"({"file": "/home/a/models/arm.osim", "list": ["/home/a/patient/x/y.sto", 1], "text": "a /b"})";
  const Provenance told = without_places(all, "/home/a/patient");
  EXPECT_EQ(told.command, "myoid run study.toml --out ../results");
  EXPECT_EQ(told.inputs[0].path, "walk.c3d");
  EXPECT_EQ(told.inputs[1].path, "arm.osim");
  EXPECT_EQ(told.inputs[2].path, "near.sto");
  EXPECT_EQ(told.inputs[1].sha256, "2");
  EXPECT_EQ(told.options_json.find("/home"), std::string::npos) << told.options_json;
  EXPECT_NE(told.options_json.find("../models/arm.osim"), std::string::npos) << told.options_json;
  EXPECT_NE(told.options_json.find("a /b"), std::string::npos) << told.options_json;
}

}  // namespace
}  // namespace myoid::inline ground
