#include "myoid/muscle/musculotendon.h"

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::muscle {
namespace {

void require(bool good, std::string_view name, double value, std::string_view expected) {
  if (!good || !std::isfinite(value)) {
    throw InvalidInput(fmt::format("{} = {:g}: expected {}", name, value, expected));
  }
}

}  // namespace

MusculotendonLaws paper_laws(TendonMode mode) {
  return {mode, LengthLaw::gaussian, VelocityLaw::hill, PassiveLaw::none, TendonLaw::linear};
}
MusculotendonLaws thelen_laws(TendonMode mode) {
  return {mode, LengthLaw::gaussian, VelocityLaw::thelen, PassiveLaw::thelen, TendonLaw::thelen};
}
MusculotendonLaws de_groote_laws(TendonMode mode) {
  return {mode, LengthLaw::de_groote, VelocityLaw::de_groote, PassiveLaw::de_groote, TendonLaw::de_groote};
}
MusculotendonLaws millard_laws(TendonMode mode) {
  return {mode, LengthLaw::millard, VelocityLaw::millard, PassiveLaw::millard, TendonLaw::millard};
}

MusculotendonLaws soest_laws(TendonMode mode) {
  return {mode, LengthLaw::soest, VelocityLaw::soest, PassiveLaw::soest, TendonLaw::soest};
}

MusculotendonLaws laws_of(LawSet set, TendonMode mode) {
  switch (set) {
    case LawSet::paper:
      return paper_laws(mode);
    case LawSet::thelen:
      return thelen_laws(mode);
    case LawSet::de_groote:
      return de_groote_laws(mode);
    case LawSet::millard:
      return millard_laws(mode);
    case LawSet::soest:
      return soest_laws(mode);
  }
  return {};
}

MusculotendonParameters<double> published_defaults(const HillParameters<double>& hill, const MusculotendonLaws& laws) {
  MusculotendonParameters<double> p;
  p.hill = hill;
  switch (laws.tendon) {
    case TendonLaw::linear:
      p.tendon_strain = 0.033;
      break;
    case TendonLaw::thelen:
    case TendonLaw::soest:
      p.tendon_strain = 0.04;
      break;
    case TendonLaw::de_groote:
    case TendonLaw::millard:
      p.tendon_strain = 0.049;
      break;
  }
  p.passive_strain = 0.6;
  p.passive_shape = laws.passive == PassiveLaw::thelen ? 5.0 : 4.0;
  p.damping = laws.velocity == VelocityLaw::soest ? 1e-4 : 0.1;
  p.muscle_mass_kg = muscle_mass_kg(hill.max_isometric_force_n, hill.optimal_fiber_length_m);
  return p;
}

void validate(const MusculotendonParameters<double>& p, const MusculotendonLaws& laws) {
  validate(p.hill);
  require(p.tendon_strain > 0.0, "tendon_strain", p.tendon_strain, "a positive number");
  require(p.damping >= 0.0, "damping", p.damping, "zero or a positive number");
  require(p.muscle_mass_kg > 0.0 || laws.mode != TendonMode::mass, "muscle_mass", p.muscle_mass_kg,
          "a positive number of kilograms, or another mode than `mass`");
  require(p.pennation_at_optimal_rad >= 0.0 && p.pennation_at_optimal_rad < 1.4, "pennation_at_optimal",
          p.pennation_at_optimal_rad, "0 to 1.4 rad");
  require(p.passive_strain > 0.0, "passive_strain", p.passive_strain, "a positive number");
  require(p.passive_shape > 0.0, "passive_shape", p.passive_shape, "a positive number");
  require(p.passive_slack >= 0.0 && (laws.passive != PassiveLaw::soest || p.passive_slack < 1.0 + p.passive_strain),
          "passive_slack", p.passive_slack, "a length over l0 below 1 + passive_strain");
  require(p.optimal_length_shift >= 0.0 && p.optimal_length_shift < 10.0, "optimal_length_shift",
          p.optimal_length_shift, "0 (none) or a small positive number such as 0.15");
  const double plateau = p.hill.eccentric_plateau;
  if (laws.velocity == VelocityLaw::thelen) {
    require(0.95 * plateau > 1.0, "eccentric_plateau", plateau,
            "more than 1.053 (Thelen's law goes on as a line from 95 % of it)");
  }
  if (laws.mode != TendonMode::rigid) {
    require(p.hill.tendon_slack_length_m > 0.0, "tendon_slack_length", p.hill.tendon_slack_length_m,
            "a positive length, or mode `rigid`");
  }
  if (laws.mode == TendonMode::equilibrium) {
    if (laws.velocity == VelocityLaw::hill || laws.velocity == VelocityLaw::soest) {
      require(plateau >= 1.0, "eccentric_plateau", plateau,
              "at least 1: below it the equilibrium has several velocities");
    }
    if (p.damping == 0.0) {
      if (laws.velocity != VelocityLaw::hill && laws.velocity != VelocityLaw::thelen) {
        throw InvalidInput(
            "damping = 0 with a force-velocity curve that does not end in lines: expected a "
            "positive damping (0.1 is usual), or the velocity law `hill` or `thelen`");
      }
      require(plateau > 1.0, "eccentric_plateau", plateau, "more than 1 where damping is 0");
    }
  }
}

std::array<double, kMusculotendonEventCount> musculotendon_events(const Musculotendon<double>& unit,
                                                                  const MusculotendonInput<double>& input,
                                                                  const MusculotendonState<double>& state) {
  namespace detail = musculotendon_detail;
  const detail::Instant<double> now = detail::instant(unit, input, state, detail::Depth::all);
  const MusculotendonParameters<double>& p = unit.parameters();
  const double law_speed =
      unit.laws().velocity == VelocityLaw::thelen ? now.speed / thelen_speed(input.activation) : now.speed;
  const VelocityHyperbola<double>& h = unit.curves().hyperbola();
  const bool tangent = h.tangent_from < 1.0 &&
                       (unit.laws().velocity == VelocityLaw::hill || unit.laws().velocity == VelocityLaw::thelen);
  const double last = tangent ? h.eccentric_curvature_product * h.tangent_from / (1.0 - h.tangent_from) : 0.0;
  return {unit.laws().mode == TendonMode::rigid ? now.tendon.value : now.strain,
          now.speed,
          unit.curves().zero_velocity(now.activity()) + law_speed,
          now.length_m / p.hill.optimal_fiber_length_m - 1.0,
          now.length_m / unit.shortest_fiber_m() - 1.0,
          tangent ? law_speed - last : 1.0};
}

template class Musculotendon<double>;

}  // namespace myoid::muscle
