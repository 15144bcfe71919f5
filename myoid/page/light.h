#pragma once

#include <string>
#include <vector>

#include "myoid/page/report.h"

namespace myoid::page {

/// The light of the gates: the worst of them decides.
struct Light {
  GateStatus status = GateStatus::pass;  ///< fail, warn or pass.
  std::string head;                      ///< "Use the numbers with caution"
  std::string answered;                  ///< "11 of 13 questions about the recording and the fit are answered well"
  std::string leads_to;                  ///< "; these ask for caution:", or "." if nothing does.
  std::vector<Gate> reasons;             ///< What explains others, then the gates of this status; none for pass.
  std::string besides;                   ///< Beside failures, the gates that ask for caution by name; or empty.
};

/// Returns the light of at least one gate.
[[nodiscard]] Light light_of(const std::vector<Gate>& gates);

/// Returns the light as HTML, with a shape of its own for each status: the color-blind can tell them apart. Empty
/// without gates.
[[nodiscard]] std::string light_html(const std::vector<Gate>& gates);

}  // namespace myoid::page
