#include "myoid/phases/phases.h"

namespace myoid {

std::string_view name(PhaseKind kind) {
  switch (kind) {
    case PhaseKind::rest:
      return "rest";
    case PhaseKind::isometric:
      return "isometric";
    case PhaseKind::warm_up:
      return "warm_up";
    case PhaseKind::regular:
      return "regular";
    case PhaseKind::fatigued:
      return "fatigued";
    case PhaseKind::changed:
      return "changed";
  }
  return "?";
}

}  // namespace myoid
