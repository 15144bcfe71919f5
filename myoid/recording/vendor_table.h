#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/recording/text_file.h"

namespace myoid::recording {

/// A text in which a header that no general rule reads is replaced by one that it does: names with
/// units in one row, "Sampling rate: R Hz" above. Every line stays at its number. Known are the
/// section "Devices" of Vicon Nexus (.csv), Qualisys' analog channels (.tsv, DATA_INCLUDED ANALOG),
/// BIOPAC's text (names and units in lines of their own), and BTS' EMG tracks (.emt, one unit for
/// all). Empty for other texts.
struct PlainTable {
  std::string text;
  std::vector<Repair> repairs;
};
[[nodiscard]] PlainTable plain_vendor_table(std::string_view text);

}  // namespace myoid::recording
