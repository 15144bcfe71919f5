// Models: a model, a ReadError or a ModelError.
#include "myoid/body/osim/osim_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    static_cast<void>(myoid::body::parse_osim(myoid::fuzz::text(data, size), "fuzz.osim"));
  } catch (const myoid::ReadError&) {
  } catch (const myoid::ModelError&) {
  }
  return 0;
}
