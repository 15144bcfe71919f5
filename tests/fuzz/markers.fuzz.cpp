// Tables of markers as the programs of their makers export them.
#include "myoid/recording/makers/marker_table.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace rec = myoid::recording;
  const auto input = myoid::fuzz::text(data, size);
  myoid::fuzz::read([&] {
    if (rec::is_marker_table(input)) static_cast<void>(rec::parse_marker_table(input, "f.csv"));
  });
  return 0;
}
