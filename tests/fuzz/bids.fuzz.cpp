// Motion-BIDS: _channels.tsv, _motion.json and _motion.tsv of one recording in one input.
#include "myoid/recording/bids.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  fuzz::write_parts(fuzz::text(data, size), {"a_channels.tsv", "a_motion.json", "a_motion.tsv"});
  fuzz::read([] { static_cast<void>(myoid::recording::read_bids_motion(fuzz::folder() / "a_motion.tsv")); });
  return 0;
}
