#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::test {

/// A C3D parameter that holds a list of texts, each padded with blanks to `width` characters.
inline recording::C3dParameter c3d_texts(const char* name, std::uint8_t width, const std::vector<std::string>& list) {
  recording::C3dParameter p{
      .name = name, .type = recording::C3dType::text, .dimensions = {width, static_cast<std::uint8_t>(list.size())}};
  for (std::string text : list) p.text += text.append(width - text.size(), ' ');
  return p;
}

}  // namespace myoid::test
