#include "myoid/page/plain_unit.h"

namespace myoid::page {

PlainUnit plain_unit(Unit unit) {
  switch (unit) {
    case Unit::dimensionless:
      return {""};
    case Unit::meter:
      return {"cm", 100.0};
    case Unit::second:
      return {"ms", 1000.0};
    case Unit::radian:
      return {"°", 1.0 / kDegree};
    default:
      return {symbol(unit)};
  }
}

}  // namespace myoid::page
