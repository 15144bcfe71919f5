#include "myoid/recording/edf_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  myoid::fuzz::read(
      [&] { static_cast<void>(myoid::recording::parse_edf(myoid::fuzz::bytes(data, size), "fuzz.edf")); });
  return 0;
}
