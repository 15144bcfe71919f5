#include "myoid/page/json_values.h"

#include <limits>

#include <gtest/gtest.h>

namespace myoid::page {
namespace {

TEST(NumberOrNull, WhatIsAbsentOrNotFiniteIsNull) {
  EXPECT_EQ(number_or_null(0.25).dump(), "0.25");
  EXPECT_TRUE(number_or_null(std::nullopt).is_null());
  EXPECT_TRUE(number_or_null(std::numeric_limits<double>::quiet_NaN()).is_null());
  EXPECT_TRUE(number_or_null(-std::numeric_limits<double>::infinity()).is_null());
}

TEST(ProvenanceJson, NamesProgramInputsAndOptions) {
  Provenance provenance;
  provenance.version = "1.2.3";
  provenance.inputs = {{"a.osim", "abc"}};
  provenance.options_json = R"({"seed": 7})";
  const nlohmann::ordered_json json = provenance_json(provenance);
  EXPECT_EQ(json.at("version"), "1.2.3");
  EXPECT_EQ(json.at("inputs").at(0).at("sha256"), "abc");
  EXPECT_EQ(json.at("options").at("seed"), 7);
  EXPECT_TRUE(provenance_json({}).at("options").is_object());
}

}  // namespace
}  // namespace myoid::page
