#include "myoid/muscle/absent_parameters.h"

#include <algorithm>

namespace myoid::muscle {

void complete_by_literature(HillParameters<double>& p, double slope_ratio) {
  const auto absent = [](double& value, double literature) {
    if (value == 0.0) value = literature;
  };
  absent(p.force_length_width_m, kLiteratureWidth * p.optimal_fiber_length_m);
  absent(p.concentric_curvature, kLiteratureCurvature);
  absent(p.eccentric_plateau, kLiteraturePlateau);
  absent(p.max_shortening_speed_mps, kLiteratureSpeed * p.optimal_fiber_length_m);
  // With a plateau of 1 the law in lengthening is level for every product.
  absent(p.eccentric_curvature_product,
         std::max(hill_field("eccentric_curvature_product").bounds.lower,
                  curvature_product_from_slope_ratio(slope_ratio, p.concentric_curvature, p.eccentric_plateau)));
}

}  // namespace myoid::muscle
