#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "myoid/ground/math/random.h"
#include "myoid/study/phases/movement_blocks.h"

namespace myoid::test {

/// Blocks of one movement; gain and frequency in per cent of the first's.
struct GainPart {
  int count;
  double gain, frequency;
  double slope = 0.0;  ///< Of the gain, per cent of it per block.
  double speed = 2.0;
};
inline std::vector<study::Block> gain_blocks(const std::vector<GainPart>& parts, std::uint64_t seed = 4) {
  math::Random random(seed, 0);
  std::vector<study::Block> result;
  for (const GainPart& part : parts) {
    for (int i = 0; i < part.count; ++i) {
      study::Block block;
      block.gain = std::log(part.gain / 100.0) + 0.01 * part.slope * i + 0.02 * random.normal();
      block.frequency = std::log(part.frequency / 100.0) + 0.01 * random.normal();
      block.speed = part.speed;
      block.torque = 10.0;
      result.push_back(block);
    }
  }
  return result;
}

}  // namespace myoid::test
