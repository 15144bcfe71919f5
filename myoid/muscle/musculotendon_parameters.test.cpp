#include "myoid/muscle/musculotendon_parameters.h"

#include <set>
#include <string>

#include <ceres/jet.h>
#include <gtest/gtest.h>

#include "myoid/muscle/scalar.h"

namespace myoid::muscle {
namespace {

TEST(MusculotendonParameters, AreVisitedOnceEachUnderTheNamesOfTheHillFields) {
  MusculotendonParameters<double> p;
  std::set<std::string> names;
  std::set<double*> fields;
  visit_parameters(p, [&](std::string_view name, Unit, double& field) {
    names.insert(std::string(name));
    fields.insert(&field);
  });
  EXPECT_EQ(static_cast<int>(names.size()), kMusculotendonParameterCount);
  EXPECT_EQ(static_cast<int>(fields.size()), kMusculotendonParameterCount);
  EXPECT_EQ(sizeof(p), kMusculotendonParameterCount * sizeof(double));  // none is forgotten
  for (const HillField& field : kHillFields) {
    EXPECT_TRUE(names.contains(std::string(field.name))) << field.name;
    visit_parameters(p, [&](std::string_view name, Unit unit, double& visited) {
      if (name != field.name) return;
      EXPECT_EQ(&visited, &(p.hill.*field.member));
      EXPECT_EQ(unit, field.unit);
    });
  }
}

TEST(MusculotendonParameters, LiftedOnesCarryTheValuesAndNoDerivatives) {
  using Jet = ceres::Jet<double, 2>;
  MusculotendonParameters<double> p;
  double next = 1.0;
  visit_parameters(p, [&](std::string_view, Unit, double& field) { field = next++; });
  auto up = lifted<Jet>(p);
  next = 1.0;
  visit_parameters(up, [&](std::string_view, Unit, Jet& field) {
    EXPECT_EQ(value_of(field), next++);
    EXPECT_EQ(field.v.norm(), 0.0);
  });
}

TEST(MusculotendonParameters, MassIsDensityTimesAreaTimesLength) {
  // 0.15 kg for the long head of the biceps, 0.23 for that of the triceps.
  EXPECT_NEAR(muscle_mass_kg(624.3, 0.1157), 0.153, 5e-4);
  EXPECT_NEAR(muscle_mass_kg(798.52, 0.1340), 0.227, 5e-4);
}

}  // namespace
}  // namespace myoid::muscle
