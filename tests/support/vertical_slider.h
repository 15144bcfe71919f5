#pragma once

#include "myoid/body/model/body_model.h"

namespace myoid::test {

/// Body 1 moves up and down over the ground, by coordinate 0.
inline body::Joint vertical_slider() {
  body::Joint root{.name = "root", .class_name = "CustomJoint", .parent = 0, .child = 1};
  root.coordinates = {0};
  root.rotation = {body::TransformAxis{Vec3::UnitX()}, body::TransformAxis{Vec3::UnitY()},
                   body::TransformAxis{Vec3::UnitZ()}};
  root.translation = {body::TransformAxis{Vec3::UnitX()}, body::TransformAxis{Vec3::UnitY(), 0, body::Linear{1.0, 0.0}},
                      body::TransformAxis{Vec3::UnitZ()}};
  return root;
}

}  // namespace myoid::test
