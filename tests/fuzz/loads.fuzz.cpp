// External loads: the set-up (.xml) and its data file in one input.
#include "myoid/body/arm/arm4.h"
#include "myoid/body/dynamics/external_loads.h"
#include "myoid/body/osim/osim_reader.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  namespace fuzz = myoid::fuzz;
  static const auto model = myoid::body::parse_osim(myoid::body::arm4_osim(), "arm4.osim");
  fuzz::write_parts(fuzz::text(data, size), {"loads.xml", "loads.sto"});
  try {
    const auto loads = myoid::body::read_external_loads(model, fuzz::folder() / "loads.xml");
    for (const auto& force : loads.forces) {
      if (force.force) fuzz::require(force.force->at(loads.start_s).allFinite());
    }
  } catch (const myoid::ReadError&) {
  } catch (const myoid::InvalidInput&) {
  }
  return 0;
}
