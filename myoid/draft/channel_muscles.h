#pragma once

#include <string>
#include <vector>

namespace myoid {

/// An EMG channel and the muscles that its electrode is taken to lie on.
struct ChannelMuscles {
  std::string channel;
  std::vector<std::string> muscles;  ///< Of the model; empty: none is recognized.
  std::string family;                ///< "biceps brachii", ...; empty likewise.
};

/// Pairs the channels with the model's muscles by what both are usually called: "Biceps_R" and
/// BIClong, BICshort; "L TRICEPS LAT" and TRIlat, or all heads of the triceps where no other
/// channel is on them. A name of a group ("MH", "quadriceps") is all of its muscles, one that is
/// not usual is compared letter by letter. A side that both state (_r, _l, right, left) must be the
/// same. Every channel comes back, in order.
[[nodiscard]] std::vector<ChannelMuscles> match_channels(const std::vector<std::string>& channels,
                                                         const std::vector<std::string>& muscles);

}  // namespace myoid
