#include "myoid/page/muscle_names.h"

#include <gtest/gtest.h>

namespace myoid::page {
namespace {

TEST(PlainMuscle, SpellsAbbreviationsSidesAndParts) {
  EXPECT_EQ(plain_muscle("BIC"), "Biceps");
  EXPECT_EQ(plain_muscle("bifemlh_r"), "Biceps femoris long head (right)");
  EXPECT_EQ(plain_muscle("med_gas_l"), "Gastrocnemius medialis (left)");
  EXPECT_EQ(plain_muscle("glmed2_r"), "Gluteus medius, part 2 (right)");
  EXPECT_EQ(plain_muscle("DELT1"), "Deltoid anterior");
  EXPECT_EQ(plain_muscle("soleus"), "Soleus");
}

TEST(PlainMuscle, LeavesNamesThatItDoesNotKnow) {
  for (const char* name : {"GM", "Bizeps links", "bic2nd", "李", "_r", "2", ""}) EXPECT_EQ(plain_muscle(name), name);
}

TEST(PlainMuscle, TheOwnNameStandsBehindWhereItDiffers) {
  EXPECT_EQ(plain_muscle_and_name("TRI"), "Triceps (TRI)");
  EXPECT_EQ(plain_muscle_and_name("soleus"), "Soleus");
  EXPECT_EQ(plain_muscle_and_name("Bizeps links"), "Bizeps links");
}

}  // namespace
}  // namespace myoid::page
