#include "myoid/ground/files/toml_table.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  myoid::fuzz::read([&] { static_cast<void>(myoid::parse_toml(myoid::fuzz::text(data, size), "fuzz.toml")); });
  return 0;
}
