#include "myoid/recording/trc_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  myoid::fuzz::read([&] { static_cast<void>(myoid::recording::parse_trc(myoid::fuzz::text(data, size), "fuzz.trc")); });
  return 0;
}
