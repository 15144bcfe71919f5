#pragma once

#include "myoid/model/body_model.h"

namespace myoid::test {

/// Body 1 moves up and down over the ground, by coordinate 0.
inline model::Joint vertical_slider() {
  model::Joint root{.name = "root", .class_name = "CustomJoint", .parent = 0, .child = 1};
  root.coordinates = {0};
  root.rotation = {model::TransformAxis{Vec3::UnitX()}, model::TransformAxis{Vec3::UnitY()},
                   model::TransformAxis{Vec3::UnitZ()}};
  root.translation = {model::TransformAxis{Vec3::UnitX()},
                      model::TransformAxis{Vec3::UnitY(), 0, model::Linear{1.0, 0.0}},
                      model::TransformAxis{Vec3::UnitZ()}};
  return root;
}

}  // namespace myoid::test
