#pragma once

#include <string>
#include <vector>

namespace myoid::study {

/// An EMG channel and the muscles that its electrode is taken to lie on.
struct ChannelMuscles {
  std::string channel;
  std::vector<std::string> muscles;  ///< Muscles of the model; empty: the name fits none.
  std::string family;                ///< "biceps brachii", ...; empty likewise.
};

/// Pairs the channels with the model's muscles by their usual names: "Biceps_R" and
/// BIClong, BICshort; "L TRICEPS LAT" and TRIlat, or all heads of the triceps where no other channel is on them. The
/// name of a group ("MH", "quadriceps") means all of its muscles; an unusual name is compared letter by letter. A side
/// that both state (_r, _l, right, left) must be the same. The result has every channel, in order.
[[nodiscard]] std::vector<ChannelMuscles> match_channels(const std::vector<std::string>& channels,
                                                         const std::vector<std::string>& muscles);

/// The limbs whose muscles channels name.
struct Limbs {
  bool arm = false, leg = false;
};

/// Returns the limbs that channels name a muscle of; the trunk and the shoulder blade are none.
[[nodiscard]] Limbs limbs_of(const std::vector<std::string>& channels);

}  // namespace myoid::study
