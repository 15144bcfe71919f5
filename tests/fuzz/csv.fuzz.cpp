#include "myoid/recording/makers/emg_table.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  myoid::fuzz::read(
      [&] { static_cast<void>(myoid::recording::parse_emg_table(myoid::fuzz::text(data, size), "fuzz.csv")); });
  return 0;
}
